"""Records of columns: chosen from, put together, and select_rows apart by group."""

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["concatenate_rows", "first_of_each_group", "is_on_cycle", "rank_in_group", "select_rows"]

Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]
_Columns = TypeVar("_Columns", bound=tuple[Any, ...])
"""A NamedTuple of arrays of the same length."""


def select_rows(columns: _Columns, chosen: Mask | Indices) -> _Columns:
    """Return the chosen rows of a record of columns."""
    return _same_type(columns, [column[chosen] for column in columns])


def concatenate_rows(portions: list[_Columns]) -> _Columns:
    """Return the rows of all portions, of which there is at least one, in one record of columns."""
    return _same_type(portions[0], [np.concatenate(column) for column in zip(*portions, strict=True)])


def _same_type(like: _Columns, columns: list[NDArray[Any]]) -> _Columns:
    record: Any = type(like)
    made: _Columns = record(*columns)
    return made


def rank_in_group(groups: Indices) -> Indices:
    """Return the place of each item among those of its group, of items sorted by group.

    >>> rank_in_group(np.array([3, 3, 7, 7, 7])).tolist()
    [0, 1, 0, 1, 2]
    """
    starts = np.flatnonzero(np.diff(groups, prepend=-1))
    return np.asarray(np.arange(len(groups)) - np.repeat(starts, np.diff(np.append(starts, len(groups)))))


def first_of_each_group(groups: Indices, keys: tuple[NDArray[np.generic], ...], most: int = 1) -> Indices:
    """Return where the first items of each group are, group by group, in the order of the keys.

    Args:
        groups: the group of each item, not negative.
        keys: the last one counts most, as in `numpy.lexsort`.
        most: how many of each group.
    """
    order = np.lexsort((*keys, groups))
    return np.asarray(order[rank_in_group(groups[order]) < most])


def is_on_cycle(after: Indices, starts: Indices) -> Mask:
    """Return for each start whether the way from one item to the one after it, -1 for the end, leads back to it.

    >>> is_on_cycle(np.array([1, 0, 1]), np.array([0, 1, 2])).tolist()
    [True, True, False]
    """
    # By strides that double: after n of them, every way has come to its end or runs in a circle.
    here = np.append(after, -1)
    ended = here.copy()
    for _ in range(len(after).bit_length()):
        ended = ended[ended]
    if not (ended[starts] >= 0).any():
        return np.zeros(len(starts), np.bool_)
    on_circle = np.zeros(len(here), np.bool_)
    # What is reached from far along a way that never ends lies on a circle, and so does all after it.
    reached = np.unique(ended[ended >= 0])
    while len(reached) and not on_circle[reached].all():
        on_circle[reached] = True
        reached = here[reached]
    return np.asarray(on_circle[starts])
