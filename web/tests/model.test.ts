import { describe, expect, it } from "vitest";
import { buildModel, closures, searchClasses } from "../src/state/model";
import { shortNames } from "../src/state/names";
import { buildPrimTree, objectsBelow } from "../src/state/primTree";
import { treeRows } from "../src/state/tree";
import { overlaps } from "../src/viewer/overlay";
import { makeScene } from "./scene";

const model = buildModel(makeScene());
const labels = (found: number[]) => found.map((index) => model.data.classes[index]?.label);

describe("class hierarchy", () => {
  it("counts a class with two parents below both", () => {
    expect([...(model.classClosure[3] as Set<number>)].sort()).toEqual([1, 3]);
    expect(model.classRoots).toEqual([0]);
  });

  it("ends in a cycle", () => {
    expect(closures([[1], [0]]).map((found) => [...found].sort())).toEqual([
      [0, 1],
      [0, 1],
    ]);
  });
});

describe("class search", () => {
  it("ranks labels before synonyms before definitions", () => {
    expect(labels(searchClasses(model, "cup", 9))).toEqual(["cup", "vessel"]);
    expect(labels(searchClasses(model, "mug", 9))).toEqual(["cup"]);
    expect(labels(searchClasses(model, "VESSEL", 9))).toEqual(["vessel", "cup"]);
  });

  it("finds nothing for nothing", () => {
    expect(searchClasses(model, "  ", 9)).toEqual([]);
    expect(searchClasses(model, "zebra", 9)).toEqual([]);
  });

  it("keeps to its limit", () => {
    expect(searchClasses(model, "a", 2)).toHaveLength(2);
  });
});

describe("prim tree", () => {
  const tree = buildPrimTree(
    ["/K/shell/Wall", "/K/Table", "/K/Table/Cup", "/K/Books[3]"],
    ["Wall", "Desk", "Cup", "3"],
  );

  it("adds the groups between objects, once, in the order of the stage", () => {
    expect(tree.names).toEqual(["K", "shell", "Wall", "Desk", "Cup", "Books", "3"]);
    expect(tree.objects).toEqual([-1, -1, 0, 1, 2, -1, 3]);
    expect(tree.parents).toEqual([-1, 0, 1, 0, 3, 0, 5]);
    expect(tree.roots).toEqual([0]);
  });

  it("lists the objects below a group", () => {
    expect(objectsBelow(tree, 0)).toEqual([0, 1, 2, 3]);
    expect(objectsBelow(tree, tree.nodeOf.get(1) as number)).toEqual([1, 2]);
  });
});

describe("tree rows", () => {
  const children = [[1, 2], [], [3], []];
  const nodes = (open: number[], shown: number[] | null) =>
    treeRows([0], children, new Set(open), shown === null ? null : new Set(shown)).map((row) => [row.node, row.depth]);

  it("shows the children of open nodes", () => {
    expect(nodes([], null)).toEqual([[0, 0]]);
    expect(nodes([0], null)).toEqual([
      [0, 0],
      [1, 1],
      [2, 1],
    ]);
  });

  it("opens the way to what a filter shows", () => {
    expect(nodes([], [3])).toEqual([
      [0, 0],
      [2, 1],
      [3, 2],
    ]);
    expect(nodes([], [])).toEqual([]);
  });

  it("closes nodes under a filter, too", () => {
    const rows = treeRows([0], children, new Set(), new Set([3]), new Set([2]));
    expect(rows.map((row) => [row.node, row.isOpen])).toEqual([
      [0, true],
      [2, false],
    ]);
  });

  it("shows a node with two parents below both", () => {
    const rows = treeRows([0, 1], [[2], [2], []], new Set([0, 1]), null);
    expect(rows.map((row) => [row.node, row.key])).toEqual([
      [0, "0"],
      [2, "0/2"],
      [1, "1"],
      [2, "1/2"],
    ]);
  });

  it("ends in a cycle", () => {
    expect(treeRows([0], [[1], [0]], new Set([0, 1]), null).map((row) => row.node)).toEqual([0, 1]);
    expect(treeRows([0], [[1], [0]], new Set(), new Set([1])).map((row) => row.node)).toEqual([0, 1]);
  });
});

describe("short names", () => {
  it("leaves out what most names begin with", () => {
    const names = ["acme_house_Chair_01", "acme_house_Table", "acme_house_Chair_02", "Lamp"];
    expect(shortNames(names)).toEqual(["…Chair_01", "…Table", "…Chair_02", "Lamp"]);
  });

  it("keeps names that begin with what they are", () => {
    expect(shortNames(["Chair_01", "Chair_02", "Table_01", "Table_02"])).toEqual([
      "Chair_01",
      "Chair_02",
      "Table_01",
      "Table_02",
    ]);
    expect(shortNames(["cup_1", "cup_2"])).toEqual(["cup_1", "cup_2"]);
  });
});

describe("labels over the picture", () => {
  it("overlap if they are near in both directions", () => {
    const label = { x: 100, y: 50, width: 60 };
    expect(overlaps(label, { x: 155, y: 60, width: 60 })).toBe(true);
    expect(overlaps(label, { x: 165, y: 50, width: 60 })).toBe(false);
    expect(overlaps(label, { x: 100, y: 67, width: 60 })).toBe(false);
  });
});
