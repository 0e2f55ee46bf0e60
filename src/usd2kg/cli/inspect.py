"""usd2kg inspect: what is on a stage."""

from dataclasses import asdict
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
    TimeCode,
    UpAxis,
    read_options,
)
from usd2kg.cli.output import emit, format_table, print_json

if TYPE_CHECKING:
    from usd2kg.scene import Scene, SceneObject

__all__ = ["inspect_command"]


def inspect_command(
    scene: SceneFile,
    why: Annotated[
        str | None, typer.Option("--why", help="Say why the prim at this path is an object or none.")
    ] = None,
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
    from usd2kg.scene import explain_choice, read_scene  # noqa: PLC0415 - opens OpenUSD, too slow for --help

    options = read_options(
        metres_per_unit, up_axis, time_code, expand_instancers, include, exclude, kind, objects, every_prim
    )
    if why is not None:
        emit(explain_choice(scene, why, options) + "\n", None)
        return
    found = read_scene(scene, options=options)
    if json:
        print_json(_as_json(found))
    else:
        emit(_as_text(found), None)


def _as_json(scene: "Scene") -> dict[str, Any]:
    families: dict[str, list[str]] = {}
    for obj in scene.objects:
        families.setdefault(obj.prim_path.rpartition("/")[0] or "/", []).append(obj.name)
    return {
        "source": scene.source,
        "content_hash": scene.content_hash,
        "frame": asdict(scene.frame),
        "time": scene.time,
        "prim_count": scene.prim_count,
        "objects": [_object_as_json(obj) for obj in scene.objects],
        "families": families,
        "left_out": dict(scene.left_out),
        "joints": [asdict(joint) for joint in scene.joints],
        "diagnostics": [asdict(diagnostic) for diagnostic in scene.diagnostics],
    }


def _object_as_json(obj: "SceneObject") -> dict[str, Any]:
    data = asdict(obj)
    labels = data.pop("labels")._asdict()
    size = obj.box.size if obj.box else None
    return {"path": data.pop("prim_path"), **data, "labels": labels, "words": obj.words, "size": size}


def _as_text(scene: "Scene") -> str:
    columns = ("path", "size w×d×h m", "mass kg", "position m", "asset", "materials", "parts", "chosen by")
    rows = [
        (
            obj.prim_path,
            " × ".join(f"{side:.2f}" for side in obj.box.size) if obj.box else "no geometry",
            f"{obj.mass_kg:.3g}" if obj.mass_kg is not None else None,
            " ".join(f"{value:.2f}" for value in obj.position) if obj.position else None,
            ", ".join(obj.asset),
            ", ".join(obj.materials),
            ", ".join(obj.parts),
            obj.selected_by,
        )
        for obj in scene.objects
    ]
    frame = scene.frame
    unit = "authored" if frame.is_authored else "fallback, not authored"
    lines = [
        f"\n{len(scene.objects)} objects among {scene.prim_count} prims; "
        f"1 stage unit = {frame.metres_per_unit:g} m ({unit}), {frame.up_axis} up\n"
    ]
    if scene.left_out:
        lines.append("left out: " + ", ".join(f"{count} {why}" for why, count in scene.left_out.items()) + "\n")
    if scene.diagnostics:
        lines.append("\n")
        notes = [(d.code, d.prim_path or d.layer, d.message) for d in scene.diagnostics]
        lines.append(format_table(("diagnostic", "where", "message"), notes))
    return format_table(columns, rows) + "".join(lines)
