/**
 * The JSON of the studio's server (src/usd2kg/studio). Keys are those of the Python records.
 *
 * Objects, classes, concepts and rooms are numbers: indices into the lists of `SceneData`; -1 means none.
 * Lengths are metres in a z-up, right-handed world frame.
 */

export type ObjectIndex = number;
export type ClassIndex = number;
export type ConceptIndex = number;

/** Lower x, y, z, upper x, y, z. */
export type Box = [number, number, number, number, number, number];

/** Quaternion x, y, z, w, then extents along the own x, y, z. */
export type Turned = [number, number, number, number, number, number, number];

/** `GET /api/scene`: what does not change during a session. */
export interface SceneData {
  title: string;
  /** The stage or graph as the user named it. */
  source: string;
  ontology: { iri: string; label: string };
  grounder: string;
  /** The grounder of a second mapping; empty without one. */
  second_grounder: string;
  /** Whether confidences are fitted probabilities; otherwise they only rank. */
  is_calibrated: boolean;
  /** Whether the source is a knowledge graph, not a stage. */
  is_graph: boolean;
  /** Whether objects have colours or materials of their own. */
  has_colors: boolean;
  /** Whether `GET /api/comparison` answers. */
  has_comparison: boolean;
  /** Why something cannot be done in this session, as with a graph without its stage; absent if it can. */
  limits: Partial<Record<Limit, string>>;
  /** Name under which this page decides, as the server suggests it. */
  reviewer: string;
  objects: ObjectColumns;
  classes: ClassRecord[];
  concepts: ConceptRecord[];
  relation_kinds: { kind: string; count: number }[];
  diagnostics: { code: string; message: string; path: string | null }[];
  figures: { label: string; value: string }[];
}

/** Meshes and pictures, the layer of semantic labels, grounding again. */
export type Limit = "meshes" | "labels" | "reground";

/** Parallel arrays, one entry for each object, in scene order: parents before children. */
export interface ObjectColumns {
  path: string[];
  /** Display name, or the name of the prim. */
  name: string[];
  parent: ObjectIndex[];
  /** Box of the object's own geometry; null without geometry. */
  box: (Box | null)[];
  /** Orientation (quaternion x, y, z, w) and extents along the object's own axes; null if those are the world's. */
  turned: (Turned | null)[];
  /** Room or group prim that holds it, as an index into `rooms`. */
  room: number[];
  rooms: string[];
  /** Whether it is far from all others, or surrounds the scene like a sky dome. */
  is_outlier: boolean[];
  /** Index into `assets`. */
  asset: number[];
  assets: string[];
  /** Linear RGB from 0 to 1; null if none is authored. */
  color: ([number, number, number] | null)[];
  /** What hides the interior of a room. */
  shell: ("" | "ceiling" | "wall")[];
  /** The object that it is attached to. */
  mount: ObjectIndex[];
}

export interface ClassRecord {
  iri: string;
  /** Short unique name for people. */
  name: string;
  label: string;
  synonyms: string[];
  definition: string;
  parents: ClassIndex[];
}

export interface ConceptRecord {
  iri: string;
  label: string;
  /** Direct hypernyms. */
  broader: ConceptIndex[];
}

/** What is known of an object's class; the first four are decisions of a person or their absence. */
export type ReviewState =
  | "suggested"
  | "confirmed"
  | "corrected"
  | "unsure"
  | "no-class"
  | "refused"
  | "unreadable"
  | "failed";

/** One object's current state; `GET /api/states` lists all of them in scene order. */
export interface ObjectState {
  object: ObjectIndex;
  state: ReviewState;
  /** The valid class: decided or suggested. */
  class: ClassIndex;
  /** Probability of the grounder's suggestion; null if it gave none. */
  confidence: number | null;
  /** The grounder's suggestion, whatever was decided. */
  suggested: ClassIndex;
  concept: ConceptIndex;
  reviewer: string;
  /** ISO 8601 in UTC; empty if undecided. */
  time: string;
  comment: string;
  /** Label of a subclass that the reviewer proposes for the class; empty without one. */
  proposal: string;
  /** Whether two reviewers decided differently and nobody has settled it. */
  is_conflict: boolean;
}

export interface States {
  /** Number of the last event in the journal. */
  version: number;
  states: ObjectState[];
  /** Whether this reviewer can undo or redo. */
  can_undo: boolean;
  can_redo: boolean;
  outputs: Outputs;
}

/** The files in the project folder that follow the decisions. */
export interface Outputs {
  folder: string;
  /** Why they are not up to date; empty if they are, or will be in a moment. */
  problem: string;
}

