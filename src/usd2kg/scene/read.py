"""read_scene: from a USD file to a Scene."""

import logging
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import Any

from pxr import Tf, Usd, UsdGeom

from usd2kg.errors import SceneError
from usd2kg.scene import evidence
from usd2kg.scene.bounds import BoxReader, is_measurable, read_pose, union
from usd2kg.scene.instancers import count_copies, read_copies
from usd2kg.scene.joints import read_joints
from usd2kg.scene.labels import LabelReader, lint_labels
from usd2kg.scene.metadata import MaterialReader, text_attributes, variant_selections
from usd2kg.scene.model import Box, Diagnostic, Scene, SceneObject, StageFrame
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.outline import Node, Outline, outline_stage
from usd2kg.scene.plausibility import check_plausibility
from usd2kg.scene.selection import ASKED_FOR, Selection, explain, select_objects
from usd2kg.scene.stage import OpenedStage, captured_diagnostics, open_stage

__all__ = ["ASKED_FOR", "explain_choice", "read_scene"]

logger = logging.getLogger(__name__)

_MOST_PARTS = 64


def read_scene(
    source: Path | str | Usd.Stage, *, paths: Iterable[str] | None = None, options: ReadOptions | None = None
) -> Scene:
    """Return the objects of a USD stage with everything the stage says about them.

    Args:
        source: the stage's root layer (.usd, .usda, .usdc, .usdz), or a stage that is open already, with its session
            layer and variants as they stand.
        paths: prim paths that are objects whatever the rules say, beside those the rules choose.
            Paths that do not exist are listed in `Scene.missing_paths`.
        options: what is to be read differently from what the stage says.

    Raises:
        SceneError: the file cannot be read, or no object is on the stage.
    """
    options = options or ReadOptions()
    opened = open_stage(source, options)
    # Where an attribute has no samples, its default value is what stands at the earliest time.
    time = Usd.TimeCode.EarliestTime() if options.time is None else Usd.TimeCode(options.time)
    with captured_diagnostics() as openusd_notes:
        outline = outline_stage(opened, time)
        selection = select_objects(outline, tuple(dict.fromkeys(paths or ())), options.selection)
        objects, notes = _read_objects(opened, outline, selection, time, options.expand_instancers)
        joints = read_joints(opened.stage, opened.frame, time)
        label_notes = lint_labels(opened.stage, time)
    if not objects:
        raise SceneError(_no_object_message(opened.source, outline, selection, opened))
    logger.info("%s: %d objects among %d prims", opened.source, len(objects), outline.prim_count)
    scene = Scene(
        source=opened.source,
        content_hash=opened.content_hash,
        frame=opened.frame,
        time=_time_read(opened, options),
        prim_count=outline.prim_count,
        objects=tuple(objects),
        left_out=dict(sorted(selection.left_out.items())),
        missing_paths=selection.missing,
        joints=joints.joints,
    )
    found = (*notes, *joints.diagnostics, *label_notes, *check_plausibility(scene))
    return replace(scene, diagnostics=(*opened.diagnostics, *openusd_notes, *found))


def explain_choice(source: Path | str | Usd.Stage, path: str, options: ReadOptions | None = None) -> str:
    """Return why a prim is an object or is none, in words.

    Raises:
        SceneError: the stage cannot be read, or has no such prim.
    """
    options = options or ReadOptions()
    opened = open_stage(source, options)
    with captured_diagnostics():
        outline = outline_stage(opened, Usd.TimeCode.EarliestTime())
        selection = select_objects(outline, (), options.selection)
    if not opened.stage.GetPrimAtPath(path):
        raise SceneError(f"{opened.source}: there is no prim {path}; expected an absolute path, see usd2kg inspect")
    return explain(path, outline, selection)


def _time_read(opened: OpenedStage, options: ReadOptions) -> float | None:
    if options.time is not None:
        return options.time
    return float(opened.stage.GetStartTimeCode()) if opened.stage.HasAuthoredTimeCodeRange() else None


def _no_object_message(source: str, outline: Outline, selection: Selection, opened: OpenedStage) -> str:
    counts = ", ".join(f"{count} {reason}" for reason, count in selection.left_out.most_common(4))
    found = f"{outline.prim_count} prims ({counts})" if counts else f"{outline.prim_count} prims"
    trouble = f"; {opened.diagnostics[0].message}" if opened.diagnostics else ""
    return f"{source}: no object among {found}, expected prims with geometry; check what the file refers to{trouble}"


