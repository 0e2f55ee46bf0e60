"""usd2kg render: pictures of a scene and its objects."""

import re
from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.options.bundles import check_files, expand_bundles
from usd2kg.cli.options.coloring import ColorOptions
from usd2kg.cli.options.common import SceneFile
from usd2kg.cli.options.stage import MetresPerUnit, TimeCode, UpAxis
from usd2kg.cli.output import notify
from usd2kg.cli.picture_colors import find_colors
from usd2kg.errors import OutputError
from usd2kg.files import check_writable, stem_of, write_whole

__all__ = ["render_command"]

_GEOMETRY_CODES = frozenset({"mesh", "copies"})
"""Codes of the diagnostics about geometry missing from the picture."""


@expand_bundles
def render_command(
    scene: SceneFile,
    coloring: ColorOptions,
    path: Annotated[
        str | None, Argument(metavar="[PATH]", help="Prim path of an object; default: the whole scene.")
    ] = None,
    output: Annotated[
        Path | None, Option("--output", "-o", help="PNG file to write; default: NAME.png in the current folder.")
    ] = None,
    context: Annotated[bool, Option("--context", help="Show the object highlighted in its place.")] = False,
    size: Annotated[
        str | None,
        Option("--size", help="WIDTHxHEIGHT in pixels; default: 256x256 for an object, 800x600 for a scene."),
    ] = None,
    metres_per_unit: MetresPerUnit = None,
    up_axis: UpAxis = None,
    time_code: TimeCode = None,
) -> None:
    """Render an object, or the whole scene from above, as a PNG picture.

    --color-by grounds the objects with the lexical grounder and adds a legend to the right of the picture.
    """
    pixels = {} if size is None else {"size": _parse_size(size)}
    if context and path is None:
        raise OutputError("--context shows one object in its place; expected the PATH of an object after the scene")
    mode = coloring.mode()
    if context and mode.value != "material":
        raise OutputError("--context highlights one object by its colour; use it without --color-by")
    target = output or Path(f"{_file_name(path) if path else stem_of(scene)}.png")
    if target.suffix.lower() != ".png":
        raise OutputError(f"{target}: expected a file name ending in .png")
    check_writable(target)
    check_files([target], [scene], coloring)
    from usd2kg.diagrams import add_legend  # noqa: PLC0415
    from usd2kg.render import Renderer  # noqa: PLC0415
    from usd2kg.scene import ReadOptions  # noqa: PLC0415 - loads OpenUSD, too slow for --help

    reading = ReadOptions(metres_per_unit=metres_per_unit, up_axis=up_axis, time=time_code)
    renderer = Renderer(scene, reading)
    colors = None if mode.value == "material" else find_colors(scene, reading, mode, coloring)
    linear = None if colors is None else colors.linear_colors()
    if path is None:
        picture = renderer.render_scene(**pixels, colors=linear)
    else:
        picture = renderer.render_object(path, **pixels, in_context=context, colors=linear)
    if colors is not None:
        picture = add_legend(picture, colors, coloring.ask or mode.value.capitalize())
    write_whole(target, picture)
    for note in renderer.diagnostics:
        if note.code in _GEOMETRY_CODES:
            notify(f"{note.prim_path}: {note.message}")
    notify(f"written to {target}")


def _file_name(path: str) -> str:
    return re.sub(r"[^\w.-]+", "_", path.rpartition("/")[2]) or "object"


def _parse_size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,5})[x×](\d{1,5})", text.strip().lower())
    if not found:
        raise OutputError(f"--size {text}: not a size, expected WIDTHxHEIGHT in pixels, like 512x384")
    return int(found.group(1)), int(found.group(2))
