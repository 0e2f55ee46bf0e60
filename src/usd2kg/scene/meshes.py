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
from usd2kg.scene.stage import OpenedStage
from usd2kg.scene.textures import TextureMapping, find_texture, read_corner_uv
from usd2kg.scene.triangulation import LocalMesh, as_array, tessellate, triangulate

__all__ = [
    "NEUTRAL_GREY",
    "MeshPiece",
    "MeshReader",
    "ObjectMesh",
    "determinant",
    "iterate_meshes",
    "points_to_metres",
]

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
    mapping: TextureMapping | None = None
    """The base-colour texture; None if there is none, or if textures are not read."""

    @property
    def is_authored(self) -> bool:
        """Whether the material defines the appearance."""
        return self.color is not None or self.mapping is not None


class MeshPiece(NamedTuple):
    """The triangles of one gprim with one look, in the stage's units and axes."""

    path: str
    points: Points
    triangles: Triangles
    look: _Look
    uv: NDArray[np.float32] | None = None
    """(m, 3, 2): texture coordinates at the corners of the triangles; None without a texture."""


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

    def __init__(
        self, stage: Any, time: Usd.TimeCode, notes: list[Diagnostic] | None, *, reads_textures: bool = False
    ) -> None:
        self.stage = stage
        self.reads_textures = reads_textures
        self.time = time
        self.notes = notes
        self.xforms = UsdGeom.XformCache(time)
        self.shared: dict[Any, LocalMesh | None] = {}
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
        # A scale of 1e30 or more puts points beyond all limits and makes the determinant NaN.
        if not (np.abs(matrix) < MAX_COORDINATE).all():
            self.note(prim, "its transform is not finite", "transform")
            return
        points = mesh.points @ matrix[:3, :3] + matrix[3, :3]
        # Mirroring inverts the winding.
        order = slice(None, None, -1 if determinant(matrix) < 0 else 1)
        for look, chosen in self._looks_of(prim, mesh):
            which = slice(None) if chosen is None else chosen
            uv = None
            if look.mapping is not None and mesh.corners is not None:
                uv = read_corner_uv(prim, look.mapping, mesh.triangles[which], mesh.corners[which], self.time)
            yield MeshPiece(
                str(prim.GetPath()),
                points,
                mesh.triangles[which][:, order],
                look,
                None if uv is None else uv[:, order],
            )

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
        prototype_of = as_array(instancer.GetProtoIndicesAttr().Get(self.time), np.int64)
        placed = instancer.ComputeInstanceTransformsAtTime(
            self.time, self.time, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
        )
        if len(placed) != len(prototype_of):
            self.note(prim, f"{len(prototype_of)} copies, but {len(placed)} positions")
            return
        matrices = np.array(placed).reshape(-1, 4, 4) @ self.matrix(prim, space)
        is_shown = np.isfinite(matrices).all(axis=(1, 2))
        if mask := instancer.ComputeMaskAtTime(self.time):
            is_shown &= as_array(mask, np.bool_)
        if copy is not None:
            ids = as_array(instancer.GetIdsAttr().Get(self.time), np.int64)
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

    def _local_mesh(self, prim: Any) -> LocalMesh | None:
        if not prim.IsInstanceProxy():
            return self._read_local_mesh(prim)
        shared = prim.GetPrimInPrototype().GetPath()
        if shared not in self.shared:
            self.shared[shared] = self._read_local_mesh(prim)
        return self.shared[shared]

    def _read_local_mesh(self, prim: Any) -> LocalMesh | None:
        if prim.IsA(UsdGeom.Mesh):
            mesh, problem = triangulate(UsdGeom.Mesh(prim), self.time)
        else:
            mesh, problem = tessellate(prim, self.time)
        if mesh is not None and not (np.abs(mesh.points) < MAX_COORDINATE).all():
            mesh, problem = None, "its points are not all finite"
        if mesh is not None and not len(mesh.triangles):
            return None
        if problem:
            self.note(prim, problem)
        return mesh

    def _looks_of(self, prim: Any, mesh: LocalMesh) -> Iterator[tuple[_Look, NDArray[np.bool_] | None]]:
        """Yield the looks of a prim, each with a mask of its triangles, or None for all of them.

        A material colour overrides the display colour, as in a renderer; many exporters write both.
        """
        rest = np.ones(len(mesh.triangles), np.bool_)
        subsets = UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim)) if prim.GetAllChildrenNames() else ()
        for subset in subsets:
            look = self._material_look(subset.GetPrim())
            chosen = rest & np.isin(mesh.face_of, as_array(subset.GetIndicesAttr().Get(self.time), np.int64))
            if look.is_authored and subset.GetElementTypeAttr().Get() == "face" and chosen.any():
                yield self._with_fallback(look, prim, mesh), chosen
                rest &= ~chosen
        whole = self._material_look(prim)
        if whole.color is None:
            for color, faces in self._display_colors(prim, int(mesh.face_of[-1]) + 1):
                chosen = rest if faces is None else rest & faces[mesh.face_of]
                if chosen.any():
                    yield whole._replace(color=color), None if chosen.all() else chosen
        elif rest.any():
            yield whole, None if rest.all() else rest

    def _with_fallback(self, look: _Look, prim: Any, mesh: LocalMesh) -> _Look:
        """Return the look of some faces; if only a texture gives the colour, with the display colour of the mesh."""
        if look.color is not None:
            return look
        return look._replace(color=self._display_colors(prim, int(mesh.face_of[-1]) + 1)[0][0])

    def _display_colors(self, prim: Any, face_count: int) -> list[tuple[Vector | None, NDArray[np.bool_] | None]]:
        """Return the display colours, each with a mask of its faces, or None for all of them."""
        primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(UsdGeom.Tokens.primvarsDisplayColor)
        colors = as_array(primvar.ComputeFlattened(self.time), np.float64) if primvar and primvar.HasValue() else None
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
        mapping = find_texture(shader, BASE_COLOR_INPUTS, self.time) if self.reads_textures else None
        return _Look(_rgb(color) if color is not None else None, float(opacity) if is_number else 1.0, mapping)

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
    is_mirrored = (np.linalg.det(matrices[:, :3, :3]) < 0)[:, None, None]
    triangles = np.where(is_mirrored, piece.triangles[:, ::-1], piece.triangles)
    uv = None if piece.uv is None else np.where(is_mirrored[..., None], piece.uv[:, ::-1], piece.uv).reshape(-1, 3, 2)
    return MeshPiece(path, points.reshape(-1, 3), (triangles + offsets).reshape(-1, 3), piece.look, uv)


def _rgb(color: Any) -> Vector:
    red, green, blue = (min(max(float(value), 0.0), 1.0) for value in tuple(color)[:3])
    return (red, green, blue)


def determinant(matrix: Points) -> float:
    """Return the determinant of the linear part of a transform (4, 4); negative if it inverts the winding."""
    # numpy.linalg.det takes ten times as long for one small matrix.
    (a, b, c), (d, e, f), (g, h, i) = matrix[:3, :3].tolist()
    return float(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))
