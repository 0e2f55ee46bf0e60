/** Labels of objects and lines of relations around the object in focus. */

import { Vector3 } from "three";
import type { ObjectIndex, ObjectPage, RelationRecord } from "../api/types";
import { classLabel } from "../state/model";
import type { Store } from "../state/store";
import type { OverlayLabel } from "./overlay";
import type { RelationLine } from "./viewer";

const MAX_LABELS = 150;
const MAX_LINES = 40;

export interface Annotations {
  lines: RelationLine[];
  labels: OverlayLabel[];
}

export function annotate(
  store: Store,
  page: ObjectPage | null,
  centerOf: (object: ObjectIndex) => Vector3 | null,
): Annotations {
  const { selection, relationKinds, hasLabels, shown, isolated } = store;
  const kinds = relationKinds.value;
  const isShown = page !== null && selection.value.length === 1 && selection.value[0] === page.object;
  const lines = isShown
    ? page.relations
        .filter((relation) => kinds.has(relation.kind) && relation.target >= 0 && relation.anchor >= 0)
        .slice(0, MAX_LINES)
        .map((relation) => ({ from: relation.target, to: relation.anchor, text: relationText(relation) }))
    : [];
  const around = new Set(lines.flatMap(({ from, to }) => [from, to]));
  const visible = isolated.value ?? shown.value;
  const wanted = hasLabels.value
    ? store.states.value.filter((state) => visible === null || visible.has(state.object)).map((state) => state.object)
    : [...around];
  const labels = wanted.slice(0, MAX_LABELS).flatMap((object) => {
    const at = topOf(store, object) ?? centerOf(object);
    const state = store.states.value[object];
    return at === null || state === undefined
      ? []
      : [{ at, text: state.class < 0 ? "no class" : classLabel(store.model, state.class), kind: "object" as const }];
  });
  return { lines, labels };
}

function topOf(store: Store, object: ObjectIndex): Vector3 | null {
  const box = store.model.data.objects.box[object];
  return box == null ? null : new Vector3((box[0] + box[3]) / 2, (box[1] + box[4]) / 2, box[5]);
}

/** Returns a relation with its most telling number: `near 0.31 m`. */
export function relationText(relation: RelationRecord): string {
  const { distance, gap } = relation.numbers;
  const length = distance ?? gap;
  const text = relation.kind.replace("-", " ");
  return length === undefined || Math.abs(length) < 0.005 ? text : `${text} ${length.toFixed(2)} m`;
}
