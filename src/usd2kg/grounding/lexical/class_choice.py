"""Choose one class from scored candidates: agreement of copies, and abstention to a superclass."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from usd2kg.grounding.context.neighbours import size_distance
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.settings import ABSTENTION, COPIES
from usd2kg.grounding.model import Prediction
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["choose_superclass", "reconcile_copies", "superclass_confidence"]


def choose_superclass(scores: Mapping[ClassIRI, float], tbox: TBox) -> ClassIRI:
    """Return the class with the highest expected hierarchical F1 (Silla and Freitas, 2011) over the candidates.

    Maximises Σ_k P(k) · F1(↑c, ↑k) over the candidates and their superclasses c, with P(k) ∝ score(k)^`score_power`
    and ↑ the closure of superclasses. Ties go to the more general class.
    """
    shares = _shares(scores)
    choices = {above for iri in scores for above in tbox.closure(iri)}

    def expected(choice: ClassIRI) -> float:
        given = tbox.closure(choice)
        value: float = sum(
            share * 2 * len(given & tbox.closure(iri)) / (len(given) + len(tbox.closure(iri)))
            for iri, share in shares.items()
        )
        return value

    return min(choices, key=lambda iri: (-round(expected(iri), 9), tbox.depths[iri], iri))


def superclass_confidence(
    superclass: ClassIRI, replaced: ClassIRI, confidence: float, scores: Mapping[ClassIRI, float], tbox: TBox
) -> float:
    """Return the probability that an object belongs to the class that replaces the best candidate, to four decimals.

    The sum of the probabilities of the candidates that are subclasses of it: the best has its calibrated confidence p,
    any other k has (1 - p) · P(k), with P as in `choose_superclass`. So a superclass is never less probable than the
    candidate it replaces, and (1 - p) · P(best) is left for classes that are not candidates.

    Args:
        superclass: the chosen class.
        replaced: the best candidate.
        confidence: the calibrated confidence of the best candidate.
        scores: candidate → score.
        tbox: the classes.
    """
    others = sum(share for iri, share in _shares(scores).items() if iri != replaced and superclass in tbox.closure(iri))
    own = confidence if superclass in tbox.closure(replaced) else 0.0
    return round(own + (1 - confidence) * others, 4)


def _shares(scores: Mapping[ClassIRI, float]) -> dict[ClassIRI, float]:
    """Return candidate → its share of the sum of the scores to the power of `score_power`."""
    total = sum(score**ABSTENTION.score_power for score in scores.values())
    return {iri: score**ABSTENTION.score_power / total for iri, score in scores.items()}


def reconcile_copies(views: Sequence[ObjectView], predictions: Sequence[Prediction], tbox: TBox) -> list[Prediction]:
    """Return the predictions, with copies of one asset assigned the class with the largest summed confidence.

    Copies come from the same asset and have the same size. A copy keeps its own class if that is a subclass: a steak
    knife among knives. Masked regimes hide assets, so their predictions are unchanged.
    """
    instances: dict[tuple[str, ...], list[int]] = {}
    for index, view in enumerate(views):
        if view.asset and not view.is_masked and predictions[index].class_iri is not None:
            instances.setdefault(view.asset, []).append(index)
    reconciled = list(predictions)
    for indices in instances.values():
        votes = _sum_confidences([predictions[index] for index in indices])
        if len(votes) < 2:
            continue
        chosen = min(votes, key=lambda iri: (-votes[iri], iri))
        voters = [index for index in indices if predictions[index].class_iri == chosen]
        surest = max(voters, key=lambda index: (predictions[index].confidence or 0.0, -index))
        for index in indices:
            iri = str(predictions[index].class_iri)
            is_outvoted = votes[chosen] > COPIES.min_vote_ratio * votes[iri] and not tbox.is_subclass(iri, chosen)
            if is_outvoted and _is_copy(views[surest], views[index]):
                reconciled[index] = _copy_prediction(
                    predictions[surest], predictions[index].prim_path, views[surest].name
                )
    return reconciled


def _sum_confidences(predictions: Sequence[Prediction]) -> dict[ClassIRI, float]:
    """Return class → sum of the confidences of its predictions."""
    totals: dict[ClassIRI, float] = {}
    for prediction in predictions:
        iri = str(prediction.class_iri)
        totals[iri] = totals.get(iri, 0.0) + (prediction.confidence or 0.0)
    return totals


def _is_copy(one: ObjectView, other: ObjectView) -> bool:
    if one.own_size is None or other.own_size is None:
        return False
    return size_distance(one.own_size, other.own_size) < COPIES.size_distance


def _copy_prediction(prediction: Prediction, prim_path: str, name: str) -> Prediction:
    original = f"“{name}”" if name else "another object"
    explanation = f"it is a copy of {original}, of the same asset and size: {prediction.explanation}"
    return replace(prediction, prim_path=prim_path, explanation=explanation, evidence=("asset",))
