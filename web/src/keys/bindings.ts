/** All keys, in one table: the handler and the help are made from it. */

import type { Signal } from "@preact/signals";
import { toggleAudit } from "../state/audit";
import { loadCandidates } from "../state/candidates";
import { openConcept } from "../state/concepts";
import { openProposal } from "../state/proposals";
import { superclasses } from "../state/review";
import type { Store } from "../state/store";

export interface ViewCommands {
  frame(): void;
  frameAll(): void;
  look(view: "perspective" | "top" | "front" | "left"): void;
  /** Moves the camera by steps to the right and up; a zoom by steps up is nearer. */
  steer(movement: "orbit" | "pan" | "zoom", right: number, up: number): void;
}

export interface Binding {
  /** As `keyName` writes them. */
  keys: string[];
  help: string;
  section: "Review" | "Queue" | "View" | "Page";
  run(store: Store, view: ViewCommands, key: string): void;
}

/** Returns the name of a key event, such as `Ctrl+Shift+Z`, `ArrowDown` or `?`. */
export function keyName(event: Pick<KeyboardEvent, "key" | "ctrlKey" | "metaKey" | "altKey" | "shiftKey">): string {
  const isLetter = /^[a-z]$/i.test(event.key);
  const parts = [];
  if (event.ctrlKey || event.metaKey) parts.push("Ctrl");
  if (event.altKey) parts.push("Alt");
  // Shift is part of the character of other keys: ? and not Shift+/.
  if (event.shiftKey && (isLetter || event.key.length > 1)) parts.push("Shift");
  parts.push(isLetter ? event.key.toUpperCase() : event.key === " " ? "Space" : event.key);
  return parts.join("+");
}

function review(store: Store): void {
  store.drawer.value = "review";
  store.isDrawerOpen.value = true;
}

export const BINDINGS: Binding[] = [
  {
    keys: ["Enter", "C"],
    help: "Confirm the suggestion for the ticked objects",
    section: "Review",
    run: (store) => void store.decide(store.targets.value, "confirm"),
  },
  {
    keys: ["1", "2", "3", "4", "5", "6", "7", "8", "9"],
    help: "Choose the candidate with this number",
    section: "Review",
    run: (store, _, key) => void chooseCandidate(store, Number(key) - 1),
  },
  {
    keys: ["U"],
    help: "Choose the superclass of the suggestion",
    section: "Review",
    run: (store) => chooseSuperclass(store),
  },
  {
    keys: ["/"],
    help: "Search a class to choose",
    section: "Review",
    run: (store) => {
      store.isClassSearchOpen.value = true;
    },
  },
  {
    keys: ["N"],
    help: "No class fits",
    section: "Review",
    run: (store) => void store.decide(store.targets.value, "no-class"),
  },
  {
    keys: ["Q"],
    help: "Unsure: leave it to somebody else",
    section: "Review",
    run: (store) => void store.decide(store.targets.value, "unsure"),
  },
  {
    keys: ["Backspace"],
    help: "Clear the decision",
    section: "Review",
    run: (store) => void store.decide(store.selection.value, "clear"),
  },
  {
    keys: ["B"],
    help: "Confirm many groups at once",
    section: "Review",
    run: (store) => {
      store.isBulkOpen.value = true;
    },
  },
  {
    keys: ["E"],
    help: "Every object of the concept has one class, here and in other scenes",
    section: "Review",
    run: openConcept,
  },
  {
    keys: ["M"],
    help: "A class is missing: propose a subclass",
    section: "Review",
    run: openProposal,
  },
  {
    keys: ["R"],
    help: "Ground again with what the decisions teach",
    section: "Review",
    run: (store) => void store.groundAgain(),
  },
  { keys: ["Ctrl+Z", "Z"], help: "Undo", section: "Review", run: (store) => void store.undo() },
  { keys: ["Ctrl+Shift+Z", "Ctrl+Y", "Shift+Z"], help: "Redo", section: "Review", run: (store) => void store.redo() },
  {
    keys: ["V"],
    help: "Audit a random sample to verify the suggestions, or back to the queue",
    section: "Queue",
    run: toggleAudit,
  },
  {
    keys: ["ArrowDown", "J", "S"],
    help: "Skip to the next group",
    section: "Queue",
    run: (store) => {
      review(store);
      store.step(1);
    },
  },
  {
    keys: ["ArrowUp", "K"],
    help: "Previous group",
    section: "Queue",
    run: (store) => {
      review(store);
      store.step(-1);
    },
  },
  {
    keys: ["ArrowRight"],
    help: "Next member of the group",
    section: "Queue",
    run: (store) => moveMember(store, 1),
  },
  {
    keys: ["ArrowLeft"],
    help: "Previous member of the group",
    section: "Queue",
    run: (store) => moveMember(store, -1),
  },
  {
    keys: ["Space"],
    help: "Tick or untick the member: exceptions of the next decision",
    section: "Queue",
    run: (store) => {
      const object = store.group.value?.objects[store.member.value];
      if (object !== undefined) store.toggleMember(object);
    },
  },
  { keys: ["F"], help: "Look at the selection", section: "View", run: (_, view) => view.frame() },
  { keys: ["A"], help: "Look at everything", section: "View", run: (_, view) => view.frameAll() },
  {
    keys: ["I"],
    help: "Isolate the selection, or show all again",
    section: "View",
    run: (store) => {
      const selected = store.selection.value;
      store.isolated.value = store.isolated.value === null && selected.length > 0 ? new Set(selected) : null;
    },
  },
  {
    keys: ["X"],
    help: "See through everything but the selection",
    section: "View",
    run: (store) => {
      store.isSeeThrough.value = !store.isSeeThrough.value;
    },
  },
  {
    keys: ["W"],
    help: "Hide ceilings, near walls and what is before the selection",
    section: "View",
    run: (store) => {
      store.isCutAway.value = !store.isCutAway.value;
    },
  },
  {
    keys: ["L"],
    help: "Labels on or off",
    section: "View",
    run: (store) => {
      store.hasLabels.value = !store.hasLabels.value;
    },
  },
  { keys: ["P"], help: "Perspective", section: "View", run: (_, view) => view.look("perspective") },
  { keys: ["T"], help: "View from the top", section: "View", run: (_, view) => view.look("top") },
  { keys: ["Shift+F"], help: "View from the front", section: "View", run: (_, view) => view.look("front") },
  { keys: ["Shift+L"], help: "View from the left", section: "View", run: (_, view) => view.look("left") },
  {
    keys: ["Shift+ArrowLeft", "Shift+ArrowRight", "Shift+ArrowUp", "Shift+ArrowDown"],
    help: "Orbit: move around the target",
    section: "View",
    run: (_, view, key) => view.steer("orbit", ...directionOf(key)),
  },
  {
    keys: ["Ctrl+ArrowLeft", "Ctrl+ArrowRight", "Ctrl+ArrowUp", "Ctrl+ArrowDown"],
    help: "Pan: move along the picture",
    section: "View",
    run: (_, view, key) => view.steer("pan", ...directionOf(key)),
  },
  // A plus without Shift is an equals sign on many keyboards.
  { keys: ["+", "="], help: "Zoom in", section: "View", run: (_, view) => view.steer("zoom", 0, 1) },
  { keys: ["-"], help: "Zoom out", section: "View", run: (_, view) => view.steer("zoom", 0, -1) },
  {
    keys: ["D"],
    help: "Open or close the drawer",
    section: "Page",
    run: (store) => {
      store.isDrawerOpen.value = !store.isDrawerOpen.value;
    },
  },
  {
    keys: ["Ctrl+K", "G"],
    help: "Search objects",
    section: "Page",
    run: () => document.getElementById("search")?.focus(),
  },
  {
    keys: ["?"],
    help: "This help",
    section: "Page",
    run: (store) => {
      store.isHelpOpen.value = !store.isHelpOpen.value;
    },
  },
  {
    keys: ["Escape"],
    help: "Close what is open, or clear the selection",
    section: "Page",
    run: (store) => close(store),
  },
];

