"""Fit the probabilities of the embedded grounder on the labelled scenes of `benchmarks/accuracy/matrix.toml`.

Usage: python tools/fit_calibration.py

Writes `src/usd2kg/grounding/data/calibration.json`: weights of a logistic model, and how well it does on each scene
when fitted on the others. An answer is right if it is the gold class. Each distinct name of a scene and regime counts
once, so that fifty copies of one box do not decide.
"""

import json
import re
import tomllib
from collections import Counter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.evaluation.gold import read_gold
from usd2kg.grounding import ground
from usd2kg.grounding.embedded.calibration import FEATURES, features_of
from usd2kg.pipeline import open_tbox
from usd2kg.scene import NamingRegime, read_scene

ROOT = Path(__file__).parents[1]
MATRIX = ROOT / "benchmarks/accuracy/matrix.toml"
OUTPUT = ROOT / "src/usd2kg/grounding/data/calibration.json"
REGIMES = (NamingRegime.SEMANTIC, NamingRegime.ABBREVIATED, NamingRegime.OPAQUE)
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
    """(n,), adding up to 1 for each regime."""


def main() -> None:
    """Fit, check, write."""
    scenes: dict[str, Sample] = {}
    for scene in tomllib.loads(MATRIX.read_text(encoding="utf-8"))["scene"]:
        path = (MATRIX.parent / scene["path"]).resolve()
        if path.exists() and "test" not in re.findall(r"\w+", scene["name"]):
            scenes[scene["name"]] = sample(scene)
    report = {name: check(name, scenes) for name in scenes}
    weights = fit(list(scenes.values()))
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
    rows, right, weights = [], [], []
    for regime in REGIMES:
        answers = ground(read, tbox, regime=regime, paths=paths).by_path
        known = [label for label in gold if answers[label.prim_path].candidates]
        names = Counter(read.by_path[label.prim_path].name for label in known)
        for label in known:
            answer = answers[label.prim_path]
            rows.append([features_of(answer, tbox)[name] for name in FEATURES])
            right.append(float(answer.class_iri == label.target))
            weights.append(1 / names[read.by_path[label.prim_path].name] / len(names))
    return Sample(np.array(rows), np.array(right), np.array(weights))


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


def check(name: str, scenes: dict[str, Sample]) -> dict[str, float]:
    """Return the calibration error of the model on a scene that it was not fitted on, and the mean right answers."""
    beta = fit([one for other, one in scenes.items() if other != name])
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
