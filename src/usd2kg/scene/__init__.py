"""From a USD stage to a Scene: objects with boxes, poses, masses and evidence, in metres and z-up.

This package alone knows OpenUSD.
"""

from usd2kg.scene.box_pairs import overlapping_pairs
from usd2kg.scene.company import Companion, Company, Nearness, size_distance
from usd2kg.scene.model import (
    Box,
    Diagnostic,
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
from usd2kg.scene.read import ASKED_FOR, explain_choice, read_scene
from usd2kg.scene.shapes import ShapeDescriptors, describe_shapes
from usd2kg.scene.views import (
    ABBREVIATED_LENGTH,
    EVIDENCE_GROUPS,
    STUDY_GROUPS,
    NamingRegime,
    ObjectView,
    abbreviate,
    view_objects,
)

__all__ = [
    "ABBREVIATED_LENGTH",
    "ASKED_FOR",
    "EVIDENCE_GROUPS",
    "STUDY_GROUPS",
    "Box",
    "Companion",
    "Company",
    "Diagnostic",
    "Instances",
    "Joint",
    "Label",
    "MaterialDetails",
    "NamingRegime",
    "Nearness",
    "ObjectLabels",
    "ObjectView",
    "ReadOptions",
    "Scene",
    "SceneObject",
    "SelectionOverrides",
    "ShapeDescriptors",
    "StageFrame",
    "abbreviate",
    "describe_shapes",
    "explain_choice",
    "overlapping_pairs",
    "read_scene",
    "size_distance",
    "view_objects",
]
