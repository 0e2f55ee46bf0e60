"""The copies of point instancers: counted as one object, or each an object of its own."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

from usd2kg.scene.bounds import BoxReader, pose_of
from usd2kg.scene.evidence import asset_names
from usd2kg.scene.model import Box, Instances, SceneObject, StageFrame
from usd2kg.scene.outline import Node

__all__ = ["COPY", "count_copies", "read_copies"]

COPY = "copy of a point instancer"
"""`selected_by` of an object that is one copy."""


def count_copies(nodes: list[Node], time: Usd.TimeCode) -> Instances | None:
    """Return the copies of an object's own point instancers; None if it has none."""
    instancers = [UsdGeom.PointInstancer(node.prim) for node in nodes if node.is_instancer]
    if not instancers:
        return None
    names = [target.name for i in instancers for target in i.GetPrototypesRel().GetTargets()]
    return Instances(sum(sum(_drawn(i, time)) for i in instancers), tuple(dict.fromkeys(names)))


def _drawn(instancer: Any, time: Usd.TimeCode) -> list[bool]:
    """Return for each copy whether it is drawn: neither inactive nor invisible."""
    count = len(instancer.GetProtoIndicesAttr().Get(time) or ())
    # The mask is empty where all are drawn.
    return list(instancer.ComputeMaskAtTime(time)) or [True] * count


def read_copies(
    node: Node, parent_path: str | None, frame: StageFrame, time: Usd.TimeCode, boxes: BoxReader
) -> Iterator[SceneObject]:
    """Yield an object for each copy that is drawn; its path is the instancer's with the copy's id in brackets."""
    instancer = UsdGeom.PointInstancer(node.prim)
    indices = instancer.GetProtoIndicesAttr().Get(time) or ()
    ids = instancer.GetIdsAttr().Get(time) or range(len(indices))
    drawn = _drawn(instancer, time)
    matrices = instancer.ComputeInstanceTransformsAtTime(
        time, time, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
    )
    if not len(indices) == len(matrices) == len(drawn):
        # OpenUSD has said what is wrong with the arrays; no copy can be placed.
        return
    to_world = UsdGeom.Xformable(node.prim).ComputeLocalToWorldTransform(time)
    prototypes = [node.prim.GetStage().GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetTargets()]
    extents = [boxes.read_local_corners(prim) if prim else np.empty((0, 3)) for prim in prototypes]
    for place, index in enumerate(indices):
        if drawn[place] and 0 <= index < len(prototypes):
            matrix = matrices[place] * to_world
            box = boxes.box_of_corners(extents[index], matrix)
            yield _copy(node, parent_path, prototypes[index], int(ids[place]), pose_of(matrix, frame), box)


def _copy(node: Node, parent_path: str | None, prototype: Any, number: int, pose: Any, box: Box | None) -> SceneObject:
    name = prototype.GetName() if prototype else node.name
    return SceneObject(
        prim_path=f"{node.path}[{number}]",
        name=f"{name}_{number}",
        type_name=str(prototype.GetTypeName()) if prototype else "",
        kind="",
        selected_by=COPY,
        parent_path=parent_path,
        box=box,
        own_box=box,
        part_boxes=(),
        position=pose[0],
        orientation=pose[1],
        mass_kg=None,
        display_name=prototype.GetDisplayName() if prototype else "",
        documentation=prototype.GetDocumentation().strip() if prototype else "",
        asset=asset_names(prototype) if prototype else (),
        materials=(),
        parts=(),
        display_color=None,
        instance_of=str(prototype.GetPath()) if prototype else None,
    )
