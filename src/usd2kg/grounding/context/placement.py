"""Where an object stands: how high above the ground around it, and what is nearest to it in space."""

import math
from bisect import bisect_left
from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.scene.model import Box, Scene, Vector

__all__ = ["Look", "Neighbour", "Plan", "Standing"]

_CELL = 3.0
"""Metres: an object's ground and neighbours are looked for in its cell of the floor plan and the eight around it."""
_FLOOR_WIDTH, _FLOOR_HEIGHT = 1.5, 0.3
"""Metres: what is at least so wide both ways and not so high may be a floor, so that things stand on its top."""
_STOREY = 2.5
"""Metres: what is farther below is another storey's ground."""
_CROWD = 2000
"""Objects around one that are looked at for the nearest."""
_SAMPLE, _MOST_COMPARED = 64, 8
"""Objects that are looked at, and of each those nearest to it, to tell whether they stand apart."""

_Floats = NDArray[np.float64]
_Indices = NDArray[np.int64]


class Look(NamedTuple):
    """What is seen of an object whatever it is called."""

    size: Vector
    """Its own extents in metres."""
    height: float | None
    """Its extent along the vertical in metres; None if nobody knows which way it stands."""
    elevation: float | None
    """Height in metres of its lowest point above the ground; None if it is not known.

    The ground is the lowest point of all objects whose centres are at most some metres away in the plan, if it is not
    more than 2.5 m below, so that each storey has its own.
    """
    is_nested: bool
    """Whether it is below another object in the stage's tree."""


class Neighbour(NamedTuple):
    """Another object, as a target sees it."""

    name: str
    """Empty where the others are nameless too."""
    parents: tuple[str, ...]
    """Names of the prims above, outermost first."""
    look: Look


Judge = Callable[[Neighbour], _Floats]
"""Says something of an object in numbers, always as many."""


