/** Rows of a tree that is shown as a flat, virtual list. */

export interface TreeRow {
  /** Nodes from the root to this one, such as `0/4/9`: a node with two parents has two rows. */
  key: string;
  node: number;
  depth: number;
  hasChildren: boolean;
  isOpen: boolean;
}

/**
 * Returns the visible rows of a forest, parents before children.
 *
 * @param open nodes that are open if there is no filter.
 * @param isShown nodes that pass a filter, or null for all; their ancestors are shown, too, and open.
 * @param folded nodes that the user has closed all the same.
 */
export function treeRows(
  roots: readonly number[],
  children: readonly number[][],
  open: ReadonlySet<number>,
  isShown: ReadonlySet<number> | null,
  folded: ReadonlySet<number> = new Set(),
): TreeRow[] {
  const kept = isShown === null ? null : withAncestors(roots, children, isShown);
  const rows: TreeRow[] = [];
  const waiting = [...roots].reverse().map((node) => ({ node, depth: 0, key: String(node), above: [] as number[] }));
  while (waiting.length > 0) {
    const { node, depth, key, above } = waiting.pop() as (typeof waiting)[number];
    if (kept !== null && !kept.has(node)) continue;
    const below = (children[node] ?? []).filter(
      (child) => !above.includes(child) && (kept === null || kept.has(child)),
    );
    const isOpen = below.length > 0 && (kept === null ? open.has(node) : !folded.has(node));
    rows.push({ key, node, depth, hasChildren: below.length > 0, isOpen });
    if (isOpen) {
      for (const child of [...below].reverse())
        waiting.push({ node: child, depth: depth + 1, key: `${key}/${child}`, above: [...above, node] });
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
