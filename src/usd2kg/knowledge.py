"""Read the package data in `usd2kg/data`, which `make data` builds from the sources in `knowledge/`."""

import csv
import io
import json
import zlib
from collections.abc import Iterable, Mapping
from functools import lru_cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from operator import itemgetter
from types import MappingProxyType
from typing import Any, TypeVar

__all__ = [
    "data_file",
    "read_bytes",
    "read_cells",
    "read_compressed",
    "read_rows",
    "read_settings",
    "read_text",
    "word_map",
    "word_set",
]

_GZIP = 31
"""zlib's `wbits` for gzip files."""


def data_file(name: str) -> Traversable:
    """Return the data file `name`, for readers that need a stream or a path (`importlib.resources.as_file`)."""
    return files("usd2kg") / "data" / name


def read_text(name: str) -> str:
    """Return the text of the data file `name`."""
    return data_file(name).read_text("utf-8")


def read_bytes(name: str) -> bytes:
    """Return the bytes of the data file `name`."""
    return data_file(name).read_bytes()


def read_compressed(name: str) -> bytes:
    """Return the decompressed bytes of the data file `name`, which gzip compressed."""
    packed = read_bytes(name)
    # Without the size, which ends the file (RFC 1952), it takes half as long again.
    return zlib.decompress(packed, wbits=_GZIP, bufsize=int.from_bytes(packed[-4:], "little"))


def read_rows(name: str) -> list[dict[str, str]]:
    """Return the rows of a CSV data file, each as column → text; an empty cell is an empty string."""
    columns, *rows = csv.reader(io.StringIO(read_text(name), newline=""), strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]


def read_cells(name: str, *columns: str) -> Iterable[tuple[str, ...]]:
    """Return the cells of two or more columns of a CSV data file, row by row: three times as fast as `read_rows`.

    Raises:
        ValueError: a column is unknown.
    """
    header, *rows = csv.reader(io.StringIO(read_text(name), newline=""), strict=True)
    return map(itemgetter(*map(header.index, columns)), rows)


@lru_cache(maxsize=256)
def word_set(component: str, name: str) -> frozenset[str]:
    """Return the words of the list `name` in `knowledge/words/<component>.toml`.

    Raises:
        KeyError: the list is unknown.

    >>> "lod" in word_set("identifiers", "production_tokens")
    True
    """
    return frozenset(_read_word_lists(component)[name])


@lru_cache(maxsize=256)
def word_map(component: str, name: str) -> Mapping[str, str]:
    """Return the map `name` from word to word in `knowledge/words/<component>.toml`.

    Raises:
        KeyError: the map is unknown.
        TypeError: it is a list of words.
    """
    words = _read_word_lists(component)[name]
    if not isinstance(words, dict):
        raise TypeError(f"{name} in knowledge/words/{component}.toml is a list; read it with word_set")
    return MappingProxyType(words)


@lru_cache(maxsize=64)
def _read_word_lists(component: str) -> Mapping[str, list[str] | dict[str, str]]:
    lists: dict[str, list[str] | dict[str, str]] = json.loads(read_text(f"words/{component}.json"))
    return lists


_Record = TypeVar("_Record")


def read_settings(component: str, section: str, record: type[_Record]) -> _Record:
    """Return a section of `knowledge/settings/<component>.toml` as a record; lists become tuples.

    The TOML file documents each value.

    Args:
        component: the name of the file.
        section: the name of the section.
        record: a named tuple, made ten times as fast as a dataclass; a dataclass where values are checked.

    Raises:
        KeyError: the section is unknown.
        TypeError: the section and the record have different keys.
    """
    values = _read_settings_file(component)[section]
    if odd := sorted(record.__annotations__.keys() ^ values.keys()):
        where = f"[{section}] in knowledge/settings/{component}.toml"
        raise TypeError(f"{odd[0]} is only in {where} or only in {record.__name__}")
    return record(**{key: tuple(value) if isinstance(value, list) else value for key, value in values.items()})


@lru_cache(maxsize=16)
def _read_settings_file(component: str) -> Mapping[str, Mapping[str, Any]]:
    sections: dict[str, dict[str, Any]] = json.loads(read_text(f"settings/{component}.json"))
    return sections
