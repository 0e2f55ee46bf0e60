"""Class membership of objects, by class IRI or by the words of class labels."""

from collections.abc import Iterable

import pyoxigraph as ox

from usd2kg.graph.vocabulary import RDFS
from usd2kg.ontology import expand_curie
from usd2kg.ontology.model import local_name
from usd2kg.validation.axiom_index import AxiomIndex
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.plausibility_rules import Rule
from usd2kg.words import split_identifier

__all__ = ["ObjectClasses"]


class ObjectClasses:
    """Looks up the superclasses and labels of objects' classes, in the graph and in the ontology."""

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
        self._members: dict[tuple[tuple[str, ...], str, str], bool] = {}

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

    def is_a(self, obj: GraphObject, rule: Rule, classes: str, words: str) -> bool:
        """Return whether a class of an object, or a superclass, is in a rule's list of classes or of words."""
        key = (obj.classes, rule.id, classes)
        if key not in self._members:
            iris, labels = rule.classes(classes), rule.words(words)
            self._members[key] = any(
                above in iris or not labels.isdisjoint(_label_and_head(self.label(above)))
                for cls in obj.classes
                for above in self.closure(cls)
            )
        return self._members[key]


def _label_and_head(label: str) -> tuple[str, str]:
    """Return a label and its head noun, the last word: a floor lamp is a lamp, not a floor."""
    return label, label.rpartition(" ")[2]
