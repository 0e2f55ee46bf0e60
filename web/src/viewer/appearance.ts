/** How each object is drawn: its colour, whether it is hidden, and whether it is a ghost. */

import { Box3, Ray, Vector3 } from "three";
import type { ObjectIndex, SceneData } from "../api/types";
import type { Rgb } from "../state/colors";
import type { Store } from "../state/store";
import { cutAway, ghostsOf } from "./cutaway";
import { GHOST_OPACITY } from "./look";
import type { Appearance } from "./meshes";

/** The viewer: position, and unit vector from the scene to there. */
export interface Eye {
  position: Vector3;
  direction: Vector3;
}

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
  const holders = ghostsOf(data);
  return (object) => {
    if (object < 0) return { isVisible: alone === null, color: null, opacity: isGhostly ? GHOST_OPACITY : 1 };
    const isHidden = (hidden.has(object) || before.has(object)) && !selected.has(object);
    const isWanted = alone === null ? !isHidden : alone.has(object);
    const isGhost =
      holders.has(object) || (isGhostly && !selected.has(object)) || (filtered !== null && !filtered.has(object));
    return { isVisible: isWanted, color: colors[object] ?? null, opacity: isGhost ? GHOST_OPACITY : 1 };
  };
}

/**
 * Returns the objects that hide the middle of one of the watched objects, or hold it: cabinets, doors, lids.
 *
 * @param meets whether a ray meets the meshes of an object nearer than a distance. It decides about what holds the
 *   viewer, such as the walls of a house: the inside of its box is mostly empty.
 */
export function occluders(
  data: SceneData,
  watched: readonly ObjectIndex[],
  eye: Eye,
  meets: (object: ObjectIndex, ray: Ray, distance: number) => boolean,
): Set<ObjectIndex> {
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
      if (box.containsPoint(eye.position)) {
        if (meets(index, ray, distance)) found.add(index);
        return;
      }
      if (ray.intersectBox(box, hit) !== null && hit.distanceTo(eye.position) < distance) found.add(index);
    });
  }
  return found;
}
