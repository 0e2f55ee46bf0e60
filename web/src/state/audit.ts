/** The audit: decisions about objects drawn at random, which measure how often suggestions are right. */

import { batch } from "@preact/signals";
import type { Audit, DecisionAction, ObjectIndex, QueueOrder } from "../api/types";
import type { DecisionDetails, Store } from "./store";

/** Returns whether the queue is the random sample, so that confidences are hidden. */
export function isAuditing(store: Store): boolean {
  return store.order.value === "audit";
}

/** Shows the queue in another order; until it is loaded, keys decide about nothing. */
export function showOrder(store: Store, order: QueueOrder): void {
  batch(() => {
    store.order.value = order;
    store.queue.value = null;
    store.groupId.value = "";
    store.select([]);
  });
  void store.loadQueue();
}

/** Shows the random sample, or again the queue by expected gain. */
export function toggleAudit(store: Store): void {
  store.drawer.value = "review";
  store.isDrawerOpen.value = true;
  showOrder(store, isAuditing(store) ? "gain" : "audit");
}

/** Returns whether a decision counts for the audit: a verdict on the object of the sample that is shown. */
export function isAuditOf(
  store: Store,
  objects: readonly ObjectIndex[],
  action: DecisionAction,
  details: DecisionDetails,
): boolean {
  const shown = store.group.value?.objects ?? [];
  const isOfSample = objects.every((object) => shown.includes(object));
  return isAuditing(store) && isOfSample && action !== "clear" && details.concept === undefined;
}

/** Returns how far the sample is judged. */
export function auditText(audit: Audit | undefined): string {
  if (audit === undefined) return "";
  const done = audit.sample - audit.waiting;
  return `${done} of ${audit.sample} judged, drawn at random from ${audit.population}. Confidences are hidden.`;
}

/** Returns the accuracy with its interval, such as “28 of 30 right: 93 %, 95 % interval 79 to 98 %”. */
export function accuracyText({ right, judged, interval }: Audit): string {
  if (interval === null) return "nothing judged yet";
  const percent = (share: number) => Math.round(100 * share);
  const [lower, upper] = interval.map(percent);
  return `${right} of ${judged} right: ${percent(right / judged)} %, 95 % interval ${lower} to ${upper} %`;
}
