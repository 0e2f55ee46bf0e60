"""Calibrate the confidences of a model on two scenes, and test the calibration on the third.

Usage: python -m benchmarks.llm.calibration MODEL … [--objects N] [--record FILE]

Uses the completions that `benchmarks.llm.forms` has stored for the same options, so it asks nothing and takes seconds.
Each model has one calibration for all forms of its prompts whose confidence is a probability: votes are left out.
"""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.labelled_scenes import LabelledScene, load_scene, read_accuracy_matrix
from benchmarks.llm.forms import FORMS, SCENES, Form, examples_for, spaced
from usd2kg.errors import EvaluationError
from usd2kg.evaluation.calibrate import fit_scaling
from usd2kg.evaluation.metrics.calibration import calibration_error
from usd2kg.evaluation.score import Score, join_scores
from usd2kg.grounding import ground
from usd2kg.grounding.llm.factory import open_llm_grounder


def main() -> None:
    """Print a row for each model and held-out scene."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("models", nargs="+", metavar="MODEL")
    parser.add_argument("--objects", type=int, default=7, help="evenly spaced labels of each scene")
    parser.add_argument("--record", type=Path, default=Path(__file__).with_name("forms.jsonl"))
    options = parser.parse_args()
    specs = {spec.name: spec for spec in read_accuracy_matrix().scenes}
    scenes = [load_scene(specs[name]) for name in SCENES]
    print("| model | held-out scene | fitted on | answers | right % | mean confidence % | calibrated % ", end="")
    print("| calibration error | calibrated | Brier score | calibrated | share of right answers instead |")
    print(f"{'| --- ' * 12}|")
    for model in options.models:
        known = {scene.name: list(read_scores(model, scene, scenes, options)) for scene in scenes}
        for name, held_out in known.items():
            others = [score for other, scores in known.items() if other != name for score in scores]
            print(f"| {Path(model).name} | {name} | {row_of(others, held_out, model)} |")


def read_scores(
    model: str, scene: LabelledScene, scenes: Sequence[LabelledScene], options: argparse.Namespace
) -> Iterator[Score]:
    """Yield the answers about a scene, in each form, that have a stored completion."""
    for form in FORMS.values():
        if form.settings.samples == 1:
            yield from read_form(model, form, scene, scenes, options)


def read_form(
    model: str, form: Form, scene: LabelledScene, scenes: Sequence[LabelledScene], options: argparse.Namespace
) -> Iterator[Score]:
    """Yield the answers in a form that have a stored completion."""
    completions = options.record.with_suffix(".sqlite")
    settings = replace(form.settings, model=model, completions=completions, is_replayed=True)
    examples = examples_for(scene, scenes, form.examples) if form.examples else []
    paths = set(spaced(scene.paths, options.objects))
    gold = [label for label in scene.gold if label.prim_path in paths]
    with open_llm_grounder(settings, examples=examples) as grounder:
        grounding = ground(scene.scene, scene.tbox, grounder, paths=[label.prim_path for label in gold])
    yield from (score for score in join_scores(gold, grounding) if score.confidence is not None)


def row_of(others: Sequence[Score], held_out: Sequence[Score], model: str) -> str:
    """Return the cells of a row: the calibration of the other scenes, applied to the held-out one."""
    counts = f"{len(others)} | {len(held_out)}"
    if not held_out:
        return f"{counts}{' | –' * 8}"
    share = sum(score.is_exact for score in held_out) / len(held_out)
    stated = f"{counts} | {100 * share:.0f} | {100 * mean_confidence(held_out):.0f}"
    raw = f"{calibration_error(held_out):.2f}", f"{brier_score(held_out):.2f}"
    try:
        scaling = fit_scaling(others, model)
    except EvaluationError:
        return f"{stated} | – | {raw[0]} | – | {raw[1]} | – | –"
    fitted = [replace(score, confidence=scaling(score.confidence or 0.0)) for score in held_out]
    constant = sum(score.is_exact for score in others) / len(others)
    without = [replace(score, confidence=constant) for score in held_out]
    return (
        f"{stated} | {100 * mean_confidence(fitted):.0f} | {raw[0]} | {calibration_error(fitted):.2f} "
        f"| {raw[1]} | {brier_score(fitted):.2f} | {brier_score(without):.2f}"
    )


def mean_confidence(scores: Sequence[Score]) -> float:
    """Return the mean confidence."""
    return float(np.mean([score.confidence for score in scores]))


def brier_score(scores: Sequence[Score]) -> float:
    """Return the mean squared difference between confidence and correctness (Brier, 1950)."""
    return float(np.mean([((score.confidence or 0.0) - score.is_exact) ** 2 for score in scores]))


if __name__ == "__main__":
    main()
