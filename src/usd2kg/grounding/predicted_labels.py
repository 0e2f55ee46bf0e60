"""Predictions that were written to the stage as labels and are read again."""

from collections.abc import Iterable
from dataclasses import replace

from usd2kg.grounding.model import Prediction
from usd2kg.scene import Scene, SceneObject

__all__ = ["limit_to_stated"]


def limit_to_stated(predictions: Iterable[Prediction], scene: Scene) -> list[Prediction]:
    """Return predictions no more certain than the same ones that the stage states as labels.

    A label that was predicted is evidence, but the name, size and neighbours that it was predicted from are read again
    beside it: counted twice, they would make the class more certain with each reading.
    """
    return [_limited(prediction, scene.by_path.get(prediction.prim_path)) for prediction in predictions]


def _limited(prediction: Prediction, obj: SceneObject | None) -> Prediction:
    if obj is None or prediction.confidence is None or not obj.labels.own:
        return prediction
    stated = [
        label.confidence
        for label in obj.labels.own
        if label.confidence is not None and label.iri == prediction.class_iri
    ]
    if not stated or min(stated) >= prediction.confidence:
        return prediction
    return replace(prediction, confidence=min(stated))
