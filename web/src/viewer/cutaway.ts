/** What the view leaves out so that the inside of a room is seen, and boxes that would hide what they hold. */

import type { Box, ObjectIndex, SceneData } from "../api/types";
import { boundsOf } from "./bounds";
import { middleOf } from "./look";

const MIN_HELD = 3;
/** Share of the volume of the scene from which a box may hold the others. */
const MIN_HOLDER_SHARE = 0.02;
/** A wall is near if its outside faces the viewer by more than this cosine. */
const MIN_COSINE = 0.15;

const knownHolders = new WeakMap<SceneData, Set<ObjectIndex>>();

/** Returns the objects that are ghosts because a box without meshes would hide what they hold. */
export function ghostsOf(data: SceneData): ReadonlySet<ObjectIndex> {
  if (data.limits.meshes === undefined) return new Set();
  const found = knownHolders.get(data) ?? findHolders(data);
  knownHolders.set(data, found);
  return found;
}

/** Returns the objects that hold others: their parents, and large boxes around the middles of several others. */
export function findHolders({ objects }: SceneData): Set<ObjectIndex> {
  const holders = new Set(objects.parent);
  const bounds = boundsOf(objects);
  const least = MIN_HOLDER_SHARE * (bounds === null ? 0 : volume(bounds));
  const middles = objects.box.map((own) => (own === null ? null : middleOf(own)));
  objects.box.forEach((own, object) => {
    if (own === null || volume(own) < least) return;
    const held = middles.filter((middle, other) => middle !== null && other !== object && holds(own, middle));
    if (held.length >= MIN_HELD) holders.add(object);
  });
  return holders;
}

function holds(box: Box, point: readonly number[]): boolean {
  return point.every((value, axis) => value >= (box[axis] as number) && value <= (box[axis + 3] as number));
}

function volume([x0, y0, z0, x1, y1, z1]: Box): number {
  return (x1 - x0) * (y1 - y0) * (z1 - z0);
}

/** Returns the ceilings, the walls between the viewer and the scene, and what is attached to those walls. */
export function cutAway(data: SceneData, direction: { x: number; y: number }): Set<ObjectIndex> {
  const { shell, box, mount } = data.objects;
  const hidden = new Set<ObjectIndex>();
  const bounds = boundsOf(data.objects);
  const [centerX, centerY] = bounds === null ? [0, 0] : middleOf(bounds);
  const length = Math.hypot(direction.x, direction.y) || 1;
  shell.forEach((kind, object) => {
    const own = box[object];
    if (kind === "ceiling") hidden.add(object);
    if (kind !== "wall" || own == null) return;
    const [x, y] = middleOf(own);
    const isThinX = own[3] - own[0] < own[4] - own[1];
    // The outside of a wall is along its thin side, away from the middle.
    const cosine = (isThinX ? Math.sign(x - centerX) * direction.x : Math.sign(y - centerY) * direction.y) / length;
    if (cosine > MIN_COSINE) hidden.add(object);
  });
  mount.forEach((wall, object) => {
    if (wall >= 0 && shell[wall] === "wall" && hidden.has(wall)) hidden.add(object);
  });
  return hidden;
}
