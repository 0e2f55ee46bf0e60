"""Manifest: the outcome of each scene of a batch, one JSON record per line."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any, Self

from usd2kg.append_only import AppendOnlyFile, whole_lines
from usd2kg.errors import OutputError
from usd2kg.scene import StageFile

__all__ = ["JobStatus", "Manifest", "Record", "SourceState"]


class JobStatus(StrEnum):
    """Outcome of the last attempt."""

    DONE = "done"
    FAILED = "failed"


@dataclass(frozen=True)
class SourceState:
    """State by which a changed scene file is recognised without reading it."""

    bytes: int
    modified_ns: int

    @classmethod
    def of(cls, path: Path) -> Self:
        """Return the state of a file, or of all files in a folder."""
        below = path.rglob("*") if path.is_dir() else ()
        states = [found.stat() for found in (path, *below) if found.exists()]
        return cls(sum(state.st_size for state in states), max(state.st_mtime_ns for state in states))


@dataclass(frozen=True)
class Record:
    """One line of the manifest: a scene that was built or that failed."""

    scene: str
    """Name of the scene in the batch."""
    status: JobStatus
    options: str
    """Hash of the options and the ontology."""
    source: SourceState
    output: str = ""
    """Graph file relative to the output folder; empty if it failed."""
    sha256: str = ""
    """Checksum of the graph file."""
    layers: tuple[StageFile, ...] = ()
    """Files that the scene refers to, relative to its folder; without a hash if one changed during the build."""
    error: str = ""
    attempts: int = 1
    seconds: float = 0.0
    finished: str = ""
    """UTC, ISO 8601."""
    store: str = ""
    """Address of the store that has the graph, too; empty for none."""
    summary: Mapping[str, Any] = field(default_factory=dict)
    """Counts of objects, classes, statements and diagnostics."""


class Manifest:
    """The records of a batch in an append-only file; the last record of a scene counts.

    A record is on disk when `add` returns. A last line that a crash cut short is removed when the file is opened.
    """

    def __init__(self, path: Path) -> None:
        """Open the manifest, or start it.

        Raises:
            OutputError: the file is not a manifest, or cannot be written.
        """
        self.path = path
        self._records: dict[str, Record] = {}
        if path.exists() and not path.is_file():
            raise OutputError(f"{path}: is not a file; choose another output folder")
        try:
            data = path.read_bytes() if path.exists() else b""
            whole = whole_lines(data)
            self._records.update((record.scene, record) for record in _read(path, whole.decode("utf-8")))
            self._file = AppendOnlyFile(path, len(whole))
        except (OSError, UnicodeDecodeError) as error:
            raise OutputError(f"{path}: cannot be used as a manifest ({error}); choose another folder") from error

    def get(self, scene: str) -> Record | None:
        """Return the last record of a scene."""
        return self._records.get(scene)

    def add(self, record: Record) -> None:
        """Append a record.

        Raises:
            OutputError: it cannot be written; a part of it is removed.
        """
        line = json.dumps(asdict(record), ensure_ascii=True, separators=(",", ":")).encode() + b"\n"
        try:
            self._file.append(line)
        except OSError as error:
            raise OutputError(
                f"{self.path}: cannot be written ({error.strerror}); free space and run it again"
            ) from error
        self._records[record.scene] = record

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _read(path: Path, text: str) -> Iterator[Record]:
    for number, line in enumerate(text.splitlines(), 1):
        try:
            values = json.loads(line)
            source = SourceState(**values.pop("source"))
            # Version 0.2.0 recorded none; its scenes are built again, as the version is one of the options.
            layers = tuple(StageFile(**layer) for layer in values.pop("layers", ()))
            yield Record(status=JobStatus(values.pop("status")), source=source, layers=layers, **values)
        except (ValueError, TypeError, KeyError, AttributeError) as error:
            raise OutputError(
                f"{path}: line {number} is not a record of a batch ({error}); choose another output folder"
            ) from error
