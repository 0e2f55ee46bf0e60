"""compare_objects: what was added, removed, renamed, moved, turned, resized, classed anew or relates anew."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from usd2kg.diff.anchors import AnchorMap
from usd2kg.diff.geometry import carried_to, is_same_size, moved_by, turned_by
from usd2kg.diff.match import Matching, ObjectMatch, match_objects
from usd2kg.diff.object_state import Link, ObjectState, Vector
from usd2kg.diff.paths import above
from usd2kg.diff.tolerances import Tolerances

__all__ = ["USUAL_KINDS", "Change", "Changes", "Move", "compare_objects"]

USUAL_KINDS = ("on", "inside", "part-of", "room")
"""The relations that are compared unless others are asked for."""
_CARRYING = ("on", "inside", "part-of")
_MASS_SHARE = 0.01
"""Of the heavier one: what differs by less weighs the same."""


class Move(NamedTuple):
    """From where to where."""

    start: Vector
    """Metres, world frame: the origin of the thing's frame, or where that stayed, the middle of its box."""
    end: Vector
    distance: float
    """Metres."""


@dataclass(frozen=True, slots=True)
class Change:
    """An old thing, the new one that it is, and how they differ; None, 0 or empty is no difference."""

    match: ObjectMatch
    move: Move | None = None
    carrier: str | None = None
    """New path of the thing that took it along, by which its move and turn are explained."""
    turned_degrees: float = 0.0
    resized: tuple[Vector, Vector] | None = None
    """Extents before and after, metres."""
    holds_changes: bool = False
    """Whether things nested below its prim were added, removed or moved, which its box goes around, too."""
    reclassified: bool = False
    mass: tuple[float | None, float | None] | None = None
    """Kilograms before and after."""
    assets: tuple[frozenset[str], frozenset[str]] | None = None
    """Identifiers before and after, where none is shared."""
    gained: tuple[Link, ...] = ()
    """Relations that it did not have before, by new paths."""
    lost: tuple[Link, ...] = ()
    """Relations that it no longer has, by old paths."""

    @property
    def is_renamed(self) -> bool:
        """Whether its prim path is another."""
        return self.match.old.prim_path != self.match.new.prim_path

    @property
    def is_none(self) -> bool:
        """Whether nothing differs."""
        return self == Change(self.match) and not self.is_renamed


@dataclass(frozen=True)
class Changes:
    """What became of all things of a graph or scene."""

    changed: tuple[Change, ...]
    """The things that differ, by new path."""
    added: tuple[ObjectState, ...]
    removed: tuple[ObjectState, ...]
    old_count: int
    """Things before."""
    new_count: int
    matches: tuple[ObjectMatch, ...]
    """All things that are in both."""
    kinds: frozenset[str]
    """The kinds of relations that were compared."""

    @property
    def is_empty(self) -> bool:
        """Whether no thing differs."""
        return not (self.changed or self.added or self.removed)

    @cached_property
    def counts(self) -> dict[str, int]:
        """Return how many things changed in each way; a thing can count in several."""
        ways: dict[str, list[object]] = {
            "renamed": [c.is_renamed for c in self.changed],
            "moved": [c.move for c in self.changed],
            "turned": [c.turned_degrees for c in self.changed],
            "resized": [c.resized for c in self.changed],
            "reclassified": [c.reclassified for c in self.changed],
            "other mass": [c.mass for c in self.changed],
            "other asset": [c.assets for c in self.changed],
        }
        counts = {name: sum(1 for each in found if each) for name, found in ways.items()}
        gained, lost = (sum(len(getattr(c, name)) for c in self.changed) for name in ("gained", "lost"))
        ends = {"added": len(self.added), "removed": len(self.removed)}
        return {**ends, **counts, "relations gained": gained, "relations lost": lost}


def compare_objects(
    old: Sequence[ObjectState],
    new: Sequence[ObjectState],
    tolerances: Tolerances | None = None,
    kinds: Iterable[str] = USUAL_KINDS,
) -> Changes:
    """Return what differs between the things before and after; the other way round it is the mirror image.

    Args:
        old: things of one scene, each prim path once.
        new: the same of the other one.
        tolerances: what is no change yet.
        kinds: the kinds of relations that are compared.
    """
    tolerances = tolerances or Tolerances()
    wanted = frozenset(kinds)
    matching = match_objects(old, new, tolerances)
    compares_classes = any(thing.classes for thing in old) and any(thing.classes for thing in new)
    changed = _Comparison(matching, tolerances, wanted, compares_classes).changes()
    added, removed = (
        tuple(_with_links(thing, wanted) for thing in ends) for ends in (matching.added, matching.removed)
    )
    return Changes(changed, added, removed, len(old), len(new), matching.matches, wanted)


