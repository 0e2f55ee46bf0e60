/** The 3D view with its legend and switches; it shows what the state of the page says. */

import { computed, effect } from "@preact/signals";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { ObjectIndex } from "../api/types";
import type { ViewCommands } from "../keys/bindings";
import { isAuditing } from "../state/audit";
import { pageOf } from "../state/candidates";
import { colorObjects, cssColor, type LegendEntry } from "../state/colors";
import { colorChanges, comparisonOf } from "../state/comparison";
import { classLabel } from "../state/model";
import type { Store } from "../state/store";
import { followSupports } from "../state/supports";
import { annotate } from "../viewer/annotations";
import { appearanceOf, MAX_WATCHED, occluders } from "../viewer/appearance";
import type { FirstPicture } from "../viewer/firstPicture";
import { loadGeometry } from "../viewer/loading";
import { Viewer } from "../viewer/viewer";
import { Popover } from "./Popover";

interface ViewerProps {
  store: Store;
  view: { current: ViewCommands | null };
  firstPicture: FirstPicture | null;
}

export function ViewerPanel({ store, view, firstPicture }: ViewerProps) {
  const host = useRef<HTMLDivElement>(null);
  const [problem, setProblem] = useState("");
  const [isLost, setLost] = useState(false);
  const [legend, setLegend] = useState<LegendEntry[]>([]);
  const [loading, setLoading] = useState<[number, number]>([0, 0]);
  useLayoutEffect(() => {
    if (host.current !== null) firstPicture?.moveTo(host.current);
  }, [firstPicture]);
  useEffect(() => {
    if (host.current === null) return;
    let viewer: Viewer;
    try {
      viewer = new Viewer(host.current, store.model.data, {
        onPick: (object, isAdding) => pick(store, object, isAdding),
        onHover: (object) => {
          store.hovered.value = object ?? -1;
        },
        onContext: setLost,
        onFirstFrame: () => firstPicture?.remove(),
      });
    } catch {
      firstPicture?.remove();
      setProblem("This browser has no WebGL 2, so there is no picture. Everything else works.");
      return;
    }
    Object.assign(window, { studioViewer: viewer });
    view.current = {
      frame: () => viewer.frame(store.selection.value.length > 0 ? store.selection.value : null),
      frameAll: () => viewer.frame(null),
      look: (name) => viewer.frame(store.selection.value.length > 0 ? store.selection.value : null, name),
      steer: (...step) => viewer.cameras.steer(...step),
    };
    const stop = follow(store, viewer, setLegend);
    void load(store, viewer, setLoading);
    return () => {
      for (const each of stop) each();
      viewer.dispose();
    };
  }, [store, view, firstPicture]);
  return (
    <main class="viewer" aria-label="3D view">
      <div class="canvas-host" data-lost={isLost} ref={host} />
      {problem !== "" && <p class="empty">{problem}</p>}
      {isLost && (
        <p class="context-lost" role="alert">
          The browser has taken the graphics memory away, so there is no picture. It comes back by itself; if it does
          not, load the page again. Decisions are saved.
        </p>
      )}
      <ViewTools store={store} />
      <Legend store={store} entries={legend} />
      <div class="view-notes">
        {store.model.data.limits.meshes !== undefined && <p class="boxes-only">{store.model.data.limits.meshes}</p>}
        {loading[0] < loading[1] && (
          <p class="loading">
            Meshes {loading[0]} of {loading[1]}
          </p>
        )}
        <HoverLine store={store} />
      </div>
    </main>
  );
}

function pick(store: Store, object: ObjectIndex | null, isAdding: boolean): void {
  if (object === null) {
    if (!isAdding) store.select([]);
    return;
  }
  store.select([object], isAdding);
}

/** Keeps the picture in step with the state; returns what stops it. */
function follow(store: Store, viewer: Viewer, setLegend: (legend: LegendEntry[]) => void): (() => void)[] {
  const before = computed<ReadonlySet<ObjectIndex>>(() => {
    const watched = store.selection.value.slice(0, MAX_WATCHED);
    if (!store.isCutAway.value) return new Set();
    return occluders(store.model.data, watched, viewer.eye.value, (...ray) => viewer.meets(...ray));
  });
  const { supports, stop } = followSupports(store);
  return [
    stop,
    effect(() => {
      const mode = store.shownColors.value;
      const { colors, legend } =
        mode === "change"
          ? colorChanges(store.model.count, comparisonOf(store).rows.value)
          : colorObjects(mode, store.model, store.states.value, store.answer.value, supports.value);
      setLegend(legend);
      viewer.setAppearance(appearanceOf(store, colors, viewer.eye, before.value), mode === "material");
    }),
    ...followComparison(store, viewer),
    effect(() => viewer.setSelection(store.selection.value)),
    effect(() => viewer.setHidden([...before.value])),
    effect(() => viewer.setCut(store.cutShare.value)),
    effect(() => {
      const { lines, labels } = annotate(store, pageOf(store).value, (object) => viewer.centerOf(object));
      viewer.setAnnotations(lines, labels);
    }),
    effect(() => {
      // The picture follows the queue and the answers, not each click.
      if (store.lookAt.value !== null) viewer.frame(store.lookAt.value);
    }),
  ];
}

