import { Vector3 } from "three";
import { describe, expect, it, vi } from "vitest";
import { ApiFailure } from "../src/api/client";
import { BINDINGS, findBinding, keyName } from "../src/keys/bindings";
import { evidenceText, focusOf } from "../src/state/candidates";
import { findAgain, groupAfter, withoutObjects } from "../src/state/queue";
import { applyStates, durationText, isOpen, predictStates, reasonsForNoClass, superclass } from "../src/state/review";
import { Store } from "../src/state/store";
import { occluders } from "../src/viewer/appearance";
import { cutAway, findHolders } from "../src/viewer/cutaway";
import { makeNames, makeStore, QUEUE, reply, VIEW as view } from "./fakeStore";
import { makeScene, makeState, makeStates } from "./scene";

describe("states", () => {
  it("predicts what the server answers", () => {
    const { states } = makeStates();
    const judged = (action: Parameters<typeof predictStates>[2], chosen?: number) => {
      const [state] = predictStates(states, [1], action, chosen);
      return [state?.state, state?.class];
    };
    expect(judged("confirm")).toEqual(["confirmed", 1]);
    expect(judged("choose", 2)).toEqual(["corrected", 2]);
    expect(judged("choose", 1)).toEqual(["confirmed", 1]);
    expect(judged("no-class")).toEqual(["no-class", -1]);
    expect(judged("unsure")).toEqual(["unsure", 1]);
  });

  it("leaves it to the server what an object is after its decision is cleared", () => {
    expect(predictStates(makeStates().states, [1, 2], "clear")).toEqual([]);
  });

  it("names each reason for which a grounder gave no class once, in a fixed order", () => {
    const reasons = ["failed", "suggested", "refused", "failed"] as const;
    const states = reasons.map((state, object) => makeState(object, { state }));
    expect(reasonsForNoClass(states, [0, 1, 2, 3])).toEqual(["refused", "failed"]);
    expect(reasonsForNoClass(states, [1])).toEqual([]);
    expect(reasonsForNoClass(states, [])).toEqual([]);
  });

  it("leaves unsure and failed objects open", () => {
    expect((["suggested", "unsure", "refused", "unreadable", "failed"] as const).every(isOpen)).toBe(true);
    expect((["confirmed", "corrected", "no-class"] as const).some(isOpen)).toBe(false);
  });

  it("replaces states without touching the old list", () => {
    const { states } = makeStates();
    const changed = applyStates(states, [makeState(1, { state: "confirmed" })]);
    expect([states[1]?.state, changed[1]?.state, changed[0]]).toEqual(["suggested", "confirmed", states[0]]);
  });

  it("writes durations for people", () => {
    expect([20, 60, 3540, 7800].map(durationText)).toEqual(["under a minute", "1 min", "59 min", "2 h 10 min"]);
  });
});

describe("evidence for a candidate", () => {
  const of = (group: string, score: number | null, likelihood_ratio: number | null) =>
    evidenceText({ group, explanation: "", score, likelihood_ratio });

  it("is a share for words and votes, and a factor for size and place", () => {
    expect([of("name", 0.966, null), of("neighbours", 0, null)]).toEqual(["name 97 %", "neighbours 0 %"]);
    expect([of("size", null, 37.9), of("size", null, 1.24), of("size", null, 1e6)]).toEqual([
      "size ×38",
      "size ×1.2",
      "size ×1000+",
    ]);
    expect([of("place", null, 0.8), of("size", null, 0.02), of("stance", null, 1.01)]).toEqual([
      "place ÷1.3",
      "size ÷50",
      "stance ×1",
    ]);
    expect(of("size", null, 0)).toBe("size ÷1000+");
  });
});

