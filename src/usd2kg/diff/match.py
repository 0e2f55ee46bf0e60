"""Which new thing is which old one: by path, and where that is gone by asset, box, name and place.

The rounds, each of things that no round before has matched, one to one:

1. The same prim path, unless asset, size and class (where known) have all become others.
2. The same path below a group or thing that has another path now, as things of unique names show.
3. The same place.
4. The same name, the nearest first, however far.
5. The same asset and no other class, within `Tolerances.match_within_m`; without assets, the same class within half of
   that.

In rounds 2 to 5 the boxes have the same size, and the assets, where both have some, share an identifier.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from usd2kg.diff.geometry import is_same_size
from usd2kg.diff.object_state import ObjectState
from usd2kg.diff.object_table import AssetAgreement, Flags, ObjectTable
from usd2kg.diff.pairs import Index, Pairs, Points, close_pairs, equal_pairs, pick
from usd2kg.diff.paths import above, differing_prefixes
from usd2kg.diff.tolerances import Tolerances

__all__ = ["Matching", "ObjectMatch", "match_objects"]

MatchRound = Literal["path", "group", "place", "name", "asset"]
_SMALLEST_SHARE = 10
"""A group's new path must be that of a tenth of those that left the old one, and of those that came to the new one."""
_NEAREST = 1e-6
"""Metres: what is nearer stands in the same place, whatever the tolerance."""
_FIRST_RADIUS = 0.05
"""Metres: where the search for things of one name begins; then twice as far, and so on."""
_STEPS = 7
"""How often a radius is doubled."""

_Allows = Callable[[ObjectTable, Index, Index], Flags]


@dataclass(frozen=True, slots=True)
class ObjectMatch:
    """An old thing and the new one that it is."""

    old: ObjectState
    new: ObjectState
    by: MatchRound
    """The round that found it."""


@dataclass(frozen=True, slots=True)
class Matching:
    """What became of each thing."""

    matches: tuple[ObjectMatch, ...]
    """By the new path."""
    removed: tuple[ObjectState, ...]
    """Old things that no new one is, by path."""
    added: tuple[ObjectState, ...]
    """New things that no old one is, by path."""


def match_objects(
    old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances | None = None
) -> Matching:
    """Return which new thing is which old one; the other way round it is the same.

    Rounds 4 and 5 look close by first, then twice as far, and so on; at each step the pairs whose names and classes
    agree come first, and of those the nearest.
    """
    rounds = _Rounds(old, new, tolerances or Tolerances())
    rounds.by_path()
    rounds.by_group()
    rounds.by_place()
    rounds.by_name()
    rounds.by_asset()
    return rounds.result()


