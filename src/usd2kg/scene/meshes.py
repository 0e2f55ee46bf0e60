"""Visible triangles of a stage with their colours, in metres and z-up."""

from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Tf, Usd, UsdGeom, UsdShade

from usd2kg.errors import SceneError
from usd2kg.scene.metadata import BASE_COLOR_INPUTS
from usd2kg.scene.model import Diagnostic, StageFrame, Vector
from usd2kg.scene.settings import MAX_COORDINATE, MESHES
from usd2kg.scene.solids import solid_surface
from usd2kg.scene.stage import OpenedStage

__all__ = ["NEUTRAL_GREY", "MeshPiece", "MeshReader", "ObjectMesh", "iterate_meshes", "points_to_metres", "read_mesh"]

Points = NDArray[np.float64]
Triangles = NDArray[np.int32]

NEUTRAL_GREY: Vector = (0.5, 0.5, 0.5)
"""Linear RGB of geometry without an authored colour."""

_PURPOSES = frozenset({UsdGeom.Tokens.default_, UsdGeom.Tokens.render})


@dataclass(frozen=True, slots=True)
class ObjectMesh:
    """The triangles of one gprim, or of its faces with one material."""

    prim_path: str
    """The gprim; for copies of a point instancer, the instancer."""
    points: NDArray[np.float32]
    """(n, 3), metres, z-up world frame."""
    triangles: Triangles
    """(m, 3), indices into `points`, counter-clockwise seen from outside."""
    color: Vector
    """Linear RGB from 0 to 1."""
    opacity: float
    """1 for solid, less for glass."""


class _Look(NamedTuple):
    color: Vector | None
    opacity: float


class _LocalMesh(NamedTuple):
    """The triangles of a gprim in its own frame and stage units."""

    points: Points
    triangles: Triangles
    face_of: NDArray[np.int64]
    """Index of the mesh face of each triangle."""


class MeshPiece(NamedTuple):
    """The triangles of one gprim with one look, in the stage's units and axes."""

    path: str
    points: Points
    triangles: Triangles
    look: _Look


def iterate_meshes(
    opened: OpenedStage,
    root_paths: Iterable[str] = ("/",),
    time: Usd.TimeCode | None = None,
    *,
    diagnostics: list[Diagnostic] | None = None,
) -> Iterator[ObjectMesh]:
    """Yield the meshes of visible gprims with default or render purpose at and below `root_paths`, in traversal order.

    Polygons are triangulated as fans; subdivision and holes are ignored; instances are traversed. The copies of a point
    instancer are one mesh per gprim of the prototype; beyond a limit, an even selection of copies is returned.

    Args:
        opened: the stage.
        root_paths: where to start; overlapping subtrees are traversed once. `path[id]` is one copy of a point
            instancer.
        time: time code; default: the earliest.
        diagnostics: receives a note for each gprim that is left out because its data are broken.

    Raises:
        SceneError: a path is not on the stage.
    """
    reader = MeshReader(opened.stage, time or Usd.TimeCode.EarliestTime(), diagnostics)
    for root, copy in _roots(opened.stage, root_paths):
        for piece in reader.below(root, copy=copy):
            world = points_to_metres(piece.points, opened.frame)
            if not (np.abs(world) < MAX_COORDINATE).all():
                # Its points are finite, its transform is not.
                reader.note(opened.stage.GetPrimAtPath(piece.path), "its points are not all finite in the world")
                continue
            points = np.ascontiguousarray(world, dtype=np.float32)
            color = piece.look.color or NEUTRAL_GREY
            yield ObjectMesh(piece.path, points, piece.triangles, color, piece.look.opacity)


def _roots(stage: Any, root_paths: Iterable[str]) -> list[tuple[Any, int | None]]:
    """Return the prims at the paths, each with the number of one copy if the path ends in `[number]`."""
    paths: list[Any] = []
    copies: list[tuple[Any, int | None]] = []
    for text in root_paths:
        name, _, number = text.removesuffix("]").partition("[")
        is_path = bool(Sdf.Path.IsValidPathString(name)) and name.startswith("/")
        if not is_path or not stage.GetPrimAtPath(name):
            raise SceneError(f"{stage.GetRootLayer().identifier}: there is no prim {text}, expected a prim path")
        if number.isdecimal():
            copies.append((stage.GetPrimAtPath(name), int(number)))
        else:
            paths.append(Sdf.Path(name))
    return [*((stage.GetPrimAtPath(path), None) for path in Sdf.Path.RemoveDescendentPaths(paths)), *copies]


