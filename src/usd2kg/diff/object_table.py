"""Things as columns of numbers, so that millions of pairs are compared at once."""

from collections.abc import Hashable, Iterable, Sequence
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from usd2kg.diff.object_state import ObjectState
from usd2kg.diff.pairs import Index
from usd2kg.diff.tolerances import Tolerances

__all__ = ["AssetAgreement", "ObjectTable"]

Flags = NDArray[np.bool_]
_UNKNOWN = -1
_MOST_COMBINATIONS = 16_000_000


class AssetAgreement(IntEnum):
    """How the identifiers of two assets go together."""

    DIFFER = 0
    SHARED = 1
    ONE_UNKNOWN = 2
    UNKNOWN = 3


class ObjectTable:
    """The old and the new things side by side. All that it tells of pairs takes an old and a new row of each."""

    def __init__(self, old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances) -> None:
        self._tolerances = tolerances
        self.old, self.new = old, new
        self.old_is_free, self.new_is_free = np.ones(len(old), np.bool_), np.ones(len(new), np.bool_)
        both = (*old, *new)
        ends = len(old)
        places = np.array([thing.place or (np.nan,) * 3 for thing in both], dtype=np.float64).reshape(-1, 3)
        # Ascending, for a thing that was turned may have its sides in another order.
        sizes = np.array([sorted(thing.size) if thing.size else (np.nan,) * 3 for thing in both]).reshape(-1, 3)
        ranks = {path: rank for rank, path in enumerate(sorted({thing.prim_path for thing in both}))}
        self._assets = list(dict.fromkeys(thing.assets for thing in both))
        self.places = places[:ends], places[ends:]
        self._sizes = sizes[:ends], sizes[ends:]
        self.names = _codes((thing.name for thing in both), ends)
        self.classes = _codes((thing.classes or None for thing in both), ends)
        self._asset_codes = _codes((thing.assets for thing in both), ends)
        by_path = np.array([ranks[thing.prim_path] for thing in both], dtype=np.int64)
        self._ranks = by_path[:ends], by_path[ends:]

    def distances(self, i: Index, j: Index) -> NDArray[np.float64]:
        """Return how far apart two things are, metres; infinite where a place is not known."""
        apart: NDArray[np.float64] = np.linalg.norm(self.places[0][i] - self.places[1][j], axis=1)
        return np.nan_to_num(apart, nan=np.inf)

    def has_same_size(self, i: Index, j: Index) -> Flags:
        """Return where the sizes agree; False where one is not known."""
        old, new = self._sizes[0][i], self._sizes[1][j]
        longer, limits = np.maximum(old, new), self._tolerances
        relative = np.minimum(limits.resized_m, limits.resized_percent / 100 * longer)
        same: Flags = (np.abs(old - new) <= np.maximum(limits.side(0.0), relative)).all(axis=1)
        return same

    def lacks_size(self, i: Index, j: Index) -> Flags:
        """Return where neither size is known."""
        lacks: Flags = np.isnan(self._sizes[0][i, 0]) & np.isnan(self._sizes[1][j, 0])
        return lacks

    def compare_assets(self, i: Index, j: Index) -> NDArray[np.int8]:
        """Return how the assets go together, one of the numbers of `AssetAgreement`."""
        width = len(self._assets)
        codes = self._asset_codes[0][i] * width + self._asset_codes[1][j]
        if width * width > _MOST_COMBINATIONS:
            present, codes = np.unique(codes, return_inverse=True)
            found: NDArray[np.int8] = self._compare_each(present)[codes]
            return found
        present = np.flatnonzero(np.bincount(codes, minlength=width * width))
        table = np.zeros(width * width, dtype=np.int8)
        table[present] = self._compare_each(present)
        found = table[codes]
        return found

    def _compare_each(self, combinations: Index) -> NDArray[np.int8]:
        pairs = (divmod(code, len(self._assets)) for code in combinations.tolist())
        return np.array([_compare(self._assets[old], self._assets[new]) for old, new in pairs], dtype=np.int8)

    def has_same_class(self, i: Index, j: Index) -> Flags:
        """Return where both classes are known and agree."""
        same: Flags = (self.classes[0][i] == self.classes[1][j]) & (self.classes[0][i] != _UNKNOWN)
        return same

    def has_other_class(self, i: Index, j: Index) -> Flags:
        """Return where both classes are known and differ."""
        old, new = self.classes[0][i], self.classes[1][j]
        other: Flags = (old != _UNKNOWN) & (new != _UNKNOWN) & (old != new)
        return other

    def keys(self, i: Index, j: Index) -> tuple[NDArray[np.float64] | Index, ...]:
        """Return by what pairs are preferred: name and class agree, then near, then by path, alike either way round."""
        differ = (self.names[0][i] != self.names[1][j]).astype(np.int64) + self.has_other_class(i, j)
        old, new = self._ranks[0][i], self._ranks[1][j]
        return differ, self.distances(i, j), np.minimum(old, new), np.maximum(old, new)


def _compare(old: frozenset[str], new: frozenset[str]) -> AssetAgreement:
    if old and new:
        return AssetAgreement.DIFFER if old.isdisjoint(new) else AssetAgreement.SHARED
    return AssetAgreement.ONE_UNKNOWN if old or new else AssetAgreement.UNKNOWN


def _codes(values: Iterable[Hashable], ends: int) -> tuple[Index, Index]:
    """Return a number for each value, equal ones for equal values; those up to `ends`, and the others."""
    numbers: dict[Hashable, int] = {}
    codes = [_UNKNOWN if v is None else numbers.setdefault(v, len(numbers)) for v in values]
    both = np.array(codes, dtype=np.int64)
    return both[:ends], both[ends:]
