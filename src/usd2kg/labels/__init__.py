"""Semantic labels on stages: read and lint them, and write grounded classes as a layer over a scene."""

from usd2kg.labels.class_labels import LABEL_STYLES, label_maker
from usd2kg.labels.encodings import parse_encodings
from usd2kg.labels.layer import ontologies_of_labels, write_labels
from usd2kg.labels.model import LABEL_MODES, OUTCOMES, ClassLabel, LabelMode, LabelOptions, LabelOutcome, LabelReport
from usd2kg.labels.prim_classes import PrimClass, PrimClasses, classes_of_grounding, read_prim_classes
from usd2kg.labels.stage_labels import label_session, label_stage, remove_session_labels
from usd2kg.labels.stage_lint import LabelLint, lint_stage
from usd2kg.labels.survey import LabelledPrim, LabelSurvey, survey_labels

__all__ = [
    "LABEL_MODES",
    "LABEL_STYLES",
    "OUTCOMES",
    "ClassLabel",
    "LabelLint",
    "LabelMode",
    "LabelOptions",
    "LabelOutcome",
    "LabelReport",
    "LabelSurvey",
    "LabelledPrim",
    "PrimClass",
    "PrimClasses",
    "classes_of_grounding",
    "label_maker",
    "label_session",
    "label_stage",
    "lint_stage",
    "ontologies_of_labels",
    "parse_encodings",
    "read_prim_classes",
    "remove_session_labels",
    "survey_labels",
    "write_labels",
]
