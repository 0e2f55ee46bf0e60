/** A button that opens a small panel; Escape, a click elsewhere or leaving it with Tab closes it. */

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";

export function Popover({ label, children }: { label: string; children: ComponentChildren }) {
  const details = useRef<HTMLDetailsElement>(null);
  const close = () => details.current?.removeAttribute("open");
  useEffect(() => {
    const onPress = (event: Event) => {
      if (!details.current?.contains(event.target as Node)) close();
    };
    addEventListener("pointerdown", onPress);
    return () => removeEventListener("pointerdown", onPress);
  }, []);
  return (
    <details
      class="popover"
      ref={details}
      onKeyDown={(event) => {
        if (event.key !== "Escape" || details.current?.open !== true) return;
        event.preventDefault();
        close();
        details.current.querySelector("summary")?.focus();
      }}
      onFocusOut={({ relatedTarget }) => {
        if (relatedTarget !== null && !details.current?.contains(relatedTarget as Node)) close();
      }}
    >
      <summary>{label}</summary>
      {/* biome-ignore lint/a11y/useKeyWithClickEvents: a button in the panel handles keys */}
      {/* biome-ignore lint/a11y/noStaticElementInteractions: only buttons in the panel are clicked */}
      <div
        onClick={(event) => {
          if (event.target instanceof HTMLButtonElement) close();
        }}
      >
        {children}
      </div>
    </details>
  );
}
