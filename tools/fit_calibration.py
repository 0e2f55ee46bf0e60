"""Fit the probabilities of the lexical grounder on the labelled scenes and lists of names that are not tests.

Usage: python tools/fit_calibration.py

Writes `src/usd2kg/data/calibration.json`: weights of a logistic model, and how well it does on each scene
when fitted on the other scenes and the lists. An answer is right if it is the gold class. Each distinct name of a scene
and regime counts once, so that fifty copies of one box do not decide.
"""

import json
import re
import sys
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.evaluation.gold import read_gold
from usd2kg.grounding import NamingRegime, view_objects
from usd2kg.grounding.lexical.concepts.object_likelihoods import Beliefs
from usd2kg.grounding.lexical.confidence import FEATURES, features_of, general_odds
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.model import Prediction
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene, read_scene

ROOT = Path(__file__).parents[1]
MATRIX = ROOT / "benchmarks/accuracy/matrix.toml"
OUTPUT = ROOT / "src/usd2kg/data/calibration.json"
sys.path.insert(0, str(ROOT))

from benchmarks.bare import bare_scene  # noqa: E402  (scripts are no packages of the product)
from benchmarks.names.lists import (  # noqa: E402
    LabelledName,
    iter_ontology_lists,
    resolve_home_lists,
    resolve_list,
)
from tools import build_written_names  # noqa: E402

LISTED = 0.5
"""What a list of names counts against a scene: nobody has built with them."""
UNLEARNED = 1.0
"""The same of a list that nothing was learned from, which tells how sure to be of what nobody prepared for."""
RIDGE = 1.0
"""Strength of the pull of the weights to zero, the intercept's apart."""
ROUNDS = 50

Array = NDArray[np.float64]


class Sample(NamedTuple):
    """The answers of one scene."""

    features: Array
    """(n, features)."""
    is_right: Array
    """(n,), 0 or 1."""
    weights: Array
    """(n,), adding up to 1 for each regime of a scene."""


def main() -> None:
    """Fit, check, write."""
    scenes: dict[str, Sample] = {}
    for scene in tomllib.loads(MATRIX.read_text(encoding="utf-8"))["scene"]:
        path = (MATRIX.parent / scene["path"]).resolve()
        if path.exists() and "test" not in re.findall(r"\w+", scene["name"]):
            scenes[scene["name"]] = sample(scene)
    home = open_tbox(None)
    lists = [sample_of_list(names, home) for names in resolve_home_lists("train", home)]
    for names, tbox in iter_ontology_lists(("train",), public=True):
        lists.append(sample_of_list(resolve_list(names, tbox), tbox))
    for names, tbox in iter_ontology_lists(("calibration",)):
        lists.append(sample_of_list(resolve_list(names, tbox), tbox, UNLEARNED))
    report = {left_out: check(left_out, scenes, lists) for left_out in scenes}
    weights = fit([*scenes.values(), *lists])
    text = {
        "weights": {name: round(float(weight), 4) for name, weight in zip(FEATURES, weights, strict=True)},
        "error_on_each_scene_when_left_out": report,
    }
    OUTPUT.write_text(json.dumps(text, indent=2) + "\n", encoding="utf-8")
    print(OUTPUT.read_text(encoding="utf-8"))


def sample(scene: dict[str, Any]) -> Sample:
    """Return the answers of one scene in all regimes."""
    ontology = scene.get("ontology")
    tbox = open_tbox(MATRIX.parent / ontology if ontology else None)
    gold = read_gold(MATRIX.parent / scene["gold"], tbox)
    paths = [label.prim_path for label in gold]
    read = read_scene(MATRIX.parent / scene["path"], paths=paths)
    samples = []
    for regime in NamingRegime:
        answers = decide(read, paths, regime, tbox)
        is_right = [answers[label.prim_path][0].class_iri == label.target for label in gold]
        names = [read.by_path[path].name for path in paths]
        samples.append(sample_of_answers([answers[path] for path in paths], is_right, names, tbox))
    return joined(samples)


