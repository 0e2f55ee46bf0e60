"""Manifests: labelled scenes that can be downloaded, with licences, addresses and hashes, as a TOML file."""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.errors import EvaluationError

__all__ = ["ManifestFile", "ManifestScene", "read_manifest"]

_NAME = re.compile(r"[\w][\w .-]{0,100}")
"""Names of folders and files: no path, not hidden."""
_SHA256 = re.compile(r"[0-9a-f]{64}")
_SCENE_KEYS = {"name", "licence", "note", "stage", "gold", "ontology", "file"}
_FILE_KEYS = {"file", "address", "sha256"}
_EXPECTED = (
    "expected [[scene]] tables with name, licence, stage, gold, and [[scene.file]] with file, address, sha256, see "
    "docs/evaluation.md"
)


@dataclass(frozen=True, slots=True)
class ManifestFile:
    """One file of a scene."""

    file: str
    """Path in the folder of the scene, with `/`."""
    address: str
    """URL to fetch it from."""
    sha256: str
    """Hexadecimal SHA-256 of its bytes."""


@dataclass(frozen=True, slots=True)
class ManifestScene:
    """A labelled scene and its files."""

    name: str
    """Name of the scene and of its folder."""
    licence: str
    """SPDX identifier, or the name of the licence."""
    note: str
    """Origin and annotator; empty if not stated."""
    stage: str
    """The root layer, one of the files."""
    gold: str
    """The gold labels, one of the files."""
    ontology: str
    """The ontology of the gold labels, one of the files; empty for the built-in home TBox."""
    files: tuple[ManifestFile, ...]


def read_manifest(path: Path) -> tuple[ManifestScene, ...]:
    """Return the scenes of a manifest, in file order.

    Raises:
        EvaluationError: the file cannot be read, or an entry is malformed.
    """
    try:
        entries = tomllib.loads(path.read_text("utf-8"))["scene"]
        scenes = tuple(_scene(path, entry) for entry in entries)
    except OSError as error:
        raise EvaluationError(f"{path}: cannot be read as a manifest ({error.strerror}); {_EXPECTED}") from error
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise EvaluationError(f"{path}: is not a manifest ({error!r}); {_EXPECTED}") from error
    if not scenes:
        raise EvaluationError(f"{path}: has no scene; {_EXPECTED}")
    _check_unique(f"{path}: two scenes", [scene.name for scene in scenes])
    return scenes


def _scene(path: Path, entry: Mapping[str, Any]) -> ManifestScene:
    name = _checked_name(path, str(entry["name"]))
    _check_keys(f"{path}: scene {name!r}", entry, _SCENE_KEYS)
    files = tuple(_file(path, name, one) for one in entry["file"])
    _check_unique(f"{path}: scene {name!r}: two files", [one.file for one in files])
    stage, gold, ontology = str(entry["stage"]), str(entry["gold"]), str(entry.get("ontology", ""))
    for key, file in (("stage", stage), ("gold", gold), ("ontology", ontology)):
        if file not in {one.file for one in files} and (file or key != "ontology"):
            raise EvaluationError(
                f"{path}: scene {name!r}: its {key} {file!r} is not among its files; add a [[scene.file]] for it"
            )
    licence = str(entry["licence"]).strip()
    if not licence:
        raise EvaluationError(f"{path}: scene {name!r}: its licence is empty; state one that permits sharing")
    return ManifestScene(name, licence, str(entry.get("note", "")), stage, gold, ontology, files)


def _file(path: Path, scene: str, entry: Mapping[str, Any]) -> ManifestFile:
    _check_keys(f"{path}: scene {scene!r}: a file", entry, _FILE_KEYS)
    found = ManifestFile(str(entry["file"]), str(entry["address"]), str(entry["sha256"]).lower())
    for part in found.file.split("/"):
        _checked_name(path, part)
    if not _SHA256.fullmatch(found.sha256):
        raise EvaluationError(
            f"{path}: scene {scene!r}: {found.file}: sha256 is {found.sha256!r}; expected 64 hexadecimal digits"
        )
    return found


def _checked_name(path: Path, name: str) -> str:
    if not _NAME.fullmatch(name) or name.lower() == "matrix.toml":
        raise EvaluationError(
            f"{path}: {name!r} is not a valid file or folder name; expected letters, digits, spaces, `.`, `_` and `-`, "
            "relative to the folder of the scene"
        )
    return name


def _check_keys(where: str, entry: Mapping[str, Any], known: set[str]) -> None:
    unknown = sorted(set(entry) - known)
    if unknown:
        raise EvaluationError(f"{where} has the unknown key {unknown[0]!r}; expected {', '.join(sorted(known))}")


def _check_unique(what: str, names: list[str]) -> None:
    # Some file systems ignore case.
    folded = [name.casefold() for name in names]
    repeated = next((name for name in names if folded.count(name.casefold()) > 1), None)
    if repeated is not None:
        raise EvaluationError(f"{what} are called {repeated!r}; expected different names")
