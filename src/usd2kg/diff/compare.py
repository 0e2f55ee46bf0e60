"""compare_objects: added, removed and changed objects between two graphs or scenes."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from usd2kg.diff.anchors import AnchorMap
from usd2kg.diff.geometry import distance_between, is_same_size, rotation_angle, transform_rigidly
from usd2kg.diff.match import Matching, ObjectMatch, match_objects
from usd2kg.diff.object_state import Link, ObjectState, Vector
from usd2kg.diff.paths import ancestor_paths
from usd2kg.diff.settings import COMPARISON
from usd2kg.diff.tolerances import DEFAULT_TOLERANCES, Tolerances

__all__ = ["USUAL_KINDS", "Change", "Changes", "Move", "compare_objects"]

USUAL_KINDS = ("on", "inside", "part-of", "room")
"""The kinds of relations that are compared by default."""
_CARRYING_KINDS = ("on", "inside", "part-of")
"""Relations in which a moving anchor carries the object."""


class Move(NamedTuple):
    """A change of place, in metres and the world frame."""

    start: Vector
    """Origin of the object's frame or, if the origin did not move, centre of its box."""
    end: Vector
    distance: float


@dataclass(frozen=True, slots=True)
class Change:
    """The differences between the two states of a matched object; None, 0 or empty where nothing differs."""

    match: ObjectMatch
    move: Move | None = None
    carrier: str | None = None
    """New path of the object that carried this one, which explains its move and turn."""
    turned_degrees: float = 0.0
    resized: tuple[Vector, Vector] | None = None
    """Extents before and after, metres."""
    holds_changes: bool = False
    """Whether a resized box encloses nested objects that were added, removed or changed."""
    reclassified: bool = False
    mass: tuple[float | None, float | None] | None = None
    """Kilograms before and after."""
    assets: tuple[frozenset[str], frozenset[str]] | None = None
    """Identifiers before and after, if none is shared."""
    gained: tuple[Link, ...] = ()
    """New relations, with new anchor paths."""
    lost: tuple[Link, ...] = ()
    """Former relations, with old anchor paths."""

    @property
    def is_renamed(self) -> bool:
        """Whether the prim path differs."""
        return self.match.old.prim_path != self.match.new.prim_path

    @property
    def is_none(self) -> bool:
        """Whether nothing differs."""
        return self == Change(self.match) and not self.is_renamed


@dataclass(frozen=True)
class Changes:
    """The differences between two graphs or scenes."""

    changed: tuple[Change, ...]
    """Sorted by the new prim path."""
    added: tuple[ObjectState, ...]
    removed: tuple[ObjectState, ...]
    old_count: int
    """Number of old objects."""
    new_count: int
    """Number of new objects."""
    matches: tuple[ObjectMatch, ...]
    """All matched objects, changed or not."""
    kinds: frozenset[str]
    """The kinds of relations that were compared."""

    @property
    def is_empty(self) -> bool:
        """Whether no object differs."""
        return not (self.changed or self.added or self.removed)

    @cached_property
    def counts(self) -> dict[str, int]:
        """Kind of change → number of objects, or of relations; an object can count in several."""
        differences: dict[str, list[object]] = {
            "renamed": [c.is_renamed for c in self.changed],
            "moved": [c.move for c in self.changed],
            "turned": [c.turned_degrees for c in self.changed],
            "resized": [c.resized for c in self.changed],
            "reclassified": [c.reclassified for c in self.changed],
            "other mass": [c.mass for c in self.changed],
            "other asset": [c.assets for c in self.changed],
        }
        counts = {name: sum(map(bool, values)) for name, values in differences.items()}
        gained, lost = (sum(len(getattr(c, name)) for c in self.changed) for name in ("gained", "lost"))
        unmatched = {"added": len(self.added), "removed": len(self.removed)}
        return {**unmatched, **counts, "relations gained": gained, "relations lost": lost}


def compare_objects(
    old: Sequence[ObjectState],
    new: Sequence[ObjectState],
    tolerances: Tolerances = DEFAULT_TOLERANCES,
    kinds: Iterable[str] = USUAL_KINDS,
    *,
    is_grounded: bool | None = None,
) -> Changes:
    """Return the differences between two scenes; swapping old and new gives the mirror image.

    Args:
        old: the objects of one scene, each prim path once.
        new: the objects of the other scene, likewise.
        tolerances: differences that do not count.
        kinds: the kinds of relations to compare.
        is_grounded: whether both scenes were grounded, so that a missing class counts as a difference; None compares
            classes only if each scene has at least one.
    """
    wanted = frozenset(kinds)
    matching = match_objects(old, new, tolerances)
    if is_grounded is None:
        is_grounded = any(state.classes for state in old) and any(state.classes for state in new)
    changed = _Comparison(matching, tolerances, wanted, is_grounded).changes()
    added, removed = (
        tuple(_select_links(state, wanted) for state in states) for states in (matching.added, matching.removed)
    )
    return Changes(changed, added, removed, len(old), len(new), matching.matches, wanted)


