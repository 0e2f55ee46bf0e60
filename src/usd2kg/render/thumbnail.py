"""draw_thumbnail, draw_stage_thumbnail: a small picture of a scene, unless drawing takes more than seconds."""

from collections.abc import Iterable
from itertools import islice
from pathlib import Path

from pxr import Usd

from usd2kg.convert import STAGE_ENDINGS
from usd2kg.errors import SceneError
from usd2kg.render.pictures import Size, picture_of_scene
from usd2kg.render.png import encode_png
from usd2kg.render.triangle_soup import gather
from usd2kg.scene.meshes import ObjectMesh, iterate_meshes
from usd2kg.scene.model import Scene
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import captured_diagnostics, open_stage, time_code

__all__ = ["draw_stage_thumbnail", "draw_thumbnail"]

_MAX_PRIMS = 20_000
_MAX_TRIANGLES = 200_000
"""Maximum number of triangles; drawing time is proportional, a few seconds at this number."""


def draw_thumbnail(scene: Scene, size: Size) -> bytes | None:
    """Return a PNG of a scene; None if it is too large to be drawn within seconds, or its stage cannot be drawn.

    None also for a scene without a file, one whose file has changed since it was read, and one that has to be
    converted, which may take minutes. The limits are numbers and not seconds, so that the result is deterministic.
    """
    if scene.prim_count > _MAX_PRIMS:
        return None
    frame = scene.frame
    options = ReadOptions(frame.metres_per_unit, frame.up_axis, scene.time)
    return draw_stage_thumbnail(Path(scene.source), scene.content_hash, size, options)


def draw_stage_thumbnail(path: Path, content_hash: str, size: Size, options: ReadOptions | None = None) -> bytes | None:
    """Return a PNG of the stage in a file; None where `draw_thumbnail` returns None.

    Args:
        path: the root layer.
        content_hash: `Scene.content_hash` of the stage when it was read.
        size: width and height in pixels.
        options: units, up axis and time code; default: those of the stage.
    """
    if path.suffix.lower() not in STAGE_ENDINGS or not path.is_file():
        return None
    options = options or ReadOptions()
    try:
        opened = open_stage(path, options)
        if opened.content_hash != content_hash or _has_more_prims(opened.stage, _MAX_PRIMS):
            return None
        with captured_diagnostics():
            meshes = _take(iterate_meshes(opened, time=time_code(options.time), diagnostics=[]))
    except SceneError:
        return None
    return encode_png(picture_of_scene(gather(meshes), size)) if meshes else None


def _has_more_prims(stage: Usd.Stage, limit: int) -> bool:
    everything = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))
    return next(islice(everything, limit + 1, None), None) is not None


def _take(meshes: Iterable[ObjectMesh]) -> list[ObjectMesh]:
    """Return all meshes with triangles; none if there are too many triangles."""
    taken, count = [], 0
    for mesh in meshes:
        count += len(mesh.triangles)
        if count > _MAX_TRIANGLES:
            return []
        if len(mesh.triangles):
            taken.append(mesh)
    return taken
