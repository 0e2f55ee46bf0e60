import { describe, expect, it } from "vitest";
import { findBinding } from "../src/keys/bindings";
import { listProposals, proposedLabel } from "../src/state/proposals";
import { makeStore, reply, VIEW as view } from "./fakeStore";
import { makeState } from "./scene";

describe("proposed classes", () => {
  it("hold the objects of one label and superclass", () => {
    const states = [
      makeState(0),
      makeState(1, { proposal: "Mug", class: 1 }),
      makeState(2, { proposal: "mug", class: 1 }),
      makeState(3, { proposal: "Mug", class: 3 }),
    ];
    expect(listProposals(states)).toEqual([
      { label: "Mug", parent: 1, objects: 2 },
      { label: "Mug", parent: 3, objects: 1 },
    ]);
  });

  it("are made with the concept's label, for the ticked members", async () => {
    const sent: unknown[] = [];
    const store = makeStore(async <T>(_: string, body: unknown) => {
      sent.push(body);
      return reply([2, 1], { state: "confirmed", class: 1, proposal: "mug" }) as T;
    });
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    expect(proposedLabel(store)).toBe("cup");
    findBinding("M")?.run(store, view, "M");
    expect(store.isProposalOpen.value).toBe(true);
    await store.decide(store.targets.value, "choose", 1, { proposal: "mug", comment: "has a handle" });
    expect(sent).toMatchObject([{ objects: [2, 1], class: 1, proposal: "mug", comment: "has a handle" }]);
    expect(store.notices.value.at(-1)?.text).toBe("Proposed “mug” below cup for 2 objects");
    expect(store.states.value[1]?.proposal).toBe("mug");
  });

  it("need objects", () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    findBinding("M")?.run(store, view, "M");
    expect(store.isProposalOpen.value).toBe(false);
  });
});
