/** A box that finds a class by label, synonym or definition, and chooses it for the objects under review. */

import { useMemo, useState } from "preact/hooks";
import { searchClasses } from "../state/model";
import type { Store } from "../state/store";
import { Dialog } from "./Dialog";

const MAX_FOUND = 30;

export function ClassSearch({ store }: { store: Store }) {
  const { model } = store;
  const [text, setText] = useState("");
  const [active, setActive] = useState(0);
  const found = useMemo(() => searchClasses(model, text, MAX_FOUND), [model, text]);
  const targets = store.targets.value;
  const close = () => {
    store.isClassSearchOpen.value = false;
  };
  const choose = (index: number | undefined) => {
    if (index === undefined) return;
    close();
    void store.decide(targets, "choose", index);
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key === "ArrowDown") setActive(Math.min(active + 1, found.length - 1));
    else if (event.key === "ArrowUp") setActive(Math.max(active - 1, 0));
    else if (event.key === "Enter") choose(found[active]);
    else return;
    event.preventDefault();
  };
  return (
    <Dialog title={`Class of ${targets.length} ${targets.length === 1 ? "object" : "objects"}`} onClose={close}>
      <input
        class="class-search"
        type="search"
        // biome-ignore lint/a11y/noRedundantRoles: the field has no datalist, which would give it the role
        role="combobox"
        list={undefined}
        aria-expanded={found.length > 0}
        aria-controls="found-classes"
        aria-activedescendant={found.length > 0 ? `found-${active}` : ""}
        aria-label="Search a class"
        placeholder="Label, synonym or words of the definition"
        autofocus
        value={text}
        onInput={(event) => {
          setText(event.currentTarget.value);
          setActive(0);
        }}
        onKeyDown={onKey}
      />
      <div id="found-classes" class="found" role="listbox" aria-label="Classes">
        {found.map((index, row) => {
          const cls = model.data.classes[index];
          return (
            // biome-ignore lint/a11y/useKeyWithClickEvents: the text field handles keys
            <div
              key={index}
              id={`found-${row}`}
              role="option"
              tabIndex={-1}
              aria-selected={row === active}
              onClick={() => choose(index)}
              onPointerMove={() => setActive(row)}
            >
              <strong>{cls?.label}</strong>
              {cls !== undefined && cls.synonyms.length > 0 && <em>{cls.synonyms.slice(0, 5).join(", ")}</em>}
              <p>{cls?.definition}</p>
            </div>
          );
        })}
        {text.trim() !== "" && found.length === 0 && <p class="empty">No class matches “{text}”.</p>}
      </div>
    </Dialog>
  );
}
