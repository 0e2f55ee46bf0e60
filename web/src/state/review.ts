/** States of review: which are open, and what a decision makes of them. */

import type { ClassIndex, DecisionAction, ObjectIndex, ObjectState, ReviewState } from "../api/types";
import type { SceneModel } from "./model";

const SETTLED: ReadonlySet<ReviewState> = new Set(["confirmed", "corrected", "no-class"]);
const NO_CLASS_REASONS: readonly ReviewState[] = ["refused", "unreadable", "failed"];

/** Returns whether a person still has to decide. */
export function isOpen(state: ReviewState): boolean {
  return !SETTLED.has(state);
}

/** Returns why a grounder named no class for some objects, each reason once. */
export function reasonsForNoClass(states: readonly ObjectState[], objects: readonly ObjectIndex[]): ReviewState[] {
  const found = new Set(objects.map((object) => states[object]?.state));
  return NO_CLASS_REASONS.filter((reason) => found.has(reason));
}

/** Returns the objects for which no class is suggested. */
export function withoutSuggestion(states: readonly ObjectState[], objects: readonly ObjectIndex[]): ObjectIndex[] {
  return objects.filter((object) => (states[object]?.suggested ?? -1) < 0);
}

/** Returns all states with some replaced. */
export function applyStates(states: readonly ObjectState[], changed: readonly ObjectState[]): readonly ObjectState[] {
  if (changed.length === 0) return states;
  const found = [...states];
  for (const state of changed) found[state.object] = state;
  return found;
}

/**
 * Returns the states that the server will answer to a decision, so that the page need not wait; none for `clear`, since
 * only the server knows what an object was before any decision: suggested, refused, decided by an earlier run.
 */
export function predictStates(
  states: readonly ObjectState[],
  objects: readonly ObjectIndex[],
  action: DecisionAction,
  chosen?: ClassIndex,
): ObjectState[] {
  if (action === "clear") return [];
  return objects.flatMap((object) => {
    const state = states[object];
    return state === undefined ? [] : [{ ...state, ...judge(state, action, chosen), proposal: "" }];
  });
}

function judge(
  state: ObjectState,
  action: Exclude<DecisionAction, "clear">,
  chosen = -1,
): Pick<ObjectState, "state" | "class"> {
  switch (action) {
    case "confirm":
      return { state: "confirmed", class: state.suggested };
    case "choose":
      return { state: chosen === state.suggested ? "confirmed" : "corrected", class: chosen };
    case "no-class":
      return { state: "no-class", class: -1 };
    case "unsure":
      return { state: "unsure", class: state.suggested };
  }
}

/** Returns the direct superclass that the key for "one level up" chooses, or -1 at a root. */
export function superclass(model: SceneModel, index: ClassIndex): ClassIndex {
  return model.data.classes[index]?.parents[0] ?? -1;
}

/** Returns the superclasses of the classes of some objects, decided or suggested, each once; -1 for a root or no class. */
export function superclasses(
  model: SceneModel,
  states: readonly ObjectState[],
  objects: readonly ObjectIndex[],
): ClassIndex[] {
  const found = objects.map((object) => {
    const { class: index = -1, suggested = -1 } = states[object] ?? {};
    return superclass(model, index >= 0 ? index : suggested);
  });
  return [...new Set(found)];
}

export function groupCount(count: number): string {
  return `${count} ${count === 1 ? "group" : "groups"}`;
}

/** Returns a time like "2 h 10 min". */
export function durationText(seconds: number): string {
  const minutes = Math.round(seconds / 60);
  if (minutes < 1) return "under a minute";
  if (minutes < 60) return `${minutes} min`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}
