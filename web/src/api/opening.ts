/** The first requests of the page. */

import { type NameStorage, storedReviewer } from "../state/reviewer";
import { type Client, createClient } from "./client";
import type { SceneData, States } from "./types";

/** What is on its way while the page is loading. */
export interface Opening {
  client: Client;
  scene: Promise<SceneData>;
  /** As this tab's reviewer sees them. */
  states: Promise<States>;
}

/** Asks for the scene and the states. */
export function openScene(key: string, storage: NameStorage, client: Client = createClient(key)): Opening {
  const reviewer = storedReviewer(storage);
  const path = reviewer === null ? "states" : `states?reviewer=${encodeURIComponent(reviewer)}`;
  const opening = { client, scene: client.get<SceneData>("scene"), states: client.get<States>(path) };
  // Whoever awaits them reports the error; nobody may await them yet.
  opening.scene.catch(() => {});
  opening.states.catch(() => {});
  return opening;
}
