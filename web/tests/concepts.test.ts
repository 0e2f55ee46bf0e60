import { describe, expect, it, vi } from "vitest";
import { findBinding } from "../src/keys/bindings";
import { objectsOfConcept, offeredClasses, openConcept } from "../src/state/concepts";
import { makeStore, reply, VIEW as view } from "./fakeStore";
import { makeState, makeStates } from "./scene";

describe("concepts", () => {
  it("has open objects and decided ones", () => {
    const { states } = makeStates();
    expect(objectsOfConcept(states, 0)).toEqual({ open: [1, 2], decided: 0 });
    const decided = states.map((state) => (state.object === 1 ? makeState(1, { state: "corrected" }) : state));
    expect(objectsOfConcept(decided, 0)).toEqual({ open: [2], decided: 1 });
  });

  it("is decided with one request", async () => {
    const sent: unknown[] = [];
    const store = makeStore(async <T>(_: string, body: unknown) => {
      sent.push(body);
      return reply([2, 1], { state: "corrected", class: 3 }) as T;
    });
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    findBinding("E")?.run(store, view, "E");
    expect(store.isConceptOpen.value).toBe(true);
    await vi.waitFor(() => expect(offeredClasses(store)).toEqual([1, 3]));
    await store.decide([1, 2], "choose", 3, { concept: 0 });
    expect(sent).toMatchObject([{ objects: [1, 2], action: "choose", class: 3, concept: 0 }]);
    expect(store.notices.value.at(-1)?.text).toBe("Every “cup” is vessel: set 2 objects");
    expect(store.groupId.value).toBe("/K/wall");
  });

  it("says why there is nothing to decide", () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    store.select([0]);
    openConcept(store);
    expect([store.isConceptOpen.value, store.notices.value.at(-1)?.text]).toEqual([false, "The object has no concept"]);
  });
});
