"""Runs the examples of a documentation page: commands after `$ `, with the output that the page shows."""

import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

__all__ = ["Command", "matches", "read_blocks", "read_commands", "run_command"]

_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_DURATION = re.compile(r"\bin [0-9.]+ s\b")
_ELLIPSIS = "…"


class Command(NamedTuple):
    """A command of a page."""

    arguments: tuple[str, ...]
    """Without the name of the program."""
    output: tuple[str, ...]
    """The lines that the page shows; none if it shows no output."""


def read_blocks(page: Path, *languages: str) -> list[str]:
    """Return the code blocks of a page in some languages, in their order."""
    return [text for language, text in _BLOCK.findall(page.read_text("utf-8")) if language in languages]


def read_commands(page: Path) -> list[Command]:
    """Return the `usd2kg` commands in the console blocks of a page, in their order."""
    commands = []
    for block in read_blocks(page, "console", "text"):
        for example in re.split(r"^\$ usd2kg ", block, flags=re.MULTILINE)[1:]:
            line, *output = example.splitlines()
            commands.append(Command(tuple(shlex.split(line, comments=True)), tuple(output)))
    return commands


def run_command(arguments: tuple[str, ...], folder: Path) -> tuple[int, list[str]]:
    """Return the exit code of `usd2kg` in a folder, and the lines that it prints."""
    done = subprocess.run(
        [sys.executable, "-m", "usd2kg", *arguments],
        check=False,
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    )
    return done.returncode, done.stdout.splitlines()


def matches(shown: tuple[str, ...] | list[str], printed: list[str]) -> bool:
    """Return whether printed lines are those that a page shows; a line `…` stands for any lines, durations vary.

    >>> matches(("1 object in 2.5 s", "…", "end"), ["1 object in 0.1 s", "a", "b", "end"])
    True
    >>> matches(("…", "end"), ["end", "more"])
    False
    """
    lines = [_DURATION.sub("in … s", line) for line in shown]
    patterns = [r"(?:.*\n)*?" if line.strip() == _ELLIPSIS else re.escape(line) + r"\n" for line in lines]
    text = "".join(f"{_DURATION.sub('in … s', line)}\n" for line in printed)
    return re.fullmatch("".join(patterns), text) is not None
