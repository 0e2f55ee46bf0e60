"""Paths and formats shared by the scripts that write package data."""

import csv
import gzip
import io
import zipfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[1]
KNOWLEDGE = ROOT / "knowledge"
DATA = ROOT / "src/usd2kg/data"


class SourceError(ValueError):
    """A source file, or a line of it, does not match its schema."""

    def __init__(self, path: Path, problem: str, line: int | None = None) -> None:
        """Create the error; `problem` states what was found and what was expected."""
        shown = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
        super().__init__(f"{shown}: {problem}" if line is None else f"{shown}:{line}: {problem}")


def read_source_rows(name: str) -> list[dict[str, str]]:
    """Return the rows of a CSV file in `knowledge/`, each as column → text."""
    with (KNOWLEDGE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, strict=True))


def csv_bytes(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> bytes:
    """Return a CSV file with a header row and Unix line ends."""
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows([columns, *rows])
    return text.getvalue().encode()


def gzip_bytes(content: bytes) -> bytes:
    """Return compressed bytes without a time stamp: the same input gives the same bytes."""
    return gzip.compress(content, compresslevel=9, mtime=0)


def npz_bytes(**arrays: Any) -> bytes:
    """Return a compressed file of arrays as `numpy.load` reads it, without time stamps."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, array in arrays.items():
            data = io.BytesIO()
            np.lib.format.write_array(data, np.asanyarray(array))
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), data.getvalue(), zipfile.ZIP_DEFLATED)
    return file.getvalue()


def encode_lines(lines: Iterable[str]) -> Any:
    """Return lines as an array of UTF-8 bytes, for `npz_bytes`."""
    return np.frombuffer("\n".join(lines).encode("utf-8"), dtype=np.uint8)


def write_data_file(name: str, content: bytes) -> Path:
    """Write a file of the package data and return its path."""
    path = DATA / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path
