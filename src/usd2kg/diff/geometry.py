"""Distances, rotations and rigid motions between two object states."""

import math
from collections.abc import Sequence

from usd2kg.diff.object_state import ObjectState, Quaternion, Vector
from usd2kg.diff.tolerances import Tolerances

__all__ = ["distance_between", "is_same_size", "rotation_angle", "transform_rigidly"]

_IDENTITY: Quaternion = (0.0, 0.0, 0.0, 1.0)


def rotation_angle(old: Quaternion | None, new: Quaternion | None) -> float:
    """Return the angle between two orientations in degrees, 0 to 180; 0 if one is unknown."""
    if old is None or new is None or old == new:
        return 0.0
    x, y, z, w = _product(new, _inverse(old))
    return math.degrees(2 * math.atan2(math.hypot(x, y, z), abs(w)))


def is_same_size(old: Sequence[float], new: Sequence[float], tolerances: Tolerances) -> bool:
    """Return whether corresponding sides agree within the tolerances."""
    return old == new or all(abs(a - b) <= tolerances.side_limit(max(a, b)) for a, b in zip(old, new, strict=True))


def distance_between(old: Vector | None, new: Vector | None) -> float:
    """Return the distance in metres; 0 if one place is unknown."""
    return math.dist(old, new) if old is not None and new is not None else 0.0


def transform_rigidly(point: Vector, old: ObjectState, new: ObjectState) -> Vector | None:
    """Return a point moved rigidly with an object from its old to its new state; None if that motion is unknown."""
    # A frame rotates about its origin; the centre alone gives only the translation.
    has_frame = old.position is not None and new.position is not None
    start, end = (old.position, new.position) if has_frame else (old.center, new.center)
    if start is None or end is None:
        return None
    rotation = _IDENTITY
    if has_frame and old.orientation is not None and new.orientation is not None:
        rotation = _product(new.orientation, _inverse(old.orientation))
    x, y, z = (a - b for a, b in zip(point, start, strict=True))
    rotated = _product(_product(rotation, (x, y, z, 0.0)), _inverse(rotation))
    return (rotated[0] + end[0], rotated[1] + end[1], rotated[2] + end[2])


def _inverse(q: Quaternion) -> Quaternion:
    x, y, z, w = q
    norm = x * x + y * y + z * z + w * w
    return (-x / norm, -y / norm, -z / norm, w / norm)


def _product(p: Quaternion, q: Quaternion) -> Quaternion:
    """Return the Hamilton product: the rotation q followed by p."""
    (px, py, pz, pw), (qx, qy, qz, qw) = p, q
    return (
        pw * qx + px * qw + py * qz - pz * qy,
        pw * qy - px * qz + py * qw + pz * qx,
        pw * qz + px * qy - py * qx + pz * qw,
        pw * qw - px * qx - py * qy - pz * qz,
    )
