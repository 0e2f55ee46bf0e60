"""Project: the folder of one review, with its sources, its journal and what follows from the decisions."""

import json
import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from usd2kg.errors import GroundingError, OutputError, StoreError
from usd2kg.files import write_whole
from usd2kg.folder_lock import lock_exclusive
from usd2kg.scene import ReadOptions, SelectionOverrides

__all__ = ["PROJECT_FILE", "Project", "ProjectSources", "open_project"]

PROJECT_FILE = "project.json"
_FORMAT = "usd2kg-studio/1"
_LOCK_WAIT_S = 1.0
_PATHS = ("scene", "ontology", "mapping", "second_mapping", "alignment")
"""Sources that are files."""


@dataclass(frozen=True)
class ProjectSources:
    """What a project reviews."""

    scene: Path
    ontology: Path | None = None
    """None for the built-in TBox that suits the scene."""
    mapping: Path | None = None
    """Grounding of `usd2kg ground --format json`; None for the lexical grounder's."""
    second_mapping: Path | None = None
    """Grounding of another grounder, to compare with; None without one."""
    alignment: Path | None = None
    """Edited alignment for the lexical grounder."""
    base: str | None = None
    """Namespace of the individuals; None for the default of the scene."""
    reading: ReadOptions = field(default_factory=ReadOptions)


@dataclass(frozen=True)
class Project:
    """An open project; no other process has it open."""

    folder: Path
    sources: ProjectSources

    @property
    def journal(self) -> Path:
        """The decisions, an input of `--decisions`."""
        return self.folder / "decisions.sssom.tsv"

    @property
    def applied_lessons(self) -> Path:
        """What the decisions had taught when the open objects were last grounded again; absent before."""
        return self.folder / "applied.sssom.tsv"


@contextmanager
def open_project(folder: Path, sources: ProjectSources | None = None) -> Iterator[Project]:
    """Open the project in a folder, or make one there.

    Args:
        folder: the folder; it is made if there are sources.
        sources: what to review; None to take those of the project.

    Raises:
        GroundingError: the folder is not a project, or one about another scene or ontology.
        OutputError: it cannot be made.
        StoreError: another process has the project open.
    """
    file = folder / PROJECT_FILE
    known = _read_sources(file) if file.is_file() else None
    if known is None and sources is None:
        raise GroundingError(f"{folder}: has no {PROJECT_FILE}; expected a project, or a stage to make one")
    if known is None and folder.exists() and any(folder.iterdir()):
        raise OutputError(f"{folder}: is not empty and no project; choose another --project")
    if known is not None and sources is not None:
        _check_same(file, known, sources)
    chosen = sources or known
    assert chosen is not None, "checked above"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be made ({error.strerror}); choose another --project") from error
    with ExitStack() as locks:
        try:
            locks.enter_context(lock_exclusive(folder, _LOCK_WAIT_S))
        except StoreError as error:
            raise StoreError(f"{error} (a studio may be open on it)") from error
        write_whole(file, _format_sources(chosen, folder))
        yield Project(folder, chosen)


def _check_same(file: Path, known: ProjectSources, given: ProjectSources) -> None:
    for name in ("scene", "ontology"):
        before, now = getattr(known, name), getattr(given, name)
        is_same = before == now if before is None or now is None else before.resolve() == now.resolve()
        if not is_same:
            raise GroundingError(
                f"{file}: is about the {name} {before or 'built in'}, not {now or 'the built-in one'}; "
                "open the folder itself to go on with it, or choose another --project"
            )


def _format_sources(sources: ProjectSources, folder: Path) -> bytes:
    """Return the sources as JSON; paths are relative to the folder, so that it can move with its scene."""
    values = asdict(sources)
    for name in _PATHS:
        if values[name] is not None:
            values[name] = _relative(values[name], folder)
    return (json.dumps({"format": _FORMAT, **values}, indent=1) + "\n").encode()


def _relative(path: Path, folder: Path) -> str:
    try:
        return Path(os.path.relpath(path.resolve(), folder.resolve())).as_posix()
    except ValueError:
        # Another drive.
        return str(path.resolve())


def _read_sources(file: Path) -> ProjectSources:
    try:
        values: dict[str, Any] = json.loads(file.read_text("utf-8"))
        if values.pop("format") != _FORMAT:
            raise ValueError("another format")
        for name in _PATHS:
            if values.get(name) is not None:
                values[name] = Path(os.path.normpath(file.parent / values[name]))
        reading = values.pop("reading")
        selection: dict[str, Any] = {
            key: tuple(value) if isinstance(value, list) else value for key, value in reading.pop("selection").items()
        }
        return ProjectSources(**values, reading=ReadOptions(**reading, selection=SelectionOverrides(**selection)))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise GroundingError(
            f"{file}: cannot be read ({error}); expected the {PROJECT_FILE} of usd2kg studio"
        ) from error
