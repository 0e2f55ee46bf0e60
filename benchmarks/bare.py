"""Scenes whose objects have no evidence except name, ancestors, position and size."""

from collections.abc import Sequence

from usd2kg.scene import Box, Scene, SceneObject, StageFrame

__all__ = ["bare_object", "bare_scene"]


def bare_object(
    path: str, size: tuple[float, float, float] | None = None, at: tuple[float, float, float] = (0.0, 0.0, 0.0)
) -> SceneObject:
    """Return an object without other evidence.

    Args:
        path: prim path; its last part is the name.
        size: extents in metres along x, y and z; None for an object without geometry.
        at: lower corner of the box in metres.
    """
    box = None if size is None else Box(at, (at[0] + size[0], at[1] + size[1], at[2] + size[2]))
    return SceneObject(
        prim_path=path,
        name=path.rpartition("/")[2],
        type_name="Xform",
        kind="component",
        selected_by="listed",
        parent_path=None,
        box=box,
        own_box=box,
        part_boxes=(),
        position=at,
        orientation=(0.0, 0.0, 0.0, 1.0),
        mass_kg=None,
        display_name="",
        documentation="",
        asset=(),
        materials=(),
        parts=(),
        display_color=None,
        instance_of=None,
    )


def bare_scene(source: str, objects: Sequence[SceneObject]) -> Scene:
    """Return a scene of these objects: metres, Z up."""
    return Scene(
        source=source,
        content_hash="",
        frame=StageFrame("Z", 1.0, 1.0, is_authored=True),
        time=None,
        prim_count=len(objects),
        objects=tuple(objects),
        left_out={},
    )
