"""read_scene: USD stage → Scene."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from pxr import Usd

from usd2kg.errors import SceneError
from usd2kg.garbage import paused_collection, release_freed_memory
from usd2kg.scene.bounds import BoxReader, union
from usd2kg.scene.evidence import NO_EVIDENCE, own_records, part_names, stated_fields
from usd2kg.scene.instancers import drawn_prototypes, read_copies
from usd2kg.scene.joints import read_joints
from usd2kg.scene.label_lint import lint_labels
from usd2kg.scene.label_reader import LabelReader, class_reader
from usd2kg.scene.levels import LevelReader, holds_others
from usd2kg.scene.masses import MassReader
from usd2kg.scene.metadata import MaterialReader, clean_text
from usd2kg.scene.model import Box, Diagnostic, Scene, SceneObject
from usd2kg.scene.object_selection import ASKED_FOR, Selection, explain, select_objects
from usd2kg.scene.options import ReadOptions
from usd2kg.scene.outline import Outline, PrimRecord
from usd2kg.scene.prototypes import PrototypeReader
from usd2kg.scene.sanity_checks import check_sanity
from usd2kg.scene.settings import LIMITS
from usd2kg.scene.stage import (
    UNREADABLE,
    OpenedStage,
    captured_diagnostics,
    error_text,
    open_stage,
    time_code,
    translated_errors,
)
from usd2kg.scene.stale_extents import StaleExtents
from usd2kg.scene.surfaces import SurfaceReader, are_near_others, hold_middles, read_shell
from usd2kg.scene.traversal import ENDLESS, UNREADABLE_PRIM, outline_stage, paths_above_endless
from usd2kg.shapes.surface import Surface
from usd2kg.tracing import traced

__all__ = ["ASKED_FOR", "explain_choice", "read_scene"]

_Text = TypeVar("_Text")

_MAX_REASONS = 4
"""Number of reasons listed in the error message for a stage without objects."""
_BATCH = 1000
"""Objects whose materials are computed together; affects speed only."""
_MANY_PRIMS = 100_000
"""Prims from which the memory of a closed stage is worth returning."""


@traced("read", lambda scene: {"objects": len(scene.objects), "prims": scene.prim_count})
def read_scene(
    source: Path | str | Usd.Stage, *, paths: Iterable[str] | None = None, options: ReadOptions | None = None
) -> Scene:
    """Return the objects of a USD stage with everything the stage states about them.

    Args:
        source: the root layer (.usd, .usda, .usdc, .usdz), a file of a format that `usd2kg.convert` knows, or an open
            stage, which is read with its session layer and current variants.
        paths: prim paths that are objects in addition to those that the rules select. Paths that are not on the stage
            are listed in `Scene.missing_paths`.
        options: overrides of what is authored.

    Raises:
        SceneError: the file cannot be read, or the stage has no objects.
    """
    scene = _read_stage(source, paths, options or ReadOptions())
    if scene.prim_count >= _MANY_PRIMS:
        release_freed_memory()
    return scene


def _read_stage(source: Path | str | Usd.Stage, paths: Iterable[str] | None, options: ReadOptions) -> Scene:
    opened = open_stage(source, options)
    time = time_code(options.time)
    with (
        translated_errors(opened.source),
        captured_diagnostics() as openusd_notes,
        paused_collection(),
        # Results are checked for non-finite values.
        np.errstate(invalid="ignore", over="ignore"),
        outline_stage(opened, time) as outline,
    ):
        extents = StaleExtents(time)
        boxes = BoxReader(opened.frame, time, paths_above_endless(outline), extents)
        wanted = tuple(dict.fromkeys(paths or ()))
        selection = select_objects(outline, options.selection, boxes.read_below, class_reader(time), wanted)
        reader = _ObjectReader(opened, outline, selection.chosen, boxes, extents)
        found = _find_objects(outline, selection.chosen, options.expand_instancers)
        objects = _read_objects(reader, found)
        joints = read_joints(outline.joint_prims, opened.frame, time)
        label_notes = lint_labels(outline.labelled_prims, time)
        time_read = _time_read(opened, options)
    if not objects:
        raise SceneError(_no_object_message(opened.source, outline, selection, opened))
    scene = Scene(
        source=opened.source,
        content_hash=opened.content_hash,
        frame=opened.frame,
        time=time_read,
        prim_count=outline.prim_count,
        objects=tuple(objects),
        left_out=dict(sorted(selection.left_out.items())),
        missing_paths=selection.missing,
        joints=joints.joints,
        origin=opened.origin,
        files=opened.contents.files,
        surfaces=reader.surfaces,
    )
    notes = (
        *_left_out_notes(outline),
        *extents.notes,
        *reader.notes,
        *reader.masses.notes,
        *joints.diagnostics,
        *label_notes,
        *check_sanity(scene),
    )
    return replace(scene, diagnostics=tuple(map(_on_one_line, (*opened.diagnostics, *openusd_notes, *notes))))


def _left_out_notes(outline: Outline) -> Iterator[Diagnostic]:
    consequence = {
        UNREADABLE_PRIM: "OpenUSD cannot read it; it is left out with all prims below it",
        ENDLESS: "a point instancer contains itself through its prototypes; it is left out",
    }
    for path, reason in outline.faults.items():
        yield Diagnostic("geometry", consequence[reason], path)


def _on_one_line(note: Diagnostic) -> Diagnostic:
    """Return a note with its message cut to one printable line, whatever names and values it quotes."""
    message, limit = note.message, LIMITS.max_message_length
    if message.isprintable() and len(message) <= limit:
        return note
    cleaned = clean_text(message)
    return replace(note, message=cleaned if len(cleaned) <= limit else cleaned[: limit - 1] + "…")


def explain_choice(source: Path | str | Usd.Stage, path: str, options: ReadOptions | None = None) -> str:
    """Return a sentence on why a prim is or is not an object.

    Raises:
        SceneError: the stage cannot be read, or has no such prim.
    """
    options = options or ReadOptions()
    opened = open_stage(source, options)
    time = time_code(options.time)
    with translated_errors(opened.source), captured_diagnostics(), outline_stage(opened, time) as outline:
        boxes = BoxReader(opened.frame, time, paths_above_endless(outline))
        selection = select_objects(outline, options.selection, boxes.read_below, class_reader(time))
        if not opened.stage.GetPrimAtPath(path):
            raise SceneError(
                f"{opened.source}: there is no prim {path}; expected an absolute path, `usd2kg inspect` lists them"
            )
        return explain(path, outline, selection)


def _time_read(opened: OpenedStage, options: ReadOptions) -> float | None:
    if options.time is not None:
        return options.time
    start = float(opened.stage.GetStartTimeCode()) if opened.stage.HasAuthoredTimeCodeRange() else math.nan
    return start if math.isfinite(start) else None


def _no_object_message(source: str, outline: Outline, selection: Selection, opened: OpenedStage) -> str:
    counts = ", ".join(f"{count} {reason}" for reason, count in selection.left_out.most_common(_MAX_REASONS))
    found = f"{outline.prim_count} prims ({counts})" if counts else f"{outline.prim_count} prims"
    problem = f"; {opened.diagnostics[0].message}" if opened.diagnostics else ""
    return f"{source}: no object among {found}, expected prims with geometry; check the referenced files{problem}"


def _read_objects(reader: "_ObjectReader", found: list["_SelectedPrim"]) -> list[SceneObject]:
    measured = [entry for entry in found if entry.is_read]
    boxes = reader.measure(measured)
    reader.read_surfaces(measured, boxes)
    known = 0
    while len(reader.extents.notes) > known:
        known = len(reader.extents.notes)
        boxes = reader.measure_again(measured)
    levels = reader.read_levels(measured, boxes)
    objects: list[SceneObject] = []
    for index, entry in enumerate(found):
        if index % _BATCH == 0:
            reader.prefetch(found[index : index + _BATCH])
        if entry.is_read:
            path = entry.records[0].path
            objects.append(reader.read(entry, boxes[path], levels.get(path, ())))
        inside = entry.records[0].path if entry.is_read else entry.parent_path
        for instancer in entry.expanded:
            objects.extend(reader.read_copies(instancer, inside))
    return objects


class _SelectedPrim(NamedTuple):
    """A selected prim that is still to be read."""

    records: list[PrimRecord]
    """The prim and the prims below it without nested objects."""
    parent_path: str | None
    """Path of the nearest object above."""
    expanded: list[PrimRecord]
    """The point instancers whose copies are objects."""
    is_read: bool
    """Whether the prim is an object in addition to its copies."""


def _why(error: Exception) -> str:
    return error_text(error) or "OpenUSD gives no reason"


class _ObjectBoxes(NamedTuple):
    below: Box | None
    """With nested objects."""
    own: Box | None
    """Without nested objects."""
    parts: tuple[Box, ...]


def _largest(parts: list[Box]) -> tuple[Box, ...]:
    """Return the largest boxes, up to a limit, in the given order."""
    limit = LIMITS.max_part_boxes
    if len(parts) <= limit:
        return tuple(parts)
    largest = sorted(range(len(parts)), key=lambda i: -parts[i].volume)[:limit]
    return tuple(parts[i] for i in sorted(largest))


def _find_objects(outline: Outline, chosen: dict[str, str], expand_instancers: bool) -> list[_SelectedPrim]:
    found = []
    # (record, path of the nearest object above)
    pending: list[tuple[PrimRecord, str | None]] = [(outline.root, None)]
    while pending:
        record, parent_path = pending.pop()
        if record.path in chosen:
            records = list(own_records(record, chosen))
            expanded = [own for own in records if own.is_instancer and not own.is_hidden] if expand_instancers else []
            is_read = not expanded or record.gprim_count > len(expanded)
            found.append(_SelectedPrim(records, parent_path, expanded, is_read))
            parent_path = record.path if is_read else parent_path
        if record.children:
            pending.extend((child, parent_path) for child in reversed(record.children))
    return found


class _ObjectReader:
    """Reads objects one by one with shared caches."""

    def __init__(
        self,
        opened: OpenedStage,
        outline: Outline,
        chosen: dict[str, str],
        boxes: BoxReader,
        extents: StaleExtents,
    ) -> None:
        self.extents = extents
        self.frame = opened.frame
        self.chosen = chosen
        self.time = time = boxes.time
        self.boxes = boxes
        self.labels = LabelReader(time)
        self.has_labels = bool(outline.labelled_prims)
        self.materials = MaterialReader(time, has_purpose_bindings=outline.has_purpose_bindings)
        self.notes: list[Diagnostic] = []
        self.masses = MassReader(self.frame)
        self.prototypes = PrototypeReader(self.masses, boxes, self.labels, self.notes)
        self.surfaces: dict[str, Surface] = {}
        self.shells: dict[str, tuple[Box, ...]] = {}
        self._tuples: dict[tuple[Any, ...], tuple[Any, ...]] = {}
        """Equal texts of several objects, kept once."""

    def measure(self, found: list[_SelectedPrim]) -> dict[str, _ObjectBoxes]:
        """Return the boxes of the objects by path."""
        boxes: dict[str, _ObjectBoxes] = {}
        inside: dict[str, list[Box]] = {}
        # In reverse order, nested objects come first and each box is computed once.
        for entry in reversed(found):
            path = entry.records[0].path
            measured = self._measure(entry.records, inside.pop(path, []))
            boxes[path] = measured
            if measured.below is not None and entry.parent_path is not None:
                inside.setdefault(entry.parent_path, []).append(measured.below)
        self.notes.reverse()
        return boxes

    def _measure(self, records: list[PrimRecord], nested: list[Box]) -> _ObjectBoxes:
        try:
            parts = self.boxes.read_parts(records)
            own = union(parts)
            below = union([*nested, own]) if nested and own else own or union(nested)
            below = below or self.boxes.read_hint(records[0])
        except UNREADABLE as error:
            self._note("geometry", records[0], f"its box cannot be computed ({_why(error)}); it has none in the graph")
            return _ObjectBoxes(None, None, ())
        if below is None:
            self._note("empty-box", records[0], "it has no measurable geometry; it has no size in the graph")
        return _ObjectBoxes(below, own if nested else below, _largest(parts) if len(parts) > 1 else ())

    def read_surfaces(self, found: list[_SelectedPrim], boxes: dict[str, _ObjectBoxes]) -> None:
        """Read the surfaces of the objects that others are near, and the shells of large ones around others."""
        surfaces = SurfaceReader(self.boxes, self.frame, self.extents)
        own = [boxes[entry.records[0].path].own for entry in found]
        for entry, is_near, is_holder in zip(found, are_near_others(own), hold_middles(own), strict=True):
            if is_near:
                try:
                    surface = surfaces.read(entry.records)
                except UNREADABLE as error:
                    message = f"its surface cannot be read ({_why(error)}); its relations follow from its box"
                    self._note("geometry", entry.records[0], message)
                    continue
                if surface is not None:
                    self.surfaces[entry.records[0].path] = surface
                    if is_holder:
                        self.shells[entry.records[0].path] = read_shell(surface)
            else:
                self.extents.compare_isolated(entry.records)

    def measure_again(self, found: list[_SelectedPrim]) -> dict[str, _ObjectBoxes]:
        """Return the boxes and read the surfaces of the objects, now that stale extents are known."""
        self.boxes.forget()
        for results in (self.notes, self.surfaces, self.shells):
            results.clear()
        boxes = self.measure(found)
        self.read_surfaces(found, boxes)
        return boxes

    def read_levels(self, found: list[_SelectedPrim], boxes: dict[str, _ObjectBoxes]) -> dict[str, tuple[Box, ...]]:
        """Return path → support levels, for the objects that may have others on an inner level."""
        reader = LevelReader(self.boxes, self.frame)
        levels: dict[str, tuple[Box, ...]] = {}
        own = [boxes[entry.records[0].path].own for entry in found]
        for entry, box, is_holder in zip(found, own, holds_others(own), strict=True):
            if is_holder and box is not None:
                try:
                    levels[entry.records[0].path] = reader.read(entry.records, box)
                except UNREADABLE as error:
                    self._note(
                        "geometry", entry.records[0], f"its faces cannot be read ({_why(error)}); it has no levels"
                    )
        return levels

    def prefetch(self, found: list[_SelectedPrim]) -> None:
        """Compute the materials of the objects that are read next."""
        self.materials.prefetch(entry.records for entry in found if entry.is_read)

    def read(self, entry: _SelectedPrim, boxes: _ObjectBoxes, levels: tuple[Box, ...]) -> SceneObject:
        """Return the object with everything the stage states about it."""
        record = entry.records[0]
        position, orientation = self._pose(record)
        try:
            evidence = self._evidence(entry.records, boxes)
        except UNREADABLE as error:
            self._note("unreadable", record, f"its evidence cannot be read ({_why(error)}); only its name and box are")
            evidence = NO_EVIDENCE
        return SceneObject(
            prim_path=record.path,
            name=record.name,
            type_name=record.type_name,
            kind=record.kind,
            selected_by=self.chosen[record.path],
            parent_path=entry.parent_path,
            box=boxes.below,
            own_box=boxes.own,
            part_boxes=boxes.parts,
            position=position,
            orientation=orientation,
            display_name=str(record.metadata.get("displayName", "")),
            documentation=str(record.metadata.get("documentation", "")).strip(),
            parts=self._once(part_names(entry.records)),
            instance_of=record.first_instance,
            support_levels=levels,
            shell_boxes=self.shells.get(record.path, ()),
            **evidence,
        )

    def _evidence(self, records: list[PrimRecord], boxes: _ObjectBoxes) -> dict[str, Any]:
        """Return the fields of an object that are read from OpenUSD."""
        mass = self.masses.read(records, self.boxes.read_point)
        stated = stated_fields(records, self.materials, self.labels if self.has_labels else None, self.time)
        if records[0].is_instancer and not stated["labels"].own:
            shared = self.labels.read_shared(drawn_prototypes(records[0].prim, self.time))
            stated["labels"] = stated["labels"]._replace(own=shared)
        return {
            "oriented_size": self.boxes.read_oriented_size(records[0]) if boxes.below else None,
            "mass_kg": mass.kg,
            "center_of_mass": mass.center,
            **stated,
            **{name: self._once(stated[name]) for name in ("asset", "materials", "texts")},
        }

    def _once(self, texts: tuple[_Text, ...]) -> tuple[_Text, ...]:
        return self._tuples.setdefault(texts, texts)

    def read_copies(self, instancer: PrimRecord, parent_path: str | None) -> list[SceneObject]:
        """Return the copies of a point instancer; none if OpenUSD cannot read it."""
        read_prototype = partial(self.prototypes.read, instancer=instancer)
        try:
            return read_copies(instancer, parent_path, self.frame, self.boxes, read_prototype, self.notes)
        except UNREADABLE as error:
            self._note("geometry", instancer, f"its copies cannot be read ({_why(error)}); they are left out")
            return []

    def _pose(self, record: PrimRecord) -> tuple[Any, Any]:
        try:
            position, orientation = self.boxes.read_pose(record)
        except UNREADABLE:
            position, orientation = None, None
        missing = [name for name, value in (("position", position), ("rotation", orientation)) if value is None]
        if missing:
            what = " or ".join(missing)
            left_out = "it is" if len(missing) == 1 else "both are"
            self._note("transform", record, f"its transform has no finite {what}; {left_out} left out")
        return position, orientation

    def _note(self, code: str, record: PrimRecord, message: str) -> None:
        self.notes.append(Diagnostic(code, message, record.path))
