"""SceneFacts: what a graph states about its objects, read when it is needed."""

import math
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np
import pyoxigraph as ox

from usd2kg.graph.vocabulary import RDFS, SKOS, U2K, USD
from usd2kg.query.answer import Answer
from usd2kg.query.bodies import BodyIndex
from usd2kg.query.body_table import Body, parse_vector
from usd2kg.query.dataset import Dataset
from usd2kg.query.lookup.object_columns import ObjectColumns, RowPairs, load_object_columns
from usd2kg.query.lookup.word_forms import common_stem

__all__ = ["SceneFacts"]


class SceneFacts:
    """The facts of one graph, by IRI. Names, kinds and relations are columns; looks are read per object."""

    def __init__(self, dataset: Dataset, bodies: BodyIndex) -> None:
        self.dataset = dataset
        self.bodies = bodies
        self._labels: dict[str, str] = {}

    @cached_property
    def columns(self) -> ObjectColumns:
        """The names, kinds and relations of all objects; groups that are rooms by name are included."""
        return load_object_columns(self.dataset)

    # Names.

    def path(self, iri: str) -> str:
        """Return the prim path of an object; empty for anything else."""
        row = self.columns.rows.get(iri)
        return "" if row is None else self.columns.paths[row]

    def label(self, iri: str) -> str:
        """Return the name of an object."""
        row = self.columns.rows.get(iri)
        return iri if row is None else self.columns.labels[row]

    def at_path(self, path: str) -> list[str]:
        """Return the objects with a prim path."""
        return self._subjects(U2K.primPath, ox.Literal(path))

    def labelled(self, labels: Iterable[str]) -> set[str]:
        """Return the objects with one of some labels, as written."""
        wanted = set(labels)
        return {iri for iri, label in zip(self.columns.iris, self.columns.labels, strict=True) if label in wanted}

    def named(self, name: str) -> list[str]:
        """Return the objects with a label, prim name or prim path, given in lower case."""
        columns, end = self.columns, f"/{name}"
        return [
            iri
            for iri, label, path in zip(columns.iris, self._lower_labels, self._lower_paths, strict=True)
            if name in (label, path) or path.endswith(end)
        ]

    def with_words(self, words: Iterable[str]) -> Iterator[tuple[str, str]]:
        """Yield the objects and labels whose label may contain all the words, see `name_words`."""
        stems = [common_stem(word) for word in words]
        columns = self.columns
        for iri, label, lower in zip(columns.iris, columns.labels, self._lower_labels, strict=True):
            if all(stem in lower for stem in stems):
                yield iri, label

    def below(self, iri: str) -> list[str]:
        """Return the things below the prim of an object."""
        columns, above = self.columns, f"{self.path(iri)}/"
        # Objects are in the order of their paths.
        start, end = bisect_left(columns.paths, above), bisect_left(columns.paths, f"{above}\U0010ffff")
        return [columns.iris[row] for row in range(start, end) if not columns.is_group[row]]

    def below_group(self, name: str) -> list[str]:
        """Return the objects below a group, named in lower case; the root and its children are not groups."""
        part = f"/{name}/"
        found = zip(self.columns.iris, self._lower_paths, strict=True)
        return [iri for iri, path in found if part in path and name in path.split("/")[2:-1]]

    @cached_property
    def _lower_labels(self) -> list[str]:
        return [label.lower() for label in self.columns.labels]

    @cached_property
    def _lower_paths(self) -> list[str]:
        return [path.lower() for path in self.columns.paths]

    @cached_property
    def things(self) -> list[str]:
        """The IRIs of objects that are no places, such as rooms and floors that are named like rooms."""
        return [iri for iri, is_group in zip(self.columns.iris, self.columns.is_group, strict=True) if not is_group]

    def sorted(self, iris: Iterable[str]) -> list[str]:
        """Return the objects among some IRIs, by prim path."""
        rows = self.columns.rows
        return self._iris(sorted({rows[iri] for iri in iris if iri in rows}))

    # Kinds.

    def classes(self, iri: str) -> list[str]:
        """Return the classes of an object, without those that every object has."""
        return self._kinds_of(iri, self.columns.of_class)

    def concept(self, iri: str) -> str | None:
        """Return the concept of an object."""
        return next(iter(self._kinds_of(iri, self.columns.of_concept)), None)

    def members(self, kinds: Iterable[str]) -> dict[str, float]:
        """Return the objects with one of some classes or concepts, and the confidence in it; 1 if none is stated."""
        columns, found = self.columns, dict[str, float]()
        rows = [self._kind_rows[kind] for kind in kinds if kind in self._kind_rows]
        for pairs, stated in ((columns.of_class, columns.confidence), (columns.of_concept, columns.concept_confidence)):
            for row in (row for kind in rows for row in pairs.of_second(kind)):
                sure = 1.0 if math.isnan(stated[row]) else float(stated[row])
                iri = columns.iris[row]
                found[iri] = max(sure, found.get(iri, 0.0))
        return found

    @cached_property
    def _kind_rows(self) -> dict[str, int]:
        return {kind: row for row, kind in enumerate(self.columns.kinds)}

    def _kinds_of(self, iri: str, pairs: RowPairs) -> list[str]:
        row = self.columns.rows.get(iri)
        return [] if row is None else [self.columns.kinds[kind] for kind in pairs.of_first(row)]

    def label_of(self, kind: str) -> str:
        """Return the label of a class or the noun of a concept; empty if there is none."""
        if kind not in self._labels:
            labels = self._values(kind, SKOS.prefLabel) or self._values(kind, RDFS.label)
            self._labels[kind] = labels[0] if labels else ""
        return self._labels[kind]

    def used_labels(self) -> list[str]:
        """Return the labels of the classes of objects, sorted."""
        used = np.unique(self.columns.of_class.pairs[:, 1]).tolist()
        return sorted({self.label_of(self.columns.kinds[kind]) for kind in used})

    def class_counts(self) -> Counter[str]:
        """Return label of a class → number of things of it, without those of its subclasses."""
        objects, kinds = self.columns.of_class.pairs.T
        used, counts = np.unique(kinds[~self.columns.is_group[objects]], return_counts=True)
        found: Counter[str] = Counter()
        for kind, count in zip(used.tolist(), counts.tolist(), strict=True):
            found[self.label_of(self.columns.kinds[kind])] += count
        return found

    def class_labels(self, iri: str) -> list[str]:
        """Return the labels of the classes of an object, sorted."""
        return sorted(map(self.label_of, self.classes(iri)))

    def kind(self, iri: str) -> str:
        """Return what an object is: the noun of its concept, else the label of its class, room for a group."""
        concept = self.concept(iri)
        if concept is not None and (noun := self.label_of(concept)):
            return noun
        return next(iter(self.class_labels(iri)), "room" if iri in self.rooms else "thing")

    def confidences(self, iris: Iterable[str]) -> dict[str, float]:
        """Return object → confidence in its class, for those that have one."""
        rows, known = self.columns.rows, self.columns.confidence
        found = ((iri, float(known[rows[iri]])) for iri in iris if iri in rows)
        return {iri: value for iri, value in found if not math.isnan(value)}

    # Looks.

    def materials(self, iri: str) -> list[str]:
        """Return the names of the materials of an object."""
        return self._values(iri, U2K.material)

    def assets(self) -> Iterator[tuple[str, list[str]]]:
        """Yield each asset with its objects."""
        columns = self.columns
        for row, asset in enumerate(columns.assets):
            yield asset, self._iris(columns.of_asset.of_second(row))

    def color(self, iri: str) -> tuple[float, float, float] | None:
        """Return the linear red, green and blue of an object, 0 to 1."""
        texts = self._values(iri, U2K.color)
        texts += [
            value.value for node in self._colors_of(iri) for value in self._objects(node, USD.primvars_displayColor)
        ]
        parsed = (parse_vector(text.strip("[]").replace(",", " ")) for text in texts)
        return next(((float(rgb[0]), float(rgb[1]), float(rgb[2])) for rgb in parsed if rgb is not None), None)

    def color_source(self, iri: str) -> str:
        """Return the material that the colour of an object comes from; empty if unknown."""
        nodes = (ox.NamedNode(iri), *self._colors_of(iri))
        return min((text.value for node in nodes for text in self._objects(node, U2K.colorSource)), default="")

    def _colors_of(self, iri: str) -> list[Any]:
        return self._objects(ox.NamedNode(iri), USD.hasColor)

    def count(self, pattern: str) -> int:
        """Return the number of objects `?s` that match a SPARQL pattern."""
        query = f"SELECT (COUNT(DISTINCT ?s) AS ?n) WHERE {{ ?s u2k:primPath [] . {pattern} }}"
        return int(self.dataset.select(query)[0]["n"].value)

    @cached_property
    def rooms(self) -> list[str]:
        """The rooms that objects are in, by prim path."""
        return self._iris(np.unique(self.columns.relations["room"].pairs[:, 1]).tolist())

    # Joints.

    @cached_property
    def has_joints(self) -> bool:
        """Whether the graph has joints that move."""
        return bool(self._pairs("?s u2k:definingPrim ?v"))

    @cached_property
    def opened_by_joint(self) -> set[str]:
        """Objects that a movable joint belongs to or moves."""
        link = "soma:hasChildLink|u2k:childObject|^soma:hasPhysicalComponent|^u2k:hasJoint"
        kinds = "soma:RevoluteJoint, u2k:RevoluteJoint, soma:PrismaticJoint, u2k:PrismaticJoint"
        return {v for _, v in self._pairs(f"?s u2k:definingPrim ?p ; a ?t ; {link} ?v . FILTER(?t IN ({kinds}))")}

    # Relations.

    def related(self, relation: str, anchor: str) -> set[str]:
        """Return the objects that stand in a relation to an anchor."""
        row = self.columns.rows.get(anchor)
        return set() if row is None else set(self._iris(self.columns.relations[relation].of_second(row)))

    def anchors(self, relation: str, iri: str) -> list[str]:
        """Return what an object stands in a relation to, by prim path."""
        row = self.columns.rows.get(iri)
        return [] if row is None else self._iris(self.columns.relations[relation].of_first(row))

    @cached_property
    def supporters(self) -> set[str]:
        """All objects that another is on."""
        return set(self._iris(np.unique(self.columns.relations["on"].pairs[:, 1]).tolist()))

    def _iris(self, rows: Iterable[int]) -> list[str]:
        iris = self.columns.iris
        return [iris[row] for row in rows]

    def body(self, iri: str) -> Body:
        """Return the box, extents and mass of an object."""
        return self.bodies.find(iri)

    def table(self, iris: Iterable[str], **columns: Mapping[str, Any]) -> Answer:
        """Return objects as rows: name, class, path, and further columns by IRI."""
        rows = []
        for iri in dict.fromkeys(iris):
            label = next(iter(self.class_labels(iri)), None)
            rows.append((self.label(iri), label, self.path(iri), *(c.get(iri) for c in columns.values())))
        texts = tuple(tuple(None if cell is None else _text(cell) for cell in row) for row in rows)
        return Answer(("object", "class", "path", *columns), texts, tuple(rows), "")

    def _values(self, iri: str, predicate: ox.NamedNode) -> list[str]:
        """Return the values of a property as text, sorted."""
        return sorted(term.value for term in self._objects(ox.NamedNode(iri), predicate) if _is_value(term))

    def _objects(self, node: Any, predicate: ox.NamedNode) -> list[Any]:
        return self.dataset.objects(node, predicate)

    def _subjects(self, predicate: ox.NamedNode, value: ox.NamedNode | ox.Literal) -> list[str]:
        return sorted(node.value for node in self.dataset.subjects(predicate, value) if isinstance(node, ox.NamedNode))

    def _pairs(self, pattern: str) -> list[tuple[str, str]]:
        rows = self.dataset.select(f"SELECT DISTINCT ?s ?v WHERE {{ {pattern} }}")
        named = ((row["s"], row["v"]) for row in rows if isinstance(row["s"], ox.NamedNode))
        return [(str(subject.value), str(value.value)) for subject, value in named if _is_value(value)]


def _is_value(term: Any) -> bool:
    """Return whether a term has a text that denotes it in any graph: no blank node, no triple term."""
    return isinstance(term, ox.NamedNode | ox.Literal)


def _text(cell: Any) -> str:
    return f"{cell:g}" if isinstance(cell, float) else str(cell)
