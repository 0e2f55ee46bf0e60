"""Fit the confidence of recognised concepts, on the training lists of `benchmarks/names`.

Usage: python -m tools.fit_concept_confidence

The lists have classes, not concepts: a concept counts as right if its noun means an accepted class of the home TBox.
Writes `src/usd2kg/data/concept_confidence.json`: P(right) is a logistic function of the log-odds of the share.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.bare import bare_scene
from benchmarks.names.lists import resolve_home_lists
from tools.fitting import Array, fit_conditional_logit, write_weights
from usd2kg.grounding.context.views import view_objects
from usd2kg.grounding.lexical.alignment.lexicon import build_lexicon
from usd2kg.grounding.lexical.concepts.home_names import home_names
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.lexical.matching.term_matching import TermMatcher
from usd2kg.grounding.lexical.reading.noun_phrase import NameReader
from usd2kg.grounding.lexical.recognition import ConfidenceWeights, describe_concepts, load_recognizer, share_features
from usd2kg.ontology import ClassIRI
from usd2kg.pipeline import open_tbox

RIDGE = 0.0
FOLDS, BINS = 5, 10


class Recognised(NamedTuple):
    """The concept of one name."""

    share: float
    is_right: bool


def main() -> None:
    """Fit, cross-validate and write."""
    by_list = list(read_lists())
    count = sum(map(len, by_list))
    left_out = [(probability, found.is_right) for fold in range(FOLDS) for probability, found in predict(by_list, fold)]
    figures = {
        "names": count,
        "right": round(sum(right for _, right in left_out) / count, 4),
        "calibration_error_when_left_out": round(calibration_error(left_out), 4),
    }
    weights = fit([name for found in by_list for name in found])
    write_weights("concept_confidence.json", ConfidenceWeights._fields, weights, figures, digits=3)


def read_lists() -> Iterator[list[Recognised]]:
    """Yield the recognised concepts of each training list."""
    tbox, taxonomy, recognizer = open_tbox(None), load_taxonomy(), load_recognizer()
    lexicon = build_lexicon(tbox, taxonomy, home_names())
    terms = TermMatcher(tbox, lexicon, taxonomy, NameReader(lexicon, taxonomy))
    for names in resolve_home_lists("train", tbox):
        views = (view for _, view in view_objects(bare_scene("a list", [name.obj for name in names])))
        pairs = [(name, recognizer.recognize(view)) for name, view in zip(names, views, strict=True)]
        yield [
            Recognised(found.share, class_of(found.concept, terms) in name.accepted)
            for name, found in pairs
            if found is not None
        ]


def class_of(concept: str, terms: TermMatcher) -> ClassIRI | None:
    """Return the class that the noun of a concept means; None if it means none."""
    label = describe_concepts([concept])[concept].label
    matches = terms.match(tuple(label.split()), ()).matches
    return matches[0].class_iri if matches else None


def predict(by_list: Sequence[Sequence[Recognised]], fold: int) -> Iterator[tuple[float, Recognised]]:
    """Yield the probability of each name of a fold's lists by the weights of the other lists."""
    weights = fit([name for at, found in enumerate(by_list) if at % FOLDS != fold for name in found])
    for found in by_list[fold::FOLDS]:
        for name in found:
            yield ConfidenceWeights(*weights).probability(name.share), name


def fit(names: Sequence[Recognised]) -> Array:
    """Return the weights that make the outcomes most likely: a choice between right and wrong for each name."""
    options = np.zeros((2 * len(names), len(ConfidenceWeights._fields)))
    options[::2] = [share_features(name.share) for name in names]
    is_right = np.array([[name.is_right, not name.is_right] for name in names]).ravel()
    return fit_conditional_logit(options, [2] * len(names), is_right, np.ones(len(names)), ridge=RIDGE)


def calibration_error(outcomes: Sequence[tuple[float, bool]]) -> float:
    """Return the expected calibration error over bins of equal count (Naeini et al., AAAI 2015)."""
    ordered = np.array(sorted(outcomes))
    bins = np.array_split(ordered, BINS)
    return float(sum(len(part) * abs(part[:, 0].mean() - part[:, 1].mean()) for part in bins) / len(ordered))


if __name__ == "__main__":
    main()
