"""Fixtures of the scene tests."""

from collections.abc import Callable

import pytest

from tests.scene.usda import METRES
from usd2kg.scene import Scene, read_scene


@pytest.fixture
def read(write_stage) -> Callable[..., Scene]:
    """A function that writes prims as a stage and reads it back."""

    def run(*prims: str, layer: str = METRES, name: str = "scene.usda", **options) -> Scene:
        return read_scene(write_stage(layer + "\n".join(prims), name), **options)

    return run
