"""Origin: the source of a converted stage, kept in `customLayerData` of its root layer."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

__all__ = ["SOURCE_ID", "Origin", "read_origin", "write_origin"]

SOURCE_ID = "usd2kgSourceId"
"""Key in `customData` of a prim: its identifier in the file that the stage was converted from."""
_KEY = "usd2kgOrigin"


@dataclass(frozen=True)
class Origin:
    """The file or folder that a stage was converted from, and the converter."""

    source: str
    """Name of the file or folder, without the folder that it is in."""
    hash: str
    """`sha256:` and the digest of that file, without the files it refers to; for a folder, that of its files' digests.

    That is the digest of what the program sha256sum prints for them, sorted and named relative to the folder.
    """
    format: str
    converter: str
    """Name and version, such as `trimesh 5.2.0`."""


def write_origin(layer: Any, origin: Origin) -> None:
    """Author the origin on a layer."""
    layer.customLayerData = {**layer.customLayerData, _KEY: asdict(origin)}


def read_origin(layers: list[Any]) -> Origin | None:
    """Return the origin that the strongest of the layers states; None if none does."""
    names = [entry.name for entry in fields(Origin)]
    for layer in layers:
        found = layer.customLayerData.get(_KEY)
        if isinstance(found, Mapping) and all(isinstance(found.get(name), str) for name in names):
            return Origin(**{name: found[name] for name in names})
    return None
