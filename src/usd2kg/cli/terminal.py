"""Capabilities of the terminal: colours and width."""

import os
import shutil
import sys
from enum import Enum
from typing import TextIO

__all__ = ["Style", "forbid_colors", "paint", "terminal_width"]

_RESET = "\x1b[0m"
_forbidden = False


class Style(Enum):
    """How text is emphasised: parameters of the ANSI sequence SGR (ECMA-48, 8.3.117)."""

    HEADER = "1"
    ERROR = "1;31"
    WARNING = "33"
    NOTE = "36"


def forbid_colors() -> None:
    """Disable colours from now on."""
    global _forbidden  # noqa: PLW0603 - an option of the process
    _forbidden = True


def paint(text: str, style: Style, stream: TextIO) -> str:
    """Return text in a style, unchanged if the stream shows no colours.

    Colours need a terminal that is not `dumb`; `NO_COLOR` (no-color.org) and `--no-color` turn them off.
    """
    is_plain = _forbidden or bool(os.environ.get("NO_COLOR")) or os.environ.get("TERM") == "dumb"
    if is_plain or not stream.isatty():
        return text
    return f"\x1b[{style.value}m{text}{_RESET}"


def terminal_width() -> int | None:
    """Return the width in columns if stdout is a terminal; None if it is a file or a pipe.

    `COLUMNS` overrides the width.
    """
    return shutil.get_terminal_size((100, 24)).columns if sys.stdout.isatty() else None
