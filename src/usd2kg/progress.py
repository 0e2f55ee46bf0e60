"""show_steps: a progress bar of steps, in a notebook or on a terminal."""

import logging
import sys
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol, Self

from usd2kg.tracing import followed_steps

if TYPE_CHECKING:
    from rich.progress import Progress

__all__ = ["show_steps"]

_DELAY_S = 1.0
"""Seconds before a bar appears on a terminal."""
_TEXTS = {
    "ontology": "reading the ontology",
    "read": "reading the scene",
    "ground": "grounding objects",
    "relate": "finding relations",
    "instantiate": "making the graph",
    "write": "writing the graph",
    "validate": "checking the graph",
}
"""Step of `usd2kg.tracing` → text beside the bar."""


class _Bar(Protocol):
    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...

    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        ...


@contextmanager
def show_steps(*steps: str) -> Iterator[None]:
    """Show a bar of the given steps until the context ends, then remove it.

    In a notebook, it is a bar of tqdm if that is installed; on a terminal, one of rich on stderr, after a second and
    unless the steps are logged; elsewhere nothing is shown.
    """
    bar = _choose_bar(len(steps))
    if bar is None:
        yield
        return
    begun: list[str] = []

    def notice(step: str) -> None:
        if step in steps and step not in begun:
            bar.show(len(begun), _TEXTS[step])
            begun.append(step)

    with bar, followed_steps(notice):
        yield


def _choose_bar(count: int) -> _Bar | None:
    if _is_notebook():
        try:
            return _NotebookBar(count)
        except ModuleNotFoundError:
            return None
    is_logged = logging.getLogger("usd2kg").isEnabledFor(logging.INFO)
    return _TerminalBar(count) if sys.stderr.isatty() and not is_logged else None


def _is_notebook() -> bool:
    """Return whether this process is the kernel of a notebook."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return shell is not None and "IPKernelApp" in shell.config


class _NotebookBar:
    """A bar of tqdm: a widget if ipywidgets is installed, else text."""

    def __init__(self, count: int) -> None:
        with warnings.catch_warnings():
            # tqdm warns if ipywidgets is missing.
            warnings.simplefilter("ignore")
            from tqdm.auto import tqdm  # noqa: PLC0415 - optional

            self._bar: Any = tqdm(total=count, leave=False, bar_format="{desc}: {n_fmt} of {total_fmt} steps {bar}")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.close()

    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        self._bar.set_description_str(text, refresh=False)
        self._bar.n = done
        self._bar.refresh()


class _TerminalBar:
    """A bar of rich on stderr, from a second after the start, also within a long step."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._done, self._text = 0, ""
        self._bar: Progress | None = None
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
                self._bar.stop()

    def show(self, done: int, text: str) -> None:
        """Show the number of finished steps, and the step that begins."""
        with self._lock:
            self._done, self._text = done, text
            if self._bar is not None:
                self._bar.update(self._bar.task_ids[0], completed=done, description=text)

    def _appear(self) -> None:
        from rich.console import Console  # noqa: PLC0415 - slow to import
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn  # noqa: PLC0415

        with self._lock:
            if self._has_ended:
                return
            columns = (BarColumn(), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
            # What is written to stdout is data, which must not pass through a console on stderr.
            bar = Progress(*columns, console=Console(stderr=True), transient=True, redirect_stdout=False)
            bar.add_task(self._text, total=self._count, completed=self._done)
            bar.start()
            self._bar = bar
