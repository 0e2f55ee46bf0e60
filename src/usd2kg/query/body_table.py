"""Boxes, extents and masses of all objects of a graph as arrays, kept beside the index of a large graph."""

import logging
import math
import os
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyoxigraph as ox
from numpy.typing import NDArray

from usd2kg.query.dataset import Dataset

__all__ = ["NO_BODY", "Body", "BodyTable", "load_table", "parse_number_term", "parse_vector"]

logger = logging.getLogger(__name__)

Vector = NDArray[np.float64]

_FILE = "bodies.npz"
_NUMBERS = ("lower", "upper", "extents", "mass")
_SHELLS = ("shell_rows", "shells")

# Simple patterns, joined here: the engine takes ten times as long for one query with all of them.
_PATHS = {
    "object": "?s u2k:primPath ?v",
    "shape": "?s soma:hasShape ?v",
    "region": "?s dul:hasRegion ?v",
    "mass attribute": "?s soma:hasMassAttribute ?v",
    "center": "?s u2k:boxCenter ?v",
    "width": "?s soma:hasDepth|u2k:width ?v",
    "depth": "?s soma:hasWidth|u2k:depth ?v",
    "height": "?s soma:hasHeight|u2k:height ?v",
    "oriented": "?s u2k:orientedSize ?v",
    "shell": "?s u2k:shellBoxes ?v",
    "mass": "?s soma:hasMassValue|u2k:mass ?v",
}


@dataclass(frozen=True)
class Body:
    """Size and mass of one object, as far as the graph states them."""

    lower: Vector | None
    """(3,) metres, world frame: lower corner of the AABB; None without a box."""
    upper: Vector | None
    extents: tuple[float, float, float] | None
    """Metres, ascending; along the object's own axes if known."""
    mass: float | None
    """Kilograms; None if unknown."""
    shell: tuple[Vector, ...] = ()
    """(6,) metres each: lower and upper corners of boxes that cover the surface of a hollow object; else empty."""


NO_BODY = Body(None, None, None, None)


@dataclass(frozen=True)
class BodyTable:
    """The bodies of n objects; NaN is unknown."""

    iris: list[str]
    """In ascending order."""
    lower: Vector
    """(n, 3) metres, world frame."""
    upper: Vector
    """(n, 3) metres, world frame."""
    extents: Vector
    """(n, 3) metres, ascending."""
    mass: Vector
    """(n,) kilograms."""
    shell_rows: NDArray[np.int64]
    """(m,): the object of each box of a shell, ascending."""
    shells: Vector
    """(m, 6) metres, world frame: lower and upper corners of boxes that cover the surfaces of hollow objects."""

    def body(self, row: int) -> Body:
        """Return the body of one object."""
        mass = None if math.isnan(self.mass[row]) else float(self.mass[row])
        if math.isnan(self.lower[row, 0]):
            return Body(None, None, None, mass)
        shortest, middle, longest = self.extents[row].tolist()
        first, last = np.searchsorted(self.shell_rows, (row, row + 1))
        shell = tuple(self.shells[first:last])
        return Body(self.lower[row], self.upper[row], (shortest, middle, longest), mass, shell)


def parse_vector(text: str, size: int = 3) -> Vector | None:
    """Return the vector written as "x y z"; None if the text is not `size` finite numbers.

    >>> parse_vector("1 2.5 0")
    array([1. , 2.5, 0. ])
    >>> parse_vector("1 two 3") is None
    True
    """
    try:
        values = np.array([float(part) for part in text.split()])
    except ValueError:
        return None
    return values if values.shape == (size,) and bool(np.isfinite(values).all()) else None


