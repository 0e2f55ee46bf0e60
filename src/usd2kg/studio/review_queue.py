"""The review queue: open objects in groups that one decision settles, in an order."""

import statistics
from collections import Counter
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from itertools import pairwise

from usd2kg.grounding import Prediction
from usd2kg.ontology import ClassIRI
from usd2kg.scene import SceneObject
from usd2kg.studio.object_review import ObjectReview
from usd2kg.studio.settings import QUEUE
from usd2kg.studio.verdicts import Action, Event

__all__ = [
    "AUDIT_ORDER",
    "QUEUE_ORDERS",
    "QueueGroup",
    "estimate_seconds",
    "group_open",
    "make_audit_queue",
    "make_queue",
]

AUDIT_ORDER = "audit"
"""The order in which each object of the random sample is a group."""


@dataclass(frozen=True, slots=True)
class QueueGroup:
    """Open objects with the same suggestion and the same concept; without a concept, with the same words or asset."""

    id: str
    """Prim path of its first object: stable until that object is decided."""
    title: str
    objects: tuple[str, ...]
    """Prim paths, the least confident first."""
    suggested: ClassIRI | None
    concept: str | None
    confidence: float | None
    """Mean of the objects; None if the grounder gave none."""
    gain: float
    """Expected number of wrong classes in the group: what a look at it settles."""
    is_disputed: bool = False
    """Whether a second grounder gives its objects another class, if the queue is in that order."""
    second: ClassIRI | None = None
    """The class by the second grounder, if it is disputed; None if that grounder says that no class fits."""


def make_queue(
    states: Iterable[ObjectReview], objects: Mapping[str, SceneObject], rooms: Mapping[str, int], order: str
) -> list[QueueGroup]:
    """Return the groups of the open objects.

    Args:
        states: the states of all objects, in scene order.
        objects: prim path → object.
        rooms: prim path → number of its room; absent if it is in none.
        order: one of `QUEUE_ORDERS`.
    """
    if order == "place":
        # Room by room, in each by gain.
        groups = group_open(states, objects, lambda prediction: rooms.get(prediction.prim_path, -1))
        place = {group.id: rooms.get(group.id, len(objects)) for group in groups}
        return sorted(groups, key=lambda group: (place[group.id], -group.gain, group.id))
    return sorted(group_open(states, objects), key=_ORDERS[order])


def group_open(
    states: Iterable[ObjectReview],
    objects: Mapping[str, SceneObject],
    apart: Callable[[Prediction], object] = lambda _: None,
) -> list[QueueGroup]:
    """Return the groups of the open objects, in scene order.

    Args:
        states: the states of all objects, in scene order.
        objects: prim path → object.
        apart: what objects of one group have in common apart from the suggestion and the concept or words.
    """
    found: dict[tuple[object, ...], list[Prediction]] = {}
    for state in states:
        if state.status.is_open:
            key = (apart(state.prediction), state.status, *_key(state.prediction, objects[state.prim_path]))
            found.setdefault(key, []).append(state.prediction)
    common = _common_words(objects.values())
    return [_make_group(predictions, objects, common) for predictions in found.values()]


_ORDERS: Mapping[str, Callable[[QueueGroup], tuple[object, ...]]] = {
    "gain": lambda group: (-group.gain, group.id),
    "confidence": lambda group: (group.confidence or 0.0, group.id),
    "class": lambda group: (group.suggested or "", -group.gain, group.id),
}
QUEUE_ORDERS = (*_ORDERS, "place")


def make_audit_queue(
    paths: Iterable[str], predictions: Mapping[str, Prediction], objects: Mapping[str, SceneObject]
) -> list[QueueGroup]:
    """Return a group for each object of an audit, without the confidence, which would sway the reviewer."""
    common = _common_words(objects.values())
    groups = (_make_group([predictions[path]], objects, common) for path in paths)
    return [replace(group, confidence=None, gain=0.0) for group in groups]


def _key(prediction: Prediction, obj: SceneObject) -> tuple[object, ...]:
    """Return what the objects of a group share."""
    if prediction.concept is not None:
        return prediction.class_iri, prediction.concept
    words = tuple(sorted({word for word in obj.words if not word.isdigit()}))
    return prediction.class_iri, words or obj.asset[:1] or obj.prim_path


def _make_group(
    predictions: Sequence[Prediction], objects: Mapping[str, SceneObject], common: Container[str]
) -> QueueGroup:
    ranked = sorted(predictions, key=lambda p: p.confidence or 0.0)
    known = [p.confidence for p in ranked if p.confidence is not None]
    first = predictions[0]
    return QueueGroup(
        id=first.prim_path,
        title=_title([objects[p.prim_path] for p in predictions], common),
        objects=tuple(p.prim_path for p in ranked),
        suggested=first.class_iri,
        concept=first.concept,
        confidence=statistics.fmean(known) if known else None,
        gain=sum(1 - (p.confidence or 0.0) for p in predictions),
    )


def _common_words(objects: Iterable[SceneObject]) -> frozenset[str]:
    """Return the words of most names of a scene, such as those of a vendor, which tell no objects apart."""
    names = [set(obj.words) for obj in objects]
    counts = Counter(word for words in names for word in words)
    return frozenset(word for word, count in counts.items() if count >= QUEUE.common_share * len(names) > 2)


def _title(objects: Sequence[SceneObject], common: Container[str]) -> str:
    """Return the words that all names of a group share, without those of the scene, else the first name."""
    shared = [
        word
        for word in objects[0].words
        if not word.isdigit() and word not in common and all(word in obj.words for obj in objects[1:])
    ]
    return " ".join(shared) or objects[0].display_name or objects[0].name


def estimate_seconds(events: Sequence[Event], open_groups: int) -> float | None:
    """Return how long the open groups will take at the pace of the last decisions; None before five decisions.

    The pace is the median time between two decisions; longer breaks do not count.
    """
    times = [datetime.fromisoformat(event.time) for event in events if event.action is Action.DECIDE]
    gaps = [(later - earlier).total_seconds() for earlier, later in pairwise(times[-QUEUE.pace_decisions :])]
    worked = [gap for gap in gaps if 0 <= gap <= QUEUE.longest_pause_s]
    return statistics.median(worked) * open_groups if len(worked) >= QUEUE.min_decisions - 1 else None
