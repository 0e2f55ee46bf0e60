/** The tree of prims: the objects, and the groups between them that only structure the stage. */

import type { ObjectIndex } from "../api/types";

export interface PrimTree {
  /** Name, object (-1 for a group) and path of each node. */
  names: string[];
  objects: ObjectIndex[];
  paths: string[];
  parents: number[];
  children: number[][];
  roots: number[];
  nodeOf: Map<ObjectIndex, number>;
}

/** Builds the tree from the paths of the objects. */
export function buildPrimTree(paths: readonly string[], names: readonly string[]): PrimTree {
  const tree: PrimTree = { names: [], objects: [], paths: [], parents: [], children: [], roots: [], nodeOf: new Map() };
  const byPath = new Map<string, number>();
  const objectOf = new Map(paths.map((path, object) => [path, object]));
  const add = (path: string): number => {
    const known = byPath.get(path);
    if (known !== undefined) return known;
    // Copies of a point instancer are named by a number in brackets, below no prim of their own.
    const above = path.endsWith("]") ? path.slice(0, path.lastIndexOf("[")) : path.slice(0, path.lastIndexOf("/"));
    const parent = above === "" ? -1 : add(above);
    const node = tree.names.length;
    const object = objectOf.get(path) ?? -1;
    byPath.set(path, node);
    tree.names.push(object < 0 ? path.slice(path.lastIndexOf("/") + 1) : (names[object] ?? ""));
    tree.objects.push(object);
    tree.paths.push(path);
    tree.parents.push(parent);
    tree.children.push([]);
    if (parent < 0) tree.roots.push(node);
    else tree.children[parent]?.push(node);
    if (object >= 0) tree.nodeOf.set(object, node);
    return node;
  };
  for (const path of paths) add(path);
  return tree;
}

/** Returns the objects at and below a node. */
export function objectsBelow(tree: PrimTree, node: number): ObjectIndex[] {
  const found: ObjectIndex[] = [];
  const waiting = [node];
  while (waiting.length > 0) {
    const next = waiting.pop() as number;
    const object = tree.objects[next] ?? -1;
    if (object >= 0) found.push(object);
    waiting.push(...(tree.children[next] ?? []));
  }
  return found.sort((a, b) => a - b);
}