/** Returns the steps to the right and up of a key such as `Shift+ArrowLeft`. */
function directionOf(key: string): [number, number] {
  if (key.endsWith("Left")) return [-1, 0];
  if (key.endsWith("Right")) return [1, 0];
  return [0, key.endsWith("Up") ? 1 : -1];
}

async function chooseCandidate(store: Store, number: number): Promise<void> {
  const targets = store.targets.value;
  try {
    const chosen = (await loadCandidates(store))[number]?.class;
    if (chosen === undefined) store.notify(`There is no candidate ${number + 1}`);
    else await store.decide(targets, "choose", chosen);
  } catch (error) {
    store.report(error);
  }
}

/** Chooses the superclass that the objects have in common: one key is one decision. */
function chooseSuperclass(store: Store): void {
  const targets = store.targets.value;
  const [above, ...others] = superclasses(store.model, store.states.value, targets);
  if (above === undefined) return;
  if (others.length > 0) store.notify(`The ${targets.length} objects have several superclasses. Choose a class with /`);
  else if (above < 0) store.notify("The class has no superclass. Choose a class with /");
  else void store.decide(targets, "choose", above);
}

function moveMember(store: Store, by: number): void {
  const objects = store.group.value?.objects ?? [];
  const next = objects[(store.member.value + by + objects.length) % objects.length];
  if (next === undefined) return;
  // Where one member is selected, not the group, the selection moves along.
  if (store.selection.value.length === 1) store.select([next]);
  else store.focus(next);
}

/** Returns whether each dialog is open. */
export function dialogs(store: Store): Signal<boolean>[] {
  return [store.isHelpOpen, store.isClassSearchOpen, store.isBulkOpen, store.isConceptOpen, store.isProposalOpen];
}

function close(store: Store): void {
  if (store.changes.value !== null) {
    store.changes.value = null;
    return;
  }
  for (const dialog of dialogs(store)) {
    if (dialog.value) {
      dialog.value = false;
      return;
    }
  }
  if (store.isolated.value !== null) store.isolated.value = null;
  else store.select([]);
}

const BY_KEY = new Map(BINDINGS.flatMap((binding) => binding.keys.map((key) => [key, binding] as const)));

export function findBinding(key: string): Binding | undefined {
  return BY_KEY.get(key);
}
