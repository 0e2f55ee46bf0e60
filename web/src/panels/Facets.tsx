/** Facets: the states, confidences, concepts and rooms of the objects, to filter by. */

import type { ReviewState } from "../api/types";
import { isAuditing } from "../state/audit";
import { STATE_LABELS } from "../state/colors";
import { countBy, type Filters } from "../state/filters";
import { conceptLabel } from "../state/model";
import type { Store } from "../state/store";
import { StateIcon } from "./StateBadge";

const MAX_VALUES = 200;

export function Facets({ store }: { store: Store }) {
  const { model, filters } = store;
  const states = store.states.value;
  const set = (change: Partial<Filters>) => (filters.value = { ...filters.value, ...change });
  const toggleState = (state: ReviewState) => {
    const chosen = new Set(filters.value.states);
    if (!chosen.delete(state)) chosen.add(state);
    set({ states: chosen });
  };
  return (
    <div class="facets">
      <h3>State</h3>
      {countBy(states, (state) => state.state).map(([state, count]) => (
        <label key={state} class="facet">
          <input type="checkbox" checked={filters.value.states.has(state)} onChange={() => toggleState(state)} />
          <StateIcon state={state} />
          <span class="name">{STATE_LABELS[state]}</span>
          <span class="count">{count}</span>
        </label>
      ))}
      {!isAuditing(store) && <Confidence store={store} />}
      <Values
        title="Room"
        values={countBy(states, (state) => model.data.objects.room[state.object] ?? -1)}
        chosen={filters.value.room}
        label={(room) => model.data.objects.rooms[room] ?? "no room"}
        onChoose={(room) => set({ room })}
      />
      <Values
        title="Concept"
        values={countBy(states, (state) => state.concept)}
        chosen={filters.value.concept}
        label={(concept) => conceptLabel(model, concept)}
        onChoose={(concept) => set({ concept })}
      />
    </div>
  );
}

function Confidence({ store }: { store: Store }) {
  const { filters, states } = store;
  const [least, most] = filters.value.confidence;
  const set = (from: number, to: number) => {
    filters.value = { ...filters.value, confidence: [from, to] };
  };
  return (
    <>
      <h3>Confidence</h3>
      <Histogram values={states.value.map((state) => state.confidence ?? 0)} least={least} most={most} />
      <div class="range">
        <label>
          from {least.toFixed(2)}
          <input
            type="range"
            min="0"
            max="1"
            step="0.05"
            value={least}
            onInput={(event) => set(Math.min(event.currentTarget.valueAsNumber, most), most)}
          />
        </label>
        <label>
          to {most.toFixed(2)}
          <input
            type="range"
            min="0"
            max="1"
            step="0.05"
            value={most}
            onInput={(event) => set(least, Math.max(event.currentTarget.valueAsNumber, least))}
          />
        </label>
      </div>
    </>
  );
}

interface ValuesProps {
  title: string;
  values: [number, number][];
  chosen: number;
  label(value: number): string;
  onChoose(value: number): void;
}

function Values({ title, values, chosen, label, onChoose }: ValuesProps) {
  const known = values.filter(([value]) => value >= 0);
  if (known.length === 0) return null;
  return (
    <>
      <h3>{title}</h3>
      {known.slice(0, MAX_VALUES).map(([value, count]) => (
        <button
          key={value}
          type="button"
          class="facet"
          aria-pressed={value === chosen}
          onClick={() => onChoose(value === chosen ? -1 : value)}
        >
          <span class="name">{label(value)}</span>
          <span class="count">{count}</span>
        </button>
      ))}
    </>
  );
}

const BINS = 20;

function Histogram({ values, least, most }: { values: number[]; least: number; most: number }) {
  const bins: number[] = new Array(BINS).fill(0);
  for (const value of values) {
    const bin = Math.min(BINS - 1, Math.floor(value * BINS));
    bins[bin] = (bins[bin] ?? 0) + 1;
  }
  const top = Math.max(1, ...bins);
  return (
    <svg class="histogram" viewBox={`0 0 ${BINS * 10} 40`} preserveAspectRatio="none" aria-hidden="true">
      {bins.map((count, bin) => {
        const isIn = (bin + 1) / BINS > least && bin / BINS < most;
        // Square roots keep small bins visible beside large ones.
        const height = 40 * Math.sqrt(count / top);
        const key = bin / BINS;
        return <rect key={key} class={isIn ? "in" : ""} x={bin * 10} y={40 - height} width="8" height={height} />;
      })}
    </svg>
  );
}
