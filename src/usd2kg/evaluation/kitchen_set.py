"""Check a user's download of Pixar's Kitchen Set, and find the objects of the study in it.

The licence forbids redistribution, so the scene is not shipped. Its layers are crate files of version 0.0.1, which
OpenUSD reads up to about release 24.11: usd-core 26.11 rejects versions below 0.4.0, and prims from rejected layers
have no geometry.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.matrix import SceneSpec
from usd2kg.scene import Scene, SceneObject

__all__ = ["KitchenSet", "check_kitchen_set", "crate_version", "kitchen_scene", "study_objects"]

_ROOT_LAYERS = ("Kitchen_set.usd", "Kitchen_set.usda", "Kitchen_set.usdc")
_LAYER_SUFFIXES = frozenset({".usd", ".usda", ".usdc"})
_MAGIC = b"PXR-USDC"
_OLDEST_READABLE = (0, 4, 0)
_CONVERSION = (
    "convert them with an older OpenUSD in a separate environment: python -m venv old && "
    "old/bin/pip install 'usd-core==24.11' && old/bin/python -c \"import sys; from pxr import Usd, Sdf; "
    '[Sdf.Layer.FindOrOpen(f).Export(f) for f in sys.argv[1:]]" $(find {folder} -name "*.usd*")'
)


@dataclass(frozen=True, slots=True)
class KitchenSet:
    """A download of the Kitchen Set that the installed OpenUSD can read."""

    root: Path
    """The root layer."""
    layer_count: int


def crate_version(path: Path) -> tuple[int, int, int] | None:
    """Return the crate version of a binary layer; None for a text layer.

    The header is the magic number PXR-USDC, then one byte each for major, minor and patch version.
    """
    with path.open("rb") as file:
        head = file.read(len(_MAGIC) + 3)
    if not head.startswith(_MAGIC) or len(head) < len(_MAGIC) + 3:
        return None
    major, minor, patch = head[len(_MAGIC) :]
    return major, minor, patch


def check_kitchen_set(folder: Path) -> KitchenSet:
    """Return the Kitchen Set in `folder` or one of its subfolders.

    Raises:
        EvaluationError: it is missing, or its layers are too old for the installed OpenUSD.
    """
    places = [folder, folder / "Kitchen_set", *sorted(path for path in folder.glob("*/Kitchen_set") if path.is_dir())]
    root = next((place / name for place in places for name in _ROOT_LAYERS if (place / name).is_file()), None)
    if root is None:
        raise EvaluationError(
            f"{folder}: no {_ROOT_LAYERS[0]} in it; expected the unpacked Kitchen Set, "
            "download it from OpenUSD's page of downloads and sample assets"
        )
    layers = list(_layers(root.parent))
    versions = [version for path in layers if (version := crate_version(path)) is not None]
    obsolete = [version for version in versions if version < _OLDEST_READABLE]
    if obsolete:
        oldest = ".".join(map(str, min(obsolete)))
        raise EvaluationError(
            f"{root.parent}: {len(obsolete)} of {len(layers)} layers are crate files of version {oldest}, "
            f"which current OpenUSD rejects; {_CONVERSION.format(folder=root.parent)}"
        )
    return KitchenSet(root, len(layers))


def _layers(folder: Path) -> Iterator[Path]:
    yield from (path for path in sorted(folder.rglob("*")) if path.suffix in _LAYER_SUFFIXES and path.is_file())


def study_objects(scene: Scene) -> tuple[SceneObject, ...]:
    """Return the objects that best approximate the study's list, which is not public.

    The study lists object-level prims, without grouping prims, cameras, lights, sub-components and prims without
    geometry. Our object selection excludes the first three; this function also excludes objects inside other objects,
    which are their components, and objects without a box.
    """
    return tuple(obj for obj in scene.objects if obj.parent_path is None and obj.box is not None)


def kitchen_scene(found: KitchenSet, gold: Path, ontology: Path | None) -> SceneSpec:
    """Return the Kitchen Set with the user's gold labels as the scene of a matrix."""
    return SceneSpec("Kitchen Set", found.root, gold, ontology, "labelled by the user", is_optional=False)