/** Shows where things were: what disappeared, and the old places of selected objects. */
function followComparison(store: Store, viewer: Viewer): (() => void)[] {
  if (!store.model.data.has_comparison) return [];
  const comparison = comparisonOf(store);
  return [
    effect(() => viewer.setGhosts(comparison.ghosts.value, comparison.focusedGhost.value)),
    effect(() => {
      const ghost = comparison.focusedGhost.value;
      if (ghost !== null) viewer.frameBox(ghost.box);
    }),
  ];
}

async function load(store: Store, viewer: Viewer, setLoading: (loading: [number, number]) => void): Promise<void> {
  try {
    await loadGeometry(store.client, viewer, (done, count) => setLoading([done, count]));
    document.documentElement.dataset["geometry"] = "loaded";
  } catch (error) {
    setLoading([0, 0]);
    store.report(error);
  }
}

function ViewTools({ store }: { store: Store }) {
  const switches = [
    {
      label: "Cutaway",
      title: "Hide ceilings, near walls, and what is before the selection (W)",
      state: store.isCutAway,
    },
    { label: "See-through", title: "Show everything but the selection as ghosts (X)", state: store.isSeeThrough },
    { label: "Labels", title: "Labels on objects (L)", state: store.hasLabels },
  ];
  const isIsolated = store.isolated.value !== null;
  return (
    <div class="view-tools">
      {switches.map(({ label, title, state }) => (
        <button
          key={label}
          type="button"
          title={title}
          aria-pressed={state.value}
          onClick={() => (state.value = !state.value)}
        >
          {label}
        </button>
      ))}
      <button
        type="button"
        title="Show the selection alone (I)"
        aria-pressed={isIsolated}
        disabled={!isIsolated && store.selection.value.length === 0}
        onClick={() => (store.isolated.value = isIsolated ? null : new Set(store.selection.value))}
      >
        Isolate
      </button>
      <label title="Hide everything above a height">
        Cut
        <input
          type="range"
          min="0"
          max="1"
          step="0.01"
          value={store.cutShare.value}
          onInput={(event) => (store.cutShare.value = event.currentTarget.valueAsNumber)}
        />
      </label>
      <Relations store={store} />
    </div>
  );
}

function Relations({ store }: { store: Store }) {
  const { relationKinds } = store;
  const toggle = (kind: string) => {
    const chosen = new Set(relationKinds.value);
    if (!chosen.delete(kind)) chosen.add(kind);
    relationKinds.value = chosen;
  };
  return (
    <Popover label="Relations">
      {store.model.data.relation_kinds.map(({ kind, count }) => (
        <label key={kind} class="facet">
          <input type="checkbox" checked={relationKinds.value.has(kind)} onChange={() => toggle(kind)} />
          <span class="name">{kind}</span>
          <span class="count">{count}</span>
        </label>
      ))}
    </Popover>
  );
}

const MAX_LEGEND = 40;

function Legend({ store, entries }: { store: Store; entries: LegendEntry[] }) {
  if (entries.length === 0) return null;
  return (
    <section class="legend" aria-label="Legend">
      {entries.slice(0, MAX_LEGEND).map(({ label, color, objects, count }) => (
        <button
          key={`${label} ${objects[0]}`}
          type="button"
          title={`Select ${label}`}
          onClick={() => store.select(objects)}
        >
          <svg viewBox="0 0 10 10" aria-hidden="true">
            <rect width="10" height="10" rx="2" fill={cssColor(color)} />
          </svg>
          <span class="name">{label}</span>
          <span class="count">{count ?? objects.length}</span>
        </button>
      ))}
      {entries.length > MAX_LEGEND && <p>and {entries.length - MAX_LEGEND} more</p>}
    </section>
  );
}

function HoverLine({ store }: { store: Store }) {
  const object = store.hovered.value;
  const state = store.states.value[object];
  if (state === undefined) return null;
  return (
    <p class="hover-line">
      <strong>{store.model.data.objects.name[object]}</strong>
      {state.class >= 0 && ` · ${classLabel(store.model, state.class)}`}
      {state.confidence !== null && !isAuditing(store) && ` · ${state.confidence.toFixed(2)}`}
    </p>
  );
}
