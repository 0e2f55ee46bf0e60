/** The state of the page, as signals, and the actions that change it. */

import { batch, computed, type Signal, signal } from "@preact/signals";
import { ApiFailure, type Client } from "../api/client";
import type {
  ChangeEvent,
  ClassIndex,
  DecisionAction,
  DecisionReply,
  ObjectIndex,
  ObjectState,
  Outputs,
  Queue,
  QueueGroup,
  QueueOrder,
  RegroundReply,
  SceneData,
  States,
} from "../api/types";
import type { ColorMode } from "./colors";
import { type Filters, filterObjects, isFiltering, NO_FILTERS } from "./filters";
import { buildModel, classLabel, type SceneModel } from "./model";
import { applyStates, isOpen, predictStates } from "./review";

export type Saving = "saved" | "saving" | "failed" | "offline";
export type Drawer = "review" | "ask" | "sparql" | "diagnostics" | "run";

export interface Notice {
  id: number;
  text: string;
  kind: "info" | "error";
}

const MAX_FRAMED = 200;
const REVIEWER = "usd2kg-reviewer";

export class Store {
  readonly model: SceneModel;
  readonly states: Signal<readonly ObjectState[]>;
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
  readonly colorMode = signal<ColorMode>("material");
  readonly answer = signal<ReadonlySet<ObjectIndex>>(new Set());
  readonly relationKinds = signal<ReadonlySet<string>>(new Set(["on", "inside", "attached-to", "part-of"]));

  readonly filters = signal<Filters>(NO_FILTERS);
  readonly drawer = signal<Drawer>("review");
  readonly isDrawerOpen = signal(true);
  readonly isHelpOpen = signal(false);
  readonly isClassSearchOpen = signal(false);
  readonly isBulkOpen = signal(false);

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
  /** What a decision applies to: the ticked members of the group, or else the selection. */
  readonly targets = computed<readonly ObjectIndex[]>(() => {
    const group = this.group.value;
    if (this.drawer.value === "review" && this.isDrawerOpen.value && group !== null) {
      return group.objects.filter((object) => !this.excluded.value.has(object));
    }
    return this.selection.value;
  });
  readonly decided = computed(() => this.states.value.filter((state) => !isOpen(state.state)).length);

  /** Objects that the picture shows next; null for all. */
  readonly lookAt = signal<readonly ObjectIndex[] | null>(null);

  private readonly page = crypto.randomUUID();
  private nextNotice = 1;

  constructor(
    readonly client: Client,
    data: SceneData,
    states: States,
    private readonly storage: Pick<Storage, "getItem" | "setItem">,
  ) {
    this.model = buildModel(data);
    this.states = signal(states.states);
    this.version.value = states.version;
    this.canUndo.value = states.can_undo;
    this.canRedo.value = states.can_redo;
    this.outputs.value = states.outputs;
    this.reviewer = signal(storage.getItem(REVIEWER) ?? data.reviewer);
  }

