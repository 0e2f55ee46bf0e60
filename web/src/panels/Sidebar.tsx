/** The trees of prims and classes, and the facets. */

import { useState } from "preact/hooks";
import type { Store } from "../state/store";
import { ClassTree } from "./ClassTree";
import { Facets } from "./Facets";
import { PrimTree } from "./PrimTree";
import { Tabs } from "./Tabs";

const TABS = [
  { id: "prims", label: "Prims" },
  { id: "classes", label: "Classes" },
  { id: "facets", label: "Facets" },
] as const;

export function Sidebar({ store }: { store: Store }) {
  const [tab, setTab] = useState<(typeof TABS)[number]["id"]>("prims");
  return (
    <nav class="sidebar" aria-label="Scene">
      <Tabs tabs={TABS} current={tab} onChange={(id) => setTab(id)} />
      <div class="sidebar-body" role="tabpanel" aria-labelledby={`tab-${tab}`}>
        {tab === "prims" && <PrimTree store={store} />}
        {tab === "classes" && <ClassTree store={store} />}
        {tab === "facets" && <Facets store={store} />}
      </div>
    </nav>
  );
}
