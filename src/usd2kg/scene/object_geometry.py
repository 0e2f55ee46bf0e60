"""GeometryReader: the visible meshes of a stage by object, each shape once, with its placements."""

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from usd2kg.scene.meshes import NEUTRAL_GREY, MeshPiece, MeshReader, determinant
from usd2kg.scene.model import Diagnostic, Scene, StageFrame
from usd2kg.scene.stage import OpenedStage, captured_diagnostics
from usd2kg.scene.textures import Texture
from usd2kg.scene.triangle_counter import TriangleCounter

__all__ = ["NO_TEXTURE", "ColoredMesh", "GeometryReader", "MeshPlacement", "join_meshes"]

Array = NDArray[np.float64]

NO_TEXTURE = -1


@dataclass(frozen=True, slots=True)
class ColoredMesh:
    """The triangles of one object, or of several equal ones, in a frame of their own."""

    points: NDArray[np.float32]
    """(n, 3), in the units of `MeshPlacement.matrix`."""
    triangles: NDArray[np.int32]
    """(m, 3), indices into `points`, counter-clockwise seen from outside."""
    colors: NDArray[np.uint8]
    """(n, 4), linear RGB and opacity, 255 for 1; the colour applies where there is no texture."""
    uv: NDArray[np.float32]
    """(n, 2), texture coordinates; 0 where there is no texture."""
    texture: NDArray[np.int32]
    """(m,), index of the texture of each triangle in `GeometryReader.textures`, or `NO_TEXTURE`."""

    def arrays(self) -> tuple[NDArray[Any], ...]:
        """Return all arrays; meshes are equal if these are."""
        return self.points, self.triangles, self.colors, self.uv, self.texture


@dataclass(frozen=True, slots=True)
class MeshPlacement:
    """One mesh in the scene."""

    prim_path: str | None
    """The object; None for geometry outside any object."""
    mesh: int
    """Index into `GeometryReader.meshes`."""
    matrix: Array
    """(4, 4), for row vectors: to the z-up world in metres."""


