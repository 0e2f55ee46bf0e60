"""MJCF, the format of MuJoCo → prims, by the program mujoco_usd_converter."""

from pathlib import Path

from usd2kg.convert.converted import Converted
from usd2kg.convert.converter_program import run_converter

__all__ = ["read_prims"]


def read_prims(path: Path) -> Converted:
    """Return the stage of an MJCF file.

    Raises:
        SceneError: the converter is not installed, or refuses the file.
    """
    return run_converter("mujoco_usd_converter", path, "an MJCF file, whose root element is <mujoco>")
