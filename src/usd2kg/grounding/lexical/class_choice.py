"""Deciding: copies of one asset agree, and where candidates are split the class above them may be the better answer."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from usd2kg.grounding.context.neighbours import size_distance
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.model import Prediction
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["agree_by_asset", "safest_class"]

_OUTVOTED = 1.5
"""How many times the votes of a copy's class the other class must have."""
_SAME_SIZE = 0.05

_SHARPNESS = 2.0
"""Scores rank; squared and made to add up to 1 they are near the shares of right answers."""


def safest_class(scores: Mapping[ClassIRI, float], tbox: TBox) -> ClassIRI:
    """Return the class with the greatest expected hierarchical F1 (Silla and Freitas, 2011) over the candidates.

    With P(k) ∝ score(k)², the class c among the candidates and all classes above them for which
    Σ_k P(k) · F1(↑c, ↑k) is largest; of equal ones the more general.
    """
    total = sum(score**_SHARPNESS for score in scores.values())
    shares = {iri: score**_SHARPNESS / total for iri, score in scores.items()}
    choices = {above for iri in scores for above in tbox.closure(iri)}

    def expected(choice: ClassIRI) -> float:
        given = tbox.closure(choice)
        value: float = sum(
            share * 2 * len(given & tbox.closure(iri)) / (len(given) + len(tbox.closure(iri)))
            for iri, share in shares.items()
        )
        return value

    return min(choices, key=lambda iri: (-round(expected(iri), 9), tbox.depths[iri], iri))


def agree_by_asset(views: Sequence[ObjectView], predictions: Sequence[Prediction], tbox: TBox) -> list[Prediction]:
    """Return the predictions, copies of one asset agreeing with the class that most of them are surest of.

    Copies come from the same asset and are of the same size; under a masked regime nobody knows who they are.
    """
    copies: dict[tuple[str, ...], list[int]] = {}
    for index, view in enumerate(views):
        if view.asset and not view.is_masked and predictions[index].class_iri is not None:
            copies.setdefault(view.asset, []).append(index)
    agreed = list(predictions)
    for indices in copies.values():
        votes = _votes([predictions[index] for index in indices])
        if len(votes) > 1:
            chosen = min(votes, key=lambda iri: (-votes[iri], iri))
            own = [index for index in indices if predictions[index].class_iri == chosen]
            speaker = max(own, key=lambda index: (predictions[index].confidence or 0.0, -index))
            for index in indices:
                iri = str(predictions[index].class_iri)
                # A steak knife among knives stays what it is.
                is_outvoted = votes[chosen] > _OUTVOTED * votes[iri] and not tbox.is_subclass(iri, chosen)
                if is_outvoted and _is_copy(views[speaker], views[index]):
                    agreed[index] = _following(predictions[index], predictions[speaker], views[speaker].name)
    return agreed


def _votes(predictions: Sequence[Prediction]) -> dict[ClassIRI, float]:
    """Return class → sum of the confidences of those that have it."""
    votes: dict[ClassIRI, float] = {}
    for prediction in predictions:
        iri = str(prediction.class_iri)
        votes[iri] = votes.get(iri, 0.0) + (prediction.confidence or 0.0)
    return votes


def _is_copy(one: ObjectView, other: ObjectView) -> bool:
    sizes = one.own_size, other.own_size
    return sizes[0] is not None and sizes[1] is not None and size_distance(sizes[0], sizes[1]) < _SAME_SIZE


def _following(prediction: Prediction, best: Prediction, name: str) -> Prediction:
    other = f"“{name}”" if name else "another object"
    explanation = f"it is a copy of {other}, of the same asset and size: {best.explanation}"
    return replace(best, prim_path=prediction.prim_path, explanation=explanation, evidence=("asset",))
