/** The states of all objects, from replies and events that arrive in any order, and from decisions not yet answered. */

import { computed, type ReadonlySignal, type Signal, signal } from "@preact/signals";
import type { ObjectIndex, ObjectState } from "../api/types";
import { applyStates } from "./review";

export class StateTable {
  /** The states to show: what the server has said, then what it is expected to say. */
  readonly shown: ReadonlySignal<readonly ObjectState[]>;
  /** The objects with a decision that the server has not answered. */
  readonly waiting: ReadonlySignal<ReadonlySet<ObjectIndex>>;
  private readonly known: Signal<readonly ObjectState[]>;
  private readonly expected = signal<readonly (readonly ObjectState[])[]>([]);
  /** Version of each object's known state, where it is not that of the whole table. */
  private readonly versions = new Map<ObjectIndex, number>();

  constructor(
    states: readonly ObjectState[],
    private version: number,
  ) {
    this.known = signal(states);
    this.shown = computed(() => this.expected.value.reduce(applyStates, this.known.value));
    this.waiting = computed(() => new Set(this.expected.value.flat().map(({ object }) => object)));
  }

  /** Replaces all states by those of a version. */
  reset(states: readonly ObjectState[], version: number): void {
    this.versions.clear();
    this.version = version;
    this.known.value = states;
  }

  /** Takes in states of a version; an object whose known state is newer keeps it. */
  apply(states: readonly ObjectState[], version: number): void {
    const newer = states.filter(({ object }) => (this.versions.get(object) ?? this.version) <= version);
    for (const { object } of newer) this.versions.set(object, version);
    this.known.value = applyStates(this.known.value, newer);
  }

  /** Shows states before the server has answered; the function that is returned stops that. */
  expect(states: readonly ObjectState[]): () => void {
    this.expected.value = [...this.expected.value, states];
    return () => {
      this.expected.value = this.expected.value.filter((each) => each !== states);
    };
  }
}
