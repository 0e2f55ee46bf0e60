"""Folders of the integrations on the import path, and a small scene for all of them."""

from pathlib import Path

import pytest
from pxr import Usd

from tests.scene.usda import METRES, component, cube, xform

INTEGRATIONS = Path(__file__).parents[2] / "integrations"

COLOR = "color3f[] primvars:displayColor = [(1, 1, 1)]"
SCENE = METRES + xform(
    "World",
    component("Table", cube("Top", COLOR)),
    component("Mug", cube("Body", size=0.1, at=(0, 0, 0.55))),
    component("Zorblax", cube("Part", size=0.2, at=(3, 0, 0))),
)


@pytest.fixture
def stage(write_stage) -> Usd.Stage:
    """A table with a mug on it, and an object whose name says nothing."""
    return Usd.Stage.Open(str(write_stage(SCENE)))