/** `GET /api/object/{index}`. */
export interface ObjectPage {
  object: ObjectIndex;
  path: string;
  name: string;
  type_name: string;
  kind: string;
  selected_by: string;
  size: [number, number, number] | null;
  position: [number, number, number] | null;
  mass_kg: number | null;
  materials: string[];
  assets: string[];
  parts: string[];
  labels: { encoding: string; taxonomy: string; value: string }[];
  documentation: string;
  explanation: string;
  evidence: string[];
  /** Best first, at most 9 for the digit keys. */
  candidates: Candidate[];
  /** What the grounder of the second mapping says; null without one. */
  second: SecondAnswer | null;
  concept: { iri: string; label: string; confidence: number | null; hypernyms: string[] } | null;
  relations: RelationRecord[];
  /** All decisions about the object, oldest first. */
  history: HistoryEntry[];
  /** The statements about the object in Turtle, as of the last graph; empty before the first. */
  turtle: string;
}

export interface SecondAnswer {
  grounder: string;
  class: ClassIndex;
  confidence: number | null;
  explanation: string;
  /** Whether it is another class than the suggestion. */
  is_disputed: boolean;
}

export interface HistoryEntry {
  event: number;
  action: "decide" | "undo" | "redo";
  verdict: "open" | "class" | "no-class" | "unsure";
  class: ClassIndex;
  /** The concept, if the decision was about all its objects; else -1. */
  concept: ConceptIndex;
  /** Label of a subclass that was proposed; empty without one. */
  proposal: string;
  reviewer: string;
  time: string;
  comment: string;
}

export interface Candidate {
  class: ClassIndex;
  /** Share of the score among the candidates, from 0 to 1; null if the scores are unknown, as in a graph. */
  share: number | null;
  /** Path of the taxonomy from the class to its root, as labels. */
  taxonomy: string[];
  /** Empty for a graph, which does not state it. */
  evidence: CandidateEvidence[];
}

/** What one source says about one candidate. */
export interface CandidateEvidence {
  /** name, asset, labels, documentation, hierarchy, parts, neighbours, size, stance or place. */
  group: string;
  explanation: string;
  /** How well words match, or the share of the neighbours' votes, from 0 to 1; null for the other groups. */
  score: number | null;
  /** How much more probable the class is by the size, stance or place alone; null for the other groups. */
  likelihood_ratio: number | null;
}

export interface RelationRecord {
  kind: string;
  /** The object that is on, inside, near… */
  target: ObjectIndex;
  anchor: ObjectIndex;
  /** Path of the anchor, which may be a group prim and no object. */
  anchor_path: string;
  numbers: Record<string, number>;
  confidence: number | null;
  rule: string;
}

/** `GET /api/relations?kind=on`: all relations of one kind, by the current decisions. */
export interface RelationList {
  relations: RelationRecord[];
}

/** `GET /api/queue?order=gain`: what to review, in order. */
export interface Queue {
  groups: QueueGroup[];
  /** Objects without a decision. */
  open: number;
  decided: number;
  /** Pairs of reviewers with objects in common. */
  agreement: Agreement[];
  /** The random sample, whatever the order. */
  audit: Audit;
  /** Estimate for all open groups from this session's pace; null before five decisions. */
  seconds_left: number | null;
}

/** How often suggestions are right, by the verdicts on objects that were drawn at random. */
export interface Audit {
  /** Objects from which the sample is drawn. */
  population: number;
  sample: number;
  /** Those of the sample without a verdict. */
  waiting: number;
  unsure: number;
  /** Those whose class is settled. */
  judged: number;
  right: number;
  /** Wilson's 95 % interval of the share that is right; null if none is judged. */
  interval: [number, number] | null;
  /** Expected calibration error of the judged objects with a confidence; null without any. */
  calibration_error: number | null;
  with_confidence: number;
  /** Number of verdicts by which confidences in written files are calibrated; 0 if they are too few or do not allow it. */
  calibrated_on: number;
  /** Non-empty bins of confidence, lowest first; `accuracy` is the share that is right. */
  bins: { lower: number; upper: number; count: number; confidence: number; accuracy: number }[];
}

/** How far two reviewers agree about the objects that both decided. */
export interface Agreement {
  reviewers: [string, string];
  objects: number;
  same: number;
  /** Cohen's kappa; null if both gave all objects one verdict. */
  kappa: number | null;
}

/** Objects with the same suggestion, and the same asset or the same words in their names. */
export interface QueueGroup {
  /** Stable while its objects are undecided. */
  id: string;
  title: string;
  objects: ObjectIndex[];
  suggested: ClassIndex;
  concept: ConceptIndex;
  confidence: number | null;
  /** Expected number of wrong classes that a look at the group settles. */
  gain: number;
  /** With the order `disagreement`, whether the second grounder gives its objects another class. */
  is_disputed: boolean;
  /** The class by the second grounder, if it is disputed; else -1. */
  second: ClassIndex;
}

