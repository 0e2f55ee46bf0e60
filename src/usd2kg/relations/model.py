"""Relations, their kinds and viewpoints, and the arrays that the rules produce."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.errors import GraphError
from usd2kg.relations.derived_room import DerivedRoom

__all__ = [
    "ALL_KINDS",
    "DEFAULT_KINDS",
    "ROOM_KINDS",
    "SYMMETRIC_KINDS",
    "VIEWPOINT_KINDS",
    "Links",
    "Relation",
    "Viewpoint",
    "check_kinds",
    "margin_above",
    "margin_below",
    "margin_score",
    "parse_kinds",
    "parse_viewpoint",
]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]
Vector = tuple[float, float, float]

DEFAULT_KINDS = (
    *("on", "inside", "attached-to", "above", "below", "touching", "next-to", "near", "room", "connects", "part-of"),
)
"""Kinds that are found by default."""
VIEWPOINT_KINDS = ("left", "right", "front", "behind")
"""Kinds that need a viewpoint; found by default if there is one."""
ALL_KINDS = (*DEFAULT_KINDS, "between", *VIEWPOINT_KINDS)
ROOM_KINDS = frozenset({"room", "connects"})
"""Kinds whose anchor is a room, possibly one without a prim."""
SYMMETRIC_KINDS = frozenset({"touching", "next-to", "near"})
"""Symmetric kinds; each relation is listed once, from the object that comes first in the scene."""


class Relation(NamedTuple):
    """A relation between a target and an anchor, or two anchors for `between`."""

    kind: str
    """One of `ALL_KINDS`, read from target to anchor: the target is `on` the anchor."""
    target: str
    """Prim path of the object that is on, inside, near…"""
    anchor: str
    """Prim path of the reference object; for `room` possibly a group prim, which is not an object."""
    rule: str
    """Id of the rule in `knowledge/spatial.toml`."""
    numbers: Mapping[str, float]
    """Measurements: metres for `gap`, `distance` and `margin`, degrees for `angle`, no unit for ratios."""
    confidence: float | None = None
    """Normalised margin to the thresholds, see `margin_score`: 0 at a threshold, 1 at the ideal. Not a probability.
    None for relations that the stage states, which have no measurement."""
    other_anchor: str | None = None
    """Second anchor of `between`."""
    room: DerivedRoom | None = None
    """The room that the anchor names if it has no prim; the anchor is its name then."""


class Links(NamedTuple):
    """Relations of one kind and rule as arrays of the same length."""

    kind: str
    rule: str
    target: Indices
    anchor: Indices
    numbers: Mapping[str, Array]
    confidence: Array | None
    other: Indices | None = None

    def where(self, chosen: Mask) -> "Links":
        """Return the links selected by a mask."""
        return self._replace(
            target=self.target[chosen],
            anchor=self.anchor[chosen],
            numbers={name: column[chosen] for name, column in self.numbers.items()},
            confidence=None if self.confidence is None else self.confidence[chosen],
            other=None if self.other is None else self.other[chosen],
        )


def margin_score(*margins: Array | float) -> Array:
    """Return the smallest of several margins, smoothed: 0 at a threshold, 0.5 halfway to the ideal, 1 at the ideal.

    Each margin is linear, 0 at its threshold and 1 at the ideal (no gap, full overlap). Smoothstep of the smallest
    margin s: s² (3 - 2 s).

    >>> margin_score(np.array([0.0, 0.5, 1.0]), 0.75).round(3).tolist()
    [0.0, 0.5, 0.844]
    """
    least = np.clip(
        np.minimum.reduce(np.broadcast_arrays(*[np.asarray(margin, np.float64) for margin in margins])), 0, 1
    )
    return np.asarray(least * least * (3 - 2 * least))


def margin_above(value: Array, least: Array | float, ideal: float = 1.0) -> Array:
    """Return the normalised margin of values above a threshold; 1 if the threshold is the ideal.

    >>> margin_above(np.array([0.3, 0.65, 1.0]), 0.3).round(3).tolist()
    [0.0, 0.5, 1.0]
    """
    span = np.asarray(ideal - np.asarray(least, np.float64))
    return np.where(span > 0, (value - least) / np.where(span > 0, span, 1.0), 1.0)


def margin_below(value: Array, most: Array | float) -> Array:
    """Return the normalised margin of absolute values below a limit; 1 for a limit of 0.

    >>> margin_below(np.array([0.0, -0.01, 0.02]), 0.02).tolist()
    [1.0, 0.5, 0.0]
    """
    allowed = np.asarray(most, np.float64)
    return np.where(allowed > 0, 1 - np.abs(value) / np.where(allowed > 0, allowed, 1.0), 1.0)


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """The viewer's position and optional gaze direction, for left, right, front and behind."""

    position: Vector
    """Metres, world frame, z-up."""
    direction: Vector | None = None
    """Gaze direction, whose z is ignored; None to look towards each pair of objects."""

    def __post_init__(self) -> None:
        numbers = (*self.position, *(self.direction or (1.0, 0.0, 0.0)))
        if not np.isfinite(numbers).all():
            raise GraphError(f"viewpoint {numbers}: expected finite numbers, metres in the world frame")
        if self.direction is not None and not np.hypot(*self.direction[:2]) > 0:
            raise GraphError(f"viewpoint: the direction {self.direction} is vertical; expected one that looks sideways")


