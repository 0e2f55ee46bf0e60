"""Levels of a hierarchy: its classes in groups that are below each other, so that a walk meets no cycle."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeVar

__all__ = ["Levels", "level", "reachable"]

T = TypeVar("T")


@dataclass(frozen=True)
class Levels:
    """The strongly connected components of a hierarchy."""

    groups: tuple[tuple[str, ...], ...]
    """Classes that are all below each other, mostly one; each group comes after those above it."""
    group_of: Mapping[str, int]
    """Class → index of its group."""
    above: tuple[frozenset[int], ...]
    """For each group the groups directly above it."""


def level(superclasses: Mapping[str, Iterable[str]]) -> Levels:
    """Return the levels of a hierarchy given as class → its direct superclasses.

    It takes time in proportion to classes and edges, and no recursion: a hierarchy may be deeper than Python's stack.
    """
    groups: list[tuple[str, ...]] = []
    group_of: dict[str, int] = {}
    for group in _components(superclasses):
        group_of.update(dict.fromkeys(group, len(groups)))
        groups.append(group)
    above = (
        {group_of[up] for iri in group for up in superclasses.get(iri, ())} - {number}
        for number, group in enumerate(groups)
    )
    return Levels(tuple(groups), group_of, tuple(frozenset(numbers) for numbers in above))


def _components(superclasses: Mapping[str, Iterable[str]]) -> Iterator[tuple[str, ...]]:
    """Yield the strongly connected components, those above first (Tarjan 1972, without recursion)."""
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
    """Return everything that edges lead to from `starts`, those themselves only if an edge leads back."""
    found: set[T] = set()
    pending = list(starts)
    while pending:
        for target in edges.get(pending.pop(), ()):
            if target not in found:
                found.add(target)
                pending.append(target)
    return found
