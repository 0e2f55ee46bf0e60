import { describe, expect, it, vi } from "vitest";
import { findBinding } from "../src/keys/bindings";
import { accuracyText, auditText, isAuditing, toggleAudit } from "../src/state/audit";
import { makeStore, QUEUE, reply, VIEW as view } from "./fakeStore";

describe("audit", () => {
  it("marks verdicts on the shown object of the sample only", async () => {
    const sent: unknown[] = [];
    const store = makeStore(async <T>(_: string, body: unknown) => {
      sent.push(body);
      return reply([3], { state: "confirmed" }) as T;
    });
    await store.loadQueue();
    store.goTo("/K/wall");
    findBinding("V")?.run(store, view, "V");
    expect([isAuditing(store), store.targets.value]).toEqual([true, []]);
    await vi.waitFor(() => expect(store.queue.value).not.toBeNull());
    store.goTo("/K/wall");
    await store.decide([3], "unsure");
    store.goTo("/K/wall");
    await store.decide([0], "confirm");
    await store.decide([3], "clear");
    await store.decide([3], "choose", 1, { concept: 0 });
    expect(sent.map((body) => (body as { audit?: boolean }).audit)).toEqual([true, undefined, undefined, undefined]);
    findBinding("V")?.run(store, view, "V");
    expect(isAuditing(store)).toBe(false);
    await vi.waitFor(() => expect(store.queue.value).not.toBeNull());
    store.goTo("/K/wall");
    await store.decide([3], "confirm");
    expect(sent.at(-1)).not.toHaveProperty("audit");
  });

  it("hides confidences in colours and filters", () => {
    const store = makeStore(vi.fn());
    store.colorMode.value = "confidence";
    store.filters.value = { ...store.filters.value, confidence: [0.95, 1] };
    expect([store.shownColors.value, store.shown.value]).toEqual(["confidence", new Set([0])]);
    toggleAudit(store);
    expect([store.shownColors.value, store.shown.value]).toEqual(["class", null]);
    toggleAudit(store);
    expect([store.shownColors.value, store.shown.value?.size]).toEqual(["confidence", 1]);
  });

  it("is described with its size and its interval", () => {
    const audit = { ...QUEUE.audit, sample: 30, waiting: 27, population: 139 };
    expect(auditText(audit)).toBe("3 of 30 judged, drawn at random from 139. Confidences are hidden.");
    expect(accuracyText(audit)).toBe("nothing judged yet");
    expect(accuracyText({ ...audit, judged: 10, right: 8, interval: [0.4902, 0.9433] })).toBe(
      "8 of 10 right: 80 %, 95 % interval 49 to 94 %",
    );
  });
});
