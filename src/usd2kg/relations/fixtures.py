"""Fixtures: what is between an object and the wall, and holds it: an outlet its plug, an arm its television."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.relations.array_records import concatenate_rows, first_of_each_group, rounded, select_rows
from usd2kg.relations.backing import first_hits
from usd2kg.relations.boxed_objects import BoxedObjects
from usd2kg.relations.holding import Mounts
from usd2kg.relations.mount_pairs import are_held_by_target, find_touching_pairs
from usd2kg.relations.stronger import StrongerRelations
from usd2kg.relations.thresholds import AttachedRule

__all__ = ["put_fixtures_before_walls"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_ROUNDING = 1e-6
"""Metres: extents that differ by less are equal."""


def _are_in_front_of_fixtures(
    boxed: BoxedObjects,
    target: Indices,
    fixture: Indices,
    wall: Indices,
    contact: Array,
    gap: Array,
    fixture_gap: Array,
    rule: AttachedRule,
) -> Mask:
    """Return for each row whether the fixture is between the target, which touches it, and the wall or ceiling.

    As seen from the wall, the middle of the target is farther away than that of the fixture and in front of it. If the
    target touches the wall as well or passes into it, as a plug does, the fixture is around nearly all of it there;
    else it is closer to the wall than the target. What is within reach of the wall must touch the fixture.

    Args:
        boxed: the objects.
        target: indices of objects that touch the fixtures.
        fixture: indices of objects at the walls.
        wall: indices of the walls or ceilings.
        contact: metres from the target to the fixture.
        gap: metres from the target to the wall; inf if it is out of reach.
        fixture_gap: metres from the fixture to the wall.
        rule: the thresholds.
    """
    if not len(target):
        return np.zeros(0, np.bool_)
    hits = first_hits(boxed, [boxed.middle[[index]] for index in fixture.tolist()], wall)
    direction = hits.argmin(axis=1)
    row, axis = np.arange(len(target)), direction // 2
    outwards = np.where(direction % 2 == 0, 1.0, -1.0)
    # What lies on a wall is no fixture.
    is_on_wall = (axis == 2) & (outwards > 0)
    farther = outwards * (boxed.middle[target, axis] - boxed.middle[fixture, axis]) > _ROUNDING
    is_along = np.arange(3) != axis[:, None]
    lower, upper = boxed.lower[fixture] - _ROUNDING, boxed.upper[fixture] + _ROUNDING
    middle = boxed.middle[target]
    is_before = (((middle >= lower) & (middle <= upper)) | ~is_along).all(axis=1)
    shared = np.minimum(upper, boxed.upper[target]) - np.maximum(lower, boxed.lower[target])
    share = np.clip(shared, 0, None) / np.maximum(boxed.size[target], _ROUNDING)
    is_around = np.where(is_along, share, 1.0).prod(axis=1) >= rule.min_borne
    is_closer = np.clip(fixture_gap, 0, None) + rule.max_touch <= gap
    touches = (contact <= rule.max_touch) | np.isinf(gap)
    return np.asarray(
        np.isfinite(hits[row, direction]) & ~is_on_wall & touches & farther & is_before & (is_around | is_closer)
    )


def put_fixtures_before_walls(
    boxed: BoxedObjects,
    pairs: Mounts,
    targets: Indices,
    is_mount: Mask,
    stronger: StrongerRelations,
    rule: AttachedRule,
) -> tuple[Mounts, Indices]:
    """Return the pairs with fixtures in place of the walls and ceilings behind them, and the objects on fixtures.

    Args:
        boxed: the objects.
        pairs: pairs of an object and what may hold it.
        targets: the objects that fixtures may hold.
        is_mount: whether each object is a wall or ceiling.
        stronger: the relations found so far.
        rule: the thresholds.
    """
    at_wall = np.flatnonzero(is_mount[pairs.anchor] & (pairs.gap <= rule.max_contact))
    keys = (boxed.rank[pairs.anchor[at_wall]], rounded(pairs.gap[at_wall]))
    at_wall = at_wall[first_of_each_group(pairs.target[at_wall], keys)]
    place = np.full(len(boxed), -1)
    place[pairs.target[at_wall]] = at_wall
    found = find_touching_pairs(boxed, targets, pairs.target[at_wall], rule)
    found = select_rows(found, ~stronger.are_related(found.target, found.anchor))
    found = select_rows(found, ~are_held_by_target(boxed, found, stronger.holder))
    wall = pairs.anchor[place[found.anchor]]
    gaps = (found.gap, _gaps_between(pairs, found.target, wall, len(boxed)), pairs.gap[place[found.anchor]])
    holds = _are_in_front_of_fixtures(boxed, found.target, found.anchor, wall, *gaps, rule)
    found, wall = select_rows(found, holds), wall[holds]
    count = len(boxed)
    one, other = np.stack([found.target, found.anchor, found.target]), np.stack([wall, found.target, found.anchor])
    replaced = (one * count + other).ravel()
    is_left = pairs.hangs | is_mount[pairs.anchor] | ~np.isin(pairs.target, found.target)
    is_left &= ~np.isin(
        pairs.target * count + pairs.anchor, np.concatenate([replaced, found.target * count + found.anchor])
    )
    return concatenate_rows([select_rows(pairs, is_left), found]), found.target


def _gaps_between(pairs: Mounts, target: Indices, anchor: Indices, count: int) -> Array:
    """Return the gap of each pair of a target and an anchor; inf where they are not among the pairs."""
    keys = pairs.target * count + pairs.anchor
    order = np.argsort(keys, kind="stable")
    sought = target * count + anchor
    row = np.append(order, len(keys))[np.searchsorted(keys[order], sought)]
    return np.where(np.append(keys, -1)[row] == sought, np.append(pairs.gap, np.inf)[row], np.inf)
