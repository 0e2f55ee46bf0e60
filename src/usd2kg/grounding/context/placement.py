"""Where an object is: its height above the ground around it, and the objects nearest to it."""

import math
from bisect import bisect_left
from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding.context.settings import PLACEMENT
from usd2kg.scene.model import Box, Scene, Vector

__all__ = ["Appearance", "BoxGrid", "PlacedObject", "Placement", "ScoreObject"]

_Floats = NDArray[np.float64]
_Indices = NDArray[np.int64]


class Appearance(NamedTuple):
    """Size and stance of an object, regardless of its name."""

    size: Vector
    """Extents in metres along its own axes."""
    height: float | None
    """Vertical extent in metres; None if its orientation is unknown."""
    elevation: float | None
    """Height in metres of its lowest point above the ground; None if unknown.

    The ground is the lowest point of all objects in its cell of the floor plan and the eight around it, at most 2.5 m
    below, so that each storey has its own ground.
    """
    is_nested: bool
    """Whether it is below another object in the stage's tree."""


class PlacedObject(NamedTuple):
    """Another object around a target."""

    name: str
    """Empty if the naming regime hides the names of others."""
    parents: tuple[str, ...]
    """Names of the prims above, outermost first."""
    appearance: Appearance


ScoreObject = Callable[[PlacedObject], _Floats]
"""Returns scores of one object, always of the same shape."""


