/** Colours of objects by a property, and the legend that explains them. */

import type { ObjectIndex, ObjectState, ReviewState } from "../api/types";
import { classLabel, conceptLabel, roomLabel, type SceneModel } from "./model";
import { ANSWER, CATEGORIES, CONFIDENCE_BOUNDS, CONFIDENCE_COLORS, REST } from "./palette";
import type { Supports } from "./supports";

export type ColorMode =
  | "material"
  | "class"
  | "concept"
  | "confidence"
  | "state"
  | "room"
  | "support"
  | "answer"
  | "change";

export const COLOR_MODES: { id: ColorMode; label: string }[] = [
  { id: "material", label: "Material" },
  { id: "class", label: "Class" },
  { id: "concept", label: "Concept" },
  { id: "confidence", label: "Confidence" },
  { id: "state", label: "Review" },
  { id: "room", label: "Room" },
  { id: "support", label: "Support" },
  { id: "answer", label: "Answer" },
  { id: "change", label: "Change" },
];

/** sRGB, each from 0 to 1. */
export type Rgb = readonly [number, number, number];

export interface LegendEntry {
  label: string;
  color: Rgb;
  objects: ObjectIndex[];
  /** Number of objects, if some are no longer in the scene. */
  count?: number;
}

export interface Coloring {
  /** Colour of each object; null keeps the colours of its materials. */
  colors: (Rgb | null)[];
  legend: LegendEntry[];
}

/** Also in styles/states.css. */
const STATE_COLORS: Record<ReviewState, Rgb> = {
  suggested: [0.45, 0.61, 0.86],
  confirmed: [0.2, 0.66, 0.39],
  corrected: [0.1, 0.62, 0.65],
  unsure: [0.93, 0.66, 0.16],
  "no-class": [0.55, 0.42, 0.78],
  refused: [0.85, 0.49, 0.25],
  unreadable: [0.8, 0.36, 0.36],
  failed: [0.72, 0.18, 0.24],
};

export const STATE_LABELS: Record<ReviewState, string> = {
  suggested: "Suggested",
  confirmed: "Confirmed",
  corrected: "Corrected",
  unsure: "Unsure",
  "no-class": "No class fits",
  refused: "Refused",
  unreadable: "Unreadable",
  failed: "Failed call",
};

/** Returns the colours and the legend of a mode. */
export function colorObjects(
  mode: Exclude<ColorMode, "change">,
  model: SceneModel,
  states: readonly ObjectState[],
  answer: ReadonlySet<ObjectIndex>,
  supports: Supports = new Map(),
): Coloring {
  switch (mode) {
    case "material":
      return { colors: states.map(() => null), legend: [] };
    case "class":
      return byGroup(
        states,
        (state) => state.class,
        (key) => classLabel(model, key),
        // A correction changes the colour of one object, not of classes.
        (state) => state.suggested,
      );
    case "concept":
      return byGroup(
        states,
        (state) => state.concept,
        (key) => conceptLabel(model, key),
      );
    case "room":
      return byGroup(
        states,
        (state) => model.data.objects.room[state.object] ?? -1,
        (_, first) => roomLabel(model, first),
      );
    case "support":
      return byGroup(
        states,
        (state) => supports.get(state.object) ?? -1,
        (key) => (key < 0 ? "not on or in anything" : (model.shortNames[key] ?? "")),
      );
    case "confidence":
      return byStep(states);
    case "state":
      return byState(states);
    case "answer":
      return byAnswer(states, answer);
  }
}

/** Gives the largest groups, by `rank`, a colour each; the others share one, with the objects in no group. */
export function byGroup(
  states: readonly ObjectState[],
  key: (state: ObjectState) => number,
  label: (key: number, first: ObjectIndex) => string,
  rank: (state: ObjectState) => number = key,
): Coloring {
  const groups = new Map<number, ObjectIndex[]>();
  const sizes = new Map<number, number>();
  for (const state of states) {
    const found = groups.get(key(state));
    if (found === undefined) groups.set(key(state), [state.object]);
    else found.push(state.object);
    sizes.set(rank(state), (sizes.get(rank(state)) ?? 0) + 1);
  }
  const ranked = [...new Set([...groups.keys(), ...sizes.keys()])]
    .filter((group) => group >= 0)
    .sort((a, b) => (sizes.get(b) ?? 0) - (sizes.get(a) ?? 0) || a - b);
  const colors = new Map(ranked.map((group, place) => [group, rgb(CATEGORIES[place] ?? REST)]));
  const legend = [...groups]
    .sort((a, b) => b[1].length - a[1].length || a[0] - b[0])
    .map(([group, objects]) => ({
      label: label(group, objects[0] ?? -1),
      color: colors.get(group) ?? rgb(REST),
      objects,
    }));
  return fill(states.length, legend);
}

function byStep(states: readonly ObjectState[]): Coloring {
  const bounds: readonly number[] = CONFIDENCE_BOUNDS;
  const legend = bounds.map((from, step) => ({
    label: stepLabel(from, bounds[step - 1] ?? 1),
    color: rgb(CONFIDENCE_COLORS[step] ?? REST),
    objects: [] as ObjectIndex[],
  }));
  const unknown: LegendEntry = { label: "not given", color: rgb(REST), objects: [] };
  for (const state of states) {
    const { confidence } = state;
    const step = confidence === null ? -1 : bounds.findIndex((from) => confidence >= from);
    (legend[step] ?? unknown).objects.push(state.object);
  }
  return fill(
    states.length,
    [...legend, unknown].filter((entry) => entry.objects.length > 0),
  );
}

function stepLabel(from: number, to: number): string {
  if (from === 0) return `below ${to.toFixed(2)}`;
  return `${from.toFixed(2)} to ${to === 1 ? "1" : to.toFixed(2)}`;
}

function byState(states: readonly ObjectState[]): Coloring {
  const legend = (Object.keys(STATE_COLORS) as ReviewState[]).map((kind) => ({
    label: STATE_LABELS[kind],
    color: STATE_COLORS[kind],
    objects: states.filter((state) => state.state === kind).map((state) => state.object),
  }));
  return fill(
    states.length,
    legend.filter((entry) => entry.objects.length > 0),
  );
}

function byAnswer(states: readonly ObjectState[], answer: ReadonlySet<ObjectIndex>): Coloring {
  const rest = states.map((state) => state.object).filter((object) => !answer.has(object));
  return fill(states.length, [
    { label: "in the answer", color: rgb(ANSWER), objects: [...answer] },
    { label: "other", color: rgb(REST), objects: rest },
  ]);
}

export function fill(count: number, legend: LegendEntry[]): Coloring {
  const colors: (Rgb | null)[] = new Array(count).fill(null);
  for (const { color, objects } of legend) for (const object of objects) colors[object] = color;
  return { colors, legend };
}

/** Returns the parts of `#rrggbb`. */
export function rgb(color: string): Rgb {
  const part = (at: number) => Number.parseInt(color.slice(at, at + 2), 16) / 255;
  return [part(1), part(3), part(5)];
}

export function cssColor([red, green, blue]: Rgb): string {
  return `rgb(${Math.round(255 * red)} ${Math.round(255 * green)} ${Math.round(255 * blue)})`;
}
