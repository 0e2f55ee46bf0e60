/** A store on the small scene, whose server answers as the test says. */

import type { Client } from "../src/api/client";
import type { DecisionReply, ObjectPage, Queue } from "../src/api/types";
import type { ViewCommands } from "../src/keys/bindings";
import type { NameStorage } from "../src/state/reviewer";
import { Store } from "../src/state/store";
import { makeScene, makeState, makeStates } from "./scene";

const ignore = () => undefined;
export const VIEW: ViewCommands = { frame: ignore, frameAll: ignore, look: ignore, steer: ignore };

export const QUEUE: Queue = {
  groups: [
    {
      id: "/K/Table/Cup_1",
      title: "cup",
      objects: [2, 1],
      suggested: 1,
      concept: 0,
      confidence: 0.65,
      gain: 0.7,
      is_disputed: false,
      second: -1,
    },
    {
      id: "/K/wall",
      title: "wall",
      objects: [3],
      suggested: 0,
      concept: -1,
      confidence: null,
      gain: 1,
      is_disputed: false,
      second: -1,
    },
  ],
  open: 4,
  decided: 0,
  agreement: [],
  audit: {
    population: 4,
    sample: 4,
    waiting: 4,
    unsure: 0,
    judged: 0,
    right: 0,
    interval: null,
    calibration_error: null,
    calibrated_on: 0,
    with_confidence: 0,
    bins: [],
  },
  seconds_left: null,
};

export function makeStore(post: Client["post"]): Store {
  const page = {
    object: 2,
    candidates: [
      { class: 1, share: 0.6, taxonomy: [], evidence: [] },
      { class: 3, share: 0.4, taxonomy: [], evidence: [] },
    ],
  };
  const client: Client = {
    get: async <T>(path: string) => (path.startsWith("queue") ? QUEUE : { ...(page as Partial<ObjectPage>) }) as T,
    post,
    blob: async () => new Blob(),
    stream: async () => new ReadableStream(),
  };
  return new Store(client, makeScene(), makeStates(), makeNames());
}

/** A storage in memory. */
export function makeStorage(): Pick<Storage, "getItem" | "setItem"> {
  const kept = new Map<string, string>();
  return { getItem: (name) => kept.get(name) ?? null, setItem: (name, value) => void kept.set(name, value) };
}

/** The names that a new tab of a new browser knows. */
export function makeNames(): NameStorage {
  return { tab: makeStorage(), browser: makeStorage() };
}

export function reply(objects: number[], state: Partial<ReturnType<typeof makeState>>): DecisionReply {
  return {
    version: 1,
    states: objects.map((object) => makeState(object, state)),
    can_undo: true,
    can_redo: false,
    outputs: { folder: "", problem: "" },
    message: "",
  };
}
