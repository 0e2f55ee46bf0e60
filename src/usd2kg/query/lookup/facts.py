"""SceneFacts: what a graph states about its objects, read object by object when it is needed."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any, NamedTuple

import pyoxigraph as ox

from usd2kg.graph.vocabulary import DUL, KNOWROB, OWL, RDF, RDFS, SKOS, SOMA, SSSOM, U2K, USD
from usd2kg.query.answer import Answer
from usd2kg.query.bodies import BodyIndex
from usd2kg.query.body_table import Body, parse_vector
from usd2kg.query.dataset import Dataset
from usd2kg.query.settings import LOOKUP

__all__ = ["Named", "SceneFacts"]


class _Link(NamedTuple):
    """A property that states a relation."""

    predicate: ox.NamedNode
    is_inverse: bool = False
    """Whether the anchor is its subject."""


_NEAR = (DUL.nearTo, KNOWROB.isNextTo, DUL.hasCommonBoundary, U2K.near, U2K.nextTo, U2K.touching)
_RELATIONS = {
    "on": (_Link(SOMA.isOntopOf), _Link(U2K.on)),
    "inside": (_Link(SOMA.isInsideOf), _Link(U2K.inside), _Link(U2K.inRoom)),
    "room": (_Link(U2K.inRoom),),
    "near": tuple(map(_Link, _NEAR)),
    "above": (_Link(KNOWROB.isAboveOf), _Link(U2K.above)),
    "attached": (_Link(U2K.attachedTo),),
    "part": (_Link(SOMA.hasPhysicalComponent, is_inverse=True), _Link(U2K.partOf)),
}
"""Relation → the properties that state it, in both profiles."""
_GENERIC_CLASSES = {OWL.NamedIndividual, USD.Prim, U2K.Object}


class Named(NamedTuple):
    """An object, by its name."""

    iri: str
    label: str
    path: str


class SceneFacts:
    """The facts of one graph, by IRI. Only `objects` and what is based on it read the whole graph."""

    def __init__(self, dataset: Dataset, bodies: BodyIndex) -> None:
        self.dataset = dataset
        self.bodies = bodies
        self._named: dict[str, Named | None] = {}
        self._labels: dict[str, str] = {}

    # Names.

    @cached_property
    def objects(self) -> dict[str, Named]:
        """IRI → object, in the order of prim paths; groups that are rooms by name are included."""
        labels: dict[str, str] = {}
        for subject, label in self._pairs("?s rdfs:label ?v"):
            labels[subject] = min(label, labels.get(subject, label))
        paths = sorted((path, iri) for iri, path in self._pairs("?s u2k:primPath ?v"))
        return {iri: Named(iri, labels.get(iri, _last_name(path)), path) for path, iri in paths}

    def find(self, iri: str) -> Named | None:
        """Return an object; None for anything else, such as a class."""
        if iri not in self._named:
            paths = self._values(iri, U2K.primPath)
            labels = self._values(iri, RDFS.label) or [_last_name(path) for path in paths]
            self._named[iri] = Named(iri, labels[0], paths[0]) if paths else None
        return self._named[iri]

    def path(self, iri: str) -> str:
        """Return the prim path of an object; empty for anything else."""
        found = self.find(iri)
        return found.path if found is not None else ""

    def label(self, iri: str) -> str:
        """Return the name of an object."""
        found = self.find(iri)
        return found.label if found is not None else iri

    def at_path(self, path: str) -> list[str]:
        """Return the objects with a prim path."""
        return self._subjects(U2K.primPath, ox.Literal(path))

    def labelled(self, labels: Iterable[str]) -> set[str]:
        """Return the objects with one of some labels, as written."""
        return {iri for label in labels for iri in self._subjects(RDFS.label, ox.Literal(label)) if self.find(iri)}

    @cached_property
    def by_name(self) -> Mapping[str, list[str]]:
        """Label, prim name or prim path in lower case → objects."""
        found: dict[str, list[str]] = {}
        for iri, label, path in self.objects.values():
            for name in {label.lower(), path.lower(), _last_name(path).lower()}:
                found.setdefault(name, []).append(iri)
        return found

    @cached_property
    def things(self) -> list[str]:
        """The IRIs of objects that are not rooms, floors of rooms by name, or other places."""
        groups = {node.value for node in self.dataset.subjects(RDF.type, U2K.RoomGroup)}
        return [iri for iri in self.objects if iri not in groups]

    def sorted(self, iris: Iterable[str]) -> list[str]:
        """Return the objects among some IRIs, by prim path."""
        named = ((self.path(iri), iri) for iri in set(iris))
        return [iri for path, iri in sorted(named) if path]

    # Kinds.

    def classes(self, iri: str) -> list[str]:
        """Return the classes of an object, without those that every object has."""
        found = self.dataset.objects(ox.NamedNode(iri), RDF.type)
        return sorted(node.value for node in found if node not in _GENERIC_CLASSES and self.label_of(node.value))

    def concept(self, iri: str) -> str | None:
        """Return the concept of an object."""
        return next(iter(self._values(iri, U2K.concept)), None)

    def label_of(self, kind: str) -> str:
        """Return the label of a class or the noun of a concept; empty if there is none."""
        if kind not in self._labels:
            labels = self._values(kind, SKOS.prefLabel) or self._values(kind, RDFS.label)
            self._labels[kind] = labels[0] if labels else ""
        return self._labels[kind]

    def class_labels(self, iri: str) -> list[str]:
        """Return the labels of the classes of an object, sorted."""
        return sorted(map(self.label_of, self.classes(iri)))

    def kind(self, iri: str) -> str:
        """Return what an object is: the noun of its concept, else the label of its class."""
        concept = self.concept(iri)
        if concept is not None and (noun := self.label_of(concept)):
            return noun
        return next(iter(self.class_labels(iri)), "thing")

    def confidences(self, iris: Iterable[str]) -> dict[str, float]:
        """Return object → confidence in its class, for those that have one."""
        wanted = list(iris)
        if len(wanted) > LOOKUP.max_listed:
            known = self._all_confidences
            return {iri: known[iri] for iri in wanted if iri in known}
        found = ((iri, self._confidence(iri)) for iri in wanted)
        return {iri: value for iri, value in found if value is not None}

    def _confidence(self, iri: str) -> float | None:
        for axiom in self.dataset.subjects(OWL.annotatedSource, ox.NamedNode(iri)):
            if RDF.type in self.dataset.objects(axiom, OWL.annotatedProperty):
                for value in self.dataset.objects(axiom, SSSOM.confidence):
                    return _number(value.value) if isinstance(value, ox.Literal) else None
        return None

    @cached_property
    def _all_confidences(self) -> dict[str, float]:
        pattern = "?x owl:annotatedProperty rdf:type ; owl:annotatedSource ?s ; sssom:confidence ?v"
        numbers = ((iri, _number(value)) for iri, value in self._pairs(pattern))
        return {iri: number for iri, number in numbers if number is not None}

    # Looks.

    def materials(self, iri: str) -> list[str]:
        """Return the names of the materials of an object."""
        return self._values(iri, U2K.material)

    def assets(self) -> list[tuple[str, str]]:
        """Return (object, asset) for all objects that have one."""
        return self._pairs("?s u2k:primPath [] ; u2k:asset ?v")

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
        return self._linked(relation, anchor, to_anchor=False)

    def anchors(self, relation: str, iri: str) -> list[str]:
        """Return what an object stands in a relation to, by prim path."""
        return self.sorted(self._linked(relation, iri, to_anchor=True))

    @cached_property
    def supporters(self) -> set[str]:
        """All objects that another is on."""
        return {anchor for _, anchor in self._pairs("?s soma:isOntopOf|u2k:on ?v")}

    def _linked(self, relation: str, iri: str, *, to_anchor: bool) -> set[str]:
        found: set[str] = set()
        for predicate, is_inverse in _RELATIONS[relation]:
            if is_inverse is to_anchor:
                found.update(self._subjects(predicate, ox.NamedNode(iri)))
            else:
                found.update(self._values(iri, predicate))
        return found

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


def _last_name(path: str) -> str:
    return path.rpartition("/")[2]


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _text(cell: Any) -> str:
    return f"{cell:g}" if isinstance(cell, float) else str(cell)
