"""Kinds of objects: by class IRI, or by the labels of classes and concepts."""

from collections.abc import Iterable
from itertools import chain

import pyoxigraph as ox

from usd2kg.graph.vocabulary import RDFS
from usd2kg.ontology import expand_curie
from usd2kg.ontology.model import local_name
from usd2kg.validation.axiom_index import AxiomIndex
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.object_concepts import ConceptLabels, everyday_stances
from usd2kg.validation.plausibility_rules import Rule
from usd2kg.words import split_identifier

__all__ = ["ObjectClasses"]


class ObjectClasses:
    """Looks up the superclasses of objects' classes, in the graph and in the ontology, and their concepts."""

    def __init__(self, store: ox.Store, axioms: AxiomIndex | None, objects: Iterable[GraphObject]) -> None:
        used = {ox.NamedNode(cls) for obj in objects for cls in obj.classes}
        own = [quad.triple for quad in store.quads_for_pattern(None, RDFS.subClassOf, None)]
        classes = used | {triple.subject for triple in own} | {triple.object for triple in own}
        own += [
            quad.triple
            for cls in classes
            if isinstance(cls, ox.NamedNode)
            for quad in store.quads_for_pattern(cls, RDFS.label, None)
        ]
        self._graph = AxiomIndex(own)
        self._axioms = axioms
        self._closures: dict[str, frozenset[str]] = {}
        self._labels: dict[str, str] = {}
        self._matches: dict[tuple[tuple[str, ...], str | None, str, str], str | None] = {}
        self.concepts = ConceptLabels(store)

    def closure(self, cls: str) -> frozenset[str]:
        """Return a class and all its superclasses."""
        if cls not in self._closures:
            found = self._graph.closure(cls)
            if self._axioms is not None:
                found = found.union(*(self._axioms.closure(iri) for iri in found))
            self._closures[cls] = found
        return self._closures[cls]

    def label(self, cls: str) -> str:
        """Return the label of a class in lower case, split into words."""
        if cls not in self._labels:
            self._labels[cls] = self._find_label(cls)
        return self._labels[cls]

    def _find_label(self, cls: str) -> str:
        label = self._graph.label(cls)
        if self._axioms is not None and expand_curie(label) == cls:
            label = self._axioms.label(cls)
        if expand_curie(label) == cls:
            label = local_name(cls)
        return " ".join(split_identifier(label)).lower()

    def names(self, obj: GraphObject) -> str:
        """Return the labels of an object's classes, for messages."""
        return " and ".join(self.label(cls) for cls in obj.classes) or "without a class"

    def kind(self, obj: GraphObject) -> str:
        """Return the kind of an object, for messages: the label of its concept, otherwise of its classes."""
        return self.concepts.label(obj.concept) if obj.concept is not None else self.names(obj)

    def stances(self, obj: GraphObject) -> frozenset[str]:
        """Return how objects of this kind may stand: floor, surface, wall, ceiling, part; empty if unknown.

        The nearest known hypernym of the concept decides, else the label of a class.
        """
        above = self.concepts.above(obj.concept) if obj.concept is not None else map(self.label, obj.classes)
        return next((known for noun in above if (known := everyday_stances(noun)) is not None), frozenset())

    def is_a(self, obj: GraphObject, rule: Rule, words: str, classes: str | None = None) -> bool:
        """Return whether an object is of a kind that a rule lists, see `match`."""
        return self.match(obj, rule, words, classes) is not None

    def match(self, obj: GraphObject, rule: Rule, words: str, classes: str | None = None) -> str | None:
        """Return the label that matches a kind listed by a rule: the object's own, a superclass's or a hypernym's.

        Args:
            obj: the object.
            rule: the rule.
            words: key of its list of words, which are compared with the labels of classes and concepts, whole or by
                their last word.
            classes: key of its list of classes; None if it has none.
        """
        key = (obj.classes, obj.concept, rule.id, words)
        if key not in self._matches:
            iris = rule.classes(classes) if classes else frozenset[str]()
            self._matches[key] = self._find_match(obj, rule.words(words), iris)
        return self._matches[key]

    def _find_match(self, obj: GraphObject, words: frozenset[str], iris: frozenset[str]) -> str | None:
        above = sorted({iri for cls in obj.classes for iri in self.closure(cls)})
        of_concept = self.concepts.above(obj.concept) if obj.concept is not None else ()
        listed = (self.label(iri) for iri in above if iri in iris)
        labels = (*map(self.label, above), *of_concept)
        named = (label for label in labels if not words.isdisjoint(_label_and_head(label)))
        return next(chain(listed, named), None)


def _label_and_head(label: str) -> tuple[str, str]:
    """Return a label and its head noun, the last word: a floor lamp is a lamp, not a floor."""
    return label, label.rpartition(" ")[2]
