/** Confirms many groups at once, after a look at all of them. */

import { useMemo, useState } from "preact/hooks";
import type { ObjectIndex } from "../api/types";
import { classLabel } from "../state/model";
import type { Store } from "../state/store";
import { Dialog } from "./Dialog";
import { Thumbnail } from "./Thumbnail";

const START = 0.9;

export function BulkDialog({ store }: { store: Store }) {
  const [least, setLeast] = useState(START);
  const [excluded, setExcluded] = useState<ReadonlySet<string>>(new Set());
  const groups = useMemo(
    () => store.groups.value.filter((group) => group.suggested >= 0 && (group.confidence ?? 0) >= least),
    [store.groups.value, least],
  );
  const chosen: ObjectIndex[] = groups.filter((group) => !excluded.has(group.id)).flatMap((group) => group.objects);
  const close = () => {
    store.isBulkOpen.value = false;
  };
  const toggle = (id: string) => {
    const next = new Set(excluded);
    if (!next.delete(id)) next.add(id);
    setExcluded(next);
  };
  return (
    <Dialog title="Confirm many groups" onClose={close}>
      <form
        class="bulk"
        onSubmit={(event) => {
          event.preventDefault();
          close();
          void store.decide(chosen, "confirm");
        }}
      >
        <label class="field">
          Confidence from {least.toFixed(2)}
          <input
            type="range"
            min="0"
            max="1"
            step="0.01"
            value={least}
            onInput={(event) => setLeast(event.currentTarget.valueAsNumber)}
          />
        </label>
        <div class="bulk-groups">
          {groups.map((group) => (
            <label key={group.id} class={excluded.has(group.id) ? "bulk-group excluded" : "bulk-group"}>
              <Thumbnail object={group.objects[0] ?? -1} label={group.title} />
              <span class="row">
                <input type="checkbox" checked={!excluded.has(group.id)} onChange={() => toggle(group.id)} />
                <span class="name">{group.title}</span>
                {group.objects.length > 1 && <span class="count">{group.objects.length}</span>}
              </span>
              <span class="class-name">{classLabel(store.model, group.suggested)}</span>
            </label>
          ))}
          {groups.length === 0 && <p class="empty">No open group is that confident.</p>}
        </div>
        <button type="submit" class="primary" disabled={chosen.length === 0} autofocus>
          Confirm {chosen.length} {chosen.length === 1 ? "object" : "objects"} <kbd>Enter</kbd>
        </button>
      </form>
    </Dialog>
  );
}
