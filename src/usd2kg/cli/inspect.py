"""usd2kg inspect: what is on a stage."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from usd2kg.cli.groups import with_groups
from usd2kg.cli.object_rows import (
    HOLLOW,
    joint_rows,
    litres_text,
    numbers_text,
    objects_of,
    rows_of,
    shape_rows,
    size_text,
    tight_text,
)
from usd2kg.cli.options import JsonOutput, ReadingOptions, SceneFile, Shapes
from usd2kg.cli.output import emit, format_table, print_json, printable
from usd2kg.errors import SceneError

if TYPE_CHECKING:
    from usd2kg.scene import Diagnostic, Label, ReadOptions, Scene, SceneObject, ShapeDescriptors

__all__ = ["inspect_command"]

_SHOWN = 3
"""Diagnostics that are shown of those that say the same."""
_NAMES = 6
"""Names of materials and parts that fit into a line of the table."""
_VARYING = re.compile(r"""'[^']*'|"[^"]*"|<[^>]*>|/\S+|\w+(?::\w+)+|[-+]?\d[\d.,e+-]*""")
"""What differs between messages that say the same: quotations, paths, names of properties, numbers."""


@with_groups
def inspect_command(
    scene: SceneFile,
    reading: ReadingOptions,
    why: Annotated[
        str | None,
        typer.Option(
            "--why", help="Say why the prim at this path is an object or none, and all that is known of the object."
        ),
    ] = None,
    shapes: Shapes = False,
    json: JsonOutput = False,
) -> None:
    """List the objects of a scene with their evidence, what was left out and why, and diagnostics."""
    from usd2kg.scene import describe_shapes, read_scene  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    options = reading.read_options()
    if why is not None:
        _explain(scene, why, options, json)
        return
    found = read_scene(scene, options=options)
    forms = None
    if shapes:
        notes: list[Diagnostic] = []
        forms = describe_shapes(scene, found, diagnostics=notes)
        found = replace(found, diagnostics=tuple(dict.fromkeys((*found.diagnostics, *notes))))
    if json:
        print_json(_as_json(found, forms))
    else:
        emit(printable(_as_text(found, forms)), None)


def _explain(source: Path, path: str, options: "ReadOptions", is_json: bool) -> None:
    """Print why a prim is an object or none and, if it is one, all that is known of it."""
    from usd2kg.scene import describe_shapes, explain_choice, read_scene  # noqa: PLC0415

    try:
        scene = read_scene(source, options=options)
    except SceneError:
        # No object on the whole stage, or no stage: the reason is all there is to say.
        scene = None
    obj = scene.by_path.get(path) if scene else None
    # A copy of a point instancer, /Shelf/I[3], is no prim: it is an object because its instancer is.
    reason = explain_choice(source, path.partition("[")[0] if obj else path, options)
    if scene is None or obj is None:
        print_json({"path": path, "why": reason, "object": None}) if is_json else emit(_line(reason) + "\n", None)
        return
    forms = describe_shapes(source, scene, [path])
    joints = [joint for joint in scene.joints if path in objects_of(joint, scene)]
    if is_json:
        known = {**_object_as_json(obj, forms), "joints": [asdict(joint) for joint in joints]}
        print_json({"path": path, "why": reason, "object": known})
        return
    notes = [note for note in scene.diagnostics if note.prim_path == path]
    rows = [*rows_of(obj), *joint_rows(joints, path, scene), *shape_rows(forms.get(path))]
    rows += [("note", f"{note.code}: {note.message}") for note in notes]
    emit(_line(reason) + "\n\n" + format_table(rows[0], rows[1:]), None)


def _line(text: str) -> str:
    return " ".join(printable(text).split())


def _as_json(scene: "Scene", forms: "Mapping[str, ShapeDescriptors] | None") -> dict[str, Any]:
    families: dict[str, list[str]] = {}
    for obj in scene.objects:
        families.setdefault(obj.prim_path.rpartition("/")[0] or "/", []).append(obj.name)
    return {
        "source": scene.source,
        "content_hash": scene.content_hash,
        "frame": asdict(scene.frame),
        "time": scene.time,
        "prim_count": scene.prim_count,
        "objects": [_object_as_json(obj, forms) for obj in scene.objects],
        "families": families,
        "left_out": dict(scene.left_out),
        "joints": [asdict(joint) for joint in scene.joints],
        "diagnostics": [asdict(diagnostic) for diagnostic in scene.diagnostics],
    }


def _object_as_json(obj: "SceneObject", forms: "Mapping[str, ShapeDescriptors] | None") -> dict[str, Any]:
    data = asdict(obj)
    labels = data.pop("labels")._asdict()
    size = obj.box.size if obj.box else None
    known = {"path": data.pop("prim_path"), **data, "labels": labels, "words": obj.words, "size": size}
    if forms is None:
        return known
    form = forms.get(obj.prim_path)
    return {**known, "shape": asdict(form) if form else None}


