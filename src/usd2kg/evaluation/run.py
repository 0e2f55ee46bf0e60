"""Evaluation of one grounder on one scene, under one naming regime and set of evidence groups."""

import math
import time
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from usd2kg.evaluation.gold import GoldLabel
from usd2kg.evaluation.metrics.selection_scores import SelectionScore, score_selection
from usd2kg.evaluation.score import Score, drop_missed, join_scores
from usd2kg.evaluation.summary import Summary, summarize_scores
from usd2kg.grounding import ABBREVIATED_LENGTH, Decision, Grounder, Grounding, NamingRegime, ground
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import ASKED_FOR, Scene

__all__ = ["Evaluation", "evaluate", "evaluation_json", "score_grounding", "score_scene_selection"]

_END_TO_END = ("answered", "ema", "ema_interval", "ema_name_interval", "ema_also", "hf1", "hf1_interval")
"""The metrics of the end-to-end score in JSON."""


@dataclass(frozen=True)
class Evaluation:
    """The scores of one run, with their summary."""

    grounding: Grounding
    scores: tuple[Score, ...]
    summary: Summary
    """Summary over all labelled objects, whether or not the object selection finds them."""
    end_to_end: Summary
    """Summary in which objects that the object selection misses count as wrong."""
    seconds: float
    """Wall time of grounding the labelled objects, without reading the scene; NaN if unknown."""


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
    seconds = time.perf_counter() - start
    return score_grounding(grounding, gold, tbox, seconds, missed=score_scene_selection(scene, gold).missed)


def score_grounding(
    grounding: Grounding,
    gold: Sequence[GoldLabel],
    tbox: TBox,
    seconds: float = math.nan,
    *,
    missed: Collection[str] = (),
) -> Evaluation:
    """Return the evaluation of an existing grounding.

    Args:
        grounding: the answers.
        gold: the labels.
        tbox: the classes.
        seconds: the time that the grounding took; NaN if unknown.
        missed: prim paths of labelled objects that the object selection misses, see `score_scene_selection`.
    """
    scores = join_scores(gold, grounding)
    summary = summarize_scores(scores, tbox)
    end_to_end = summarize_scores(drop_missed(scores, frozenset(missed)), tbox) if missed else summary
    return Evaluation(grounding, scores, summary, end_to_end, seconds)


def score_scene_selection(scene: Scene, gold: Sequence[GoldLabel]) -> SelectionScore:
    """Return recall and precision of the selection rules on the labelled prims; prims read on request do not count."""
    selected = [obj.prim_path for obj in scene.objects if obj.selected_by != ASKED_FOR]
    return score_selection(selected, (label.prim_path for label in gold))


def evaluation_json(evaluation: Evaluation, selection: SelectionScore | None = None) -> dict[str, Any]:
    """Return an evaluation as plain data: the summary, the settings of the run, and every score."""
    grounding = evaluation.grounding
    data: dict[str, Any] = {
        **evaluation.summary.as_json(),
        "end_to_end": {key: evaluation.end_to_end.as_json()[key] for key in _END_TO_END},
        "seconds": None if math.isnan(evaluation.seconds) else evaluation.seconds,
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
