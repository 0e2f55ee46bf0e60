/** A field that finds a class by label, synonym or definition; Enter submits the form around it. */

import { useEffect, useMemo, useState } from "preact/hooks";
import type { ClassIndex } from "../api/types";
import { type SceneModel, searchClasses } from "../state/model";

const MAX_FOUND = 30;

export interface ClassChoice {
  text: string;
  found: readonly ClassIndex[];
  /** Row of `found` that is marked. */
  active: number;
  /** The marked class; -1 if none is found. */
  chosen: ClassIndex;
  search(text: string): void;
  mark(row: number): void;
}

/** Returns the state of a picker; before something is typed, it offers the given classes. */
export function useClassChoice(model: SceneModel, offered: readonly ClassIndex[]): ClassChoice {
  const [text, setText] = useState("");
  const [active, setActive] = useState(0);
  const found = useMemo(
    () => (text.trim() === "" ? offered : searchClasses(model, text, MAX_FOUND)),
    [model, text, offered],
  );
  return {
    text,
    found,
    active,
    chosen: found[active] ?? -1,
    search: (typed) => {
      setText(typed);
      setActive(0);
    },
    mark: setActive,
  };
}

interface Props {
  model: SceneModel;
  choice: ClassChoice;
  label: string;
  isFocused: boolean;
  /** Called on a click, after the class is marked. */
  onPick?(index: ClassIndex): void;
}

export function ClassPicker({ model, choice, label, isFocused, onPick }: Props) {
  const { text, found, active, mark } = choice;
  useEffect(() => document.getElementById(`found-${active}`)?.scrollIntoView({ block: "nearest" }), [active]);
  const onKey = (event: KeyboardEvent) => {
    if (event.key === "ArrowDown") mark(Math.max(Math.min(active + 1, found.length - 1), 0));
    else if (event.key === "ArrowUp") mark(Math.max(active - 1, 0));
    else return;
    event.preventDefault();
  };
  return (
    <div class="class-picker">
      <input
        class="class-search"
        type="search"
        // biome-ignore lint/a11y/noRedundantRoles: the field has no datalist, which would give it the role
        role="combobox"
        list={undefined}
        aria-expanded={found.length > 0}
        aria-controls="found-classes"
        aria-activedescendant={found.length > 0 ? `found-${active}` : ""}
        aria-label={label}
        placeholder="Label, synonym or words of the definition"
        autofocus={isFocused}
        value={text}
        onInput={(event) => choice.search(event.currentTarget.value)}
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
              onClick={() => {
                mark(row);
                onPick?.(index);
              }}
            >
              <strong>{cls?.label}</strong>
              {cls !== undefined && cls.synonyms.length > 0 && <em>{cls.synonyms.slice(0, 5).join(", ")}</em>}
              <p>{cls?.definition}</p>
            </div>
          );
        })}
        {text.trim() !== "" && found.length === 0 && <p class="empty">No class matches “{text}”.</p>}
      </div>
    </div>
  );
}
