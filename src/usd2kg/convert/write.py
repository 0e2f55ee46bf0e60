"""convert_file: a USD file from a file of another format."""

import tempfile
from pathlib import Path
from typing import Any

from pxr import UsdGeom

from usd2kg.convert.converted import Converted
from usd2kg.convert.formats import FORMATS, LAYER_ENDINGS, find_format, refuse_other_xml
from usd2kg.convert.read import convert_stage
from usd2kg.errors import OutputError, SceneError
from usd2kg.files import check_apart, check_writable, write_whole
from usd2kg.tracing import traced

__all__ = ["convert_file"]


@traced("convert")
def convert_file(
    source: Path, output: Path, *, metres_per_unit: float | None = None, up_axis: str | None = None
) -> Converted:
    """Write a file of another format, or a folder of OBJ files, as one USD layer, and return what was converted.

    Args:
        source: the file or folder.
        output: the layer to write, `.usdc`, `.usda` or `.usd`.
        metres_per_unit: length of a unit of the source in metres, instead of what the format says.
        up_axis: `Y` or `Z`, instead of what the format says.

    Raises:
        SceneError: the file is missing, of no known format, or broken, or its converter is not installed.
        OutputError: the layer cannot be written.
    """
    if output.suffix.lower() not in LAYER_ENDINGS:
        raise OutputError(f"{output}: expected a USD layer with a name ending in one of {', '.join(LAYER_ENDINGS)}")
    check_writable(output)
    check_apart([output], [source])
    known = ", ".join(ending for entry in FORMATS for ending in entry.endings)
    if not source.exists():
        raise SceneError(f"{source}: no such file; expected a file to convert ({known}), or a folder of OBJ files")
    source_format = find_format(source)
    if source_format is None and source.is_dir():
        raise SceneError(f"{source}: is a folder without OBJ files; name the file to convert ({known})")
    if source_format is None:
        refuse_other_xml(source)
        raise SceneError(
            f"{source}: no known format (ending {source.suffix or 'missing'!r}), expected one of {known}; "
            "USD stages need no conversion"
        )
    converted = convert_stage(source, source_format)
    if metres_per_unit is not None:
        UsdGeom.SetStageMetersPerUnit(converted.stage, metres_per_unit)
    if up_axis is not None:
        UsdGeom.SetStageUpAxis(converted.stage, up_axis)
    write_whole(output, _serialize(converted.stage.GetRootLayer(), output.suffix.lower()))
    return converted


def _serialize(layer: Any, ending: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"layer{ending}"
        layer.Export(str(path))
        return path.read_bytes()
