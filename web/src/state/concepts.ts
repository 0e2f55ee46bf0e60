/** The concept of the object under review, and the open objects that have it. */

import type { ClassIndex, ConceptIndex, ObjectIndex, ObjectState } from "../api/types";
import { candidatesOf, focusOf } from "./candidates";
import { isOpen } from "./review";
import type { Store } from "./store";

interface ConceptObjects {
  open: ObjectIndex[];
  /** How many a person has decided; they stay as they are. */
  decided: number;
}

/** Returns the objects of a concept. */
export function objectsOfConcept(states: readonly ObjectState[], concept: ConceptIndex): ConceptObjects {
  const found = states.filter((state) => state.concept === concept);
  const open = found.filter((state) => isOpen(state.state)).map((state) => state.object);
  return { open, decided: found.length - open.length };
}

/** Returns the concept of the object under review; -1 without one. */
export function conceptOf(store: Store): ConceptIndex {
  return store.states.value[focusOf(store)]?.concept ?? -1;
}

/** Opens the dialog about all objects of the concept, if there are any to decide. */
export function openConcept(store: Store): void {
  const concept = conceptOf(store);
  if (concept < 0) store.notify("The object has no concept");
  else if (objectsOfConcept(store.states.value, concept).open.length === 0)
    store.notify("No object of the concept is open");
  else store.isConceptOpen.value = true;
}

/** Returns the classes that are offered first for the object under review: its class, then its candidates. */
export function offeredClasses(store: Store): ClassIndex[] {
  const state = store.states.value[focusOf(store)];
  const candidates = (candidatesOf(store) ?? []).map((candidate) => candidate.class);
  return [...new Set([state?.class ?? -1, ...candidates])].filter((index) => index >= 0);
}
