/** The first requests of the page. */

import { storedReviewer } from "../state/reviewer";
import type { Client } from "./client";
import type { SceneData, States } from "./types";

/** Returns the scene, and the states as this browser's reviewer sees them. */
export function requestScene(client: Client, storage: Pick<Storage, "getItem">): Promise<[SceneData, States]> {
  const reviewer = storedReviewer(storage);
  const states = reviewer === null ? "states" : `states?reviewer=${encodeURIComponent(reviewer)}`;
  return Promise.all([client.get<SceneData>("scene"), client.get<States>(states)]);
}
