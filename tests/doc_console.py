"""Reads the code blocks of a documentation page and runs them.

A block is run by its language. A `title` in its first line is the name of the file that it shows, and is written first.
A line `*Not run by the tests: REASON.*` above a block says why it is not run, and `*Run by the tests if NAME is
installed.*` names a program or module that it needs. A server is started, waited for, and stopped as by Ctrl+C.
`http://localhost:7878` is a store on a server: an empty one of Oxigraph, for each page.
"""

import doctest
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import pyoxigraph as ox
import pytest
import yaml

from tests.stores.servers import oxigraph
from usd2kg.graph.vocabulary import PREFIXES
from usd2kg.query import load_graph

__all__ = ["Block", "Command", "matches", "read_blocks", "read_commands", "run_command", "run_page"]

_BLOCK = re.compile(
    r"""(?:^\*Not\ run\ by\ the\ tests:\ (?P<reason>[^*]+)\.\*\n)?
    (?:^\*Run\ by\ the\ tests\ if\ (?P<needs>[^*]+)\ is\ installed\.\*\n)?
    ^(?P<indent>\ *)```(?P<language>\w*)(?:\ title="(?P<title>[^"]+)")?\n(?P<text>.*?)^(?P=indent)```$""",
    re.MULTILINE | re.DOTALL | re.VERBOSE,
)
_DURATION = re.compile(r"\bin [0-9.]+ s\b")
_ELLIPSIS = "…"
_ROOT = Path(__file__).parents[1]
_FINDING = re.compile(r"usd2kg (validate|diff|label lint|ontology check)\b")
"""Commands whose exit code is 1 if they find something."""
_SERVER = re.compile(r"usd2kg (serve|studio)\b")
"""Commands that run until Ctrl+C."""
_SERVER_LIMIT_S = 120.0
_STORE = "http://localhost:7878"
"""Address of a store in commands of a page."""
_INSTALL = re.compile(r"pip install 'usd2kg\[([\w,]+)\]'")
"""Commands that the documentation shows for installing extras."""


class Block(NamedTuple):
    """A code block of a page."""

    language: str
    """The first word after the fence; empty if there is none."""
    text: str
    title: str
    """Name of the file that the block shows; empty if it shows none."""
    reason: str
    """Why the tests do not run it, as the page says; empty if they do."""
    needs: str
    """Program or module without which it does not run; empty if it needs none."""
    line: int
    """Number of its first line on the page."""

    @property
    def is_console(self) -> bool:
        """Whether the block shows commands."""
        return self.language in {"console", "sh"} or (self.language == "text" and self.text.startswith("$ "))


class Command(NamedTuple):
    """A command of a page."""

    line: str
    output: tuple[str, ...]
    """The lines that the page shows; none if it shows no output."""


def read_blocks(page: Path, *languages: str) -> list[Block]:
    """Return the code blocks of a page, in some languages if any are given, in their order."""
    text = page.read_text("utf-8")
    blocks = [
        Block(
            match["language"],
            textwrap.dedent(match["text"]),
            match["title"] or "",
            " ".join((match["reason"] or "").split()),
            match["needs"] or "",
            text.count("\n", 0, match.start("language")) + 1,
        )
        for match in _BLOCK.finditer(text)
    ]
    assert len(re.findall("^ *```", text, re.MULTILINE)) == 2 * len(blocks), f"{page}: a code block is not read"
    assert text.count("*Not run by") == sum(bool(block.reason) for block in blocks), f"{page}: a reason is not read"
    assert text.count("*Run by the") == sum(bool(block.needs) for block in blocks), f"{page}: a need is not read"
    return [block for block in blocks if not languages or block.language in languages]


def read_commands(block: Block) -> list[Command]:
    r"""Return the commands of a console block, in their order: lines after `$ `, or all lines if there is none.

    >>> read_commands(Block("console", "$ usd2kg a \\\n    b\nc\n$ usd2kg d\n", "", "", "", 1))
    [Command(line='usd2kg a     b', output=('c',)), Command(line='usd2kg d', output=())]
    """
    text = block.text.replace("\\\n", "")
    if not text.startswith("$ "):
        return [Command(line, ()) for line in text.splitlines() if line and not line.startswith("#")]
    examples = [example.splitlines() for example in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]]
    return [Command(line, tuple(output)) for line, *output in examples]


def run_page(page: Path, folder: Path) -> Counter[str]:
    """Run the blocks of a page in a folder, in their order, and count them: `run`, `read`, `shown`, `marked`.

    Raises:
        AssertionError: see `run_block`.
    """
    blocks = read_blocks(page)
    if any(block.language == "pycon" for block in blocks):
        flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
        done = doctest.testfile(str(page), module_relative=False, optionflags=flags, encoding="utf-8")
        assert done.attempted > 0
        assert done.failed == 0
    is_stored = any(_STORE in block.text for block in blocks if block.is_console and not block.reason)
    with _store_server(folder) if is_stored else nullcontext(_STORE) as store:
        return Counter(
            "marked" if block.reason or _is_missing(block.needs) else run_block(block, folder, store)
            for block in blocks
        )


@contextmanager
def _store_server(folder: Path) -> Iterator[str]:
    """Run a server with an empty store beside the folder of a page, and return its address."""
    beside = folder.parent / f"{folder.name}.store"
    beside.mkdir()
    with oxigraph(beside) as address:
        yield address


def _is_missing(name: str) -> bool:
    return bool(name) and shutil.which(name) is None and find_spec(name) is None


