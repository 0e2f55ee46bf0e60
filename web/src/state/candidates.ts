/** The pages of objects, loaded when they are needed, and the candidates of the object under review. */

import { effect, type Signal, signal } from "@preact/signals";
import type { Candidate, CandidateEvidence, ObjectIndex, ObjectPage } from "../api/types";
import type { Store } from "./store";

const pages = new WeakMap<Store, Signal<ObjectPage | null>>();

/** Returns the object whose page is shown: the last selected one, else the focused member of the group. */
export function focusOf(store: Store): ObjectIndex {
  const { selection, group, member, isGroupInFocus } = store;
  const found = isGroupInFocus.value ? group.value?.objects[member.value] : selection.value.at(-1);
  return found ?? -1;
}

/** Returns the page of the focused object; it follows the focus, the decisions and the graph that is written. */
export function pageOf(store: Store): Signal<ObjectPage | null> {
  const known = pages.get(store);
  if (known !== undefined) return known;
  const page = signal<ObjectPage | null>(null);
  pages.set(store, page);
  effect(() => {
    const object = focusOf(store);
    // A decision changes the history on the page, the graph its statements and relations.
    void store.server.version.value;
    void store.server.written.value;
    void store.server.connections.value;
    if (object < 0) {
      page.value = null;
      return;
    }
    store.client.get<ObjectPage>(`object/${object}`).then(
      (found) => {
        if (focusOf(store) === object) page.value = found;
      },
      (error: unknown) => store.reportLoading(error),
    );
  });
  return page;
}

/** Returns the candidates of the focused object, those with a class only; undefined until they are loaded. */
export function candidatesOf(store: Store): Candidate[] | undefined {
  const page = pageOf(store).value;
  return page?.object === focusOf(store) ? withClass(page) : undefined;
}

/** Returns the candidates of the focused object; loads them if the reviewer is faster than the page. */
export async function loadCandidates(store: Store): Promise<Candidate[]> {
  const known = candidatesOf(store);
  return known ?? withClass(await store.client.get<ObjectPage>(`object/${focusOf(store)}`));
}

function withClass(page: ObjectPage): Candidate[] {
  return page.candidates.filter(({ class: index }) => index >= 0);
}

/** Returns a source of evidence with its weight: `name 97 %`, `size ×38`, or `place ÷1.2` for what speaks against. */
export function evidenceText({ group, score, likelihood_ratio: ratio }: CandidateEvidence): string {
  if (score !== null) return `${group} ${Math.round(100 * score)} %`;
  if (ratio === null) return group;
  const times = ratio >= 1 ? ratio : 1 / ratio;
  const number = times >= 1000 ? "1000+" : times >= 10 ? times.toFixed(0) : times.toFixed(1);
  return number === "1.0" ? `${group} ×1` : `${group} ${ratio >= 1 ? "×" : "÷"}${number}`;
}
