import { describe, expect, it } from "vitest";
import type { Client } from "../src/api/client";
import { openScene } from "../src/api/opening";
import { storedReviewer, storeReviewer } from "../src/state/reviewer";
import { Store } from "../src/state/store";
import { makeNames, makeStorage } from "./fakeStore";
import { makeScene, makeStates } from "./scene";

function recording(): { client: Client; paths: string[] } {
  const paths: string[] = [];
  const get = async <T>(path: string) => {
    paths.push(path);
    return { path } as T;
  };
  return { client: { get } as unknown as Client, paths };
}

describe("the first requests", () => {
  const storage = makeNames();

  it("ask for the states of the reviewer whom the server suggests, if the browser knows none", async () => {
    const { client, paths } = recording();
    const { scene, states } = openScene("key", storage, client);
    expect([await scene, await states]).toEqual([{ path: "scene" }, { path: "states" }]);
    expect(paths).toEqual(["scene", "states"]);
  });

  it("ask for the states of the reviewer who has typed a name, so that undo is of the own decisions", async () => {
    storeReviewer("Ann & Bob", storage);
    const { client, paths } = recording();
    openScene("key", storage, client);
    expect(paths).toEqual(["scene", "states?reviewer=Ann%20%26%20Bob"]);
  });

  it("ask for the reviewer of this tab, whatever is typed in another one", () => {
    const browser = makeStorage();
    const newTab = () => ({ tab: makeStorage(), browser });
    const [one, other] = [newTab(), newTab()];
    storeReviewer("Ann", one);
    storeReviewer("Bob", other);
    const fresh = newTab();
    expect([storedReviewer(one), storedReviewer(fresh)]).toEqual(["Ann", "Bob"]);
    // A tab that has begun with a name, typed elsewhere or suggested by the server, keeps it too.
    const store = new Store(recording().client, makeScene(), makeStates(), fresh);
    storeReviewer("Cleo", one);
    expect([store.reviewer.value, storedReviewer(fresh)]).toEqual(["Bob", "Bob"]);
  });
});
