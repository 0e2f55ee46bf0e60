/** The box around objects, without outliers that would make everything else too small to see. */

import type { Box, ObjectColumns, ObjectIndex } from "../api/types";

/** Returns the box around objects, by default all, that are no outliers; around all of them if there are no others. */
export function boundsOf(
  columns: Pick<ObjectColumns, "box" | "is_outlier">,
  objects: readonly ObjectIndex[] = [...columns.box.keys()],
): Box | null {
  const usual = objects.filter((object) => columns.is_outlier[object] !== true);
  let bounds: Box | null = null;
  for (const object of usual.length > 0 ? usual : objects) {
    const box = columns.box[object];
    if (box == null) continue;
    bounds = bounds === null ? [...box] : join(bounds, box);
  }
  return bounds;
}

function join(one: Box, other: Box): Box {
  return one.map((value, axis) => (axis < 3 ? Math.min : Math.max)(value, other[axis] as number)) as Box;
}
