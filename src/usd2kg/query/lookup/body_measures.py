"""BodyMeasures: measures of the bodies of things, and the words for them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.errors import GraphError
from usd2kg.knowledge import word_map, word_set
from usd2kg.query.body_table import Body
from usd2kg.query.lookup.facts import SceneFacts
from usd2kg.query.lookup.things import Things
from usd2kg.query.settings import LOOKUP

__all__ = [
    "AREA",
    "COMPARED",
    "ELEVATION",
    "HEIGHT",
    "MASS",
    "MEASURES",
    "SAME",
    "SIZE",
    "SUPERLATIVES",
    "TOP",
    "WIDTH",
    "BodyMeasures",
    "Measure",
    "nearest_of",
]


SAME = 0.005
"""Share of a measure by which two things must differ to be unequal."""


class Measure(NamedTuple):
    """A measure of bodies."""

    name: str
    unit: str
    of: Callable[[Body], float | None]


def _height(body: Body) -> float | None:
    """Return the height of a box in metres."""
    return None if body.lower is None or body.upper is None else float(body.upper[2] - body.lower[2])


def _level_sides(body: Body) -> tuple[float, float] | None:
    """Return the shorter and the longer level side in metres: along the body's own axes if one of them is vertical.

    A forklift that stands oblique in the hall is as wide as it is.
    """
    height = _height(body)
    if height is None or body.lower is None or body.upper is None:
        return None
    sides = sorted((body.upper - body.lower)[:2].tolist())
    if body.extents is not None:
        own = sorted(body.extents, key=lambda extent: abs(extent - height))
        if abs(own[0] - height) <= SAME * height:
            sides = sorted(own[1:])
    return sides[0], sides[1]


def _level_side(body: Body, axis: int) -> float | None:
    sides = _level_sides(body)
    return None if sides is None else sides[axis]


def _mean_side(body: Body) -> float | None:
    """Return the side of a cube with the volume of the extents, in metres."""
    return None if body.extents is None else float(np.prod(body.extents)) ** (1 / 3)


def _area(body: Body) -> float | None:
    """Return the area of the footprint of a box, in m²."""
    sides = _level_sides(body)
    return None if sides is None else sides[0] * sides[1]


def _bottom(body: Body) -> float | None:
    return None if body.lower is None else float(body.lower[2])


def _top(body: Body) -> float | None:
    return None if body.upper is None else float(body.upper[2])


HEIGHT = Measure("tall", "m", _height)
WIDTH = Measure("wide", "m", lambda body: _level_side(body, 1))
DEPTH = Measure("deep", "m", lambda body: _level_side(body, 0))
LENGTH = Measure("long", "m", lambda body: None if body.extents is None else body.extents[2])
THICKNESS = Measure("thick", "m", lambda body: None if body.extents is None else body.extents[0])
MASS = Measure("heavy", "kg", lambda body: body.mass)
AREA = Measure("large in area", "m²", _area)
SIZE = Measure("large", "m", _mean_side)
ELEVATION = Measure("high up", "m", _bottom)
"""Of the bottom above the floor."""
TOP = Measure("high", "m", _top)
"""Of the top above the floor: the height of what stands on it."""
_BY_NAME = {
    "height": HEIGHT,
    "width": WIDTH,
    "depth": DEPTH,
    "length": LENGTH,
    "thickness": THICKNESS,
    "mass": MASS,
    "area": AREA,
    "size": SIZE,
    "elevation": ELEVATION,
    "top": TOP,
}


def _read_signed(words: Mapping[str, str]) -> dict[str, tuple[Measure, int]]:
    """Return word → measure, and -1 where the word means less of it."""
    parts = {word: meaning.split() for word, meaning in words.items()}
    return {word: (_BY_NAME[name], 1 if sign in {"most", "more"} else -1) for word, (sign, name) in parts.items()}


MEASURES = {word: _BY_NAME[name] for word, name in word_map("query", "measure_words").items()}
SUPERLATIVES = _read_signed(word_map("query", "superlatives"))
COMPARED = _read_signed(word_map("query", "comparatives"))
_FLOORS = word_set("query", "floors")


def nearest_of(gaps: Mapping[str, float], sign: int = 1) -> list[str]:
    """Return the things with the least distance, or the largest if the sign is -1; several if these are equal."""
    least = min((sign * gap for gap in gaps.values()), default=0.0)
    return [iri for iri, gap in gaps.items() if sign * gap <= least + LOOKUP.same_gap]


class BodyMeasures:
    """Measures of the things that words mean."""

    def __init__(self, facts: SceneFacts) -> None:
        self._facts = facts

    def gaps(self, iris: Iterable[str], anchors: Sequence[str]) -> dict[str, float]:
        """Return the distances between boxes in metres, to the nearest anchor; things without a box are left out."""
        boxes = {anchor: box for anchor in anchors if (box := self._box(anchor)) is not None}
        if not boxes:
            return {}
        numbers = {anchor: number for number, anchor in enumerate(boxes)}
        lower, upper = (np.array([box[end] for box in boxes.values()]) for end in (0, 1))
        found: dict[str, float] = {}
        for iri in iris:
            box = self._box(iri)
            if box is None or boxes.keys() == {iri}:
                continue
            gaps = np.linalg.norm(np.maximum(np.maximum(lower - box[1], box[0] - upper), 0), axis=1)
            if iri in numbers:
                gaps[numbers[iri]] = np.inf
            found[iri] = round(float(gaps.min()), 4)
        return found

    def _box(self, iri: str) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
        """Return the corners of the box of a thing; None without one."""
        body = self._facts.body(iri)
        if body.lower is None or body.upper is None or not np.isfinite([*body.lower, *body.upper]).all():
            return None
        return body.lower, body.upper

    def values(self, iris: Iterable[str], measure: Measure) -> dict[str, float]:
        """Return the measure of each thing that has it."""
        found = {iri: measure.of(self._facts.body(iri)) for iri in iris}
        start = self.floor_level if measure in {ELEVATION, TOP} else 0.0
        return {iri: round(value - start, 4) for iri, value in found.items() if value is not None}

    def differ(self, one: float, other: float) -> bool:
        """Return whether two values of a measure are unequal."""
        return abs(one - other) > SAME * max(abs(one), abs(other))

    @cached_property
    def floor_level(self) -> float:
        """The height of the lowest floor, or of the lowest thing, in metres."""
        tops = [body.upper[2] for iri in self.floors() if (body := self._facts.body(iri)).upper is not None]
        return float(min(tops)) if tops else float(np.nanmin(self._facts.bodies.table.lower[:, 2]))

    def floors(self) -> list[str]:
        """Return the things that are floors."""
        facts = self._facts
        # A floor slab is a floor by its class.
        return [
            iri
            for iri in facts.things
            if facts.kind(iri).rsplit(maxsplit=1)[-1] in _FLOORS or not _FLOORS.isdisjoint(facts.class_labels(iri))
        ]

    def unmeasured(self, things: Things, measure: Measure) -> GraphError:
        """Return the error that things lack a measure."""
        missing = "mass" if measure is MASS else "box"
        return GraphError(f"not known: the graph has no {missing} for {things.text}{things.suffix}")
