"""By which names an ontology knows its classes, and how they lie to each other: what labels are compared with."""

from collections import defaultdict
from collections.abc import Iterable
from functools import cached_property

import pyoxigraph as ox
from rapidfuzz import fuzz, process

from usd2kg.graph.vocabulary import OWL, RDF, RDFS
from usd2kg.ontology import Closure, TBox, local_name
from usd2kg.scene import class_words
from usd2kg.words import split_identifier

__all__ = ["ClassIndex", "name_key"]

_LIKE_ENOUGH = 80
"""Likeness in percent from which a name is suggested."""
_SKOS = "http://www.w3.org/2004/02/skos/core#"
_NAME_PROPERTIES = (
    RDFS.label,
    *(ox.NamedNode(_SKOS + name) for name in ("prefLabel", "altLabel", "hiddenLabel")),
    ox.NamedNode("http://purl.obolibrary.org/obo/IAO_0000118"),
    ox.NamedNode("http://www.geneontology.org/formats/oboInOwl#hasExactSynonym"),
)
_REPLACED_BY = (
    ox.NamedNode("http://purl.obolibrary.org/obo/IAO_0100001"),
    ox.NamedNode("http://purl.org/dc/terms/isReplacedBy"),
)
_CLASS_TYPES = (OWL.Class, RDFS.Class)


def name_key(name: str) -> str:
    """Return what spellings of one name have in common.

    >>> name_key("coffee_mug") == name_key("CoffeeMug") == name_key("Coffee mug")
    True
    """
    return "".join(split_identifier(name)).casefold() or name.casefold()


class ClassIndex:
    """The classes of an ontology with all that it imports, in scope or not."""

    def __init__(self, tbox: TBox, closure: Closure) -> None:
        self._tbox = tbox
        self.iris = {cls.iri for cls in tbox.classes}
        self.deprecated: dict[str, str | None] = {}
        """IRI of a deprecated class → IRI of what is to be used instead, None if nobody says."""
        self._above: dict[str, frozenset[str]] = {}
        self._names: dict[str, set[str]] = defaultdict(set)
        self._parents: dict[str, set[str]] = defaultdict(set)
        self._read(closure.triples)
        self._by_key: dict[str, set[str]] = defaultdict(set)
        for cls in tbox.classes:
            self._names[cls.iri] |= {cls.label, *cls.alt_labels}
        for iri in self.iris:
            for name in (local_name(iri), *self._names[iri]):
                self._by_key[name_key(name)].add(iri)

    def _read(self, triples: Iterable[ox.Triple]) -> None:
        replaced: dict[str, str] = {}
        for triple in triples:
            subject, predicate, value = triple.subject, triple.predicate, triple.object
            if not isinstance(subject, ox.NamedNode):
                continue
            if predicate == RDF.type and value in _CLASS_TYPES:
                self.iris.add(subject.value)
            elif predicate in _NAME_PROPERTIES and isinstance(value, ox.Literal):
                self._names[subject.value].add(value.value)
            elif predicate == OWL.deprecated and isinstance(value, ox.Literal) and value.value in {"true", "1"}:
                self.deprecated[subject.value] = None
            elif isinstance(value, ox.NamedNode):
                self._link(subject.value, predicate, value.value, replaced)
        for iri in self.deprecated:
            self.deprecated[iri] = replaced.get(iri)

    def _link(self, subject: str, predicate: ox.NamedNode, target: str, replaced: dict[str, str]) -> None:
        if predicate in {RDFS.subClassOf, OWL.equivalentClass}:
            self._parents[subject].add(target)
        if predicate == OWL.equivalentClass:
            self._parents[target].add(subject)
        if predicate in _REPLACED_BY:
            replaced[subject] = target

    def named(self, name: str) -> frozenset[str]:
        """Return the classes that go by a name, whatever its case and separators; deprecated ones where no other."""
        found = self._by_key.get(name_key(name), set())
        return frozenset(found - self.deprecated.keys() or found)

    def above(self, iri: str) -> frozenset[str]:
        """Return a class with all classes above it."""
        if iri not in self._above:
            self._above[iri] = self._find_above(iri)
        return self._above[iri]

    def _find_above(self, iri: str) -> frozenset[str]:
        found, pending = {iri}, [iri]
        while pending:
            for parent in self._parents.get(pending.pop(), ()):
                if parent not in found:
                    found.add(parent)
                    pending.append(parent)
        known = {up for cls in found if cls in self._tbox.by_iri for up in self._tbox.closure(cls)}
        return frozenset(found | known)

    def are_related(self, one: str, other: str) -> bool:
        """Return whether a class is the other, above or below it."""
        return other in self.above(one) or one in self.above(other)

    def is_own_namespace(self, iri: str) -> bool:
        """Return whether classes of the ontology lie in the namespace of an IRI."""
        return iri.removesuffix(local_name(iri)) in self._namespaces

    @cached_property
    def _namespaces(self) -> set[str]:
        return {iri.removesuffix(local_name(iri)) for iri in self.iris}

    def words(self, iri: str) -> set[str]:
        """Return the words of all names of a class."""
        return {word for name in (local_name(iri), *self._names.get(iri, ())) for word in class_words(name)}

    def suggest(self, name: str) -> str:
        """Return the end of the IRI of the class whose name is most like `name`; empty if none in scope is like it."""
        names = self._scope_names
        found = process.extractOne(name_key(name), names.keys(), scorer=fuzz.ratio, score_cutoff=_LIKE_ENOUGH)
        return local_name(names[found[0]]) if found else ""

    @cached_property
    def _scope_names(self) -> dict[str, str]:
        named = [(name, cls.iri) for cls in self._tbox.classes for name in (cls.local_name, cls.label, *cls.alt_labels)]
        return {name_key(name): iri for name, iri in reversed(named)}
