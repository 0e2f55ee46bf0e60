"""Add to predictions the concepts that the objects' own words name, whatever grounder chose the classes."""

from collections.abc import Mapping
from dataclasses import replace

from usd2kg.garbage import paused_collection
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Concept, Prediction, Status
from usd2kg.grounding.registry import make_grounder
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["add_concepts", "concepts_named"]


def add_concepts(
    predictions: Mapping[str, Prediction], views: Mapping[str, ObjectView], tbox: TBox
) -> tuple[dict[str, Prediction], dict[str, Concept]]:
    """Return the predictions with their concepts, and IRI → concept for these and their hypernyms.

    An object has no concept if its words mean another class than the one that a person chose.

    Args:
        predictions: prim path → prediction.
        views: prim path → evidence about the object.
        tbox: the candidate classes.
    """
    # Imported here, since it reads the noun taxonomy.
    from usd2kg.grounding.lexical.recognition import describe_concepts, load_recognizer  # noqa: PLC0415

    contradicted = _find_contradicted(predictions, views, tbox)
    completed = dict(predictions)
    with paused_collection():
        recognizer = load_recognizer()
        for path in predictions.keys() - contradicted:
            found = recognizer.recognize(views[path], predictions[path].words)
            if found is not None:
                completed[path] = replace(predictions[path], concept=found.concept, concept_confidence=found.confidence)
    return completed, describe_concepts(p.concept for p in completed.values() if p.concept is not None)


def concepts_named(noun: str) -> tuple[str, ...]:
    """Return the IRIs of the concepts that a noun or compound may mean; empty if it is unknown."""
    from usd2kg.grounding.lexical import recognition  # noqa: PLC0415

    return recognition.concepts_named(noun)


def _find_contradicted(
    predictions: Mapping[str, Prediction], views: Mapping[str, ObjectView], tbox: TBox
) -> frozenset[str]:
    """Return the paths of the objects whose words mean another class than the one that a person chose."""
    chosen = {path: p.class_iri for path, p in predictions.items() if p.status is Status.REVIEWED}
    if not chosen:
        return frozenset()
    by_words = make_grounder("lexical").ground_views([(path, views[path]) for path in chosen], tbox)
    return frozenset(p.prim_path for p in by_words if not _agree(p.class_iri, chosen[p.prim_path], tbox))


def _agree(one: ClassIRI | None, other: ClassIRI | None, tbox: TBox) -> bool:
    """Return whether one of two classes is a subclass of the other."""
    if one is None or other is None:
        return False
    return tbox.is_subclass(one, other) or tbox.is_subclass(other, one)
