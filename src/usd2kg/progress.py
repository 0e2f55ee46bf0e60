"""show_steps: a progress bar of steps, in a notebook or on a terminal."""

import logging
import sys
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any, Protocol, Self

from usd2kg.tracing import are_steps_followed, followed_steps

__all__ = ["show_steps"]

_DELAY_S = 1.0
"""Seconds before a bar appears."""
_TEXTS = {
    "ontology": "reading the ontology",
    "read": "reading the scene",
    "ground": "grounding objects",
    "relate": "finding relations",
    "instantiate": "making the graph",
    "write": "writing the graph",
    "validate": "checking the graph",
    "parse": "reading the graph",
    "answer": "answering the question",
    "load": "loading the store",
    "export": "writing the files",
    "draw": "drawing the graph",
    "convert": "converting the file",
    "label": "writing the labels",
    "lint": "checking the labels",
}
"""Step of `usd2kg.tracing` → text beside the bar."""


class _Bar(Protocol):
    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        ...

    def close(self) -> None:
        """Remove the bar."""
        ...


_MakeBar = Callable[[int | None], _Bar]
"""Number of all steps, None if unknown → a bar that is shown."""


@contextmanager
def show_steps(*steps: str, is_wanted: bool = True) -> Iterator[None]:
    """Show a bar of the given steps from a second after the start until the context ends, then remove it.

    In a notebook, it is a bar of tqdm if that is installed; on a terminal, one of rich on stderr unless the steps are
    logged; elsewhere nothing is shown. Within another such context, nothing is shown either.

    Args:
        steps: names of steps of `usd2kg.tracing`; without any, all steps that begin are shown.
        is_wanted: whether to show the bar at all.

    >>> with show_steps():
    ...     pass
    """
    make = _choose_bar() if is_wanted and not are_steps_followed() else None
    if make is None:
        yield
        return
    bar = _DelayedBar(make, len(steps) or None)
    begun: list[str] = []

    def notice(step: str) -> None:
        if (step in steps or (not steps and step in _TEXTS)) and step not in begun:
            bar.show(len(begun), _TEXTS[step])
            begun.append(step)

    with bar, followed_steps(notice):
        yield


def _choose_bar() -> _MakeBar | None:
    if _is_notebook():
        try:
            return _notebook_bars()
        except ModuleNotFoundError:
            return None
    is_logged = logging.getLogger("usd2kg").isEnabledFor(logging.INFO)
    return _TerminalBar if sys.stderr.isatty() and not is_logged else None


def _is_notebook() -> bool:
    """Return whether this process is the kernel of a notebook."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return shell is not None and "IPKernelApp" in shell.config


class _DelayedBar:
    """A bar that appears after the delay, also within a long step."""

    def __init__(self, make: _MakeBar, count: int | None) -> None:
        self._make, self._count = make, count
        self._done, self._text = 0, ""
        self._bar: _Bar | None = None
        self._has_ended = False
        self._lock = threading.Lock()
        self._timer = threading.Timer(_DELAY_S, self._appear)
        self._timer.daemon = True

    def __enter__(self) -> Self:
        self._timer.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._timer.cancel()
        with self._lock:
            self._has_ended = True
            if self._bar is not None:
                self._bar.close()

    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        with self._lock:
            self._done, self._text = done, text
            if self._bar is not None:
                self._bar.show(done, text)

    def _appear(self) -> None:
        with self._lock:
            if not self._has_ended:
                self._bar = self._make(self._count)
                self._bar.show(self._done, self._text)


def _notebook_bars() -> _MakeBar:
    """Return a function that makes bars of tqdm: widgets if ipywidgets is installed, else text.

    Raises:
        ModuleNotFoundError: tqdm is not installed.
    """
    with warnings.catch_warnings():
        # tqdm warns if ipywidgets is missing.
        warnings.simplefilter("ignore")
        from tqdm.auto import tqdm  # noqa: PLC0415 - optional

    return lambda count: _NotebookBar(tqdm, count)


class _NotebookBar:
    def __init__(self, tqdm: Any, count: int | None) -> None:
        number = "{n_fmt}" if count is None else "{n_fmt} of {total_fmt}"
        self._bar = tqdm(total=count, leave=False, bar_format=f"{{desc}}: {number} steps {{bar}}")

    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        self._bar.set_description_str(text, refresh=False)
        self._bar.n = done
        self._bar.refresh()

    def close(self) -> None:
        """Remove the bar."""
        self._bar.close()


class _TerminalBar:
    """A bar of rich on stderr."""

    def __init__(self, count: int | None) -> None:
        from rich.console import Console  # noqa: PLC0415 - slow to import
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn  # noqa: PLC0415

        columns = (BarColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
        # What is written to stdout is data, which must not pass through a console on stderr.
        console = Console(stderr=True)
        self._bar: Progress = Progress(*columns, console=console, transient=True, redirect_stdout=False)
        self._task = self._bar.add_task("", total=count)
        self._bar.start()

    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        self._bar.update(self._task, completed=done, description=text)

    def close(self) -> None:
        """Remove the bar."""
        self._bar.stop()
