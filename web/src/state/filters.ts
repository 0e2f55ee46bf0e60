/** Facets and full text: which objects are shown. */

import type { ClassIndex, ConceptIndex, ObjectIndex, ObjectState, ReviewState } from "../api/types";
import type { SceneModel } from "./model";

export interface Filters {
  text: string;
  /** Objects of this class or a class below it; -1 for all. */
  class: ClassIndex;
  concept: ConceptIndex;
  room: number;
  states: ReadonlySet<ReviewState>;
  /** Confidence from and to, inclusive; objects without one count as 0. */
  confidence: readonly [number, number];
}

export const NO_FILTERS: Filters = {
  text: "",
  class: -1,
  concept: -1,
  room: -1,
  states: new Set(),
  confidence: [0, 1],
};

export function isFiltering(filters: Filters): boolean {
  return (
    filters.text.trim() !== "" ||
    filters.class >= 0 ||
    filters.concept >= 0 ||
    filters.room >= 0 ||
    filters.states.size > 0 ||
    filters.confidence[0] > 0 ||
    filters.confidence[1] < 1
  );
}

/** Returns the objects that pass, in scene order. All words of the text must occur in path, name, class or concept. */
export function filterObjects(model: SceneModel, states: readonly ObjectState[], filters: Filters): ObjectIndex[] {
  const words = filters.text.toLowerCase().split(/\s+/).filter(Boolean);
  const classes = filters.class >= 0 ? model.classClosure[filters.class] : undefined;
  const [least, most] = filters.confidence;
  const found: ObjectIndex[] = [];
  for (const state of states) {
    const confidence = state.confidence ?? 0;
    if (classes !== undefined && !classes.has(state.class)) continue;
    if (filters.concept >= 0 && state.concept !== filters.concept) continue;
    if (filters.room >= 0 && model.data.objects.room[state.object] !== filters.room) continue;
    if (filters.states.size > 0 && !filters.states.has(state.state)) continue;
    if (confidence < least || confidence > most) continue;
    if (words.length > 0) {
      const label = model.data.classes[state.class]?.label ?? "";
      const concept = model.data.concepts[state.concept]?.label ?? "";
      const text = `${model.objectText[state.object]} ${label} ${concept}`.toLowerCase();
      if (!words.every((word) => text.includes(word))) continue;
    }
    found.push(state.object);
  }
  return found;
}

/** Returns value → number of objects, largest first. */
export function countBy<T>(states: readonly ObjectState[], key: (state: ObjectState) => T): [T, number][] {
  const counts = new Map<T, number>();
  for (const state of states) counts.set(key(state), (counts.get(key(state)) ?? 0) + 1);
  return [...counts].sort((a, b) => b[1] - a[1]);
}
