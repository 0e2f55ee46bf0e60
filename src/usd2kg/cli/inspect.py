"""usd2kg inspect: what is on a stage."""

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from usd2kg.cli.options import (
    EveryPrim,
    Exclude,
    ExpandInstancers,
    Include,
    JsonOutput,
    Kinds,
    MetresPerUnit,
    ObjectList,
    SceneFile,
    Shapes,
    TimeCode,
    UpAxis,
    read_options,
)
from usd2kg.cli.output import emit, format_table, print_json, printable
from usd2kg.errors import SceneError

if TYPE_CHECKING:
    from usd2kg.scene import (
        Box,
        Diagnostic,
        Joint,
        Label,
        MaterialDetails,
        ReadOptions,
        Scene,
        SceneObject,
        ShapeDescriptors,
    )

__all__ = ["inspect_command"]

_SHOWN = 3
"""Diagnostics that are shown of those that say the same."""
_NAMES = 6
"""Names of materials and parts that fit into a line of the table."""
_HOLLOW = 0.005
"""What is less open than this holds drops between its parts."""
_VARYING = re.compile(r"""'[^']*'|"[^"]*"|<[^>]*>|/\S+|\w+(?::\w+)+|[-+]?\d[\d.,e+-]*""")
"""What differs between messages that say the same: quotations, paths, names of properties, numbers."""

Rows = Iterator[tuple[str, str]]


def inspect_command(
    scene: SceneFile,
    why: Annotated[
        str | None,
        typer.Option(
            "--why", help="Say why the prim at this path is an object or none, and all that is known of the object."
        ),
    ] = None,
    shapes: Shapes = False,
    metres_per_unit: MetresPerUnit = None,
    up_axis: UpAxis = None,
    time_code: TimeCode = None,
    expand_instancers: ExpandInstancers = False,
    include: Include = None,
    exclude: Exclude = None,
    kind: Kinds = None,
    objects: ObjectList = None,
    every_prim: EveryPrim = False,
    json: JsonOutput = False,
) -> None:
    """List the objects of a scene with their evidence, what was left out and why, and diagnostics."""
    from usd2kg.scene import describe_shapes, read_scene  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    options = read_options(
        metres_per_unit, up_axis, time_code, expand_instancers, include, exclude, kind, objects, every_prim
    )
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
    joints = [joint for joint in scene.joints if path in _objects_of(joint, scene)]
    if is_json:
        known = {**_object_as_json(obj, forms), "joints": [asdict(joint) for joint in joints]}
        print_json({"path": path, "why": reason, "object": known})
        return
    notes = [note for note in scene.diagnostics if note.prim_path == path]
    rows = [*_rows_of(obj), *_joint_rows(joints, path, scene), *_shape_rows(forms.get(path))]
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
        _size(obj.box.size) if obj.box else "no geometry",
        f"{obj.mass_kg:.3g}" if obj.mass_kg is not None else None,
        _numbers(obj.position) if obj.position else None,
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
    volume = _litres(form.volume_m3) if form.volume_m3 is not None else "open surface"
    holds = _litres(form.capacity_m3) if form.openness >= _HOLLOW else None
    roundness = f"{form.roundness:.2f}" if form.roundness is not None else None
    return [_tight(form), volume, holds, roundness]


def _tight(form: "ShapeDescriptors") -> str:
    return " × ".join(f"{side:.3f}" for side in (form.long_m, form.middle_m, form.short_m))


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


def _rows_of(obj: "SceneObject") -> Rows:
    """Yield (what, value) of all that the stage says of an object; what it does not say is left out."""
    yield "name", obj.name
    yield from _block("display name", [obj.display_name])
    yield "words", ", ".join(obj.words) or "none that tell what it is"
    yield from _block("documentation", [obj.documentation])
    yield "type", f"{obj.type_name or 'none'}{', kind ' + obj.kind if obj.kind else ''}"
    yield from _block("inside", [obj.parent_path or ""])
    yield from _block("instance", [f"of the same prototype as {obj.instance_of}" if obj.instance_of else ""])
    if obj.instances:
        yield "copies", f"{obj.instances.count} of {', '.join(obj.instances.prototypes)}"
    yield from _measure_rows(obj)
    yield from _block("assets", obj.asset)
    yield from _block("materials", [_material(m) for m in obj.material_details] or obj.materials)
    if obj.display_color:
        yield "display colour", _color(obj.display_color)
    yield from _block("parts", [", ".join(obj.parts)])
    yield from _block("variants", [f"{name} = {choice}" for name, choice in obj.variants])
    yield from _block("texts", [f"{name}: {text}" for name, text in obj.texts])
    yield from _block("labels", [_label(label, obj) for group in obj.labels for label in group])


def _block(what: str, values: Sequence[str]) -> Rows:
    """Yield a row for each value that is not empty, named once."""
    for i, value in enumerate(filter(None, values)):
        yield "" if i else what, value


