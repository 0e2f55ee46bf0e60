"""Comparison: the scene, with the current decisions, against another version, as JSON; see `web/src/api/types.ts`."""

import threading
from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Any

from usd2kg.diff import Change, Changes, ObjectState, compare_objects, describe_match
from usd2kg.studio.class_claims import ClassClaim, class_name
from usd2kg.studio.object_review import ObjectReview
from usd2kg.studio.other_version import OtherVersion, VersionSource, compared_states
from usd2kg.studio.page_indices import NONE, PageIndices
from usd2kg.studio.session import StudioSession

__all__ = ["CHANGE_KINDS", "Comparison"]

CHANGE_KINDS = (
    *("appeared", "disappeared", "class", "moved", "turned", "resized", "renamed"),
    *("mass", "asset", "relations"),
)
"""Kinds of change, the most telling first; an object can have several."""


class Comparison:
    """The changes from another version to the scene; computed again when the decisions have changed."""

    def __init__(self, session: StudioSession, indices: PageIndices, other: OtherVersion) -> None:
        self._session = session
        self._indices = indices
        self._other = other
        self._lock = threading.Lock()
        self._found: tuple[object, dict[str, Any]] | None = None

    def json(self) -> dict[str, Any]:
        """Return the changes; safe to call from several threads."""
        with self._lock:
            session = self._session
            current = session.version, session.suggestions, session.relations
            if self._found is None or not _is_same(self._found[0], current):
                self._found = current, self._compare(session.version)
            return self._found[1]

    def _compare(self, version: int) -> dict[str, Any]:
        claims = {state.prim_path: self._claim(state) for state in self._session.states()}
        new = compared_states(self._session.scene, claims, self._session.relations)
        old, new, notes = self._before(new)
        changes = compare_objects(old, new, is_grounded=True)
        found = [*self._changed(changes, claims), *self._unmatched(changes, claims)]
        found.sort(key=lambda change: (CHANGE_KINDS.index(change["kinds"][0]), change["path"]))
        counts = Counter(kind for change in found for kind in change["kinds"])
        return {
            "other": str(self._other.path),
            "source": self._other.source.value,
            "version": version,
            "counts": {kind: counts[kind] for kind in CHANGE_KINDS if counts[kind]},
            "unchanged": len(changes.matches) - len(changes.changed),
            "notes": notes,
            "changes": found,
        }

    def _claim(self, state: ObjectReview) -> ClassClaim:
        iri, is_decided = state.class_iri, not state.status.is_open
        confidence = None if is_decided or iri is None else state.prediction.confidence
        return ClassClaim(iri, class_name(iri, self._session.tbox) if iri else "", confidence, is_decided)

    def _before(
        self, new: tuple[ObjectState, ...]
    ) -> tuple[tuple[ObjectState, ...], tuple[ObjectState, ...], list[str]]:
        """Return the objects before and now that can be compared, and what cannot."""
        if self._other.source is not VersionSource.MAPPING:
            return tuple(self._other.objects), new, []
        claims = self._other.claims
        shared = tuple(state for state in new if state.prim_path in claims)
        notes = []
        if missing := len(new) - len(shared):
            notes.append(f"Not compared, since the mapping has no row for them: {missing}")
        if others := len(claims) - len(shared):
            notes.append(f"Rows of the mapping about prims that are not objects of this scene: {others}")
        before = compared_states(self._session.scene, claims, self._session.relations)
        return tuple(state for state in before if state.prim_path in claims), shared, notes

    def _changed(self, changes: Changes, claims: Mapping[str, ClassClaim]) -> Iterator[dict[str, Any]]:
        for change in changes.changed:
            old, new = change.match.old, change.match.new
            yield {
                "kinds": [*_kinds(change)],
                **self._ends(old, new, claims),
                "distance_m": None if change.move is None else round(change.move.distance, 4),
                "carried_by": self._indices.object(change.carrier),
                "turned_degrees": round(change.turned_degrees, 2),
                "sizes": None if change.resized is None else change.resized,
                "masses": change.mass,
                "gained": [link._asdict() for link in change.gained],
                "lost": [link._asdict() for link in change.lost],
                "reason": describe_match(change.match) if change.is_renamed else "",
            }

    def _unmatched(self, changes: Changes, claims: Mapping[str, ClassClaim]) -> Iterator[dict[str, Any]]:
        rest: dict[str, Any] = {
            "distance_m": None,
            "carried_by": NONE,
            "turned_degrees": 0,
            "sizes": None,
            "masses": None,
        }
        rest |= {"gained": [], "lost": [], "reason": ""}
        for state in changes.added:
            yield {"kinds": ["appeared"], **self._ends(None, state, claims), **rest}
        for state in changes.removed:
            yield {"kinds": ["disappeared"], **self._ends(state, None, claims), **rest}

    def _ends(
        self, old: ObjectState | None, new: ObjectState | None, claims: Mapping[str, ClassClaim]
    ) -> dict[str, Any]:
        """Return what is known of an object before and now."""
        state = new or old
        assert state is not None, "one end is known"
        return {
            "object": NONE if new is None else self._indices.object(new.prim_path),
            "path": state.prim_path,
            "path_before": "" if old is None else old.prim_path,
            "name": state.name,
            "before": None if old is None else self._class_json(self._other.claims.get(old.prim_path)),
            "after": None if new is None else self._class_json(claims.get(new.prim_path)),
            "box_before": None if old is None else _box(old),
            "turned_before": None if old is None else _turned(old),
        }

    def _class_json(self, claim: ClassClaim | None) -> dict[str, Any]:
        claim = claim or ClassClaim(None, "", None, is_decided=False)
        return {
            "class": self._indices.class_(claim.class_iri),
            "label": claim.label,
            "confidence": claim.confidence,
            "is_decided": claim.is_decided,
        }


def _is_same(one: Any, other: Any) -> bool:
    return one[0] == other[0] and one[1] is other[1] and one[2] is other[2]


def _kinds(change: Change) -> Iterator[str]:
    """Yield the kinds of a change in the order of `CHANGE_KINDS`."""
    holds = {
        "class": change.reclassified,
        "moved": change.move,
        "turned": change.turned_degrees,
        "resized": change.resized,
        "renamed": change.is_renamed,
        "mass": change.mass,
        "asset": change.assets,
        "relations": change.gained or change.lost,
    }
    return (kind for kind, found in holds.items() if found)


def _box(state: ObjectState) -> list[float] | None:
    """Return lower and upper x, y, z."""
    if state.center is None or state.box_size is None:
        return None
    sides = tuple(zip(state.center, state.box_size, strict=True))
    return [round(v, 4) for v in (*(c - s / 2 for c, s in sides), *(c + s / 2 for c, s in sides))]


def _turned(state: ObjectState) -> list[float] | None:
    """Return orientation and extents along the own axes; None if those are the world's."""
    if state.orientation is None or state.size is None or state.size == state.box_size:
        return None
    return [round(value, 4) for value in (*state.orientation, *state.size)]
