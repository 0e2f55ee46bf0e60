/** How each object is drawn: its colour, whether it is hidden, and whether it is a ghost. */

import { Box3, Ray, Vector3 } from "three";
import type { Box, ObjectIndex, SceneData } from "../api/types";
import type { Rgb } from "../state/colors";
import type { Store } from "../state/store";
import { boundsOf } from "./bounds";
import type { Appearance } from "./meshes";

/** The viewer: position, and unit vector from the scene to there. */
export interface Eye {
  position: Vector3;
  direction: Vector3;
}

const GHOST = 0.12;
/** Selected objects whose view is kept free. */
export const MAX_WATCHED = 12;

/**
 * Returns the appearance of each object. It reads signals, so that an effect that calls it runs again when they change.
 *
 * @param eye where the viewer is.
 * @param before what hides the selection from there.
 */
export function appearanceOf(
  store: Store,
  colors: readonly (Rgb | null)[],
  eye: { value: Eye },
  before: ReadonlySet<ObjectIndex>,
): (object: ObjectIndex) => Appearance {
  const { isolated, isSeeThrough, isCutAway, shown, selection } = store;
  const [alone, filtered, selected] = [isolated.value, shown.value, new Set(selection.value)];
  const isGhostly = isSeeThrough.value && selected.size > 0;
  const hidden = isCutAway.value ? cutAway(store.model.data, eye.value.direction) : new Set<ObjectIndex>();
  const { data } = store.model;
  const holders = data.limits.meshes === undefined ? new Set<ObjectIndex>() : holdersOf(data);
  return (object) => {
    if (object < 0) return { isVisible: alone === null, color: null, opacity: isGhostly ? GHOST : 1 };
    const isHidden = (hidden.has(object) || before.has(object)) && !selected.has(object);
    const isWanted = alone === null ? !isHidden : alone.has(object);
    // A box without meshes would hide what the object holds.
    const isGhost =
      holders.has(object) || (isGhostly && !selected.has(object)) || (filtered !== null && !filtered.has(object));
    return { isVisible: isWanted, color: colors[object] ?? null, opacity: isGhost ? GHOST : 1 };
  };
}

const MIN_HELD = 3;
/** Share of the volume of the scene from which a box may hold the others. */
const MIN_HOLDER_SHARE = 0.02;

const knownHolders = new WeakMap<SceneData, Set<ObjectIndex>>();

function holdersOf(data: SceneData): Set<ObjectIndex> {
  const found = knownHolders.get(data) ?? findHolders(data);
  knownHolders.set(data, found);
  return found;
}

/** Returns the objects that hold others: their parents, and large boxes around the middles of several others. */
export function findHolders({ objects }: SceneData): Set<ObjectIndex> {
  const holders = new Set(objects.parent);
  const boxes = objects.box.map((own) => (own === null ? null : asBox3(own)));
  const least = MIN_HOLDER_SHARE * volume(boundsOf(objects));
  const middles = boxes.map((own) => own?.getCenter(new Vector3()) ?? null);
  boxes.forEach((own, object) => {
    if (own === null || volume(own) < least) return;
    const held = middles.filter((middle, other) => middle !== null && other !== object && own.containsPoint(middle));
    if (held.length >= MIN_HELD) holders.add(object);
  });
  return holders;
}

function asBox3([x0, y0, z0, x1, y1, z1]: Box): Box3 {
  return new Box3(new Vector3(x0, y0, z0), new Vector3(x1, y1, z1));
}

function volume(box: Box3): number {
  const { x, y, z } = box.getSize(new Vector3());
  return x * y * z;
}

/** A wall is near if its outside faces the viewer by more than this cosine. */
const MIN_COSINE = 0.15;

/** Returns the ceilings, the walls between the viewer and the scene, and what is attached to those walls. */
export function cutAway(data: SceneData, direction: Pick<Vector3, "x" | "y">): Set<ObjectIndex> {
  const { shell, box, mount } = data.objects;
  const hidden = new Set<ObjectIndex>();
  const center = boundsOf(data.objects).getCenter(new Vector3());
  const length = Math.hypot(direction.x, direction.y) || 1;
  shell.forEach((kind, object) => {
    const own = box[object];
    if (kind === "ceiling") hidden.add(object);
    if (kind !== "wall" || own == null) return;
    const [x, y] = [(own[0] + own[3]) / 2 - center.x, (own[1] + own[4]) / 2 - center.y];
    const isThinX = own[3] - own[0] < own[4] - own[1];
    // The outside of a wall is along its thin side, away from the middle.
    const cosine = (isThinX ? Math.sign(x) * direction.x : Math.sign(y) * direction.y) / length;
    if (cosine > MIN_COSINE) hidden.add(object);
  });
  mount.forEach((wall, object) => {
    if (wall >= 0 && shell[wall] === "wall" && hidden.has(wall)) hidden.add(object);
  });
  return hidden;
}

/** Returns the objects whose boxes hide the middle of one of the watched objects, or hold it: cabinets, doors, lids. */
export function occluders(data: SceneData, watched: readonly ObjectIndex[], eye: Eye): Set<ObjectIndex> {
  const found = new Set<ObjectIndex>();
  const boxes = data.objects.box;
  const box = new Box3();
  const hit = new Vector3();
  for (const object of watched) {
    const own = boxes[object];
    if (own == null) continue;
    const middle = new Vector3((own[0] + own[3]) / 2, (own[1] + own[4]) / 2, (own[2] + own[5]) / 2);
    const ray = new Ray(eye.position, middle.clone().sub(eye.position).normalize());
    const distance = eye.position.distanceTo(middle);
    boxes.forEach((other, index) => {
      if (other === null || index === object) return;
      box.min.set(other[0], other[1], other[2]);
      box.max.set(other[3], other[4], other[5]);
      // What holds the viewer, such as a room, hides nothing.
      if (box.containsPoint(eye.position)) return;
      if (ray.intersectBox(box, hit) !== null && hit.distanceTo(eye.position) < distance) found.add(index);
    });
  }
  return found;
}
