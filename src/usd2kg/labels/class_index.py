"""ClassIndex: the classes of an ontology by name, with their superclasses, for checking labels."""

from collections import defaultdict
from collections.abc import Iterable
from functools import cached_property

import pyoxigraph as ox
from rapidfuzz import fuzz, process

from usd2kg.graph.vocabulary import OWL, RDF, RDFS
from usd2kg.labels.settings import LINT
from usd2kg.ontology import ClassIRI, Closure, TBox, local_name
from usd2kg.ontology.class_axioms import ALT_LABELS, LABELS
from usd2kg.ontology.components import reachable
from usd2kg.scene import class_words
from usd2kg.words import split_identifier

__all__ = ["ClassIndex", "normalize_name"]

_NAME_PROPERTIES = frozenset(ox.NamedNode(iri) for iri in (*LABELS, *ALT_LABELS))
_REPLACED_BY = (
    ox.NamedNode("http://purl.obolibrary.org/obo/IAO_0100001"),
    ox.NamedNode("http://purl.org/dc/terms/isReplacedBy"),
)
_CLASS_TYPES = (OWL.Class, RDFS.Class)


def normalize_name(name: str) -> str:
    """Return a name without case and separators.

    >>> normalize_name("coffee_mug") == normalize_name("CoffeeMug") == normalize_name("Coffee mug")
    True
    """
    return "".join(split_identifier(name)).casefold() or name.casefold()


class ClassIndex:
    """The classes of an ontology and its imports, in scope or not."""

    def __init__(self, tbox: TBox, closure: Closure) -> None:
        self._tbox = tbox
        self.iris = {cls.iri for cls in tbox.classes}
        self.deprecated: dict[ClassIRI, ClassIRI | None] = {}
        """IRI of a deprecated class → IRI of its replacement, None if the ontology names none."""
        self._superclasses: dict[ClassIRI, frozenset[ClassIRI]] = {}
        self._names: dict[ClassIRI, set[str]] = defaultdict(set)
        self._parents: dict[ClassIRI, set[ClassIRI]] = defaultdict(set)
        self._read(closure.triples)
        self._by_name: dict[str, set[ClassIRI]] = defaultdict(set)
        for cls in tbox.classes:
            self._names[cls.iri] |= {cls.label, *cls.alt_labels}
        for iri in self.iris:
            for name in (local_name(iri), *self._names[iri]):
                self._by_name[normalize_name(name)].add(iri)

    def _read(self, triples: Iterable[ox.Triple]) -> None:
        replacements: dict[ClassIRI, ClassIRI] = {}
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
            elif predicate in _REPLACED_BY and isinstance(value, ox.NamedNode):
                replacements[subject.value] = value.value
            elif isinstance(value, ox.NamedNode):
                self._add_parents(subject.value, predicate, value.value)
        self.deprecated = {iri: replacements.get(iri) for iri in self.deprecated}

    def _add_parents(self, subject: ClassIRI, predicate: ox.NamedNode, target: ClassIRI) -> None:
        if predicate in {RDFS.subClassOf, OWL.equivalentClass}:
            self._parents[subject].add(target)
        if predicate == OWL.equivalentClass:
            self._parents[target].add(subject)

    def find(self, name: str) -> frozenset[ClassIRI]:
        """Return the classes with a name, regardless of case and separators; deprecated only if no other has it."""
        found = self._by_name.get(normalize_name(name), set())
        return frozenset(found - self.deprecated.keys() or found)

    def superclasses(self, iri: ClassIRI) -> frozenset[ClassIRI]:
        """Return a class and all its superclasses."""
        if iri not in self._superclasses:
            found = {iri, *reachable(self._parents, [iri])}
            # The TBox adds superclasses across classes out of scope, such as those in class expressions.
            known = {up for cls in found if cls in self._tbox.by_iri for up in self._tbox.closure(cls)}
            self._superclasses[iri] = frozenset(found | known)
        return self._superclasses[iri]

    def are_related(self, one: ClassIRI, other: ClassIRI) -> bool:
        """Return whether two classes are equal or one is a superclass of the other."""
        return other in self.superclasses(one) or one in self.superclasses(other)

    def is_own_namespace(self, iri: str) -> bool:
        """Return whether the ontology has classes in the namespace of an IRI."""
        return iri.removesuffix(local_name(iri)) in self._namespaces

    @cached_property
    def _namespaces(self) -> set[str]:
        return {iri.removesuffix(local_name(iri)) for iri in self.iris}

    def words(self, iri: ClassIRI) -> set[str]:
        """Return the words of all names of a class."""
        return {word for name in (local_name(iri), *self._names.get(iri, ())) for word in class_words(name)}

    def suggest(self, name: str) -> str:
        """Return the local name of the class in scope whose name is most similar to `name`; empty if none is."""
        names = self._scope_names
        limit = LINT.min_name_similarity
        found = process.extractOne(normalize_name(name), names.keys(), scorer=fuzz.ratio, score_cutoff=limit)
        return local_name(names[found[0]]) if found else ""

    @cached_property
    def _scope_names(self) -> dict[str, ClassIRI]:
        named = [(name, cls.iri) for cls in self._tbox.classes for name in (cls.local_name, cls.label, *cls.alt_labels)]
        return {normalize_name(name): iri for name, iri in reversed(named)}
