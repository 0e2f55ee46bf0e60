"""Output: data to stdout or a file, messages and progress to stderr."""

import json
import logging
import os
import re
import sys
import time
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from usd2kg.cli.log_format import format_record, is_json_log
from usd2kg.cli.terminal import Style, paint
from usd2kg.files import write_whole

if TYPE_CHECKING:
    from usd2kg.grounding.llm.metered_client import RunReport
    from usd2kg.ontology import TBox

__all__ = [
    "Progress",
    "count_noun",
    "emit",
    "format_optional",
    "notify",
    "notify_notes",
    "print_json",
    "replace_controls",
    "to_single_line",
]

_TERMINAL_CONTROLS = re.compile(r"[\x7f-\x9f\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Control characters that JSON does not escape (DEL, C1), line separators and bidirectional controls."""
_CLEAR_LINE = "\r\x1b[K"
"""Carriage return and the ANSI sequence that erases the rest of the line."""


def notify(message: str, level: int = logging.INFO) -> None:
    """Print a message to stderr, as a record if messages are JSON."""
    text = replace_controls(format_record(level, message) if is_json_log() else message)
    if level >= logging.ERROR and not is_json_log():
        text = paint(text, Style.ERROR, sys.stderr)
    print(text, file=sys.stderr)  # noqa: T201


def notify_notes(tbox: "TBox") -> None:
    """Print the notes of an ontology to stderr."""
    for note in tbox.notes:
        notify(f"{note.code}: {note.message}")


def print_json(data: Any, path: Path | None = None) -> None:
    """Write data as JSON to a file, or to stdout; characters that control a terminal are escaped."""
    text = json.dumps(data, indent=1, ensure_ascii=False)
    emit(_TERMINAL_CONTROLS.sub(lambda match: f"\\u{ord(match[0]):04x}", text) + "\n", path)


def emit(text: str, path: Path | None = None) -> None:
    """Write text to a file, atomically, or to stdout.

    Raises:
        OutputError: the file cannot be written.
    """
    if path is not None:
        write_whole(path, text.encode("utf-8"))
        return
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader closed the pipe (`| head`), which is not an error. Python would flush the closed pipe at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)


def replace_controls(text: str) -> str:
    """Return text with U+FFFD in place of control characters, since names on a stage are untrusted."""
    return "".join(c if c.isprintable() or c in "\t\n" else "\ufffd" for c in text)


def to_single_line(text: str) -> str:
    """Return text on one line without control characters."""
    return replace_controls(" ".join(text.split()))


def count_noun(count: int, noun: str) -> str:
    """Return a count with its noun in the singular or plural.

    >>> count_noun(1, "object"), count_noun(2, "class")
    ('1 object', '2 classes')
    """
    return f"{count} {noun}{'' if count == 1 else 'es' if noun.endswith('s') else 's'}"


def format_optional(value: float | None, spec: str) -> str | None:
    """Return a number in a format specification; None for None."""
    return None if value is None else format(value, spec)


class Progress:
    """A progress line on stderr, only on a terminal, erased at the end."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._report: RunReport | None = None
        self._is_shown = sys.stderr.isatty()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.clear()

    def clear(self) -> None:
        """Erase the line."""
        if self._is_shown:
            sys.stderr.write(_CLEAR_LINE)

    def follow(self, report: "RunReport") -> None:
        """Show tokens and price of this report, too."""
        self._report = report

    def update(self, done: int, count: int) -> None:
        """Show the number of completed objects out of `count`."""
        self.show(self.line(done, count))

    def show(self, text: str) -> None:
        """Show a text."""
        if self._is_shown:
            sys.stderr.write(_CLEAR_LINE + text)
            sys.stderr.flush()

    def say(self, text: str) -> None:
        """Print a line to stderr in place of the progress line."""
        self.clear()
        notify(text)

    def line(self, done: int, count: int) -> str:
        """Return the line: objects, rate, tokens and price."""
        elapsed = time.monotonic() - self._start
        parts = [f"{done} of {count} objects", f"{done / elapsed if elapsed else 0:.1f} a second"]
        if self._report is not None:
            usage = self._report.usage
            parts.append(f"{usage.input_tokens + usage.output_tokens:,} tokens")
            if self._report.price is not None:
                parts.append(f"${self._report.price:.4f}")
        return ", ".join(parts)