def _measure_rows(obj: "SceneObject") -> Rows:
    yield "box", _box(obj.box) if obj.box else "no geometry"
    if obj.own_box and obj.own_box != obj.box:
        yield "own box", f"{_box(obj.own_box)}, without the objects inside"
    if obj.oriented_size:
        yield "along own axes", f"{_size(obj.oriented_size)} m"
    if obj.position:
        yield "position", f"{_numbers(obj.position)} m"
    if obj.orientation and abs(obj.orientation[3]) < 1 - 1e-9:
        yield "orientation", f"{_numbers(obj.orientation)} (quaternion x y z w)"
    if obj.mass_kg is not None:
        yield "mass", f"{obj.mass_kg:.3g} kg"


def _box(box: "Box") -> str:
    return f"{_size(box.size)} m (w×d×h), centre at {_numbers(box.center)} m"


def _size(sides: Sequence[float]) -> str:
    return " × ".join(f"{side:.2f}" for side in sides)


def _numbers(values: Sequence[float]) -> str:
    # Adding 0 makes a 0 of what is -0.
    return " ".join(f"{round(value, 2) + 0.0:.2f}" for value in values)


def _color(rgb: Sequence[float]) -> str:
    return f"linear RGB {_numbers(rgb)}"


def _material(material: "MaterialDetails") -> str:
    numbers = {name: getattr(material, name) for name in ("roughness", "metallic", "opacity")}
    known = [f"{name} {value:.2g}" for name, value in numbers.items() if value is not None]
    if material.base_color:
        known.insert(0, _color(material.base_color))
    return f"{material.name}: {', '.join(known) or 'nothing constant'}"


def _label(label: "Label", obj: "SceneObject") -> str:
    place = "" if label.prim_path == obj.prim_path else f", {'from' if label.is_inherited else 'on'} {label.prim_path}"
    strength = ", as a report only" if label.strength == "report" else ""
    return f"{label.value} ({label.encoding}, {label.taxonomy}{strength}{place})"


def _objects_of(joint: "Joint", scene: "Scene") -> set[str]:
    """Return the paths of the objects that the bodies of a joint are, or are parts of."""
    return {owner for body in (joint.body0, joint.body1) if (owner := _owner(body, scene)) is not None}


def _owner(path: str | None, scene: "Scene") -> str | None:
    while path and path not in scene.by_path:
        path = path.rpartition("/")[0]
    return path or None


def _joint_rows(joints: "Sequence[Joint]", path: str, scene: "Scene") -> Rows:
    def name(body: str | None) -> str:
        if body is None or _owner(body, scene) != path:
            return body or "the world"
        return "it" if body == path else f"its {body.rpartition('/')[2]}"

    for i, joint in enumerate(joints):
        moved, base = name(joint.body1), name(joint.body0)
        verb = "hangs on" if joint.type == "fixed" else "moves against"
        told = ", ".join([f"{moved} {verb} {base}", *_motion(joint)])
        yield "" if i else "joints", f"{joint.type}: {told} (joint {joint.prim_path})"


def _motion(joint: "Joint") -> Iterator[str]:
    """Yield which way and how far a joint moves, angles in degrees."""
    factor, unit = (math.degrees(1), "°") if joint.type == "revolute" else (1.0, " m")
    if joint.direction:
        yield f"{'about' if joint.type == 'revolute' else 'along'} {_article(joint.direction)} axis"
    if joint.lower is not None or joint.upper is not None:
        ends = ("no limit" if end is None else f"{end * factor:.3g}{unit}" for end in (joint.lower, joint.upper))
        yield "from " + " to ".join(ends)
    elif joint.type in {"revolute", "prismatic"}:
        yield "without limits"
    if joint.value is not None:
        yield f"now at {joint.value * factor:.3g}{unit}"
    if not joint.is_enabled:
        yield "switched off"


def _article(word: str) -> str:
    return f"an {word}" if word[0] in "aeiou" else f"a {word}"


def _shape_rows(form: "ShapeDescriptors | None") -> Rows:
    """Yield the measures of an object's own geometry; nothing where it has none."""
    if form is None:
        return
    yield "tight box", f"{_tight(form)} m, turned as it fits best"
    enclosed = "its surface is not closed" if form.volume_m3 is None else f"{_litres(form.volume_m3)} litres enclosed"
    yield "volume", f"{enclosed}, {_litres(form.hull_volume_m3)} litres in its convex hull"
    yield "surface", f"{form.surface_m2:.3g} m²"
    holds = f"{_litres(form.capacity_m3)} litres of water as it stands, openness {form.openness:.2f}"
    yield "holds", holds if form.openness >= _HOLLOW else "no water as it stands"
    ratios = {name: getattr(form, name) for name in ("elongation", "flatness", "roundness", "verticality")}
    known = [f"{name} {value:.2f}" for name, value in ratios.items() if value is not None]
    yield from _block("form", [", ".join(known)])


def _litres(cubic_metres: float) -> str:
    litres = cubic_metres * 1000
    return f"{litres:.0f}" if litres >= 100 else f"{litres:.3g}"
