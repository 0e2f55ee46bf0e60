"""convert_stage: a stage in memory from a file of another format."""

from importlib import import_module
from pathlib import Path

from usd2kg.convert.converted import Converted, parse_error
from usd2kg.convert.folders import hash_files, list_folder
from usd2kg.convert.formats import SourceFormat
from usd2kg.convert.origin import Origin, write_origin
from usd2kg.errors import SceneError, Usd2kgError
from usd2kg.files import hash_file, name_of

__all__ = ["convert_stage"]


def convert_stage(path: Path, source_format: SourceFormat) -> Converted:
    """Return the stage of a file or folder, with the origin in its root layer.

    Raises:
        SceneError: the converter is not installed, or cannot read the file.
    """
    try:
        converted: Converted = import_module(f"usd2kg.convert.{source_format.module}").read_prims(path)
    except ModuleNotFoundError as error:
        raise SceneError(
            f"{path}: {source_format.name} needs {error.name}, which is not installed; run: {source_format.install}"
        ) from error
    except (Usd2kgError, MemoryError, RecursionError):
        raise
    except Exception as error:
        # The libraries that parse a damaged file may raise anything.
        raise parse_error(path, error, f"a whole {source_format.name} file") from error
    origin = Origin(name_of(path), f"sha256:{_hash(path)}", source_format.name, converted.converter)
    write_origin(converted.stage.GetRootLayer(), origin)
    return converted


def _hash(path: Path) -> str:
    return hash_files(path, list_folder(path, ()).obj) if path.is_dir() else hash_file(path)
