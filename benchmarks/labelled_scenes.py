"""Scenes with gold labels: those of `benchmarks/accuracy/matrix.toml`.

Scenes that may not be redistributed are in the folder that the variable USD2KG_SHARED names, `../shared` by default.
"""

import os
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from usd2kg.evaluation import read_matrix
from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.evaluation.matrix import Matrix, SceneSpec
from usd2kg.ontology import TBox
from usd2kg.pipeline import open_tbox
from usd2kg.scene import Scene, read_scene

__all__ = ["MATRIX", "SHARED", "LabelledScene", "iter_training_scenes", "load_scene", "read_accuracy_matrix"]

ROOT = Path(__file__).parents[1]
MATRIX = ROOT / "benchmarks/accuracy/matrix.toml"
DEFAULT_SHARED = ROOT.parent / "shared"
SHARED = Path(os.environ.get("USD2KG_SHARED", DEFAULT_SHARED))


class LabelledScene(NamedTuple):
    """A scene with labels; its objects are the labelled prims."""

    name: str
    scene: Scene
    gold: tuple[GoldLabel, ...]
    tbox: TBox

    @property
    def paths(self) -> list[str]:
        """The labelled prims in the order of the gold file."""
        return [label.prim_path for label in self.gold]


def read_accuracy_matrix(shared: Path = SHARED) -> Matrix:
    """Return the matrix, with paths below `../shared` moved to `shared`."""
    matrix = read_matrix(MATRIX)
    return replace(matrix, scenes=tuple(_move_spec(spec, shared) for spec in matrix.scenes))


def _move_spec(spec: SceneSpec, shared: Path) -> SceneSpec:
    ontology = _move_path(spec.ontology, shared) if spec.ontology else None
    return replace(spec, path=_move_path(spec.path, shared), gold=_move_path(spec.gold, shared), ontology=ontology)


def _move_path(path: Path, shared: Path) -> Path:
    path = Path(os.path.normpath(path))
    return shared / path.relative_to(DEFAULT_SHARED) if path.is_relative_to(DEFAULT_SHARED) else path


def load_scene(spec: SceneSpec) -> LabelledScene:
    """Return the scene of a specification."""
    tbox = open_tbox(spec.ontology)
    gold = read_gold(spec.gold, tbox)
    return LabelledScene(spec.name, read_scene(spec.path, paths=[label.prim_path for label in gold]), gold, tbox)


def iter_training_scenes() -> Iterator[LabelledScene]:
    """Yield the scenes that are present and not marked as test."""
    for spec in read_accuracy_matrix().scenes:
        if spec.missing is None and not re.search(r"\btest\b", spec.name):
            yield load_scene(spec)
