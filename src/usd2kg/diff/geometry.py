"""How far, how much turned, and where a thing lands that is carried along."""

import math
from collections.abc import Sequence

from usd2kg.diff.object_state import ObjectState, Vector
from usd2kg.diff.tolerances import Tolerances

__all__ = ["carried_to", "is_same_size", "moved_by", "turned_by"]

Quaternion = tuple[float, float, float, float]
_UNTURNED: Quaternion = (0.0, 0.0, 0.0, 1.0)


def turned_by(old: Quaternion | None, new: Quaternion | None) -> float:
    """Return the angle between two orientations in degrees, 0 to 180; 0 if one is not known."""
    if old is None or new is None or old == new:
        return 0.0
    x, y, z, w = _product(new, _inverse(old))
    return math.degrees(2 * math.atan2(math.hypot(x, y, z), abs(w)))


def is_same_size(old: Sequence[float], new: Sequence[float], tolerances: Tolerances) -> bool:
    """Return whether all sides agree, in their order."""
    return old == new or all(abs(a - b) <= tolerances.side(max(a, b)) for a, b in zip(old, new, strict=True))


def moved_by(old: Vector | None, new: Vector | None) -> float:
    """Return the distance in metres; 0 if one place is not known."""
    return math.dist(old, new) if old is not None and new is not None else 0.0


def carried_to(point: Vector, old: ObjectState, new: ObjectState) -> Vector | None:
    """Return where a point lands that moves and turns with a thing; None if it is not known where that thing is."""
    # A frame turns about its own origin; where that is unknown, the turn is, too.
    has_frame = old.position is not None and new.position is not None
    start, end = (old.position, new.position) if has_frame else (old.center, new.center)
    if start is None or end is None:
        return None
    turn = _UNTURNED
    if has_frame and old.orientation is not None and new.orientation is not None:
        turn = _product(new.orientation, _inverse(old.orientation))
    x, y, z = (a - b for a, b in zip(point, start, strict=True))
    turned = _product(_product(turn, (x, y, z, 0.0)), _inverse(turn))
    return (turned[0] + end[0], turned[1] + end[1], turned[2] + end[2])


def _inverse(q: Quaternion) -> Quaternion:
    x, y, z, w = q
    norm = x * x + y * y + z * z + w * w
    return (-x / norm, -y / norm, -z / norm, w / norm)


def _product(p: Quaternion, q: Quaternion) -> Quaternion:
    """Return the turn that is q and then p."""
    (px, py, pz, pw), (qx, qy, qz, qw) = p, q
    return (
        pw * qx + px * qw + py * qz - pz * qy,
        pw * qy - px * qz + py * qw + pz * qx,
        pw * qz + px * qy - py * qx + pz * qw,
        pw * qw - px * qx - py * qy - pz * qz,
    )