describe("store", () => {
  it("shows a decision at once and moves to the next group", async () => {
    const store = makeStore(async <T>() => reply([2, 1], { state: "confirmed", class: 1 }) as T);
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    const done = store.decide(store.targets.value, "confirm");
    expect([store.states.value[1]?.state, store.server.saving.value]).toEqual(["confirmed", "saving"]);
    await done;
    expect([store.server.saving.value, store.server.canUndo.value, store.groupId.value]).toEqual([
      "saved",
      true,
      "/K/wall",
    ]);
  });

  it("takes a decision back that the server refuses", async () => {
    const store = makeStore(() => Promise.reject(new ApiFailure("no space left", 422)));
    await store.loadQueue();
    await store.decide([1], "confirm");
    expect([store.states.value[1]?.state, store.server.saving.value]).toEqual(["suggested", "failed"]);
    expect(store.notices.value.at(-1)?.text).toBe("Not saved: Cup_1 (no space left)");
  });

  it("does not confirm an object without a suggestion", async () => {
    const post = vi.fn();
    const store = makeStore(post);
    await store.loadQueue();
    const change = { version: 1, reviewer: "", page: "p", message: "", can_undo: false, can_redo: false };
    store.server.receive({ ...change, states: [makeState(3, { state: "failed", suggested: -1, class: -1 })] });
    store.goTo("/K/wall");
    findBinding("Enter")?.run(store, view, "Enter");
    expect(store.notices.value.at(-1)?.text).toBe("no suggestion to confirm. Choose a class with /");
    await store.decide([2, 3], "confirm");
    expect(store.notices.value.at(-1)?.text).toMatch(/^1 of 2 objects: no suggestion/);
    expect([post.mock.calls.length, store.groupId.value, store.server.saving.value]).toEqual([0, "/K/wall", "saved"]);
  });

  it("leaves unticked members out", async () => {
    const store = makeStore(async <T>() => reply([2], { state: "confirmed" }) as T);
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    store.toggleMember(1);
    expect(store.targets.value).toEqual([2]);
    store.toggleMember(1);
    expect(store.targets.value).toEqual([2, 1]);
  });

  it("decides about the selection outside the review", () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    store.select([0]);
    store.select([1], true);
    store.select([0], true);
    store.drawer.value = "ask";
    expect(store.targets.value).toEqual([1]);
  });

  it("takes in the decisions of others, once", () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    const change = {
      version: 4,
      reviewer: "Bob",
      page: "p",
      message: "confirm",
      can_undo: true,
      can_redo: false,
      states: [makeState(0, { state: "confirmed" })],
    };
    store.server.receive(change);
    store.server.receive({ ...change, states: [makeState(0)] });
    expect([store.states.value[0]?.state, store.server.version.value]).toEqual(["confirmed", 4]);
  });

  it("filters the queue with the objects", async () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    await store.loadQueue();
    store.filters.value = { ...store.filters.value, text: "wall" };
    expect(store.groups.value.map((group) => group.title)).toEqual(["wall"]);
    expect(store.group.value?.title).toBe("wall");
  });

  it("decides about the members that pass the filters only", async () => {
    const sent: unknown[] = [];
    const store = makeStore(async <T>(_: string, body: unknown) => {
      sent.push((body as { objects: number[] }).objects);
      return reply([1], { state: "confirmed" }) as T;
    });
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    findBinding("ArrowRight")?.run(store, view, "ArrowRight");
    store.filters.value = { ...store.filters.value, text: "cup_1" };
    expect([store.ticked.value, store.hiddenMembers.value, store.member.value]).toEqual([[1], 1, 0]);
    findBinding("Enter")?.run(store, view, "Enter");
    await vi.waitFor(() => expect(sent).toEqual([[1]]));
    // With no group left under the filter, keys decide about nothing.
    store.filters.value = { ...store.filters.value, text: "no such thing" };
    findBinding("Enter")?.run(store, view, "Enter");
    expect([store.targets.value, store.openGroups.value.length]).toEqual([[], 2]);
  });

  it("selects the group as it is filtered, until something else is selected", async () => {
    const store = makeStore(vi.fn());
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    store.filters.value = { ...store.filters.value, text: "cup_2" };
    expect(store.selection.value).toEqual([2]);
    store.filters.value = { ...store.filters.value, text: "" };
    expect(store.selection.value).toEqual([2, 1]);
    // A member that was clicked and is then hidden is not decided about.
    store.select([1]);
    store.filters.value = { ...store.filters.value, text: "cup_2" };
    expect([store.targets.value, focusOf(store)]).toEqual([[2], 2]);
    store.select([0]);
    store.filters.value = { ...store.filters.value, text: "cup_2" };
    expect(store.selection.value).toEqual([0]);
  });

  it("isolates what the queue goes to", async () => {
    const store = makeStore(vi.fn());
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    findBinding("I")?.run(store, view, "I");
    store.select([1]);
    expect(store.isolated.value).toEqual(new Set([2, 1]));
    store.step(1);
    expect([store.isolated.value, store.lookAt.value]).toEqual([new Set([3]), [3]]);
    findBinding("I")?.run(store, view, "I");
    store.step(-1);
    expect(store.isolated.value).toBeNull();
  });

  it("lets both pages of a reviewer undo, not those of others", () => {
    const store = makeStore(vi.fn());
    const change = { page: "other", message: "", states: [], can_redo: false };
    store.server.receive({ ...change, version: 1, reviewer: "Bob", can_undo: true });
    expect(store.server.canUndo.value).toBe(false);
    store.server.receive({ ...change, version: 2, reviewer: "Ann", can_undo: true });
    expect(store.server.canUndo.value).toBe(true);
    store.server.receive({ ...change, version: 3, reviewer: "Ann", can_undo: false, can_redo: true });
    expect([store.server.canUndo.value, store.server.canRedo.value]).toEqual([false, true]);
  });
});

