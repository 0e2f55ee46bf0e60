/** A list of rows of equal height, of which only the visible ones are drawn. */

import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

interface Props<T> {
  rows: readonly T[];
  rowHeight: number;
  label: string;
  role: "tree" | "listbox" | "list";
  /** Row to keep in view, or -1. */
  current: number;
  /** Makes the list take the focus for its rows, of which only the visible ones exist. */
  focus?: { active: string; onKeyDown(event: KeyboardEvent): void; onBlur(): void };
  children(row: T, index: number): ComponentChildren;
}

const SPARE = 6;
/** Keys that move in a list. */
const MOVES = /^(Arrow|Home|End)/;

export function VirtualList<T>({ rows, rowHeight, label, role, current, focus, children }: Props<T>) {
  const host = useRef<HTMLDivElement>(null);
  // A click has done what Enter does to a row: until arrows move on, Enter and Space belong to the review.
  const isClicked = useRef(false);
  const onKeyDown = (event: KeyboardEvent) => {
    if (isClicked.current && (event.key === "Enter" || event.key === " ")) return;
    if (MOVES.test(event.key)) isClicked.current = false;
    focus?.onKeyDown(event);
  };
  const [top, setTop] = useState(0);
  const [height, setHeight] = useState(400);
  useEffect(() => {
    const element = host.current;
    if (element === null) return;
    const observer = new ResizeObserver(() => setHeight(element.clientHeight));
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    const element = host.current;
    if (element === null || current < 0) return;
    const [from, to] = [current * rowHeight, (current + 1) * rowHeight];
    if (from < element.scrollTop) element.scrollTop = from;
    else if (to > element.scrollTop + element.clientHeight) element.scrollTop = to - element.clientHeight;
  }, [current, rowHeight]);
  const first = Math.max(0, Math.floor(top / rowHeight) - SPARE);
  const last = Math.min(rows.length, Math.ceil((top + height) / rowHeight) + SPARE);
  return (
    // biome-ignore lint/a11y/useAriaPropsSupportedByRole: all three roles may have a label
    <div
      class="virtual"
      ref={host}
      role={role}
      aria-label={label}
      {...(focus === undefined
        ? {}
        : {
            tabIndex: 0,
            "data-own-keys": true,
            "aria-activedescendant": focus.active,
            onKeyDown,
            onBlur: focus.onBlur,
            onFocusOut: () => {
              isClicked.current = false;
            },
            onClickCapture: () => {
              isClicked.current = true;
            },
          })}
      onScroll={(event) => setTop(event.currentTarget.scrollTop)}
    >
      <div class="virtual-space" style={{ height: `${rows.length * rowHeight}px` }}>
        <div class="virtual-rows" style={{ transform: `translateY(${first * rowHeight}px)` }}>
          {rows.slice(first, last).map((row, index) => children(row, first + index))}
        </div>
      </div>
    </div>
  );
}
