/** Compare: what appeared, disappeared and changed since another version; a row selects its object. */

import { useId } from "preact/hooks";
import type { ChangeKind, Comparison, SceneChange } from "../api/comparison";
import { CHANGES, type ComparisonState, changeTexts, comparisonOf } from "../state/comparison";
import type { Store } from "../state/store";
import { VirtualList } from "./VirtualList";

const ROW_HEIGHT = 44;

export function Compare({ store }: { store: Store }) {
  const comparison = comparisonOf(store);
  const data = comparison.data.value;
  if (data === null) return <p class="empty">Comparing…</p>;
  return (
    <div class="compare">
      <header>
        <p>
          Changes from <strong title={data.other}>{data.other.replace(/^.*[/\\]/, "")}</strong>, a {data.source}:{" "}
          {data.changes.length} of {data.changes.length + data.unchanged} objects
        </p>
        <Kinds comparison={comparison} data={data} />
        {store.colorMode.value !== "change" && (
          <button type="button" onClick={() => (store.colorMode.value = "change")}>
            Color by change
          </button>
        )}
        {data.notes.map((note) => (
          <p key={note} class="note">
            {note}
          </p>
        ))}
      </header>
      <Changes store={store} comparison={comparison} data={data} />
    </div>
  );
}

function Kinds({ comparison, data }: { comparison: ComparisonState; data: Comparison }) {
  const { hidden } = comparison;
  return (
    <fieldset class="group" aria-label="Kinds of change">
      {CHANGES.filter(({ kind }) => data.counts[kind] !== undefined).map(({ kind, label }) => (
        <button
          key={kind}
          type="button"
          title="Show or hide; double-click shows it alone"
          aria-pressed={!hidden.value.has(kind)}
          onClick={() => comparison.toggle(kind)}
          onDblClick={() => comparison.only(kind)}
        >
          <Swatch kind={kind} />
          {label} <span class="count">{data.counts[kind]}</span>
        </button>
      ))}
    </fieldset>
  );
}

function Swatch({ kind }: { kind: ChangeKind | undefined }) {
  return <span class={`swatch change-${kind}`} aria-hidden="true" />;
}

function Changes({ store, comparison, data }: { store: Store; comparison: ComparisonState; data: Comparison }) {
  const id = useId();
  const rows = comparison.rows.value;
  const focused = comparison.focused.value;
  const current = focused === null ? -1 : rows.indexOf(focused);
  if (rows.length === 0) {
    return <p class="empty">{data.changes.length === 0 ? "Nothing has changed." : "Nothing matches the filter."}</p>;
  }
  const go = (index: number) => {
    const change = rows[Math.min(Math.max(index, 0), rows.length - 1)];
    if (change !== undefined) comparison.look(change);
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === "ArrowDown") go(current + 1);
    else if (event.key === "ArrowUp") go(current - 1);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(rows.length - 1);
    else if (event.key === "Enter" || event.key === " ") go(current);
    else return;
    event.preventDefault();
  };
  const names = store.model.data.objects.name;
  return (
    <VirtualList
      rows={rows}
      rowHeight={ROW_HEIGHT}
      role="listbox"
      label="Changes"
      current={current}
      focus={{ active: current < 0 ? "" : `${id}-${current}`, onKeyDown, onBlur: () => undefined }}
    >
      {(change: SceneChange, index) => (
        // biome-ignore lint/a11y/useKeyWithClickEvents: the list handles keys
        <div
          key={`${change.kinds[0]} ${change.path}`}
          id={`${id}-${index}`}
          class="queue-row change-row"
          role="option"
          tabIndex={-1}
          aria-selected={index === current}
          aria-setsize={rows.length}
          aria-posinset={index + 1}
          title={change.path}
          onClick={() => comparison.look(change)}
        >
          <span class="name">
            <Swatch kind={change.kinds[0]} />
            {names[change.object] ?? change.name}
            <span class="kinds">
              {change.kinds.map((kind) => CHANGES.find((each) => each.kind === kind)?.label.toLowerCase()).join(", ")}
            </span>
          </span>
          <span class="class-name">{changeTexts(change, (object) => names[object] ?? "").join(" · ")}</span>
        </div>
      )}
    </VirtualList>
  );
}