describe("a server that does not answer", () => {
  const gone = new ApiFailure("no answer", 0);

  /** A store whose server can be stopped, and started with the states on its disk. */
  function stoppable() {
    const server = { isGone: false, states: makeStates() };
    const answer = <T>(found: unknown) => (server.isGone ? Promise.reject(gone) : Promise.resolve(found as T));
    const client = {
      ...makeStore(vi.fn()).client,
      get: <T>(path: string) => answer<T>(path.startsWith("states") ? server.states : QUEUE),
      post: <T>() => answer<T>(reply([2, 1], { state: "confirmed" })),
    };
    return { server, store: new Store(client, makeScene(), makeStates(), makeNames()) };
  }
  const texts = (store: Store) => store.notices.value.map(({ text }) => text);

  it("leaves the group and its ticks as they were, and is named in a message", async () => {
    const { server, store } = stoppable();
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    store.toggleMember(1);
    server.isGone = true;
    await store.decide(store.targets.value, "confirm");
    expect([store.groupId.value, store.ticked.value, store.server.saving.value]).toEqual([
      "/K/Table/Cup_1",
      [2],
      "offline",
    ]);
    expect(store.groups.value).toEqual(QUEUE.groups);
    expect(texts(store)).toEqual(["Not saved: Cup_2 (no answer)"]);
    // The next key may have been meant for the next group.
    await store.decide(store.targets.value, "confirm");
    expect(texts(store).at(-1)).toBe(
      "The decision about this group was not saved. Press the key again to decide about this one.",
    );
  });

  it("names what it has not saved once it answers, and says so until the next decision", async () => {
    const { server, store } = stoppable();
    await store.loadQueue();
    server.isGone = true;
    await Promise.all([store.decide([2, 1], "confirm"), store.decide([3], "no-class")]);
    expect(store.groups.value).toEqual(QUEUE.groups);
    server.isGone = false;
    store.server.setConnected(true);
    await vi.waitFor(() => expect(store.server.saving.value).toBe("failed"));
    expect(texts(store).at(-1)).toBe("Not saved while the server did not answer: Cup_2 and 1 more; wall");
    expect(store.server.connections.value).toBe(1);
    // The first key after the way back is held back.
    await store.decide([0], "confirm");
    expect(store.server.saving.value).toBe("failed");
    await store.decide([0], "confirm");
    expect(store.server.saving.value).toBe("saved");
  });

  it("has saved a decision whose answer alone was lost", async () => {
    const { server, store } = stoppable();
    await store.loadQueue();
    server.isGone = true;
    await store.decide([0], "confirm");
    const states = makeStates().states.map((state) =>
      state.object === 0 ? makeState(0, { state: "confirmed" }) : state,
    );
    Object.assign(server, { isGone: false, states: { ...makeStates(), version: 1, states } });
    store.server.setConnected(true);
    await vi.waitFor(() => expect(store.server.saving.value).toBe("saved"));
    expect([store.states.value[0]?.state, texts(store).length]).toEqual(["confirmed", 1]);
  });

  it("is not taken for one that has grounded again", async () => {
    const { server, store } = stoppable();
    server.isGone = true;
    store.server.setConnected(false);
    await store.groundAgain();
    expect([store.server.saving.value, texts(store)]).toEqual(["offline", ["no answer"]]);
  });
});

