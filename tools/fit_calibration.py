"""Fit the confidence of the lexical grounder on the training scenes and the training and calibration lists of names.

Usage: python -m tools.fit_calibration

Writes `src/usd2kg/data/calibration.json`: the weights of a logistic model, and its calibration error on each scene when
fitted without it, and on each list when fitted without the lists of its ontology, beside the error that true
confidences would have by chance. Names with a public ontology are answered with the lists of what belongs to its
classes that usd2kg ships, and again without them, as for an ontology that has none.

An answer is right if it is the gold class. Each distinct name of a scene and naming regime counts once, so that copies
of an asset do not dominate.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from benchmarks.bare import bare_scene
from benchmarks.labelled_scenes import LabelledScene, iter_training_scenes
from benchmarks.names.lists import LabelledName, iter_ontology_lists, resolve_home_lists, resolve_list
from tools import build_written_names
from tools.fitting import Array, write_weights
from usd2kg.evaluation.metrics.calibration import mean_absolute_deviation
from usd2kg.grounding import NamingRegime, view_objects
from usd2kg.grounding.lexical.confidence import FEATURES, features_of, general_class_log_odds
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.lexical.scored_view import ScoredView
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene

LIST_WEIGHTS = {"train": 0.5, "calibration": 1.0}
"""Split → weight of a list relative to a scene.

The grounder was improved on `train`, so its answers there are too good; they still bring the confidence closer to the
accuracy with other ontologies.
"""
FULL_WEIGHT_NAMES = 40
"""Distinct names from which a scene has full weight: a few names are no more evidence than as many of a large scene."""
RIDGE = 1.0
"""Strength of the L2 penalty on all weights but the intercept."""
NEWTON_ROUNDS = 50
TOTAL_WEIGHT = 100
"""Sum of the weights of the answers of one scene and regime in the likelihood, relative to the penalty."""


DEFAULT, WITHOUT = LexicalGrounder(), LexicalGrounder(use_member_lists=False)


class Sample(NamedTuple):
    """The answers for one scene or list."""

    features: Array
    """(n, features)."""
    is_right: Array
    """(n,), 0 or 1."""
    weights: Array
    """(n,), with sum 1 for each regime of a scene with enough names."""


def main() -> None:
    """Fit, cross-validate and write."""
    scenes = {case.name: sample_scene(case) for case in iter_training_scenes()}
    home = open_tbox(None)
    lists = {f"home {at}": sample_list(names, home) for at, names in enumerate(resolve_home_lists("train", home))}
    others: dict[str, dict[str, Sample]] = {}
    for names, tbox in iter_ontology_lists(("train", "calibration"), public=False):
        sample = sample_list(resolve_list(names, tbox), tbox, LIST_WEIGHTS[names.split])
        others.setdefault(names.ontology, {})[names.name] = sample
    for names, tbox in iter_ontology_lists(("train",), public=True):
        resolved = resolve_list(names, tbox)
        others[names.ontology] = {
            names.ontology: sample_list(resolved, tbox),
            f"{names.ontology}, without shipped lists": sample_list(resolved, tbox, grounder=WITHOUT),
        }
    samples = scenes | lists
    for own in others.values():
        samples |= own
    figures = {
        "error_on_each_scene_when_left_out": {name: cross_validate([name], samples)[name] for name in scenes},
        "error_on_each_ontology_when_left_out": {
            name: figure for own in others.values() for name, figure in cross_validate(list(own), samples).items()
        },
    }
    write_weights("calibration.json", FEATURES, fit(list(samples.values())), figures, digits=4)


def sample_scene(case: LabelledScene) -> Sample:
    """Return the answers for one scene in all naming regimes."""
    names = [case.scene.by_path[path].name for path in case.paths]
    samples = []
    for regime in NamingRegime:
        answers = decide(case.scene, case.paths, regime, case.tbox)
        is_right = [answers[label.prim_path].prediction.class_iri == label.target for label in case.gold]
        samples.append(sample_answers([answers[path] for path in case.paths], is_right, names, case.tbox))
    return join_samples(samples)


def sample_list(
    names: Sequence[LabelledName],
    tbox: TBox,
    weight: float = LIST_WEIGHTS["train"],
    grounder: LexicalGrounder = DEFAULT,
) -> Sample:
    """Return the answers for a list of names, authored and abbreviated.

    Abbreviated names that the abbreviation model was trained on are left out, since it reads them too well.
    """
    trained = frozenset(build_written_names.names())
    scene = bare_scene("a list of names", [name.obj for name in names])
    paths = [name.obj.prim_path for name in names]
    samples = []
    for regime in (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED):
        answers = decide(scene, paths, regime, tbox, grounder)
        is_right = [answers[name.obj.prim_path].prediction.class_iri == name.target for name in names]
        sample = sample_answers([answers[path] for path in paths], is_right, paths, tbox)
        is_new = [regime is NamingRegime.SEMANTIC or name.obj.name not in trained for name in names]
        samples.append(Sample(*(column[is_new] for column in sample)))
    both = join_samples(samples)
    return both._replace(weights=both.weights * weight)


def decide(
    scene: Scene, paths: list[str], regime: NamingRegime, tbox: TBox, grounder: LexicalGrounder = DEFAULT
) -> dict[str, ScoredView]:
    """Return prim path → answer."""
    views = {obj.prim_path: view for obj, view in view_objects(scene, regime)}
    answers = grounder.score_views([(path, views[path]) for path in paths], tbox)
    return dict(zip(paths, answers, strict=True))


def sample_answers(answers: list[ScoredView], is_right: list[bool], names: list[str], tbox: TBox) -> Sample:
    """Return the answers of one regime; distinct names have equal weights with sum 1, less if they are few."""
    counts = Counter(names)
    general = DEFAULT.general_classes(tbox)
    odds = general_class_log_odds((answer.prediction for answer in answers), general)
    features = [features_of(answer, tbox, general, odds) for answer in answers]
    return Sample(
        features=np.array([[found[name] for name in FEATURES] for found in features]),
        is_right=np.array(is_right, dtype=float),
        weights=np.array([1 / counts[name] / max(len(counts), FULL_WEIGHT_NAMES) for name in names]),
    )


def join_samples(samples: list[Sample]) -> Sample:
    """Return the samples as one."""
    return Sample(*(np.concatenate(columns) for columns in zip(*samples, strict=True)))


def fit(samples: list[Sample]) -> Array:
    """Return the weights of a logistic regression with L2 penalty, by Newton's method."""
    x = np.concatenate([one.features for one in samples])
    y = np.concatenate([one.is_right for one in samples])
    w = np.concatenate([one.weights for one in samples]) * TOTAL_WEIGHT
    ridge = np.diag([0.0] + [RIDGE] * (x.shape[1] - 1))
    beta = np.zeros(x.shape[1])
    for _ in range(NEWTON_ROUNDS):
        p = 1 / (1 + np.exp(-x @ beta))
        gradient = x.T @ (w * (y - p)) - ridge @ beta
        hessian = (x * (w * p * (1 - p))[:, None]).T @ x + ridge
        beta = beta + np.linalg.solve(hessian, gradient)
    return beta


