"""From a USD stage to a Scene: objects with boxes, poses, masses and evidence, in metres and z-up.

This package alone knows OpenUSD.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from usd2kg.scene.box_pairs import overlapping_pairs
from usd2kg.scene.company import Companion, Company, Nearness, size_distance
from usd2kg.scene.labels import (
    LABEL_MODES,
    OUTCOMES,
    ClassLabel,
    LabelledPrim,
    LabelMode,
    LabelOptions,
    LabelOutcome,
    LabelProblem,
    LabelReport,
    LabelSurvey,
    survey_labels,
    write_labels,
)
from usd2kg.scene.labels.encodings import class_words
from usd2kg.scene.model import (
    Box,
    Diagnostic,
    Encoding,
    Instances,
    Joint,
    Label,
    MaterialDetails,
    ObjectLabels,
    Scene,
    SceneObject,
    StageFrame,
)
from usd2kg.scene.options import ReadOptions, SelectionOverrides
from usd2kg.scene.selection import ASKED_FOR
from usd2kg.scene.standing import Look, Neighbour
from usd2kg.scene.views import (
    ABBREVIATED_LENGTH,
    EVIDENCE_GROUPS,
    STUDY_GROUPS,
    NamingRegime,
    ObjectView,
    abbreviate,
    view_objects,
)

if TYPE_CHECKING:
    from usd2kg.scene.read import explain_choice, read_scene
    from usd2kg.scene.shapes import ShapeDescriptors, describe_shapes

_READERS = {
    "ShapeDescriptors": "shapes",
    "describe_shapes": "shapes",
    "explain_choice": "read",
    "read_scene": "read",
}
"""Public names that load OpenUSD, and their modules: a grounder, which is given records, does not wait for it."""

__all__ = [
    "ABBREVIATED_LENGTH",
    "ASKED_FOR",
    "EVIDENCE_GROUPS",
    "LABEL_MODES",
    "OUTCOMES",
    "STUDY_GROUPS",
    "Box",
    "ClassLabel",
    "Companion",
    "Company",
    "Diagnostic",
    "Encoding",
    "Instances",
    "Joint",
    "Label",
    "LabelMode",
    "LabelOptions",
    "LabelOutcome",
    "LabelProblem",
    "LabelReport",
    "LabelSurvey",
    "LabelledPrim",
    "Look",
    "MaterialDetails",
    "NamingRegime",
    "Nearness",
    "Neighbour",
    "ObjectLabels",
    "ObjectView",
    "ReadOptions",
    "Scene",
    "SceneObject",
    "SelectionOverrides",
    "ShapeDescriptors",
    "StageFrame",
    "abbreviate",
    "class_words",
    "describe_shapes",
    "explain_choice",
    "overlapping_pairs",
    "read_scene",
    "size_distance",
    "survey_labels",
    "view_objects",
    "write_labels",
]


def __getattr__(name: str) -> Any:
    if name not in _READERS:
        raise AttributeError(f"module 'usd2kg.scene' has no attribute {name!r}")
    return getattr(import_module(f"usd2kg.scene.{_READERS[name]}"), name)
