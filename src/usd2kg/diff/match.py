"""match_objects: match old with new objects by prim path, otherwise by asset, size, name and place.

Matching is one to one, in rounds; each round considers the objects still unmatched:

1. The same prim path, unless asset, size and (if known) class all differ.
2. The same path below a group or object whose path changed, as objects with unique names show.
3. The same place.
4. The same name, nearest first, at any distance.
5. The same asset and no differing class, within `Tolerances.match_within_m`; without assets, the same class within
   half of that distance.

In rounds 2 to 5 the sizes must agree, and so must the assets if both are known.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from usd2kg.diff.geometry import is_same_size
from usd2kg.diff.object_state import ObjectState
from usd2kg.diff.object_table import AssetAgreement, Mask, ObjectTable
from usd2kg.diff.pairs import GroupedPoints, Index, Pairs, close_pairs, equal_pairs, pick_pairs
from usd2kg.diff.paths import ancestor_paths, differing_prefixes
from usd2kg.diff.settings import MATCHING
from usd2kg.diff.tolerances import DEFAULT_TOLERANCES, Tolerances

__all__ = ["Matching", "ObjectMatch", "match_objects"]

MatchRound = Literal["path", "group", "place", "name", "asset"]
_Predicate = Callable[[ObjectTable, Index, Index], Mask]


@dataclass(frozen=True, slots=True)
class ObjectMatch:
    """An old object and the matching new object."""

    old: ObjectState
    new: ObjectState
    by: MatchRound
    """The round that matched them."""


@dataclass(frozen=True, slots=True)
class Matching:
    """Matched and unmatched objects."""

    matches: tuple[ObjectMatch, ...]
    """By new path."""
    removed: tuple[ObjectState, ...]
    """Unmatched old objects, by path."""
    added: tuple[ObjectState, ...]
    """Unmatched new objects, by path."""


def match_objects(
    old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances = DEFAULT_TOLERANCES
) -> Matching:
    """Return the matched and unmatched objects; swapping old and new gives the mirror image.

    Rounds 4 and 5 search within a radius that doubles at each step. Within a step, pairs with equal names and classes
    come first, then the nearest.
    """
    rounds = _MatchRounds(old, new, tolerances)
    rounds.match_paths()
    rounds.match_groups()
    rounds.match_places()
    rounds.match_names()
    rounds.match_assets()
    return rounds.result()


class _MatchRounds:
    """The unmatched objects and the matches so far."""

    def __init__(self, old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances) -> None:
        self.tolerances = tolerances
        self.matches: list[ObjectMatch] = []
        self.old = {state.prim_path: state for state in old}
        self.new = {state.prim_path: state for state in new}

    def result(self) -> Matching:
        matches = sorted(self.matches, key=lambda match: match.new.prim_path)
        removed, added = (tuple(free[path] for path in sorted(free)) for free in (self.old, self.new))
        return Matching(tuple(matches), removed, added)

    def match_paths(self) -> None:
        for path in self.old.keys() & self.new.keys():
            if not _is_replaced(self.old[path], self.new[path], self.tolerances):
                self._add(self.old[path], self.new[path], "path")

    def match_groups(self) -> None:
        """Match objects below groups whose path changed."""
        found = list(self._candidates_below_groups())
        is_similar = self._are_similar([(old, new) for _, old, new in found])
        candidates = [each for each, similar in zip(found, is_similar, strict=True) if similar]
        # Two groups can lead to the same path; the group with more votes wins.
        candidates.sort(key=lambda each: (-each[0], sorted((each[1].prim_path, each[2].prim_path))))
        sizes = Counter(differing_prefixes(old.prim_path, new.prim_path) for _, old, new in candidates)
        for _, old, new in candidates:
            if old.prim_path in self.old and new.prim_path in self.new:
                is_group = sizes[differing_prefixes(old.prim_path, new.prim_path)] > 1
                self._add(old, new, "group" if is_group else "name")

    def _candidates_below_groups(self) -> Iterator[tuple[int, ObjectState, ObjectState]]:
        """Yield the votes for a group, an old object below it, and the new object at the path in the new group."""
        groups: dict[str, list[tuple[str, int]]] = {}
        for (before, after), votes in self._moved_groups().items():
            groups.setdefault(before, []).append((after, votes))
        for path, state in self.old.items():
            for before in ancestor_paths(path):
                for after, votes in groups.get(before, ()):
                    other = self.new.get(after + path.removeprefix(before))
                    if other is not None:
                        yield votes, state, other

    def _moved_groups(self) -> dict[tuple[str, str], int]:
        """Return (old path, new path) of groups → votes: number of objects with unique names that moved that way."""
        old, new = _by_unique_name(self.old.values()), _by_unique_name(self.new.values())
        shared = [(old[name], new[name]) for name in sorted(old.keys() & new.keys())]
        is_similar = self._are_similar(shared)
        prefixes = (differing_prefixes(before.prim_path, after.prim_path) for before, after in shared)
        votes = Counter(pair for pair, similar in zip(prefixes, is_similar, strict=True) if similar)
        left, entered = Counter[str](), Counter[str]()
        for (before, after), count in votes.items():
            left[before] += count
            entered[after] += count
        return {
            (before, after): count
            for (before, after), count in votes.items()
            if count / max(left[before], entered[after]) >= MATCHING.min_group_share
        }

    def match_places(self) -> None:
        """Match objects in the same place."""
        self._match_within([max(self.tolerances.moved_m, MATCHING.same_place_m)], "place", _is_similar)

    def match_names(self) -> None:
        """Match objects with the same name, nearest first."""
        radii = [MATCHING.first_radius_m * 2**step for step in range(MATCHING.radius_doublings)]
        self._match_within(radii, "name", _is_similar, has_same_name=True)
        table = self._make_table()
        for pairs in equal_pairs(*table.names):
            self._pick(table, pairs, "name", lambda t, i, j: _is_similar(t, i, j) & np.isfinite(t.distances(i, j)))

    def match_assets(self) -> None:
        """Match objects with other names by asset or, if both have none, by class."""
        reach = self.tolerances.match_within_m
        radii = [reach / 2**step for step in range(MATCHING.radius_doublings, -1, -1)]

        def is_likely(table: ObjectTable, i: Index, j: Index) -> Mask:
            assets = table.compare_assets(i, j)
            by_asset = (assets == AssetAgreement.SHARED) & ~table.has_other_class(i, j)
            is_near = table.distances(i, j) <= MATCHING.class_only_reach * reach
            by_class = (assets == AssetAgreement.UNKNOWN) & table.has_same_class(i, j) & is_near
            likely: Mask = _is_similar(table, i, j) & (by_asset | by_class)
            return likely

        self._match_within(radii, "asset", is_likely)

    def _match_within(
        self, radii: Sequence[float], name: MatchRound, is_allowed: _Predicate, *, has_same_name: bool = False
    ) -> None:
        """Match the allowed pairs within each radius in turn."""
        table = self._make_table()
        groups = table.names if has_same_name else tuple(np.zeros_like(names) for names in table.names)
        for radius in filter(None, radii):
            if not (table.old_is_free.any() and table.new_is_free.any()):
                return
            rows = np.flatnonzero(table.old_is_free), np.flatnonzero(table.new_is_free)
            old, new = (GroupedPoints(table.places[k][rows[k]], groups[k][rows[k]]) for k in (0, 1))
            for i, j in close_pairs(old, new, radius):
                self._pick(table, (rows[0][i], rows[1][j]), name, is_allowed)

    def _make_table(self) -> ObjectTable:
        old, new = ([free[path] for path in sorted(free)] for free in (self.old, self.new))
        return ObjectTable(old, new, self.tolerances)

    def _pick(self, table: ObjectTable, pairs: Pairs, name: MatchRound, is_allowed: _Predicate) -> None:
        i, j = pairs
        is_free = table.old_is_free[i] & table.new_is_free[j]
        i, j = i[is_free], j[is_free]
        allowed = is_allowed(table, i, j)
        i, j = i[allowed], j[allowed]
        for at in pick_pairs(i, j, table.preference_keys(i, j)):
            self._add(table.old[i[at]], table.new[j[at]], name)
            table.old_is_free[i[at]] = table.new_is_free[j[at]] = False

    def _add(self, old: ObjectState, new: ObjectState, name: MatchRound) -> None:
        del self.old[old.prim_path], self.new[new.prim_path]
        self.matches.append(ObjectMatch(old, new, name))

    def _are_similar(self, pairs: Sequence[tuple[ObjectState, ObjectState]]) -> list[bool]:
        table = ObjectTable([old for old, _ in pairs], [new for _, new in pairs], self.tolerances)
        rows = np.arange(len(pairs))
        similar: list[bool] = _is_similar(table, rows, rows).tolist()
        return similar


def _is_similar(table: ObjectTable, i: Index, j: Index) -> Mask:
    """Return whether each pair has the same size and no differing asset, or no size but the same asset."""
    assets = table.compare_assets(i, j)
    by_size: Mask = table.has_same_size(i, j) & (assets != AssetAgreement.DIFFER)
    by_asset: Mask = table.lacks_size(i, j) & (assets == AssetAgreement.SHARED)
    return by_size | by_asset


def _is_replaced(old: ObjectState, new: ObjectState, tolerances: Tolerances) -> bool:
    """Return whether the path now belongs to another object: asset, size and (if known) class differ."""
    if not (old.assets and new.assets and old.assets.isdisjoint(new.assets)) or old.size is None or new.size is None:
        return False
    is_resized = not is_same_size(sorted(old.size), sorted(new.size), tolerances)
    is_reclassified = not (old.classes and new.classes) or old.classes != new.classes
    return is_resized and is_reclassified


def _by_unique_name(states: Iterable[ObjectState]) -> dict[str, ObjectState]:
    found: dict[str, ObjectState] = {}
    counts = Counter[str]()
    for state in states:
        found[state.name] = state
        counts[state.name] += 1
    return {name: state for name, state in found.items() if counts[name] == 1}
