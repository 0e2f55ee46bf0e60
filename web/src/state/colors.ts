/** Colours of objects by a property, and the legend that explains them. */

import type { ObjectIndex, ObjectState, ReviewState } from "../api/types";
import { classLabel, conceptLabel, roomLabel, type SceneModel } from "./model";

export type ColorMode = "material" | "class" | "concept" | "confidence" | "state" | "room" | "answer" | "change";

export const COLOR_MODES: { id: ColorMode; label: string }[] = [
  { id: "material", label: "Material" },
  { id: "class", label: "Class" },
  { id: "concept", label: "Concept" },
  { id: "confidence", label: "Confidence" },
  { id: "state", label: "Review" },
  { id: "room", label: "Room" },
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

export const GREY: Rgb = [0.62, 0.64, 0.67];
const ANSWER: Rgb = [0.96, 0.62, 0.11];

/** Also in styles/states.css. */
export const STATE_COLORS: Record<ReviewState, Rgb> = {
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

const CONFIDENCE_STEPS: { from: number; label: string; color: Rgb }[] = [
  { from: 0.95, label: "0.95 to 1", color: [0.13, 0.56, 0.55] },
  { from: 0.8, label: "0.80 to 0.95", color: [0.37, 0.78, 0.38] },
  { from: 0.5, label: "0.50 to 0.80", color: [0.99, 0.78, 0.14] },
  { from: 0.2, label: "0.20 to 0.50", color: [0.95, 0.5, 0.2] },
  { from: 0, label: "below 0.20", color: [0.82, 0.18, 0.24] },
];

/** Returns the colours and the legend of a mode. */
export function colorObjects(
  mode: Exclude<ColorMode, "change">,
  model: SceneModel,
  states: readonly ObjectState[],
  answer: ReadonlySet<ObjectIndex>,
): Coloring {
  switch (mode) {
    case "material":
      return { colors: states.map(() => null), legend: [] };
    case "class":
      return byGroup(
        states,
        (state) => state.class,
        (key) => classLabel(model, key),
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
    case "confidence":
      return byStep(states);
    case "state":
      return byState(states);
    case "answer":
      return byAnswer(states, answer);
  }
}

function byGroup(
  states: readonly ObjectState[],
  key: (state: ObjectState) => number,
  label: (key: number, first: ObjectIndex) => string,
): Coloring {
  const groups = new Map<number, ObjectIndex[]>();
  for (const state of states) {
    const found = groups.get(key(state));
    if (found === undefined) groups.set(key(state), [state.object]);
    else found.push(state.object);
  }
  const legend = [...groups]
    .sort((a, b) => b[1].length - a[1].length || a[0] - b[0])
    .map(([group, objects]) => ({
      label: label(group, objects[0] ?? -1),
      color: group < 0 ? GREY : categoryColor(group),
      objects,
    }));
  return fill(states.length, legend);
}

function byStep(states: readonly ObjectState[]): Coloring {
  const legend = CONFIDENCE_STEPS.map(({ label, color }) => ({ label, color, objects: [] as ObjectIndex[] }));
  const unknown: LegendEntry = { label: "not given", color: GREY, objects: [] };
  for (const state of states) {
    const { confidence } = state;
    const step = confidence === null ? -1 : CONFIDENCE_STEPS.findIndex(({ from }) => confidence >= from);
    (legend[step] ?? unknown).objects.push(state.object);
  }
  return fill(
    states.length,
    [...legend, unknown].filter((entry) => entry.objects.length > 0),
  );
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
    { label: "in the answer", color: ANSWER, objects: [...answer] },
    { label: "other", color: GREY, objects: rest },
  ]);
}

export function fill(count: number, legend: LegendEntry[]): Coloring {
  const colors: (Rgb | null)[] = new Array(count).fill(null);
  for (const { color, objects } of legend) for (const object of objects) colors[object] = color;
  return { colors, legend };
}

/** Returns the colour of a category: hues a golden angle apart in OKLCH, so that neighbours in a list differ. */
export function categoryColor(index: number): Rgb {
  const hue = (index * 137.508 + 25) % 360;
  const lightness = [0.7, 0.6, 0.78][index % 3] ?? 0.7;
  return oklch(lightness, 0.13, hue);
}

/** Returns sRGB of an OKLCH colour (https://bottosson.github.io/posts/oklab), clipped to the gamut. */
export function oklch(lightness: number, chroma: number, hue: number): Rgb {
  const a = chroma * Math.cos((hue * Math.PI) / 180);
  const b = chroma * Math.sin((hue * Math.PI) / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    encode(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

function encode(linear: number): number {
  const value = Math.min(Math.max(linear, 0), 1);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
}

export function cssColor([red, green, blue]: Rgb): string {
  return `rgb(${Math.round(255 * red)} ${Math.round(255 * green)} ${Math.round(255 * blue)})`;
}
