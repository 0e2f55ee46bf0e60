import { describe, expect, it, vi } from "vitest";
import type { RelationList } from "../src/api/types";
import { Store } from "../src/state/store";
import { followSupports } from "../src/state/supports";
import { makeNames, makeStore } from "./fakeStore";
import { makeScene, makeStates } from "./scene";

function setUp() {
  const asked: string[] = [];
  const answers: (() => void)[] = [];
  const get = <T>(path: string) => {
    asked.push(path);
    const anchor = path.endsWith("version=3") ? 3 : 0;
    const on = [{ kind: "on", target: 1, anchor, anchor_path: "", numbers: {}, confidence: null, rule: "" }];
    const list: RelationList = { relations: path.includes("kind=on") ? on : [] };
    return new Promise<T>((resolve) => answers.push(() => resolve(list as T)));
  };
  const client = { ...makeStore(vi.fn()).client, get };
  const store = new Store(client, makeScene(), makeStates(), makeNames());
  return { store, asked, answers };
}

describe("what objects stand on", () => {
  it("is fetched only while the colours show it", () => {
    const { store, asked } = setUp();
    followSupports(store);
    store.server.version.value = 1;
    expect(asked).toEqual([]);
    store.colorMode.value = "support";
    expect(asked).toEqual(["relations?kind=on&version=1", "relations?kind=inside&version=1"]);
  });

  it("is asked again for the last of the decisions that were made in the meantime", async () => {
    const { store, asked, answers } = setUp();
    const { supports } = followSupports(store);
    store.colorMode.value = "support";
    store.server.version.value = 1;
    store.server.version.value = 2;
    store.server.version.value = 3;
    expect(asked).toHaveLength(2);
    for (const answer of answers.splice(0)) answer();
    await vi.waitFor(() => expect(supports.value.get(1)).toBe(0));
    await vi.waitFor(() => expect(asked).toHaveLength(4));
    expect(asked.slice(2)).toEqual(["relations?kind=on&version=3", "relations?kind=inside&version=3"]);
    for (const answer of answers.splice(0)) answer();
    await vi.waitFor(() => expect(supports.value.get(1)).toBe(3));
    expect(asked).toHaveLength(4);
  });
});
