"""Renderer: pictures of a stage that is opened once."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd
from rapidfuzz import fuzz, process

from usd2kg.errors import SceneError
from usd2kg.render.pictures import Size, choose_scene_view, picture_in_context, picture_of_object, picture_of_scene
from usd2kg.render.png import encode_png
from usd2kg.render.settings import PICTURE, VIEWPOINT
from usd2kg.render.triangle_soup import gather
from usd2kg.scene.meshes import ObjectMesh, iterate_meshes
from usd2kg.scene.model import Diagnostic, Vector
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import captured_diagnostics, open_stage, time_code

__all__ = ["ObjectColors", "Renderer", "render_object", "render_objects", "render_scene"]

ObjectColors = Mapping[str, Vector]
"""Prim path → linear RGB, 0 to 1, replacing material colours; `/` is for prims below no other path."""


def render_object(
    source: Path | str | Usd.Stage, prim_path: str, *, size: Size = PICTURE.thumbnail_size, in_context: bool = False
) -> bytes:
    """Return a PNG of one object, alone or highlighted in its surroundings.

    The output is deterministic.

    Raises:
        SceneError: the stage cannot be read, there is no such prim, or it has no visible geometry.
    """
    return Renderer(source).render_object(prim_path, size=size, in_context=in_context)


def render_objects(
    source: Path | str | Usd.Stage,
    prim_paths: Iterable[str],
    *,
    size: Size = PICTURE.thumbnail_size,
    in_context: bool = False,
) -> Iterator[tuple[str, bytes | None]]:
    """Yield (prim path, PNG) for each object, or None where it has no visible geometry; the stage is opened once.

    Raises:
        SceneError: the stage cannot be read, or there is no such prim.
    """
    renderer = Renderer(source)
    for path in prim_paths:
        has_geometry = bool(renderer.meshes_below(path))
        yield path, renderer.render_object(path, size=size, in_context=in_context) if has_geometry else None


def render_scene(source: Path | str | Usd.Stage, *, size: Size = PICTURE.scene_size) -> bytes:
    """Return a PNG of the whole scene from a corner above, without ceiling and near walls.

    Raises:
        SceneError: the stage cannot be read, or has no visible geometry.
    """
    return Renderer(source).render_scene(size=size)


class Renderer:
    """Draws pictures of one stage; meshes are read when first needed and cached."""

    def __init__(self, source: Path | str | Usd.Stage, options: ReadOptions | None = None) -> None:
        options = options or ReadOptions()
        self._opened = open_stage(source, options)
        self._time = time_code(options.time)
        self.diagnostics: list[Diagnostic] = list(self._opened.diagnostics)
        """Problems found on the stage so far."""

    def render_object(
        self,
        prim_path: str,
        *,
        size: Size = PICTURE.thumbnail_size,
        in_context: bool = False,
        colors: ObjectColors | None = None,
    ) -> bytes:
        """Return a PNG of one object, alone in given colours; see `usd2kg.render.render_object`."""
        _check_size(size)
        meshes = self.meshes_below(prim_path)
        if not meshes:
            raise SceneError(f"{self._opened.source}: {prim_path} has no visible geometry, so it cannot be drawn")
        if not in_context:
            return encode_png(picture_of_object(gather(_recolored(meshes, colors)), size))
        soup = gather([*meshes, *self._around(meshes)])
        return encode_png(picture_in_context(soup, len(meshes), size))

    def render_scene(self, *, size: Size = PICTURE.scene_size, colors: ObjectColors | None = None) -> bytes:
        """Return a PNG of the whole scene; see `usd2kg.render.render_scene`."""
        return encode_png(picture_of_scene(gather(_recolored(self._scene_meshes(size), colors)), size))

    def project_scene(self, points: NDArray[np.floating], *, size: Size = PICTURE.scene_size) -> NDArray[np.float64]:
        """Return where world points (n, 3) appear in the picture that `render_scene` draws: (n, 2), pixels.

        Raises:
            SceneError: the stage has no visible geometry.
        """
        camera = choose_scene_view(gather(self._scene_meshes(size)), size).camera
        return camera.to_pixels(camera.to_view(points))[:, :2]

    def _scene_meshes(self, size: Size) -> list[ObjectMesh]:
        _check_size(size)
        if not self._all_meshes:
            raise SceneError(f"{self._opened.source}: the stage has no visible geometry, so it cannot be drawn")
        return self._all_meshes

    def meshes_below(self, prim_path: str) -> list[ObjectMesh]:
        """Return the visible meshes at and below a prim, or of one copy of a point instancer (`path[id]`).

        Raises:
            SceneError: there is no such prim.
        """
        self._check_path(prim_path)
        return self._read([prim_path])

    def _read(self, paths: list[str]) -> list[ObjectMesh]:
        with captured_diagnostics() as openusd_notes:
            found = list(iterate_meshes(self._opened, paths, self._time, diagnostics=self.diagnostics))
        self.diagnostics.extend(openusd_notes)
        return [mesh for mesh in found if len(mesh.triangles)]

    @cached_property
    def _all_meshes(self) -> list[ObjectMesh]:
        return self._read(["/"])

    @cached_property
    def _boxes(self) -> NDArray[np.float32]:
        """(n, 2, 3): AABB corners of each mesh."""
        boxes = [(mesh.points.min(axis=0), mesh.points.max(axis=0)) for mesh in self._all_meshes]
        return np.array(boxes, np.float32).reshape(-1, 2, 3)

    def _around(self, meshes: list[ObjectMesh]) -> list[ObjectMesh]:
        """Return the other meshes that overlap the surroundings of an object."""
        low = np.min([mesh.points.min(axis=0) for mesh in meshes], axis=0)
        high = np.max([mesh.points.max(axis=0) for mesh in meshes], axis=0)
        reach = max(VIEWPOINT.surroundings * float((high - low).max()), VIEWPOINT.min_surroundings)
        is_near = ((self._boxes[:, 1] >= low - reach) & (self._boxes[:, 0] <= high + reach)).all(axis=1)
        own = {mesh.prim_path for mesh in meshes}
        return [self._all_meshes[i] for i in np.flatnonzero(is_near) if self._all_meshes[i].prim_path not in own]

    def _check_path(self, prim_path: str) -> None:
        name = prim_path.partition("[")[0]
        stage: Any = self._opened.stage
        if name.startswith("/") and Sdf.Path.IsValidPathString(name) and stage.GetPrimAtPath(name):
            return
        everything = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)
        paths = [str(prim.GetPath()) for prim in Usd.PrimRange(stage.GetPseudoRoot(), everything)][1:]
        # Users type a name without its path, or with a typo.
        wanted = name.rpartition("/")[2].lower()
        names = [path.rpartition("/")[2].lower() for path in paths]
        close = [paths[match[2]] for match in process.extract(wanted, names, scorer=fuzz.WRatio, limit=3)]
        hint = f"; did you mean {' or '.join(close)}?" if close else ""
        raise SceneError(f"{self._opened.source}: there is no prim {prim_path}; expected an absolute path{hint}")


def _recolored(meshes: list[ObjectMesh], colors: ObjectColors | None) -> list[ObjectMesh]:
    """Return the meshes, each in the colour of the nearest prim at or above it that has one."""
    if colors is None:
        return meshes
    return [replace(mesh, color=_nearest(mesh.prim_path, colors, mesh.color)) for mesh in meshes]


def _nearest(prim_path: str, colors: ObjectColors, default: Vector) -> Vector:
    path = prim_path
    while path not in colors and path:
        path = path.rpartition("/")[0]
    return colors.get(path or "/", default)


def _check_size(size: Size) -> None:
    if not all(1 <= side <= PICTURE.max_side for side in size):
        raise SceneError(
            f"cannot draw a picture of {size[0]}x{size[1]} pixels; expected 1 to {PICTURE.max_side} per side"
        )