class BoxGrid:
    """The boxes of a scene in a grid of cells on the floor plan, computed on first use."""

    def __init__(self, scene: Scene) -> None:
        self._objects = scene.objects
        self._elevations: dict[int, float | None] = {}
        self._scores: dict[tuple[ScoreObject, bool], NDArray[np.float32]] = {}

    @cached_property
    def is_laid_out(self) -> bool:
        """Whether positions are meaningful: the assets of a library may all be at the origin.

        They are not if more than half of a sample of at most 127 objects overlap with most of their eight nearest: each
        centre is within the other's footprint, and the heights overlap by more than half of the lower box.
        """
        known = np.flatnonzero(~np.isnan(self._grounds))
        sample = known[:: max(1, len(known) // PLACEMENT.layout_sample)].tolist()
        return 2 * sum(map(self._overlaps_nearest, sample)) <= len(sample)

    def elevation(self, index: int) -> float | None:
        """Return the elevation of an object, see `Appearance.elevation`."""
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
            at = bisect_left(grounds, own - PLACEMENT.storey_height)
            if at < len(grounds):
                lowest = min(lowest, grounds[at])
        return own - lowest

    def nearest(self, index: int, most: int) -> tuple[_Indices, _Floats]:
        """Return the nearest objects except descendants, and the distances between box centres in metres.

        Of 2,000 or more objects around it, only an even sample is searched.
        """
        if self._objects[index].box is None or not self.is_laid_out:
            return np.empty(0, int), np.empty(0)
        others, metres = self._find_nearest(index, most)
        path = self._objects[index].prim_path
        if path not in self._wholes:
            return others, metres
        below = path + "/"
        kept = [not self._objects[other].prim_path.startswith(below) for other in others.tolist()]
        return others[kept], metres[kept]

    def scores(self, score: ScoreObject, indices: _Indices, *, is_anonymous: bool) -> NDArray[np.float32]:
        """Return the scores of objects with boxes, one row each; `score` is called once for each object."""
        known = self._scores.get((score, is_anonymous))
        missing = indices.tolist() if known is None else indices[np.isnan(known[indices, 0])].tolist()
        for index in missing:
            row = score(self._placed_object(index, is_anonymous=is_anonymous))
            if known is None:
                known = np.full((len(self._objects), len(row)), np.nan, np.float32)
                self._scores[score, is_anonymous] = known
            known[index] = row
        return np.empty((0, 0), np.float32) if known is None else known[indices]

    def _placed_object(self, index: int, *, is_anonymous: bool) -> PlacedObject:
        obj = self._objects[index]
        assert obj.box is not None
        size = obj.box.size
        seen = Appearance(obj.oriented_size or size, size[2], self.elevation(index), obj.parent_path is not None)
        if is_anonymous:
            return PlacedObject("", (), seen)
        return PlacedObject(obj.name, tuple(filter(None, obj.prim_path.split("/")[:-1])), seen)

    @cached_property
    def _wholes(self) -> frozenset[str]:
        """Paths of objects with objects below them."""
        return frozenset(obj.parent_path for obj in self._objects if obj.parent_path is not None)

    @cached_property
    def _centres(self) -> _Floats:
        """(objects, 3), metres, world frame; NaN without a box."""
        nowhere = (math.nan, math.nan, math.nan)
        return np.array([nowhere if obj.box is None else obj.box.center for obj in self._objects]).reshape(-1, 3)

    @cached_property
    def _grounds(self) -> _Floats:
        """(objects,), metres: height of an object's bottom, or of its top if it is a floor; NaN without a box."""
        grounds = np.full(len(self._objects), np.nan)
        for index, obj in enumerate(self._objects):
            if obj.box is not None:
                width, depth, height = obj.box.size
                is_floor = min(width, depth) > PLACEMENT.min_floor_width and height < PLACEMENT.max_floor_height
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
        return math.floor(x / PLACEMENT.cell), math.floor(y / PLACEMENT.cell)

    @cached_property
    def _grounds_by_cell(self) -> dict[tuple[int, int], list[float]]:
        """Cell → the grounds of its objects, the lowest first."""
        return {cell: self._grounds[found].tolist() for cell, found in self._cells.items()}

    def _cells_around(self, index: int) -> list[tuple[int, int]]:
        x, y = self._cell(index)
        near = [(x + dx, y + dy) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
        return [cell for cell in near if cell in self._cells]

    def _find_nearest(self, index: int, most: int) -> tuple[_Indices, _Floats]:
        cells = [self._cells[cell] for cell in self._cells_around(index)]
        step = 1 + sum(map(len, cells)) // PLACEMENT.max_crowd
        others = np.concatenate([cell[::step] for cell in cells])
        others = others[others != index]
        metres = np.sqrt(np.square(self._centres[others] - self._centres[index]).sum(axis=1))
        order = np.argsort(metres, kind="stable")[:most]
        return others[order], metres[order]

    def _overlaps_nearest(self, index: int) -> bool:
        near = self._find_nearest(index, PLACEMENT.layout_neighbours)[0].tolist()
        return 2 * sum([self._overlap(index, other) for other in near]) > len(near)

    def _overlap(self, one: int, other: int) -> bool:
        boxes = self._objects[one].box, self._objects[other].box
        if boxes[0] is None or boxes[1] is None:
            return False
        shared = min(boxes[0].upper[2], boxes[1].upper[2]) - max(boxes[0].lower[2], boxes[1].lower[2])
        is_beside = shared > min(boxes[0].size[2], boxes[1].size[2]) / 2
        return is_beside and _covers(boxes[0], boxes[1].center) and _covers(boxes[1], boxes[0].center)


class Placement:
    """Location of one object, computed on first use."""

    def __init__(self, plan: BoxGrid, index: int, *, is_anonymous: bool) -> None:
        """Create it; `is_anonymous` hides the names of other objects."""
        self._plan = plan
        self._index = index
        self._is_anonymous = is_anonymous

    @property
    def elevation(self) -> float | None:
        """Elevation in metres, see `Appearance.elevation`."""
        return self._plan.elevation(self._index)

    @property
    def is_laid_out(self) -> bool:
        """Whether positions in the scene are meaningful, see `BoxGrid.is_laid_out`."""
        return self._plan.is_laid_out

    def around(self, score: ScoreObject, most: int) -> tuple[NDArray[np.float32], _Floats]:
        """Return the scores of the nearest objects, one row each, and the distances between box centres in metres.

        `score` is called once for each object of the scene. Descendants are left out: they have the object's name among
        their parents.
        """
        others, metres = self._plan.nearest(self._index, most)
        return self._plan.scores(score, others, is_anonymous=self._is_anonymous), metres


def _covers(box: Box, point: Vector) -> bool:
    """Return whether a point is above, in or below a box."""
    return box.lower[0] <= point[0] <= box.upper[0] and box.lower[1] <= point[1] <= box.upper[1]
