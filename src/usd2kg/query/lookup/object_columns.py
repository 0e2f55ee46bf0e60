"""Names, kinds and relations of all objects of a graph as columns, kept beside the index of a large graph."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import pyoxigraph as ox
from numpy.typing import NDArray

from usd2kg.graph.vocabulary import DUL, KNOWROB, OWL, RDF, RDFS, SKOS, SOMA, SSSOM, U2K, USD
from usd2kg.query.column_file import Columns, keep_columns, pack_texts, unpack_texts
from usd2kg.query.dataset import Dataset
from usd2kg.words import split_identifier

__all__ = ["NEAR_PROPERTIES", "ObjectColumns", "RowPairs", "load_object_columns"]

_FILE = "objects.npz"
_GENERIC_CLASSES = {OWL.NamedIndividual, USD.Prim, U2K.Object, U2K.DerivedRoom}
_CLASSES_IN_USE = "SELECT DISTINCT ?c WHERE { ?o a ?c }"


class _Link(NamedTuple):
    """A property that states a relation."""

    predicate: ox.NamedNode
    is_inverse: bool = False
    """Whether the anchor is its subject."""


NEAR_PROPERTIES = (DUL.nearTo, KNOWROB.isNextTo, DUL.hasCommonBoundary, U2K.near, U2K.nextTo, U2K.touching)
"""Properties that state that objects are near each other, in both profiles."""
_RELATIONS = {
    "on": (_Link(SOMA.isOntopOf), _Link(U2K.on)),
    "inside": (_Link(SOMA.isInsideOf), _Link(U2K.inside), _Link(U2K.inRoom)),
    "room": (_Link(U2K.inRoom),),
    "near": tuple(map(_Link, NEAR_PROPERTIES)),
    "above": (_Link(KNOWROB.isAboveOf), _Link(U2K.above)),
    "attached": (_Link(U2K.attachedTo),),
    "left": (_Link(KNOWROB.isLeftOf), _Link(U2K.leftOf)),
    "right": (_Link(KNOWROB.isRightOf), _Link(U2K.rightOf)),
    "front": (_Link(KNOWROB.isInFrontOf), _Link(U2K.inFrontOf)),
    "behind": (_Link(KNOWROB.isBehindOf), _Link(U2K.behind)),
    "part": (_Link(SOMA.hasPhysicalComponent, is_inverse=True), _Link(U2K.partOf)),
}
"""Relation → the properties that state it, in both profiles."""
_TEXTS = ("iris", "labels", "paths", "kinds", "assets", "words")
_PAIRS = ("of_class", "of_concept", "of_asset")


class _Groups(NamedTuple):
    """Row numbers by row."""

    starts: list[int]
    """Row → index of its first value; the last is the number of values."""
    values: list[int]


class RowPairs:
    """Pairs of row numbers, for lookups in both directions."""

    def __init__(self, pairs: NDArray[np.int32]) -> None:
        """Wrap (m, 2) pairs, each once, in ascending order."""
        self.pairs = pairs

    def of_first(self, row: int) -> list[int]:
        """Return the second rows of a first row, ascending."""
        return _slice(self._forward, row)

    def of_second(self, row: int) -> list[int]:
        """Return the first rows of a second row, ascending."""
        return _slice(self._backward, row)

    @cached_property
    def _forward(self) -> _Groups:
        return _group(self.pairs[:, 0], self.pairs[:, 1])

    @cached_property
    def _backward(self) -> _Groups:
        inverse = self.pairs[np.lexsort((self.pairs[:, 0], self.pairs[:, 1]))]
        return _group(inverse[:, 1], inverse[:, 0])


def _group(keys: NDArray[np.int32], values: NDArray[np.int32]) -> _Groups:
    """Return the values by their keys, which ascend."""
    most = int(keys[-1]) if len(keys) else -1
    # Lists: one row is looked up at a time, which takes arrays a hundred times as long.
    starts: list[int] = np.searchsorted(np.ascontiguousarray(keys), np.arange(most + 2)).tolist()
    return _Groups(starts, values.tolist())


def _slice(groups: _Groups, row: int) -> list[int]:
    return groups.values[groups.starts[row] : groups.starts[row + 1]] if row < len(groups.starts) - 1 else []


@dataclass(frozen=True)
class ObjectColumns:
    """The n objects of a graph, by prim path; groups that are rooms by name, and rooms without a prim, are included."""

    iris: list[str]
    labels: list[str]
    paths: list[str]
    """Prim path; the label of a room without a prim."""
    kinds: list[str]
    """IRIs of the classes and concepts of objects, without classes that every object has."""
    assets: list[str]
    words: list[str]
    """The words of all labels in lower case, sorted."""
    is_group: NDArray[np.bool_]
    """(n,)"""
    confidence: NDArray[np.float64]
    """(n,): confidence in the class; NaN where none is stated."""
    concept_confidence: NDArray[np.float64]
    """(n,): confidence in the concept; NaN where none is stated."""
    of_class: RowPairs
    """Object, class."""
    of_concept: RowPairs
    """Object, concept."""
    of_asset: RowPairs
    """Object, asset."""
    relations: Mapping[str, RowPairs]
    """Relation → object, anchor."""

    @cached_property
    def rows(self) -> dict[str, int]:
        """IRI → row."""
        return {iri: row for row, iri in enumerate(self.iris)}


def load_object_columns(dataset: Dataset) -> ObjectColumns:
    """Return the columns of a dataset: from its folder, if it has one, where the first call leaves it."""
    path = None if dataset.folder is None else dataset.folder / _FILE
    return keep_columns(path, _from_columns, lambda: _ColumnReader(dataset).table(), _to_columns)


class _ColumnReader:
    """Reads the objects of a dataset property by property, which is faster than object by object."""

    def __init__(self, dataset: Dataset) -> None:
        self._dataset = dataset
        self._labels = _smallest(dataset.pairs(RDFS.label))
        self._derived_rooms = {node.value for node in dataset.subjects(RDF.type, U2K.DerivedRoom)}
        # A room without a prim is found by its name.
        paths = {iri: self._labels[iri] for iri in self._derived_rooms if iri in self._labels}
        paths.update(_smallest(dataset.pairs(U2K.primPath)))
        ordered = sorted((path, iri) for iri, path in paths.items())
        self._iris = [iri for _, iri in ordered]
        self._paths = [path for path, _ in ordered]
        self._rows = {iri: row for row, iri in enumerate(self._iris)}

    def table(self) -> ObjectColumns:
        named = [
            self._labels.get(iri, path.rpartition("/")[2]) for iri, path in zip(self._iris, self._paths, strict=True)
        ]
        groups = {node.value for node in self._dataset.subjects(RDF.type, U2K.RoomGroup)} | self._derived_rooms
        classes, concepts, assets = (
            [pair for pair in pairs if pair[0] in self._rows]
            for pairs in (self._typed(), self._dataset.pairs(U2K.concept), self._dataset.pairs(U2K.asset))
        )
        kinds, files = (sorted({value for _, value in pairs}) for pairs in ([*classes, *concepts], assets))
        return ObjectColumns(
            self._iris,
            named,
            self._paths,
            of_class=self._to_values(classes, kinds),
            of_concept=self._to_values(concepts, kinds),
            of_asset=self._to_values(assets, files),
            kinds=kinds,
            assets=files,
            words=sorted({word.lower() for label in named for word in split_identifier(label)}),
            is_group=np.array([iri in groups for iri in self._iris], dtype=bool),
            confidence=self._confidences(),
            concept_confidence=self._numbers(U2K.conceptConfidence),
            relations={name: self._related(links) for name, links in _RELATIONS.items()},
        )

    def _typed(self) -> Iterator[tuple[str, str]]:
        """Yield the objects with their classes that have a label."""
        classes = [row["c"] for row in self._dataset.select(_CLASSES_IN_USE)]
        for node in sorted((c for c in classes if isinstance(c, ox.NamedNode)), key=str):
            is_named = self._dataset.objects(node, RDFS.label) or self._dataset.objects(node, SKOS.prefLabel)
            if node not in _GENERIC_CLASSES and is_named:
                yield from ((subject.value, node.value) for subject in self._dataset.subjects(RDF.type, node))

    def _numbers(self, predicate: ox.NamedNode) -> NDArray[np.float64]:
        found = np.full(len(self._iris), np.nan)
        for node, value in self._dataset.quads(predicate):
            row = self._rows.get(getattr(node, "value", ""))
            if row is not None:
                found[row] = _number(value)
        return found

    def _confidences(self) -> NDArray[np.float64]:
        found = np.full(len(self._iris), np.nan)
        about = set(self._dataset.subjects(OWL.annotatedProperty, RDF.type))
        for axiom, value in self._dataset.quads(SSSOM.confidence):
            if axiom in about:
                for source in self._dataset.objects(axiom, OWL.annotatedSource):
                    row = self._rows.get(getattr(source, "value", ""))
                    if row is not None:
                        found[row] = _number(value)
        return found

    def _to_values(self, pairs: Iterable[tuple[str, str]], values: Sequence[str]) -> RowPairs:
        """Return object and value as rows."""
        rows = {value: row for row, value in enumerate(values)}
        return _sorted_pairs((self._rows[iri], rows[value]) for iri, value in pairs)

    def _related(self, links: Iterable[_Link]) -> RowPairs:
        rows = self._rows
        stated = (
            (anchor, iri) if link.is_inverse else (iri, anchor)
            for link in links
            for iri, anchor in self._dataset.pairs(link.predicate)
        )
        return _sorted_pairs((rows[iri], rows[anchor]) for iri, anchor in stated if iri in rows and anchor in rows)


def _number(term: object) -> float:
    """Return the number of a literal; NaN for anything else."""
    try:
        return float(term.value) if isinstance(term, ox.Literal) else math.nan
    except ValueError:
        return math.nan


def _smallest(pairs: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Return subject → value; of several, the first in the order of text."""
    found: dict[str, str] = {}
    for subject, value in pairs:
        found[subject] = min(value, found.get(subject, value))
    return found


