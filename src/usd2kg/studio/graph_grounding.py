"""The grounding that a graph states: classes with confidence, explanation, alternatives and reviews, and concepts."""

from collections.abc import Iterator, Sequence
from typing import Any

import pyoxigraph as ox

from usd2kg.diff import ObjectState
from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.graph.vocabulary import PROV, RDF, SKOS, SSSOM, U2K
from usd2kg.grounding import Candidate, Concept, Grounding, Prediction, Review, Status
from usd2kg.scene import Scene
from usd2kg.studio.graph_index import GraphIndex

__all__ = ["read_stated_grounding"]


def read_stated_grounding(index: GraphIndex, scene: Scene, stated: Sequence[ObjectState]) -> Grounding:
    """Return the grounding behind the types of the objects.

    The scores of the alternatives are not in a graph, so all candidates have the score 0.
    """
    run = next((node for node, types in index.subjects_of(RDF.type) if PROV.Activity in types), None)
    ontology = next((node for node, _ in index.subjects_of(U2K.ontologyIri)), None)
    software = next((node for node, _ in index.subjects_of(U2K.version)), None)
    grounder = index.text(run, U2K.grounder)
    reader = _PredictionReader(index, grounder)
    settings = (text.partition("=") for text in index.texts(run, U2K.setting))
    return Grounding(
        scene=scene.source,
        scene_hash=scene.content_hash,
        ontology=index.text(ontology, U2K.ontologyIri),
        ontology_hash=index.text(ontology, U2K.contentHash),
        grounder=grounder or "unknown",
        settings={name: value for name, _, value in settings},
        is_calibrated=index.text(run, U2K.isCalibrated) in {"true", "1"},
        tool_version=index.text(software, U2K.version),
        predictions=tuple(map(reader.prediction, stated)),
        concepts={concept.iri: concept for concept in _concepts(index)},
    )


def _concepts(index: GraphIndex) -> Iterator[Concept]:
    for node, types in index.subjects_of(RDF.type):
        if SKOS.Concept in types and isinstance(node, ox.NamedNode):
            yield Concept(node.value, index.text(node, SKOS.prefLabel), index.texts(node, SKOS.broader))


class _PredictionReader:
    """Reads predictions from the annotations of type statements, or of the object if it has no class."""

    def __init__(self, index: GraphIndex, grounder: str) -> None:
        self._index = index
        self._grounder = grounder

    def prediction(self, stated: ObjectState) -> Prediction:
        """Return the prediction of one object."""
        index, node = self._index, ox.NamedNode(stated.iri)
        # usd2kg writes one class; more would be the work of another tool, and the first is as good as any.
        class_iri = next(iter(stated.classes), None)
        about: Any = node
        if class_iri is not None:
            about = index.annotation((node, RDF.type, ox.NamedNode(class_iri)))
        status = _status(index.text(about, U2K.status), class_iri)
        others = [iri for iri in index.texts(about, U2K.alternative) if iri != class_iri]
        return Prediction(
            prim_path=stated.prim_path,
            class_iri=class_iri,
            confidence=self._probability(about, SSSOM.confidence),
            status=status,
            grounder=index.text(about, U2K.grounder) or self._grounder,
            explanation=index.text(about, U2K.explanation),
            evidence=index.texts(about, U2K.evidence),
            candidates=tuple(Candidate(iri, 0.0) for iri in [*([class_iri] if class_iri else []), *others]),
            review=self._review(about, class_iri) if status is Status.REVIEWED else None,
            decided_for=index.text(about, U2K.decidedFor),
            concept=index.text(node, U2K.concept) or None,
            concept_confidence=self._probability(node, U2K.conceptConfidence),
        )

    def _review(self, about: Any, class_iri: str | None) -> Review:
        index = self._index
        return Review(
            reviewer=index.text(about, SSSOM.reviewer_id) or index.text(about, SSSOM.reviewer_label),
            # A graph states the predicted class only if the reviewer chose another.
            predicted_class=index.text(about, U2K.predictedClass) or class_iri,
            predicted_confidence=self._probability(about, U2K.predictedConfidence),
            predicted_status=None,
            comment=index.text(about, U2K.reviewComment),
            time=index.text(about, U2K.reviewTime),
        )

    def _probability(self, node: Any, name: ox.NamedNode) -> float | None:
        numbers = parse_numbers(self._index.text(node, name))
        return numbers[0] if len(numbers) == 1 and 0 <= numbers[0] <= 1 else None


def _status(text: str, class_iri: str | None) -> Status:
    if text in set(Status):
        return Status(text)
    return Status.GROUNDED if class_iri is not None else Status.UNREADABLE
