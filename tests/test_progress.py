"""The progress bar of steps: where it is shown, and that it leaves data alone."""

import os
import pty
import sys
import threading
import time
import types
from collections.abc import Callable
from contextlib import suppress
from typing import Self

import pytest

import usd2kg
from tests.scene.usda import METRES, box
from usd2kg import progress
from usd2kg.progress import show_steps
from usd2kg.tracing import span


class Terminal:
    """A pseudo-terminal that is stderr until the context ends; `shown` has then what was written to it."""

    def __init__(self) -> None:
        self.shown = ""

    def __enter__(self) -> Self:
        self._controller, user = pty.openpty()
        self._parts: list[bytes] = []
        self._reader = threading.Thread(target=self._drain)
        self._reader.start()
        # Not in a fixture: pytest replaces stderr before it calls the test.
        self._before, sys.stderr = sys.stderr, os.fdopen(user, "w", encoding="utf-8")
        return self

    def __exit__(self, *_: object) -> None:
        sys.stderr.close()
        sys.stderr = self._before
        self._reader.join()
        os.close(self._controller)
        self.shown = b"".join(self._parts).decode()

    def _drain(self) -> None:
        # Reading fails when the other end is closed.
        with suppress(OSError):
            while part := os.read(self._controller, 1 << 16):
                self._parts.append(part)


@pytest.fixture(autouse=True)
def _terminal_that_moves_the_cursor(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")


@pytest.fixture
def room(write_stage) -> str:
    return str(write_stage(METRES + box("cup", (0, 0, 0), (0.1, 0.1, 0.1))))


def run_steps(wait_s: float = 0.0) -> None:
    with show_steps("read", "ground"):
        for step in ("read", "ground"):
            with span(step):
                time.sleep(wait_s)


def test_a_terminal_shows_long_steps(monkeypatch, capsys):
    monkeypatch.setattr(progress, "_DELAY_S", 0.02)
    with Terminal() as terminal:
        run_steps(0.3)
    assert "reading the scene" in terminal.shown
    assert "grounding objects" in terminal.shown
    assert capsys.readouterr().out == ""


def test_a_terminal_shows_no_short_steps():
    with Terminal() as terminal:
        run_steps()
    assert terminal.shown == ""


def test_a_long_step_is_shown_before_it_ends(monkeypatch):
    monkeypatch.setattr(progress, "_DELAY_S", 0.02)
    with Terminal() as terminal, show_steps("read", "ground"), span("read"):
        time.sleep(0.3)
        assert b"reading the scene" in b"".join(terminal._parts)


def test_nothing_is_shown_without_a_terminal(monkeypatch, capsys):
    monkeypatch.setattr(progress, "_DELAY_S", 0.0)
    run_steps(0.05)
    assert capsys.readouterr() == ("", "")


def test_nothing_is_shown_where_steps_are_logged(monkeypatch, caplog):
    monkeypatch.setattr(progress, "_DELAY_S", 0.0)
    caplog.set_level("INFO", "usd2kg")
    with Terminal() as terminal:
        run_steps(0.05)
    assert terminal.shown == ""


def test_output_passes_beside_the_bar(monkeypatch, capsys):
    monkeypatch.setattr(progress, "_DELAY_S", 0.0)
    with Terminal() as terminal, show_steps("read"), span("read"):
        time.sleep(0.3)
        print("data")
        print("a message", file=sys.stderr)
    assert capsys.readouterr().out == "data\n"
    assert "a message" in terminal.shown


def test_the_bar_ends_with_an_error(monkeypatch):
    monkeypatch.setattr(progress, "_DELAY_S", 0.0)
    with Terminal() as terminal, pytest.raises(ValueError, match="broken"), show_steps("read"), span("read"):
        time.sleep(0.3)
        raise ValueError("broken")
    # The cursor is shown again.
    assert "\x1b[?25h" in terminal.shown


class FakeBar:
    """A bar of tqdm that records what it shows."""

    def __init__(self, total: int, **_: object) -> None:
        self.total, self.n, self.text = total, 0, ""
        self.shown: list[tuple[int, str]] = []
        self.is_closed = False

    def set_description_str(self, text: str, refresh: bool) -> None:
        self.text = text

    def refresh(self) -> None:
        self.shown.append((self.n, self.text))

    def close(self) -> None:
        self.is_closed = True


@pytest.fixture
def notebook(monkeypatch) -> None:
    shell = types.SimpleNamespace(config={"IPKernelApp": {}})
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell))


@pytest.fixture
def bars(notebook, monkeypatch) -> list[FakeBar]:
    made: list[FakeBar] = []

    def make(**options: int) -> FakeBar:
        made.append(FakeBar(**options))
        return made[-1]

    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", types.SimpleNamespace(tqdm=make))
    return made


def test_a_notebook_has_a_bar_of_tqdm(bars, room):
    usd2kg.build(room, progress=True)
    (bar,) = bars
    assert (bar.total, bar.is_closed) == (5, True)
    texts = [text for _, text in bar.shown if text != "reading the ontology"]
    assert texts == ["reading the scene", "grounding objects", "finding relations", "making the graph"]
    assert [done for done, _ in bar.shown] == list(range(len(bar.shown)))


def test_build_shows_no_bar_unless_asked(bars, room):
    usd2kg.build(room)
    assert bars == []


def test_a_notebook_without_tqdm_shows_nothing(notebook, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    run_steps()
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("command", ["build", "ground"])
def test_commands_show_the_bar(command: str, monkeypatch, room, tmp_path, capsys, run_main: Callable[..., None]):
    monkeypatch.setattr(progress, "_DELAY_S", 0.0)
    with Terminal() as terminal:
        run_main(command, room, "-o", str(tmp_path / ("out.ttl" if command == "build" else "out.csv")))
    # A small scene may be done before the text of a step is drawn.
    assert "━" in terminal.shown
    assert capsys.readouterr().out == ""


@pytest.fixture
def run_main(monkeypatch) -> Callable[..., None]:
    def run(*arguments: str) -> None:
        from usd2kg.cli.app import main  # noqa: PLC0415

        monkeypatch.setattr(sys, "argv", ["usd2kg", *arguments])
        monkeypatch.setattr("usd2kg.cli.app.set_up_logging", lambda *_: None)
        with pytest.raises(SystemExit, match="0"):
            main()

    return run
