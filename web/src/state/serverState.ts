/** What the page shares with the server: states, undo, files, and whether requests are answered and saved. */

import { batch, computed, signal } from "@preact/signals";
import { ApiFailure } from "../api/client";
import type {
  ChangeEvent,
  DecisionReply,
  ObjectIndex,
  ObjectState,
  Outputs,
  States,
  SuggestionsEvent,
} from "../api/types";
import { messageOf } from "./messages";
import { StateTable } from "./stateTable";
import type { Store } from "./store";

export type Saving = "saved" | "saving" | "failed" | "offline";

/** A key pressed so soon after the page has changed was meant for what it showed before. */
export const REACTION_MS = 800;

/** A change by another reviewer. */
interface Arrival {
  /** As `performance.now()`. */
  at: number;
  /** Version before it. */
  before: number;
  objects: ReadonlySet<ObjectIndex>;
}

/** A request whose answer was lost: it may be on disk or not. */
interface LostRequest {
  what: string;
  /** Version before it. */
  seen: number;
  /** The states that it leads to, as far as the page can tell. */
  expected: readonly ObjectState[];
}

export class ServerState {
  readonly table: StateTable;
  /** Version of the last change that this page has seen, its own or of others. */
  readonly version = signal(0);
  readonly canUndo = signal(false);
  readonly canRedo = signal(false);
  readonly outputs = signal<Outputs>({ folder: "", problem: "" });
  /** Counts how often the files were written: the graph has changed. */
  readonly written = signal(0);
  readonly isOffline = signal(false);
  /** Counts how often all was loaded again after a lost connection: what failed meanwhile is worth another try. */
  readonly connections = signal(0);
  private readonly unanswered = signal(0);
  /** Whether a decision was not saved since the last one was sent. */
  private readonly hasFailed = signal(false);
  readonly saving = computed<Saving>(() => {
    if (this.isOffline.value) return "offline";
    if (this.unanswered.value > 0) return "saving";
    return this.hasFailed.value ? "failed" : "saved";
  });
  /** Decisions, undo and redo reach the server in the order of the keys. */
  private lastSent: Promise<unknown> = Promise.resolve();
  private lost: LostRequest[] = [];
  private arrivals: Arrival[] = [];

  constructor(
    private readonly store: Pick<Store, "client" | "reviewer" | "page" | "notify" | "loadQueue" | "reportLoading">,
    states: States,
  ) {
    this.table = new StateTable(states.states, states.version);
    this.version.value = states.version;
    this.take(states);
  }

  /** Hears from the stream of changes whether it is connected; after a loss, all is loaded again. */
  setConnected(isConnected: boolean): void {
    if (!isConnected) this.isOffline.value = true;
    else if (this.isOffline.value) void this.reload();
  }

  /** Loads all states again, for another reviewer's undo or after a lost connection. */
  async reload(): Promise<void> {
    try {
      const query = encodeURIComponent(this.store.reviewer.value);
      const states = await this.store.client.get<States>(`states?reviewer=${query}`);
      // A change that arrived in the meantime is newer.
      if (states.version < this.version.value) return this.reload();
      batch(() => {
        this.table.reset(states.states, states.version);
        this.version.value = states.version;
        this.take(states);
        if (this.isOffline.value) this.connections.value++;
        this.isOffline.value = false;
        this.settle(states);
      });
      await this.store.loadQueue();
    } catch (error) {
      this.store.reportLoading(error);
    }
  }

  /** Finds which requests without an answer are on disk, and says which are not. */
  private settle({ states, version }: States): void {
    if (this.lost.length === 0) return;
    const isKnown = ({ object, state, class: index }: ObjectState) =>
      states[object]?.state === state && states[object]?.class === index;
    const unsaved = this.lost.filter(({ seen, expected }) => version <= seen || !expected.every(isKnown));
    this.lost = [];
    this.hasFailed.value = unsaved.length > 0;
    if (unsaved.length === 0) return;
    this.store.notify(
      `Not saved while the server did not answer: ${unsaved.map(({ what }) => what).join("; ")}`,
      "error",
    );
  }

  /** Sends what goes to the journal; returns null, after a message, if it is not known to be saved. */
  async send(
    path: string,
    body: unknown,
    what: string,
    expected: readonly ObjectState[],
  ): Promise<DecisionReply | null> {
    const seen = this.version.value;
    this.hasFailed.value = false;
    return this.waitFor(async () => {
      const sent = this.lastSent.then(() => this.store.client.post<DecisionReply>(path, body));
      this.lastSent = sent.catch(() => undefined);
      try {
        const reply = await sent;
        batch(() => {
          this.table.apply(reply.states, reply.version);
          this.take(reply);
        });
        if (this.isOffline.value) void this.reload();
        return reply;
      } catch (error) {
        this.hasFailed.value = true;
        if (hasNoAnswer(error)) this.lost.push({ what, seen, expected });
        this.fail(error, `Not saved: ${what} (${messageOf(error)})`);
        return null;
      }
    });
  }

  /** Counts a request as unanswered until it is done with. */
  async waitFor<T>(request: () => Promise<T>): Promise<T> {
    this.unanswered.value++;
    try {
      return await request();
    } finally {
      this.unanswered.value--;
    }
  }

  /** Says that a request has failed; what has no answer may have been done all the same, which only the server knows. */
  fail(error: unknown, text: string): void {
    this.store.notify(text, "error");
    if (!hasNoAnswer(error)) return;
    this.isOffline.value = true;
    void this.reload();
  }

  private take(reply: Pick<States, "can_undo" | "can_redo" | "outputs">): void {
    this.canUndo.value = reply.can_undo;
    this.canRedo.value = reply.can_redo;
    this.outputs.value = reply.outputs;
  }

  /** Returns the version of the last change that a person can have read about objects before deciding now. */
  seenOf(objects: readonly ObjectIndex[]): number {
    const unread = this.recentArrivals().filter((arrival) => objects.some((object) => arrival.objects.has(object)));
    return Math.min(this.version.value, ...unread.map(({ before }) => before));
  }

  private recentArrivals(): Arrival[] {
    return this.arrivals.filter(({ at }) => performance.now() - at < REACTION_MS);
  }

  /** Takes in a change that the server announces: of another page, or of this one, whose reply may be lost. */
  receive(change: ChangeEvent): void {
    if (change.version <= this.version.value) return;
    if (change.reviewer !== this.store.reviewer.value) {
      const objects = new Set(change.states.map(({ object }) => object));
      this.arrivals = [...this.recentArrivals(), { at: performance.now(), before: this.version.value, objects }];
    }
    batch(() => {
      this.table.apply(change.states, change.version);
      this.version.value = change.version;
      if (change.reviewer !== this.store.reviewer.value) return;
      this.canUndo.value = change.can_undo;
      this.canRedo.value = change.can_redo;
    });
    if (change.page === this.store.page) return;
    if (change.reviewer !== "") this.store.notify(`${change.reviewer}: ${change.message}`);
    void this.store.loadQueue(true);
  }

  /** Hears that the files have been written, the graph among them. */
  receiveOutputs(outputs: Outputs): void {
    batch(() => {
      this.outputs.value = outputs;
      this.written.value++;
    });
  }

  /** Loads the suggestions that another page has asked for. */
  receiveSuggestions({ reviewer, page }: SuggestionsEvent): void {
    if (page === this.store.page) return;
    this.store.notify(`${reviewer} has grounded the open objects again`);
    void this.reload();
  }
}

function hasNoAnswer(error: unknown): boolean {
  return error instanceof ApiFailure && error.status === 0;
}
