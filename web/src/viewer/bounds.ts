/** The box around objects, without outliers that would make everything else too small to see. */

import { Box3, Vector3 } from "three";
import type { ObjectColumns, ObjectIndex } from "../api/types";
import { indices } from "../state/model";

/** Returns the box around objects, by default all, that are no outliers; around all of them if there are no others. */
export function boundsOf(
  columns: Pick<ObjectColumns, "box" | "is_outlier">,
  objects: readonly ObjectIndex[] = indices(columns.box.length),
): Box3 {
  const usual = objects.filter((object) => columns.is_outlier[object] !== true);
  const bounds = new Box3();
  for (const object of usual.length > 0 ? usual : objects) {
    const box = columns.box[object];
    if (box == null) continue;
    bounds.expandByPoint(new Vector3(box[0], box[1], box[2]));
    bounds.expandByPoint(new Vector3(box[3], box[4], box[5]));
  }
  return bounds;
}
