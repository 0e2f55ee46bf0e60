"""read_geometry: the visible meshes of a stage by object, each shape once, with its placements."""

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from usd2kg.scene.meshes import NEUTRAL_GREY, MeshPiece, MeshReader
from usd2kg.scene.model import Diagnostic, Scene, StageFrame
from usd2kg.scene.stage import OpenedStage, captured_diagnostics

__all__ = ["ColoredMesh", "Placement", "SceneGeometry", "read_geometry"]

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ColoredMesh:
    """The triangles of one object, or of several equal ones, in a frame of their own."""

    points: NDArray[np.float32]
    """(n, 3), in the units of `Placement.matrix`."""
    triangles: NDArray[np.int32]
    """(m, 3), indices into `points`, counter-clockwise seen from outside."""
    colors: NDArray[np.uint8]
    """(n, 4), linear RGB and opacity, 255 for 1."""


@dataclass(frozen=True, slots=True)
class Placement:
    """One mesh in the scene."""

    prim_path: str | None
    """The object; None for geometry outside any object."""
    mesh: int
    """Index into `SceneGeometry.meshes`."""
    matrix: Array
    """(4, 4), for row vectors: to the z-up world in metres."""


@dataclass(frozen=True)
class SceneGeometry:
    """All visible geometry of a scene."""

    meshes: tuple[ColoredMesh, ...]
    placements: tuple[Placement, ...]
    """In scene order; geometry outside any object comes last."""


def read_geometry(
    opened: OpenedStage, scene: Scene, time: Usd.TimeCode, *, diagnostics: list[Diagnostic] | None = None
) -> SceneGeometry:
    """Return the visible meshes by object. Instances of one prototype, and equal meshes, are stored once.

    Args:
        opened: the stage of the scene.
        scene: its objects.
        time: time code.
        diagnostics: receives a note for each gprim that is left out because its data are broken.
    """
    with captured_diagnostics() as notes:
        geometry = _GeometryReader(opened, scene, MeshReader(opened.stage, time, diagnostics)).read()
    if diagnostics is not None:
        diagnostics.extend(notes)
    return geometry


class _GeometryReader:
    """Reads the meshes of one outermost object after the other."""

    def __init__(self, opened: OpenedStage, scene: Scene, reader: MeshReader) -> None:
        self._stage = opened.stage
        self._to_metres = _frame_matrix(opened.frame)
        self._scene = scene
        self._reader = reader
        self._meshes: list[ColoredMesh] = []
        self._by_digest: dict[bytes, int] = {}
        self._of_prototype: dict[str, list[tuple[str, int]]] = {}
        """Path of a prototype → (path below its instance, mesh) of each object in it."""
        self._placements: list[Placement] = []

    def read(self) -> SceneGeometry:
        outermost = [obj.prim_path for obj in self._scene.objects if obj.parent_path is None]
        for path in outermost:
            self._read_object(path)
        root = self._stage.GetPseudoRoot()
        rest = list(self._reader.below(root, without=frozenset(outermost)))
        if rest:
            self._place(None, self._add(rest), self._to_metres)
        order = {obj.prim_path: index for index, obj in enumerate(self._scene.objects)}
        placements = sorted(self._placements, key=lambda p: order.get(p.prim_path or "", len(order)))
        return SceneGeometry(tuple(self._meshes), tuple(placements))

    def _read_object(self, path: str) -> None:
        name, _, number = path.removesuffix("]").partition("[")
        prim = self._stage.GetPrimAtPath(name)
        if not prim:
            return
        matrix = self._reader.matrix(prim)
        # A mirrored frame would turn the triangles inside out, a broken one lose them: keep world points.
        is_plain = bool(np.isfinite(matrix).all() and np.linalg.det(matrix[:3, :3]) > 0)
        prototype = str(prim.GetPrototype().GetPath()) if prim.IsInstance() and is_plain else ""
        to_world = matrix @ self._to_metres if is_plain else self._to_metres
        if prototype in self._of_prototype and all(
            path + below in self._scene.by_path for below, _ in self._of_prototype[prototype]
        ):
            for below, mesh in self._of_prototype[prototype]:
                self._place(path + below, mesh, to_world)
            return
        pieces = self._reader.below(prim, prim if is_plain else None, copy=int(number) if number.isdecimal() else None)
        parts = []
        for owner, own in self._by_owner(pieces, path).items():
            mesh = self._add(own)
            parts.append((owner.removeprefix(path), mesh))
            self._place(owner, mesh, to_world)
        if prototype:
            self._of_prototype[prototype] = parts

    def _by_owner(self, pieces: Iterator[MeshPiece], outermost: str) -> Mapping[str, list[MeshPiece]]:
        """Return prim path of an object → its pieces: those whose nearest object above it is."""
        found: dict[str, list[MeshPiece]] = {}
        for piece in pieces:
            owner = piece.path
            while owner not in self._scene.by_path and len(owner) > len(outermost):
                owner = owner.rpartition("/")[0]
            found.setdefault(owner if owner in self._scene.by_path else outermost, []).append(piece)
        return found

    def _add(self, pieces: Sequence[MeshPiece]) -> int:
        """Return the index of the mesh of some pieces; equal meshes are stored once."""
        mesh = _join(pieces)
        digest = hashlib.sha256(mesh.points.tobytes() + mesh.triangles.tobytes() + mesh.colors.tobytes()).digest()
        if digest not in self._by_digest:
            self._by_digest[digest] = len(self._meshes)
            self._meshes.append(mesh)
        return self._by_digest[digest]

    def _place(self, path: str | None, mesh: int, matrix: Array) -> None:
        self._placements.append(Placement(path, mesh, matrix))


def _join(pieces: Sequence[MeshPiece]) -> ColoredMesh:
    """Return the pieces as one mesh."""
    starts = np.cumsum([0, *(len(piece.points) for piece in pieces)])
    colors = [
        np.tile(
            np.round(255 * np.array([*(piece.look.color or NEUTRAL_GREY), piece.look.opacity])).astype(np.uint8),
            (len(piece.points), 1),
        )
        for piece in pieces
    ]
    triangles = [piece.triangles + np.int32(start) for piece, start in zip(pieces, starts, strict=False)]
    return ColoredMesh(
        points=np.concatenate([piece.points for piece in pieces]).astype(np.float32),
        triangles=np.concatenate(triangles).astype(np.int32),
        colors=np.concatenate(colors),
    )


def _frame_matrix(frame: StageFrame) -> Array:
    """Return the matrix (4, 4), for row vectors, from stage units to metres and z-up: (x, y, z) → (x, -z, y)."""
    matrix: Array = np.eye(4)
    if frame.up_axis != "Z":
        matrix[:3, :3] = [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    matrix[:3, :3] *= frame.metres_per_unit
    return matrix