def parse_viewpoint(text: str) -> Viewpoint:
    """Return the viewpoint for `x,y,z`, or `x,y,z,dx,dy,dz` with a gaze direction.

    Raises:
        GraphError: the text is not three or six numbers, or the direction is vertical.

    >>> parse_viewpoint("0, -2, 1.6").position
    (0.0, -2.0, 1.6)
    """
    try:
        numbers = tuple(float(part) for part in text.split(","))
    except ValueError:
        numbers = ()
    if len(numbers) not in {3, 6}:
        raise GraphError(f"viewpoint {text!r}: expected three numbers x,y,z in metres, or six: x,y,z,dx,dy,dz")
    x, y, z = numbers[:3]
    if len(numbers) == 3:
        return Viewpoint((x, y, z))
    dx, dy, dz = numbers[3:]
    return Viewpoint((x, y, z), (dx, dy, dz))


def parse_kinds(text: str, viewpoint: Viewpoint | None = None) -> tuple[str, ...]:
    """Return the kinds of a comma-separated list, in the order of `ALL_KINDS`.

    `all` and `default` name sets of kinds; both include the sides if there is a viewpoint.

    Raises:
        GraphError: a kind is unknown, a side lacks a viewpoint, or the list is empty.

    >>> parse_kinds("inside,on")
    ('on', 'inside')
    """
    names = [part.strip() for part in text.split(",") if part.strip()]
    sides = VIEWPOINT_KINDS if viewpoint else ()
    sets = {"all": (*(kind for kind in ALL_KINDS if kind not in VIEWPOINT_KINDS), *sides)}
    sets["default"] = (*DEFAULT_KINDS, *sides)
    chosen = frozenset(kind for name in names for kind in sets.get(name, (name,)))
    check_kinds(chosen, viewpoint)
    return tuple(kind for kind in ALL_KINDS if kind in chosen)


def check_kinds(kinds: frozenset[str], viewpoint: Viewpoint | None) -> None:
    """Raise GraphError for an unknown kind, a side without a viewpoint, or an empty set."""
    unknown = sorted(kinds - set(ALL_KINDS))
    if unknown or not kinds:
        found = f"kind {unknown[0]!r} is unknown" if unknown else "no kind is named"
        raise GraphError(f"relation kinds: {found}; expected a list of {', '.join(ALL_KINDS)}, all or default")
    sides = [kind for kind in VIEWPOINT_KINDS if kind in kinds]
    if sides and viewpoint is None:
        raise GraphError(f"relation kinds: {sides[0]} depends on the viewer; give a viewpoint, x,y,z in metres")