def _sorted_pairs(pairs: Iterable[tuple[int, int]]) -> RowPairs:
    return RowPairs(np.array(sorted(set(pairs)), dtype=np.int32).reshape(-1, 2))


def _to_columns(table: ObjectColumns) -> Columns:
    if not table.iris:
        return {}
    return {
        **{name: pack_texts(getattr(table, name)) for name in _TEXTS},
        **{name: getattr(table, name).pairs for name in _PAIRS},
        **{f"relation {name}": pairs.pairs for name, pairs in table.relations.items()},
        "is_group": table.is_group,
        "confidence": table.confidence,
        "concept_confidence": table.concept_confidence,
    }


def _from_columns(columns: Columns) -> ObjectColumns:
    texts: dict[str, Any] = {name: unpack_texts(columns[name]) for name in _TEXTS}
    sizes = {len(texts["iris"]), len(texts["labels"]), len(texts["paths"]), len(columns["confidence"])}
    if len(sizes) != 1:
        raise ValueError(f"columns of different lengths: {sorted(sizes)}")
    return ObjectColumns(
        **texts,
        of_class=RowPairs(columns["of_class"]),
        of_concept=RowPairs(columns["of_concept"]),
        of_asset=RowPairs(columns["of_asset"]),
        is_group=columns["is_group"],
        confidence=columns["confidence"],
        concept_confidence=columns["concept_confidence"],
        relations={name: RowPairs(columns[f"relation {name}"]) for name in _RELATIONS},
    )
