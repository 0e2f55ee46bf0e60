"""Converted: the prims that a converter created from a file."""

from dataclasses import dataclass
from pathlib import Path

from pxr import Usd

from usd2kg.errors import SceneError, one_line

__all__ = ["Converted", "parse_error"]

_MAX_REASON = 240
"""Characters quoted from the message of a parser."""


@dataclass(frozen=True)
class Converted:
    """A stage in memory, with notes for the user."""

    stage: Usd.Stage
    converter: str
    """Name and version of the library that read the file."""
    notes: tuple[str, ...] = ()
    """Assumptions and omissions of the conversion."""


def parse_error(path: Path, found: object, expected: str) -> SceneError:
    """Return the error of a file that its parser rejects."""
    reason = one_line(found) or type(found).__name__
    reason = reason if len(reason) <= _MAX_REASON else reason[: _MAX_REASON - 1] + "…"
    return SceneError(f"{path}: cannot be converted ({reason}), expected {expected}; correct it or export it again")
