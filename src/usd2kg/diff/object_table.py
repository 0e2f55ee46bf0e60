"""ObjectTable: old and new objects as arrays, to compare millions of pairs at once."""

from collections.abc import Hashable, Iterable, Sequence
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from usd2kg.diff.object_state import ObjectState
from usd2kg.diff.pairs import Index
from usd2kg.diff.settings import COMPARISON
from usd2kg.diff.tolerances import Tolerances

__all__ = ["AssetAgreement", "Mask", "ObjectTable"]

Mask = NDArray[np.bool_]
_UNKNOWN = -1
_NO_VECTOR = (np.nan,) * 3


class AssetAgreement(IntEnum):
    """Relation between the asset identifiers of two objects."""

    DIFFER = 0
    SHARED = 1
    ONE_UNKNOWN = 2
    UNKNOWN = 3


class ObjectTable:
    """Old and new objects as columns. Pairs are given by rows `i` of old objects and rows `j` of new ones."""

    def __init__(self, old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances) -> None:
        self._tolerances = tolerances
        self.old, self.new = old, new
        self.old_is_free, self.new_is_free = np.ones(len(old), np.bool_), np.ones(len(new), np.bool_)
        both = (*old, *new)
        count = len(old)
        places = np.array([state.place or _NO_VECTOR for state in both], dtype=np.float64).reshape(-1, 3)
        # Sorted, since a rotation may exchange the sides of the world box.
        sizes = np.array([sorted(state.size) if state.size else _NO_VECTOR for state in both]).reshape(-1, 3)
        ranks = {path: rank for rank, path in enumerate(sorted({state.prim_path for state in both}))}
        self._assets = list(dict.fromkeys(state.assets for state in both))
        self.places = places[:count], places[count:]
        self._sizes = sizes[:count], sizes[count:]
        self.names = _encode((state.name for state in both), count)
        self.classes = _encode((state.classes or None for state in both), count)
        self._asset_codes = _encode((state.assets for state in both), count)
        by_path = np.array([ranks[state.prim_path] for state in both], dtype=np.int64)
        self._path_ranks = by_path[:count], by_path[count:]

    def distances(self, i: Index, j: Index) -> NDArray[np.float64]:
        """Return the distance of each pair in metres; infinite if a place is unknown."""
        distances: NDArray[np.float64] = np.linalg.norm(self.places[0][i] - self.places[1][j], axis=1)
        return np.nan_to_num(distances, nan=np.inf)

    def has_same_size(self, i: Index, j: Index) -> Mask:
        """Return whether the sizes of each pair agree; False if one is unknown."""
        old, new = self._sizes[0][i], self._sizes[1][j]
        longer, limits = np.maximum(old, new), self._tolerances
        limit = np.maximum(COMPARISON.noise_m, np.minimum(limits.resized_m, limits.resized_percent / 100 * longer))
        same: Mask = (np.abs(old - new) <= limit).all(axis=1)
        return same

    def lacks_size(self, i: Index, j: Index) -> Mask:
        """Return whether neither size of each pair is known."""
        lacks: Mask = np.isnan(self._sizes[0][i, 0]) & np.isnan(self._sizes[1][j, 0])
        return lacks

    def compare_assets(self, i: Index, j: Index) -> NDArray[np.int8]:
        """Return the `AssetAgreement` of each pair."""
        codes = self._asset_codes[0][i] * len(self._assets) + self._asset_codes[1][j]
        distinct, positions = np.unique(codes, return_inverse=True)
        pairs = (divmod(code, len(self._assets)) for code in distinct.tolist())
        found = [_compare_assets(self._assets[old], self._assets[new]) for old, new in pairs]
        return np.array(found, dtype=np.int8)[positions]

    def has_same_class(self, i: Index, j: Index) -> Mask:
        """Return whether both classes of each pair are known and equal."""
        same: Mask = (self.classes[0][i] == self.classes[1][j]) & (self.classes[0][i] != _UNKNOWN)
        return same

    def has_other_class(self, i: Index, j: Index) -> Mask:
        """Return whether both classes of each pair are known and differ."""
        old, new = self.classes[0][i], self.classes[1][j]
        other: Mask = (old != _UNKNOWN) & (new != _UNKNOWN) & (old != new)
        return other

    def preference_keys(self, i: Index, j: Index) -> tuple[NDArray[np.float64] | Index, ...]:
        """Return sort keys of pairs: differing name and class, distance, then paths; symmetric in old and new."""
        differ = (self.names[0][i] != self.names[1][j]).astype(np.int64) + self.has_other_class(i, j)
        old, new = self._path_ranks[0][i], self._path_ranks[1][j]
        return differ, self.distances(i, j), np.minimum(old, new), np.maximum(old, new)


def _compare_assets(old: frozenset[str], new: frozenset[str]) -> AssetAgreement:
    if old and new:
        return AssetAgreement.DIFFER if old.isdisjoint(new) else AssetAgreement.SHARED
    return AssetAgreement.ONE_UNKNOWN if old or new else AssetAgreement.UNKNOWN


def _encode(values: Iterable[Hashable], count: int) -> tuple[Index, Index]:
    """Return the values as integer codes, -1 for None, split after the first `count` values."""
    numbers: dict[Hashable, int] = {}
    codes = [_UNKNOWN if v is None else numbers.setdefault(v, len(numbers)) for v in values]
    both = np.array(codes, dtype=np.int64)
    return both[:count], both[count:]
