"""Grounding evaluation: gold labels, metrics, run matrices and reports."""

from usd2kg.evaluation.calibrate import fit_scaling
from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.evaluation.matrix import Matrix, read_matrix
from usd2kg.evaluation.predictions import read_predictions
from usd2kg.evaluation.run import Evaluation, evaluate, evaluation_json, score_grounding, score_scene_selection
from usd2kg.evaluation.run_matrix import CellResult, SceneResult, run_matrix
from usd2kg.evaluation.score import Score, join_scores
from usd2kg.evaluation.summary import Summary, summarize_scores

__all__ = [
    "CellResult",
    "Evaluation",
    "GoldLabel",
    "Matrix",
    "SceneResult",
    "Score",
    "Summary",
    "evaluate",
    "evaluation_json",
    "fit_scaling",
    "join_scores",
    "read_gold",
    "read_matrix",
    "read_predictions",
    "run_matrix",
    "score_grounding",
    "score_scene_selection",
    "summarize_scores",
]
