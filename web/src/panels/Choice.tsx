/** A list to choose one of, after which the keys of the review work again. */

import { useRef } from "preact/hooks";

interface Props<T extends string> {
  label: string;
  options: readonly { id: T; label: string }[];
  value: T;
  onChange(value: T): void;
}

export function Choice<T extends string>({ label, options, value, onChange }: Props<T>) {
  // Arrows go through the list, so that the focus stays; a click or a first letter is a choice.
  const isBrowsing = useRef(false);
  return (
    <label class="field">
      <span class="field-name">{label}</span>
      <select
        aria-label={label}
        value={value}
        onPointerDown={() => {
          isBrowsing.current = false;
        }}
        onKeyDown={(event) => {
          isBrowsing.current = event.key.startsWith("Arrow");
        }}
        onChange={(event) => {
          onChange(event.currentTarget.value as T);
          if (!isBrowsing.current) event.currentTarget.blur();
        }}
      >
        {options.map((option) => (
          <option key={option.id} value={option.id}>
            {option.label}
          </option>
        ))}
      </select>
    </label>
  );
}
