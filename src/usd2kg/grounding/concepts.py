"""Add to predictions the concepts that the objects' own words name, whatever grounder chose the classes."""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

from usd2kg.garbage import paused_collection
from usd2kg.grounding.context.views import ObjectView, view_objects
from usd2kg.grounding.model import Concept, Decision, Grounding, Prediction, Status
from usd2kg.grounding.registry import make_grounder
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import Scene

__all__ = ["add_concepts", "apply_decisions", "concepts_named", "hypernyms_of", "is_english_word"]


def add_concepts(
    predictions: Mapping[str, Prediction], views: Mapping[str, ObjectView], tbox: TBox
) -> tuple[dict[str, Prediction], dict[str, Concept]]:
    """Return the predictions with their concepts, and IRI → concept for these and their hypernyms.

    An object has no concept if its words contradict the class that a person chose.

    Args:
        predictions: prim path → prediction.
        views: prim path → evidence about the object.
        tbox: the candidate classes.
    """
    # Imported here, since it reads the noun taxonomy.
    from usd2kg.grounding.lexical.recognition import describe_concepts, load_recognizer  # noqa: PLC0415

    named = _classes_by_words(predictions, views, tbox)
    completed = dict(predictions)
    with paused_collection():
        recognizer = load_recognizer()
        # Copies come one after the other, so that small caches find their results.
        for path, prediction in sorted(predictions.items(), key=lambda item: views[item[0]].own_size or ()):
            found = recognizer.recognize(views[path], prediction.words)
            is_decided = prediction.status is Status.REVIEWED
            if found is None or (is_decided and not _agrees(found.concept, named[path], prediction.class_iri, tbox)):
                continue
            completed[path] = replace(prediction, concept=found.concept, concept_confidence=found.confidence)
    return completed, describe_concepts(p.concept for p in completed.values() if p.concept is not None)


def apply_decisions(grounding: Grounding, decisions: Mapping[str, Decision], scene: Scene, tbox: TBox) -> Grounding:
    """Return a grounding with the decisions of people over its predictions, which `Prediction.review` keeps.

    Args:
        grounding: the predictions, without decisions.
        decisions: prim path → decision.
        scene: the scene of the grounding.
        tbox: the candidate classes.
    """
    decided = {
        p.prim_path: p.reviewed(made.class_iri, made.reviewer, confidence=1.0, comment=made.comment, time=made.time)
        for p in grounding.predictions
        if (made := decisions.get(p.prim_path)) is not None
    }
    views = {obj.prim_path: view for obj, view in view_objects(scene) if obj.prim_path in decided}
    without = {path: replace(p, concept=None, concept_confidence=None) for path, p in decided.items()}
    renewed, _ = add_concepts(without, views, tbox)
    return replace(grounding, predictions=tuple(renewed.get(p.prim_path, p) for p in grounding.predictions))


def concepts_named(noun: str) -> tuple[str, ...]:
    """Return the IRIs of the concepts that a noun or compound may mean, the usual one first; empty if it is unknown."""
    from usd2kg.grounding.lexical import recognition  # noqa: PLC0415

    return recognition.concepts_of_noun(noun)


@lru_cache(maxsize=4096)
def hypernyms_of(noun: str) -> frozenset[str]:
    """Return the labels of the usual sense of a noun and of all its hypernyms; empty for an unknown noun."""
    from usd2kg.grounding.lexical import recognition  # noqa: PLC0415

    described = recognition.describe_concepts(recognition.concepts_of_noun(noun)[:1])
    return frozenset(concept.label for concept in described.values())


def is_english_word(word: str) -> bool:
    """Return whether a lower-case word of five letters or more is English, whatever its part of speech."""
    from usd2kg.grounding.lexical.reading import english_words  # noqa: PLC0415

    return english_words.is_english_word(word)


def _classes_by_words(
    predictions: Mapping[str, Prediction], views: Mapping[str, ObjectView], tbox: TBox
) -> dict[str, ClassIRI | None]:
    """Return prim path → class by the evidence, of the objects whose class a person chose."""
    decided = [(path, views[path]) for path, p in predictions.items() if p.status is Status.REVIEWED]
    if not decided:
        return {}
    return {p.prim_path: p.class_iri for p in make_grounder("lexical").ground_views(decided, tbox)}


def _agrees(concept: str, by_words: ClassIRI | None, chosen: ClassIRI | None, tbox: TBox) -> bool:
    """Return whether an object with a concept may belong to the class that a person chose.

    Args:
        concept: the concept that the object's words name.
        by_words: the class that they mean.
        chosen: the class that the person chose; None if no class fits, whatever the object is.
        tbox: the classes.
    """
    if chosen is None:
        return True
    if by_words is None:
        return False
    if tbox.is_subclass(by_words, chosen):
        return True
    if not tbox.is_subclass(chosen, by_words):
        return False
    # The words mean only a coarse class: of the artifacts, a ball is not a bowl.
    meant = concepts_named(tbox.by_iri[chosen].label)[:1]
    return not meant or _is_below(concept, meant[0]) or _is_below(meant[0], concept)


def _is_below(concept: str, above: str) -> bool:
    """Return whether a concept is a hyponym of another, or the same."""
    from usd2kg.grounding.lexical.recognition import describe_concepts  # noqa: PLC0415

    return above in describe_concepts([concept])
