"""A folder of OBJ files → prims: an object for each file, a group for each folder.

Programs export a scene in this way with the positions of the scene, so that the files fit together.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pxr import Kind, Usd

from usd2kg.convert.converted import Converted, parse_error
from usd2kg.convert.folders import list_folder
from usd2kg.convert.formats import SCENE_ENDINGS
from usd2kg.convert.materials import MaterialAuthor
from usd2kg.convert.obj import ASSUMED, ObjPart, define_parts, read_parts
from usd2kg.convert.origin import SOURCE_ID
from usd2kg.convert.prims import PrimAuthor, custom_data, new_stage, valid_text
from usd2kg.convert.trimesh_files import MeshAuthor, trimesh_name
from usd2kg.errors import SceneError, Usd2kgError
from usd2kg.files import name_of

__all__ = ["read_prims"]

_EXPECTED = "a folder with an OBJ file for each object"
_OTHER_ENDINGS = frozenset({*SCENE_ENDINGS, ".fbx", ".dae", ".stl", ".ply", ".3ds", ".blend"})
"""Files whose geometry is missing from the scene, which must be reported."""
_MAX_NAMED = 20
"""Files that cannot be read, each with its own note."""
_MAX_LISTED = 3
"""Maximum number of example files in a note."""
_OBJECT_NAME = re.compile(rb"^o[ \t]+(\S[^\r\n]*)", re.MULTILINE)


def read_prims(path: Path) -> Converted:
    """Return the stage of a folder of OBJ files, below a prim named after the folder.

    Files that cannot be read are notes. A single file with several objects is a scene of these objects.

    Raises:
        SceneError: the folder has no OBJ file, or none that can be read.
    """
    files = list_folder(path, _OTHER_ENDINGS)
    if not files.obj:
        raise parse_error(path, "it holds no OBJ file", _EXPECTED)
    stage = new_stage("Y", 1.0)
    writer = _FolderWriter(stage, path, is_one_file=len(files.obj) == 1)
    for file in files.obj:
        writer.write(file)
    if writer.count == 0:
        raise parse_error(path, f"no OBJ file of {len(files.obj)} is readable: {writer.failures[0]}", _EXPECTED)
    notes = [ASSUMED, *writer.notes()]
    if files.others:
        notes.append(f"files of other formats are left out ({_listed(path, files.others)}); only OBJ files are read")
    return Converted(stage, trimesh_name(), tuple(notes))


class _FolderWriter:
    """Writes files as components, and their folders as groups when they are needed."""

    def __init__(self, stage: Usd.Stage, folder: Path, *, is_one_file: bool) -> None:
        self.count = 0
        """Files that were written."""
        self.failures: list[str] = []
        self._stage = stage
        self._folder = folder
        self._is_one_file = is_one_file
        self._several: list[Path] = []
        """Files with several objects."""
        self._author = PrimAuthor(stage)
        name = name_of(folder)
        root = self._author.define("/", name)
        stage.SetDefaultPrim(root)
        root.SetAssetInfo({"name": valid_text(name)})
        Usd.ModelAPI(root).SetKind(Kind.Tokens.assembly)
        self._groups = {folder: str(root.GetPath())}
        self._materials = MaterialAuthor(self._author, self._groups[folder])

    def write(self, file: Path) -> None:
        """Write a file, or record why it cannot be read."""
        try:
            parts = read_parts(file)
        except (SceneError, OSError) as error:
            self._fail(file, error)
            return
        # A prim of an earlier file may have the geometry's id, by which meshes are kept.
        meshes = MeshAuthor(self._author, self._groups[self._folder], self._materials)
        group = self._group(file.parent)
        is_several = len({part.name for part in parts}) > 1
        if is_several and self._is_one_file:
            prims = define_parts(self._author, meshes, group, parts)
            for prim in prims:
                Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
            self.count += 1
            return
        prim = self._author.define(group, file.stem)
        try:
            self._write_object(prim, meshes, file, parts)
        except (Usd2kgError, MemoryError, RecursionError):
            raise
        except Exception as error:
            # Textures that Pillow cannot read, and meshes that trimesh does not check, may raise anything.
            self._stage.RemovePrim(prim.GetPath())
            self._fail(file, error)
        else:
            self.count += 1

    def _write_object(self, prim: Usd.Prim, meshes: MeshAuthor, file: Path, parts: list[ObjPart]) -> None:
        path = str(prim.GetPath())
        Usd.ModelAPI(prim).SetKind(Kind.Tokens.component)
        prim.SetCustomDataByKey(SOURCE_ID, valid_text(file.relative_to(self._folder).as_posix()))
        if len({part.name for part in parts}) == 1:
            for part in parts:
                meshes.define(path, "mesh", part.geometry)
            _keep_object_name(prim, file)
            return
        self._several.append(file)
        for part in define_parts(self._author, meshes, path, parts):
            Usd.ModelAPI(part).SetKind(Kind.Tokens.subcomponent)

    def notes(self) -> Iterator[str]:
        """Yield notes about omissions and assumptions."""
        yield from self.failures[:_MAX_NAMED]
        more = len(self.failures) - _MAX_NAMED
        if more > 0:
            yield f"{more} more files cannot be read"
        if self._several:
            listed = _listed(self._folder, self._several)
            yield f"the objects (o) of a file are its parts ({listed}); --kind subcomponent makes them objects"

    def _fail(self, file: Path, error: Exception) -> None:
        text = str(error) if isinstance(error, SceneError) else str(parse_error(file, error, "a whole OBJ file"))
        name = file.relative_to(self._folder).as_posix()
        self.failures.append(valid_text(f"{name}{text.removeprefix(str(file))}; its object is left out"))

    def _group(self, folder: Path) -> str:
        """Return the path of the group of a folder."""
        missing = []
        while folder not in self._groups:
            missing.append(folder)
            folder = folder.parent
        path = self._groups[folder]
        for inner in reversed(missing):
            prim = self._author.define(path, inner.name)
            Usd.ModelAPI(prim).SetKind(Kind.Tokens.group)
            path = self._groups[inner] = str(prim.GetPath())
        return path


def _keep_object_name(prim: Any, file: Path) -> None:
    """Keep the name of the object (`o`) if it is not that of the file: one of the two often is a number."""
    found = _OBJECT_NAME.search(file.read_bytes())
    name = found[1].decode("utf-8", "replace").strip() if found else ""
    if name and name.casefold() != file.stem.casefold():
        prim.SetCustomDataByKey("obj", custom_data({"object": name}))


def _listed(folder: Path, files: list[Path] | tuple[Path, ...]) -> str:
    names = ", ".join(file.relative_to(folder).as_posix() for file in files[:_MAX_LISTED])
    more = len(files) - _MAX_LISTED
    return valid_text(f"{names} and {more} more" if more > 0 else names)
