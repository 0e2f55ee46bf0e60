"""Where a second grounder gives an object another class: first in the queue, and on the page of the object."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from usd2kg.grounding import Grounding, Prediction
from usd2kg.scene import SceneObject
from usd2kg.studio.object_review import ObjectReview, suggestion_of
from usd2kg.studio.page_indices import PageIndices
from usd2kg.studio.review_queue import QueueGroup, group_open

__all__ = ["DISAGREEMENT_ORDER", "make_disagreement_queue", "second_answer"]

DISAGREEMENT_ORDER = "disagreement"


def make_disagreement_queue(
    states: Iterable[ObjectReview], objects: Mapping[str, SceneObject], second: Grounding
) -> list[QueueGroup]:
    """Return the groups of the open objects, first those about which the grounders disagree, the largest first.

    Args:
        states: the states of all objects, in scene order.
        objects: prim path → object.
        second: what the other grounder says.
    """

    def answer(prediction: Prediction) -> tuple[bool, str | None]:
        other = second.by_path[prediction.prim_path]
        return (True, other.class_iri) if _disagree(prediction, other) else (False, None)

    predictions = {state.prim_path: state.prediction for state in states}
    groups = []
    for group in group_open(states, objects, answer):
        is_disputed, iri = answer(predictions[group.id])
        groups.append(replace(group, is_disputed=is_disputed, second=iri))
    return sorted(groups, key=lambda g: (not g.is_disputed, -len(g.objects) if g.is_disputed else 0, -g.gain, g.id))


def second_answer(prediction: Prediction, second: Grounding | None, indices: PageIndices) -> dict[str, Any] | None:
    """Return what the second grounder says of an object; None without one."""
    if second is None:
        return None
    other = second.by_path[prediction.prim_path]
    return {
        "grounder": second.grounder,
        "class": indices.class_(other.class_iri),
        "confidence": other.confidence,
        "explanation": other.explanation,
        "is_disputed": _disagree(prediction, other),
    }


def _disagree(prediction: Prediction, other: Prediction) -> bool:
    """Return whether two grounders answer differently; a failed call is not an answer."""
    first, second = suggestion_of(prediction), suggestion_of(other)
    return first is not None and second is not None and first.class_iri != second.class_iri
