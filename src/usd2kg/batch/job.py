"""Job, Outcome and Task: what a worker is given, what it answers, and what it does."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from usd2kg.errors import Usd2kgError, one_line

__all__ = ["LAYERS", "Job", "Outcome", "Task", "attempt"]

LAYERS = "layers"
"""Key in what a task returns: the `StageFile` of each file that the scene refers to. All else is the summary."""


@dataclass(frozen=True)
class Job:
    """One scene to build."""

    name: str
    """Name of the scene in the batch: its path relative to the folder that all scenes share."""
    source: Path
    target: Path
    """Graph file to write."""
    base: str
    """Namespace of the individuals."""


@dataclass(frozen=True)
class Outcome:
    """How one job ended."""

    job: Job
    summary: Mapping[str, Any] | None
    """What the task returned, with `LAYERS` if it knows them; None if it failed."""
    error: str
    """Why it failed, on one line; empty otherwise."""
    seconds: float
    """Wall time of the last attempt."""
    attempts: int = 1


class Task(Protocol):
    """What is done for each job. It is pickled, sent to each worker once, and prepared there."""

    def prepare(self) -> Callable[[Job], Mapping[str, Any]]:
        """Return the function that does one job, after all that its jobs have in common is loaded."""


def attempt(work: Callable[[Job], Mapping[str, Any]], job: Job) -> tuple[Mapping[str, Any] | None, str]:
    """Return the summary of a job, and an empty string; or None, and why it failed."""
    try:
        return work(job), ""
    except Usd2kgError as error:
        return None, one_line(error)
    except MemoryError:
        return None, f"{job.source}: needs more memory than there is"
    except RecursionError:
        return None, f"{job.source}: is nested too deeply to be read"
    except Exception as error:
        # A fault of the program in one scene must not end the others.
        return None, f"{job.source}: {type(error).__name__}: {one_line(error)}; please report it"
