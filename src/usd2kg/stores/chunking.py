"""split_triples: split a graph into chunks that can be uploaded separately, keeping each blank node in one chunk."""

from collections.abc import Iterator, Sequence

import pyoxigraph as ox

__all__ = ["group_by_blank_nodes", "split_triples"]


def split_triples(triples: Sequence[ox.Triple], size: int) -> Iterator[tuple[ox.Triple, ...]]:
    """Yield the triples in chunks of about `size`, with all triples of a blank node in one chunk.

    A server renames the blank nodes of each upload, so a node in two chunks would become two nodes. Connected blank
    nodes stay together, even if their chunk exceeds `size`.
    """
    chunk: list[ox.Triple] = []
    for group in group_by_blank_nodes(triples):
        if chunk and len(chunk) + len(group) > size:
            yield tuple(chunk)
            chunk = []
        chunk.extend(group)
    if chunk:
        yield tuple(chunk)


def group_by_blank_nodes(triples: Sequence[ox.Triple]) -> list[list[ox.Triple]]:
    """Return groups of triples that are connected by blank nodes; other triples are groups of one."""
    parent: dict[str, str] = {}

    def root(label: str) -> str:
        top = label
        while parent.setdefault(top, top) != top:
            top = parent[top]
        while parent[label] != top:
            parent[label], label = top, parent[label]
        return top

    for triple in triples:
        first, *others = _blanks(triple) or [""]
        for other in others:
            parent[root(other)] = root(first)
    groups: dict[str, list[ox.Triple]] = {}
    ordered: list[list[ox.Triple]] = []
    for triple in triples:
        blanks = _blanks(triple)
        if not blanks:
            ordered.append([triple])
            continue
        key = root(blanks[0])
        if key not in groups:
            groups[key] = []
            ordered.append(groups[key])
        groups[key].append(triple)
    return ordered


def _blanks(triple: ox.Triple) -> list[str]:
    """Return the labels of the blank nodes in a triple, including those of a triple term."""
    found = []
    for term in (triple.subject, triple.object):
        if isinstance(term, ox.BlankNode):
            found.append(term.value)
        elif isinstance(term, ox.Triple):
            found.extend(_blanks(term))
    return found
