/** Subclasses that the ontology lacks and reviewers propose. */

import type { ClassIndex, ObjectState } from "../api/types";
import { conceptOf } from "./concepts";
import { conceptLabel } from "./model";
import type { Store } from "./store";

interface ProposedClass {
  label: string;
  parent: ClassIndex;
  /** How many objects it holds. */
  objects: number;
}

/** Returns the proposed classes, those with the most objects first. */
export function listProposals(states: readonly ObjectState[]): ProposedClass[] {
  const found = new Map<string, ProposedClass>();
  for (const { proposal, class: parent } of states) {
    if (proposal === "") continue;
    const key = `${parent} ${proposal.toLowerCase()}`;
    const known = found.get(key) ?? { label: proposal, parent, objects: 0 };
    found.set(key, { ...known, objects: known.objects + 1 });
  }
  return [...found.values()].sort((a, b) => b.objects - a.objects || a.label.localeCompare(b.label));
}

/** Returns the label that a proposal starts with: that of the concept of the object under review. */
export function proposedLabel(store: Store): string {
  const concept = conceptOf(store);
  return concept < 0 ? "" : conceptLabel(store.model, concept);
}

/** Opens the dialog, if there is something to decide about. */
export function openProposal(store: Store): void {
  if (store.targets.value.length === 0) store.notify("Select objects for the proposed class");
  else store.isProposalOpen.value = true;
}
