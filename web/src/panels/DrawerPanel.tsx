/** The drawer: review, questions, SPARQL, diagnostics, figures of the run. */

import type { ComponentChildren } from "preact";
import { useRef } from "preact/hooks";
import { comparisonOf } from "../state/comparison";
import type { Drawer, Store } from "../state/store";
import { Ask } from "./Ask";
import { AuditFigures } from "./AuditFigures";
import { Compare } from "./Compare";
import { Diagnostics } from "./Diagnostics";
import { Review } from "./Review";
import { RunFigures } from "./RunFigures";
import { Sparql } from "./Sparql";
import { Tabs } from "./Tabs";

/** Keeps what is typed and answered while another tab is shown; made when it is shown first. */
function Kept({ isShown, children }: { isShown: boolean; children: ComponentChildren }) {
  const wasShown = useRef(false);
  wasShown.current ||= isShown;
  return wasShown.current ? (
    <div class="kept" hidden={!isShown}>
      {children}
    </div>
  ) : null;
}

export function DrawerPanel({ store }: { store: Store }) {
  const tabs: { id: Drawer; label: string; count?: number }[] = [
    { id: "review", label: "Review", count: store.groups.value.length },
    { id: "ask", label: "Ask" },
    { id: "sparql", label: "SPARQL" },
    { id: "diagnostics", label: "Diagnostics", count: store.model.data.diagnostics.length },
    { id: "run", label: "Run" },
    ...(store.model.data.has_comparison
      ? [{ id: "compare" as const, label: "Compare", count: comparisonOf(store).changes.value.length }]
      : []),
  ];
  const { drawer, isDrawerOpen } = store;
  return (
    <section class="drawer" aria-label="Tools">
      <div class="drawer-bar">
        <Tabs
          tabs={tabs}
          current={drawer.value}
          onChange={(id) => {
            drawer.value = id;
            isDrawerOpen.value = true;
          }}
        />
        <button
          type="button"
          class="quiet"
          aria-expanded={isDrawerOpen.value}
          aria-label={isDrawerOpen.value ? "Close the tools" : "Open the tools"}
          title="Open or close (D)"
          onClick={() => (isDrawerOpen.value = !isDrawerOpen.value)}
        >
          {isDrawerOpen.value ? "Close" : "Open"}
        </button>
      </div>
      <div class="drawer-body" hidden={!isDrawerOpen.value} role="tabpanel" aria-labelledby={`tab-${drawer.value}`}>
        {drawer.value === "review" && <Review store={store} />}
        <Kept isShown={drawer.value === "ask"}>
          <Ask store={store} />
        </Kept>
        <Kept isShown={drawer.value === "sparql"}>
          <Sparql store={store} />
        </Kept>
        {drawer.value === "diagnostics" && <Diagnostics store={store} />}
        {drawer.value === "compare" && <Compare store={store} />}
        {drawer.value === "run" && (
          <>
            <AuditFigures audit={store.queue.value?.audit} />
            <RunFigures store={store} />
          </>
        )}
      </div>
    </section>
  );
}
