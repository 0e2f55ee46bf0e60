import { describe, expect, it, vi } from "vitest";
import type { Client } from "../src/api/client";
import type { Comparison, SceneChange } from "../src/api/comparison";
import {
  CHANGES,
  changeTexts,
  claimText,
  colorChanges,
  comparisonOf,
  startWithComparison,
} from "../src/state/comparison";
import { NO_FILTERS } from "../src/state/filters";
import { Store } from "../src/state/store";
import { ghostEdges } from "../src/viewer/ghosts";
import { makeNames } from "./fakeStore";
import { makeScene, makeStates } from "./scene";

function makeChange(given: Partial<SceneChange>): SceneChange {
  return {
    kinds: ["moved"],
    object: 1,
    path: "/K/Table/Cup_1",
    path_before: "/K/Table/Cup_1",
    name: "Cup_1",
    before: null,
    after: null,
    box_before: [0, 0, 0, 1, 1, 1],
    turned_before: null,
    distance_m: null,
    carried_by: -1,
    turned_degrees: 0,
    sizes: null,
    masses: null,
    gained: [],
    lost: [],
    reason: "",
    ...given,
  };
}

const cup = { class: 1, label: "cup", confidence: 0.934, is_decided: false };
const plate = { class: -1, label: "plate", confidence: null, is_decided: true };
const GONE = makeChange({ kinds: ["disappeared"], object: -1, path: "/K/Jug", name: "Jug", before: cup });
const MOVED = makeChange({ kinds: ["class", "moved"], distance_m: 0.3, carried_by: 0, before: cup, after: plate });
const RENAMED = makeChange({
  kinds: ["renamed"],
  object: 2,
  path: "/K/Table/Cup_2",
  path_before: "/K/C",
  reason: "same size",
});

function makeStore(): Store {
  const comparison: Comparison = {
    other: "old/kitchen.ttl",
    source: "graph",
    version: 0,
    counts: { disappeared: 1, class: 1, moved: 1, renamed: 1 },
    unchanged: 2,
    notes: [],
    changes: [GONE, MOVED, RENAMED],
  };
  const client: Client = {
    get: async <T>() => structuredClone(comparison) as T,
    post: async () => ({}) as never,
    blob: async () => new Blob(),
    stream: async () => new ReadableStream(),
  };
  return new Store(client, { ...makeScene(), has_comparison: true }, makeStates(), makeNames());
}

async function loaded(store: Store) {
  const state = comparisonOf(store);
  await vi.waitFor(() => expect(state.data.value).not.toBeNull());
  return state;
}

describe("a comparison", () => {
  it("is shown when the page starts, and only if there is one", () => {
    const store = makeStore();
    startWithComparison(store);
    expect([store.drawer.value, store.colorMode.value]).toEqual(["compare", "change"]);
    const other = new Store(store.client, makeScene(), makeStates(), makeNames());
    startWithComparison(other);
    expect([other.drawer.value, other.colorMode.value]).toEqual(["review", "material"]);
  });

  it("leaves a scene without colours of its own coloured by class", () => {
    const { client } = makeStore();
    const plain = new Store(client, { ...makeScene(), has_colors: false }, makeStates(), makeNames());
    startWithComparison(plain);
    expect(plain.colorMode.value).toBe("class");
  });

  it("is filtered by kind: a change stays while one of its kinds is shown", async () => {
    const state = await loaded(makeStore());
    const paths = () => state.rows.value.map((change) => change.path);
    expect(paths()).toEqual(["/K/Jug", "/K/Table/Cup_1", "/K/Table/Cup_2"]);
    state.toggle("class");
    expect(paths()).toHaveLength(3);
    state.toggle("moved");
    expect(paths()).toEqual(["/K/Jug", "/K/Table/Cup_2"]);
    state.only("class");
    expect(paths()).toEqual(["/K/Table/Cup_1"]);
    state.only("class");
    expect(paths()).toHaveLength(3);
  });

  it("follows the filter of the page", async () => {
    const store = makeStore();
    const state = await loaded(store);
    store.filters.value = { ...NO_FILTERS, text: "cup_2" };
    expect(state.rows.value.map((change) => change.object)).toEqual([2]);
  });

  it("shows what disappeared as ghosts, and the old place of a selected object", async () => {
    const store = makeStore();
    const state = await loaded(store);
    expect(state.ghosts.value).toEqual([]);
    store.colorMode.value = "change";
    expect(state.ghosts.value).toHaveLength(1);
    const [gone, moved, renamed] = state.changes.value;
    state.look(moved as SceneChange);
    expect(store.selection.value).toEqual([1]);
    expect(store.lookAt.value).toEqual([1]);
    expect(state.ghosts.value).toHaveLength(2);
    expect(state.focusedGhost.value).toBeNull();
    // A renamed object is where it was.
    state.look(renamed as SceneChange);
    expect(state.ghosts.value).toHaveLength(1);
    state.look(gone as SceneChange);
    expect(store.selection.value).toEqual([]);
    expect(state.focusedGhost.value?.box).toEqual([0, 0, 0, 1, 1, 1]);
    state.toggle("disappeared");
    expect(state.focusedGhost.value).toBeNull();
  });

  it("keeps what is looked at when it is loaded again", async () => {
    const state = await loaded(makeStore());
    state.look(state.changes.value[1] as SceneChange);
    await state.load();
    expect(state.focused.value).toBe(state.changes.value[1]);
  });

  it("colours each object by its first kind and counts what is gone", () => {
    const { colors, legend } = colorChanges(4, [GONE, MOVED, RENAMED]);
    const colorOf = (kind: string) => CHANGES.find((each) => each.kind === kind)?.color;
    expect(colors[1]).toBe(colorOf("class"));
    expect(colors[2]).toBe(colorOf("renamed"));
    expect(legend.map(({ label, objects, count }) => [label, objects, count])).toEqual([
      ["Disappeared", [], 1],
      ["Other class", [1], 1],
      ["Renamed", [2], 1],
      ["Unchanged", [0, 3], undefined],
    ]);
  });
});

describe("texts", () => {
  it("say what changed", () => {
    const names = ["Table", "Cup_1"];
    expect(changeTexts(MOVED, (object) => names[object] ?? "")).toEqual([
      "cup 0.93 → plate (decided)",
      "moved 0.30 m with Table",
    ]);
    expect(changeTexts(GONE, () => "")).toEqual(["gone: cup 0.93"]);
    expect(changeTexts(RENAMED, () => "")).toEqual(["was /K/C (same size)"]);
    const links = { gained: [{ kind: "part-of", anchor: "/K/Table" }], lost: [{ kind: "on", anchor: "/K/wall" }] };
    expect(changeTexts(makeChange({ kinds: ["relations"], ...links }), () => "")).toEqual([
      "now part of Table, no longer on wall",
    ]);
    expect(claimText({ class: -1, label: "", confidence: null, is_decided: true })).toBe("no class (decided)");
  });
});

describe("a ghost", () => {
  it("stands along the object's own axes", () => {
    const half = Math.SQRT1_2;
    const edges = ghostEdges({ box: [-0.1, -1, 0, 0.1, 1, 0.1], turned: [0, 0, half, half, 2, 0.2, 0.1] });
    expect(edges).toHaveLength(24);
    expect(Math.max(...edges.map((corner) => corner.y))).toBeCloseTo(1);
    expect(Math.max(...edges.map((corner) => corner.x))).toBeCloseTo(0.1);
  });
});
