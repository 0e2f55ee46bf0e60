"""Measuring grounding: gold labels, metrics, matrices of runs, reports."""

from usd2kg.evaluation.calibrate import fit_scaling
from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.evaluation.matrix import Matrix, read_matrix
from usd2kg.evaluation.reproduce import CellResult, SceneResult, run_matrix
from usd2kg.evaluation.run import Evaluation, evaluate, evaluation_json, selection_of
from usd2kg.evaluation.sample import Score, join_scores
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
    "run_matrix",
    "selection_of",
    "summarize_scores",
]
