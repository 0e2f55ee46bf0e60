"""Semantic labels on a stage: reading the three encodings in use, finding what is wrong with them, writing them."""

from usd2kg.scene.labels.layer import write_labels
from usd2kg.scene.labels.lint import LabelProblem, lint_labels
from usd2kg.scene.labels.model import (
    LABEL_MODES,
    OUTCOMES,
    ClassLabel,
    LabelMode,
    LabelOptions,
    LabelOutcome,
    LabelReport,
)
from usd2kg.scene.labels.read import LabelReader, read_labels
from usd2kg.scene.labels.survey import LabelledPrim, LabelSurvey, survey_labels

__all__ = [
    "LABEL_MODES",
    "OUTCOMES",
    "ClassLabel",
    "LabelMode",
    "LabelOptions",
    "LabelOutcome",
    "LabelProblem",
    "LabelReader",
    "LabelReport",
    "LabelSurvey",
    "LabelledPrim",
    "lint_labels",
    "read_labels",
    "survey_labels",
    "write_labels",
]
