/** Messages about decisions. */

import type { ClassIndex, DecisionAction, DecisionReply } from "../api/types";
import { classLabel, conceptLabel, type SceneModel } from "./model";
import type { DecisionDetails } from "./store";

/** Returns what a decision has done, for people. */
export function describeDecision(
  model: SceneModel,
  reply: DecisionReply,
  count: number,
  action: DecisionAction,
  chosen: ClassIndex | undefined,
  { concept, proposal }: DecisionDetails,
): string {
  const things =
    count === 1 ? (model.data.objects.name[reply.states[0]?.object ?? -1] ?? "1 object") : `${count} objects`;
  const classes = new Set(reply.states.map((state) => state.class));
  const label = classLabel(model, chosen ?? reply.states[0]?.class ?? -1);
  switch (action) {
    case "confirm":
      return classes.size > 1 ? `Confirmed ${things} of ${classes.size} classes` : `Confirmed ${things} as ${label}`;
    case "choose":
      if (proposal !== undefined) return `Proposed “${proposal}” below ${label} for ${things}`;
      return concept === undefined
        ? `Set ${things} to ${label}`
        : `Every “${conceptLabel(model, concept)}” is ${label}: set ${things}`;
    case "unsure":
      return `Marked ${things} as unsure`;
    case "no-class":
      return `No class fits ${things}`;
    case "clear":
      return `Cleared ${things}`;
  }
}
