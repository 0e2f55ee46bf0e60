"""Strongly connected components of a class hierarchy, for traversal without cycles."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeVar

__all__ = ["Components", "find_components", "reachable"]

T = TypeVar("T")


@dataclass(frozen=True)
class Components:
    """The strongly connected components of a hierarchy, superclasses first."""

    members: tuple[tuple[str, ...], ...]
    """Classes of each component: one, unless the hierarchy is cyclic."""
    component_of: Mapping[str, int]
    """Class → index of its component."""
    above: tuple[frozenset[int], ...]
    """Indices of the components directly above each component."""


def find_components(superclasses: Mapping[str, Iterable[str]]) -> Components:
    """Return the components of a hierarchy given as class → direct superclasses, in linear time."""
    members: list[tuple[str, ...]] = []
    component_of: dict[str, int] = {}
    for group in _components(superclasses):
        component_of.update(dict.fromkeys(group, len(members)))
        members.append(group)
    above = (
        {component_of[up] for iri in group for up in superclasses.get(iri, ())} - {number}
        for number, group in enumerate(members)
    )
    return Components(tuple(members), component_of, tuple(frozenset(numbers) for numbers in above))


def _components(superclasses: Mapping[str, Iterable[str]]) -> Iterator[tuple[str, ...]]:
    """Yield the strongly connected components, superclasses first.

    Tarjan's algorithm (1972), iterative: a hierarchy may be deeper than Python's stack.
    """
    order: dict[str, int] = {}
    low: dict[str, int] = {}
    waiting: dict[str, None] = {}
    for start in superclasses:
        pending = [] if start in order else [(start, iter(superclasses[start]))]
        while pending:
            iri, parents = pending[-1]
            if iri not in order:
                order[iri] = low[iri] = len(order)
                waiting[iri] = None
            for parent in parents:
                if parent not in order:
                    pending.append((parent, iter(superclasses.get(parent, ()))))
                    break
                if parent in waiting:
                    low[iri] = min(low[iri], low[parent])
            else:
                pending.pop()
                if pending:
                    low[pending[-1][0]] = min(low[pending[-1][0]], low[iri])
                if low[iri] == order[iri]:
                    yield tuple(_taken_until(iri, waiting))


def _taken_until(iri: str, waiting: dict[str, None]) -> Iterator[str]:
    taken = None
    while taken != iri:
        taken, _ = waiting.popitem()
        yield taken


def reachable(edges: Mapping[T, Iterable[T]], starts: Iterable[T]) -> set[T]:
    """Return all nodes reachable from `starts`; a start is included only if a cycle leads back to it."""
    found: set[T] = set()
    pending = list(starts)
    while pending:
        for target in edges.get(pending.pop(), ()):
            if target not in found:
                found.add(target)
                pending.append(target)
    return found
