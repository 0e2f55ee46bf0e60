/** Decides that every open object of a concept has one class, after a look at all of them. */

import { useMemo, useState } from "preact/hooks";
import type { ObjectIndex } from "../api/types";
import { conceptOf, objectsOfConcept, offeredClasses } from "../state/concepts";
import { classLabel, conceptLabel } from "../state/model";
import type { Store } from "../state/store";
import { ClassPicker, useClassChoice } from "./ClassPicker";
import { Dialog } from "./Dialog";
import { Thumbnail } from "./Thumbnail";

export function ConceptDialog({ store }: { store: Store }) {
  const { model } = store;
  const concept = useMemo(() => conceptOf(store), [store]);
  const { open, decided } = objectsOfConcept(store.states.value, concept);
  const [excluded, setExcluded] = useState<ReadonlySet<ObjectIndex>>(store.excluded.value);
  const offered = offeredClasses(store);
  const choice = useClassChoice(
    model,
    useMemo(() => offered, [offered.join()]),
  );
  const chosen = open.filter((object) => !excluded.has(object));
  const close = () => {
    store.isConceptOpen.value = false;
  };
  const toggle = (object: ObjectIndex) => {
    const next = new Set(excluded);
    if (!next.delete(object)) next.add(object);
    setExcluded(next);
  };
  const isReady = chosen.length > 0 && choice.chosen >= 0;
  return (
    <Dialog title={`Every “${conceptLabel(model, concept)}” is…`} onClose={close}>
      <form
        class="bulk picking"
        onSubmit={(event) => {
          event.preventDefault();
          if (!isReady) return;
          close();
          void store.decide(chosen, "choose", choice.chosen, { concept });
        }}
      >
        <ClassPicker model={model} choice={choice} label="Class of the concept" isFocused />
        <p class="muted">
          {chosen.length} of {open.length} open ticked
          {decided > 0 && `; ${decided} decided before ${decided === 1 ? "stays as it is" : "stay as they are"}`}. The
          lessons keep it for other scenes.
        </p>
        <div class="bulk-groups">
          {open.map((object) => (
            <label key={object} class={excluded.has(object) ? "bulk-group excluded" : "bulk-group"}>
              <Thumbnail object={object} label={model.data.objects.name[object] ?? ""} />
              <span class="row">
                <input type="checkbox" checked={!excluded.has(object)} onChange={() => toggle(object)} />
                <span class="name" title={model.data.objects.path[object] ?? ""}>
                  {model.shortNames[object]}
                </span>
              </span>
              <span class="class-name">{classLabel(model, store.states.value[object]?.suggested ?? -1)}</span>
            </label>
          ))}
        </div>
        <button type="submit" class="primary" disabled={!isReady}>
          {choice.chosen < 0 ? "Choose a class" : `Set ${chosen.length} to ${classLabel(model, choice.chosen)}`}{" "}
          <kbd>Enter</kbd>
        </button>
      </form>
    </Dialog>
  );
}