def _with_links(thing: ObjectState, kinds: frozenset[str]) -> ObjectState:
    return replace(thing, links=frozenset(link for link in thing.links if link.kind in kinds))


class _Comparison:
    """Compares matched things, first each with itself, then with what they hold and what carries them."""

    def __init__(
        self, matching: Matching, tolerances: Tolerances, kinds: frozenset[str], compares_classes: bool
    ) -> None:
        self._matching = matching
        self._tolerances = tolerances
        self._kinds = kinds
        self._compares_classes = compares_classes
        self._anchors = AnchorMap(matching.matches, matching.removed, matching.added)

    def changes(self) -> tuple[Change, ...]:
        """Return the matched things that differ."""
        own = [self._compare(match) for match in self._matching.matches]
        holders = self._holders(own)
        moved = [self._with_contents(change, holders) for change in own]
        by_path = {change.match.new.prim_path: change for change in moved}
        found = (self._with_carrier(change, by_path) for change in moved)
        return tuple(change for change in found if not change.is_none)

    def _compare(self, match: ObjectMatch) -> Change:
        old, new = match.old, match.new
        distance = moved_by(old.position, new.position)
        move = None
        if old.position is not None and new.position is not None and self._is_far(distance):
            move = Move(old.position, new.position, distance)
        angle = turned_by(old.orientation, new.orientation)
        is_turned = angle > self._tolerances.turned_degrees
        gained, lost = self._anchors.gained_and_lost(match, self._kinds)
        return Change(
            match,
            move,
            turned_degrees=angle if is_turned else 0.0,
            resized=self._resized(old.size, new.size, is_turned),
            reclassified=self._compares_classes and old.classes != new.classes,
            mass=(old.mass_kg, new.mass_kg) if _weighs_otherwise(old.mass_kg, new.mass_kg) else None,
            assets=(old.assets, new.assets) if old.assets != new.assets and old.assets.isdisjoint(new.assets) else None,
            gained=gained,
            lost=lost,
        )

    def _resized(self, old: Vector | None, new: Vector | None, is_turned: bool) -> tuple[Vector, Vector] | None:
        if old is None or new is None:
            return None
        # A thing that was turned may have its sides in another order.
        before, after = (sorted(old), sorted(new)) if is_turned else (old, new)
        return None if is_same_size(before, after, self._tolerances) else (old, new)

    def _holders(self, own: Iterable[Change]) -> set[str]:
        """Return the paths, old and new ones, of all prims below which something changed its place or size."""
        ends = (*self._matching.removed, *self._matching.added)
        shifted = (c.match for c in own if c.move or c.turned_degrees or c.resized or c.is_renamed)
        paths = {thing.prim_path for thing in ends}
        paths.update(thing.prim_path for match in shifted for thing in (match.old, match.new))
        return {holder for path in paths for holder in above(path)}

    def _with_contents(self, change: Change, holders: set[str]) -> Change:
        """Return the change with what follows from nested things; geometry that moves within its frame moves, too."""
        old, new = change.match.old, change.match.new
        if old.prim_path in holders or new.prim_path in holders:
            return replace(change, holds_changes=change.resized is not None)
        if change.move or change.turned_degrees or change.resized or old.center is None or new.center is None:
            return change
        distance = moved_by(old.center, new.center)
        return replace(change, move=Move(old.center, new.center, distance)) if self._is_far(distance) else change

    def _is_far(self, distance: float) -> bool:
        return distance > self._tolerances.moved_m

    def _with_carrier(self, change: Change, by_path: Mapping[str, Change]) -> Change:
        if not (change.move or change.turned_degrees):
            return change
        for path in self._anchors.carriers(change.match, _CARRYING):
            if path != change.match.new.prim_path and self._is_carried(change, by_path[path]):
                return replace(change, carrier=path)
        return change

    def _is_carried(self, change: Change, carrier: Change) -> bool:
        """Return whether a thing went where, and turned as, something that moved as a whole with it would."""
        if not (carrier.move or carrier.turned_degrees):
            return False
        if abs(carrier.turned_degrees - change.turned_degrees) > self._tolerances.turned_degrees:
            return False
        old, new = change.match.old, change.match.new
        starts, ends = (old.position, new.position) if old.position and new.position else (old.center, new.center)
        expected = carried_to(starts, carrier.match.old, carrier.match.new) if starts else None
        return expected is not None and ends is not None and not self._is_far(moved_by(expected, ends))


def _weighs_otherwise(old: float | None, new: float | None) -> bool:
    if old is None or new is None:
        return old is not new
    return abs(old - new) > _MASS_SHARE * max(abs(old), abs(new))
