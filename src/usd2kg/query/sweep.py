"""Collisions of an opening door or drawer: its box moves in small steps and is tested against all other boxes."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.query.bodies import BodyIndex, JointMotion
from usd2kg.query.settings import SWEEP

__all__ = ["find_obstacles"]

Array = NDArray[np.float64]

_EPSILON = 1e-9
"""Length below which a cross product counts as that of parallel axes."""


class _Box(NamedTuple):
    """An axis-aligned box; metres, world frame."""

    center: Array
    half: Array


class _PosedBox(NamedTuple):
    """A box at a joint position."""

    center: Array
    half: Array
    axes: Array
    """(3, 3): unit vectors of the sides, as columns."""


def find_obstacles(bodies: BodyIndex, motion: JointMotion) -> dict[str, float]:
    """Return the objects that a joint's moving part collides with on its way to the farther limit.

    Objects are represented by their boxes. Objects that move with the part, the object that the joint is fixed to, and
    objects that the part overlaps at the start, such as its frame, are not obstacles.

    Returns:
        Object IRI → joint position at the collision relative to the start, in radians or metres, signed.
    """
    part = _moving_box(bodies, motion)
    if part is None:
        return {}
    own = {iri for iri in (motion.parent, motion.child, motion.whole) if iri}
    own |= bodies.carried_by(motion.child or motion.whole or "")
    table = bodies.table
    is_other = ~np.isnan(table.lower[:, 0]) & np.array([iri not in own for iri in table.iris], dtype=bool)
    others = [table.iris[row] for row in np.flatnonzero(is_other).tolist()]
    lower, upper = table.lower[is_other], table.upper[is_other]
    center, half = (lower + upper) / 2, np.maximum((upper - lower) / 2 - SWEEP.tolerated_overlap / 2, 0)
    is_free = ~_overlaps(_pose(part, motion, 0.0), center, half)
    collisions: dict[str, float] = {}
    for position in np.linspace(0, motion.opening, _count_steps(part, motion) + 1)[1:]:
        hits = is_free & _overlaps(_pose(part, motion, position), center, half)
        collisions.update((others[i], float(position)) for i in np.flatnonzero(hits))
        is_free &= ~hits
    return collisions


def _count_steps(part: _Box, motion: JointMotion) -> int:
    reach = 1.0
    if motion.is_revolute:
        reach = float(np.linalg.norm(np.abs(part.center - motion.origin) + part.half))
    return int(np.clip(np.ceil(abs(motion.opening) * reach / SWEEP.step), 1, SWEEP.max_steps))


def _pose(part: _Box, motion: JointMotion, position: float) -> _PosedBox:
    """Return the part's box at a joint position."""
    if not motion.is_revolute:
        return _PosedBox(part.center + position * motion.axis, part.half, np.eye(3))
    rotation = _rotation(motion.axis, position)
    return _PosedBox(motion.origin + rotation @ (part.center - motion.origin), part.half, rotation)


def _rotation(axis: Array, angle: float) -> Array:
    """Return the rotation matrix about a unit axis, by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix: Array = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return matrix


def _overlaps(part: _PosedBox, center: Array, half: Array) -> NDArray[np.bool_]:
    """Return which axis-aligned boxes a posed box overlaps, by the separating axis theorem.

    Candidate axes are the three of each box and their cross products (Gottschalk et al., OBBTree, SIGGRAPH 1996).
    """
    size = np.maximum(part.half - SWEEP.tolerated_overlap / 2, 0)
    crossed = np.array([np.cross(unit, axis) for unit in np.eye(3) for axis in part.axes.T])
    directions = np.vstack([np.eye(3), part.axes.T, crossed[np.linalg.norm(crossed, axis=1) > _EPSILON]])
    distance = np.abs((center - part.center) @ directions.T)
    reach = half @ np.abs(directions).T + np.abs(directions @ part.axes) @ size
    is_overlapping: NDArray[np.bool_] = np.all(distance < reach, axis=1)
    return is_overlapping


def _moving_box(bodies: BodyIndex, motion: JointMotion) -> _Box | None:
    """Return the box that moves: the child, or the opening side of `whole` if the moving part is not an object."""
    body = bodies.find(motion.child or motion.whole or "")
    if body.lower is None or body.upper is None:
        return None
    if motion.child is None and float(np.min(body.upper - body.lower)) > SWEEP.max_panel_thickness:
        return _opening_side(body.lower, body.upper, motion)
    return _to_box(body.lower, body.upper)


def _to_box(lower: Array, upper: Array) -> _Box:
    return _Box((lower + upper) / 2, (upper - lower) / 2)


def _opening_side(lower: Array, upper: Array, motion: JointMotion) -> _Box | None:
    """Return the side of a box nearest to the joint that leaves the box when the joint opens; None if none does."""
    best: tuple[float, _Box] | None = None
    for axis in range(3):
        for at_upper in (False, True):
            face = upper[axis] if at_upper else lower[axis]
            inward = float(np.clip((face - motion.origin[axis]) * (1 if at_upper else -1), 0, SWEEP.max_hinge_depth))
            middle = face - inward if at_upper else face + inward
            low, high = lower.copy(), upper.copy()
            low[axis] = max(low[axis], middle - SWEEP.door_thickness / 2)
            high[axis] = min(high[axis], middle + SWEEP.door_thickness / 2)
            slab = _to_box(low, high)
            opened = _pose(slab, motion, motion.opening).center[axis]
            outward = opened - upper[axis] if at_upper else lower[axis] - opened
            distance = float(np.linalg.norm(np.maximum(np.maximum(low - motion.origin, motion.origin - high), 0)))
            # The margin makes equal distances deterministic: the first side wins.
            if outward > 0 and (best is None or distance < best[0] - 1e-6):
                best = (distance, slab)
    return best[1] if best else None