def run_block(block: Block, folder: Path, store: str = _STORE) -> str:
    """Run a block in a folder and return what was done: `run`, `read` if only its syntax counts, or `shown`.

    `store` is the address that replaces `http://localhost:7878` in its commands.

    Raises:
        AssertionError: the block fails, prints something else than the page shows, or cannot be read.
    """
    if block.title:
        path = folder / block.title
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(block.text, "utf-8")
    if block.is_console:
        for command in read_commands(block):
            _run_console(command._replace(line=command.line.replace(_STORE, store)), folder)
        return "run"
    if block.language == "python":
        _check(subprocess.run([sys.executable, "-c", block.text], check=False, **_options(folder)))
        return "run"
    if block.language == "pycon":
        return "run"  # by run_page, since the blocks of a page share their names
    if block.language == "sparql":
        (graph,) = folder.glob("kitchen.ttl")
        assert load_graph(graph).sparql(block.text).rows, block.text
        return "run"
    return _read(block)


def _read(block: Block) -> str:
    if block.language == "toml":
        tomllib.loads(block.text)
    elif block.language == "json":
        json.loads(block.text)
    elif block.language == "yaml":
        yaml.safe_load(block.text)
    elif block.language == "turtle":
        head = "".join(f"@prefix {name}: <{iri}> .\n" for name, iri in {"": "https://example.org/", **PREFIXES}.items())
        assert list(ox.parse(head + block.text, format=ox.RdfFormat.TURTLE)), block.text
    else:
        assert block.title or block.language == "text", f"line {block.line}: no test reads a {block.language!r} block"
        return "read" if block.title else "shown"
    return "read"


def _run_console(command: Command, folder: Path) -> None:
    words = shlex.split(command.line, comments=True)
    if words[0] == "make":
        # Recipes of this checkout; a folder of the tests has none.
        assert f"make {words[1]}" in (_ROOT / ".ci/run").read_text("utf-8"), f"{command.line}: .ci/run does not run it"
        return
    if install := _INSTALL.match(command.line):
        extras = tomllib.loads((_ROOT / "pyproject.toml").read_text("utf-8"))["project"]["optional-dependencies"]
        assert set(install[1].split(",")) <= extras.keys(), command.line
        return
    if _SERVER.match(command.line):
        _run_server(command.line, folder)
        return
    code, printed = run_command(command.line, folder)
    allowed = {0, 1} if _FINDING.search(command.line) else {0}
    assert code in allowed, "\n".join([command.line, *printed])
    assert not command.output or matches(command.output, printed), "\n".join([command.line, *printed])


def _run_server(line: str, folder: Path) -> None:
    """Start a server on a free port, wait until it names its address, and stop it as Ctrl+C does.

    Raises:
        AssertionError: it names no address in time, or does not end with 0.
    """
    words = [*shlex.split(line, comments=True), *([] if "--port" in line else ["--port", "0"])]
    # The studio opens a browser.
    environment = {**_environment(folder), "BROWSER": "true"}
    with subprocess.Popen(
        words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, encoding="utf-8", env=environment
    ) as server:
        timer = threading.Timer(_SERVER_LIMIT_S, server.kill)
        timer.start()
        try:
            assert server.stderr is not None
            printed: list[str] = []
            for text in server.stderr:
                printed.append(text)
                if "http://" in text:
                    break
            else:
                pytest.fail(f"{line}: names no address: {''.join(printed)}")
            server.send_signal(signal.SIGINT)
            server.stderr.read()
            assert server.wait() == 0, f"{line}: {''.join(printed)}"
        finally:
            timer.cancel()
            server.kill()


def _check(done: "subprocess.CompletedProcess[str]") -> None:
    assert done.returncode == 0, done.stdout


def _options(folder: Path) -> dict[str, Any]:
    return {"cwd": folder, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "encoding": "utf-8"}


def run_command(line: str, folder: Path) -> tuple[int, list[str]]:
    """Return the exit code of a command line in a folder, and the lines that it prints."""
    bash = ["bash", "-o", "pipefail", "-c", line]
    done = subprocess.run(bash, check=False, env=_environment(folder), **_options(folder))
    return done.returncode, done.stdout.splitlines()


def _environment(folder: Path) -> dict[str, str]:
    return {**os.environ, "PATH": f"{_write_shims(folder)}{os.pathsep}{os.environ['PATH']}"}


def _write_shims(folder: Path) -> Path:
    """Return a folder beside `folder` with the programs `usd2kg` and `python` of this interpreter."""
    programs = folder.parent / f"{folder.name}.bin"
    programs.mkdir(exist_ok=True)
    for name, arguments in (("usd2kg", "-m usd2kg "), ("python", "")):
        path = programs / name
        if not path.exists():
            path.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} {arguments}"$@"\n', "utf-8")
            path.chmod(0o755)
    return programs


def matches(shown: Sequence[str], printed: Sequence[str]) -> bool:
    """Return whether printed lines are those that a page shows; a line `…` stands for any lines.

    Durations and the widths of spaces vary.

    >>> matches(("1 object in 2.5 s", "…", "end"), ["1 object in 0.1 s", "a", "b", "end"])
    True
    >>> matches(("…", "end"), ["end", "more"])
    False
    """
    lines = [*map(_comparable, shown)]
    # An empty line before the next command only separates the two.
    while lines and not lines[-1]:
        lines.pop()
    patterns = [r"(?:.*\n)*?" if line == _ELLIPSIS else re.escape(line) + r"\n" for line in lines]
    text = "".join(f"{_comparable(line)}\n" for line in printed)
    return re.fullmatch("".join(patterns) + r"\n*", text) is not None


def _comparable(line: str) -> str:
    return " ".join(_DURATION.sub("in … s", line).split())