def sample_of_list(things: list[LabelledName], tbox: TBox, share: float = LISTED) -> Sample:
    """Return the answers of a list of names, spelled out and abbreviated.

    Those that the reader of abbreviations learned from do not tell how well it reads others.
    """
    learned = frozenset(build_written_names.names())
    scene, paths = (
        bare_scene("a list of names", [thing.obj for thing in things]),
        [thing.obj.prim_path for thing in things],
    )
    samples = []
    for regime in (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED):
        answers = decide(scene, paths, regime, tbox)
        is_right = [answers[thing.obj.prim_path][0].class_iri == thing.target for thing in things]
        told = sample_of_answers([answers[path] for path in paths], is_right, paths, tbox)
        is_new = [regime is NamingRegime.SEMANTIC or thing.obj.name not in learned for thing in things]
        samples.append(Sample(*(column[is_new] for column in told)))
    both = joined(samples)
    return both._replace(weights=both.weights * share)


def decide(scene: Scene, paths: list[str], regime: NamingRegime, tbox: TBox) -> dict[str, tuple[Prediction, Beliefs]]:
    """Return prim path → the uncalibrated answer, and what is believed of it whatever it is called."""
    views = {obj.prim_path: view for obj, view in view_objects(scene, regime)}
    answers = LexicalGrounder().decide([(path, views[path]) for path in paths], tbox)
    return dict(zip(paths, answers, strict=True))


def sample_of_answers(
    answers: list[tuple[Prediction, Beliefs]], is_right: list[bool], names: list[str], tbox: TBox
) -> Sample:
    """Return the answers of one regime; each distinct name weighs the same, all together 1."""
    counts = Counter(names)
    general = LexicalGrounder().general_classes(tbox)
    odds = general_odds((answer for answer, _ in answers), general)
    features = [features_of(answer, beliefs, tbox, general, odds) for answer, beliefs in answers]
    return Sample(
        features=np.array([[found[name] for name in FEATURES] for found in features]),
        is_right=np.array(is_right, dtype=float),
        weights=np.array([1 / counts[name] / len(counts) for name in names]),
    )


def joined(samples: list[Sample]) -> Sample:
    """Return several samples as one."""
    return Sample(*(np.concatenate(columns) for columns in zip(*samples, strict=True)))


def fit(samples: list[Sample]) -> Array:
    """Return the weights that make the labels most likely, by Newton's method."""
    x = np.concatenate([one.features for one in samples])
    y = np.concatenate([one.is_right for one in samples])
    w = np.concatenate([one.weights for one in samples]) * 100
    ridge = np.diag([0.0] + [RIDGE] * (x.shape[1] - 1))
    beta = np.zeros(x.shape[1])
    for _ in range(ROUNDS):
        p = 1 / (1 + np.exp(-x @ beta))
        gradient = x.T @ (w * (y - p)) - ridge @ beta
        hessian = (x * (w * p * (1 - p))[:, None]).T @ x + ridge
        beta = beta + np.linalg.solve(hessian, gradient)
    return beta


def check(name: str, scenes: dict[str, Sample], lists: list[Sample]) -> dict[str, float]:
    """Return the calibration error of the model on a scene that it was not fitted on, and the mean right answers."""
    beta = fit([*(one for other, one in scenes.items() if other != name), *lists])
    left_out = scenes[name]
    p = 1 / (1 + np.exp(-left_out.features @ beta))
    bins = np.minimum((p * 10).astype(int), 9)
    total = left_out.weights.sum()
    error = sum(
        abs(np.sum(left_out.weights[bins == b] * (left_out.is_right - p)[bins == b])) / total for b in range(10)
    )
    mean = float(np.sum(left_out.weights * left_out.is_right) / total)
    return {"calibration_error": round(float(error), 4), "accuracy": round(mean, 4)}


if __name__ == "__main__":
    main()
