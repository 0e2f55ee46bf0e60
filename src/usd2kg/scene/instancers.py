"""Copies of point instancers: counted in one object, or one object per copy."""

from collections.abc import Callable, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from typing import Any, NamedTuple

import numpy as np
from pxr import Gf, Usd, UsdGeom, Vt

from usd2kg.scene.bounds import BoxReader, pose_of, to_metres
from usd2kg.scene.model import Box, Diagnostic, Instances, SceneObject, StageFrame, Vector
from usd2kg.scene.outline import PrimRecord
from usd2kg.scene.stage import read_targets, read_value

__all__ = ["COPY", "Prototype", "count_copies", "drawn_prototypes", "is_endless", "read_copies"]

COPY = "copy of a point instancer"
"""`SceneObject.selected_by` of a copy."""


class Prototype(NamedTuple):
    """What a prototype states, which holds for each of its copies."""

    name: str
    """The name of its prim."""
    fields: Mapping[str, Any]
    """Fields of `SceneObject`."""
    center_of_mass: Vector | None = None
    """In the prototype's own frame, stage units."""


_NOTHING: Mapping[str, Any] = {
    **dict.fromkeys(("type_name", "display_name", "documentation"), ""),
    **dict.fromkeys(("asset", "materials", "parts"), ()),
    **dict.fromkeys(("mass_kg", "display_color", "instance_of")),
}
"""Fields of the copies of a missing prototype."""


def count_copies(records: list[PrimRecord], time: Usd.TimeCode) -> Instances | None:
    """Return the number of visible copies and the prototypes of an object's point instancers; None if it has none."""
    instancers = [record.prim for record in records if record.is_instancer]
    if not instancers:
        return None
    names = [target.name for prim in instancers for target in _prototypes(prim)]
    return Instances(sum(sum(_drawn(prim, time)) for prim in instancers), tuple(dict.fromkeys(names)))


def drawn_prototypes(instancer: Any, time: Usd.TimeCode) -> list[Any]:
    """Return the prims of the prototypes that have a visible copy, in the order of the instancer."""
    shown = zip(_indices(instancer, time), _drawn(instancer, time), strict=True)
    used = {index for index, is_drawn in shown if is_drawn}
    paths = [path for index, path in enumerate(_prototypes(instancer)) if index in used]
    return [prim for path in paths if (prim := instancer.GetStage().GetPrimAtPath(path))]


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
    boxes: BoxReader,
    read_prototype: Callable[[Any], Prototype],
    notes: list[Diagnostic],
) -> list[SceneObject]:
    """Return an object for each visible copy; the path is the instancer's with the copy's id in brackets.

    If the authored ids are not unique or do not match the number of copies, copies are numbered by position and a
    diagnostic is added to `notes`.

    Args:
        record: the point instancer.
        parent_path: the nearest object above the copies.
        frame: units and up axis of the stage.
        boxes: reads the bounds of the prototypes, at its time.
        read_prototype: reads what the prim of a prototype states.
        notes: receives the diagnostics.
    """
    instancer, time = UsdGeom.PointInstancer(record.prim), boxes.time
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
    prims = [record.prim.GetStage().GetPrimAtPath(path) for path in _prototypes(record.prim)]
    corners = [boxes.read_local_corners(prim) if prim else np.empty((0, 3)) for prim in prims]
    prototypes = [read_prototype(prim) if prim else Prototype(record.name, _NOTHING) for prim in prims]
    copies = []
    for position, index in enumerate(indices):
        if drawn[position] and 0 <= index < len(prims):
            matrix = matrices[position] * to_world
            place = _Place(parent_path, matrix, boxes.box_of_corners(corners[index], matrix), frame)
            copies.append(_copy(f"{record.path}[{ids[position]}]", ids[position], prototypes[index], place))
    return copies


class _Place(NamedTuple):
    """Where a copy is."""

    parent_path: str | None
    matrix: Any
    """From the frame of the prototype to the stage."""
    box: Box | None
    frame: StageFrame


def _copy(path: str, number: int, prototype: Prototype, place: _Place) -> SceneObject:
    position, orientation = pose_of(place.matrix, place.frame)
    center = prototype.center_of_mass
    moved = None if center is None else np.array(place.matrix.Transform(Gf.Vec3d(center)))
    return SceneObject(
        prim_path=path,
        name=f"{prototype.name}_{number}",
        kind="",
        selected_by=COPY,
        parent_path=place.parent_path,
        box=place.box,
        own_box=place.box,
        part_boxes=(),
        position=position,
        orientation=orientation,
        center_of_mass=None if moved is None or not np.isfinite(moved).all() else to_metres(moved, place.frame),
        **prototype.fields,
    )


def _read_ids(record: PrimRecord, count: int, time: Usd.TimeCode, notes: list[Diagnostic]) -> Sequence[int]:
    ids = read_value(record.prim, UsdGeom.Tokens.ids, time, object)
    if ids is None or (isinstance(ids, Vt.Int64Array) and not ids):
        return range(count)
    if isinstance(ids, Vt.Int64Array) and len(ids) == len(set(ids)) == count:
        return list(ids)
    message = f"its ids are not {count} different numbers, one for each copy; the copies are numbered by position"
    notes.append(Diagnostic("instancer", message, record.path))
    return range(count)
