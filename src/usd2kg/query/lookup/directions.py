"""find_beside and find_between: what is left of, right of, in front of, behind or between things, by boxes."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.settings import DIRECTIONS
from usd2kg.shapes.side_angles import angles_off_side, turns_from_gaze

__all__ = ["find_beside", "find_between"]

Vector = NDArray[np.float64]


def find_beside(facts: SceneFacts, side: str, anchor: str) -> list[str] | None:
    """Return the objects on a side of a thing, the nearest first.

    The viewer stands in the middle of the surrounding objects and looks at the anchor: an object in front is nearer to
    the viewer (relative frame of reference, Levinson 2003).

    Args:
        facts: the graph.
        side: left, right, front or behind.
        anchor: the thing.

    Returns:
        None if the anchor has no box, or nothing around it says where people look from.
    """
    body, table = facts.body(anchor), facts.bodies.table
    if body.lower is None or body.upper is None:
        return None
    gaps = np.maximum(np.maximum(table.lower - body.upper, body.lower - table.upper), 0)
    distance = np.linalg.norm(gaps, axis=1)
    middle, own = (table.lower + table.upper)[:, :2] / 2, (body.lower + body.upper)[:2] / 2
    around = middle[distance <= DIRECTIONS.surroundings]
    gaze = own - around.mean(axis=0)
    if float(np.hypot(*gaze)) < DIRECTIONS.min_offset:
        return None
    off = angles_off_side(turns_from_gaze(gaze, middle - own), side)
    overlap = np.minimum(table.upper[:, 2], body.upper[2]) - np.maximum(table.lower[:, 2], body.lower[2])
    # The anchor itself and what is around or within it have no direction.
    is_apart = np.any(gaps[:, :2] > 0, axis=1)
    chosen = (distance <= DIRECTIONS.reach) & (off <= DIRECTIONS.tolerance) & (overlap > 0) & is_apart
    rows = sorted(np.flatnonzero(chosen).tolist(), key=lambda row: (float(distance[row]), table.iris[row]))
    return [table.iris[row] for row in rows]


def find_between(facts: SceneFacts, one: str, other: str) -> list[str] | None:
    """Return the objects between two things, by prim path; None if one of them has no box.

    The middle of such an object is over the strip from middle to middle, as wide as the narrower thing, and outside
    both boxes; their heights overlap. An object that fills half of the strip's width, and lies along it, may have its
    middle beside it, such as a bed between two bedside tables. `u2k:Between` requires most of the footprint to be in
    the convex hull of the two, which that bed is not; it also relates each object to its nearest two anchors only.
    """
    first, second, table = facts.body(one), facts.body(other), facts.bodies.table
    if first.lower is None or first.upper is None or second.lower is None or second.upper is None:
        return None
    start, end = (first.lower + first.upper)[:2] / 2, (second.lower + second.upper)[:2] / 2
    length = float(np.hypot(*(end - start)))
    if length < DIRECTIONS.min_offset:
        return []
    along = (end - start) / length
    middle = (table.lower + table.upper)[:, :2] / 2
    way = (middle - start) @ along
    aside = np.abs((middle - start) @ np.array([-along[1], along[0]]))
    boxes = ((first.lower, first.upper), (second.lower, second.upper))
    half = min(float(np.min((upper - lower)[:2])) for lower, upper in boxes) / 2
    lowest, highest = max(first.lower[2], second.lower[2]), min(first.upper[2], second.upper[2])
    is_level = (table.lower[:, 2] < highest) & (table.upper[:, 2] > lowest)
    reach = (table.upper - table.lower)[:, :2] / 2 @ np.abs(np.array([along, [-along[1], along[0]]])).T
    covered = np.minimum(aside + reach[:, 1], half) - np.maximum(aside - reach[:, 1], -half)
    is_filled = (covered >= half) & (way - reach[:, 0] > 0) & (way + reach[:, 0] < length)
    is_between = (way > 0) & (way < length) & ((aside <= half) | is_filled) & is_level
    for lower, upper in boxes:
        is_between &= ~((middle > lower[:2]) & (middle < upper[:2])).all(axis=1)
    return facts.sorted(table.iris[row] for row in np.flatnonzero(is_between).tolist())
