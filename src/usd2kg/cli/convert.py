"""usd2kg convert: a USD file from a file of another format."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from usd2kg.cli.options.stage import MetresPerUnit, UpAxis
from usd2kg.cli.output import notify
from usd2kg.files import stem_of

__all__ = ["convert_command"]


def convert_command(
    source: Annotated[
        Path,
        Argument(
            metavar="FILE",
            help="File to convert: .glb, .gltf, .obj, .urdf, .xml (MJCF), .ifc, .ifczip, .sdf or .world; or a folder "
            "with an .obj file for each object.",
        ),
    ],
    output: Annotated[
        Path | None,
        Option(
            "--output", "-o", help="Layer to write: .usdc, .usda or .usd; default: FILE.usdc in the current folder."
        ),
    ] = None,
    metres_per_unit: MetresPerUnit = None,
    up_axis: UpAxis = None,
) -> None:
    """Convert a file of another format to USD, with its names, hierarchy, units, colours and metadata.

    A folder of OBJ files is one scene: each file is an object, each folder below it a group.
    Commands that read a scene convert such files themselves; this one keeps the result.
    """
    from usd2kg.convert.write import convert_file  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.progress import show_steps  # noqa: PLC0415
    from usd2kg.scene import ReadOptions  # noqa: PLC0415

    target = output or Path(f"{stem_of(source)}.usdc")
    # Checks the units.
    reading = ReadOptions(metres_per_unit=metres_per_unit, up_axis=up_axis)
    with show_steps("convert"):
        converted = convert_file(source, target, metres_per_unit=reading.metres_per_unit, up_axis=reading.up_axis)
    for note in converted.notes:
        notify(note)
    notify(f"converted by {converted.converter}, written to {target}")
