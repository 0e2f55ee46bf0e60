"""Printing: data on stdout, talk on stderr."""

import json
import os
import re
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from usd2kg.files import write_whole

if TYPE_CHECKING:
    from usd2kg.grounding.llm.asking import RunReport

__all__ = ["Progress", "emit", "format_table", "print_json", "printable", "talk"]

_WIDEST = 60
_STEERING = re.compile(r"[\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Controls beyond ASCII's, which JSON escapes by itself, and changes of direction."""


def talk(message: str) -> None:
    """Print a line for the person at the terminal, on stderr."""
    print(printable(message), file=sys.stderr)  # noqa: T201


def print_json(data: Any, path: Path | None = None) -> None:
    """Write data as JSON, to stdout if there is no file; readable: only what could steer a terminal is escaped."""
    text = json.dumps(data, indent=1, ensure_ascii=False)
    emit(_STEERING.sub(lambda match: f"\\u{ord(match[0]):04x}", text) + "\n", path)


def emit(text: str, path: Path | None) -> None:
    """Write text to a file, whole or not at all; to stdout if there is none."""
    if path is not None:
        write_whole(path, text.encode("utf-8"))
        return
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader of our output has enough (`| head`): that is no error of ours.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)


def printable(text: str) -> str:
    """Return text without control characters: names on a stage must not steer a terminal."""
    return "".join(c if c.isprintable() or c in "\t\n" else "\ufffd" for c in text)


def format_table(columns: Sequence[str], rows: Sequence[Sequence[str | None]]) -> str:
    """Return rows as aligned text.

    On a terminal, long cells but the last are cut in the middle, where paths say least; what is piped is whole.

    >>> print(format_table(("name", "size"), [("mug", "0.09"), ("table", None)]), end="")
    name   size
    mug    0.09
    table
    """
    cells = [[" ".join(printable(cell or "").splitlines()) for cell in row] for row in [columns, *rows]]
    if sys.stdout.isatty():
        cells = [[*map(_shorten, row[:-1]), row[-1]] for row in cells]
    widths = [max(len(row[i]) for row in cells) for i in range(len(columns))]
    lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in cells)
    return "\n".join(lines) + "\n"


def _shorten(text: str) -> str:
    if len(text) <= _WIDEST:
        return text
    head = _WIDEST // 3
    return f"{text[:head]}…{text[len(text) - (_WIDEST - head - 1) :]}"


class Progress:
    """A line on stderr that tells how far a run is; only where a person watches, and gone when the run is over."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._report: RunReport | None = None
        self._is_shown = sys.stderr.isatty()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._is_shown:
            sys.stderr.write("\r\x1b[K")

    def follow(self, report: "RunReport") -> None:
        """Tell what this report counts, too."""
        self._report = report

    def objects(self, done: int, count: int) -> None:
        """Show that so many objects of so many are done."""
        if self._is_shown:
            sys.stderr.write(f"\r\x1b[K{self.line(done, count)}")
            sys.stderr.flush()

    def line(self, done: int, count: int) -> str:
        """Return the line: objects, their rate, and what they cost so far."""
        rate = done / max(1e-9, time.monotonic() - self._start)
        told = [f"{done} of {count} objects", f"{rate:.1f} a second"]
        if self._report is not None:
            usage = self._report.usage
            told.append(f"{usage.input_tokens + usage.output_tokens:,} tokens")
            if self._report.price is not None:
                told.append(f"${self._report.price:.4f}")
        return ", ".join(told)
