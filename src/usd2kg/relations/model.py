"""What the rules give: relations, and the columns they are found as."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.errors import GraphError

__all__ = [
    "ALL_KINDS",
    "DEFAULT_KINDS",
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

DEFAULT_KINDS = ("on", "inside", "above", "below", "touching", "next-to", "near", "room", "part-of")
"""The kinds of relations that are found where the user does not choose."""
VIEWPOINT_KINDS = ("left", "right", "front", "behind")
"""Those that need a viewpoint, and are found where one is given."""
ALL_KINDS = (*DEFAULT_KINDS, "between", *VIEWPOINT_KINDS)
SYMMETRIC_KINDS = frozenset({"touching", "next-to", "near"})
"""Those that hold both ways; the relation is there once, from the object that comes first in the scene."""


class Relation(NamedTuple):
    """One relation between two objects, or of one object to two for `between`."""

    kind: str
    """One of `ALL_KINDS`, read from the target to the anchor: the target is `on` the anchor, `part-of` it…"""
    target: str
    """Prim path of the thing that is on, inside, near…"""
    anchor: str
    """Prim path of what it is on, inside of, near…; for `room` maybe that of a group prim, which is no object."""
    rule: str
    """Id of the rule, as in `data/spatial.toml`."""
    numbers: Mapping[str, float]
    """What was measured: metres for `gap`, `distance` and `margin`, degrees for `angle`, no unit for ratios."""
    confidence: float | None = None
    """How far inside its thresholds the geometry lies, from 0 (it just passes) to 1, see `margin_score`. Not a
    probability. None where nothing is measured: the stage says so."""
    other_anchor: str | None = None
    """For `between`, the second anchor."""


class Links(NamedTuple):
    """Relations of one kind and rule as columns of the same length."""

    kind: str
    rule: str
    target: Indices
    anchor: Indices
    numbers: Mapping[str, Array]
    confidence: Array | None
    other: Indices | None = None

    def where(self, chosen: Mask) -> "Links":
        """Return the chosen ones."""
        return self._replace(
            target=self.target[chosen],
            anchor=self.anchor[chosen],
            numbers={name: column[chosen] for name, column in self.numbers.items()},
            confidence=None if self.confidence is None else self.confidence[chosen],
            other=None if self.other is None else self.other[chosen],
        )


def margin_score(*shares: Array | float) -> Array:
    """Return how far inside all of its thresholds a thing lies: 0 at one of them, 1 where it is clear of them all.

    Each share is the margin that is used, 0 at the threshold and 1 where the criterion is met ideally (a gap of
    nothing, an overlap of all), both linear. The smallest share s counts, smoothed at both ends: s² (3 - 2 s). So 0.5
    is half way between just passing and ideal.

    >>> margin_score(np.array([0.0, 0.5, 1.0]), 0.75).round(3).tolist()
    [0.0, 0.5, 0.844]
    """
    least = np.clip(np.minimum.reduce(np.broadcast_arrays(*[np.asarray(share, np.float64) for share in shares])), 0, 1)
    return np.asarray(least * least * (3 - 2 * least))


def margin_above(value: Array, least: Array | float, ideal: float = 1.0) -> Array:
    """Return which share of the way from the threshold to the ideal a value has gone; 1 where there is no way.

    >>> margin_above(np.array([0.3, 0.65, 1.0]), 0.3).round(3).tolist()
    [0.0, 0.5, 1.0]
    """
    way = np.asarray(ideal - np.asarray(least, np.float64))
    return np.where(way > 0, (value - least) / np.where(way > 0, way, 1.0), 1.0)


def margin_below(value: Array, most: Array | float) -> Array:
    """Return which share of what is allowed a value leaves over, whichever way it is off; 1 where nothing is allowed.

    >>> margin_below(np.array([0.0, -0.01, 0.02]), 0.02).tolist()
    [1.0, 0.5, 0.0]
    """
    allowed = np.asarray(most, np.float64)
    return np.where(allowed > 0, 1 - np.abs(value) / np.where(allowed > 0, allowed, 1.0), 1.0)


@dataclass(frozen=True, slots=True)
class Viewpoint:
    """Where someone stands who says left, right, in front of and behind."""

    position: Vector
    """Metres, world frame, z-up."""
    direction: Vector | None = None
    """Where they look; by default at each pair of things in turn. Its vertical part does not count."""

    def __post_init__(self) -> None:
        numbers = (*self.position, *(self.direction or (1.0, 0.0, 0.0)))
        if not np.isfinite(numbers).all():
            raise GraphError(f"viewpoint {numbers}: expected finite numbers, metres in the world frame")
        if self.direction is not None and not np.hypot(*self.direction[:2]) > 0:
            raise GraphError(f"viewpoint: the direction {self.direction} is vertical; expected one that looks sideways")


def parse_viewpoint(text: str) -> Viewpoint:
    """Return the viewpoint that a user writes: `x,y,z`, or `x,y,z,dx,dy,dz` to look in a direction.

    Raises:
        GraphError: it is not three or six numbers, or the direction is vertical.

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

    `all` stands for all, `default` for the default set, both with the sides where there is a viewpoint.

    Raises:
        GraphError: one of them is no kind or needs a viewpoint that is not there, or none is named.

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
    """Raise GraphError where a kind is unknown or needs a viewpoint that is not there, or where there is no kind."""
    unknown = sorted(kinds - set(ALL_KINDS))
    if unknown or not kinds:
        found = f"kind {unknown[0]!r} is unknown" if unknown else "no kind is named"
        raise GraphError(f"relation kinds: {found}; expected a list of {', '.join(ALL_KINDS)}, all or default")
    sides = [kind for kind in VIEWPOINT_KINDS if kind in kinds]
    if sides and viewpoint is None:
        raise GraphError(f"relation kinds: {sides[0]} depends on where one stands; give a viewpoint, x,y,z in metres")
