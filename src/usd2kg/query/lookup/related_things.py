"""Related things: what the graph states, or the boxes show, to be on, in, below or beside others."""

from collections.abc import Iterable

import numpy as np

from usd2kg.query.body_table import Body
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.settings import DIRECTIONS

__all__ = ["find_above", "find_below", "find_over", "find_over_covers", "find_parts", "find_related"]


def find_related(facts: SceneFacts, relation: str, anchors: Iterable[str], *, is_direct: bool) -> set[str]:
    """Return the objects in a relation to any of some anchors; if not direct, also those on or in these objects.

    What is below the prim of a room is inside it where the graph states no room for it.
    """
    names = [*anchors]
    found = {iri for anchor in names for iri in facts.related(relation, anchor)}
    if relation == "inside":
        found |= {
            iri
            for anchor in names
            if anchor in facts.rooms
            for iri in facts.below(anchor)
            if not facts.anchors("room", iri)
        }
    if relation == "on":
        found |= {iri for anchor in names for iri in _on_part(facts, anchor)}
    if is_direct or relation not in {"on", "inside"}:
        return found
    waiting, found = [*found], set()
    while waiting:
        iri = waiting.pop()
        if iri not in found:
            found.add(iri)
            waiting.extend(one for name in ("on", "inside") for one in facts.related(name, iri))
    return found


def find_over_covers(facts: SceneFacts, anchors: Iterable[str]) -> set[str]:
    """Return what is on the covers of things, such as a tablecloth, and on the covers of these.

    A cover is low, and over more than half of what it is on.
    """
    covers: set[str] = set()
    waiting = {*anchors}
    while waiting:
        near = {(one, iri) for iri in waiting for one in facts.related("on", iri)}
        waiting = {one for one, iri in near if _covers(facts.body(one), facts.body(iri))} - covers
        covers |= waiting
    return {one for cover in covers for one in facts.related("on", cover)}


def _covers(cover: Body, body: Body) -> bool:
    if cover.lower is None or cover.upper is None or body.lower is None or body.upper is None:
        return False
    shared = (np.minimum(cover.upper, body.upper) - np.maximum(cover.lower, body.lower))[:2]
    is_over = bool((shared > 0).all()) and 2 * shared.prod() > (body.upper - body.lower)[:2].prod()
    return is_over and bool(cover.upper[2] - body.upper[2] <= DIRECTIONS.cover)


def find_parts(facts: SceneFacts, wholes: Iterable[str]) -> set[str]:
    """Return the parts of things, and the parts of these."""
    found: set[str] = set()
    waiting = {*wholes}
    while waiting:
        waiting = {part for whole in waiting for part in facts.related("part", whole)} - found
        found |= waiting
    return found


def find_below(facts: SceneFacts, anchor: str) -> set[str]:
    """Return what is below a thing, or below its top between its legs, by boxes; not what carries or holds it.

    The box of a table begins at its feet, so nothing is below that box.
    """
    body, table = facts.body(anchor), facts.bodies.table
    if body.lower is None or body.upper is None:
        return set()
    shared = np.minimum(table.upper, body.upper)[:, :2] - np.maximum(table.lower, body.lower)[:, :2]
    clearance = body.lower[2] - table.upper[:, 2]
    is_below = (shared > 0).all(axis=1) & (clearance >= 0) & (clearance <= DIRECTIONS.vertical)
    middle = (table.lower[:, :2] + table.upper[:, :2]) / 2
    is_over = ((middle > body.lower[:2]) & (middle < body.upper[:2])).all(axis=1)
    is_lower = (table.upper[:, 2] < body.upper[2]) & (table.lower[:, 2] >= body.lower[2] - DIRECTIONS.feet)
    own = {anchor, *find_related(facts, "on", [anchor], is_direct=False), *facts.related("part", anchor)}
    own |= find_related(facts, "inside", [anchor], is_direct=False)
    legs = {iri for row in np.flatnonzero(is_over & is_lower).tolist() if (iri := table.iris[row]) not in own}
    return ({table.iris[row] for row in np.flatnonzero(is_below).tolist()} - _holders(facts, anchor)) | legs


def find_over(facts: SceneFacts, iri: str) -> set[str]:
    """Return the things that a thing is below, also between their legs: the inverse of `find_below`."""
    body, table = facts.body(iri), facts.bodies.table
    if body.lower is None or body.upper is None:
        return set()
    shared = np.minimum(table.upper, body.upper)[:, :2] - np.maximum(table.lower, body.lower)[:, :2]
    rows = np.flatnonzero((shared > 0).all(axis=1) & (table.upper[:, 2] > body.upper[2]))
    return {one for row in rows.tolist() if iri in find_below(facts, one := table.iris[row])}


def find_above(facts: SceneFacts, anchor: str) -> set[str]:
    """Return what is above a thing by boxes; not what is on or in it."""
    body, table = facts.body(anchor), facts.bodies.table
    if body.lower is None or body.upper is None:
        return set()
    shared = np.minimum(table.upper, body.upper)[:, :2] - np.maximum(table.lower, body.lower)[:, :2]
    clearance = table.lower[:, 2] - body.upper[2]
    is_above = (shared > 0).all(axis=1) & (clearance >= 0) & (clearance <= DIRECTIONS.vertical)
    found = {table.iris[row] for row in np.flatnonzero(is_above).tolist()}
    return {iri for iri in found if anchor not in _holders(facts, iri)}


def _holders(facts: SceneFacts, iri: str) -> set[str]:
    """Return what an object is on or in, and what carries or holds that."""
    found: set[str] = set()
    waiting = {iri}
    while waiting:
        waiting = {one for held in waiting for name in ("on", "inside") for one in facts.anchors(name, held)} - found
        found |= waiting
    return found


def _on_part(facts: SceneFacts, part: str) -> set[str]:
    """Return what is on the whole of a part and stands on this part by its box: the pot on a burner of the stove."""
    body = facts.body(part)
    if body.lower is None or body.upper is None:
        return set()
    wholes = _wholes(facts, part)
    found = set()
    for iri in {one for whole in wholes for one in facts.related("on", whole)} - {part}:
        box = facts.body(iri)
        if box.lower is None or box.upper is None:
            continue
        middle = (box.lower + box.upper)[:2] / 2
        is_over = bool(((middle > body.lower[:2]) & (middle < body.upper[:2])).all())
        if is_over and abs(box.lower[2] - body.upper[2]) <= DIRECTIONS.feet:
            found.add(iri)
    return found


def _wholes(facts: SceneFacts, part: str) -> set[str]:
    found: set[str] = set()
    waiting = {part}
    while waiting:
        waiting = {whole for one in waiting for whole in facts.anchors("part", one)} - found
        found |= waiting
    return found
