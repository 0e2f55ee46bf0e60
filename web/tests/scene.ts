/** A small scene for tests. */

import type { ObjectState, SceneData, States } from "../src/api/types";

export function makeScene(): SceneData {
  return {
    title: "kitchen.usda",
    source: "kitchen.usda",
    ontology: { iri: "https://x.org/onto", label: "onto" },
    grounder: "lexical",
    second_grounder: "",
    is_calibrated: true,
    is_graph: false,
    has_colors: true,
    has_comparison: false,
    limits: {},
    reviewer: "Ann",
    objects: {
      path: ["/K/Table", "/K/Table/Cup_1", "/K/Table/Cup_2", "/K/wall"],
      name: ["Table", "Cup_1", "Cup_2", "wall"],
      parent: [-1, 0, 0, -1],
      box: [
        [0, 0, 0, 1, 1, 0.7],
        [0.4, 0.4, 0.7, 0.5, 0.5, 0.8],
        [0.6, 0.4, 0.7, 0.7, 0.5, 0.8],
        [-2, -2, 0, 2, -1.9, 2.5],
      ],
      turned: [null, null, null, null],
      room: [0, 0, 0, -1],
      rooms: ["K"],
      asset: [0, 1, 1, 0],
      assets: ["", "cup"],
      color: [null, [1, 0, 0], null, null],
      is_outlier: [false, false, false, false],
      shell: ["", "", "", "wall"],
      mount: [-1, -1, -1, -1],
    },
    classes: [
      makeClass("Artifact", [], "Something made."),
      makeClass("Cup", [0, 3], "A vessel to drink from.", ["mug", "beaker"]),
      makeClass("Table", [0], "A slab on legs."),
      makeClass("Vessel", [0], "A hollow artifact that holds liquids, such as a cup."),
    ],
    concepts: [{ iri: "https://x.org/cup", label: "cup", broader: [] }],
    relation_kinds: [{ kind: "on", count: 2 }],
    diagnostics: [],
    figures: [],
  };
}

function makeClass(label: string, parents: number[], definition: string, synonyms: string[] = []) {
  return { iri: `https://x.org/${label}`, name: label, label: label.toLowerCase(), synonyms, definition, parents };
}

export function makeState(object: number, given: Partial<ObjectState> = {}): ObjectState {
  const suggested = [2, 1, 1, 0][object] ?? -1;
  return {
    object,
    state: "suggested",
    class: suggested,
    confidence: [0.99, 0.9, 0.4, null][object] ?? null,
    suggested,
    concept: object === 1 || object === 2 ? 0 : -1,
    reviewer: "",
    time: "",
    comment: "",
    proposal: "",
    is_conflict: false,
    ...given,
  };
}

export function makeStates(): States {
  return {
    version: 0,
    states: [0, 1, 2, 3].map((object) => makeState(object)),
    can_undo: false,
    can_redo: false,
    outputs: { folder: "k.studio", problem: "" },
  };
}
