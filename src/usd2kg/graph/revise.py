"""revise_classes: the statements of a graph after reviewers changed the classes of some objects."""

from collections.abc import Iterable, Iterator, Mapping

import pyoxigraph as ox

from usd2kg.graph.axiom_annotation import annotate_owl, annotate_rdf12
from usd2kg.graph.concept_hierarchy import state_concept
from usd2kg.graph.declarations import declare_classes, declare_terms
from usd2kg.graph.justification import justify_class, justify_refusal
from usd2kg.graph.vocabulary import OWL, RDF, SSSOM, U2K, Triple
from usd2kg.grounding import Prediction
from usd2kg.ontology import TBox

__all__ = ["revise_classes"]

_OUTCOME = frozenset(
    {
        *(U2K.status, U2K.explanation, U2K.decidedFor, U2K.reviewComment, U2K.reviewTime, U2K.predictedClass),
        *(U2K.predictedConfidence, SSSOM.reviewer_id, SSSOM.reviewer_label, U2K.concept, U2K.conceptConfidence),
    }
)
"""Properties of an object that follow from its prediction, except for its class."""


def revise_classes(
    statements: Iterable[ox.Triple],
    before: Mapping[str, Prediction],
    after: Mapping[str, Prediction],
    tbox: TBox,
    *,
    run: str,
    annotations: str,
) -> tuple[ox.Triple, ...]:
    """Return the statements of a graph after decisions: only those about the class of a revised object differ.

    Spatial relations are kept, although the class of an object can affect which relations hold. The superclasses of
    classes that are no longer used are kept, too.

    Args:
        statements: the graph.
        before: individual IRI → current prediction in the graph, for the revised objects.
        after: individual IRI → new prediction.
        tbox: the classes.
        run: IRI of the grounding run.
        annotations: `owl` or `rdf12`, see `GraphOptions`.
    """
    revision = _ClassRevision(before, after, ox.NamedNode(run), annotations)
    known = dict.fromkeys(statements)
    dropped = revision.annotation_nodes(known)
    kept = [each for each in known if each.subject not in dropped and not revision.replaces(each)]
    added = [ox.Triple(*triple) for triple in revision.statements()]
    terms = [ox.Triple(*triple) for triple in _terms(added, after.values(), tbox)]
    return tuple(dict.fromkeys((*kept, *terms, *added)))


class _ClassRevision:
    """The statements to remove from a graph and to add to it."""

    def __init__(
        self, before: Mapping[str, Prediction], after: Mapping[str, Prediction], run: ox.NamedNode, annotations: str
    ) -> None:
        self._after = after
        self._run = run
        self._annotate = annotate_rdf12 if annotations == "rdf12" else annotate_owl
        self._nodes = {ox.NamedNode(iri) for iri in after}
        self._types = {
            (ox.NamedNode(iri), RDF.type, ox.NamedNode(found.class_iri))
            for iri, found in before.items()
            if found.class_iri is not None
        }

    def annotation_nodes(self, statements: Iterable[ox.Triple]) -> set[object]:
        """Return the nodes that annotate a type statement to be replaced."""
        parts: dict[object, dict[ox.NamedNode, object]] = {}
        found: set[object] = set()
        for subject, predicate, value in statements:
            if predicate in {OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget}:
                parts.setdefault(subject, {})[predicate] = value
            elif predicate == RDF.reifies and isinstance(value, ox.Triple) and tuple(value) in self._types:
                found.add(subject)
        annotated = (OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget)
        found.update(node for node, each in parts.items() if tuple(map(each.get, annotated)) in self._types)
        return found

    def replaces(self, statement: ox.Triple) -> bool:
        """Return whether a statement follows from a prediction that is replaced."""
        subject, predicate, _ = statement
        return subject in self._nodes and (predicate in _OUTCOME or tuple(statement) in self._types)

    def statements(self) -> Iterator[Triple]:
        """Yield the statements that follow from the new predictions, as written by `instantiate`."""
        for iri, prediction in self._after.items():
            node = ox.NamedNode(iri)
            if prediction.class_iri is None:
                yield from ((node, name, value) for name, value in justify_refusal(prediction))
            else:
                statement = (node, RDF.type, ox.NamedNode(prediction.class_iri))
                yield statement
                yield from self._annotate(statement, justify_class(prediction, self._run))
            yield from state_concept(node, prediction)


def _terms(added: Iterable[ox.Triple], predictions: Iterable[Prediction], tbox: TBox) -> Iterator[Triple]:
    """Yield the declarations of the properties in use, and the superclass closure of the classes."""
    yield from declare_terms({each.predicate for each in added}, ())
    yield from declare_classes({p.class_iri for p in predictions if p.class_iri is not None}, tbox)
