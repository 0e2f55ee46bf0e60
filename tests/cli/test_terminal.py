"""Tables fit the terminal, and colours are only where it shows them."""

import io
import logging
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout

import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.cli import terminal
from usd2kg.cli.limits import NARROWEST_COLUMN
from usd2kg.cli.output import notify
from usd2kg.cli.terminal import Style, paint
from usd2kg.cli.text_table import fit_columns, format_table


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@contextmanager
def screen_of(width: int) -> Iterator[Terminal]:
    """Make stdout and stderr a terminal."""
    screen = Terminal()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(screen), redirect_stderr(screen):
        patch.setattr(terminal, "_forbidden", False)
        patch.setenv("COLUMNS", str(width))
        patch.setenv("TERM", "xterm")
        patch.delenv("NO_COLOR", raising=False)
        yield screen


PATHS = [(f"/World/Kitchen/Cupboard_{number}", "", "authored kind: component", "0.6 m") for number in range(3)]
COLUMNS = ("path", "mass", "chosen by", "width")


def test_a_wide_table_keeps_what_differs():
    with screen_of(50):
        text = format_table(COLUMNS, [*PATHS, ("/World/Kitchen/Table", "", "authored kind: component", "1.2 m")])
    assert text.splitlines()[0] == "\x1b[1mpath                       width\x1b[0m"
    assert text.splitlines()[1:] == [
        "/World/Kitchen/Cupboard_0  0.6 m",
        "/World/Kitchen/Cupboard_1  0.6 m",
        "/World/Kitchen/Cupboard_2  0.6 m",
        "/World/Kitchen/Table       1.2 m",
        "all: chosen by authored kind: component",
    ]


def test_a_file_gets_the_whole_table():
    assert format_table(COLUMNS, PATHS[:1]).splitlines() == [
        "path                       mass  chosen by                 width",
        "/World/Kitchen/Cupboard_0        authored kind: component  0.6 m",
    ]


TEXTS = st.text(st.characters(codec="ascii", categories=["L", "N"]), max_size=40)


@given(st.integers(1, 5).flatmap(lambda n: st.lists(st.lists(TEXTS, min_size=n, max_size=n), min_size=1, max_size=6)))
def test_a_fitted_table_is_no_wider_than_the_terminal(cells: list[list[str]]):
    table, below = fit_columns(cells, 80)
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    # Five columns of the least width and the gaps between them.
    assert 5 * NARROWEST_COLUMN + 4 * 2 <= 80
    assert sum(widths) + 2 * (len(widths) - 1) <= 80 or len(cells) == 1
    assert len({len(row) for row in table}) == 1
    shown = " ".join([*(cell for row in table for cell in row), *below])
    assert all(cell in shown for row in cells[1:] for cell in row if len(cell) <= NARROWEST_COLUMN)


def test_errors_are_red_on_a_terminal():
    with screen_of(60) as screen:
        notify("usd2kg: no such file", logging.ERROR)
        notify("written")
    assert screen.getvalue() == "\x1b[1;31musd2kg: no such file\x1b[0m\nwritten\n"


@pytest.mark.parametrize(("name", "value"), [("NO_COLOR", "1"), ("TERM", "dumb")])
def test_no_colours_by_variable(monkeypatch: pytest.MonkeyPatch, name: str, value: str):
    with screen_of(60) as screen:
        assert paint("text", Style.HEADER, screen) == "\x1b[1mtext\x1b[0m"
        monkeypatch.setenv(name, value)
        assert paint("text", Style.HEADER, screen) == "text"


def test_no_colours_by_option():
    with screen_of(60) as screen:
        terminal.forbid_colors()
        assert paint("text", Style.HEADER, screen) == "text"


def test_no_colours_in_a_file():
    with screen_of(60):
        assert paint("text", Style.HEADER, io.StringIO()) == "text"


def test_a_name_cannot_colour_the_terminal():
    with screen_of(60) as screen:
        assert "\x1b[31m" not in format_table(("name",), [("\x1b[31mred",), ("b",)])
        notify("\x1b[31mred")
    assert "\x1b" not in screen.getvalue()


def test_shortens_no_number_and_leaves_out_what_a_table_can_do_without():
    rows = [["/Room/" + "x" * 40, "0.05 × 0.89 × 2.04", "-2.75 0.70 0.00", "m" * 30], ["/Room/Cup", "", "", "Clay"]]
    cells = [["path", "size m", "position m", "materials"], *rows]
    table, below = fit_columns(cells, 80)
    assert [row[1:3] for row in table] == [row[1:3] for row in cells]
    assert below == []
    table, below = fit_columns(cells, 80, ["materials"])
    assert [row[1:] for row in table] == [row[1:3] for row in cells]
    assert below == ["left out for the width of the terminal: materials"]
    assert fit_columns(cells, 120, ["materials"]) == (cells, [])
