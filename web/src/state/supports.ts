/** What each object stands on or is in, fetched while the picture shows it. */

import { effect, type ReadonlySignal, signal } from "@preact/signals";
import type { ObjectIndex, RelationList } from "../api/types";
import type { Store } from "./store";

export type Supports = ReadonlyMap<ObjectIndex, ObjectIndex>;

/** Later kinds win: what is in a box on a shelf is in the box. */
const KINDS = ["on", "inside"] as const;

/** Returns the support of each object; up to date while the colours show it. */
export function followSupports(store: Store): { supports: ReadonlySignal<Supports>; stop: () => void } {
  const supports = signal<Supports>(new Map());
  let wanted: number | null = null;
  let isFetching = false;
  // The server builds a graph for each answer: while it does, only the last of several decisions is asked about.
  const fetchWanted = async () => {
    if (isFetching) return;
    isFetching = true;
    try {
      while (wanted !== null) {
        const version: number = wanted;
        wanted = null;
        supports.value = await fetchSupports(store, version);
      }
    } catch (error) {
      store.report(error);
    } finally {
      isFetching = false;
    }
  };
  const stop = effect(() => {
    // Decisions change what may hold and bear something.
    const version = store.server.version.value;
    if (store.colorMode.value !== "support") return;
    wanted = version;
    void fetchWanted();
  });
  return { supports, stop };
}

async function fetchSupports(store: Store, version: number): Promise<Supports> {
  const lists = await Promise.all(
    KINDS.map((kind) => store.client.get<RelationList>(`relations?kind=${kind}&version=${version}`)),
  );
  return new Map(
    lists.flatMap(({ relations }) =>
      relations.filter(({ target, anchor }) => target >= 0 && anchor >= 0).map((r) => [r.target, r.anchor] as const),
    ),
  );
}
