"""GraphIndex: the statements of a graph by subject and property, with the annotations of statements."""

from collections.abc import Iterable, Iterator
from typing import Any

import pyoxigraph as ox

from usd2kg.graph.vocabulary import OWL, RDF

__all__ = ["GraphIndex"]


class GraphIndex:
    """Values in the order of the statements."""

    def __init__(self, statements: Iterable[ox.Triple]) -> None:
        self._values: dict[Any, dict[ox.NamedNode, list[Any]]] = {}
        self._subjects: dict[ox.NamedNode, dict[Any, None]] = {}
        for subject, predicate, value in statements:
            self._values.setdefault(subject, {}).setdefault(predicate, []).append(value)
            self._subjects.setdefault(predicate, {})[subject] = None
        self._annotating = dict(self._find_annotations())

    def subjects_of(self, name: ox.NamedNode) -> Iterator[tuple[Any, list[Any]]]:
        """Yield each subject that has a property, with the values."""
        for subject in self._subjects.get(name, ()):
            yield subject, self._values[subject][name]

    def properties(self, node: Any) -> dict[ox.NamedNode, list[Any]]:
        """Return property → values of a node."""
        return self._values.get(node, {})

    def values(self, node: Any, name: ox.NamedNode) -> list[Any]:
        """Return the values of a property."""
        return self.properties(node).get(name, [])

    def texts(self, node: Any, name: ox.NamedNode) -> tuple[str, ...]:
        """Return the values of a property as texts: of literals, and IRIs."""
        return tuple(str(value.value) for value in self.values(node, name) if not isinstance(value, ox.Triple))

    def text(self, node: Any, name: ox.NamedNode) -> str:
        """Return the first value of a property as text; empty without one."""
        return next(iter(self.texts(node, name)), "")

    def annotation(self, statement: tuple[Any, ox.NamedNode, Any]) -> Any:
        """Return the node that annotates a statement; None if there is none."""
        return self._annotating.get(statement)

    def _find_annotations(self) -> Iterator[tuple[tuple[Any, Any, Any], Any]]:
        """Yield each annotated statement with its owl:Axiom (OWL 2) or reifier (RDF 1.2)."""
        for node, sources in self.subjects_of(OWL.annotatedSource):
            predicates, targets = (self.values(node, name) for name in (OWL.annotatedProperty, OWL.annotatedTarget))
            if predicates and targets:
                yield (sources[0], predicates[0], targets[0]), node
        for node, reified in self.subjects_of(RDF.reifies):
            for statement in reified:
                if isinstance(statement, ox.Triple):
                    yield (statement.subject, statement.predicate, statement.object), node
