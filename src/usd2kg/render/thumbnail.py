"""draw_thumbnail: a small picture of a scene that was read before, if it can be drawn within seconds."""

from collections.abc import Iterable
from pathlib import Path

from usd2kg.convert import STAGE_ENDINGS
from usd2kg.errors import SceneError
from usd2kg.render.pictures import Size, picture_of_scene
from usd2kg.render.png import encode_png
from usd2kg.render.triangle_soup import gather
from usd2kg.scene.meshes import ObjectMesh, iterate_meshes
from usd2kg.scene.model import Scene
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.stage import captured_diagnostics, open_stage, time_code

__all__ = ["draw_thumbnail"]

_MAX_PRIMS = 20_000
_MAX_TRIANGLES = 200_000
"""Drawing takes time in proportion, a few seconds at this number."""


def draw_thumbnail(scene: Scene, size: Size) -> bytes | None:
    """Return a PNG of a scene; None if it is too large to be drawn within seconds, or its stage cannot be drawn.

    None also for a scene without a file, one whose file has changed since it was read, and one that has to be
    converted, which may take minutes. The limits are numbers and not seconds, so that the result is deterministic.
    """
    path = Path(scene.source)
    if path.suffix.lower() not in STAGE_ENDINGS or not path.is_file() or scene.prim_count > _MAX_PRIMS:
        return None
    frame = scene.frame
    options = ReadOptions(frame.metres_per_unit, frame.up_axis, scene.time)
    try:
        opened = open_stage(path, options)
        with captured_diagnostics():
            meshes = _take(iterate_meshes(opened, time=time_code(options.time), diagnostics=[]))
    except SceneError:
        return None
    if not meshes or opened.content_hash != scene.content_hash:
        return None
    return encode_png(picture_of_scene(gather(meshes), size))


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
