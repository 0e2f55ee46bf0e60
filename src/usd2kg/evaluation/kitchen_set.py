"""Pixar's Kitchen Set, as the user's own download: is it there, can it be read?

The scene may not be redistributed, so it is never shipped. Its layers are crates of version 0.0.1, which OpenUSD
reads only up to release 24.11 or so: usd-core 26.11 refuses everything below 0.4.0, and prims whose layers are refused
open without geometry.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.matrix import Matrix, SceneSpec
from usd2kg.grounding import GROUNDERS, NamingRegime

__all__ = ["KitchenSet", "check_kitchen_set", "crate_version", "kitchen_matrix"]

_ROOT_LAYERS = ("Kitchen_set.usd", "Kitchen_set.usda", "Kitchen_set.usdc")
_MAGIC = b"PXR-USDC"
_OLDEST_READ = (0, 4, 0)
_CONVERSION = (
    "convert them with an older OpenUSD in an environment of its own: python -m venv old && "
    "old/bin/pip install 'usd-core==24.11' && old/bin/python -c \"import sys; from pxr import Usd, Sdf; "
    '[Sdf.Layer.FindOrOpen(f).Export(f) for f in sys.argv[1:]]" $(find {folder} -name "*.usd*")'
)


@dataclass(frozen=True, slots=True)
class KitchenSet:
    """A download that can be read."""

    root: Path
    """The root layer."""
    layer_count: int


def crate_version(path: Path) -> tuple[int, int, int] | None:
    """Return the version in a binary layer's header; None for a layer of text.

    The header is the magic PXR-USDC, then one byte each for major, minor and patch.
    """
    with path.open("rb") as file:
        head = file.read(11)
    return (head[8], head[9], head[10]) if head.startswith(_MAGIC) and len(head) == 11 else None


def check_kitchen_set(folder: Path) -> KitchenSet:
    """Return the Kitchen Set in `folder` or below it.

    Raises:
        EvaluationError: it is not there, or its layers are too old for the installed OpenUSD.
    """
    places = [folder, folder / "Kitchen_set", *sorted(path for path in folder.glob("*/Kitchen_set") if path.is_dir())]
    root = next((p / name for p in places for name in _ROOT_LAYERS if (p / name).is_file()), None)
    if root is None:
        raise EvaluationError(
            f"{folder}: no {_ROOT_LAYERS[0]} in it; expected the unpacked Kitchen Set, "
            "download it from OpenUSD's page of downloads and sample assets"
        )
    layers = list(_layers(root.parent))
    obsolete = [path for path in layers if (version := crate_version(path)) is not None and version < _OLDEST_READ]
    if obsolete:
        oldest = ".".join(str(part) for part in crate_version(obsolete[0]) or ())
        raise EvaluationError(
            f"{root.parent}: {len(obsolete)} of {len(layers)} layers are crates of version {oldest}, "
            f"which current OpenUSD refuses; {_CONVERSION.format(folder=root.parent)}"
        )
    return KitchenSet(root, len(layers))


def _layers(folder: Path) -> Iterator[Path]:
    for path in sorted(folder.rglob("*")):
        if path.suffix in {".usd", ".usda", ".usdc"} and path.is_file():
            yield path


def kitchen_matrix(found: KitchenSet, gold: Path, ontology: Path | None) -> Matrix:
    """Return the study's matrix on the user's Kitchen Set: all grounders, all regimes, the ablation."""
    scene = SceneSpec("Kitchen Set", found.root, gold, ontology, "labelled by the user", is_optional=False)
    return Matrix(
        "The study's matrix on the Kitchen Set", (scene,), GROUNDERS, tuple(NamingRegime), 1, has_ablation=True
    )
