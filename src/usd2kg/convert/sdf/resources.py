"""Files that SDFormat files refer to by URI, in the folders where Gazebo would look for them."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from urllib.parse import unquote, urlsplit

__all__ = ["MODEL_PATH_VARIABLES", "ResourceError", "Resources", "asset_name"]

MODEL_PATH_VARIABLES = ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH", "SDF_PATH")
"""Environment variables with folders of models, of new and classic Gazebo."""
_MODEL_SCHEMES = ("model", "package", "file")
"""URIs whose first folder is the name of a model. Some worlds write `file://NAME/…`."""
_REMOTE_SCHEMES = ("http", "https")
_FILE_ENDINGS = ("sdf", "world", "urdf")
"""An include may name the file instead of its folder."""


class ResourceError(LookupError):
    """A URI leads to no file; the message says why."""


class Resources:
    """The folders of one world, and the environment's folders of models. No file outside of them is read."""

    def __init__(self, path: Path, environment: Mapping[str, str] = os.environ) -> None:
        """Allow the folder of a file, `models` in it and beside it, and the folders that the environment names."""
        folder = path.resolve().parent
        named = (place for name in MODEL_PATH_VARIABLES for place in environment.get(name, "").split(os.pathsep))
        folders = (folder, folder / "models", folder.parent / "models", *(Path(place) for place in named if place))
        self._roots = tuple(dict.fromkeys(place.resolve() for place in folders))

    def find(self, uri: str, base: Path) -> Path:
        """Return the file or folder of a URI in a file of the folder `base`; links are followed.

        Raises:
            ResourceError: there is none, or it is outside of the folders.
        """
        is_outside = False
        for candidate in self._candidates(uri, base):
            try:
                found = candidate.resolve()
                exists = found.exists()
            except (OSError, ValueError, RuntimeError):
                continue
            if not any(found.is_relative_to(root) for root in self._roots):
                is_outside = True
            elif exists:
                return found
        if is_outside:
            raise ResourceError("it leads out of the folders of the file and of the model path")
        if _scheme(uri) in _REMOTE_SCHEMES:
            raise ResourceError("it is on a server, and nothing is downloaded; put the model into the folder models")
        raise ResourceError(
            "it is neither in the folder of the file nor in models nor in the folders of GZ_SIM_RESOURCE_PATH"
        )

    def _candidates(self, uri: str, base: Path) -> Iterator[Path]:
        scheme, rest = _scheme(uri), uri.partition("://")[2]
        if not scheme:
            yield base / uri
            yield from (root / uri for root in self._roots)
        elif scheme in _MODEL_SCHEMES:
            if rest.startswith("/"):
                yield Path(rest)
                return
            # A model that refers to itself is found even if it is not in a folder of models.
            name, _, inner = rest.partition("/")
            if name and name == base.name:
                yield base / inner
            yield from (root / rest for root in self._roots)
            yield base / rest
        elif scheme in _REMOTE_SCHEMES:
            local = _local_part(uri)
            if local:
                name, _, inner = local.partition("/")
                # Gazebo's own cache has the names in lower case.
                yield from (root / folder / inner for root in self._roots for folder in (name, name.lower()))


def _scheme(uri: str) -> str:
    """Return the scheme of a URI in lower case; empty for a path."""
    scheme, separator, _ = uri.partition("://")
    return scheme.strip().lower() if separator else ""


def asset_name(uri: str) -> str:
    """Return the name of the model that a URI of an include names.

    >>> asset_name("model://aws_Chair_01"), asset_name("https://fuel.gazebosim.org/1.0/o/models/Red%20Mug/3")
    ('aws_Chair_01', 'Red Mug')
    >>> asset_name("model://chair/model.sdf"), asset_name("parts/wheel.sdf"), asset_name("../chair")
    ('chair', 'wheel', 'chair')
    """
    if _scheme(uri) in _REMOTE_SCHEMES:
        return (_local_part(uri) or "").partition("/")[0]
    parts = [part for part in uri.partition("://")[2 if "://" in uri else 0].split("/") if part not in {"", ".", ".."}]
    if not parts:
        return ""
    stem, dot, ending = parts[-1].rpartition(".")
    if not dot or ending.lower() not in _FILE_ENDINGS:
        return parts[-1]
    return parts[-2] if stem == "model" and len(parts) > 1 else stem


def _local_part(uri: str) -> str | None:
    """Return `NAME` or `NAME/PATH` of the URL of a model on Fuel, `…/models/NAME[/VERSION[/files/PATH]]`."""
    try:
        parts = [unquote(part) for part in urlsplit(uri).path.split("/") if part]
    except ValueError:
        return None
    if "models" not in parts[:-1]:
        return None
    rest = parts[parts.index("models") + 1 :]
    inner = rest[rest.index("files") + 1 :] if "files" in rest else []
    return "/".join((rest[0], *inner))