class Plan:
    """The boxes of a scene by the cell of the floor plan that their centres are in; made once a scene, when asked."""

    def __init__(self, scene: Scene) -> None:
        self._objects = scene.objects
        self._elevations: dict[int, float | None] = {}
        self._told: dict[tuple[Judge, bool], NDArray[np.float32]] = {}

    @cached_property
    def is_laid_out(self) -> bool:
        """Whether the objects stand apart: assets of a library may all stand at the origin, which tells nothing.

        They do not if, of at most 64 of them, more than half share their space with most of the eight that are nearest,
        so that the centre of each is within the plan of the other, and half of the lower one beside the other.
        """
        known = np.flatnonzero(~np.isnan(self._grounds))
        sample = known[:: max(1, len(known) // _SAMPLE)].tolist()
        return 2 * sum(map(self._is_piled, sample)) <= len(sample)

    def elevation(self, index: int) -> float | None:
        """Return how high an object stands, see `Look.elevation`."""
        if index not in self._elevations:
            self._elevations[index] = self._measure_elevation(index)
        return self._elevations[index]

    def _measure_elevation(self, index: int) -> float | None:
        box = self._objects[index].box
        if box is None or not self.is_laid_out:
            return None
        own = lowest = box.lower[2]
        for cell in self._cells_around(index):
            grounds = self._grounds_by_cell[cell]
            at = bisect_left(grounds, own - _STOREY)
            if at < len(grounds):
                lowest = min(lowest, grounds[at])
        return own - lowest

    def nearest(self, index: int, most: int) -> tuple[_Indices, _Floats]:
        """Return the objects nearest to one, none below it, and the metres between the centres of the boxes.

        Of more than 2,000 objects around it, as many are taken evenly.
        """
        if self._objects[index].box is None or not self.is_laid_out:
            return np.empty(0, int), np.empty(0)
        others, metres = self._nearest(index, most)
        below = self._objects[index].prim_path + "/"
        kept = [not self._objects[other].prim_path.startswith(below) for other in others.tolist()]
        return others[kept], metres[kept]

    def told(self, judge: Judge, indices: _Indices, *, is_anonymous: bool) -> NDArray[np.float32]:
        """Return what a judge says of objects with boxes, a row each; it is asked once an object."""
        told = self._told.get((judge, is_anonymous))
        missing = indices.tolist() if told is None else indices[np.isnan(told[indices, 0])].tolist()
        for index in missing:
            judgement = judge(self._neighbour(index, is_anonymous=is_anonymous))
            if told is None:
                told = self._told[judge, is_anonymous] = np.full(
                    (len(self._objects), len(judgement)), np.nan, np.float32
                )
            told[index] = judgement
        return np.empty((0, 0), np.float32) if told is None else told[indices]

    def _neighbour(self, index: int, *, is_anonymous: bool) -> Neighbour:
        obj = self._objects[index]
        assert obj.box is not None
        size = obj.box.size
        look = Look(obj.oriented_size or size, size[2], self.elevation(index), obj.parent_path is not None)
        if is_anonymous:
            return Neighbour("", (), look)
        return Neighbour(obj.name, tuple(filter(None, obj.prim_path.split("/")[:-1])), look)

    @cached_property
    def _centres(self) -> _Floats:
        """(objects, 3), in metres; NaN without a box."""
        nowhere = (math.nan, math.nan, math.nan)
        return np.array([nowhere if obj.box is None else obj.box.center for obj in self._objects]).reshape(-1, 3)

    @cached_property
    def _grounds(self) -> _Floats:
        """Where things may stand at the lowest, (objects,), in metres; NaN without a box."""
        grounds = np.full(len(self._objects), np.nan)
        for index, obj in enumerate(self._objects):
            if obj.box is not None:
                width, depth, height = obj.box.size
                is_floor = min(width, depth) > _FLOOR_WIDTH and height < _FLOOR_HEIGHT
                grounds[index] = (obj.box.upper if is_floor else obj.box.lower)[2]
        return grounds

    @cached_property
    def _cells(self) -> dict[tuple[int, int], _Indices]:
        """Cell → its objects, the lowest ground first."""
        known = np.flatnonzero(~np.isnan(self._grounds))
        cells: dict[tuple[int, int], list[int]] = {}
        for index in known[np.argsort(self._grounds[known], kind="stable")].tolist():
            cells.setdefault(self._cell(index), []).append(index)
        return {cell: np.array(found) for cell, found in cells.items()}

    def _cell(self, index: int) -> tuple[int, int]:
        x, y, _ = self._centres[index].tolist()
        return math.floor(x / _CELL), math.floor(y / _CELL)

    @cached_property
    def _grounds_by_cell(self) -> dict[tuple[int, int], list[float]]:
        """Cell → the grounds of its objects, the lowest first."""
        return {cell: self._grounds[found].tolist() for cell, found in self._cells.items()}

    def _cells_around(self, index: int) -> list[tuple[int, int]]:
        x, y = self._cell(index)
        near = [(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        return [cell for cell in near if cell in self._cells]

    def _nearest(self, index: int, most: int) -> tuple[_Indices, _Floats]:
        cells = [self._cells[cell] for cell in self._cells_around(index)]
        # Where thousands crowd a few metres, an even choice of them tells the same at a bounded cost.
        step = 1 + sum(map(len, cells)) // _CROWD
        others = np.concatenate([cell[::step] for cell in cells])
        others = others[others != index]
        metres = np.sqrt(np.square(self._centres[others] - self._centres[index]).sum(axis=1))
        order = np.argsort(metres, kind="stable")[:most]
        return others[order], metres[order]

    def _is_piled(self, index: int) -> bool:
        near = self._nearest(index, _MOST_COMPARED)[0].tolist()
        return 2 * sum([self._stand_in_each_other(index, other) for other in near]) > len(near)

    def _stand_in_each_other(self, one: int, other: int) -> bool:
        boxes = self._objects[one].box, self._objects[other].box
        if boxes[0] is None or boxes[1] is None:
            return False
        shared = min(boxes[0].upper[2], boxes[1].upper[2]) - max(boxes[0].lower[2], boxes[1].lower[2])
        is_level = shared > min(boxes[0].size[2], boxes[1].size[2]) / 2
        return is_level and _holds(boxes[0], boxes[1].center) and _holds(boxes[1], boxes[0].center)


class Standing:
    """Where one object stands; found out when it is asked for."""

    def __init__(self, plan: Plan, index: int, *, is_anonymous: bool) -> None:
        """Make it; `is_anonymous` leaves out the names of the others."""
        self._plan = plan
        self._index = index
        self._is_anonymous = is_anonymous

    @property
    def elevation(self) -> float | None:
        """How high it stands in metres, see `Look.elevation`."""
        return self._plan.elevation(self._index)

    @property
    def is_laid_out(self) -> bool:
        """Whether the objects of its scene stand apart, see `Plan.is_laid_out`."""
        return self._plan.is_laid_out

    def around(self, judge: Judge, most: int) -> tuple[NDArray[np.float32], _Floats]:
        """Return what `judge` says of the nearest objects, a row each, and the metres between the boxes' centres.

        It is asked once an object of the scene. What is below the target is left out: it has its name above it.
        """
        others, metres = self._plan.nearest(self._index, most)
        return self._plan.told(judge, others, is_anonymous=self._is_anonymous), metres


def _holds(box: Box, point: Vector) -> bool:
    """Return whether a point is within the plan of a box."""
    return box.lower[0] <= point[0] <= box.upper[0] and box.lower[1] <= point[1] <= box.upper[1]
