"""The formats of scenes by the ending of the file: USD, and those that are converted at reading."""

from dataclasses import dataclass
from pathlib import Path

from usd2kg.convert.folders import holds_obj_files, list_folder
from usd2kg.convert.xml_root import read_root_tag
from usd2kg.errors import SceneError

__all__ = [
    "FORMATS",
    "LAYER_ENDINGS",
    "OBJ_FOLDER",
    "SCENE_ENDINGS",
    "STAGE_ENDINGS",
    "SourceFormat",
    "find_format",
    "is_scene_folder",
    "is_stage",
    "refuse_other_xml",
    "stages_in",
]

LAYER_ENDINGS = (".usda", ".usdc", ".usd")
"""USD files that hold one layer."""
STAGE_ENDINGS = (".usd", ".usda", ".usdc", ".usdz")
"""USD files that open as a stage."""


@dataclass(frozen=True)
class SourceFormat:
    """A file format with its converter."""

    name: str
    endings: tuple[str, ...]
    """In lower case, with the dot."""
    module: str
    """Module of this package with a function `read_prims`; imported only for files of this format."""
    install: str
    """Command that installs the converter."""
    root_tag: str = ""
    """Root element, of XML files whose ending does not name the format."""


_EXTRA = "pip install 'usd2kg[convert]'"
FORMATS = (
    SourceFormat("glTF", (".glb", ".gltf"), "gltf", _EXTRA),
    SourceFormat("OBJ", (".obj",), "obj", _EXTRA),
    SourceFormat("URDF", (".urdf",), "urdf", "pipx install urdf-usd-converter"),
    SourceFormat("MJCF", (".xml",), "mjcf", "pipx install mujoco-usd-converter", "mujoco"),
    SourceFormat("IFC", (".ifc", ".ifczip"), "ifc", "pip install 'usd2kg[ifc]'"),
    SourceFormat("SDFormat", (".sdf", ".world"), "sdf", "pip install 'usd2kg[sdf]'"),
)

OBJ_FOLDER = SourceFormat("OBJ folder", (), "obj_folder", _EXTRA)
"""A folder with an OBJ file for each object."""
SCENE_ENDINGS = (*STAGE_ENDINGS, *(ending for entry in FORMATS for ending in entry.endings))
"""Endings of files that may be scenes."""


def find_format(path: Path) -> SourceFormat | None:
    """Return the format of a file that needs conversion, by its ending; None for USD files and unknown endings.

    An XML file is only of a format that has its root element, a folder only if it holds OBJ files.

    Raises:
        SceneError: the folder has more files than a scene.
    """
    if path.is_dir():
        return OBJ_FOLDER if holds_obj_files(path) else None
    found = _formats_of(path.suffix)
    # A missing file is reported where it is read.
    if any(entry.root_tag for entry in found) and path.is_file():
        tag = read_root_tag(path)
        found = [entry for entry in found if entry.root_tag in {"", tag}]
    return found[0] if found else None


def _formats_of(ending: str) -> list[SourceFormat]:
    return [entry for entry in FORMATS if ending.lower() in entry.endings]


def refuse_other_xml(path: Path) -> None:
    """Say why an XML file of no known format is not converted; nothing for other files.

    Raises:
        SceneError: the ending is that of a format whose files have another root element.
    """
    expected = [f"<{entry.root_tag}> ({entry.name})" for entry in _formats_of(path.suffix) if entry.root_tag]
    if expected:
        tag = read_root_tag(path)
        root = "no root element" if tag is None else f"the root element <{tag}>"
        raise SceneError(f"{path}: has {root}, expected {' or '.join(expected)}; name the file of the whole model")


def is_stage(path: Path) -> bool:
    """Return whether a file or folder is a USD stage or is converted to one."""
    return find_format(path) is not None or (path.suffix.lower() in STAGE_ENDINGS and not path.is_dir())


def stages_in(folder: Path) -> tuple[Path, ...]:
    """Return the USD stages in a folder and below it."""
    return list_folder(folder, STAGE_ENDINGS).others


def is_scene_folder(path: Path) -> bool:
    """Return whether a path is a folder of OBJ files, without other scenes in it."""
    if not path.is_dir():
        return False
    found = list_folder(path, SCENE_ENDINGS)
    return bool(found.obj) and not found.others
