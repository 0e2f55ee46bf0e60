"""Job, Outcome and Task: the input, the result and the work of a worker."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from usd2kg.errors import Usd2kgError, one_line

__all__ = ["LAYERS", "Job", "Outcome", "Task", "attempt"]

LAYERS = "layers"
"""Key in the result of a task for the `StageFile` of each file of the scene; other keys are the summary."""


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
    """The outcome of one job."""

    job: Job
    summary: Mapping[str, Any] | None
    """Result of the task, with `LAYERS` if known; None if the job failed."""
    error: str
    """Why it failed, on one line; empty otherwise."""
    seconds: float
    """Wall time of the last attempt."""
    attempts: int = 1


class Task(Protocol):
    """The work done for each job. A task is pickled, sent to each worker once, and prepared there."""

    def prepare(self) -> Callable[[Job], Mapping[str, Any]]:
        """Load the data shared by all jobs, and return the function that does one job."""


def attempt(work: Callable[[Job], Mapping[str, Any]], job: Job) -> tuple[Mapping[str, Any] | None, str]:
    """Return the summary of a job and an empty string, or None and the reason for its failure."""
    try:
        return work(job), ""
    except Usd2kgError as error:
        return None, one_line(error)
    except MemoryError:
        return None, f"{job.source}: needs more memory than there is"
    except RecursionError:
        return None, f"{job.source}: is nested too deeply to be read"
    except Exception as error:
        # A bug triggered by one scene must not stop the others.
        return None, f"{job.source}: {type(error).__name__}: {one_line(error)}; please report it"
