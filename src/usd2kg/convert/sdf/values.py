"""Numbers, colours and poses of SDFormat elements."""

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from usd2kg.convert.sdf.notes import Notes
from usd2kg.convert.sdf.xml_tree import XmlElement

__all__ = [
    "Matrix",
    "inverse",
    "is_true",
    "pose_matrix",
    "quaternion_matrix",
    "read_matrix",
    "read_number",
    "read_numbers",
]

Matrix = NDArray[np.float64]
"""(4, 4), acts on column vectors."""
_MAX_NUMBER = 1e9
"""Greater lengths are nonsense; float32 has no centimetres there."""


def pose_matrix(x: float, y: float, z: float, roll: float, pitch: float, yaw: float) -> Matrix:
    """Return the matrix of a pose in metres and radians.

    The angles turn about the fixed axes x, y and z, in this order (SDFormat, "Pose frame semantics").

    >>> pose_matrix(1, 2, 3, 0, 0, math.pi / 2).round(6).tolist()[0]
    [0.0, -1.0, 0.0, 1.0]
    """
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(angle), math.cos(angle)) for angle in (roll, pitch, yaw))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y],
            [-sp, cp * sr, cp * cr, z],
            [0, 0, 0, 1],
        ],
        np.float64,
    )


def quaternion_matrix(position: tuple[float, ...], x: float, y: float, z: float, w: float) -> Matrix | None:
    """Return the matrix of a position and a quaternion, which need not have length 1; None if its length is 0."""
    length = math.sqrt(x * x + y * y + z * z + w * w)
    if length < 1e-9:
        return None
    x, y, z, w = (value / length for value in (x, y, z, w))
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, 3] = position
    return matrix


def inverse(pose: Matrix) -> Matrix:
    """Return the inverse of a pose, a matrix of a rotation and a translation."""
    result = np.eye(4)
    result[:3, :3] = pose[:3, :3].T
    result[:3, 3] = -pose[:3, :3].T @ pose[:3, 3]
    return result


def read_matrix(element: XmlElement | None, path: Path, notes: Notes) -> Matrix:
    """Return the matrix of a `pose`; identity without one, or with a note if it cannot be read."""
    if element is None or not element.text:
        return np.eye(4)
    is_quaternion = element.name("rotation_format") == "quat_xyzw"
    count = 7 if is_quaternion else 6
    values = _parse(element.text)
    matrix = None
    if values is not None and len(values) == count:
        if is_quaternion:
            matrix = quaternion_matrix(values[:3], *values[3:])
        else:
            angles = [math.radians(value) for value in values[3:]] if is_true(element.name("degrees")) else values[3:]
            matrix = pose_matrix(*values[:3], *angles)
    if matrix is None:
        notes.add(path, element, f"the pose is {element.text[:60]!r}, expected {count} numbers; it is taken as zero")
        return np.eye(4)
    return matrix


def read_numbers(element: XmlElement | None, count: int, path: Path, notes: Notes) -> tuple[float, ...] | None:
    """Return the numbers in an element; None without one, or with a note if they cannot be read.

    Further numbers are left out: some files have the alpha of a colour where it is none.
    """
    if element is None:
        return None
    values = _parse(element.text)
    if values is None or len(values) < count:
        notes.add(path, element, f"<{element.tag}> is {element.text[:60]!r}, expected {count} numbers; it is left out")
        return None
    return values[:count]


def read_number(element: XmlElement | None, path: Path, notes: Notes) -> float | None:
    """Return the number in an element, as `read_numbers`."""
    values = read_numbers(element, 1, path, notes)
    return values[0] if values else None


def is_true(text: str) -> bool:
    """Return whether a text is a true boolean of SDFormat."""
    return text.strip().lower() in {"true", "1"}


def _parse(text: str) -> tuple[float, ...] | None:
    try:
        values = tuple(float(word) for word in text.split())
    except ValueError:
        return None
    return values if all(abs(value) < _MAX_NUMBER for value in values) else None
