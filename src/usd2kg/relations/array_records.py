"""Operations on records of arrays (structs of arrays), on groups and chains of rows, and on sort keys and ratios."""

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "are_reached",
    "concatenate_rows",
    "first_of_each_group",
    "is_on_cycle",
    "rank_in_group",
    "ratios",
    "rounded",
    "select_rows",
]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]
_Columns = TypeVar("_Columns", bound=tuple[Any, ...])
"""A NamedTuple of arrays of the same length."""

_DECIMALS = 6
"""Decimals of sort keys: micrometres."""
_SMALLEST = 1e-12
"""Smallest divisor."""


def select_rows(columns: _Columns, chosen: Mask | Indices) -> _Columns:
    """Return the selected rows of a record of arrays."""
    return _same_type(columns, [column[chosen] for column in columns])


def concatenate_rows(portions: list[_Columns]) -> _Columns:
    """Return the concatenated rows of one or more records of arrays."""
    return _same_type(portions[0], [np.concatenate(column) for column in zip(*portions, strict=True)])


def _same_type(like: _Columns, columns: list[NDArray[Any]]) -> _Columns:
    record: Any = type(like)
    made: _Columns = record(*columns)
    return made


def rank_in_group(groups: Indices) -> Indices:
    """Return the index of each item within its group; items are sorted by group.

    >>> rank_in_group(np.array([3, 3, 7, 7, 7])).tolist()
    [0, 1, 0, 1, 2]
    """
    starts = np.flatnonzero(np.diff(groups, prepend=-1))
    return np.asarray(np.arange(len(groups)) - np.repeat(starts, np.diff(np.append(starts, len(groups)))))


def first_of_each_group(groups: Indices, keys: tuple[NDArray[np.generic], ...], most: int = 1) -> Indices:
    """Return the indices of the first items of each group, group by group.

    Args:
        groups: group of each item, not negative.
        keys: sort keys; the last is the primary one, as in `numpy.lexsort`.
        most: number of items per group.
    """
    order = np.lexsort((*keys, groups))
    return np.asarray(order[rank_in_group(groups[order]) < most])


def is_on_cycle(after: Indices, starts: Indices) -> Mask:
    """Return for each start whether following `after` (-1 ends a chain) leads back to it.

    >>> is_on_cycle(np.array([1, 0, 1]), np.array([0, 1, 2])).tolist()
    [True, True, False]
    """
    # Pointer doubling: after log2(n) rounds every chain has ended or is cyclic.
    here = np.append(after, -1)
    ended = here.copy()
    for _ in range(len(after).bit_length()):
        ended = ended[ended]
    if not (ended[starts] >= 0).any():
        return np.zeros(len(starts), np.bool_)
    on_cycle = np.zeros(len(here), np.bool_)
    # Items reached this far along an endless chain are on a cycle, and so are their successors.
    reached = np.unique(ended[ended >= 0])
    while len(reached) and not on_cycle[reached].all():
        on_cycle[reached] = True
        reached = here[reached]
    return np.asarray(on_cycle[starts])


def are_reached(goals: Indices, starts: Indices, after: Indices) -> Mask:
    """Return for each goal whether following `after` (-1 ends a chain) from its start leads to it, in one step or more.

    Chains may be long or end in a cycle; n items and m pairs take O((n + m) log n) (binary lifting, Bender and
    Farach-Colton, 2004).

    Args:
        goals: (m,), an item for each pair.
        starts: (m,), the item that each chain starts from.
        after: (n,), the item after each item.

    >>> are_reached(np.array([2, 0, 1]), np.array([0, 2, 1]), np.array([1, 2, -1])).tolist()
    [True, False, False]
    """
    is_round = is_on_cycle(after, np.arange(len(after)))
    # Cut where it enters a cycle, each chain is a path up a tree.
    up = np.append(np.where(is_round, -1, after), -1)
    depth = (up >= 0).astype(np.int64)
    top = np.where(up >= 0, up, np.arange(len(up)))
    steps = [up]
    while (steps[-1] >= 0).any():
        depth, top = depth + depth[steps[-1]], top[top]
        steps.append(steps[-1][steps[-1]])
    distance = depth[starts] - depth[goals]
    here = starts
    for power, step in enumerate(steps):
        here = np.where((distance > 0) & (distance >> power & 1 > 0), step[here], here)
    found = (distance > 0) & (here == goals)
    if is_round.any():
        least, ahead = np.arange(len(after)), np.where(is_round, after, np.arange(len(after)))
        for _ in range(len(after).bit_length()):
            least, ahead = np.minimum(least, least[ahead]), ahead[ahead]
        entry = top[starts]
        found |= is_round[goals] & is_round[entry] & (least[goals] == least[entry])
    return np.asarray(found)


def rounded(values: Array) -> Array:
    """Return sort keys rounded to micrometres, so that translating a scene does not change the order."""
    return np.asarray(values.round(_DECIMALS))


def ratios(parts: Array, wholes: Array) -> Array:
    """Return parts / wholes; wholes smaller than 1e-12 count as 1e-12."""
    return np.asarray(parts / np.maximum(wholes, _SMALLEST))