def parse_number_term(term: ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple | None) -> float | None:
    """Return the value of a literal that is a finite number, else None."""
    if not isinstance(term, ox.Literal):
        return None
    try:
        value = float(term.value)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def load_table(dataset: Dataset) -> BodyTable:
    """Return the table of a dataset: from its folder, if it has one, where the first call leaves it."""
    path = None if dataset.folder is None else dataset.folder / _FILE
    if path is not None and path.is_file():
        try:
            return _load(path)
        except (OSError, ValueError, KeyError, zipfile.BadZipFile) as error:
            logger.warning("%s: is damaged and is made again (%s)", path, error)
    table = _read(dataset)
    if path is not None:
        with suppress(OSError):
            _save(table, path)
    return table


def _read(dataset: Dataset) -> BodyTable:
    values = {name: _values(dataset, pattern) for name, pattern in _PATHS.items()}
    owners = {region: obj for obj, shape in values["shape"].items() if (region := values["region"].get(shape))}
    owners.update({attribute: obj for obj, attribute in values["mass attribute"].items()})

    def of_objects(name: str) -> Mapping[Any, Any]:
        return {owners.get(subject, subject): value for subject, value in values[name].items()}

    columns = {name: of_objects(name) for name in ("center", "width", "depth", "height", "oriented", "shell", "mass")}
    objects = sorted(values["object"], key=lambda node: str(node.value))
    count = len(objects)
    lower, upper, extents = (np.full((count, 3), np.nan) for _ in range(3))
    mass = np.full(count, np.nan)
    shells: list[tuple[int, Vector]] = []
    for row, node in enumerate(objects):
        kilograms = parse_number_term(columns["mass"].get(node))
        mass[row] = math.nan if kilograms is None else kilograms
        middle = _vector(columns["center"].get(node))
        if middle is None:
            continue
        size = np.array([parse_number_term(columns[name].get(node)) or 0.0 for name in ("width", "depth", "height")])
        lower[row], upper[row] = middle - size / 2, middle + size / 2
        oriented = _vector(columns["oriented"].get(node))
        extents[row] = np.sort(size if oriented is None else oriented)
        shells += [(row, box) for box in _boxes(columns["shell"].get(node))]
    return BodyTable(
        [node.value for node in objects],
        *(lower, upper, extents, mass),
        np.array([row for row, _ in shells], dtype=np.int64),
        np.array([box for _, box in shells]).reshape(-1, 6),
    )


def _boxes(term: Any) -> Iterator[Vector]:
    """Yield the boxes written as "x y z x y z; …", without malformed ones."""
    parts = term.value.split(";") if isinstance(term, ox.Literal) else ()
    yield from (box for part in parts if (box := parse_vector(part, 6)) is not None)


def _values(dataset: Dataset, pattern: str) -> dict[Any, Any]:
    """Return subject → value of a property; of several values, the first in the order of their text."""
    found: dict[Any, Any] = {}
    for row in dataset.select(f"SELECT ?s ?v WHERE {{ {pattern} }}"):
        subject, value = row
        known = found.setdefault(subject, value)
        if known is not value and str(value) < str(known):
            found[subject] = value
    return found


def _vector(term: Any) -> Vector | None:
    return parse_vector(term.value) if isinstance(term, ox.Literal) else None


def _load(path: Path) -> BodyTable:
    with np.load(path, allow_pickle=False) as file:
        iris = file["iris"].tobytes().decode().split("\n")
        numbers = [file[name] for name in _NUMBERS]
        shells = [file[name] for name in _SHELLS]
    if any(len(iris) != len(column) for column in numbers):
        raise ValueError(f"{len(iris)} objects, other numbers of values")
    return BodyTable(iris, *numbers, *shells)


def _save(table: BodyTable, path: Path) -> None:
    if not table.iris:
        return
    iris = np.frombuffer("\n".join(table.iris).encode(), dtype=np.uint8)
    # Two processes may write at the same time.
    handle, name = tempfile.mkstemp(suffix=".npz", dir=path.parent)
    os.close(handle)
    try:
        np.savez(name, iris=iris, **{column: getattr(table, column) for column in (*_NUMBERS, *_SHELLS)})
        Path(name).replace(path)
    finally:
        Path(name).unlink(missing_ok=True)
