"""Evaluation of one grounder on one scene, under one naming regime and set of evidence groups."""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.evaluation.metrics.selection_scores import SelectionScore, score_selection
from usd2kg.evaluation.score import Score, join_scores
from usd2kg.evaluation.summary import Summary, summarize_scores
from usd2kg.grounding import ABBREVIATED_LENGTH, Decision, Grounder, Grounding, NamingRegime, ground
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import ASKED_FOR, Scene

__all__ = ["Evaluation", "evaluate", "evaluation_json", "score_grounding", "score_scene_selection"]


@dataclass(frozen=True)
class Evaluation:
    """The scores of one run, with their summary."""

    grounding: Grounding
    scores: tuple[Score, ...]
    summary: Summary
    seconds: float
    """Wall time of grounding the labelled objects, without reading the scene."""


def evaluate(
    scene: Scene,
    gold: Sequence[GoldLabel],
    tbox: TBox,
    grounder: Grounder,
    *,
    regime: NamingRegime = NamingRegime.SEMANTIC,
    evidence: frozenset[str] | None = None,
    decisions: Mapping[str, ClassIRI | Decision] | None = None,
    abbreviated_length: int = ABBREVIATED_LENGTH,
) -> Evaluation:
    """Return the evaluation of a grounder on the labelled prims of a scene.

    Read the scene with the gold paths as `paths`, so that each is an object. All other objects serve as context.
    """
    start = time.perf_counter()
    paths = [label.prim_path for label in gold]
    grounding = ground(
        scene,
        tbox,
        grounder,
        regime=regime,
        evidence=evidence,
        paths=paths,
        decisions=decisions,
        abbreviated_length=abbreviated_length,
    )
    return score_grounding(grounding, gold, tbox, time.perf_counter() - start)


def score_grounding(grounding: Grounding, gold: Sequence[GoldLabel], tbox: TBox, seconds: float) -> Evaluation:
    """Return the evaluation of an existing grounding; `seconds` is the time it took."""
    scores = join_scores(gold, grounding)
    return Evaluation(grounding, scores, summarize_scores(scores, tbox), seconds)


def score_scene_selection(scene: Scene, gold: Sequence[GoldLabel]) -> SelectionScore:
    """Return recall and precision of the selection rules on the labelled prims; prims read on request do not count."""
    selected = [obj.prim_path for obj in scene.objects if obj.selected_by != ASKED_FOR]
    return score_selection(selected, (label.prim_path for label in gold))


def evaluation_json(evaluation: Evaluation, selection: SelectionScore | None = None) -> dict[str, Any]:
    """Return an evaluation as plain data: the summary, the settings of the run, and every score."""
    grounding = evaluation.grounding
    data: dict[str, Any] = {
        **evaluation.summary.as_json(),
        "seconds": evaluation.seconds,
        "scene": grounding.scene,
        "scene_hash": grounding.scene_hash,
        "ontology": grounding.ontology,
        "ontology_hash": grounding.ontology_hash,
        "grounder": grounding.grounder,
        "settings": dict(grounding.settings),
        "is_calibrated": grounding.is_calibrated,
        "tool_version": grounding.tool_version,
        "scores": [_score_json(score) for score in evaluation.scores],
    }
    if selection is not None:
        data["selection"] = selection._asdict()
    return data


def _score_json(score: Score) -> Mapping[str, Any]:
    return {
        "path": score.id,
        "target": score.target,
        "also": sorted(score.also),
        "answer": score.answer,
        "confidence": score.confidence,
        "status": score.status.value,
        "explanation": score.explanation,
    }