  setReviewer(name: string): void {
    const trimmed = name.trim();
    if (trimmed === "" || trimmed === this.reviewer.value) return;
    this.reviewer.value = trimmed;
    this.storage.setItem(REVIEWER, trimmed);
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

  select(objects: readonly ObjectIndex[], isAdding = false): void {
    if (!isAdding) {
      this.selection.value = objects;
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

  async loadQueue(): Promise<void> {
    try {
      this.queue.value = await this.client.get<Queue>(`queue?order=${this.order.value}`);
    } catch (error) {
      this.report(error);
    }
  }

  /** Loads all states again, for another reviewer's undo or after a lost connection. */
  async reload(): Promise<void> {
    try {
      const query = encodeURIComponent(this.reviewer.value);
      const states = await this.client.get<States>(`states?reviewer=${query}`);
      // A change that arrived in the meantime is newer.
      if (states.version < this.version.value) return this.reload();
      batch(() => {
        this.states.value = states.states;
        this.take(states);
      });
      await this.loadQueue();
    } catch (error) {
      this.report(error);
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

  /** Decides about objects; the page shows the result at once, and takes it back if the server refuses. */
  async decide(objects: readonly ObjectIndex[], action: DecisionAction, chosen?: ClassIndex): Promise<void> {
    if (objects.length === 0 || this.model.data.is_read_only) return;
    const { groups } = this;
    const current = this.group.value;
    const following = groups.value[groups.value.findIndex((group) => group.id === current?.id) + 1];
    const exception = current?.objects.find((object) => !objects.includes(object));
    const before = this.states.value;
    this.states.value = applyStates(before, predictStates(before, objects, action, chosen));
    const body = {
      objects,
      action,
      reviewer: this.reviewer.value,
      page: this.page,
      seen: this.version.value,
      ...(chosen === undefined ? {} : { class: chosen }),
    };
    const reply = await this.send("decisions", body, before);
    if (reply === null) return;
    this.notify(describe(this.model, reply, objects.length, action, chosen));
    await this.loadQueue();
    // The exceptions of a group come next, since the reviewer has just looked at them.
    const next =
      groups.value.find((group) => exception !== undefined && group.objects.includes(exception)) ??
      groups.value.find((group) => group.id === following?.id) ??
      groups.value[0];
    if (next !== undefined) this.goTo(next.id);
  }

  /** Grounds the open objects again with what the decisions teach, and lists what changed. */
  async groundAgain(): Promise<void> {
    this.saving.value = "saving";
    try {
      const body = { reviewer: this.reviewer.value, page: this.page };
      const reply = await this.client.post<RegroundReply>("reground", body);
      batch(() => {
        this.states.value = reply.states;
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
    const reply = await this.send(path, { reviewer: this.reviewer.value, page: this.page }, this.states.value);
    if (reply === null) return;
    const objects = reply.states.map((state) => state.object);
    this.notify(`${text}: ${objects.length} ${objects.length === 1 ? "object" : "objects"}`);
    await this.loadQueue();
    const back = this.groups.value.find((group) => group.objects.some((object) => objects.includes(object)));
    if (back !== undefined) this.goTo(back.id);
    else this.select(objects);
  }

  private async send(path: string, body: unknown, before: readonly ObjectState[]): Promise<DecisionReply | null> {
    this.saving.value = "saving";
    try {
      const reply = await this.client.post<DecisionReply>(path, body);
      batch(() => {
        this.states.value = applyStates(this.states.value, reply.states);
        this.take(reply);
        this.saving.value = "saved";
      });
      return reply;
    } catch (error) {
      this.states.value = before;
      this.saving.value = error instanceof ApiFailure && error.status === 0 ? "offline" : "failed";
      this.report(error);
      return null;
    }
  }

  private take(reply: Pick<States, "version" | "can_undo" | "can_redo" | "outputs">): void {
    this.version.value = Math.max(this.version.value, reply.version);
    this.canUndo.value = reply.can_undo;
    this.canRedo.value = reply.can_redo;
    this.outputs.value = reply.outputs;
  }

  /** Takes in a change that the server announces: of another reviewer, or of this page. */
  receive(change: ChangeEvent): void {
    if (change.version <= this.version.value || change.page === this.page) return;
    batch(() => {
      this.states.value = applyStates(this.states.value, change.states);
      this.version.value = change.version;
    });
    if (change.reviewer !== "") this.notify(`${change.reviewer}: ${change.message}`);
    void this.loadQueue();
  }

  report(error: unknown): void {
    this.notify(error instanceof Error ? error.message : String(error), "error");
  }
}

function describe(
  model: SceneModel,
  reply: DecisionReply,
  count: number,
  action: DecisionAction,
  chosen: ClassIndex | undefined,
): string {
  const things =
    count === 1 ? (model.data.objects.name[reply.states[0]?.object ?? -1] ?? "1 object") : `${count} objects`;
  const classes = new Set(reply.states.map((state) => state.class));
  const label = classLabel(model, chosen ?? reply.states[0]?.class ?? -1);
  switch (action) {
    case "confirm":
      return classes.size > 1 ? `Confirmed ${things} of ${classes.size} classes` : `Confirmed ${things} as ${label}`;
    case "choose":
      return `Set ${things} to ${label}`;
    case "unsure":
      return `Marked ${things} as unsure`;
    case "no-class":
      return `No class fits ${things}`;
    case "clear":
      return `Cleared ${things}`;
  }
}
