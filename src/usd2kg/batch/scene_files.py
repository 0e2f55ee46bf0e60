"""find_scene_files: the scenes of a batch, by paths, folders and patterns."""

import glob
import os
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from usd2kg.convert import STAGE_ENDINGS, is_scene_folder, is_stage
from usd2kg.errors import SceneError

__all__ = ["SceneFile", "find_scene_files", "output_names"]


class SceneFile(NamedTuple):
    """One scene of a batch."""

    name: str
    """Path relative to the folder that all scenes share, with `/`."""
    path: Path

    @property
    def stem(self) -> str:
        """The name without the ending of the file."""
        return self.name.removesuffix(self.path.suffix)


def find_scene_files(places: Iterable[str], exclude: Iterable[str] = ()) -> tuple[SceneFile, ...]:
    """Return the scenes that paths, folders and patterns name, sorted by name, each once.

    A folder stands for all stages below it; files of other formats have to be named, or matched by a pattern. A folder
    that only has OBJ files is one scene. In a pattern, `**` stands for any number of folders, as in a shell.

    Args:
        places: files, folders, and patterns such as `scenes/**/*.usd`.
        exclude: patterns of what is left out, such as `**/assets/**`.

    Raises:
        SceneError: a place names no scene.
    """
    left_out = {path for pattern in exclude for path in _matches(pattern)}
    found: dict[Path, None] = {}
    for place in places:
        paths = [path for path in _scenes_of(place) if path not in left_out]
        if not paths:
            raise SceneError(f"{place}: no scene found; expected a file, a folder with stages, or a pattern in quotes")
        found.update(dict.fromkeys(paths))
    if not found:
        raise SceneError("no scene is named; expected files, folders or patterns such as 'scenes/**/*.usd'")
    root = Path(os.path.commonpath([path.parent for path in found]))
    return tuple(sorted(SceneFile(path.relative_to(root).as_posix(), path) for path in found))


def output_names(scenes: Iterable[SceneFile]) -> dict[str, str]:
    """Return name of a scene → name of its output without an ending; that of the file stays where names would clash."""
    scenes = tuple(scenes)
    counts = Counter(scene.stem.casefold() for scene in scenes)
    return {scene.name: scene.stem if counts[scene.stem.casefold()] == 1 else scene.name for scene in scenes}


def _scenes_of(place: str) -> Iterator[Path]:
    path = Path(place)
    if path.is_dir():
        stages = [file for file in sorted(_files_below(path)) if file.suffix.lower() in STAGE_ENDINGS]
        yield from stages or ([path.absolute()] if is_scene_folder(path) else [])
    elif path.is_file():
        yield path.absolute()
    else:
        yield from (file for file in sorted(_matches(place)) if is_stage(file))


def _files_below(folder: Path) -> Iterator[Path]:
    for parent, folders, files in os.walk(folder.absolute()):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(parent, name) for name in files if not name.startswith("."))


def _matches(pattern: str) -> set[Path]:
    # Unlike `Path.glob`, `glob.iglob` accepts absolute patterns.
    found = (Path(name).absolute() for name in glob.iglob(pattern, recursive=True))  # noqa: PTH207
    return {path for path in found if path.is_file()}
