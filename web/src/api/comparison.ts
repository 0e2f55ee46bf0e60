/** The JSON of a comparison, `GET /api/comparison`; see types.ts for indices and units. */

import type { Box, ClassIndex, ObjectIndex, Turned } from "./types";

/** An object can have several; `relations` are on, inside, part of, and room. */
export type ChangeKind =
  | "appeared"
  | "disappeared"
  | "class"
  | "moved"
  | "turned"
  | "resized"
  | "renamed"
  | "mass"
  | "asset"
  | "relations";

/** `GET /api/comparison`: the changes from another version, or mapping, to the scene with its current decisions. */
export interface Comparison {
  /** The file that `--compare` names. */
  other: string;
  source: "stage" | "graph" | "mapping";
  /** `States.version` of the decisions that are compared. */
  version: number;
  /** Number of objects with each kind of change; kinds without objects are left out. */
  counts: Partial<Record<ChangeKind, number>>;
  unchanged: number;
  /** What could not be compared. */
  notes: string[];
  /** By kind, then by path. */
  changes: SceneChange[];
}

export interface SceneChange {
  /** The most telling first. */
  kinds: ChangeKind[];
  /** -1 if it disappeared. */
  object: ObjectIndex;
  path: string;
  /** Empty if it appeared. */
  path_before: string;
  name: string;
  /** Null if it appeared. */
  before: ClassClaim | null;
  /** Null if it disappeared. */
  after: ClassClaim | null;
  box_before: Box | null;
  turned_before: Turned | null;
  distance_m: number | null;
  /** The object that explains the move: it carried this one; -1 if none does. */
  carried_by: ObjectIndex;
  turned_degrees: number;
  /** Extents before and after. */
  sizes: [[number, number, number], [number, number, number]] | null;
  /** Kilograms before and after. */
  masses: [number | null, number | null] | null;
  /** New relations, with paths of now, and former ones, with paths of before. */
  gained: { kind: string; anchor: string }[];
  lost: { kind: string; anchor: string }[];
  /** Why an object with another path is the same. */
  reason: string;
}

/** The class of an object according to one version. */
export interface ClassClaim {
  /** -1 without a class, or with one of another ontology, which has a label all the same. */
  class: ClassIndex;
  label: string;
  /** Null if there is none, or a person decided. */
  confidence: number | null;
  is_decided: boolean;
}
