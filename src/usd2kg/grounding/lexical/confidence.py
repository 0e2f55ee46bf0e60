"""From scores to probabilities: a logistic model of few features, fitted on labelled scenes (Platt, 1999).

The parameters are in `data/calibration.json`, written by `tools/fit_calibration.py`.
"""

import json
import math
from collections.abc import Container, Iterable, Mapping
from functools import lru_cache

from usd2kg.grounding.lexical.alignment.lexicon import home_names
from usd2kg.grounding.lexical.concepts.object_likelihoods import Beliefs
from usd2kg.grounding.model import Prediction
from usd2kg.knowledge import read_text
from usd2kg.ontology import ClassIRI, TBox

__all__ = ["FEATURES", "features_of", "general_odds", "probability"]

FEATURES = (
    "intercept",
    "score",
    "margin",
    "is_label",
    "is_general",
    "has_subclasses",
    "is_company",
    "is_foreign",
    "foreign_margin",
    "foreign_general",
    "foreign_subclasses",
    "foreign_general_odds",
    "company_score",
    "belief",
)
"""What the parameters are called."""
_BY_LOOK = frozenset({"company", "geometry"})
_LEAST, _USUAL = 0.01, 0.1
_LABEL = 0.95
"""A score that only the class's own label reaches."""
_SUPPOSED_GENERAL, _SUPPOSED = 2, 10
"""Of so many answers that are supposed to come before a stage's so many are general."""


def general_odds(predictions: Iterable[Prediction], general: Container[ClassIRI]) -> float:
    """Return the logarithm of the odds that a thing whose name was understood is said to be of a general class.

    Of an ontology that has classes for what is on a stage one is seldom the answer, and then mostly a better one was
    missed; of one that was made for other things it is often, and right.

    Args:
        predictions: the answers of a stage.
        general: the classes that say little, see `LexicalGrounder.general_classes`.
    """
    told = [iri in general for one in predictions if _is_by_words(one) and (iri := one.class_iri)]
    share = (sum(told) + _SUPPOSED_GENERAL) / (len(told) + _SUPPOSED)
    return math.log(share / (1 - share))


def _is_by_words(prediction: Prediction) -> bool:
    return bool(prediction.evidence) and _BY_LOOK.isdisjoint(prediction.evidence)


def features_of(
    prediction: Prediction, look: Beliefs, tbox: TBox, general: Container[ClassIRI], odds: float
) -> dict[str, float]:
    """Return the features of an answer.

    - `score`: of the likeliest class, 0 to 1;
    - `margin`: how far the next class is behind;
    - `is_label`: whether the name is the class's own label;
    - `is_general`: whether the class is true of so much that a better one may be missed;
    - `has_subclasses`: whether classes are below it, of which a person may have chosen one: a table fork for a fork;
    - `is_company`: whether other objects or the size decided and not the words;
    - `is_foreign`: whether the class is none of the built-in home TBox, so that the home vocabulary says nothing of it;
    - `foreign_margin`, `foreign_general` and `foreign_subclasses`: what these say where it is so;
    - `foreign_general_odds`: how often the stage's things are of a general class, where this one is so by its words;
    - `company_score`: the score, where they did;
    - `belief`: how probable the class is by what the object looks like, the logarithm against a tenth; 0 where its size
      is not known, where the words did not decide, and for classes of other ontologies.

    Args:
        prediction: the answer, with the scores of its candidates.
        look: what the object is believed to be by its size, how it stands, and where the names above say.
        tbox: the classes.
        general: those of them that say little.
        odds: see `general_odds`, of the answers of the stage.
    """
    scores = [candidate.score for candidate in prediction.candidates]
    first, second = (*scores, 0.0, 0.0)[:2]
    iri = prediction.class_iri
    is_general = iri in general
    has_subclasses = iri is not None and bool(tbox.children[iri])
    is_foreign = iri is not None and iri not in home_names()
    is_by_look = not _BY_LOOK.isdisjoint(prediction.evidence)
    return {
        "intercept": 1.0,
        "score": first,
        "margin": first - second,
        "is_label": float(first > _LABEL),
        "is_general": float(is_general),
        "has_subclasses": float(has_subclasses),
        "is_company": float(is_by_look),
        "is_foreign": float(is_foreign),
        "foreign_margin": first - second if is_foreign else 0.0,
        "foreign_general": float(is_foreign and is_general),
        "foreign_subclasses": float(is_foreign and has_subclasses),
        "foreign_general_odds": odds if is_foreign and is_general and _is_by_words(prediction) else 0.0,
        "company_score": first if is_by_look else 0.0,
        "belief": _belief(prediction, look),
    }


def _belief(prediction: Prediction, look: Beliefs) -> float:
    iri = prediction.class_iri
    if iri is None or iri not in home_names() or not look.classes or not _BY_LOOK.isdisjoint(prediction.evidence):
        return 0.0
    return math.log((look.probability(iri) + _LEAST) / _USUAL)


def probability(features: Mapping[str, float]) -> float:
    """Return the probability that the answer is the class a person would choose, to four decimals."""
    weights = _weights()
    # A feature that is being fitted for the first time has no weight yet.
    return round(1 / (1 + math.exp(-sum(weights.get(name, 0.0) * value for name, value in features.items()))), 4)


@lru_cache(maxsize=1)
def _weights() -> dict[str, float]:
    text = read_text("calibration.json")
    found: dict[str, float] = json.loads(text)["weights"]
    return found
