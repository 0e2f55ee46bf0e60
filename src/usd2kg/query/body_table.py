"""Boxes, extents and masses of all objects of a graph as arrays, kept beside the index of a large graph."""

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyoxigraph as ox
from numpy.typing import NDArray

from usd2kg.graph.vocabulary import DUL, SOMA, U2K
from usd2kg.query.column_file import Columns, keep_columns, pack_texts, unpack_texts
from usd2kg.query.dataset import Dataset

__all__ = ["NO_BODY", "Body", "BodyTable", "load_table", "parse_number_term", "parse_vector"]

Vector = NDArray[np.float64]

_FILE = "boxes.npz"
_NUMBERS = ("lower", "upper", "extents", "mass")
_SHELLS = ("shell_rows", "shells")

_PROPERTIES = {
    "object": (U2K.primPath,),
    "shape": (SOMA.hasShape,),
    "region": (DUL.hasRegion,),
    "mass attribute": (SOMA.hasMassAttribute,),
    "center": (U2K.boxCenter,),
    "width": (SOMA.hasDepth, U2K.width),
    "depth": (SOMA.hasWidth, U2K.depth),
    "height": (SOMA.hasHeight, U2K.height),
    "oriented": (U2K.orientedSize,),
    "shell": (U2K.shellBoxes,),
    "mass": (SOMA.hasMassValue, U2K.mass),
}
"""What is read → properties that state it. They are joined here, which is ten times as fast as one query."""


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
    return keep_columns(path, _from_columns, lambda: _read(dataset), _to_columns)


def _read(dataset: Dataset) -> BodyTable:
    values = {name: _values(dataset, properties) for name, properties in _PROPERTIES.items()}
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


def _values(dataset: Dataset, properties: Iterable[ox.NamedNode]) -> dict[Any, Any]:
    """Return subject → value of some properties; of several values, the first in the order of their text."""
    found: dict[Any, Any] = {}
    for subject, value in (pair for one in properties for pair in dataset.quads(one)):
        known = found.setdefault(subject, value)
        if known is not value and str(value) < str(known):
            found[subject] = value
    return found


def _vector(term: Any) -> Vector | None:
    return parse_vector(term.value) if isinstance(term, ox.Literal) else None


def _from_columns(columns: Columns) -> BodyTable:
    iris = unpack_texts(columns["iris"])
    numbers = [columns[name] for name in _NUMBERS]
    if any(len(iris) != len(column) for column in numbers):
        raise ValueError(f"{len(iris)} objects, other numbers of values")
    return BodyTable(iris, *numbers, *(columns[name] for name in _SHELLS))


def _to_columns(table: BodyTable) -> Columns:
    if not table.iris:
        return {}
    return {"iris": pack_texts(table.iris), **{name: getattr(table, name) for name in (*_NUMBERS, *_SHELLS)}}
