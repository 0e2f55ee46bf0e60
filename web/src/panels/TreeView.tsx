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
  const [folded, setFolded] = useState<ReadonlySet<number>>(new Set());
  const [focused, setFocused] = useState("");
  const opened = useMemo(() => withAncestors(open, revealed, props.parentOf), [open, revealed, props.parentOf]);
  const rows = useMemo(
    () => treeRows(roots, children, opened, shown, folded),
    [roots, children, opened, shown, folded],
  );
  const current = rows.findIndex((row) => (focused === "" ? row.node === revealed : row.key === focused));
  const toggle = (node: number) => {
    // Under a filter all is open at first, and closing something must not change the tree without the filter.
    if (shown === null) setOpen(toggled(opened, node));
    else setFolded(toggled(folded, node));
  };
  const go = (index: number) => setFocused(rows[Math.min(Math.max(index, 0), rows.length - 1)]?.key ?? "");
  const onKeyDown = (event: KeyboardEvent) => {
    const row = rows[current] ?? rows[0];
    if (row === undefined) return;
    if (event.key === "ArrowDown") go(current + 1);
    else if (event.key === "ArrowUp") go(current - 1);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(rows.length - 1);
    else if (event.key === "ArrowRight" && row.hasChildren && !row.isOpen) toggle(row.node);
    else if (event.key === "ArrowRight" && row.hasChildren) go(current + 1);
    else if (event.key === "ArrowLeft" && row.isOpen) toggle(row.node);
    else if (event.key === "ArrowLeft") setFocused(row.key.slice(0, row.key.lastIndexOf("/")) || row.key);
    else if (event.key === "Enter" || event.key === " ") props.onSelect(row.node, event.shiftKey);
    else return;
    event.preventDefault();
  };
  if (rows.length === 0) return <p class="empty">Nothing matches the filter.</p>;
  const rowId = (row: TreeRow | undefined) => (row === undefined ? "" : `${props.label}-${row.key}`);
  return (
    <div class="tree">
      <VirtualList
        rows={rows}
        rowHeight={ROW_HEIGHT}
        role="tree"
        label={props.label}
        current={current}
        focus={{ active: rowId(rows[current]), onKeyDown, onBlur: () => setFocused("") }}
      >
        {(row: TreeRow) => (
          // biome-ignore lint/a11y/useKeyWithClickEvents: the tree handles keys
          <div
            key={row.key}
            id={rowId(row)}
            class={row.key === focused ? "tree-row focused" : "tree-row"}
            role="treeitem"
            tabIndex={-1}
            aria-level={row.depth + 1}
            aria-selected={selected.has(row.node)}
            {...(row.hasChildren ? { "aria-expanded": row.isOpen } : {})}
            style={{ paddingLeft: `${4 + 14 * row.depth}px` }}
            onClick={(event) => props.onSelect(row.node, event.shiftKey || event.ctrlKey || event.metaKey)}
          >
            <span
              class="twist"
              aria-hidden="true"
              onClick={(event) => {
                if (!row.hasChildren) return;
                event.stopPropagation();
                toggle(row.node);
              }}
            >
              {row.hasChildren && (
                <svg viewBox="0 0 10 10" aria-hidden="true" class={row.isOpen ? "open" : ""}>
                  <path d="M3 2l4 3-4 3z" />
                </svg>
              )}
            </span>
            {props.renderRow(row.node)}
          </div>
        )}
      </VirtualList>
    </div>
  );
}

function toggled(nodes: ReadonlySet<number>, node: number): ReadonlySet<number> {
  const next = new Set(nodes);
  if (!next.delete(node)) next.add(node);
  return next;
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
