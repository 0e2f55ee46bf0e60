/** Where the reviewer is in the queue while groups shrink, vanish and move. */

import type { ObjectIndex, Queue, QueueGroup } from "../api/types";

/** Returns the groups with those of their objects that pass; a group without any is left out. */
export function restrictGroups(
  groups: readonly QueueGroup[],
  passes: (object: ObjectIndex) => boolean,
): readonly QueueGroup[] {
  return groups.flatMap((group) => {
    const objects = group.objects.filter(passes);
    if (objects.length === group.objects.length) return [group];
    return objects.length === 0 ? [] : [{ ...group, objects }];
  });
}

/** Returns the queue without objects that have been decided. */
export function withoutObjects(queue: Queue, decided: ReadonlySet<ObjectIndex>): Queue {
  if (decided.size === 0) return queue;
  return { ...queue, groups: [...restrictGroups(queue.groups, (object) => !decided.has(object))] };
}

/** Returns the group to show once objects are decided: the exceptions of the current group, else the next one. */
export function groupAfter(
  groups: readonly QueueGroup[],
  current: QueueGroup,
  decided: ReadonlySet<ObjectIndex>,
): QueueGroup | null {
  const isLeft = (group: QueueGroup) => group.objects.some((object) => !decided.has(object));
  if (isLeft(current)) return current;
  const at = groups.findIndex((group) => group.id === current.id);
  return groups.slice(at + 1).find(isLeft) ?? groups.find(isLeft) ?? null;
}

/** Returns the group of a new queue in which the reviewer stays: of the same id, else with the same objects; or null. */
export function findAgain(groups: readonly QueueGroup[], before: QueueGroup): QueueGroup | null {
  const objects = new Set(before.objects);
  return (
    groups.find((group) => group.id === before.id && group.objects.some((object) => objects.has(object))) ??
    groups.find((group) => group.objects.some((object) => objects.has(object))) ??
    null
  );
}
