/** Rows of a tree that is shown as a flat, virtual list. */

export interface TreeRow {
  node: number;
  depth: number;
  hasChildren: boolean;
  isOpen: boolean;
}

/**
 * Returns the visible rows of a forest, parents before children.
 *
 * @param isShown nodes that pass a filter, or null for all; their ancestors are shown, too, and open.
 */
export function treeRows(
  roots: readonly number[],
  children: readonly number[][],
  open: ReadonlySet<number>,
  isShown: ReadonlySet<number> | null,
): TreeRow[] {
  const kept = isShown === null ? null : withAncestors(roots, children, isShown);
  const rows: TreeRow[] = [];
  const waiting = [...roots].reverse().map((node) => ({ node, depth: 0, above: [] as number[] }));
  while (waiting.length > 0) {
    const { node, depth, above } = waiting.pop() as (typeof waiting)[number];
    if (kept !== null && !kept.has(node)) continue;
    const below = (children[node] ?? []).filter(
      (child) => !above.includes(child) && (kept === null || kept.has(child)),
    );
    const isOpen = below.length > 0 && (open.has(node) || kept !== null);
    rows.push({ node, depth, hasChildren: below.length > 0, isOpen });
    if (isOpen) {
      for (const child of [...below].reverse())
        waiting.push({ node: child, depth: depth + 1, above: [...above, node] });
    }
  }
  return rows;
}

function withAncestors(
  roots: readonly number[],
  children: readonly number[][],
  shown: ReadonlySet<number>,
): Set<number> {
  const kept = new Set<number>();
  const onPath = new Set<number>();
  const visit = (node: number): boolean => {
    if (kept.has(node)) return true;
    if (onPath.has(node)) return false;
    onPath.add(node);
    let isKept = shown.has(node);
    for (const child of children[node] ?? []) if (visit(child)) isKept = true;
    onPath.delete(node);
    if (isKept) kept.add(node);
    return isKept;
  };
  for (const root of roots) visit(root);
  return kept;
}
