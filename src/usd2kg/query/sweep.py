"""What stands in the way of a door or drawer: its box is moved in small steps and held against all other boxes."""

import numpy as np
from numpy.typing import NDArray

from usd2kg.query.bodies import BodyIndex, JointMotion

__all__ = ["find_obstacles"]

Array = NDArray[np.float64]

_STEP = 0.01
"""Metres that the farthest corner moves from one step to the next."""
_MOST_STEPS = 400
_TOLERANCE = 0.01
"""Metres that two boxes may share without being in each other's way: doors are set close, boxes are a little large."""
_DOOR_THICKNESS = 0.04
"""Metres; of a door that is no object of its own, a side of the body it belongs to is taken."""
_PANEL_THICKNESS = 0.1
"""Metres; what is thinner is a door itself."""
_HINGE_DEPTH = 0.15
"""Metres that a hinge may lie behind the front of the box, which handles make deeper than the door."""


def find_obstacles(bodies: BodyIndex, motion: JointMotion) -> dict[str, float]:
    """Return what a joint's moving part meets on its way to the farther limit.

    All are taken as boxes. What moves along, what the joint hangs on and what the part overlaps already (its frame)
    is not counted.

    Returns:
        Object IRI → how far the joint comes until they meet, radians or metres, with the sign of the movement.
    """
    part = _moving_box(bodies, motion)
    if part is None:
        return {}
    own = {iri for iri in (motion.parent, motion.child, motion.whole) if iri}
    own |= bodies.carried_by(motion.child or motion.whole or "")
    others = [(iri, body) for iri, body in bodies.by_iri.items() if iri not in own and body.lower is not None]
    if not others:
        return {}
    lower = np.array([body.lower for _, body in others])
    upper = np.array([body.upper for _, body in others])
    center, half = (lower + upper) / 2, np.maximum((upper - lower) / 2 - _TOLERANCE / 2, 0)
    free = ~_overlaps(_posed(part, motion, 0.0), center, half)
    met: dict[str, float] = {}
    for position in np.linspace(0, motion.opening, _count_steps(part, motion) + 1)[1:]:
        hits = free & _overlaps(_posed(part, motion, position), center, half)
        met.update((others[i][0], float(position)) for i in np.flatnonzero(hits))
        free &= ~hits
    return met


def _count_steps(part: tuple[Array, Array], motion: JointMotion) -> int:
    reach = 1.0
    if motion.turns:
        reach = float(np.linalg.norm(np.abs(part[0] - motion.origin) + part[1]))
    return int(np.clip(np.ceil(abs(motion.opening) * reach / _STEP), 1, _MOST_STEPS))


def _posed(part: tuple[Array, Array], motion: JointMotion, position: float) -> tuple[Array, Array, Array]:
    """Return the part's box at a joint position: centre, half sizes, and its axes as columns."""
    center, half = part
    if not motion.turns:
        return center + position * motion.axis, half, np.eye(3)
    turn = _rotation(motion.axis, position)
    return motion.origin + turn @ (center - motion.origin), half, turn


def _rotation(axis: Array, angle: float) -> Array:
    """Return the matrix of a turn about a unit axis, by Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix: Array = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return matrix


def _overlaps(posed: tuple[Array, Array, Array], center: Array, half: Array) -> NDArray[np.bool_]:
    """Return which of many upright boxes a turned box overlaps, by the separating axis theorem.

    The axes between which two boxes can be parted: three of each, and the products of theirs (Gottschalk 1996).
    """
    at, size, axes = posed
    size = np.maximum(size - _TOLERANCE / 2, 0)
    crossed = np.array([np.cross(unit, axis) for unit in np.eye(3) for axis in axes.T])
    directions = np.vstack([np.eye(3), axes.T, crossed[np.linalg.norm(crossed, axis=1) > 1e-9]])
    apart = np.abs((center - at) @ directions.T)
    reach = half @ np.abs(directions).T + np.abs(directions @ axes) @ size
    overlap: NDArray[np.bool_] = np.all(apart < reach, axis=1)
    return overlap


def _moving_box(bodies: BodyIndex, motion: JointMotion) -> tuple[Array, Array] | None:
    """Return centre and half size of what moves; of a part that is no object, the side of its body that opens."""
    body = bodies.by_iri.get(motion.child or motion.whole or "")
    if body is None or body.lower is None or body.upper is None:
        return None
    if motion.child is None and float(np.min(body.upper - body.lower)) > _PANEL_THICKNESS:
        return _opening_side(body.lower, body.upper, motion)
    return _halved(body.lower, body.upper)


def _halved(lower: Array, upper: Array) -> tuple[Array, Array]:
    return (lower + upper) / 2, (upper - lower) / 2


def _opening_side(lower: Array, upper: Array, motion: JointMotion) -> tuple[Array, Array] | None:
    """Return the slab of a box that is at the joint and leaves the box when the joint opens; None if none does."""
    best: tuple[float, tuple[Array, Array]] | None = None
    for axis in range(3):
        for at_upper in (False, True):
            face = upper[axis] if at_upper else lower[axis]
            inward = float(np.clip((face - motion.origin[axis]) * (1 if at_upper else -1), 0, _HINGE_DEPTH))
            middle = face - inward if at_upper else face + inward
            low, high = lower.copy(), upper.copy()
            low[axis] = max(low[axis], middle - _DOOR_THICKNESS / 2)
            high[axis] = min(high[axis], middle + _DOOR_THICKNESS / 2)
            slab = _halved(low, high)
            outward = _posed(slab, motion, motion.opening)[0][axis]
            left = outward - upper[axis] if at_upper else lower[axis] - outward
            away = float(np.linalg.norm(np.maximum(np.maximum(low - motion.origin, motion.origin - high), 0)))
            if left > 0 and (best is None or away < best[0] - 1e-6):
                best = (away, slab)
    return best[1] if best else None