describe("the current member of a group", () => {
  it("is the object that is selected anywhere, and arrows move the selection", async () => {
    const store = makeStore(vi.fn());
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    store.select([1]);
    expect([store.member.value, focusOf(store)]).toEqual([1, 1]);
    findBinding("ArrowRight")?.run(store, view, "ArrowRight");
    expect([store.selection.value, focusOf(store)]).toEqual([[2], 2]);
    // Something outside the group leaves its member.
    store.select([3]);
    expect([store.member.value, focusOf(store)]).toEqual([0, 3]);
  });

  it("moves alone while the group is selected", async () => {
    const store = makeStore(vi.fn());
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    findBinding("ArrowLeft")?.run(store, view, "ArrowLeft");
    expect([store.selection.value, store.member.value, focusOf(store)]).toEqual([[2, 1], 1, 1]);
  });
});

describe("fast and concurrent reviewers", () => {
  /** Answers each decision when it is let through, with the state that it asks for. */
  function gated() {
    const sent: { objects: number[]; action: string }[] = [];
    const gates: { pass(version: number): void; fail(status: number): void }[] = [];
    const post = <T>(_: string, body: unknown) => {
      const { objects, action } = body as { objects: number[]; action: string };
      sent.push({ objects, action });
      return new Promise<T>((resolve, reject) => {
        const states = objects.map((object) => makeState(object, { state: "confirmed" }));
        gates.push({
          pass: (version) => resolve({ ...reply(objects, {}), version, states } as T),
          fail: (status) => reject(new ApiFailure("no", status)),
        });
      });
    };
    return { sent, gates, post };
  }
  const change = (object: number, version: number, given: Partial<ReturnType<typeof makeState>>, page = "other") => ({
    version,
    page,
    reviewer: "Bob",
    message: "decides",
    can_undo: true,
    can_redo: false,
    states: [makeState(object, given)],
  });

  it("decides about the next group when a key comes before the reply", async () => {
    const { sent, gates, post } = gated();
    const store = makeStore(post);
    await store.loadQueue();
    const confirm = () => findBinding("Enter")?.run(store, view, "Enter");
    confirm();
    confirm();
    expect(store.group.value).toBeNull();
    await vi.waitFor(() => expect(sent).toHaveLength(1));
    gates[0]?.pass(1);
    await vi.waitFor(() => expect(sent).toHaveLength(2));
    expect(store.server.saving.value).toBe("saving");
    gates[1]?.pass(2);
    await vi.waitFor(() => expect(store.server.saving.value).toBe("saved"));
    expect(sent.map(({ objects }) => objects)).toEqual([[2, 1], [3]]);
  });

  it("takes back the decision that failed, not one made in the meantime", async () => {
    const { gates, post } = gated();
    const store = makeStore(post);
    await store.loadQueue();
    const first = store.decide([2, 1], "confirm");
    const second = store.decide([3], "confirm");
    await vi.waitFor(() => expect(gates).toHaveLength(1));
    gates[0]?.fail(500);
    await first;
    expect(store.states.value.map(({ state }) => state)).toEqual(["suggested", "suggested", "suggested", "confirmed"]);
    await vi.waitFor(() => expect(gates).toHaveLength(2));
    gates[1]?.pass(1);
    await second;
    expect([store.states.value[3]?.state, store.server.saving.value]).toEqual(["confirmed", "failed"]);
  });

  it("takes in an older change of others after its own reply", async () => {
    const { gates, post } = gated();
    const store = makeStore(post);
    const done = store.decide([1], "confirm");
    await vi.waitFor(() => expect(gates).toHaveLength(1));
    gates[0]?.pass(6);
    await done;
    store.server.receive(change(0, 5, { state: "no-class" }));
    store.server.receive(change(1, 5.5, { state: "unsure" }));
    expect(store.states.value.slice(0, 2).map(({ state }) => state)).toEqual(["no-class", "confirmed"]);
  });

  it("keeps a decision whose reply is lost but which the stream announces", async () => {
    const { gates, post } = gated();
    const store = makeStore(post);
    const done = store.decide([1], "confirm");
    await vi.waitFor(() => expect(gates).toHaveLength(1));
    store.server.receive(change(1, 1, { state: "confirmed" }));
    gates[0]?.fail(500);
    await done;
    expect(store.states.value[1]?.state).toBe("confirmed");
  });

  it("holds a key back that was meant for a group that somebody else has just decided", async () => {
    const { sent, post } = gated();
    let queue = QUEUE;
    const client = { ...makeStore(post).client, get: async <T>() => queue as T, post };
    const store = new Store(client, makeScene(), makeStates(), makeNames());
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    queue = { ...QUEUE, groups: QUEUE.groups.slice(1) };
    store.server.receive(change(1, 1, { state: "confirmed" }));
    await vi.waitFor(() => expect(store.groupId.value).toBe("/K/wall"));
    await store.decide(store.targets.value, "confirm");
    expect(sent).toEqual([]);
    void store.decide(store.targets.value, "confirm");
    await vi.waitFor(() => expect(sent).toEqual([{ objects: [3], action: "confirm" }]));
  });

  it("has not seen what another reviewer decided a moment ago", async () => {
    const seen: number[] = [];
    const post = async <T>(_: string, body: unknown) => {
      seen.push((body as { seen: number }).seen);
      return { ...reply([], {}), version: 2 } as T;
    };
    const store = makeStore(post);
    const now = vi.spyOn(performance, "now").mockReturnValue(1000);
    store.server.receive(change(1, 2, { state: "confirmed" }));
    now.mockReturnValue(1400);
    await store.decide([1], "no-class");
    await store.decide([3], "confirm");
    now.mockReturnValue(1900);
    await store.decide([1], "no-class");
    now.mockRestore();
    expect(seen).toEqual([0, 2, 2]);
  });

  it("shows the group of the last of several undos, whatever the order of the answers", async () => {
    const answers: (() => void)[] = [];
    let version = 0;
    const client = {
      ...makeStore(async <T>() => ({}) as T).client,
      get: <T>() => new Promise<T>((resolve) => answers.push(() => resolve(QUEUE as T))),
      post: async <T>() => ({ ...reply([version === 0 ? 1 : 3], {}), version: ++version }) as T,
    };
    const store = new Store(client, makeScene(), makeStates(), makeNames());
    const undone = Promise.all([store.undo(), store.undo()]);
    await vi.waitFor(() => expect(answers).toHaveLength(2));
    answers[1]?.();
    answers[0]?.();
    await undone;
    expect(store.groupId.value).toBe("/K/wall");
  });

  it("decides about what is selected outside the group, and stays in the queue", async () => {
    const { sent, gates, post } = gated();
    const store = makeStore(post);
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    store.select([0]);
    expect([store.targets.value, store.ticked.value, focusOf(store)]).toEqual([[0], [2, 1], 0]);
    void store.decide(store.targets.value, "confirm");
    await vi.waitFor(() => expect(gates).toHaveLength(1));
    expect([sent[0]?.objects, store.groupId.value]).toEqual([[0], "/K/Table/Cup_1"]);
  });
});