/** `disagreement` needs a second mapping. With `audit`, each waiting object of the random sample is a group, without its confidence. */
export type QueueOrder = "gain" | "confidence" | "class" | "place" | "audit" | "disagreement";

export type DecisionAction = "confirm" | "choose" | "unsure" | "no-class" | "clear";

/** Body of `POST /api/decisions`. */
export interface DecisionRequest {
  objects: ObjectIndex[];
  action: DecisionAction;
  /** For `choose`. */
  class?: ClassIndex;
  /** For `choose`: the concept of all these objects, which belongs to the class from now on, in other scenes too. */
  concept?: ConceptIndex;
  /** For `choose`: label of a subclass that the ontology lacks and the reviewer proposes. */
  proposal?: string;
  /** Whether the objects are of the random sample, and the decision counts for it. */
  audit?: boolean;
  comment?: string;
  reviewer: string;
  /** Number that tells this page from others, which hear of the decision by an event. */
  page: string;
  /** `States.version` that the reviewer saw; a later decision of somebody else on the same object is a conflict. */
  seen: number;
}

/** Answer to decisions, undo and redo (`POST /api/undo`, `/api/redo` with {reviewer, page}), sent once the journal is on disk. */
export interface DecisionReply {
  version: number;
  /** The objects whose state changed. */
  states: ObjectState[];
  can_undo: boolean;
  can_redo: boolean;
  outputs: Outputs;
  /** What happened, for the status line: “Confirmed 4 objects as Cup”. */
  message: string;
}

/** Lines of `GET /api/events` (text/event-stream, event `change`): decisions of all reviewers. */
export interface ChangeEvent {
  version: number;
  reviewer: string;
  /** The page that caused it. */
  page: string;
  states: ObjectState[];
  message: string;
  /** Whether `reviewer` can undo or redo now. */
  can_undo: boolean;
  can_redo: boolean;
}

/** The same stream, event `outputs`, has `Outputs`: the files have been written. */

/** The same stream, event `suggestions`: the open objects were grounded again, so all states have to be loaded. */
export interface SuggestionsEvent {
  reviewer: string;
  /** The page that caused it. */
  page: string;
}

/** `POST /api/ask` with {question}. */
export interface AskReply {
  understood: string;
  sentence: string;
  columns: string[];
  rows: (string | number | null)[][];
  /** Object of each row, -1 if the row names none. */
  objects: ObjectIndex[];
  is_cut: boolean;
}

/** `POST /api/sparql` with {query}: a table; errors are `ApiError`. */
export interface SparqlReply {
  columns: string[];
  rows: (string | null)[][];
  /** Object of each row, -1 if the row names none. */
  objects: ObjectIndex[];
  is_cut: boolean;
  milliseconds: number;
  /** A line for each name that the graph does not have. */
  hints: string[];
}

/** `GET /api/examples`: SPARQL queries about this scene. */
export interface ExampleQuery {
  title: string;
  query: string;
}

/** `GET /api/geometry`: the parts of the scene's meshes, the largest first; each is `GET /api/geometry/{index}.glb`. */
export interface GeometryManifest {
  /** Numbers of triangles are estimates; the meshes are read when they are asked for. */
  chunks: { triangles: number }[];
  triangles: number;
  /** Triangles before decimation. */
  source_triangles: number;
}
// In a chunk, each node with `extras.object` (an ObjectIndex, or -1 for geometry outside any object) has a mesh with
// positions, normals and vertex colours (linear RGBA); nodes of equal objects share one mesh. Coordinates are metres,
// z-up, without a root rotation. A primitive whose `extras` are a TextureUse has texture coordinates, too.

/** `GET /api/geometry/textures/{texture}` is the image, or nothing (204) where the vertex colours are shown instead. */
export interface TextureUse {
  texture: number;
  /** How it goes on beyond its borders along u and v: repeat, mirror, clamp, or others, which are drawn as repeat. */
  wrap: [string, string];
  /** Factor of its linear RGB. */
  scale: [number, number, number];
}

/** `POST /api/reground` with {reviewer, page}: ground the open objects again with what the decisions teach. */
export interface RegroundReply {
  version: number;
  states: ObjectState[];
  changes: { object: ObjectIndex; before: ClassIndex; after: ClassIndex; reason: string }[];
}

/** Every failed request: status 4xx or 5xx. */
export interface ApiError {
  error: string;
}
