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
  let request = 0;
  const stop = effect(() => {
    // Decisions change what may hold and bear something.
    const version = store.version.value;
    if (store.colorMode.value !== "support") return;
    const own = ++request;
    fetchSupports(store, version)
      .then((found) => {
        if (own === request) supports.value = found;
      })
      .catch((error: unknown) => store.report(error));
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