describe("queue", () => {
  const [cups, wall] = QUEUE.groups as [(typeof QUEUE.groups)[0], (typeof QUEUE.groups)[0]];

  it("goes to exceptions first, then on, then round", () => {
    expect(groupAfter(QUEUE.groups, cups, new Set([2]))).toBe(cups);
    expect(groupAfter(QUEUE.groups, cups, new Set([1, 2]))).toBe(wall);
    expect(groupAfter(QUEUE.groups, wall, new Set([3]))).toBe(cups);
    expect(groupAfter(QUEUE.groups, wall, new Set([1, 2, 3]))).toBeNull();
  });

  it("finds a group again whose first object is decided", () => {
    const rest = { ...cups, id: "/K/Table/Cup_2", objects: [2] };
    expect(findAgain([wall, rest], cups)).toBe(rest);
    expect(findAgain([wall], cups)).toBeNull();
  });

  it("loses decided objects, and groups without any left", () => {
    expect(withoutObjects(QUEUE, new Set([1, 3])).groups).toEqual([{ ...cups, objects: [2] }]);
    expect(withoutObjects(QUEUE, new Set())).toBe(QUEUE);
  });
});

describe("keys", () => {
  it("has each key once, and all of them in the help", () => {
    const keys = BINDINGS.flatMap((binding) => binding.keys);
    expect(new Set(keys).size).toBe(keys.length);
    expect(BINDINGS.every((binding) => binding.help.length > 3)).toBe(true);
  });

  it("names keys as the table does", () => {
    const event = { key: "z", ctrlKey: false, metaKey: false, altKey: false, shiftKey: false };
    expect(keyName(event)).toBe("Z");
    expect(keyName({ ...event, metaKey: true, shiftKey: true, key: "Z" })).toBe("Ctrl+Shift+Z");
    expect(keyName({ ...event, key: "?", shiftKey: true })).toBe("?");
    expect(keyName({ ...event, key: " " })).toBe("Space");
    expect(keyName({ ...event, key: "ArrowDown" })).toBe("ArrowDown");
  });

  it("chooses a candidate by its digit for all ticked members", async () => {
    const sent: unknown[] = [];
    const store = makeStore(async <T>(_: string, body: unknown) => {
      sent.push(body);
      return reply([2, 1], { state: "corrected", class: 3 }) as T;
    });
    await store.loadQueue();
    store.goTo("/K/Table/Cup_1");
    expect(focusOf(store)).toBe(2);
    // Faster than the page of the object is loaded.
    findBinding("2")?.run(store, view, "2");
    await vi.waitFor(() => expect(sent).toHaveLength(1));
    expect(sent).toMatchObject([{ objects: [2, 1], action: "choose", class: 3, reviewer: "Ann" }]);
  });

  it("steer the camera with Shift, Ctrl and arrows, plus and minus", () => {
    const steps: unknown[] = [];
    const steering = { ...view, steer: (...step: unknown[]) => void steps.push(step) };
    const store = makeStore(async <T>() => reply([], {}) as T);
    for (const key of ["Shift+ArrowLeft", "Shift+ArrowUp", "Ctrl+ArrowRight", "Ctrl+ArrowDown", "+", "=", "-"])
      findBinding(key)?.run(store, steering, key);
    expect(steps).toEqual([
      ["orbit", -1, 0],
      ["orbit", 0, 1],
      ["pan", 1, 0],
      ["pan", 0, -1],
      ["zoom", 0, 1],
      ["zoom", 0, 1],
      ["zoom", 0, -1],
    ]);
  });

  it("chooses the superclass", () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    expect([superclass(store.model, 2), superclass(store.model, 0)]).toEqual([0, -1]);
  });

  it("chooses the superclass that all objects have in common, or says why there is none", async () => {
    const sent: unknown[] = [];
    const store = makeStore(async <T>(_: string, body: unknown) => {
      sent.push(body);
      return reply([], {}) as T;
    });
    const change = { version: 1, reviewer: "", page: "p", message: "", can_undo: false, can_redo: false };
    store.server.receive({
      ...change,
      states: [makeState(1, { class: -1, suggested: 1 }), makeState(2, { class: 3 })],
    });
    const press = (...objects: number[]) => {
      store.select(objects);
      findBinding("U")?.run(store, view, "U");
      return store.notices.value.at(-1)?.text;
    };
    // A table, a cup without a decided class, a vessel: all are artifacts.
    press(0, 1, 2);
    await vi.waitFor(() => expect(sent).toMatchObject([{ objects: [0, 1, 2], class: 0 }]));
    expect(press(0, 3)).toBe("The 2 objects have several superclasses. Choose a class with /");
    expect(press(3)).toBe("The class has no superclass. Choose a class with /");
    expect(sent).toHaveLength(1);
  });

  it("closes one thing at a time with Escape", () => {
    const store = makeStore(async <T>() => reply([], {}) as T);
    store.select([1]);
    store.isHelpOpen.value = true;
    const pressEscape = () => findBinding("Escape")?.run(store, view, "Escape");
    pressEscape();
    expect([store.isHelpOpen.value, store.selection.value]).toEqual([false, [1]]);
    pressEscape();
    expect(store.selection.value).toEqual([]);
  });
});

