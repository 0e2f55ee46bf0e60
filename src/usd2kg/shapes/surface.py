"""Surface: the triangles of one object, shared among the instances of a prototype."""

from collections import OrderedDict
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes.extent import extent_of

__all__ = ["Surface", "SurfaceCache", "SurfacePiece", "is_box", "turned_outward"]

Array = NDArray[np.float64]

_BOX_TOLERANCE = 1e-6
"""Share of the extent by which the corners of a box may be off."""
_SHEET_SHARE = 1e-6
"""Share of the volume around a surface below which it encloses none."""
_MAX_BOX_POINTS = 64
"""A box with three normals per corner has 24 points; some exporters write one per triangle corner."""


_MAX_TRIANGLES = 500_000
"""Triangles kept in double precision, 60 MB; affects speed and memory only."""


class SurfacePiece(NamedTuple):
    """The triangles of one gprim."""

    points: NDArray[np.float32]
    """(n, 3), in the gprim's own frame and stage units; shared among instances."""
    triangles: NDArray[np.int32]
    """(m, 3), indices into `points`, counter-clockwise seen from outside."""
    matrix: Array
    """(4, 4), from the gprim's frame to the world (metres, z-up), for row vectors."""


class _WorldTriangles(NamedTuple):
    """The triangles of a surface in the world frame: metres, z-up."""

    corners: Array
    """(m, 3, 3), counter-clockwise seen from outside."""
    lower: Array
    """(m, 3), smallest coordinates of each triangle."""
    upper: Array


class SurfaceCache:
    """LRU cache of the triangles of surfaces, which bounds memory."""

    def __init__(self, max_triangles: int = _MAX_TRIANGLES) -> None:
        self._max_triangles = max_triangles
        self._count = 0
        self._recent: OrderedDict[int, _WorldTriangles] = OrderedDict()

    def get(self, surface: "Surface") -> _WorldTriangles:
        """Return the triangles of a surface that lives as long as this cache."""
        key = id(surface)
        found = self._recent.get(key)
        if found is None:
            found = self._recent[key] = _to_world(surface.pieces)
            self._count += len(found.corners)
            while self._count > self._max_triangles and len(self._recent) > 1:
                _, oldest = self._recent.popitem(last=False)
                self._count -= len(oldest.corners)
        else:
            self._recent.move_to_end(key)
        return found


class Surface:
    """The own triangles of one object in the world frame: metres, z-up."""

    def __init__(self, pieces: tuple[SurfacePiece, ...], cache: SurfaceCache | None = None) -> None:
        self.pieces = pieces
        self._cache = cache

    @property
    def triangle_count(self) -> int:
        """Number of triangles, known without their corners."""
        return sum([len(piece.triangles) for piece in self.pieces])

    @property
    def corners(self) -> Array:
        """(m, 3, 3), the corners of the triangles, counter-clockwise seen from outside."""
        return self._world.corners

    @property
    def lower(self) -> Array:
        """(m, 3), smallest coordinates of each triangle."""
        return self._world.lower

    @property
    def upper(self) -> Array:
        """(m, 3), largest coordinates of each triangle."""
        return self._world.upper

    @property
    def _world(self) -> _WorldTriangles:
        return _to_world(self.pieces) if self._cache is None else self._cache.get(self)

    @cached_property
    def orientation(self) -> float:
        """1 if the triangles face outward, -1 if inward, 0 for a sheet: the sign of the enclosed volume."""
        corners = self.corners
        centred = corners - corners.mean(axis=(0, 1))
        volume = float(np.einsum("ij,ij->", centred[:, 0], np.cross(centred[:, 1], centred[:, 2]))) / 6
        lower, upper = extent_of(corners)
        extent = upper - lower
        # A flat box has a volume of 0; its thickness is that of a modelling error.
        least = _SHEET_SHARE * float(np.sort(extent)[1:].prod() * extent.max())
        return float(np.sign(volume)) if abs(volume) > least else 0.0


def _to_world(pieces: tuple[SurfacePiece, ...]) -> _WorldTriangles:
    corners = _corners(pieces[0]) if len(pieces) == 1 else np.concatenate([np.zeros((0, 3, 3)), *map(_corners, pieces)])
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return _WorldTriangles(corners, np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))


def _corners(piece: SurfacePiece) -> Array:
    world = piece.points @ piece.matrix[:3, :3] + piece.matrix[3, :3]
    # Twice as fast as indexing.
    return np.asarray(world.take(turned_outward(piece), axis=0), np.float64)


def turned_outward(piece: SurfacePiece) -> NDArray[np.int32]:
    """Return the triangles of a piece, counter-clockwise seen from outside in the world: mirroring inverts them."""
    return piece.triangles[:, ::-1] if _is_mirrored(piece.matrix) else piece.triangles


def _is_mirrored(matrix: Array) -> bool:
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = matrix[:3, :3].tolist()
    # Most objects are not rotated, and numpy.linalg.det takes long for one small matrix.
    if xy == xz == yx == yz == zx == zy == 0:
        return bool(xx * yy * zz < 0)
    return bool(np.linalg.det(matrix[:3, :3]) < 0)


def is_box(surface: Surface) -> bool:
    """Return whether triangles are the six faces of an axis-aligned box, which its corners fully describe."""
    if not 0 < sum(len(piece.triangles) for piece in surface.pieces) <= _MAX_BOX_POINTS:
        return False
    corners = surface.corners
    low, high = extent_of(corners)
    size = high - low
    slack = _BOX_TOLERANCE * size.max()
    is_at_end = (np.abs(corners - low) <= slack) | (np.abs(corners - high) <= slack)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = float(np.sqrt((normals**2).sum(axis=1)).sum() / 2)
    faces = 2 * float(size[0] * size[1] + size[1] * size[2] + size[2] * size[0])
    return bool(is_at_end.all() and abs(area - faces) <= 1e-3 * faces)
