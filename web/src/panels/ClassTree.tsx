/** The classes of the ontology, with the number of objects of each and of its subclasses. */

import { useMemo, useState } from "preact/hooks";
import { searchClasses } from "../state/model";
import type { Store } from "../state/store";
import { TreeView } from "./TreeView";

export function ClassTree({ store }: { store: Store }) {
  const { model, filters } = store;
  const [text, setText] = useState("");
  const [isUsedOnly, setUsedOnly] = useState(true);
  const states = store.states.value;
  const own = useMemo(() => {
    const counts = model.data.classes.map(() => 0);
    for (const state of states) if (state.class >= 0) counts[state.class] = (counts[state.class] ?? 0) + 1;
    return counts;
  }, [states, model]);
  const totals = useMemo(
    () => model.classClosure.map((closure) => [...closure].reduce((total, index) => total + (own[index] ?? 0), 0)),
    [own, model],
  );
  const shown = useMemo(() => {
    if (text.trim() !== "") return new Set(searchClasses(model, text, model.data.classes.length));
    return isUsedOnly ? new Set(own.flatMap((count, index) => (count > 0 ? [index] : []))) : null;
  }, [text, isUsedOnly, own, model]);
  const chosen = filters.value.class;
  return (
    <>
      <div class="tree-tools">
        <input
          type="search"
          placeholder="Search labels, synonyms, definitions"
          aria-label="Search classes"
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
        />
        <label>
          <input type="checkbox" checked={isUsedOnly} onChange={() => setUsedOnly(!isUsedOnly)} />
          used only
        </label>
      </div>
      <TreeView
        label="Classes"
        roots={model.classRoots}
        children={model.classChildren}
        shown={shown}
        selected={new Set(chosen >= 0 ? [chosen] : [])}
        revealed={chosen}
        parentOf={(node) => model.data.classes[node]?.parents[0] ?? -1}
        onSelect={(node) => (filters.value = { ...filters.value, class: chosen === node ? -1 : node })}
        renderRow={(node) => {
          const cls = model.data.classes[node];
          return (
            <>
              <span class="name" title={[cls?.iri, cls?.definition].filter(Boolean).join("\n")}>
                {cls?.label}
              </span>
              <span class="count" title={`${own[node]} of the class itself`}>
                {totals[node] || ""}
              </span>
            </>
          );
        }}
      />
    </>
  );
}
