"""Semantic labels on stages: read them, lint them, and write the classes of a run as an override layer."""

from usd2kg.labels.classes import NAMINGS, label_maker
from usd2kg.labels.layer import write_labels
from usd2kg.labels.model import LABEL_MODES, OUTCOMES, ClassLabel, LabelMode, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.runs import Answer, Run, read_run
from usd2kg.labels.stage_lint import LabelLint, lint_stage
from usd2kg.labels.survey import LabelledPrim, LabelSurvey, survey_labels
from usd2kg.labels.write import label_stage

__all__ = [
    "LABEL_MODES",
    "NAMINGS",
    "OUTCOMES",
    "Answer",
    "ClassLabel",
    "LabelLint",
    "LabelMode",
    "LabelOptions",
    "LabelOutcome",
    "LabelReport",
    "LabelSurvey",
    "LabelledPrim",
    "Run",
    "label_maker",
    "label_stage",
    "lint_stage",
    "read_run",
    "survey_labels",
    "write_labels",
]