def _select_links(state: ObjectState, kinds: frozenset[str]) -> ObjectState:
    return replace(state, links=frozenset(link for link in state.links if link.kind in kinds))


class _Comparison:
    """Compares matched objects: first the two states of each, then the effects of nested objects and carriers."""

    def __init__(self, matching: Matching, tolerances: Tolerances, kinds: frozenset[str], has_classes: bool) -> None:
        self._matching = matching
        self._tolerances = tolerances
        self._kinds = kinds
        self._has_classes = has_classes
        self._anchors = AnchorMap(matching.matches, matching.removed, matching.added)

    def changes(self) -> tuple[Change, ...]:
        """Return the changes of the matched objects that differ."""
        own = [self._compare(match) for match in self._matching.matches]
        changed_below = self._ancestors_of_changes(own)
        moved = [self._add_effects_of_contents(change, changed_below) for change in own]
        by_path = {change.match.new.prim_path: change for change in moved}
        found = (self._add_carrier(change, by_path) for change in moved)
        return tuple(change for change in found if not change.is_none)

    def _compare(self, match: ObjectMatch) -> Change:
        old, new = match.old, match.new
        angle = rotation_angle(old.orientation, new.orientation)
        is_turned = angle > self._tolerances.turned_degrees
        gained, lost = self._anchors.gained_and_lost(match, self._kinds)
        return Change(
            match,
            self._find_move(old.position, new.position),
            turned_degrees=angle if is_turned else 0.0,
            resized=self._find_resize(old.size, new.size, is_turned),
            reclassified=self._has_classes and old.classes != new.classes,
            mass=(old.mass_kg, new.mass_kg) if _has_other_mass(old.mass_kg, new.mass_kg) else None,
            assets=(old.assets, new.assets) if old.assets != new.assets and old.assets.isdisjoint(new.assets) else None,
            gained=gained,
            lost=lost,
        )

    def _find_move(self, old: Vector | None, new: Vector | None) -> Move | None:
        if old is None or new is None:
            return None
        distance = distance_between(old, new)
        return Move(old, new, distance) if distance > self._tolerances.moved_m else None

    def _find_resize(self, old: Vector | None, new: Vector | None, is_turned: bool) -> tuple[Vector, Vector] | None:
        if old is None or new is None:
            return None
        # A rotation may exchange the sides of the world box.
        before, after = (sorted(old), sorted(new)) if is_turned else (old, new)
        return None if is_same_size(before, after, self._tolerances) else (old, new)

    def _ancestors_of_changes(self, own: Iterable[Change]) -> set[str]:
        """Return the old and new paths above objects that were added, removed, renamed, moved, turned or resized."""
        unmatched = (*self._matching.removed, *self._matching.added)
        changed = (c.match for c in own if c.move or c.turned_degrees or c.resized or c.is_renamed)
        paths = {state.prim_path for state in unmatched}
        paths.update(state.prim_path for match in changed for state in (match.old, match.new))
        return {ancestor for path in paths for ancestor in ancestor_paths(path)}

    def _add_effects_of_contents(self, change: Change, changed_below: set[str]) -> Change:
        """Mark a resize that nested objects can explain; else report geometry that moved within its frame."""
        old, new = change.match.old, change.match.new
        if old.prim_path in changed_below or new.prim_path in changed_below:
            return replace(change, holds_changes=change.resized is not None)
        if change.move or change.turned_degrees or change.resized:
            return change
        return replace(change, move=self._find_move(old.center, new.center))

    def _add_carrier(self, change: Change, by_path: Mapping[str, Change]) -> Change:
        if not (change.move or change.turned_degrees):
            return change
        for path in self._anchors.carriers(change.match, _CARRYING_KINDS):
            if path != change.match.new.prim_path and self._is_carried(change, by_path[path]):
                return replace(change, carrier=path)
        return change

    def _is_carried(self, change: Change, carrier: Change) -> bool:
        """Return whether the rigid motion of the carrier explains the move and turn of an object."""
        if not (carrier.move or carrier.turned_degrees):
            return False
        if abs(carrier.turned_degrees - change.turned_degrees) > self._tolerances.turned_degrees:
            return False
        old, new = change.match.old, change.match.new
        start, end = (old.position, new.position) if old.position and new.position else (old.center, new.center)
        expected = transform_rigidly(start, carrier.match.old, carrier.match.new) if start else None
        return expected is not None and end is not None and self._find_move(expected, end) is None


def _has_other_mass(old: float | None, new: float | None) -> bool:
    if old is None or new is None:
        return old is not new
    return abs(old - new) > COMPARISON.min_mass_change * max(abs(old), abs(new))
