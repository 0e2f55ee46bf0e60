"""The progress of a batch on stderr: a bar on a terminal, otherwise periodic lines."""

import sys
import time
from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Self

from usd2kg.cli.output import notify, to_single_line

if TYPE_CHECKING:
    from rich.progress import Progress

    from usd2kg.batch import Built, Job

__all__ = ["BatchProgress"]

_LINE_S = 30.0
"""Seconds between two lines without a terminal."""
_SCENE_WEIGHT = 300_000
"""Scene file size whose processing time equals the fixed cost of a scene, in bytes."""


class BatchProgress:
    """Shows the number of finished scenes, and the remaining time estimated from file sizes."""

    def __init__(self, jobs: "Sequence[Job]", before: int) -> None:
        """Create a progress display; `before` is the number of scenes that earlier runs finished."""
        self._weights = {job.name: _weight(job) for job in jobs}
        self._total = sum(self._weights.values())
        self._count = len(jobs)
        self._before = before
        self._done = self._failed = self._passed = 0
        self._start = self._last = time.monotonic()
        self._bar: Progress | None = None

    def __enter__(self) -> Self:
        if sys.stderr.isatty() and self._count:
            from rich.console import Console  # noqa: PLC0415 - slow to import
            from rich.progress import BarColumn, Progress, TextColumn  # noqa: PLC0415

            self._bar = Progress(BarColumn(), TextColumn("{task.description}"), console=Console(stderr=True))
            self._bar.start()
            self._bar.add_task(self.text(), total=self._total)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def show(self, built: "Built") -> None:
        """Show that a scene is finished; a failure is printed on a permanent line."""
        self._done += 1
        self._passed += self._weights[built.job.name]
        if built.record.error:
            self._failed += 1
            self._say(f"failed: {built.job.name}: {built.record.error}")
        if self._bar is not None:
            self._bar.update(self._bar.task_ids[0], completed=self._passed, description=self.text())
        elif time.monotonic() - self._last > _LINE_S:
            self._last = time.monotonic()
            notify(self.text())

    def text(self) -> str:
        """Return the state in words."""
        elapsed = time.monotonic() - self._start
        parts = [f"{self._before + self._done} of {self._before + self._count} scenes"]
        if self._failed:
            parts.append(f"{self._failed} failed")
        if self._passed and self._done < self._count:
            parts.append(f"about {_duration(elapsed * (self._total / self._passed - 1))} left")
        return ", ".join(parts)

    def _say(self, message: str) -> None:
        if self._bar is None:
            notify(to_single_line(message))
        else:
            self._bar.console.print(to_single_line(message), markup=False, highlight=False, soft_wrap=True)


def _weight(job: "Job") -> int:
    try:
        return _SCENE_WEIGHT + job.source.stat().st_size
    except OSError:
        return _SCENE_WEIGHT


def _duration(seconds: float) -> str:
    """Return a duration with one unit.

    >>> _duration(42), _duration(600), _duration(9000)
    ('42 s', '10 min', '2.5 h')
    """
    if seconds < 90:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
