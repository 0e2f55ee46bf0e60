/** The state of the page, as signals, and the actions that change it. */

import { batch, computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { Client } from "../api/client";
import type {
  ClassIndex,
  DecisionAction,
  DecisionRequest,
  ObjectIndex,
  ObjectState,
  Queue,
  QueueGroup,
  QueueOrder,
  RegroundReply,
  SceneData,
  States,
} from "../api/types";
import { isAuditing, isAuditOf } from "./audit";
import type { ColorMode } from "./colors";
import { type Filters, filterObjects, isFiltering, NO_FILTERS } from "./filters";
import { describeDecision, messageOf, nameObjects } from "./messages";
import { buildModel, type SceneModel } from "./model";
import { findAgain, groupAfter, restrictGroups, withoutObjects } from "./queue";
import { isOpen, predictStates, withoutSuggestion } from "./review";
import { keepReviewer, type NameStorage, storedReviewer, storeReviewer } from "./reviewer";
import { REACTION_MS, ServerState } from "./serverState";

export type Drawer = "review" | "ask" | "sparql" | "diagnostics" | "run" | "compare";

/** What a decision says apart from class and objects. */
export type DecisionDetails = Pick<DecisionRequest, "concept" | "proposal" | "comment">;

interface Notice {
  id: number;
  text: string;
  kind: "info" | "error";
}

const MAX_FRAMED = 200;

export class Store {
  readonly model: SceneModel;
  readonly server: ServerState;
  readonly states: ReadonlySignal<readonly ObjectState[]>;
  readonly reviewer: Signal<string>;
  readonly notices = signal<readonly Notice[]>([]);

  /** What is selected by itself; null where the group under review is selected, however it changes. */
  private readonly picked = signal<readonly ObjectIndex[] | null>([]);
  readonly selection = computed<readonly ObjectIndex[]>(() => this.picked.value ?? this.group.value?.objects ?? []);
  readonly hovered = signal<ObjectIndex>(-1);
  readonly isolated = signal<ReadonlySet<ObjectIndex> | null>(null);
  readonly isSeeThrough = signal(false);
  readonly isCutAway = signal(true);
  readonly hasLabels = signal(false);
  readonly cutShare = signal(1);
  /** By material at first; where nothing has one, that would be a grey picture. */
  readonly colorMode: Signal<ColorMode>;
  /** The colours that are shown: an audit hides confidences. */
  readonly shownColors = computed<ColorMode>(() =>
    isAuditing(this) && this.colorMode.value === "confidence" ? "class" : this.colorMode.value,
  );
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

  /** As the server said last, without what it has answered since. */
  readonly queue = signal<Queue | null>(null);
  readonly order = signal<QueueOrder>("gain");
  readonly groupId = signal<string>("");
  /** Members of the current group that the next decision leaves out. */
  readonly excluded = signal<ReadonlySet<ObjectIndex>>(new Set());
  private readonly focused = signal<ObjectIndex>(-1);
  /** Place of the current member in the group: that of the focused object, or the first. */
  readonly member = computed(() => Math.max(0, this.group.value?.objects.indexOf(this.focused.value) ?? 0));

  /** The objects that pass the filters; null for all. An audit hides confidences, and so does not filter by them. */
  readonly shown = computed<ReadonlySet<ObjectIndex> | null>(() => {
    const { confidence } = isAuditing(this) ? NO_FILTERS : this.filters.value;
    const filters = { ...this.filters.value, confidence };
    return isFiltering(filters) ? new Set(filterObjects(this.model, this.states.value, filters)) : null;
  });
  /** The groups without what is decided and not answered yet; they come back if the server refuses. */
  readonly openGroups = computed<readonly QueueGroup[]>(() => {
    const waiting = this.server.table.waiting.value;
    const groups = this.queue.value?.groups ?? [];
    return waiting.size === 0 ? groups : restrictGroups(groups, (object) => !waiting.has(object));
  });
  /** The open groups, each with the members that pass the filters. */
  readonly groups = computed<readonly QueueGroup[]>(() => {
    const shown = this.shown.value;
    return shown === null ? this.openGroups.value : restrictGroups(this.openGroups.value, (each) => shown.has(each));
  });
  readonly group = computed<QueueGroup | null>(
    () => this.groups.value.find((group) => group.id === this.groupId.value) ?? this.groups.value[0] ?? null,
  );
  /** All open members of the current group, whatever the filters. */
  private readonly members = computed<readonly ObjectIndex[]>(
    () => this.openGroups.value.find((group) => group.id === this.group.value?.id)?.objects ?? [],
  );
  /** Number of members of the current group that the filters hide. */
  readonly hiddenMembers = computed(() => this.members.value.length - (this.group.value?.objects.length ?? 0));
  /** The ticked members of the current group. */
  readonly ticked = computed<readonly ObjectIndex[]>(
    () => this.group.value?.objects.filter((object) => !this.excluded.value.has(object)) ?? [],
  );
  /** Whether the keys decide about the group, not about something selected outside it. */
  readonly isGroupInFocus = computed(() => {
    const selected = this.selection.value.at(-1);
    if (this.drawer.value !== "review" || !this.isDrawerOpen.value || this.group.value === null) return false;
    return selected === undefined || this.members.value.includes(selected);
  });
  /** What a key decides about: the ticked members of the group, or else the selection. */
  readonly targets = computed<readonly ObjectIndex[]>(() =>
    this.isGroupInFocus.value ? this.ticked.value : this.selection.value,
  );
  readonly decided = computed(() => this.states.value.filter((state) => !isOpen(state.state)).length);

  /** Objects that the picture shows next; null for all. */
  readonly lookAt = signal<readonly ObjectIndex[] | null>(null);

  /** Name of this page, by which it knows its own changes among those that the server announces. */
  readonly page = randomId();
  private nextNotice = 1;
  private queueRequests = 0;
  /** When the queue last moved by itself, as `performance.now()`, and why. */
  private moved = { at: Number.NEGATIVE_INFINITY, why: "" };

  constructor(
    readonly client: Client,
    data: SceneData,
    states: States,
    private readonly storage: NameStorage,
  ) {
    this.model = buildModel(data);
    this.server = new ServerState(this, states);
    this.states = this.server.table.shown;
    this.reviewer = signal(storedReviewer(storage) ?? data.reviewer);
    keepReviewer(this.reviewer.value, storage);
    this.colorMode = signal(data.has_colors ? "material" : "class");
  }

  setReviewer(name: string): void {
    const trimmed = name.trim();
    if (trimmed === "" || trimmed === this.reviewer.value) return;
    this.reviewer.value = trimmed;
    storeReviewer(trimmed, this.storage);
    void this.server.reload();
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
      const [object] = objects;
      const isMember = object !== undefined && objects.length === 1 && this.group.value?.objects.includes(object);
      batch(() => {
        this.picked.value = objects;
        if (isMember === true) this.focused.value = object;
      });
      return;
    }
    const known = new Set(this.selection.value);
    for (const object of objects) {
      if (known.has(object)) known.delete(object);
      else known.add(object);
    }
    this.picked.value = [...known];
  }

  /** Makes a member the current one, without selecting it. */
  focus(member: ObjectIndex): void {
    this.focused.value = member;
  }

  /** Looks at objects; where others are isolated, these are from now on. */
  show(objects: readonly ObjectIndex[]): void {
    batch(() => {
      this.lookAt.value = objects.slice(0, MAX_FRAMED);
      if (this.isolated.value !== null) this.isolated.value = objects.length === 0 ? null : new Set(objects);
    });
  }

  // Review.

  /** Loads the queue; returns false if a later request has taken over. */
  async loadQueue(isFromOthers = false): Promise<boolean> {
    const request = ++this.queueRequests;
    try {
      const queue = await this.client.get<Queue>(`queue?order=${this.order.value}`);
      if (request !== this.queueRequests) return false;
      this.showQueue(queue, isFromOthers);
    } catch (error) {
      this.reportLoading(error);
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
      if (isFromOthers) this.moved = { at: performance.now(), why: "Another reviewer has decided the group before." };
      const next = following === null ? null : findAgain(this.groups.value, following);
      this.goTo((next ?? this.groups.value[0])?.id ?? "");
    });
  }

  goTo(id: string): void {
    batch(() => {
      this.groupId.value = id;
      this.excluded.value = new Set();
      this.focused.value = -1;
      this.picked.value = null;
      this.show(this.selection.value);
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
    const body = {
      objects,
      action,
      reviewer: this.reviewer.value,
      page: this.page,
      seen: this.server.seenOf(objects),
      ...(chosen === undefined ? {} : { class: chosen }),
      ...details,
      ...(isAuditOf(this, objects, action, details) ? { audit: true } : {}),
    };
    const expected = predictStates(this.states.value, objects, action, chosen);
    const decided = new Set(action === "clear" ? [] : objects);
    const { forget, goBack } = batch(() => this.anticipate(decided, expected));
    const reply = await this.server.send("decisions", body, nameObjects(this.model, objects), expected);
    batch(() => {
      if (reply !== null && this.queue.value !== null) this.queue.value = withoutObjects(this.queue.value, decided);
      forget();
      if (reply === null) goBack();
      else this.notify(describeDecision(this.model, reply, objects.length, action, chosen, details));
    });
    await this.loadQueue();
  }

  /** Tells the reviewer, once, that the keys now decide about another group. */
  private hasJustMoved(): boolean {
    if (performance.now() - this.moved.at > REACTION_MS) return false;
    this.moved.at = Number.NEGATIVE_INFINITY;
    this.notify(`${this.moved.why} Press the key again to decide about this one.`);
    return true;
  }

  /**
   * Shows what a decision will lead to, and goes to what it leaves of the current group or to the next one. Returns what
   * forgets the prediction, and then the way back.
   */
  private anticipate(
    decided: ReadonlySet<ObjectIndex>,
    expected: readonly ObjectState[],
  ): { forget(): void; goBack(): void } {
    const [current, excluded] = [this.group.value, this.excluded.value];
    const isInGroup = current?.objects.some((object) => decided.has(object)) === true;
    const next = isInGroup ? groupAfter(this.groups.value, current, decided) : null;
    const forget = this.server.table.expect(expected);
    if (isInGroup) this.goTo(next?.id ?? "");
    const goBack = () => {
      const again = isInGroup ? findAgain(this.groups.value, current) : null;
      if (again === null) return;
      this.goTo(again.id);
      this.excluded.value = excluded;
      this.moved = { at: performance.now(), why: "The decision about this group was not saved." };
    };
    return { forget, goBack };
  }

  /** Grounds the open objects again with what the decisions teach, and lists what changed. */
  async groundAgain(): Promise<void> {
    const { reground } = this.model.data.limits;
    if (reground !== undefined) {
      this.notify(reground);
      return;
    }
    await this.server.waitFor(async () => {
      try {
        const body = { reviewer: this.reviewer.value, page: this.page };
        const reply = await this.client.post<RegroundReply>("reground", body);
        batch(() => {
          this.server.table.reset(reply.states, reply.version);
          this.changes.value = reply.changes;
        });
        await this.loadQueue();
      } catch (error) {
        this.server.fail(error, messageOf(error));
      }
    });
  }

  async undo(): Promise<void> {
    await this.revert("undo", "Undone");
  }

  async redo(): Promise<void> {
    await this.revert("redo", "Done again");
  }

  private async revert(path: "undo" | "redo", text: string): Promise<void> {
    const reply = await this.server.send(path, { reviewer: this.reviewer.value, page: this.page }, path, []);
    if (reply === null) return;
    const objects = reply.states.map((state) => state.object);
    this.notify(`${text}: ${objects.length} ${objects.length === 1 ? "object" : "objects"}`);
    // The last of several undos decides which group is shown.
    if (!(await this.loadQueue())) return;
    const back = this.groups.value.find((group) => group.objects.some((object) => objects.includes(object)));
    if (back !== undefined) this.goTo(back.id);
    else this.select(objects);
  }

  /** Reports what could not be loaded; while the page is offline, the status line says so, and all is loaded again. */
  reportLoading(error: unknown): void {
    if (!this.server.isOffline.value) this.report(error);
  }

  report(error: unknown): void {
    this.notify(messageOf(error), "error");
  }
}

/** Returns a random name; `crypto.randomUUID` is missing where the page comes over plain HTTP from another machine. */
function randomId(): string {
  return Array.from(crypto.getRandomValues(new Uint32Array(4)), (part) => part.toString(16).padStart(8, "0")).join("");
}
