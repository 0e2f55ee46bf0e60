/** The bar at the top: search and facets, colours, views, undo, export. */

import type { ViewCommands } from "../keys/bindings";
import { isAuditing } from "../state/audit";
import { COLOR_MODES } from "../state/colors";
import { NO_FILTERS } from "../state/filters";
import type { Store } from "../state/store";
import { Choice } from "./Choice";
import { ExportMenu } from "./ExportMenu";

/** Returns the colours to choose from. */
function colorModes(store: Store): typeof COLOR_MODES {
  const { has_comparison } = store.model.data;
  return COLOR_MODES.filter(
    ({ id }) => (id !== "change" || has_comparison) && (id !== "confidence" || !isAuditing(store)),
  );
}

export function TopBar({ store, view }: { store: Store; view: ViewCommands }) {
  const { model, filters } = store;
  const shown = store.shown.value;
  return (
    <header class="top-bar">
      <h1 title={model.data.source}>{model.data.title}</h1>
      <div class="search">
        <input
          id="search"
          type="search"
          placeholder="Filter objects by path, name, class, concept   G"
          aria-label="Filter objects"
          value={filters.value.text}
          onInput={(event) => (filters.value = { ...filters.value, text: event.currentTarget.value })}
        />
        {shown !== null && (
          <button type="button" class="chip" onClick={() => (filters.value = NO_FILTERS)}>
            {shown.size} of {model.count} shown · clear
          </button>
        )}
      </div>
      <Choice
        label="Color by"
        options={colorModes(store)}
        value={store.shownColors.value}
        onChange={(mode) => {
          store.colorMode.value = mode;
        }}
      />
      <fieldset class="group" aria-label="View">
        <button type="button" title="Look at everything (A)" onClick={view.frameAll}>
          All
        </button>
        <button type="button" title="Perspective (P)" onClick={() => view.look("perspective")}>
          3D
        </button>
        <button type="button" title="From the top (T)" onClick={() => view.look("top")}>
          Top
        </button>
        <button type="button" title="From the front (Shift+F)" onClick={() => view.look("front")}>
          Front
        </button>
      </fieldset>
      <fieldset class="group" aria-label="Undo">
        <button type="button" title="Undo (Ctrl+Z)" disabled={!store.server.canUndo.value} onClick={() => store.undo()}>
          Undo
        </button>
        <button
          type="button"
          title="Redo (Ctrl+Shift+Z)"
          disabled={!store.server.canRedo.value}
          onClick={() => store.redo()}
        >
          Redo
        </button>
      </fieldset>
      <ExportMenu store={store} />
      <button type="button" title="Keys (?)" onClick={() => (store.isHelpOpen.value = true)}>
        Keys
      </button>
    </header>
  );
}
