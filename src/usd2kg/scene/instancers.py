"""Copies of point instancers: counted in one object, or one object per copy."""

from collections.abc import Sequence
from graphlib import CycleError, TopologicalSorter
from typing import Any

import numpy as np
from pxr import Usd, UsdGeom, Vt

from usd2kg.scene.bounds import BoxReader, pose_of
from usd2kg.scene.evidence import asset_arcs, asset_names
from usd2kg.scene.model import Box, Diagnostic, Instances, SceneObject, StageFrame
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import read_targets, read_value

__all__ = ["COPY", "count_copies", "is_endless", "read_copies"]

COPY = "copy of a point instancer"
"""`SceneObject.selected_by` of a copy."""


def count_copies(records: list[PrimRecord], time: Usd.TimeCode) -> Instances | None:
    """Return the number of visible copies and the prototypes of an object's point instancers; None if it has none."""
    instancers = [record.prim for record in records if record.is_instancer]
    if not instancers:
        return None
    names = [target.name for prim in instancers for target in _prototypes(prim)]
    return Instances(sum(sum(_drawn(prim, time)) for prim in instancers), tuple(dict.fromkeys(names)))


def is_endless(prim: Any, known: dict[Any, list[Any]]) -> bool:
    """Return whether a point instancer at or below a prim contains itself through its prototypes.

    OpenUSD crashes with infinite recursion when asked for the bounds of such a prim.

    Args:
        prim: root of the subtree that is searched.
        known: cache, path → point instancers at and below that prim; shared prototypes are traversed once.
    """
    graph: dict[Any, list[Any]] = {}
    pending = list(_instancers_in(prim, known))
    while pending:
        instancer = pending.pop()
        if instancer.GetPath() not in graph:
            stage = instancer.GetStage()
            prototypes = [prototype for path in _prototypes(instancer) if (prototype := stage.GetPrimAtPath(path))]
            used = [below for prototype in prototypes for below in _instancers_in(prototype, known)]
            graph[instancer.GetPath()] = [below.GetPath() for below in used]
            pending += used
    try:
        TopologicalSorter(graph).prepare()
    except CycleError:
        return True
    return False


def _instancers_in(prim: Any, known: dict[Any, list[Any]]) -> list[Any]:
    path = prim.GetPath()
    if path not in known:
        prims = Usd.PrimRange(prim, Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate))
        known[path] = [below for below in prims if below.IsA(UsdGeom.PointInstancer)]
    return known[path]


def _prototypes(instancer: Any) -> list[Any]:
    return read_targets(instancer, UsdGeom.Tokens.prototypes)


def _indices(instancer: Any, time: Usd.TimeCode) -> Sequence[int]:
    """Return the index of the prototype of each copy."""
    return read_value(instancer, UsdGeom.Tokens.protoIndices, time, Vt.IntArray) or ()


def _drawn(instancer: Any, time: Usd.TimeCode) -> list[bool]:
    """Return for each copy whether it is active and visible."""
    count = len(_indices(instancer, time))
    mask = list(UsdGeom.PointInstancer(instancer).ComputeMaskAtTime(time))
    # An empty mask means that all copies are drawn. A mask of another length results from malformed ids.
    return mask if len(mask) == count else [True] * count


def read_copies(
    record: PrimRecord,
    parent_path: str | None,
    frame: StageFrame,
    time: Usd.TimeCode,
    boxes: BoxReader,
    notes: list[Diagnostic],
) -> list[SceneObject]:
    """Return an object for each visible copy; the path is the instancer's with the copy's id in brackets.

    If the authored ids are not unique or do not match the number of copies, copies are numbered by position and a
    diagnostic is added to `notes`.
    """
    instancer = UsdGeom.PointInstancer(record.prim)
    indices = _indices(record.prim, time)
    ids = _read_ids(record, len(indices), time, notes)
    drawn = _drawn(record.prim, time)
    matrices = instancer.ComputeInstanceTransformsAtTime(
        time, time, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
    )
    if not len(indices) == len(matrices) == len(drawn):
        # The arrays do not match; OpenUSD has reported it.
        return []
    to_world = UsdGeom.Xformable(record.prim).ComputeLocalToWorldTransform(time)
    prototypes = [record.prim.GetStage().GetPrimAtPath(path) for path in _prototypes(record.prim)]
    extents = [boxes.read_local_corners(prim) if prim else np.empty((0, 3)) for prim in prototypes]
    copies = []
    for position, index in enumerate(indices):
        if drawn[position] and 0 <= index < len(prototypes):
            matrix = matrices[position] * to_world
            box = boxes.box_of_corners(extents[index], matrix)
            copies.append(_copy(record, parent_path, prototypes[index], ids[position], pose_of(matrix, frame), box))
    return copies


def _read_ids(record: PrimRecord, count: int, time: Usd.TimeCode, notes: list[Diagnostic]) -> Sequence[int]:
    ids = read_value(record.prim, UsdGeom.Tokens.ids, time, object)
    if ids is None or (isinstance(ids, Vt.Int64Array) and not ids):
        return range(count)
    if isinstance(ids, Vt.Int64Array) and len(ids) == len(set(ids)) == count:
        return list(ids)
    message = f"its ids are not {count} different numbers, one for each copy; the copies are numbered by position"
    notes.append(Diagnostic("instancer", message, record.path))
    return range(count)


def _copy(
    record: PrimRecord, parent_path: str | None, prototype: Any, number: int, pose: Any, box: Box | None
) -> SceneObject:
    name = prototype.GetName() if prototype else record.name
    return SceneObject(
        prim_path=f"{record.path}[{number}]",
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
        asset=asset_names(prototype.GetAssetInfo(), asset_arcs(prototype)) if prototype else (),
        materials=(),
        parts=(),
        display_color=None,
        instance_of=str(prototype.GetPath()) if prototype else None,
    )
