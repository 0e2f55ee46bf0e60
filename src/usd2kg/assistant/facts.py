"""SceneFacts: what a graph states about its objects, read property by property when it is needed."""

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any, NamedTuple

from usd2kg.query import Answer, GraphStore
from usd2kg.query.body_table import Body, parse_vector

__all__ = ["Named", "SceneFacts"]

_RELATIONS = {
    "on": "soma:isOntopOf|u2k:on",
    "inside": "soma:isInsideOf|u2k:inside|u2k:inRoom",
    "room": "u2k:inRoom",
    "near": "dul:nearTo|knowrob:isNextTo|dul:hasCommonBoundary|u2k:near|u2k:nextTo|u2k:touching",
    "above": "knowrob:isAboveOf|u2k:above",
    "attached": "u2k:attachedTo",
    "part": "^soma:hasPhysicalComponent|u2k:partOf",
}
"""Relation → property path from an object to its anchor, in both profiles."""


class Named(NamedTuple):
    """An object, by its name."""

    iri: str
    label: str
    path: str


class SceneFacts:
    """The facts of one graph, by IRI."""

    def __init__(self, graph: GraphStore) -> None:
        self.graph = graph

    @cached_property
    def objects(self) -> dict[str, Named]:
        """IRI → object, in the order of prim paths; groups that are rooms by name are included."""
        labels = self._first("?s rdfs:label ?v")
        paths = sorted((path, iri) for iri, path in self._first("?s u2k:primPath ?v").items())
        return {iri: Named(iri, labels.get(iri, path.rpartition("/")[2]), path) for path, iri in paths}

    @cached_property
    def things(self) -> list[str]:
        """The IRIs of objects that are not rooms, floors of rooms by name, or other places."""
        groups = {s for s, _ in self._pairs("?s a u2k:RoomGroup . BIND(1 AS ?v)")}
        return [iri for iri in self.objects if iri not in groups]

    @cached_property
    def classes(self) -> dict[str, set[str]]:
        """Object → its classes."""
        found: dict[str, set[str]] = {}
        for iri, cls in self._pairs("?s u2k:primPath [] ; a ?v . ?v rdfs:label ?l"):
            found.setdefault(iri, set()).add(cls)
        return found

    @cached_property
    def class_labels(self) -> dict[str, str]:
        """Class → label."""
        return self._first("?s a owl:Class ; rdfs:label ?v")

    @cached_property
    def concepts(self) -> dict[str, str]:
        """Object → its concept."""
        return self._first("?s u2k:primPath [] ; u2k:concept ?v")

    @cached_property
    def concept_labels(self) -> dict[str, str]:
        """Concept → noun."""
        return self._first("?s a skos:Concept ; skos:prefLabel ?v")

    @cached_property
    def confidences(self) -> dict[str, float]:
        """Object → confidence in its class."""
        pattern = "?x owl:annotatedProperty rdf:type ; owl:annotatedSource ?s ; sssom:confidence ?v"
        return {iri: float(value) for iri, value in self._pairs(pattern)}

    @cached_property
    def materials(self) -> dict[str, list[str]]:
        """Object → the names of its materials."""
        found: dict[str, list[str]] = {}
        for iri, name in self._pairs("?s u2k:material ?v"):
            found.setdefault(iri, []).append(name)
        return {iri: sorted(names) for iri, names in found.items()}

    @cached_property
    def colors(self) -> dict[str, tuple[float, float, float]]:
        """Object → linear red, green and blue, 0 to 1."""
        found = {**self._first("?s usd:hasColor/usd:primvars_displayColor ?v"), **self._first("?s u2k:color ?v")}
        parsed = {iri: parse_vector(text.strip("[]").replace(",", " ")) for iri, text in found.items()}
        return {iri: tuple(rgb.tolist()) for iri, rgb in parsed.items() if rgb is not None}

    @cached_property
    def color_sources(self) -> dict[str, str]:
        """Object → the material that its colour comes from."""
        return self._first("?s (usd:hasColor)?/u2k:colorSource ?v")

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

    def related(self, relation: str) -> Mapping[str, set[str]]:
        """Return anchor → the objects that stand in a relation to it."""
        known = self._relations.setdefault(relation, {})
        if not known:
            for iri, anchor in self._pairs(f"?s {_RELATIONS[relation]} ?v"):
                known.setdefault(anchor, set()).add(iri)
        return known

    def anchors(self, relation: str, iri: str) -> list[str]:
        """Return what an object stands in a relation to, by prim path."""
        return self.sorted(anchor for anchor, found in self.related(relation).items() if iri in found)

    @cached_property
    def _relations(self) -> dict[str, dict[str, set[str]]]:
        return {}

    def below(self, iris: Iterable[str], predicate: str) -> set[str]:
        """Return classes or concepts and everything below them, along `rdfs:subClassOf` or `skos:broader`."""
        children = self._children(predicate)
        found: set[str] = set()
        waiting = [*iris]
        while waiting:
            iri = waiting.pop()
            if iri not in found:
                found.add(iri)
                waiting.extend(children.get(iri, ()))
        return found

    def _children(self, predicate: str) -> Mapping[str, set[str]]:
        known = self._hierarchies.get(predicate)
        if known is None:
            known = self._hierarchies[predicate] = {}
            for child, parent in self._pairs(f"?s {predicate} ?v"):
                known.setdefault(parent, set()).add(child)
        return known

    @cached_property
    def _hierarchies(self) -> dict[str, dict[str, set[str]]]:
        return {}

    def body(self, iri: str) -> Body:
        """Return the box, extents and mass of an object."""
        return self.graph.bodies.find(iri)

    def sorted(self, iris: Iterable[str]) -> list[str]:
        """Return the objects among some IRIs, by prim path."""
        wanted = set(iris)
        return [iri for iri in self.objects if iri in wanted]

    def label(self, iri: str) -> str:
        """Return the name of an object."""
        return self.objects[iri].label

    def kind(self, iri: str) -> str:
        """Return what an object is: the noun of its concept, else the label of its class."""
        concept = self.concepts.get(iri)
        if concept in self.concept_labels:
            return self.concept_labels[concept]
        labels = sorted(self.class_labels[cls] for cls in self.classes.get(iri, ()) if cls in self.class_labels)
        return labels[0] if labels else "thing"

    def table(self, iris: Iterable[str], **columns: Mapping[str, Any]) -> Answer:
        """Return objects as rows: name, class, path, and further columns by IRI."""
        rows = []
        for iri in dict.fromkeys(iris):
            named = self.objects[iri]
            labels = sorted(self.class_labels[cls] for cls in self.classes.get(iri, ()) if cls in self.class_labels)
            rows.append(
                (named.label, labels[0] if labels else None, named.path, *(c.get(iri) for c in columns.values()))
            )
        texts = tuple(tuple(None if cell is None else _text(cell) for cell in row) for row in rows)
        return Answer(("object", "class", "path", *columns), texts, tuple(rows), "")

    def _pairs(self, pattern: str) -> Iterator[tuple[str, str]] | list[tuple[str, str]]:
        rows = self.graph.dataset.select(f"SELECT DISTINCT ?s ?v WHERE {{ {pattern} }}")
        return [(str(row["s"].value), str(row["v"].value)) for row in rows]

    def _first(self, pattern: str) -> dict[str, str]:
        found: dict[str, str] = {}
        for subject, value in sorted(self._pairs(pattern), reverse=True):
            found[subject] = value
        return found


def _text(cell: Any) -> str:
    return f"{cell:g}" if isinstance(cell, float) else str(cell)
