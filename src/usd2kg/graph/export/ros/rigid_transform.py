"""Positions and orientations: a translation in metres and a unit quaternion x y z w."""

import math
from collections.abc import Mapping
from typing import NamedTuple

from usd2kg.graph.export.property_graph import Value

__all__ = ["RigidTransform", "read_pose"]

_POSE = ("x", "y", "z", "qx", "qy", "qz", "qw")
_Vector = tuple[float, float, float]
_Quaternion = tuple[float, float, float, float]


class RigidTransform(NamedTuple):
    """The pose of a frame in another frame: rotation first, then translation."""

    translation: _Vector
    """Metres."""
    rotation: _Quaternion
    """Unit quaternion, x y z w."""

    def seen_from(self, other: "RigidTransform") -> "RigidTransform":
        """Return this frame relative to another one; both are given in a common frame.

        >>> turned = RigidTransform((1, 0, 0), (0, 0, math.sqrt(0.5), math.sqrt(0.5)))
        >>> ahead = RigidTransform((1, 2, 0), turned.rotation).seen_from(turned)
        >>> [round(number, 6) + 0 for number in ahead.translation]
        [2.0, 0.0, 0.0]
        """
        x, y, z, w = other.rotation
        inverse = (-x, -y, -z, w)
        (ax, ay, az), (bx, by, bz) = self.translation, other.translation
        turned = _product(_product(inverse, (ax - bx, ay - by, az - bz, 0.0)), other.rotation)
        return RigidTransform(turned[:3], _product(inverse, self.rotation))


def read_pose(properties: Mapping[str, Value]) -> RigidTransform | None:
    """Return the pose of a node in the world frame, its quaternion normalised; None without a valid one."""
    numbers = [float(value) for name in _POSE if isinstance(value := properties.get(name), float)]
    if len(numbers) != len(_POSE) or not all(map(math.isfinite, numbers)):
        return None
    length = math.hypot(*numbers[3:])
    if not 0 < length < math.inf:
        return None
    x, y, z, *rotation = numbers
    qx, qy, qz, qw = (part / length for part in rotation)
    return RigidTransform((x, y, z), (qx, qy, qz, qw))


def _product(first: _Quaternion, second: _Quaternion) -> _Quaternion:
    """Return the Hamilton product."""
    ax, ay, az, aw = first
    bx, by, bz, bw = second
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )
