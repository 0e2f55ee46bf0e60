/** Messages about decisions. */

import type { ClassIndex, DecisionAction, DecisionReply, ObjectIndex } from "../api/types";
import { classLabel, conceptLabel, type SceneModel } from "./model";
import type { DecisionDetails } from "./store";

export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** Returns objects by the name of the first: `Cup_1 and 3 more`. */
export function nameObjects(model: SceneModel, objects: readonly ObjectIndex[]): string {
  const name = model.data.objects.name[objects[0] ?? -1] ?? "nothing";
  return objects.length > 1 ? `${name} and ${objects.length - 1} more` : name;
}

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
