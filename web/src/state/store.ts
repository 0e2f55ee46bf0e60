/** The state of the page, as signals, and the actions that change it. */

import { batch, computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { ApiFailure, type Client } from "../api/client";
import type {
  ChangeEvent,
  ClassIndex,
  DecisionAction,
  DecisionReply,
  DecisionRequest,
  ObjectIndex,
  ObjectState,
  Outputs,
  Queue,
  QueueGroup,
  QueueOrder,
  RegroundReply,
  SceneData,
  States,
  SuggestionsEvent,
} from "../api/types";
import { isAuditOf } from "./audit";
import type { ColorMode } from "./colors";
import { type Filters, filterObjects, isFiltering, NO_FILTERS } from "./filters";
import { describeDecision } from "./messages";
import { buildModel, type SceneModel } from "./model";
import { findAgain, groupAfter, withoutObjects } from "./queue";
import { isOpen, predictStates, withoutSuggestion } from "./review";
import { storedReviewer, storeReviewer } from "./reviewer";
import { StateTable } from "./stateTable";

export type Saving = "saved" | "saving" | "failed" | "offline";
export type Drawer = "review" | "ask" | "sparql" | "diagnostics" | "run" | "compare";

/** What a decision says apart from class and objects. */
export type DecisionDetails = Pick<DecisionRequest, "concept" | "proposal" | "comment">;

interface Notice {
  id: number;
  text: string;
  kind: "info" | "error";
}

const MAX_FRAMED = 200;
/** A key pressed so soon after the queue moved by itself was meant for the group before. */
const MOVED_MS = 800;

export class Store {
  readonly model: SceneModel;
  readonly states: ReadonlySignal<readonly ObjectState[]>;
  /** Version of the last change that this page has seen, its own or of others. */
  readonly version = signal(0);
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);
  readonly outputs = signal<Outputs>({ folder: "", problem: "" });
  readonly saving = signal<Saving>("saved");
  readonly reviewer: Signal<string>;
  readonly notices = signal<readonly Notice[]>([]);

  readonly selection = signal<readonly ObjectIndex[]>([]);
  readonly hovered = signal<ObjectIndex>(-1);
  readonly isolated = signal<ReadonlySet<ObjectIndex> | null>(null);
  readonly isSeeThrough = signal(false);
  readonly isCutAway = signal(true);
  readonly hasLabels = signal(false);
  readonly cutShare = signal(1);
  /** By material at first; where nothing has one, that would be a grey picture. */
  readonly colorMode: Signal<ColorMode>;
  readonly answer = signal<ReadonlySet<ObjectIndex>>(new Set());
  readonly relationKinds = signal<ReadonlySet<string>>(new Set(["on", "inside", "next-to", "attached-to", "part-of"]));

  readonly filters = signal<Filters>(NO_FILTERS);
  readonly drawer = signal<Drawer>("review");
  readonly isDrawerOpen = signal(true);
  readonly isHelpOpen = signal(false);
  readonly isClassSearchOpen = signal(false);
  readonly isBulkOpen = signal(false);
  readonly isConceptOpen = signal(false);
  readonly isProposalOpen = signal(false);

  /** What grounding again has changed, while its list is open. */
  readonly changes = signal<RegroundReply["changes"] | null>(null);

  readonly queue = signal<Queue | null>(null);
  readonly order = signal<QueueOrder>("gain");
  readonly groupId = signal<string>("");
  /** Members of the current group that the next decision leaves out. */
  readonly excluded = signal<ReadonlySet<ObjectIndex>>(new Set());
  readonly member = signal(0);

  readonly shown = computed(() =>
    isFiltering(this.filters.value) ? new Set(filterObjects(this.model, this.states.value, this.filters.value)) : null,
  );
  /** The groups with at least one member that passes the filters. */
  readonly groups = computed<readonly QueueGroup[]>(() => {
    const shown = this.shown.value;
    const groups = this.queue.value?.groups ?? [];
    return shown === null ? groups : groups.filter((group) => group.objects.some((object) => shown.has(object)));
  });
  readonly group = computed<QueueGroup | null>(
    () => this.groups.value.find((group) => group.id === this.groupId.value) ?? this.groups.value[0] ?? null,
  );
  /** The ticked members of the current group. */
  readonly ticked = computed<readonly ObjectIndex[]>(
    () => this.group.value?.objects.filter((object) => !this.excluded.value.has(object)) ?? [],
  );
  /** Whether the keys decide about the group, not about something selected outside it. */
  readonly isGroupInFocus = computed(() => {
    const group = this.group.value;
    const selected = this.selection.value.at(-1);
    if (this.drawer.value !== "review" || !this.isDrawerOpen.value || group === null) return false;
    return selected === undefined || group.objects.includes(selected);
  });
  /** What a key decides about: the ticked members of the group, or else the selection. */
  readonly targets = computed<readonly ObjectIndex[]>(() =>
    this.isGroupInFocus.value ? this.ticked.value : this.selection.value,
  );
  readonly decided = computed(() => this.states.value.filter((state) => !isOpen(state.state)).length);

  /** Objects that the picture shows next; null for all. */
  readonly lookAt = signal<readonly ObjectIndex[] | null>(null);

  private readonly page = randomId();
  private readonly table: StateTable;
  private nextNotice = 1;
  private queueRequests = 0;
  /** When the queue last moved by itself, as `performance.now()`. */
  private movedAt = Number.NEGATIVE_INFINITY;
  /** Decisions, undo and redo reach the server in the order of the keys. */
  private lastSent: Promise<unknown> = Promise.resolve();
  private unanswered = 0;

  constructor(
    readonly client: Client,
    data: SceneData,
    states: States,
    private readonly storage: Pick<Storage, "getItem" | "setItem">,
  ) {
    this.model = buildModel(data);
    this.table = new StateTable(states.states, states.version);
    this.states = this.table.shown;
    this.version.value = states.version;
    this.canUndo.value = states.can_undo;
    this.canRedo.value = states.can_redo;
    this.outputs.value = states.outputs;
    this.reviewer = signal(storedReviewer(storage) ?? data.reviewer);
    this.colorMode = signal(data.has_colors ? "material" : "class");
  }

  setReviewer(name: string): void {
    const trimmed = name.trim();
    if (trimmed === "" || trimmed === this.reviewer.value) return;
    this.reviewer.value = trimmed;
    storeReviewer(trimmed, this.storage);
    void this.reload();
  }

  notify(text: string, kind: Notice["kind"] = "info"): void {
    const notice = { id: this.nextNotice++, text, kind };
    this.notices.value = [...this.notices.value.slice(-3), notice];
    setTimeout(() => this.dismiss(notice.id), kind === "error" ? 12000 : 4000);
  }

  dismiss(id: number): void {
    this.notices.value = this.notices.value.filter((notice) => notice.id !== id);
  }

  /** Selects objects; one of the group under review becomes its current member. */
  select(objects: readonly ObjectIndex[], isAdding = false): void {
    if (!isAdding) {
      const member = objects.length === 1 ? (this.group.value?.objects.indexOf(objects[0] as ObjectIndex) ?? -1) : -1;
      batch(() => {
        this.selection.value = objects;
        if (member >= 0) this.member.value = member;
      });
      return;
    }
    const known = new Set(this.selection.value);
    for (const object of objects) {
      if (known.has(object)) known.delete(object);
      else known.add(object);
    }
    this.selection.value = [...known];
  }

  // Review.

  /** Loads the queue; returns false if a later request has taken over. */
  async loadQueue(isFromOthers = false): Promise<boolean> {
    const request = ++this.queueRequests;
    try {
      const queue = await this.client.get<Queue>(`queue?order=${this.order.value}`);
      if (request !== this.queueRequests) return false;
      this.showQueue(withoutObjects(queue, this.table.waiting()), isFromOthers);
    } catch (error) {
      this.report(error);
    }
    return true;
  }

  /** Shows a new queue, and stays in the current group if it is still there. */
  private showQueue(queue: Queue, isFromOthers: boolean): void {
    const before = this.group.value;
    const following = before === null ? null : groupAfter(this.groups.value, before, new Set(before.objects));
    batch(() => {
      this.queue.value = queue;
      if (before === null || this.groupId.value === "") return;
      const again = findAgain(this.groups.value, before);
      if (again !== null) {
        this.groupId.value = again.id;
        return;
      }
      if (isFromOthers) this.movedAt = performance.now();
      const next = following === null ? null : findAgain(this.groups.value, following);
      this.goTo((next ?? this.groups.value[0])?.id ?? "");
    });
  }

  /** Loads all states again, for another reviewer's undo or after a lost connection. */
  async reload(): Promise<void> {
    try {
      const query = encodeURIComponent(this.reviewer.value);
      const states = await this.client.get<States>(`states?reviewer=${query}`);
      // A change that arrived in the meantime is newer.
      if (states.version < this.version.value) return this.reload();
      batch(() => {
        this.table.reset(states.states, states.version);
        this.version.value = states.version;
        this.take(states);
        if (this.saving.value === "offline") this.saving.value = "saved";
      });
      await this.loadQueue();
    } catch (error) {
      // While the page is offline, the status line says so, and the stream of changes tries again.
      if (this.saving.value !== "offline") this.report(error);
    }
  }

  goTo(id: string): void {
    batch(() => {
      this.groupId.value = id;
      this.excluded.value = new Set();
      this.member.value = 0;
      this.selection.value = this.groups.value.find((group) => group.id === id)?.objects ?? [];
      this.lookAt.value = this.selection.value.slice(0, MAX_FRAMED);
    });
  }

  /** Moves in the queue: 1 to the next group, -1 to the one before. */
  step(by: number): void {
    const groups = this.groups.value;
    const current = groups.findIndex((group) => group.id === this.group.value?.id);
    const next = groups[Math.min(Math.max(current + by, 0), groups.length - 1)];
    if (next !== undefined) this.goTo(next.id);
  }

  toggleMember(object: ObjectIndex): void {
    const excluded = new Set(this.excluded.value);
    if (!excluded.delete(object)) excluded.add(object);
    this.excluded.value = excluded;
  }

  /**
   * Decides about objects. The page shows the result and the next group at once; if the server refuses, it takes both
   * back.
   */
  async decide(
    objects: readonly ObjectIndex[],
    action: DecisionAction,
    chosen?: ClassIndex,
    details: DecisionDetails = {},
  ): Promise<void> {
    if (objects.length === 0 || this.hasJustMoved()) return;
    const without = action === "confirm" ? withoutSuggestion(this.states.value, objects) : [];
    if (without.length > 0) {
      const which = objects.length === 1 ? "" : `${without.length} of ${objects.length} objects: `;
      this.notify(`${which}no suggestion to confirm. Choose a class with /`);
      return;
    }
    const forget = this.table.expect(predictStates(this.states.value, objects, action, chosen));
    const { seen, group } = { seen: this.version.value, group: this.group.value };
    const isAudit = isAuditOf(this, objects, action, details);
    if (action !== "clear") this.moveOn(objects);
    const reply = await this.send("decisions", {
      objects,
      action,
      reviewer: this.reviewer.value,
      page: this.page,
      seen,
      ...(chosen === undefined ? {} : { class: chosen }),
      ...details,
      ...(isAudit ? { audit: true } : {}),
    });
    forget();
    if (reply !== null) this.notify(describeDecision(this.model, reply, objects.length, action, chosen, details));
    await this.loadQueue();
    const again = reply === null && group !== null ? findAgain(this.groups.value, group) : null;
    if (again !== null) this.goTo(again.id);
  }

  /** Tells the reviewer, once, that the keys now decide about another group. */
  private hasJustMoved(): boolean {
    if (performance.now() - this.movedAt > MOVED_MS) return false;
    this.movedAt = Number.NEGATIVE_INFINITY;
    this.notify(
      "Another reviewer has decided the group before this one. Press the key again to decide about this one.",
    );
    return true;
  }

  /** Takes decided objects out of the queue, and goes to the exceptions of their group or the next one. */
  private moveOn(objects: readonly ObjectIndex[]): void {
    const current = this.group.value;
    const decided = new Set(objects);
    const isInGroup = current?.objects.some((object) => decided.has(object)) === true;
    const next = isInGroup ? groupAfter(this.groups.value, current, decided) : current;
    batch(() => {
      if (this.queue.value !== null) this.queue.value = withoutObjects(this.queue.value, decided);
      if (isInGroup) this.goTo(next?.id ?? "");
    });
  }

  /** Grounds the open objects again with what the decisions teach, and lists what changed. */
  async groundAgain(): Promise<void> {
    const { reground } = this.model.data.limits;
    if (reground !== undefined) {
      this.notify(reground);
      return;
    }
    this.saving.value = "saving";
    try {
      const body = { reviewer: this.reviewer.value, page: this.page };
      const reply = await this.client.post<RegroundReply>("reground", body);
      batch(() => {
        this.table.reset(reply.states, reply.version);
        this.changes.value = reply.changes;
        this.saving.value = "saved";
      });
      await this.loadQueue();
    } catch (error) {
      this.saving.value = "saved";
      this.report(error);
    }
  }

  async undo(): Promise<void> {
    await this.revert("undo", "Undone");
  }

  async redo(): Promise<void> {
    await this.revert("redo", "Done again");
  }

  private async revert(path: "undo" | "redo", text: string): Promise<void> {
    const reply = await this.send(path, { reviewer: this.reviewer.value, page: this.page });
    if (reply === null) return;
    const objects = reply.states.map((state) => state.object);
    this.notify(`${text}: ${objects.length} ${objects.length === 1 ? "object" : "objects"}`);
    // The last of several undos decides which group is shown.
    if (!(await this.loadQueue())) return;
    const back = this.groups.value.find((group) => group.objects.some((object) => objects.includes(object)));
    if (back !== undefined) this.goTo(back.id);
    else this.select(objects);
  }

  private async send(path: string, body: unknown): Promise<DecisionReply | null> {
    this.saving.value = "saving";
    this.unanswered++;
    const sent = this.lastSent.then(() => this.client.post<DecisionReply>(path, body));
    this.lastSent = sent.catch(() => undefined);
    try {
      const reply = await sent;
      batch(() => {
        this.table.apply(reply.states, reply.version);
        this.take(reply);
        if (this.unanswered === 1 && this.saving.value === "saving") this.saving.value = "saved";
      });
      return reply;
    } catch (error) {
      const isOffline = error instanceof ApiFailure && error.status === 0;
      this.saving.value = isOffline ? "offline" : "failed";
      this.report(error);
      // The decision may be on disk all the same; only the server knows.
      if (isOffline) void this.reload();
      return null;
    } finally {
      this.unanswered--;
    }
  }

  private take(reply: Pick<States, "can_undo" | "can_redo" | "outputs">): void {
    this.canUndo.value = reply.can_undo;
    this.canRedo.value = reply.can_redo;
    this.outputs.value = reply.outputs;
  }

  /** Takes in a change that the server announces: of another page, or of this one, whose reply may be lost. */
  receive(change: ChangeEvent): void {
    if (change.version <= this.version.value) return;
    batch(() => {
      this.table.apply(change.states, change.version);
      this.version.value = change.version;
    });
    if (change.page === this.page) return;
    if (change.reviewer !== "") this.notify(`${change.reviewer}: ${change.message}`);
    void this.loadQueue(true);
  }

  /** Loads the suggestions that another page has asked for. */
  receiveSuggestions({ reviewer, page }: SuggestionsEvent): void {
    if (page === this.page) return;
    this.notify(`${reviewer} has grounded the open objects again`);
    void this.reload();
  }

  report(error: unknown): void {
    this.notify(error instanceof Error ? error.message : String(error), "error");
  }
}

/** Returns a random name; `crypto.randomUUID` is missing where the page comes over plain HTTP from another machine. */
function randomId(): string {
  return Array.from(crypto.getRandomValues(new Uint32Array(4)), (part) => part.toString(16).padStart(8, "0")).join("");
}
