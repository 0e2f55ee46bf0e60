"""The schema of the sources in `knowledge/`, read from `knowledge/schema.toml`, and the validation of CSV files."""

import csv
import math
import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.data_files import SourceError

TYPES = ("text", "number", "names")
FACTS = ("description", "origin", "licence")
"""What each entry states in words."""


@dataclass(frozen=True, slots=True)
class Column:
    """One column of a CSV source; `knowledge/schema.toml` describes the fields."""

    name: str
    type: str
    meaning: str
    unit: str = ""
    above: float = -math.inf
    least: float = -math.inf
    allowed: tuple[str, ...] = ()
    pattern: str = ""
    optional: bool = False

    def find_problem(self, cell: str) -> str | None:
        """Return what is wrong with a cell; None if it is valid."""
        if not cell:
            return None if self.optional else "is empty"
        if self.type == "number":
            return self._find_number_problem(cell)
        texts = cell.split("|") if self.type == "names" else [cell]
        if len(set(texts)) < len(texts):
            return f"{cell!r} repeats a name"
        return next(filter(None, map(self._find_text_problem, texts)), None)

    def _find_number_problem(self, cell: str) -> str | None:
        try:
            value = float(cell)
        except ValueError:
            return f"{cell!r} is not a number"
        if not math.isfinite(value) or value <= self.above or value < self.least:
            bound = f"above {self.above:g}" if math.isfinite(self.above) else f"of at least {self.least:g}"
            return f"{cell!r}; expected a number {bound}"
        return None

    def _find_text_problem(self, text: str) -> str | None:
        if text != " ".join(text.split()) or not text:
            return f"{text!r} has stray spaces"
        if self.allowed and text not in self.allowed:
            return f"{text!r}; expected one of {', '.join(self.allowed)}"
        if self.pattern and re.fullmatch(self.pattern, text) is None:
            return f"{text!r}; expected a match of {self.pattern}"
        return None


@dataclass(frozen=True, slots=True)
class Source:
    """One hand-written file."""

    name: str
    facts: Mapping[str, str]
    """Its description, origin and licence."""
    builds: tuple[str, ...]
    """Names of the data files that are made from it; its own name if it is copied."""
    key: tuple[str, ...]
    """Columns whose values together occur once."""
    columns: tuple[Column, ...]
    """In the order of the header row; empty for TOML files."""


@dataclass(frozen=True, slots=True)
class Schema:
    """The contents of `knowledge/schema.toml`."""

    sources: Mapping[str, Source]
    data: Mapping[str, Mapping[str, str]]
    """Data files that `make data` does not write → description, origin, licence, command."""


def read_schema(path: Path) -> Schema:
    """Return the schema.

    Raises:
        SourceError: an entry lacks its description, origin or licence, or a column is malformed.
    """
    tables = tomllib.loads(path.read_text("utf-8"))
    for name, table in (*tables["source"].items(), *tables["data"].items()):
        if missing := [key for key in FACTS if not table.get(key)]:
            raise SourceError(path, f"{name}: {', '.join(missing)} missing")
    return Schema({name: _source(path, name, table) for name, table in tables["source"].items()}, tables["data"])


def _source(path: Path, name: str, table: Mapping[str, Any]) -> Source:
    columns = tuple(_column(path, name, column, fields) for column, fields in table.get("columns", {}).items())
    key = tuple(table.get("key", ()))
    if bool(columns) != name.endswith(".csv") or not set(key) <= {column.name for column in columns}:
        raise SourceError(path, f"{name}: expected columns and a key of them for CSV files, and for these only")
    facts = {key: table[key] for key in FACTS}
    return Source(name, facts, tuple(table.get("builds", [name])), key, columns)


def _column(path: Path, source: str, name: str, fields: dict[str, Any]) -> Column:
    try:
        column = Column(name, **{**fields, "allowed": tuple(fields.get("allowed", ()))})
    except TypeError as error:
        raise SourceError(path, f"{source}: column {name}: {error}") from error
    if column.type not in TYPES:
        raise SourceError(path, f"{source}: column {name}: type {column.type!r}; expected one of {', '.join(TYPES)}")
    return column


def validate_source(path: Path, source: Source) -> None:
    """Check one source file.

    Raises:
        SourceError: the file cannot be parsed, or a cell does not match the schema; the first one is reported.
    """
    try:
        text = path.read_bytes().decode("utf-8")
        if not source.columns:
            tomllib.loads(text)
            return
        _validate_rows(path, source, csv.reader(text.splitlines(keepends=True), strict=True))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, csv.Error) as error:
        raise SourceError(path, str(error)) from error


def _validate_rows(path: Path, source: Source, lines: Iterator[list[str]]) -> None:
    names = [column.name for column in source.columns]
    if (header := next(lines, [])) != names:
        raise SourceError(path, f"header is {','.join(header)}; expected {','.join(names)}", 1)
    key = [names.index(name) for name in source.key]
    seen: dict[tuple[str, ...], int] = {}
    for line, row in enumerate(lines, 2):
        if len(row) != len(names):
            raise SourceError(path, f"{len(row)} cells; expected {len(names)}", line)
        for column, cell in zip(source.columns, row, strict=True):
            if problem := column.find_problem(cell):
                raise SourceError(path, f"column {column.name}: {problem}", line)
        own = tuple(row[at] for at in key)
        if own in seen:
            raise SourceError(path, f"{', '.join(source.key)} {own} is in line {seen[own]} already", line)
        seen[own] = line
