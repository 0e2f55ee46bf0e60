"""The page of one object as JSON; the records are documented in `web/src/api/types.ts`."""

from typing import Any

import pyoxigraph as ox

from usd2kg.graph.iris import individual_iri
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.grounding import Prediction
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.relations import Relation
from usd2kg.studio.disagreement import second_answer
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.session import StudioSession

__all__ = ["object_page", "relation_json"]

_MAX_CANDIDATES = 9
"""As many as there are digit keys."""


def object_page(session: StudioSession, indices: PageIndices, index: int) -> dict[str, Any]:
    """Return everything about one object; its statements are those of the last graph that was built."""
    obj = session.scene.objects[index]
    prediction = session.predictions[obj.prim_path]
    box = obj.own_box or obj.box
    return {
        "object": index,
        "path": obj.prim_path,
        "name": obj.display_name or obj.name,
        "type_name": obj.type_name,
        "kind": obj.kind,
        "selected_by": obj.selected_by,
        "size": None if box is None else box.size,
        "position": obj.position or (None if box is None else box.center),
        "mass_kg": obj.mass_kg,
        "materials": obj.materials,
        "assets": obj.asset,
        "parts": obj.parts,
        "labels": [
            {"encoding": label.encoding, "taxonomy": label.taxonomy, "value": label.value}
            for label in (*obj.labels.own, *obj.labels.inherited)
        ],
        "documentation": obj.documentation,
        "explanation": prediction.explanation,
        "evidence": prediction.evidence,
        "candidates": _candidates(prediction, session, indices),
        "second": second_answer(prediction, session.second, indices),
        "concept": _concept(prediction, session),
        "relations": [relation_json(relation, indices) for relation in session.relations_of(obj.prim_path)],
        "history": [
            {
                "event": event.number,
                "action": event.action.value,
                "verdict": verdict.kind.value,
                "class": indices.class_(verdict.class_iri),
                "concept": indices.concept(event.concept),
                "proposal": verdict.proposal,
                "reviewer": event.reviewer,
                "time": event.time,
                "comment": verdict.comment,
            }
            for event, verdict in session.review.history(obj.prim_path)
        ],
        "turtle": _turtle(session, individual_iri(session.base, obj.prim_path)),
    }


def _turtle(session: StudioSession, iri: str) -> str:
    """Return the statements about an individual and its aspects (box, pose…); empty if no graph is built yet."""
    graph = session.last_answers
    if graph is None:
        return ""
    found: dict[ox.Triple, None] = {}
    waiting = [ox.NamedNode(iri)]
    while waiting:
        for quad in graph.store.quads_for_pattern(waiting.pop(), None, None):
            if quad.triple not in found and isinstance(quad.object, ox.NamedNode):
                waiting += [quad.object] if quad.object.value.startswith(f"{iri}-") else []
            found[quad.triple] = None
    text = ox.serialize(found, format=ox.RdfFormat.TURTLE, prefixes={**PREFIXES, "scene": session.base})
    assert text is not None, "without an output, the text is returned"
    return text.decode()


def _candidates(prediction: Prediction, session: StudioSession, indices: PageIndices) -> list[dict[str, Any]]:
    """Return the candidates, the suggestion first, with their shares of the score and the evidence about each."""
    scores = {candidate.class_iri: max(candidate.score, 0.0) for candidate in prediction.candidates}
    if prediction.class_iri is not None:
        # A superclass by abstention is none of the candidates.
        scores = {prediction.class_iri: scores.get(prediction.class_iri, 0.0), **scores}
    total = sum(scores.values())
    shown = list(scores.items())[:_MAX_CANDIDATES]
    evidence = session.evidence(prediction.prim_path, [iri for iri, _ in shown])
    return [
        {
            "class": indices.class_(iri),
            "share": score / total if total else None,
            "taxonomy": _path_to_root(iri, session.tbox),
            "evidence": [each._asdict() for each in evidence.get(iri, ())],
        }
        for iri, score in shown
    ]


def _path_to_root(iri: ClassIRI, tbox: TBox) -> list[str]:
    """Return the labels from a class to a root, along its first superclasses."""
    labels: list[str] = []
    above: ClassIRI | None = iri
    while above is not None:
        cls = tbox.by_iri[above]
        labels.append(cls.label)
        above = cls.parents[0] if cls.parents and len(labels) <= len(tbox.classes) else None
    return labels


def _concept(prediction: Prediction, session: StudioSession) -> dict[str, Any] | None:
    concepts = session.suggestions.concepts
    concept = concepts.get(prediction.concept or "")
    if concept is None:
        return None
    hypernyms: list[str] = []
    above = concept
    while above.broader and len(hypernyms) < len(concepts):
        above = concepts[above.broader[0]]
        hypernyms.append(above.label)
    return {
        "iri": concept.iri,
        "label": concept.label,
        "confidence": prediction.concept_confidence,
        "hypernyms": hypernyms,
    }


def relation_json(relation: Relation, indices: PageIndices) -> dict[str, Any]:
    """Return one relation."""
    return {
        "kind": relation.kind,
        "target": indices.object(relation.target),
        "anchor": indices.object(relation.anchor),
        "anchor_path": relation.anchor,
        "numbers": {name: round(value, 4) for name, value in relation.numbers.items()},
        "confidence": relation.confidence,
        "rule": relation.rule,
    }