def cross_validate(names: Sequence[str], samples: Mapping[str, Sample]) -> dict[str, dict[str, float]]:
    """Return the calibration error and accuracy on some samples of a model that was fitted on all others."""
    beta = fit([one for other, one in samples.items() if other not in names])
    return {name: _measure(samples[name], beta) for name in names}


def _measure(sample: Sample, beta: Array) -> dict[str, float]:
    """Return the expected calibration error (10 bins), what it would be by chance alone, and the accuracy."""
    p = 1 / (1 + np.exp(-sample.features @ beta))
    bins = np.minimum((p * 10).astype(int), 9)
    total = sample.weights.sum()
    error = chance = 0.0
    for b in np.unique(bins):
        weights, expected = sample.weights[bins == b], p[bins == b]
        error += abs(weights @ (sample.is_right[bins == b] - expected)) / total
        # Copies of a name count as one answer (Kish 1965, effective sample size).
        count = round(weights.sum() ** 2 / (weights @ weights))
        chance += mean_absolute_deviation(count, weights @ expected / weights.sum()) / count * weights.sum() / total
    return {
        "calibration_error": round(float(error), 4),
        "chance_calibration_error": round(float(chance), 4),
        "accuracy": round(float(sample.weights @ sample.is_right / total), 4),
    }


if __name__ == "__main__":
    main()
