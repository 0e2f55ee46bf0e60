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


class Now:
    """A timer whose time is over when it starts."""

    def __init__(self, _seconds: float, call: Callable[[], None]) -> None:
        self.start = call

    def cancel(self) -> None:
        pass


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

    monkeypatch.setattr(progress, "threading", types.SimpleNamespace(Timer=Now, Lock=threading.Lock))
    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm"))
    monkeypatch.setitem(sys.modules, "tqdm.auto", types.SimpleNamespace(tqdm=make))
    return made


def test_a_notebook_has_a_bar_of_tqdm(bars, room):
    usd2kg.build(room, progress=True)
    (bar,) = bars
    assert (bar.total, bar.is_closed) == (5, True)
    texts = [text for _, text in bar.shown if text != "reading the ontology"]
    assert texts == ["", "reading the scene", "grounding objects", "finding relations", "making the graph"]
    assert [done for done, _ in bar.shown] == [0, *range(len(bar.shown) - 1)]


def test_a_notebook_shows_no_short_steps(bars, monkeypatch):
    monkeypatch.setattr(progress, "threading", threading)
    run_steps()
    assert bars == []


def test_without_names_all_steps_are_shown(bars, room, tmp_path):
    with show_steps():
        usd2kg.write_graph(usd2kg.build(room).graph, tmp_path / "g.ttl")
        usd2kg.load_graph(tmp_path / "g.ttl")
    (bar,) = bars
    assert (bar.total, bar.is_closed) == (None, True)
    assert [text for _, text in bar.shown][-2:] == ["writing the graph", "reading the graph"]


def test_a_bar_within_a_bar_is_not_shown(bars, room):
    with show_steps("read", "ground"):
        usd2kg.build(room, progress=True)
    (bar,) = bars
    assert [text for _, text in bar.shown if text] == ["reading the scene", "grounding objects"]


def test_an_opened_graph_has_a_bar(bars, room, tmp_path):
    usd2kg.open(room, progress=True).save(tmp_path / "g.ttl")
    usd2kg.open(tmp_path / "g.ttl", progress=True)
    assert bars[1].shown[-1] == (0, "reading the graph")


def test_build_shows_no_bar_unless_asked(bars, room):
    usd2kg.build(room)
    assert bars == []


def test_a_notebook_without_tqdm_shows_nothing(notebook, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    run_steps()
    assert capsys.readouterr() == ("", "")


@pytest.fixture
def graph(room, tmp_path) -> str:
    path = tmp_path / "graph.ttl"
    usd2kg.write_graph(usd2kg.build(room).graph, path)
    return str(path)


@pytest.mark.parametrize(
    ("command", "steps"),
    [
        ("build ROOM -o out.ttl", "read ground relate instantiate write"),
        ("ground ROOM -o out.csv", "read ground"),
        ("inspect ROOM", "read"),
        ("convert ROOM.obj -o out.usda", "convert"),
        ("label ROOM GRAPH -o out.usda", "parse label"),
        ("label lint ROOM --run GRAPH", "parse lint"),
        ("query GRAPH where is cup", "parse answer"),
        ("query GRAPH --sparql ASK{}", "parse answer"),
        ("ask GRAPH where is the cup?", "parse answer"),
        ("store load GRAPH --store lab", "parse load"),
        ("graph draw GRAPH -o out.svg", "parse draw"),
        ("graph convert GRAPH -o out.nt", "parse write"),
        ("graph export GRAPH --to tf -o out", "parse export"),
        ("graph export GRAPH --to ros2 -o out", "parse export"),
        ("graph export GRAPH -o out", "parse export"),
        ("validate GRAPH", "parse validate"),
        ("diff GRAPH GRAPH", "parse"),
    ],
)
def test_commands_show_their_steps(command, steps, monkeypatch, room, graph, tmp_path, run_main):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(progress, "threading", types.SimpleNamespace(Timer=Now, Lock=threading.Lock))
    if "ROOM.obj" in command:
        pytest.importorskip("trimesh")
        trimesh_box(tmp_path / "box.obj")
    places = {"ROOM": room, "GRAPH": graph, "ROOM.obj": "box.obj"}
    shown: list[str] = []
    bar = types.SimpleNamespace(show=lambda _, text: shown.append(text), close=lambda: shown.append("closed"))
    monkeypatch.setattr(progress, "_choose_bar", lambda: lambda _count: bar)
    words = command.split()
    run_main(*(places.get(word, word) for word in words))
    found = [text for text in shown if text not in {"", "closed", "reading the ontology"}]
    assert found == [progress._TEXTS[step] for step in steps.split()]
    assert shown[-1] == "closed"


def test_json_has_no_bar(monkeypatch, room, graph, run_main, tmp_path):
    monkeypatch.setattr(progress, "_choose_bar", lambda: pytest.fail("a bar was chosen"))
    for command in (
        ["build", room, "-o", str(tmp_path / "x.ttl")],
        ["query", graph, "on", "cup"],
        ["inspect", room],
        ["diff", graph, graph],
    ):
        run_main(*command, "--json")


def trimesh_box(path) -> None:
    import trimesh  # noqa: PLC0415 - an extra

    trimesh.creation.box((1, 1, 1)).export(path)


@pytest.mark.parametrize("command", ["build", "ground"])
def test_a_terminal_shows_the_bar_of_a_command(command, monkeypatch, room, tmp_path, capsys, run_main):
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
        with pytest.raises(SystemExit) as stop:
            main()
        # `label lint` and `validate` may have findings.
        assert stop.value.code in {0, None, 1}

    return run