def points_to_metres(points: Points, frame: StageFrame) -> Points:
    """Return points (n, 3) of the stage in metres, z-up: (x, y, z) of a y-up stage becomes (x, -z, y)."""
    world = points * frame.metres_per_unit
    return world if frame.up_axis == "Z" else np.stack([world[:, 0], -world[:, 2], world[:, 1]], axis=1)


class MeshReader:
    """Reads gprims one by one, with caches for transforms, shared meshes and materials."""

    def __init__(self, stage: Any, time: Usd.TimeCode, notes: list[Diagnostic] | None) -> None:
        self.stage = stage
        self.time = time
        self.notes = notes
        self.xforms = UsdGeom.XformCache(time)
        self.shared: dict[Any, _LocalMesh | None] = {}
        self.looks: dict[Any, _Look] = {}
        self.copied_triangles_left = MESHES.max_copied_triangles

    def below(
        self,
        root: Any,
        space: Any = None,
        depth: int = 0,
        copy: int | None = None,
        without: Container[str] = frozenset(),
    ) -> Iterator[MeshPiece]:
        """Yield the gprims at and below `root`, with points in the frame of the prim `space`, or of the world.

        Args:
            root: where to start.
            space: a prim at or above `root`; None for the world.
            depth: number of point instancers around it.
            copy: id of the only copy to draw, if `root` is a point instancer.
            without: paths of prims that are left out with all that is below them.
        """
        above = root.GetParent()
        while space is None and above:
            if self._is_invisible(above):
                return
            above = above.GetParent()
        predicate = Usd.PrimDefaultPredicate if space is None else Usd.PrimIsActive & Usd.PrimIsLoaded
        prims = iter(Usd.PrimRange(root, Usd.TraverseInstanceProxies(predicate)))
        for prim in prims:
            if without and str(prim.GetPath()) in without:
                prims.PruneChildren()
                continue
            is_instancer = prim.IsA(UsdGeom.PointInstancer)
            if is_instancer or self._is_invisible(prim):
                prims.PruneChildren()
            if (is_instancer or prim.IsA(UsdGeom.Gprim)) and self._is_drawn(prim):
                try:
                    yield from self._copies(prim, space, depth, copy) if is_instancer else self._pieces(prim, space)
                except Tf.ErrorException as error:
                    self.note(prim, f"OpenUSD cannot read it ({str(error).strip().splitlines()[-1]})")

    def _is_invisible(self, prim: Any) -> bool:
        if prim.IsPseudoRoot():
            return False
        visibility = prim.GetAttribute(UsdGeom.Tokens.visibility)
        return bool(visibility.HasAuthoredValue() and visibility.Get(self.time) == UsdGeom.Tokens.invisible)

    def _is_drawn(self, prim: Any) -> bool:
        return not self._is_invisible(prim) and UsdGeom.Imageable(prim).ComputePurpose() in _PURPOSES

    def _pieces(self, prim: Any, space: Any) -> Iterator[MeshPiece]:
        mesh = self._local_mesh(prim)
        matrix = self.matrix(prim, space)
        if mesh is None or not len(mesh.triangles):
            return
        # A factor of 1e30 and more has points beyond all limits, and a determinant that is no number.
        if not (np.abs(matrix) < MAX_COORDINATE).all():
            self.note(prim, "its transform is not finite", "transform")
            return
        points = mesh.points @ matrix[:3, :3] + matrix[3, :3]
        # Mirroring inverts the winding.
        triangles = mesh.triangles[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else mesh.triangles
        for look, chosen in self._looks_of(prim, mesh):
            yield MeshPiece(str(prim.GetPath()), points, triangles if chosen is None else triangles[chosen], look)

    def matrix(self, prim: Any, space: Any = None) -> Points:
        """Return the transform of a prim (4, 4), for row vectors, to the frame of a prim above it, or to the world."""
        if space is None:
            return np.array(self.xforms.GetLocalToWorldTransform(prim))
        return np.eye(4) if prim == space else np.array(self.xforms.ComputeRelativeTransform(prim, space)[0])

    def _copies(self, prim: Any, space: Any, depth: int, copy: int | None) -> Iterator[MeshPiece]:
        if depth >= MESHES.max_instancer_depth:
            self.note(prim, f"point instancers are nested more than {MESHES.max_instancer_depth} deep")
            return
        instancer = UsdGeom.PointInstancer(prim)
        prototype_of = _array(instancer.GetProtoIndicesAttr().Get(self.time), np.int64)
        placed = instancer.ComputeInstanceTransformsAtTime(
            self.time, self.time, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
        )
        if len(placed) != len(prototype_of):
            self.note(prim, f"{len(prototype_of)} copies, but {len(placed)} positions")
            return
        matrices = np.array(placed).reshape(-1, 4, 4) @ self.matrix(prim, space)
        is_shown = np.isfinite(matrices).all(axis=(1, 2))
        if mask := instancer.ComputeMaskAtTime(self.time):
            is_shown &= _array(mask, np.bool_)
        if copy is not None:
            ids = _array(instancer.GetIdsAttr().Get(self.time), np.int64)
            is_shown &= (ids if len(ids) == len(placed) else np.arange(len(placed))) == copy
        for i, target in enumerate(instancer.GetPrototypesRel().GetForwardedTargets()):
            prototype = self.stage.GetPrimAtPath(target)
            chosen = matrices[(prototype_of == i) & is_shown]
            if prototype and len(chosen):
                pieces = list(self.below(prototype, prototype, depth + 1))
                drawn = self._even_selection(prim, chosen, sum(len(piece.triangles) for piece in pieces))
                for piece in pieces:
                    yield _scatter(str(prim.GetPath()), piece, drawn)

    def _even_selection(self, prim: Any, matrices: Points, triangle_count: int) -> Points:
        limit = min(MESHES.max_copies, max(1, self.copied_triangles_left // max(1, triangle_count)))
        if len(matrices) > limit:
            self.note(prim, f"{limit} of {len(matrices)} copies are drawn; the others are", "copies")
            matrices = matrices[np.linspace(0, len(matrices) - 1, limit).astype(np.int64)]
        self.copied_triangles_left -= len(matrices) * triangle_count
        return matrices

    def _local_mesh(self, prim: Any) -> _LocalMesh | None:
        if not prim.IsInstanceProxy():
            return self._read_local_mesh(prim)
        shared = prim.GetPrimInPrototype().GetPath()
        if shared not in self.shared:
            self.shared[shared] = self._read_local_mesh(prim)
        return self.shared[shared]

    def _read_local_mesh(self, prim: Any) -> _LocalMesh | None:
        if prim.IsA(UsdGeom.Mesh):
            mesh, problem = _triangulate(UsdGeom.Mesh(prim), self.time)
        else:
            mesh, problem = _tessellate(prim, self.time)
        if mesh is not None and not (np.abs(mesh.points) < MAX_COORDINATE).all():
            mesh, problem = None, "its points are not all finite"
        if mesh is not None and not len(mesh.triangles):
            return None
        if problem:
            self.note(prim, problem)
        return mesh

    def _looks_of(self, prim: Any, mesh: _LocalMesh) -> Iterator[tuple[_Look, NDArray[np.bool_] | None]]:
        """Yield the looks of a prim, each with a mask of its triangles, or None for all of them.

        A material colour overrides the display colour, as in a renderer; many exporters write both.
        """
        rest = np.ones(len(mesh.triangles), np.bool_)
        for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim)):
            look = self._material_look(subset.GetPrim())
            chosen = rest & np.isin(mesh.face_of, _array(subset.GetIndicesAttr().Get(self.time), np.int64))
            if look.color is not None and subset.GetElementTypeAttr().Get() == "face" and chosen.any():
                yield look, chosen
                rest &= ~chosen
        whole = self._material_look(prim)
        if whole.color is None:
            for color, faces in self._display_colors(prim, int(mesh.face_of[-1]) + 1):
                chosen = rest if faces is None else rest & faces[mesh.face_of]
                if chosen.any():
                    yield _Look(color, whole.opacity), None if chosen.all() else chosen
        elif rest.any():
            yield whole, None if rest.all() else rest

    def _display_colors(self, prim: Any, face_count: int) -> list[tuple[Vector | None, NDArray[np.bool_] | None]]:
        """Return the display colours, each with a mask of its faces, or None for all of them."""
        primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(UsdGeom.Tokens.primvarsDisplayColor)
        colors = _array(primvar.ComputeFlattened(self.time), np.float64) if primvar and primvar.HasValue() else None
        if colors is None or not len(colors) or colors.shape[1:] != (3,) or not np.isfinite(colors).all():
            return [(None, None)]
        if primvar.GetInterpolation() == UsdGeom.Tokens.uniform and len(colors) >= face_count:
            distinct, which = np.unique(colors, axis=0, return_inverse=True)
            if len(distinct) <= MESHES.max_display_colors:
                return [(_rgb(color), which.reshape(-1) == i) for i, color in enumerate(distinct)]
        return [(_rgb(colors.mean(axis=0)), None)]

    def _material_look(self, prim: Any) -> _Look:
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        if not material:
            return _Look(None, 1.0)
        path = material.GetPath()
        if path not in self.looks:
            self.looks[path] = self._read_material(material)
        return self.looks[path]

    def _read_material(self, material: Any) -> _Look:
        shader = material.ComputeSurfaceSource()[0] or material.ComputeSurfaceSource("mdl")[0]
        if not shader:
            return _Look(None, 1.0)
        colors = (self._constant(shader, name) for name in BASE_COLOR_INPUTS)
        color = next((value for value in colors if value is not None and hasattr(value, "__len__")), None)
        opacity = self._constant(shader, "opacity")
        is_number = isinstance(opacity, int | float) and 0 <= opacity <= 1
        return _Look(_rgb(color) if color is not None else None, float(opacity) if is_number else 1.0)

    def _constant(self, shader: Any, name: str) -> Any:
        """Return the value of a shader input; None without a value or if it is connected to a texture."""
        source = shader.GetInput(name)
        if not source:
            return None
        inputs = [
            attribute
            for attribute in source.GetValueProducingAttributes()
            if UsdShade.Utils.GetType(attribute.GetName()) == UsdShade.AttributeType.Input
        ]
        return inputs[0].Get(self.time) if inputs else None

    def note(self, prim: Any, problem: str, code: str = "mesh") -> None:
        """Note why a prim is not in pictures."""
        if self.notes is not None:
            self.notes.append(Diagnostic(code, f"{problem}; not in pictures", str(prim.GetPath())))


def _scatter(path: str, piece: MeshPiece, matrices: Points) -> MeshPiece:
    points = piece.points @ matrices[:, :3, :3] + matrices[:, 3, None, :3]
    offsets = np.arange(len(matrices), dtype=np.int32)[:, None, None] * len(piece.points)
    triangles = np.where(
        (np.linalg.det(matrices[:, :3, :3]) < 0)[:, None, None], piece.triangles[:, ::-1], piece.triangles
    )
    return MeshPiece(path, points.reshape(-1, 3), (triangles + offsets).reshape(-1, 3), piece.look)


def _array(values: Any, dtype: Any) -> NDArray[Any]:
    """Return values as an array; an empty array for None or for values that are not numbers (mistyped attributes)."""
    try:
        array = np.asarray(values if values is not None else (), dtype=dtype)
    except (TypeError, ValueError):
        array = np.zeros(0, dtype)
    return array if array.ndim else np.zeros(0, dtype)


def _rgb(color: Any) -> Vector:
    red, green, blue = (min(max(float(value), 0.0), 1.0) for value in tuple(color)[:3])
    return (red, green, blue)


def read_mesh(prim: Any, time: Usd.TimeCode) -> tuple[Points, Triangles] | None:
    """Return points (n, 3) of a mesh in its own frame and stage units, and triangles (m, 3); None if empty or broken.

    Triangles are counter-clockwise seen from outside; polygons are triangulated as fans.
    """
    mesh, _ = _triangulate(UsdGeom.Mesh(prim), time)
    return (mesh.points, mesh.triangles) if mesh is not None and np.isfinite(mesh.points).all() else None


def _tessellate(prim: Any, time: Usd.TimeCode) -> tuple[_LocalMesh | None, str]:
    """Return the triangles of a solid, or None and the problem."""
    surface = solid_surface(prim, time)
    if surface is None:
        return None, f"a {prim.GetTypeName() or 'prim without type'} has no triangles"
    points, triangles = surface
    return _LocalMesh(points, triangles, np.zeros(len(triangles), np.int64)), ""


def _triangulate(mesh: Any, time: Usd.TimeCode) -> tuple[_LocalMesh | None, str]:
    """Return the triangles of a mesh, or None and the problem."""
    points = _array(mesh.GetPointsAttr().Get(time), np.float64)
    counts = _array(mesh.GetFaceVertexCountsAttr().Get(time), np.int64)
    indices = _array(mesh.GetFaceVertexIndicesAttr().Get(time), np.int64)
    if not len(points) or not len(counts):
        return None, ""
    if points.shape[1:] != (3,) or counts.ndim != 1 or indices.ndim != 1:
        return None, "its points or faces are not of the type that OpenUSD specifies"
    if counts.min() < 0 or counts.sum() != len(indices):
        return None, f"faceVertexCounts add up to {int(counts.sum())}, but faceVertexIndices has {len(indices)} values"
    if len(indices) and (indices.min() < 0 or indices.max() >= len(points)):
        return None, f"faceVertexIndices has values outside 0 … {len(points) - 1}"
    fan = np.maximum(counts - 2, 0)
    face_of = np.repeat(np.arange(len(counts)), fan)
    first = np.repeat(np.cumsum(counts) - counts, fan)
    nth = np.arange(len(face_of)) - np.repeat(np.cumsum(fan) - fan, fan)
    corners = np.stack([first, first + nth + 1, first + nth + 2], axis=1)
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        corners = corners[:, ::-1]
    return _LocalMesh(points, indices[corners].astype(np.int32), face_of), ""
