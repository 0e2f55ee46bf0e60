/** What is derived once from the scene: children, hierarchies, words to search. */

import type { ClassIndex, ConceptIndex, ObjectIndex, SceneData } from "../api/types";
import { shortNames } from "./names";
import { buildPrimTree, type PrimTree } from "./primTree";

export interface SceneModel {
  data: SceneData;
  count: number;
  prims: PrimTree;
  /** Name of each object without the beginning that most share. */
  shortNames: string[];
  classChildren: ClassIndex[][];
  classRoots: ClassIndex[];
  /** All classes below each class, itself included. */
  classClosure: Set<ClassIndex>[];
  /** Lower-case text of each object that a search looks at. */
  objectText: string[];
  /** Lower-case label, name, synonyms of each class. */
  classText: string[];
}

export function buildModel(data: SceneData): SceneModel {
  const { path, name } = data.objects;
  const short = shortNames(name);
  const classChildren = invert(data.classes.map((cls) => cls.parents));
  return {
    data,
    count: path.length,
    prims: buildPrimTree(path, short),
    shortNames: short,
    classChildren,
    classRoots: indices(data.classes.length).filter((index) => data.classes[index]?.parents.length === 0),
    classClosure: closures(classChildren),
    objectText: path.map((text, index) => `${text} ${name[index]}`.toLowerCase()),
    classText: data.classes.map((cls) => [cls.label, cls.name, ...cls.synonyms].join("\n").toLowerCase()),
  };
}

export function indices(count: number): number[] {
  return Array.from({ length: count }, (_, index) => index);
}

/** Returns for each entry the entries that name it. */
function invert(parents: number[][]): number[][] {
  const found: number[][] = parents.map(() => []);
  parents.forEach((above, index) => {
    for (const parent of above) found[parent]?.push(index);
  });
  return found;
}

/** Returns for each entry the set of all entries below it, itself included; safe for several parents and cycles. */
export function closures(children: number[][]): Set<number>[] {
  return children.map((_, start) => {
    const seen = new Set<number>();
    const waiting = [start];
    while (waiting.length > 0) {
      const next = waiting.pop() as number;
      if (!seen.has(next)) {
        seen.add(next);
        waiting.push(...(children[next] ?? []));
      }
    }
    return seen;
  });
}

export function classLabel(model: SceneModel, index: ClassIndex): string {
  return model.data.classes[index]?.label ?? "no class";
}

export function conceptLabel(model: SceneModel, index: ConceptIndex): string {
  return model.data.concepts[index]?.label ?? "no concept";
}

export function roomLabel(model: SceneModel, index: ObjectIndex): string {
  const room = model.data.objects.room[index] ?? -1;
  return model.data.objects.rooms[room] ?? "no room";
}

/**
 * Returns the classes that match a text, best first: label begins with it, a word of the label does, a synonym does,
 * any part matches, the definition mentions it.
 */
export function searchClasses(model: SceneModel, text: string, limit: number): ClassIndex[] {
  const wanted = text.trim().toLowerCase();
  if (wanted === "") return [];
  const ranked: [number, ClassIndex][] = [];
  model.data.classes.forEach((cls, index) => {
    const label = cls.label.toLowerCase();
    const words = model.classText[index] ?? "";
    let rank = -1;
    if (label === wanted) rank = 0;
    else if (label.startsWith(wanted)) rank = 1;
    else if (label.includes(` ${wanted}`)) rank = 2;
    else if (words.includes(`\n${wanted}`)) rank = 3;
    else if (words.includes(wanted)) rank = 4;
    else if (cls.definition.toLowerCase().includes(wanted)) rank = 5;
    if (rank >= 0) ranked.push([rank, index]);
  });
  return ranked
    .sort((a, b) => a[0] - b[0] || classLabel(model, a[1]).localeCompare(classLabel(model, b[1])))
    .slice(0, limit)
    .map(([, index]) => index);
}
