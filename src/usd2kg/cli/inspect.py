"""usd2kg inspect: the objects of a stage."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from typer import Option

from usd2kg.cli.limits import NAMES_PER_CELL, SIMILAR_DIAGNOSTICS
from usd2kg.cli.object_text import (
    box_size_text,
    capacity_text,
    joint_rows,
    jointed_objects,
    litres_text,
    mass_text,
    numbers_text,
    object_rows,
    shape_rows,
    tight_size_text,
)
from usd2kg.cli.options.bundles import expand_bundles
from usd2kg.cli.options.common import JsonOutput, SceneFile
from usd2kg.cli.options.stage import StageOptions
from usd2kg.cli.output import count_noun, emit, print_json, replace_controls, to_single_line
from usd2kg.cli.text_table import format_table
from usd2kg.errors import SceneError

if TYPE_CHECKING:
    from usd2kg.scene import Diagnostic, Label, ReadOptions, Scene, SceneObject, ShapeDescriptors

__all__ = ["inspect_command"]

_VARIABLE_PART = re.compile(r"""'[^']*'|"[^"]*"|<[^>]*>|/\S+|\w+(?::\w+)+|[-+]?\d[\d.,e+-]*""")
"""Parts that differ between similar messages: quotations, paths, property names, numbers."""


@expand_bundles
def inspect_command(
    scene: SceneFile,
    reading: StageOptions,
    why: Annotated[
        str | None,
        Option(
            "--why",
            metavar="PATH",
            help="Explain why the prim at this path is an object or not, and show all of the object's properties; "
            "default: list all objects.",
        ),
    ] = None,
    shapes: Annotated[
        bool, Option("--shapes", help="Measure the geometry, too: tight box, volume, capacity, roundness.")
    ] = False,
    json: JsonOutput = False,
) -> None:
    """List the objects of a scene with their evidence, counts of excluded prims by reason, and diagnostics."""
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.scene import describe_shapes, read_scene  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    options = reading.read_options()
    if why is not None:
        _explain(scene, why, options, is_json=json)
        return
    with show_steps("read", is_wanted=not json):
        found = read_scene(scene, options=options)
    measured = None
    if shapes:
        notes: list[Diagnostic] = []
        measured = describe_shapes(scene, found, diagnostics=notes)
        found = replace(found, diagnostics=tuple(dict.fromkeys((*found.diagnostics, *notes))))
    if json:
        print_json(_scene_json(found, measured))
    else:
        emit(_scene_text(found, measured))


def _explain(source: Path, path: str, options: "ReadOptions", *, is_json: bool) -> None:
    """Print why a prim is an object or not and, for an object, all its properties."""
    from usd2kg.scene import describe_shapes, explain_choice, read_scene  # noqa: PLC0415

    try:
        scene = read_scene(source, options=options)
    except SceneError:
        # Even on a stage without objects, each prim has a reason.
        scene = None
    obj = scene.by_path.get(path) if scene else None
    # An instance of a point instancer, /Shelf/I[3], is not a prim: its instancer was selected.
    reason = explain_choice(source, path.partition("[")[0] if obj else path, options)
    if scene is None or obj is None:
        if is_json:
            print_json({"path": path, "why": reason, "object": None})
        else:
            emit(to_single_line(reason) + "\n")
        return
    missing = []
    try:
        shapes = describe_shapes(source, scene, [path])
    except SceneError as error:
        # Only the shape needs scipy, which is optional.
        shapes, missing = None, [("form", str(error))]
    joints = [joint for joint in scene.joints if path in jointed_objects(joint, scene)]
    if is_json:
        properties = {**_object_json(obj, shapes), "joints": [asdict(joint) for joint in joints]}
        print_json({"path": path, "why": reason, "object": properties})
        return
    rows = [*object_rows(obj), *joint_rows(joints, path, scene), *(shape_rows(shapes.get(path)) if shapes else missing)]
    rows += [("note", f"{note.code}: {note.message}") for note in scene.diagnostics if note.prim_path == path]
    emit(to_single_line(reason) + "\n\n" + format_table(rows[0], rows[1:]))


def _scene_json(scene: "Scene", shapes: "Mapping[str, ShapeDescriptors] | None") -> dict[str, Any]:
    families: dict[str, list[str]] = {}
    for obj in scene.objects:
        families.setdefault(obj.prim_path.rpartition("/")[0] or "/", []).append(obj.name)
    return {
        "source": scene.source,
        "content_hash": scene.content_hash,
        "frame": asdict(scene.frame),
        "time": scene.time,
        "prim_count": scene.prim_count,
        "objects": [_object_json(obj, shapes) for obj in scene.objects],
        "families": families,
        "left_out": dict(scene.left_out),
        "joints": [asdict(joint) for joint in scene.joints],
        "diagnostics": [asdict(diagnostic) for diagnostic in scene.diagnostics],
    }


