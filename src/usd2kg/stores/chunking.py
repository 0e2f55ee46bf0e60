"""chunks: a graph in parts that can be sent one by one without breaking a blank node in two."""

from collections.abc import Iterator, Sequence

import pyoxigraph as ox

__all__ = ["group_by_blank_nodes", "split_triples"]


def split_triples(triples: Sequence[ox.Triple], size: int) -> Iterator[tuple[ox.Triple, ...]]:
    """Yield the triples in parts of about `size`; all that is said of a blank node is in one part.

    A server makes new blank nodes of each part that it is sent, so a node in two parts would become two. Nodes that
    are tied to each other go together, however many they are.
    """
    part: list[ox.Triple] = []
    for group in group_by_blank_nodes(triples):
        if part and len(part) + len(group) > size:
            yield tuple(part)
            part = []
        part.extend(group)
    if part:
        yield tuple(part)


def group_by_blank_nodes(triples: Sequence[ox.Triple]) -> list[list[ox.Triple]]:
    """Return the triples in groups: those that share blank nodes together, each other one by itself."""
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
    alone: list[list[ox.Triple]] = []
    for triple in triples:
        blanks = _blanks(triple)
        if not blanks:
            alone.append([triple])
            continue
        key = root(blanks[0])
        if key not in groups:
            groups[key] = []
            alone.append(groups[key])
        groups[key].append(triple)
    return alone


def _blanks(triple: ox.Triple) -> list[str]:
    """Return the names of the blank nodes in a triple, those of a triple in it as well."""
    found = []
    for term in (triple.subject, triple.object):
        if isinstance(term, ox.BlankNode):
            found.append(term.value)
        elif isinstance(term, ox.Triple):
            found.extend(_blanks(term))
    return found
