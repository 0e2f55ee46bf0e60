"""USD stage → Scene: objects with boxes, poses, masses and evidence, in metres and z-up.

Only this package, `convert`, `labels` and `render` import OpenUSD.
"""

from typing import TYPE_CHECKING

from usd2kg.lazy_names import lazy_names
from usd2kg.scene.coincidence import find_surplus
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
    StageFile,
    StageFrame,
)
from usd2kg.scene.object_selection import ASKED_FOR
from usd2kg.scene.options import ReadOptions, SelectionOverrides
from usd2kg.scene.robots import ROBOT

if TYPE_CHECKING:
    from usd2kg.scene.label_encodings import class_words
    from usd2kg.scene.label_lint import LabelProblem
    from usd2kg.scene.read import explain_choice, read_scene
    from usd2kg.scene.shape_descriptors import ShapeDescriptors, describe_shapes

_LAZY = {
    "LabelProblem": "label_lint",
    "ShapeDescriptors": "shape_descriptors",
    "class_words": "label_encodings",
    "describe_shapes": "shape_descriptors",
    "explain_choice": "read",
    "read_scene": "read",
}
"""Public name → module that imports OpenUSD; loaded on first use, so that code that only needs records starts fast."""

__all__ = [
    "ASKED_FOR",
    "ROBOT",
    "Box",
    "Diagnostic",
    "Encoding",
    "Instances",
    "Joint",
    "Label",
    "LabelProblem",
    "MaterialDetails",
    "ObjectLabels",
    "ReadOptions",
    "Scene",
    "SceneObject",
    "SelectionOverrides",
    "ShapeDescriptors",
    "StageFile",
    "StageFrame",
    "class_words",
    "describe_shapes",
    "explain_choice",
    "find_surplus",
    "read_scene",
]

__getattr__ = lazy_names(__name__, _LAZY)
