/** The layout of the page: bar, trees, picture, object page, drawer. */

import { useEffect, useMemo, useRef } from "preact/hooks";
import type { ViewCommands } from "../keys/bindings";
import { giveFocusBack } from "../keys/focus";
import { handleKey } from "../keys/keyboard";
import type { Store } from "../state/store";
import type { FirstPicture } from "../viewer/firstPicture";
import { BulkDialog } from "./BulkDialog";
import { ChangesDialog } from "./ChangesDialog";
import { ClassSearch } from "./ClassSearch";
import { ConceptDialog } from "./ConceptDialog";
import { DrawerPanel } from "./DrawerPanel";
import { Help } from "./Help";
import { Notices } from "./Notices";
import { ObjectPanel } from "./ObjectPanel";
import { ProposalDialog } from "./ProposalDialog";
import { Sidebar } from "./Sidebar";
import { StatusBar } from "./StatusBar";
import { missingPicture, ThumbnailCache, Thumbnails } from "./Thumbnail";
import { TopBar } from "./TopBar";
import { ViewerPanel } from "./ViewerPanel";

export function App({ store, firstPicture }: { store: Store; firstPicture: FirstPicture | null }) {
  const view = useRef<ViewCommands | null>(null);
  const commands = useMemo<ViewCommands>(
    () => ({
      frame: () => view.current?.frame(),
      frameAll: () => view.current?.frameAll(),
      look: (name) => view.current?.look(name),
      steer: (...step) => view.current?.steer(...step),
    }),
    [],
  );
  const thumbnails = useMemo(
    () =>
      new ThumbnailCache(store.client, (object) => missingPicture(store.model.data, object), store.server.connections),
    [store],
  );
  useEffect(() => {
    const onKey = (event: KeyboardEvent) => handleKey(event, store, commands);
    addEventListener("keydown", onKey);
    return () => removeEventListener("keydown", onKey);
  }, [store, commands]);
  useEffect(giveFocusBack, []);
  return (
    <Thumbnails.Provider value={thumbnails}>
      <div class={store.isDrawerOpen.value ? "app" : "app drawer-closed"}>
        <TopBar store={store} view={commands} />
        <Sidebar store={store} />
        <ViewerPanel store={store} view={view} firstPicture={firstPicture} />
        <ObjectPanel store={store} />
        <DrawerPanel store={store} />
        <StatusBar store={store} />
        <Notices store={store} />
      </div>
      {store.isHelpOpen.value && <Help store={store} />}
      {store.isClassSearchOpen.value && <ClassSearch store={store} />}
      {store.isBulkOpen.value && <BulkDialog store={store} />}
      {store.isConceptOpen.value && <ConceptDialog store={store} />}
      {store.isProposalOpen.value && <ProposalDialog store={store} />}
      {store.changes.value !== null && <ChangesDialog store={store} changes={store.changes.value} />}
    </Thumbnails.Provider>
  );
}