describe("view", () => {
  const scene = makeScene();

  it("hides the wall between the viewer and the scene", () => {
    expect([...cutAway(scene, { x: 0, y: -1 })]).toEqual([3]);
    expect([...cutAway(scene, { x: 0, y: 1 })]).toEqual([]);
  });

  it("finds boxes that hold others: a large one around three middles, not a small one, and parents", () => {
    const small = (x: number): [number, number, number, number, number, number] => [x, 1, 0, x + 0.2, 1.2, 0.2];
    const walls: [number, number, number, number, number, number] = [0, 0, 0, 5, 5, 3];
    const crate: [number, number, number, number, number, number] = [0.9, 0.9, 0, 3.5, 1.3, 0.3];
    const boxes = [walls, small(1), small(2), small(3), crate, null];
    const objects = { ...scene.objects, box: boxes, parent: [-1, -1, 5, -1, -1, -1] };
    expect([...findHolders({ ...scene, objects })].filter((found) => found >= 0).sort()).toEqual([0, 5]);
  });

  it("finds what hides an object: what is before it, not what is behind", () => {
    const eye = { position: new Vector3(0.45, -5, 0.75), direction: new Vector3(0, -1, 0) };
    const hidesNothing = () => false;
    expect([...occluders(scene, [1], eye, hidesNothing)]).toEqual([3]);
    const above = { position: new Vector3(0.45, 0.45, 5), direction: new Vector3(0, 0, 1) };
    expect([...occluders(scene, [1], above, hidesNothing)]).toEqual([]);
    const below = { position: new Vector3(0.45, 0.45, -5), direction: new Vector3(0, 0, -1) };
    expect([...occluders(scene, [1], below, hidesNothing)]).toEqual([0]);
  });

  it("asks the meshes of what holds the viewer, such as the walls of a house", () => {
    const eye = { position: new Vector3(0.45, -1.95, 0.75), direction: new Vector3(0, -1, 0) };
    const asked: number[] = [];
    const found = occluders(scene, [1], eye, (object, ray, distance) => {
      asked.push(object);
      expect([ray.direction.y, distance]).toEqual([expect.closeTo(1), expect.closeTo(2.4)]);
      return true;
    });
    expect([asked, [...found]]).toEqual([[3], [3]]);
  });
});