class _Rounds:
    """The things that are still free, and the matches so far."""

    def __init__(self, old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances) -> None:
        self.tolerances = tolerances
        self.matches: list[ObjectMatch] = []
        self.old = {thing.prim_path: thing for thing in old}
        self.new = {thing.prim_path: thing for thing in new}

    def result(self) -> Matching:
        matches = sorted(self.matches, key=lambda match: match.new.prim_path)
        removed, added = (tuple(free[path] for path in sorted(free)) for free in (self.old, self.new))
        return Matching(tuple(matches), removed, added)

    def by_path(self) -> None:
        for path in self.old.keys() & self.new.keys():
            if not _is_another(self.old[path], self.new[path], self.tolerances):
                self._take(self.old[path], self.new[path], "path")

    def by_group(self) -> None:
        """ObjectMatch things below what has another path now."""
        found = list(self._below_groups())
        is_alike = self._are_alike([(old, new) for _, old, new in found])
        likely = [each for each, alike in zip(found, is_alike, strict=True) if alike]
        # Two groups could lead to one path; that of more things goes first.
        likely.sort(key=lambda each: (-each[0], sorted((each[1].prim_path, each[2].prim_path))))
        sizes = Counter(differing_prefixes(old.prim_path, new.prim_path) for _, old, new in likely)
        for _, old, new in likely:
            if old.prim_path in self.old and new.prim_path in self.new:
                is_group = sizes[differing_prefixes(old.prim_path, new.prim_path)] > 1
                self._take(old, new, "group" if is_group else "name")

    def _below_groups(self) -> Iterator[tuple[int, ObjectState, ObjectState]]:
        """Yield an old thing, what now has the path that it would have, and how many things went that way."""
        groups: dict[str, list[tuple[str, int]]] = {}
        for (before, after), votes in self._groups().items():
            groups.setdefault(before, []).append((after, votes))
        for path, thing in self.old.items():
            for before in above(path):
                for after, votes in groups.get(before, ()):
                    other = self.new.get(after + path.removeprefix(before))
                    if other is not None:
                        yield votes, thing, other

    def _groups(self) -> dict[tuple[str, str], int]:
        """Return (path before, path after) of groups → number of things of unique names that went that way."""
        old, new = _by_unique_name(self.old.values()), _by_unique_name(self.new.values())
        shared = [(old[name], new[name]) for name in sorted(old.keys() & new.keys())]
        is_alike = self._are_alike(shared)
        stems = (differing_prefixes(before.prim_path, after.prim_path) for before, after in shared)
        votes = Counter(stem for stem, alike in zip(stems, is_alike, strict=True) if alike)
        left, came = Counter[str](), Counter[str]()
        for (before, after), count in votes.items():
            left[before] += count
            came[after] += count
        return {
            (before, after): count
            for (before, after), count in votes.items()
            if count * _SMALLEST_SHARE >= max(left[before], came[after])
        }

    def by_place(self) -> None:
        """ObjectMatch things that stand where one stood."""
        self._by_distance("place", [max(self.tolerances.moved_m, _NEAREST)], _alike)

    def by_name(self) -> None:
        """ObjectMatch things of one name, the nearest first."""
        radii = [_FIRST_RADIUS * 2**step for step in range(_STEPS)]
        self._by_distance("name", radii, _alike, of_one_name=True)
        table = self._columns()
        for pairs in equal_pairs(*table.names):
            self._pick(
                table, pairs, lambda table, i, j: _alike(table, i, j) & np.isfinite(table.distances(i, j)), "name"
            )

    def by_asset(self) -> None:
        """ObjectMatch things of other names that come from one asset or, without any, are of one class."""
        farthest = self.tolerances.match_within_m
        radii = [farthest / 2**step for step in range(_STEPS, -1, -1)]

        def is_likely(table: ObjectTable, i: Index, j: Index) -> Flags:
            assets = table.compare_assets(i, j)
            by_asset = (assets == AssetAgreement.SHARED) & ~table.has_other_class(i, j)
            by_class = (assets == AssetAgreement.UNKNOWN) & table.has_same_class(i, j)
            likely: Flags = by_asset | (by_class & (table.distances(i, j) <= farthest / 2))
            return _alike(table, i, j) & likely

        self._by_distance("asset", radii, is_likely)

    def _by_distance(
        self, way: MatchRound, radii: Sequence[float], allows: _Allows, *, of_one_name: bool = False
    ) -> None:
        """ObjectMatch what is allowed within the first radius, then what is left within the next one…"""
        table = self._columns()
        for radius in filter(None, radii):
            if not (table.old_is_free.any() and table.new_is_free.any()):
                return
            rows = np.flatnonzero(table.old_is_free), np.flatnonzero(table.new_is_free)
            colors = table.names if of_one_name else (np.zeros_like(table.names[0]), np.zeros_like(table.names[1]))
            old, new = (Points(table.places[k][rows[k]], colors[k][rows[k]]) for k in (0, 1))
            for a, b in close_pairs(old, new, radius):
                self._pick(table, (rows[0][a], rows[1][b]), allows, way)

    def _columns(self) -> ObjectTable:
        old, new = ([free[path] for path in sorted(free)] for free in (self.old, self.new))
        return ObjectTable(old, new, self.tolerances)

    def _pick(self, table: ObjectTable, pairs: Pairs, allows: _Allows, way: MatchRound) -> None:
        i, j = pairs
        is_free = table.old_is_free[i] & table.new_is_free[j]
        i, j = i[is_free], j[is_free]
        is_allowed = allows(table, i, j)
        i, j = i[is_allowed], j[is_allowed]
        for at in pick(i, j, table.keys(i, j)):
            self._take(table.old[i[at]], table.new[j[at]], way)
            table.old_is_free[i[at]] = table.new_is_free[j[at]] = False

    def _take(self, old: ObjectState, new: ObjectState, way: MatchRound) -> None:
        del self.old[old.prim_path], self.new[new.prim_path]
        self.matches.append(ObjectMatch(old, new, way))

    def _are_alike(self, pairs: Sequence[tuple[ObjectState, ObjectState]]) -> list[bool]:
        table = ObjectTable([old for old, _ in pairs], [new for _, new in pairs], self.tolerances)
        rows = np.arange(len(pairs))
        alike: list[bool] = _alike(table, rows, rows).tolist()
        return alike


def _alike(table: ObjectTable, i: Index, j: Index) -> Flags:
    """Return where two things could be one: the same size and no other asset; without any size, the same asset."""
    assets = table.compare_assets(i, j)
    by_size: Flags = table.has_same_size(i, j) & (assets != AssetAgreement.DIFFER)
    by_asset: Flags = table.lacks_size(i, j) & (assets == AssetAgreement.SHARED)
    return by_size | by_asset


def _is_another(old: ObjectState, new: ObjectState, tolerances: Tolerances) -> bool:
    """Return whether a path is that of another thing now: asset and size are others, and the class where known."""
    if not (old.assets and new.assets and old.assets.isdisjoint(new.assets)) or old.size is None or new.size is None:
        return False
    is_resized = not is_same_size(sorted(old.size), sorted(new.size), tolerances)
    is_reclassified = not (old.classes and new.classes) or old.classes != new.classes
    return is_resized and is_reclassified


def _by_unique_name(things: Iterable[ObjectState]) -> dict[str, ObjectState]:
    found: dict[str, ObjectState] = {}
    counts = Counter[str]()
    for thing in things:
        found[thing.name] = thing
        counts[thing.name] += 1
    return {name: thing for name, thing in found.items() if counts[name] == 1}