def _object_json(obj: "SceneObject", shapes: "Mapping[str, ShapeDescriptors] | None") -> dict[str, Any]:
    """Return an object as JSON data, with a `shape` if shapes were measured."""
    data = asdict(obj)
    labels = data.pop("labels")._asdict()
    size = obj.box.size if obj.box else None
    known = {"path": data.pop("prim_path"), **data, "labels": labels, "words": obj.words, "size": size}
    if shapes is None:
        return known
    shape = shapes.get(obj.prim_path)
    return {**known, "shape": asdict(shape) if shape else None}


def _scene_text(scene: "Scene", shapes: "Mapping[str, ShapeDescriptors] | None") -> str:
    columns = ["path", "size w×d×h m", "mass kg", "position m", "asset", "materials", "parts", "chosen by"]
    rows = [_object_cells(obj) for obj in scene.objects]
    if shapes is not None:
        columns[2:2] = ["tight box m", "encloses litres", "holds litres", "roundness"]
        for obj, row in zip(scene.objects, rows, strict=True):
            row[2:2] = _shape_cells(shapes.get(obj.prim_path))
    frame = scene.frame
    unit = "authored" if frame.is_authored else "fallback, not authored"
    lines = [
        f"\n{count_noun(len(scene.objects), 'object')} among {count_noun(scene.prim_count, 'prim')}; "
        f"1 stage unit = {frame.metres_per_unit:g} m ({unit}), {frame.up_axis} up\n"
    ]
    if counts := list(_counts(scene)):
        lines.append(f"also read: {', '.join(counts)}; --why PATH shows those of one object\n")
    if scene.left_out:
        lines.append("left out: " + ", ".join(f"{count} {reason}" for reason, count in scene.left_out.items()) + "\n")
    lines = [replace_controls(line) for line in lines]
    if scene.diagnostics:
        lines += ["\n", format_table(("diagnostic", "where", "message"), list(_diagnostic_rows(scene.diagnostics)))]
    return format_table(columns, rows, dispensable=("materials", "parts")) + "".join(lines)


def _object_cells(obj: "SceneObject") -> list[str | None]:
    return [
        obj.prim_path,
        box_size_text(obj.box.size) if obj.box else "no geometry",
        mass_text(obj.mass_kg) if obj.mass_kg is not None else None,
        numbers_text(obj.position) if obj.position else None,
        ", ".join(obj.asset),
        _names_cell(obj.materials),
        _names_cell(obj.parts),
        obj.selected_by,
    ]


def _names_cell(names: Sequence[str]) -> str:
    more = [f"… ({len(names)} in all)"] if len(names) > NAMES_PER_CELL else []
    return ", ".join([*names[:NAMES_PER_CELL], *more])


def _shape_cells(shape: "ShapeDescriptors | None") -> list[str | None]:
    if shape is None:
        return [None] * 4
    volume = litres_text(shape.volume_m3) if shape.volume_m3 is not None else "open surface"
    roundness = f"{shape.roundness:.2f}" if shape.roundness is not None else None
    return [tight_size_text(shape), volume, capacity_text(shape), roundness]


def _counts(scene: "Scene") -> Iterator[str]:
    """Yield counts of labels, joints, variants and texts, which are not in the table."""
    # A label is read for its prim and, if inherited, for each object below it.
    labels = {_label_key(label): label for obj in scene.objects for group in obj.labels for label in group}
    if labels:
        encodings = Counter(label.encoding for label in labels.values())
        objects = count_noun(sum(any(obj.labels) for obj in scene.objects), "object")
        yield f"{count_noun(len(labels), 'label')} on {objects} ({_tally(encodings)})"
    if scene.joints:
        yield f"{count_noun(len(scene.joints), 'joint')} ({_tally(Counter(joint.type for joint in scene.joints))})"
    for noun, attribute in (("chosen variant", "variants"), ("text", "texts")):
        counts = [len(getattr(obj, attribute)) for obj in scene.objects]
        if any(counts):
            yield f"{count_noun(sum(counts), noun)} on {count_noun(sum(map(bool, counts)), 'object')}"


def _label_key(label: "Label") -> tuple[str, str, str, str]:
    return label.prim_path, label.encoding, label.taxonomy, label.value


def _tally(counts: Counter[Any]) -> str:
    return ", ".join(f"{count} {name}" for name, count in counts.most_common())


def _diagnostic_rows(notes: "Iterable[Diagnostic]") -> Iterator[tuple[str, str | None, str]]:
    """Yield code, location and message of diagnostics; groups of similar ones are truncated with a count."""
    similar: dict[tuple[str, str], list[Diagnostic]] = {}
    for note in notes:
        similar.setdefault((note.code, _VARIABLE_PART.sub("…", note.message)), []).append(note)
    for (code, _), group in similar.items():
        # Do not replace a single diagnostic by a line of the same length.
        shown = len(group) if len(group) == SIMILAR_DIAGNOSTICS + 1 else SIMILAR_DIAGNOSTICS
        yield from ((note.code, note.prim_path or note.layer, note.message) for note in group[:shown])
        if len(group) > shown:
            yield code, None, f"… and {len(group) - shown} more like it; --json has them all"