def _read_objects(
    opened: OpenedStage, outline: Outline, selection: Selection, time: Usd.TimeCode, expand_instancers: bool
) -> tuple[list[SceneObject], list[Diagnostic]]:
    reader = _ObjectReader(opened.frame, selection.chosen, time)
    objects: list[SceneObject] = []
    # (node, path of the nearest object above)
    pending: list[tuple[Node, str | None]] = [(outline.root, None)]
    while pending:
        node, parent_path = pending.pop()
        if node.path in selection.chosen:
            instancers = reader.own_instancers(node) if expand_instancers else []
            if not instancers or node.gprim_count > len(instancers):
                objects.append(reader.read(node, parent_path))
                parent_path = node.path
            for instancer in instancers:
                objects.extend(read_copies(instancer, parent_path, opened.frame, time, reader.boxes))
        pending.extend((child, parent_path) for child in reversed(node.children))
    return objects, reader.notes


class _ObjectReader:
    """Reads one object at a time, sharing OpenUSD's caches."""

    def __init__(self, frame: StageFrame, chosen: dict[str, str], time: Usd.TimeCode) -> None:
        self.frame = frame
        self.chosen = chosen
        self.time = time
        self.boxes = BoxReader(frame, time)
        self.xforms = UsdGeom.XformCache(time)
        self.labels = LabelReader(time)
        self.materials = MaterialReader(time)
        self.notes: list[Diagnostic] = []

    def read(self, node: Node, parent_path: str | None) -> SceneObject:
        nodes = list(evidence.own_nodes(node, self.chosen))
        prim = node.prim
        box, own_box, part_boxes = self._boxes(node, nodes)
        position, orientation = self._pose(node)
        materials = self.materials.read(nodes)
        return SceneObject(
            prim_path=node.path,
            name=node.name,
            type_name=node.type_name,
            kind=node.kind,
            selected_by=self.chosen[node.path],
            parent_path=parent_path,
            box=box,
            own_box=own_box,
            part_boxes=part_boxes,
            oriented_size=self.boxes.read_oriented_size(prim) if box else None,
            position=position,
            orientation=orientation,
            mass_kg=evidence.mass_kg(nodes, self.frame),
            display_name=prim.GetDisplayName(),
            documentation=prim.GetDocumentation().strip(),
            asset=evidence.asset_names(prim),
            materials=tuple(dict.fromkeys(material.name for material in materials)),
            parts=evidence.part_names(nodes),
            display_color=evidence.display_color(nodes, self.time),
            instance_of=str(prim.GetPrototype().GetPath()) if prim.IsInstance() else None,
            instances=count_copies(nodes, self.time),
            labels=self.labels.read(nodes),
            variants=variant_selections(prim),
            texts=text_attributes(prim, self.time),
            material_details=materials,
        )

    def own_instancers(self, node: Node) -> list[Node]:
        """Return the visible point instancers of an object, those of objects nested below it left out."""
        return [own for own in evidence.own_nodes(node, self.chosen) if own.is_instancer and not own.is_hidden]

    def _boxes(self, node: Node, nodes: list[Node]) -> tuple[Box | None, Box | None, tuple[Box, ...]]:
        """Return the box of all below the prim, the box of its own geometry, and the boxes of its own parts."""
        try:
            box = self.boxes.read_below(node)
            gprims = [own for own in nodes if is_measurable(own)]
            parts = [part for own in gprims if (part := self.boxes.read_own(own))]
            own_box = box if len(gprims) == node.gprim_count else union(parts)
        except Tf.ErrorException as error:
            self._note("geometry", node, f"its box could not be computed ({error}); it has none in the graph")
            return None, None, ()
        if box is None:
            self._note("empty-box", node, "no geometry that can be measured; it has no size in the graph")
        largest = sorted(range(len(parts)), key=lambda i: -parts[i].volume)[:_MOST_PARTS]
        return box, own_box, tuple(parts[i] for i in sorted(largest)) if len(parts) > 1 else ()

    def _pose(self, node: Node) -> tuple[Any, Any]:
        try:
            position, orientation = read_pose(self.xforms, node.prim, self.frame)
        except Tf.ErrorException:
            position, orientation = None, None
        if position is None or orientation is None:
            self._note("transform", node, "its transform has no finite position or rotation; pose left out")
        return position, orientation

    def _note(self, code: str, node: Node, message: str) -> None:
        self.notes.append(Diagnostic(code, message, node.path))
