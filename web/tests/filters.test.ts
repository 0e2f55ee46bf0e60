import { describe, expect, it } from "vitest";
import { byGroup, colorObjects, rgb } from "../src/state/colors";
import { countBy, type Filters, filterObjects, isFiltering, NO_FILTERS } from "../src/state/filters";
import { buildModel } from "../src/state/model";
import { CATEGORIES, REST } from "../src/state/palette";
import { makeScene, makeState, makeStates } from "./scene";

const model = buildModel(makeScene());
const { states } = makeStates();
const filtered = (change: Partial<Filters>) => filterObjects(model, states, { ...NO_FILTERS, ...change });

describe("filters", () => {
  it("lets all pass", () => {
    expect(filtered({})).toEqual([0, 1, 2, 3]);
    expect(isFiltering(NO_FILTERS)).toBe(false);
  });

  it("counts subclasses to a class", () => {
    expect(filtered({ class: 0 })).toEqual([0, 1, 2, 3]);
    expect(filtered({ class: 3 })).toEqual([1, 2]);
  });

  it("finds all words in path, class or concept, in any order", () => {
    expect(filtered({ text: "cup_2" })).toEqual([2]);
    expect(filtered({ text: "TABLE cup" })).toEqual([1, 2]);
    expect(filtered({ text: "artifact" })).toEqual([3]);
    expect(filtered({ text: "cup zebra" })).toEqual([]);
  });

  it("takes an unknown confidence for zero", () => {
    expect(filtered({ confidence: [0.5, 1] })).toEqual([0, 1]);
    expect(filtered({ confidence: [0, 0.5] })).toEqual([2, 3]);
  });

  it("combines facets", () => {
    expect(filtered({ concept: 0, room: 0, states: new Set(["suggested"]), confidence: [0.5, 1] })).toEqual([1]);
    expect(filtered({ states: new Set(["confirmed"]) })).toEqual([]);
  });

  it("counts values, the most frequent first", () => {
    expect(countBy(states, (state) => state.class)).toEqual([
      [1, 2],
      [2, 1],
      [0, 1],
    ]);
  });
});

describe("colours", () => {
  it("keeps the materials", () => {
    expect(colorObjects("material", model, states, new Set())).toEqual({
      colors: [null, null, null, null],
      legend: [],
    });
  });

  it("explains each colour", () => {
    for (const mode of ["class", "concept", "confidence", "state", "room", "support", "answer"] as const) {
      const { colors, legend } = colorObjects(mode, model, states, new Set([1]));
      expect(legend.reduce((total, entry) => total + entry.objects.length, 0)).toBe(4);
      for (const { color, objects } of legend) for (const object of objects) expect(colors[object]).toEqual(color);
    }
  });

  it("colours objects by what they stand on", () => {
    const { colors, legend } = colorObjects(
      "support",
      model,
      states,
      new Set(),
      new Map([
        [1, 0],
        [2, 0],
      ]),
    );
    expect(legend.map((entry) => [entry.label, entry.objects])).toEqual([
      ["not on or in anything", [0, 3]],
      ["Table", [1, 2]],
    ]);
    expect(colors).toEqual([rgb(REST), rgb(CATEGORIES[0]), rgb(CATEGORIES[0]), rgb(REST)]);
  });

  it("separates a confidence that is not given from a low one", () => {
    const { legend } = colorObjects("confidence", model, states, new Set());
    expect(legend.map((entry) => [entry.label, entry.objects])).toEqual([
      ["0.95 to 1", [0]],
      ["0.80 to 0.95", [1]],
      ["0.20 to 0.50", [2]],
      ["not given", [3]],
    ]);
  });

  it("ranks classes by the suggestions, so that a correction moves no colour", () => {
    const before = colorObjects("class", model, states, new Set()).colors;
    // Both cups become tables, which are now more than the cups were.
    const corrected = states.map((state) => (state.object === 3 ? state : { ...state, class: 2 }));
    const after = colorObjects("class", model, corrected, new Set()).colors;
    expect(after[1]).toEqual(before[0]);
    expect(after[0]).toEqual(before[0]);
    expect(before[1]).toEqual(rgb(CATEGORIES[0]));
  });

  it("gives the largest groups a colour each, and the rest one that nothing else has", () => {
    const many = [...Array(60).keys()].map((object) => makeState(object, { class: object, suggested: object }));
    const { colors } = byGroup(
      many,
      (state) => state.class,
      (key) => `${key}`,
    );
    expect(new Set(colors.map(String)).size).toBe(CATEGORIES.length + 1);
    expect(colors.at(-1)).toEqual(rgb(REST));
  });
});
