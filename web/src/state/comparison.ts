/** The comparison with another version: loaded anew after decisions, filtered by kind, and as colours. */

import { batch, computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import type { ChangeKind, ClassClaim, Comparison, SceneChange } from "../api/comparison";
import type { Ghost } from "../viewer/ghosts";
import { type Coloring, fill, type LegendEntry, type Rgb, rgb } from "./colors";
import { REST } from "./palette";
import type { Store } from "./store";

/** In the order of the list, with the colours of the 3D view, which are also in styles/compare.css. */
export const CHANGES: { kind: ChangeKind; label: string; color: Rgb }[] = [
  { kind: "appeared", label: "Appeared", color: [0.2, 0.66, 0.39] },
  { kind: "disappeared", label: "Disappeared", color: [0.9, 0.28, 0.3] },
  { kind: "class", label: "Other class", color: [0.6, 0.45, 0.86] },
  { kind: "moved", label: "Moved", color: [0.95, 0.55, 0.13] },
  { kind: "turned", label: "Turned", color: [0.93, 0.77, 0.16] },
  { kind: "resized", label: "Resized", color: [0.1, 0.62, 0.65] },
  { kind: "renamed", label: "Renamed", color: [0.33, 0.55, 0.93] },
  { kind: "mass", label: "Other mass", color: [0.55, 0.4, 0.3] },
  { kind: "asset", label: "Other asset", color: [0.86, 0.44, 0.68] },
  { kind: "relations", label: "Other relations", color: [0.45, 0.58, 0.66] },
];

const RELOAD_MS = 400;

/** What the page knows of a comparison. */
export class ComparisonState {
  readonly data = signal<Comparison | null>(null);
  /** Kinds that are not shown. */
  readonly hidden = signal<ReadonlySet<ChangeKind>>(new Set());
  /** The change that is looked at. */
  readonly focused = signal<SceneChange | null>(null);
  readonly changes: ReadonlySignal<readonly SceneChange[]> = computed(() => this.data.value?.changes ?? []);
  /** The changes of the kinds that are shown, of objects that pass the filters of the page. */
  readonly rows: ReadonlySignal<readonly SceneChange[]>;
  /** What disappeared, and the old places of selected objects. */
  readonly ghosts: ReadonlySignal<readonly Ghost[]>;
  /** The old place of the change that is looked at, if it disappeared. */
  readonly focusedGhost: ReadonlySignal<Ghost | null>;

  constructor(private readonly store: Store) {
    this.rows = computed(() => shownChanges(this.changes.value, this.hidden.value, store.shown.value));
    const made = computed(() => new Map(this.rows.value.map((change) => [change, ghostOf(change)] as const)));
    this.focusedGhost = computed(() => {
      const change = this.focused.value;
      return change !== null && change.object < 0 ? (made.value.get(change) ?? null) : null;
    });
    this.ghosts = computed(() => {
      const isShown = store.colorMode.value === "change" || store.drawer.value === "compare";
      const selected = new Set(store.selection.value);
      return [...made.value].flatMap(([{ object }, ghost]) =>
        isShown && ghost !== null && (object < 0 || selected.has(object)) ? [ghost] : [],
      );
    });
  }

  async load(): Promise<void> {
    try {
      const data = await this.store.client.get<Comparison>("comparison");
      batch(() => {
        const before = this.focused.value;
        this.data.value = data;
        this.focused.value = data.changes.find((change) => isSame(change, before)) ?? null;
      });
    } catch (error) {
      this.store.report(error);
    }
  }

  toggle(kind: ChangeKind): void {
    const hidden = new Set(this.hidden.value);
    if (!hidden.delete(kind)) hidden.add(kind);
    this.hidden.value = hidden;
  }

  /** Shows one kind alone, or all again. */
  only(kind: ChangeKind): void {
    const others = CHANGES.map((each) => each.kind).filter((each) => each !== kind);
    const isAlone = others.every((each) => this.hidden.value.has(each)) && !this.hidden.value.has(kind);
    this.hidden.value = new Set(isAlone ? [] : others);
  }

  /** Selects the object of a change and looks at it, or at the place where it was. */
  look(change: SceneChange): void {
    batch(() => {
      this.focused.value = change;
      this.store.select(change.object < 0 ? [] : [change.object]);
      if (change.object >= 0) this.store.show([change.object]);
    });
  }
}

const states = new WeakMap<Store, ComparisonState>();

/** Shows the comparison, if there is one, when the page starts. */
export function startWithComparison(store: Store): void {
  if (!store.model.data.has_comparison) return;
  store.drawer.value = "compare";
  store.colorMode.value = "change";
}

/** Returns the comparison of a page; it follows the decisions. */
export function comparisonOf(store: Store): ComparisonState {
  const known = states.get(store);
  if (known !== undefined) return known;
  const state = new ComparisonState(store);
  states.set(store, state);
  if (!store.model.data.has_comparison) return state;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isFirst = true;
  effect(() => {
    void store.server.version.value;
    void store.states.value;
    clearTimeout(timer);
    timer = setTimeout(() => void state.load(), isFirst ? 0 : RELOAD_MS);
    isFirst = false;
  });
  return state;
}

function isSame(change: SceneChange, other: SceneChange | null): boolean {
  return change.path === other?.path && change.object < 0 === other.object < 0;
}

/** Returns the changes with a kind that is not hidden, of objects that pass a filter. */
function shownChanges(
  changes: readonly SceneChange[],
  hidden: ReadonlySet<ChangeKind>,
  shown: ReadonlySet<number> | null,
): SceneChange[] {
  return changes.filter(
    ({ kinds, object }) => kinds.some((kind) => !hidden.has(kind)) && (shown === null || shown.has(object)),
  );
}

function ghostOf({ kinds, box_before, turned_before }: SceneChange): Ghost | null {
  const wasElsewhere = kinds.some((kind) => ["disappeared", "moved", "turned", "resized"].includes(kind));
  return wasElsewhere && box_before !== null ? { box: box_before, turned: turned_before } : null;
}

/** Returns colours and legend; an object with several changes has the colour of the first. */
export function colorChanges(count: number, changes: readonly SceneChange[]): Coloring {
  const legend: LegendEntry[] = [];
  const changed = new Set<number>();
  for (const { kind, label, color } of CHANGES) {
    const found = changes.filter(({ kinds }) => kinds[0] === kind);
    const objects = found.map(({ object }) => object).filter((object) => object >= 0);
    for (const object of objects) changed.add(object);
    if (found.length > 0) legend.push({ label, color, objects, count: found.length });
  }
  const rest = Array.from({ length: count }, (_, object) => object).filter((object) => !changed.has(object));
  return fill(count, [...legend, { label: "Unchanged", color: rgb(REST), objects: rest }]);
}

/** Returns a class with its confidence, such as `cup 0.93`, or who decided. */
export function claimText(claim: ClassClaim | null): string {
  if (claim === null) return "";
  const label = claim.label === "" ? "no class" : claim.label;
  if (claim.is_decided) return `${label} (decided)`;
  return claim.confidence === null ? label : `${label} ${claim.confidence.toFixed(2)}`;
}

/** Returns what changed, in words, one text for each kind. */
export function changeTexts(change: SceneChange, nameOf: (object: number) => string): string[] {
  return change.kinds.map((kind) => changeText(kind, change, nameOf));
}

function changeText(kind: ChangeKind, change: SceneChange, nameOf: (object: number) => string): string {
  switch (kind) {
    case "appeared":
      return `new: ${claimText(change.after)}`;
    case "disappeared":
      return `gone: ${claimText(change.before)}`;
    case "class":
      return `${claimText(change.before)} → ${claimText(change.after)}`;
    case "moved": {
      const carrier = change.carried_by < 0 ? "" : ` with ${nameOf(change.carried_by)}`;
      return `moved ${(change.distance_m ?? 0).toFixed(2)} m${carrier}`;
    }
    case "turned":
      return `turned ${change.turned_degrees.toFixed(0)}°`;
    case "resized":
      return change.sizes === null ? "resized" : `${change.sizes.map(sizeText).join(" → ")} m`;
    case "renamed":
      return `was ${change.path_before} (${change.reason})`;
    case "mass":
      return `mass ${(change.masses ?? []).map((mass) => (mass === null ? "unknown" : `${mass} kg`)).join(" → ")}`;
    case "asset":
      return "comes from another asset";
    case "relations":
      return [
        ...change.gained.map((link) => `now ${linkText(link)}`),
        ...change.lost.map((link) => `no longer ${linkText(link)}`),
      ].join(", ");
  }
}

function sizeText(size: readonly number[]): string {
  return size.map((side) => side.toFixed(2)).join(" × ");
}

function linkText({ kind, anchor }: { kind: string; anchor: string }): string {
  return `${kind.replace("-", " ")} ${anchor.slice(anchor.lastIndexOf("/") + 1)}`;
}