class GeometryReader:
    """Reads the visible meshes of a scene, one outermost object after the other.

    Instances of one prototype, and equal meshes, are stored once.
    """

    def __init__(
        self, opened: OpenedStage, scene: Scene, time: Usd.TimeCode, diagnostics: list[Diagnostic] | None = None
    ) -> None:
        """Prepare the reader; nothing is read yet.

        Args:
            opened: the stage of the scene.
            scene: its objects.
            time: time code.
            diagnostics: receives a note for each gprim that is left out because its data are broken.
        """
        self.meshes: list[ColoredMesh] = []
        """The data read so far."""
        self.outermost = tuple(obj.prim_path for obj in scene.objects if obj.parent_path is None)
        """Prim paths of the objects in no other object, in scene order."""
        self._stage = opened.stage
        self._to_metres = _frame_matrix(opened.frame)
        self._scene = scene
        self._notes: list[Diagnostic] = [] if diagnostics is None else diagnostics
        self._reader = MeshReader(opened.stage, time, self._notes, reads_textures=True)
        self._triangles = TriangleCounter(opened.stage, time)
        self._textures: dict[Texture, int] = {}
        self._by_digest: dict[bytes, int] = {}
        self._of_prototype: dict[str, list[tuple[str, int]]] = {}
        """Path of a prototype → (path below its instance, mesh) of each object in it."""

    @property
    def textures(self) -> tuple[Texture, ...]:
        """The textures of the meshes that have been read so far."""
        return tuple(self._textures)

    def count(self, prim_path: str) -> int:
        """Return an estimate of the triangles of an outermost object, without reading its points."""
        return self._triangles.count(prim_path.partition("[")[0])

    def count_outside(self) -> int:
        """Return an estimate of the triangles outside any object."""
        return self._triangles.count("/", without=frozenset(self.outermost))

    def read(self, prim_paths: Iterable[str]) -> list[MeshPlacement]:
        """Return the meshes of outermost objects and of the objects in them."""
        with captured_diagnostics() as notes:
            found = [placement for path in prim_paths for placement in self._read_object(path)]
        self._notes.extend(notes)
        return found

    def read_outside(self) -> list[MeshPlacement]:
        """Return the mesh of the geometry outside any object; none if there is no such geometry."""
        with captured_diagnostics() as notes:
            root = self._stage.GetPseudoRoot()
            rest = list(self._reader.below(root, without=frozenset(self.outermost)))
        self._notes.extend(notes)
        return [MeshPlacement(None, self._add(rest), self._to_metres)] if rest else []

    def _read_object(self, path: str) -> list[MeshPlacement]:
        name, _, number = path.removesuffix("]").partition("[")
        prim = self._stage.GetPrimAtPath(name)
        if not prim:
            return []
        matrix = self._reader.matrix(prim)
        # A mirrored frame would turn the triangles inside out, a broken one lose them: points stay in the world frame.
        is_plain = bool(np.isfinite(matrix).all() and determinant(matrix) > 0)
        prototype = str(prim.GetPrototype().GetPath()) if prim.IsInstance() and is_plain else ""
        to_world = matrix @ self._to_metres if is_plain else self._to_metres
        parts = self._of_prototype.get(prototype)
        if parts is None or not all(path + below in self._scene.by_path for below, _ in parts):
            copy = int(number) if number.isdecimal() else None
            pieces = self._reader.below(prim, prim if is_plain else None, copy=copy)
            own = self._by_owner(pieces, path)
            parts = [(owner.removeprefix(path), self._add(found)) for owner, found in own.items()]
            if prototype:
                self._of_prototype[prototype] = parts
        return [MeshPlacement(path + below, mesh, to_world) for below, mesh in parts]

    def _by_owner(self, pieces: Iterator[MeshPiece], outermost: str) -> Mapping[str, list[MeshPiece]]:
        """Return prim path of an object → the pieces of which it is the nearest ancestor object."""
        found: dict[str, list[MeshPiece]] = {}
        for piece in pieces:
            owner = piece.path
            while owner not in self._scene.by_path and len(owner) > len(outermost):
                owner = owner.rpartition("/")[0]
            found.setdefault(owner if owner in self._scene.by_path else outermost, []).append(piece)
        return found

    def _add(self, pieces: Sequence[MeshPiece]) -> int:
        """Return the index of the mesh of some pieces; equal meshes are stored once."""
        mesh = join_meshes([self._split_at_seams(piece) for piece in pieces])
        digest = hashlib.sha256(b"".join(part.tobytes() for part in mesh.arrays())).digest()
        if digest not in self._by_digest:
            self._by_digest[digest] = len(self.meshes)
            self.meshes.append(mesh)
        return self._by_digest[digest]

    def _split_at_seams(self, piece: MeshPiece) -> ColoredMesh:
        """Return a piece as a mesh, with several points where the corners at a point differ in texture coordinates."""
        points, triangles, texture = piece.points, piece.triangles, NO_TEXTURE
        uv: NDArray[np.float32] | None = None
        if piece.uv is not None and piece.look.mapping is not None:
            corners, uv = triangles.reshape(-1).astype(np.int64), piece.uv.reshape(-1, 2)
            key = np.column_stack([corners, uv.astype(np.float32).view(np.int32)])
            _, first, which = np.unique(key, axis=0, return_index=True, return_inverse=True)
            points, uv, triangles = points[corners[first]], uv[first], which.reshape(-1, 3).astype(np.int32)
            texture = self._textures.setdefault(piece.look.mapping.texture, len(self._textures))
        color = np.round(255 * np.array([*(piece.look.color or NEUTRAL_GREY), piece.look.opacity])).astype(np.uint8)
        return ColoredMesh(
            points.astype(np.float32),
            triangles.astype(np.int32),
            np.tile(color, (len(points), 1)),
            np.zeros((len(points), 2), np.float32) if uv is None else uv,
            np.full(len(triangles), texture, np.int32),
        )


def join_meshes(parts: Sequence[ColoredMesh]) -> ColoredMesh:
    """Return several meshes as one."""
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    return ColoredMesh(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.triangles + np.int32(start) for part, start in zip(parts, starts, strict=False)]),
        np.concatenate([part.colors for part in parts]),
        np.concatenate([part.uv for part in parts]),
        np.concatenate([part.texture for part in parts]),
    )


def _frame_matrix(frame: StageFrame) -> Array:
    """Return the matrix (4, 4), for row vectors, from stage units to metres and z-up: (x, y, z) → (x, -z, y)."""
    matrix: Array = np.eye(4)
    if frame.up_axis != "Z":
        matrix[:3, :3] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    matrix[:3, :3] *= frame.metres_per_unit
    return matrix
