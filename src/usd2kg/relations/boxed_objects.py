"""Objects as arrays: boxes, footprints, feet, parts, and membership in class lists."""

from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from itertools import chain
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.ontology import expand_curie
from usd2kg.relations.feet import find_feet, find_undersides, grid_feet
from usd2kg.relations.object_kinds import ObjectKind
from usd2kg.relations.settings import FOOTPRINT
from usd2kg.relations.thresholds import ClassLists, ObjectGeometry
from usd2kg.scene import Box, SceneObject, find_surplus
from usd2kg.shapes.surface import Surface, SurfaceCache
from usd2kg.two_processes import compute_in_halves

__all__ = ["BoxedObjects", "ClassMembership", "Footprints", "corners_of", "overlap_areas"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Mask = NDArray[np.bool_]

_MANY_SURFACES = 20_000
"""Surfaces from which a second process saves time."""


class ClassMembership:
    """Membership of objects in class lists, by their kinds."""

    def __init__(self, names: ClassLists, kinds: Sequence[ObjectKind]) -> None:
        self._names = names
        self._known = list(dict.fromkeys(kinds))
        number = {kind: index for index, kind in enumerate(self._known)}
        self._which = np.array([number[kind] for kind in kinds], np.int64)

    def are_in(self, name: str) -> Mask:
        """Return for each object whether one of its classes or their superclasses is in the list `name`."""
        items: tuple[str, ...] = getattr(self._names, name)
        exact = {expand_curie(item[1:]) for item in items if item.startswith("=")}
        whole = self.items_of(name)
        is_in = [not (exact.isdisjoint(kind.own) and whole.isdisjoint(kind.above)) for kind in self._known]
        return np.array(is_in, np.bool_)[self._which]

    def items_of(self, name: str) -> frozenset[str]:
        """Return the IRIs of the list `name` that include subclasses."""
        items: tuple[str, ...] = getattr(self._names, name)
        return frozenset(expand_curie(item) for item in items if not item.startswith("="))

    @cached_property
    def are_drawers(self) -> Mask:
        """Whether each object is a drawer, and not a cabinet by its name, such as a drawer cabinet."""
        return self.are_in("not_laid") & ~self.are_in("cases")

    @cached_property
    def are_handles(self) -> Mask:
        """Whether each object is a handle, and not a tool by its name, such as a crank puller."""
        return self.are_in("handles") & ~self.are_in("tools")

    @cached_property
    def may_be_placed(self) -> Mask:
        """Whether each object may be on or in another, which tools are by their name."""
        return ~self.are_in("not_placed") | self.are_in("tools")

    @cached_property
    def can_contain(self) -> Mask:
        """Whether each object is a container."""
        disposition = expand_curie(self._names.containment_disposition)
        can = np.array([disposition in kind.dispositions for kind in self._known], np.bool_)[self._which]
        return np.asarray((can | self.are_in("containers")) & ~self.are_in("not_containers"))


class Footprints(NamedTuple):
    """Rectangles in the floor plane, one row each."""

    is_rotated: Mask
    """Whether the sides are not along x and y."""
    half_sides: Array
    """(n, 2), metres."""
    direction: Array
    """(n, 2), unit vector of the first side."""


class BoxedObjects:
    """Objects with a box of their own as arrays, one row each; metres, world frame, z-up.

    Those that `scene.find_surplus` returns are left out.
    """

    def __init__(
        self, objects: Sequence[SceneObject], geometry: ObjectGeometry, surfaces: Mapping[str, Surface]
    ) -> None:
        self.geometry = geometry
        surplus = find_surplus(objects)
        known_boxes = [obj.own_box is not None and obj.prim_path not in surplus for obj in objects]
        self.scene_index = np.flatnonzero(np.array(known_boxes, np.bool_)).astype(np.int64)
        """Index among all objects of the scene."""
        self.objects = [objects[index] for index in self.scene_index.tolist()]
        cache = SurfaceCache()
        known = [surfaces.get(obj.prim_path) for obj in self.objects]
        self.surfaces = [None if surface is None else Surface(surface.pieces, cache) for surface in known]
        """The surface of each object; None where its boxes say it all, or the surface is not known."""
        self.has_surface = np.array([surface is not None for surface in self.surfaces], np.bool_)
        boxes = [obj.own_box for obj in self.objects if obj.own_box is not None]
        self.lower = np.array([box.lower for box in boxes], np.float64).reshape(-1, 3)
        self.upper = np.array([box.upper for box in boxes], np.float64).reshape(-1, 3)
        self.size = self.upper - self.lower
        self.middle = (self.lower + self.upper) / 2
        self.area = self.size[:, 0] * self.size[:, 1]
        self.volume = self.area * self.size[:, 2]

    def __len__(self) -> int:
        return len(self.objects)

    @cached_property
    def rank(self) -> Indices:
        """Rank of each object by prim path; breaks ties independently of the order of the scene."""
        paths = [obj.prim_path for obj in self.objects]
        rank = np.empty(len(paths), np.int64)
        rank[sorted(range(len(paths)), key=paths.__getitem__)] = np.arange(len(paths))
        return rank

    @cached_property
    def feet(self) -> tuple[Array, Array]:
        """Lower and upper corners (n, 3) of the box around the feet of each object; its own box if it has no parts.

        A tap stands on its foot, not on the surface below its spout.
        """
        lower, upper = self.lower.copy(), self.upper.copy()
        for index, obj in enumerate(self.objects):
            if obj.part_boxes:
                bottom = lower[index, 2] + self.geometry.foot_height
                feet = corners_of([box for box in obj.part_boxes if box.lower[2] <= bottom])
                if len(feet[0]):
                    lower[index], upper[index] = feet[0].min(axis=0), feet[1].max(axis=0)
        return lower, upper

    @cached_property
    def foot_area(self) -> Array:
        """Area (n,) of the box around the feet of each object in square metres."""
        lower, upper = self.feet
        return np.asarray((upper - lower)[:, :2].prod(axis=1))

    def feet_of(self, indices: Indices) -> dict[int, Array]:
        """Return index → points (n, 3) on the underside of objects: of their surface, else of the box of their feet."""
        lower, upper = self.feet
        feet = {i: grid_feet(lower[i], upper[i]) for i in indices[~self.has_surface[indices]].tolist()}
        meshes = self._surfaces_of(indices)
        find = partial(find_feet, height=self.geometry.foot_height)
        found = chain.from_iterable(compute_in_halves(find, [*meshes.values()], least=_MANY_SURFACES))
        return feet | dict(zip(meshes, found, strict=True))

    def undersides_of(self, indices: Indices) -> dict[int, Array]:
        """Return index → points (n, 3) on the whole underside of the objects with a surface."""
        meshes = self._surfaces_of(indices)
        return dict(zip(meshes, find_undersides([*meshes.values()]), strict=True))

    def _surfaces_of(self, indices: Indices) -> dict[int, Surface]:
        found = ((index, self.surfaces[index]) for index in indices.tolist())
        return {index: surface for index, surface in found if surface is not None}

    @cached_property
    def parts(self) -> tuple[Indices, Array, Array]:
        """Start index of each object's parts (n + 1,), and the parts' corners; an object without parts is one part."""
        own = [obj.shell_boxes or obj.part_boxes or (obj.own_box,) for obj in self.objects]
        starts = np.cumsum([0, *(len(boxes) for boxes in own)])
        lower, upper = corners_of([box for boxes in own for box in boxes if box is not None])
        return starts.astype(np.int64), lower, upper

    @cached_property
    def upright_volume(self) -> Array:
        """Volume (n,) of the upright box around each object in its own directions, in cubic metres.

        That of an open door is the same as that of a shut one.
        """
        return np.asarray(4 * self.footprints.half_sides.prod(axis=1) * self.size[:, 2])

    @cached_property
    def footprints(self) -> Footprints:
        """The footprint of each object as a rectangle.

        It is rotated if the extents along the prim's own axes reproduce the measured AABB; else it is that of the AABB.
        """
        is_rotated = np.zeros(len(self), np.bool_)
        half, along = self.size[:, :2] / 2, np.tile([1.0, 0.0], (len(self), 1))
        for index, obj in enumerate(self.objects):
            found = _rotated_footprint(obj)
            if found is not None:
                is_rotated[index] = True
                half[index], along[index] = found
        return Footprints(is_rotated, half, along)


def _rotated_footprint(obj: SceneObject) -> tuple[Array, Array] | None:
    """Return half sides and the direction of the first side of an object rotated about z only; None for others."""
    if obj.oriented_size is None or obj.orientation is None or obj.own_box is None or obj.own_box != obj.box:
        return None
    x, y, z, w = obj.orientation
    # Rows are the prim's axes in the world frame.
    axes = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
            [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
            [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
    upright = int(np.abs(axes[:, 2]).argmax())
    if abs(axes[upright, 2]) < FOOTPRINT.min_upright:
        return None
    first, second = (axis for axis in range(3) if axis != upright)
    sides = np.array([obj.oriented_size[first], obj.oriented_size[second]])
    along = axes[first, :2] / np.hypot(*axes[first, :2])
    around = np.abs(along) * sides[0] + np.abs(along[::-1]) * sides[1]
    fits = np.abs(around - obj.own_box.size[:2]).max() <= FOOTPRINT.max_misfit * sides.max()
    return (sides / 2, along) if fits else None


def corners_of(boxes: Sequence[Box]) -> tuple[Array, Array]:
    """Return the lower and upper corners of boxes, each (n, 3)."""
    lower = np.array([box.lower for box in boxes], np.float64).reshape(-1, 3)
    return lower, np.array([box.upper for box in boxes], np.float64).reshape(-1, 3)


def overlap_areas(lower: Array, upper: Array, others_lower: Array, others_upper: Array) -> Array:
    """Return the overlap area of each row of footprints with the same row of the others, in square metres."""
    sides = np.clip(np.minimum(upper, others_upper)[:, :2] - np.maximum(lower, others_lower)[:, :2], 0, None)
    return np.asarray(sides[:, 0] * sides[:, 1])