def _as_text(scene: "Scene", forms: "Mapping[str, ShapeDescriptors] | None") -> str:
    columns = ["path", "size w×d×h m", "mass kg", "position m", "asset", "materials", "parts", "chosen by"]
    rows = [_cells_of(obj) for obj in scene.objects]
    if forms is not None:
        columns[2:2] = ["tight box m", "encloses litres", "holds litres", "roundness"]
        for obj, row in zip(scene.objects, rows, strict=True):
            row[2:2] = _form_cells(forms.get(obj.prim_path))
    frame = scene.frame
    unit = "authored" if frame.is_authored else "fallback, not authored"
    lines = [
        f"\n{len(scene.objects)} objects among {scene.prim_count} prims; "
        f"1 stage unit = {frame.metres_per_unit:g} m ({unit}), {frame.up_axis} up\n"
    ]
    beside = list(_counts(scene))
    if beside:
        lines.append(f"also read: {', '.join(beside)}; --why PATH shows those of one object\n")
    if scene.left_out:
        lines.append("left out: " + ", ".join(f"{count} {why}" for why, count in scene.left_out.items()) + "\n")
    if scene.diagnostics:
        lines += ["\n", format_table(("diagnostic", "where", "message"), list(_grouped(scene.diagnostics)))]
    return format_table(columns, rows) + "".join(lines)


def _cells_of(obj: "SceneObject") -> list[str | None]:
    return [
        obj.prim_path,
        size_text(obj.box.size) if obj.box else "no geometry",
        f"{obj.mass_kg:.3g}" if obj.mass_kg is not None else None,
        numbers_text(obj.position) if obj.position else None,
        ", ".join(obj.asset),
        _first(obj.materials),
        _first(obj.parts),
        obj.selected_by,
    ]


def _first(names: Sequence[str]) -> str:
    more = [f"… ({len(names)} in all)"] if len(names) > _NAMES else []
    return ", ".join([*names[:_NAMES], *more])


def _form_cells(form: "ShapeDescriptors | None") -> list[str | None]:
    if form is None:
        return [None] * 4
    volume = litres_text(form.volume_m3) if form.volume_m3 is not None else "open surface"
    holds = litres_text(form.capacity_m3) if form.openness >= HOLLOW else None
    roundness = f"{form.roundness:.2f}" if form.roundness is not None else None
    return [tight_text(form), volume, holds, roundness]


def _counts(scene: "Scene") -> Iterator[str]:
    """Yield what there is on the objects of a scene beside what the table shows, counted."""
    labels = {_key(label): label for obj in scene.objects for group in obj.labels for label in group}
    if labels:
        encodings = Counter(label.encoding for label in labels.values())
        holders = _holders(any(obj.labels) for obj in scene.objects)
        yield f"{_many(len(labels), 'label')} {holders} ({_tally(encodings)})"
    if scene.joints:
        yield f"{_many(len(scene.joints), 'joint')} ({_tally(Counter(joint.type for joint in scene.joints))})"
    for word, found in (("chosen variant", "variants"), ("text", "texts")):
        counts = [len(getattr(obj, found)) for obj in scene.objects]
        if any(counts):
            yield f"{_many(sum(counts), word)} {_holders(map(bool, counts))}"


def _key(label: "Label") -> tuple[str, str, str, str]:
    """Return what two labels share that are one on the stage, read for an object and for those below it."""
    return label.prim_path, label.encoding, label.taxonomy, label.value


def _many(count: int, word: str) -> str:
    return f"{count} {word}" if count == 1 else f"{count} {word}s"


def _holders(is_holder: Iterable[bool]) -> str:
    return "on " + _many(sum(is_holder), "object")


def _tally(counts: Counter[Any]) -> str:
    return ", ".join(f"{count} {what}" for what, count in counts.most_common())


def _grouped(notes: "Iterable[Diagnostic]") -> Iterator[tuple[str, str | None, str]]:
    """Yield code, place and message of diagnostics, those that say the same together and no more than some of them."""
    alike: dict[tuple[str, str], list[Diagnostic]] = {}
    for note in notes:
        alike.setdefault((note.code, _VARYING.sub("…", note.message)), []).append(note)
    for (code, _), group in alike.items():
        # A line that stands for one more takes as much room as that one.
        shown = len(group) if len(group) == _SHOWN + 1 else _SHOWN
        yield from ((note.code, note.prim_path or note.layer, note.message) for note in group[:shown])
        if len(group) > shown:
            yield code, None, f"… and {len(group) - shown} more like it; --json has them all"
