"""Concepts of objects: labels, hypernyms, and their rows in everyday_objects.csv."""

from functools import cache

import pyoxigraph as ox

from usd2kg.graph.vocabulary import SKOS
from usd2kg.grounding.lexical.concepts.sizes import everyday_object_row, everyday_object_rows, typical_extents
from usd2kg.ontology.model import local_name
from usd2kg.validation.graph_objects import values_of

__all__ = ["ConceptLabels", "everyday_extent", "everyday_stances"]


class ConceptLabels:
    """The labels of the concepts in a graph, with those of their hypernyms."""

    def __init__(self, store: ox.Store) -> None:
        self._labels = {node.value: str(values[0].value) for node, values in values_of(store, SKOS.prefLabel).items()}
        self._broader = {
            node.value: [value.value for value in values if isinstance(value, ox.NamedNode)]
            for node, values in values_of(store, SKOS.broader).items()
        }
        self._above: dict[str, tuple[str, ...]] = {}

    def label(self, concept: str) -> str:
        """Return the label of a concept in lower case; its local name if it has none."""
        return self._labels.get(concept, local_name(concept)).lower()

    def above(self, concept: str) -> tuple[str, ...]:
        """Return the labels of a concept and all its hypernyms in lower case, nearest first."""
        if concept not in self._above:
            order = {concept: None}
            pending = [concept]
            for each in pending:
                new = [iri for iri in self._broader.get(each, ()) if iri not in order]
                order.update(dict.fromkeys(new))
                pending.extend(new)
            self._above[concept] = tuple(map(self.label, order))
        return self._above[concept]


def everyday_extent(noun: str) -> float | None:
    """Return the typical longest extent of an everyday object in metres; None if unknown."""
    extents = typical_extents(noun.replace(" ", ""))
    return extents[0] if extents is not None else None


@cache
def everyday_stances(noun: str) -> frozenset[str] | None:
    """Return how an everyday object may stand: floor, surface, wall, ceiling, part; None if unknown."""
    row = everyday_object_row(noun.replace(" ", ""))
    return frozenset(everyday_object_rows()[row]["stands"].split()) if row is not None else None
