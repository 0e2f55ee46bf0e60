/** A tree with keyboard navigation as in the ARIA practices: arrows, Enter, Home, End. */

import type { ComponentChildren } from "preact";
import { useMemo, useState } from "preact/hooks";
import { type TreeRow, treeRows } from "../state/tree";
import { VirtualList } from "./VirtualList";

interface Props {
  label: string;
  roots: readonly number[];
  children: readonly number[][];
  /** Nodes that pass the filter; null for all. */
  shown: ReadonlySet<number> | null;
  selected: ReadonlySet<number>;
  /** Node to reveal; -1 for none. */
  revealed: number;
  parentOf(node: number): number;
  onSelect(node: number, isAdding: boolean): void;
  renderRow(node: number): ComponentChildren;
}

const ROW_HEIGHT = 26;
const FIRST_OPEN_ROWS = 40;

export function TreeView(props: Props) {
  const { roots, children, shown, selected, revealed } = props;
  const [open, setOpen] = useState<ReadonlySet<number>>(() =>
    roots.length < FIRST_OPEN_ROWS ? new Set(roots) : new Set(),
  );
  const [focused, setFocused] = useState(-1);
  const opened = useMemo(() => withAncestors(open, revealed, props.parentOf), [open, revealed, props.parentOf]);
  const rows = useMemo(() => treeRows(roots, children, opened, shown), [roots, children, opened, shown]);
  const target = focused >= 0 ? focused : revealed;
  const current = rows.findIndex((row) => row.node === target);
  const toggle = (node: number) => {
    const next = new Set(opened);
    if (!next.delete(node)) next.add(node);
    setOpen(next);
  };
  const onKey = (event: KeyboardEvent) => {
    const row = rows[current] ?? rows[0];
    if (row === undefined) return;
    const go = (index: number) => {
      const next = rows[Math.min(Math.max(index, 0), rows.length - 1)];
      if (next !== undefined) setFocused(next.node);
    };
    if (event.key === "ArrowDown") go(current + 1);
    else if (event.key === "ArrowUp") go(current - 1);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(rows.length - 1);
    else if (event.key === "ArrowRight" && row.hasChildren && !row.isOpen) toggle(row.node);
    else if (event.key === "ArrowLeft" && row.isOpen) toggle(row.node);
    else if (event.key === "ArrowLeft") setFocused(props.parentOf(row.node));
    else if (event.key === "Enter" || event.key === " ") props.onSelect(row.node, event.shiftKey);
    else return;
    event.preventDefault();
  };
  if (rows.length === 0) return <p class="empty">Nothing matches the filter.</p>;
  return (
    // biome-ignore lint/a11y/noStaticElementInteractions: the list inside has the role; keys bubble to here
    // biome-ignore lint/a11y/noNoninteractiveTabindex: it takes the focus for the rows, of which few exist at a time
    <div class="tree" tabIndex={0} data-own-keys onKeyDown={onKey} onBlur={() => setFocused(-1)}>
      <VirtualList rows={rows} rowHeight={ROW_HEIGHT} role="tree" label={props.label} current={current}>
        {(row: TreeRow) => (
          // biome-ignore lint/a11y/useKeyWithClickEvents: the tree handles keys
          <div
            key={row.node}
            class={`tree-row${row.node === focused ? " focused" : ""}`}
            role="treeitem"
            tabIndex={-1}
            aria-level={row.depth + 1}
            aria-selected={selected.has(row.node)}
            {...(row.hasChildren ? { "aria-expanded": row.isOpen } : {})}
            style={{ paddingLeft: `${4 + 14 * row.depth}px` }}
            onClick={(event) => props.onSelect(row.node, event.shiftKey || event.ctrlKey || event.metaKey)}
          >
            {row.hasChildren ? (
              <button
                type="button"
                class="twist"
                tabIndex={-1}
                aria-label={row.isOpen ? "Close" : "Open"}
                onClick={(event) => {
                  event.stopPropagation();
                  toggle(row.node);
                }}
              >
                <svg viewBox="0 0 10 10" aria-hidden="true" class={row.isOpen ? "open" : ""}>
                  <path d="M3 2l4 3-4 3z" />
                </svg>
              </button>
            ) : (
              <span class="twist" />
            )}
            {props.renderRow(row.node)}
          </div>
        )}
      </VirtualList>
    </div>
  );
}

function withAncestors(
  open: ReadonlySet<number>,
  node: number,
  parentOf: (node: number) => number,
): ReadonlySet<number> {
  const found = new Set(open);
  const seen = new Set<number>();
  for (let above = node < 0 ? -1 : parentOf(node); above >= 0 && !seen.has(above); above = parentOf(above)) {
    seen.add(above);
    found.add(above);
  }
  return found;
}
