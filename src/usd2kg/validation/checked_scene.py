"""CheckedScene: the objects of a graph, prepared for the plausibility checks."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.lexical.settings import SIZE
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.object_classes import ObjectClasses
from usd2kg.validation.plausibility_rules import Rule, Rules

__all__ = [
    "SHOWN",
    "Check",
    "CheckedScene",
    "Implausible",
    "PlacedBoxes",
    "is_nested",
    "length_text",
    "name_of",
    "names_of",
    "size_text",
    "volume_of",
]

Vector = tuple[float, float, float]
SHOWN = 3
"""Number of examples in a finding about many objects."""


class PlacedBoxes(NamedTuple):
    """The objects that have a box, with the corners of their boxes."""

    objects: tuple[GraphObject, ...]
    lower: NDArray[np.float64]
    """(n, 3), metres, world frame."""
    upper: NDArray[np.float64]
    """(n, 3), metres, world frame."""

    @property
    def volumes(self) -> NDArray[np.float64]:
        """(n,), cubic metres; extents below a millimetre count as one."""
        return np.asarray(np.maximum(self.upper - self.lower, SIZE.min_extent).prod(axis=1))


@dataclass(frozen=True)
class CheckedScene:
    """The objects of a graph with their classes and concepts."""

    objects: list[GraphObject]
    classes: ObjectClasses
    rules: Rules
    """All rules, since some checks use the word lists of other rules."""
    has_probabilities: bool
    """Whether confidences are calibrated probabilities; otherwise they are only scores."""
    metres_per_unit: float | None
    """Metres per stage unit, as stated in the graph."""

    @cached_property
    def by_iri(self) -> dict[str, GraphObject]:
        """IRI → object."""
        return {obj.iri: obj for obj in self.objects}

    @cached_property
    def boxes(self) -> PlacedBoxes:
        """The boxes of the objects that have one."""
        placed = [(obj, obj.center, obj.size) for obj in self.objects if obj.center and obj.size]
        centers = np.array([center for _, center, _ in placed], np.float64).reshape(-1, 3)
        halves = np.array([size for _, _, size in placed], np.float64).reshape(-1, 3) / 2
        return PlacedBoxes(tuple(obj for obj, _, _ in placed), centers - halves, centers + halves)

    def divided_by(self, scale: float) -> "CheckedScene":
        """Return the scene with all lengths divided by a number; masses are unchanged."""
        objects = [
            replace(
                obj,
                size=_divided(obj.size, scale),
                center=_divided(obj.center, scale),
                oriented_size=_divided(obj.oriented_size, scale),
            )
            for obj in self.objects
        ]
        return replace(self, objects=objects)

    def supports(self) -> Iterator[tuple[GraphObject, GraphObject]]:
        """Yield pairs of an object and an object that it is on."""
        for obj in self.objects:
            yield from ((obj, self.by_iri[iri]) for iri in obj.supporters if iri in self.by_iri)

    def contents(self) -> Iterator[tuple[GraphObject, GraphObject]]:
        """Yield pairs of an object and an object that it is inside."""
        for obj in self.objects:
            yield from ((obj, self.by_iri[iri]) for iri in obj.containers if iri in self.by_iri)


def _divided(vector: Vector | None, scale: float) -> Vector | None:
    return None if vector is None else (vector[0] / scale, vector[1] / scale, vector[2] / scale)


class Implausible(NamedTuple):
    """A violation of a rule."""

    subject: GraphObject | None
    """The object; None for the whole scene."""
    found: str
    expected: str


Check = Callable[[CheckedScene, Rule], Iterator[Implausible]]
"""Yields the violations of a rule."""


def name_of(obj: GraphObject) -> str:
    """Return the label and the prim path of an object, for messages."""
    return f"“{obj.label}” ({obj.prim_path})"


def names_of(objects: list[GraphObject]) -> str:
    """Return the first prim paths of a list, for messages: /A, /B, /C and 7 more."""
    shown = ", ".join(obj.prim_path for obj in objects[:SHOWN])
    return shown if len(objects) <= SHOWN else f"{shown} and {len(objects) - SHOWN} more"


def size_text(size: Vector) -> str:
    """Return extents in metres."""
    return f"{' × '.join(f'{side:.3g}' for side in size)} m"


def length_text(metres: float) -> str:
    """Return a length in a unit that suits its magnitude.

    >>> length_text(344000), length_text(12.34), length_text(0.4), length_text(0.0042)
    ('344 km', '12.3 m', '40 cm', '4.2 mm')
    """
    if abs(metres) >= 1000:
        return f"{metres / 1000:.3g} km"
    # 0.9996 m would be 100 cm.
    if abs(metres) >= 0.9995:
        return f"{metres:.3g} m"
    return f"{metres * 100:.3g} cm" if abs(metres) >= 0.01 else f"{metres * 1000:.2g} mm"


def volume_of(size: Vector) -> float:
    """Return the volume of a box in cubic metres; extents below a millimetre count as one."""
    return math.prod(max(side, SIZE.min_extent) for side in size)


def is_nested(first: GraphObject, second: GraphObject) -> bool:
    """Return whether one prim is below the other; a group with one object has the same box as the object."""
    paths = f"{first.prim_path}/", f"{second.prim_path}/"
    return paths[0].startswith(paths[1]) or paths[1].startswith(paths[0])
