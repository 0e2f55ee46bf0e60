"""Justification of type assertions in SSSOM and SEMAPV terms, with reviews and predictions."""

import re
from collections.abc import Iterator

import pyoxigraph as ox

from usd2kg.graph.axiom_annotation import Annotation
from usd2kg.graph.settings import JUSTIFICATION
from usd2kg.graph.vocabulary import SEMAPV, SSSOM, U2K, named_node, number, text
from usd2kg.grounding import PERSON, Prediction, Review

__all__ = ["justify_class", "justify_refusal", "matching_process"]

_MATCHING = {
    "dictionary": SEMAPV.LexicalMatching,
    "lexical": SEMAPV.CompositeMatching,
    "embedding": SEMAPV.SemanticSimilarityThresholdMatching,
    "llm": SEMAPV.BackgroundKnowledgeBasedMatching,
    PERSON: SEMAPV.ManualMappingCuration,
    "volume": SEMAPV.BackgroundKnowledgeBasedMatching,
}
"""Grounder id prefix → SEMAPV matching process."""


def justify_class(prediction: Prediction, run: ox.NamedNode) -> list[Annotation]:
    """Return the annotations of a type assertion: confidence, justification, review, evidence, alternatives, run."""
    confidence = prediction.confidence
    return [
        *([(SSSOM.confidence, number(confidence))] if confidence is not None else []),
        (SSSOM.mapping_justification, matching_process(prediction)),
        *_outcome(prediction),
        (U2K.grounder, text(prediction.grounder)),
        *((U2K.evidence, text(group)) for group in prediction.evidence),
        *((U2K.alternative, ox.NamedNode(iri)) for iri in _alternatives(prediction)),
        (U2K.run, run),
    ]


def justify_refusal(prediction: Prediction) -> list[Annotation]:
    """Return the annotations of an object without a class: status, explanation and review."""
    return list(_outcome(prediction))


def _outcome(prediction: Prediction) -> Iterator[Annotation]:
    yield U2K.status, text(prediction.status.value)
    yield U2K.explanation, text(prediction.explanation)
    if prediction.decided_for:
        yield U2K.decidedFor, text(prediction.decided_for)
    if prediction.review is not None:
        yield from _review(prediction.review, prediction.class_iri)


def _review(review: Review, decided: str | None) -> Iterator[Annotation]:
    reviewer = named_node(review.reviewer)
    if reviewer is not None:
        yield SSSOM.reviewer_id, reviewer
    elif review.reviewer:
        yield SSSOM.reviewer_label, text(review.reviewer)
    if review.comment:
        yield U2K.reviewComment, text(review.comment)
    if review.time:
        yield U2K.reviewTime, text(review.time)
    if review.predicted_class is not None and review.predicted_class != decided:
        yield U2K.predictedClass, ox.NamedNode(review.predicted_class)
    if review.predicted_confidence is not None:
        yield U2K.predictedConfidence, number(review.predicted_confidence)


def matching_process(prediction: Prediction) -> ox.NamedNode:
    """Return the SEMAPV matching process of a prediction; curation if a person changed the class or is not named.

    A decision without a name is recognised by its process alone, see `read_sssom_decisions`.
    """
    review = prediction.review
    if review is not None and (not review.reviewer or review.predicted_class != prediction.class_iri):
        return SEMAPV.ManualMappingCuration
    # Grounder ids may include strategy and model: llm-B:openai:gpt.
    return _MATCHING.get(re.split("[-:]", prediction.grounder)[0], SEMAPV.UnspecifiedMatching)


def _alternatives(prediction: Prediction) -> list[str]:
    others = [c.class_iri for c in prediction.candidates if c.class_iri != prediction.class_iri]
    return others[: JUSTIFICATION.max_alternatives]
