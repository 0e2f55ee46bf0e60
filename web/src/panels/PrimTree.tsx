/** The objects of the stage and the groups between them, as they are nested. */

import { classLabel } from "../state/model";
import { objectsBelow } from "../state/primTree";
import type { Store } from "../state/store";
import { StateIcon } from "./StateBadge";
import { TreeView } from "./TreeView";

export function PrimTree({ store }: { store: Store }) {
  const { model } = store;
  const { prims } = model;
  const states = store.states.value;
  const node = (object: number) => prims.nodeOf.get(object) ?? -1;
  const shown = store.shown.value;
  return (
    <TreeView
      label="Prims"
      roots={prims.roots}
      children={prims.children}
      shown={shown === null ? null : new Set([...shown].map(node))}
      selected={new Set(store.selection.value.map(node))}
      revealed={node(store.selection.value[0] ?? -1)}
      parentOf={(child) => prims.parents[child] ?? -1}
      onSelect={(chosen, isAdding) => {
        const object = prims.objects[chosen] ?? -1;
        store.select(object < 0 ? objectsBelow(prims, chosen) : [object], isAdding);
      }}
      renderRow={(row) => {
        const state = states[prims.objects[row] ?? -1];
        return (
          <>
            {state !== undefined && <StateIcon state={state.state} />}
            <span class={state === undefined ? "name group-name" : "name"} title={prims.paths[row]}>
              {prims.names[row]}
            </span>
            {state !== undefined && state.class >= 0 && (
              <span class="class-name">{classLabel(model, state.class)}</span>
            )}
          </>
        );
      }}
    />
  );
}
