import { describe, expect, it } from "vitest";
import type { Client } from "../src/api/client";
import { openScene } from "../src/api/opening";
import { storeReviewer } from "../src/state/reviewer";

function recording(): { client: Client; paths: string[] } {
  const paths: string[] = [];
  const get = async <T>(path: string) => {
    paths.push(path);
    return { path } as T;
  };
  return { client: { get } as unknown as Client, paths };
}

describe("the first requests", () => {
  const kept = new Map<string, string>();
  const storage = {
    getItem: (name: string) => kept.get(name) ?? null,
    setItem: (name: string, value: string) => void kept.set(name, value),
  };

  it("ask for the states of the reviewer whom the server suggests, if this browser knows none", async () => {
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
});
