"""Calibrated confidence: a logistic model of a few features of a prediction (Platt, 1999).

`tools/fit_calibration.py` fits the weights on labelled scenes and writes them to `data/calibration.json`.
"""

import json
import math
from collections.abc import Container, Iterable, Mapping
from functools import lru_cache

from usd2kg.grounding.lexical.class_posterior import ClassPosterior
from usd2kg.grounding.lexical.evidence_combination import CONTEXT_GROUPS
from usd2kg.grounding.lexical.scored_view import ScoredView
from usd2kg.grounding.lexical.settings import CONFIDENCE
from usd2kg.grounding.model import Prediction
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, TBox, load_home_tbox

__all__ = ["FEATURES", "calibrate", "features_of", "general_class_log_odds"]

FEATURES = (
    "intercept",
    "score",
    "margin",
    "is_label",
    "is_general",
    "has_subclasses",
    "is_by_context",
    "is_foreign",
    "foreign_margin",
    "foreign_general",
    "foreign_subclasses",
    "foreign_general_log_odds",
    "context_score",
    "posterior",
    "is_listed",
    "listed_general",
    "unknown_share",
    "foreign_unknown_share",
)
"""Names of the features."""


def general_class_log_odds(predictions: Iterable[Prediction], general: Container[ClassIRI]) -> float:
    """Return the log-odds of a general class among the predictions that words decided.

    In an ontology of the stage's own domain, a general answer is usually a missed specific class; in an ontology of
    another domain, it is usually right. Smoothed with a beta prior.

    Args:
        predictions: the predictions of a stage.
        general: the general classes, see `LexicalGrounder.general_classes`.
    """
    answers = [iri in general for one in predictions if _is_by_words(one) and (iri := one.class_iri)]
    share = (sum(answers) + CONFIDENCE.prior_general) / (len(answers) + CONFIDENCE.prior_answers)
    return math.log(share / (1 - share))


def _is_by_words(prediction: Prediction) -> bool:
    return bool(prediction.evidence) and CONTEXT_GROUPS.isdisjoint(prediction.evidence)


def features_of(scored: ScoredView, tbox: TBox, general: Container[ClassIRI], log_odds: float) -> dict[str, float]:
    """Return the features of a prediction.

    - `score`: score of the best class, 0 to 1;
    - `margin`: score of the best class less that of the second;
    - `is_label`: whether the name is the class's own label;
    - `is_general`: whether the class is a general one;
    - `has_subclasses`: whether the class has subclasses, one of which a person may choose;
    - `is_by_context`: whether neighbours, size or place decided rather than words;
    - `is_foreign`: whether the class is not one of the built-in home TBox;
    - `foreign_margin`, `foreign_general`, `foreign_subclasses`: the features above, for foreign classes only;
    - `foreign_general_log_odds`: `general_class_log_odds`, for foreign general classes that were chosen by words;
    - `context_score`: the score, where the context decided;
    - `posterior`: log of the probability given size and place, relative to 0.1; 0 where the size is unknown,
      where the context decided, and for foreign classes;
    - `is_listed`: whether a list of what belongs to the class decided;
    - `listed_general`: the same, for general classes;
    - `unknown_share`: the share of the words of the name that are not known;
    - `foreign_unknown_share`: the same, for foreign classes only.

    Args:
        scored: the prediction with the scores of its candidates, and class probabilities given size, stance and the
            places that names above mention.
        tbox: the classes.
        general: the general ones among them.
        log_odds: see `general_class_log_odds`, for the predictions of the stage.
    """
    prediction, posterior, is_listed, unknown_share = scored
    scores = [candidate.score for candidate in prediction.candidates]
    first, second = (*scores, 0.0, 0.0)[:2]
    iri = prediction.class_iri
    is_general = iri in general
    has_subclasses = iri is not None and bool(tbox.children[iri])
    is_foreign = iri is not None and iri not in load_home_tbox().by_iri
    is_by_context = not CONTEXT_GROUPS.isdisjoint(prediction.evidence)
    return {
        "intercept": 1.0,
        "score": first,
        "margin": first - second,
        "is_label": float(first > CONFIDENCE.label_score),
        "is_general": float(is_general),
        "has_subclasses": float(has_subclasses),
        "is_by_context": float(is_by_context),
        "is_foreign": float(is_foreign),
        "foreign_margin": first - second if is_foreign else 0.0,
        "foreign_general": float(is_foreign and is_general),
        "foreign_subclasses": float(is_foreign and has_subclasses),
        "foreign_general_log_odds": log_odds if is_foreign and is_general and _is_by_words(prediction) else 0.0,
        "context_score": first if is_by_context else 0.0,
        "posterior": 0.0 if is_foreign or is_by_context else _log_posterior(iri, posterior),
        "is_listed": float(is_listed),
        "listed_general": float(is_listed and is_general),
        "unknown_share": unknown_share,
        "foreign_unknown_share": unknown_share if is_foreign else 0.0,
    }


def _log_posterior(iri: ClassIRI | None, posterior: ClassPosterior) -> float:
    if iri is None or not posterior.columns:
        return 0.0
    probability = posterior.probability(iri) + CONFIDENCE.posterior_floor
    return math.log(probability / CONFIDENCE.posterior_reference)


def calibrate(features: Mapping[str, float]) -> float:
    """Return the probability that a person would choose the predicted class, to four decimals."""
    weights = _weights()
    # A new feature has no weight until it is fitted.
    return round(1 / (1 + math.exp(-sum(weights.get(name, 0.0) * value for name, value in features.items()))), 4)


@lru_cache(maxsize=1)
def _weights() -> dict[str, float]:
    weights: dict[str, float] = json.loads(read_text("calibration.json"))["weights"]
    return weights
