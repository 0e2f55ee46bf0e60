"""Folders of the integrations on the import path, and a small scene for all of them."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
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


@contextmanager
def imported_from(folder: Path, package: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let a package be imported from a folder, and forget it at the end."""
    monkeypatch.syspath_prepend(str(folder))
    yield
    for name in [name for name in sys.modules if name.startswith(package)]:
        del sys.modules[name]


@pytest.fixture
def stage(write_stage) -> Usd.Stage:
    """A table with a mug on it, and an object whose name says nothing."""
    return Usd.Stage.Open(str(write_stage(SCENE)))
