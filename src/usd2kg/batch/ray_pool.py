"""run_on_ray: do jobs on a Ray cluster, one at a time in each of its actors."""

import logging
import time
from collections import deque
from collections.abc import Generator, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from usd2kg.batch.job import Job, Outcome, Task, attempt
from usd2kg.batch.process_pool import PoolLimits
from usd2kg.errors import GroundingError

__all__ = ["run_on_ray"]

_POLL_S = 0.5


def run_on_ray(task: Task, jobs: Iterable[Job], limits: PoolLimits) -> Generator[Outcome]:
    """Yield the outcome of each job, as `run_in_processes` does.

    The cluster is the one that the environment variable RAY_ADDRESS names, else a local one is started. Its nodes must
    see the files of the jobs by the same paths, and have usd2kg installed. As many actors as `limits.workers` are used;
    Ray places them. Ray itself watches their memory.

    Raises:
        GroundingError: Ray is not installed, or the cluster cannot be reached.
    """
    try:
        import ray  # noqa: PLC0415 - an extra
    except ImportError as error:
        raise GroundingError("--ray needs Ray: pip install 'usd2kg[ray]'") from error
    is_ours = not ray.is_initialized()
    try:
        if is_ours:
            ray.init(log_to_driver=False, logging_level=logging.ERROR, configure_logging=False, include_dashboard=False)
    except (ConnectionError, RuntimeError, ValueError) as error:
        raise GroundingError(f"--ray: the cluster cannot be reached ({error}); start one with ray start") from error
    pool = _RayPool(ray, task, limits)
    waiting = deque((job, 1) for job in jobs)
    try:
        while waiting or pool.is_busy:
            pool.assign(waiting)
            for job, count, outcome in pool.collect():
                if outcome is None and count < limits.attempts:
                    waiting.append((job, count + 1))
                else:
                    summary, error_text, seconds = outcome or (None, f"{job.source}: {pool.last_problem}", 0.0)
                    yield Outcome(job, summary, error_text, seconds, count)
    finally:
        pool.close()
        if is_ours:
            ray.shutdown()


class _Actor:
    """The class of the actors, before Ray makes it remote."""

    def __init__(self, task: Task) -> None:
        self._work = task.prepare()

    def do(self, job: Job) -> tuple[Mapping[str, Any] | None, str, float]:
        start = time.monotonic()
        summary, error = attempt(self._work, job)
        return summary, error, time.monotonic() - start


@dataclass
class _Running:
    actor: Any
    job: Job
    count: int
    since: float


class _RayPool:
    def __init__(self, ray: Any, task: Task, limits: PoolLimits) -> None:
        self._ray = ray
        self._task = ray.put(task)
        self._limits = limits
        self._remote = ray.remote(num_cpus=1, max_restarts=0)(_Actor)
        self._free: list[Any] = []
        self._running: dict[Any, _Running] = {}
        self.last_problem = ""
        """The reason why the last job was lost."""

    @property
    def is_busy(self) -> bool:
        return bool(self._running)

    def assign(self, waiting: "deque[tuple[Job, int]]") -> None:
        while waiting and len(self._running) < self._limits.workers:
            actor = self._free.pop() if self._free else self._remote.remote(self._task)
            job, count = waiting.popleft()
            self._running[actor.do.remote(job)] = _Running(actor, job, count, time.monotonic())

    def collect(self) -> "Iterable[tuple[Job, int, tuple[Mapping[str, Any] | None, str, float] | None]]":
        """Wait a moment, and yield the jobs that have ended; None for those whose actor is lost."""
        ready, _ = self._ray.wait([*self._running], num_returns=1, timeout=_POLL_S)
        for reference in ready:
            running = self._running.pop(reference)
            try:
                outcome = self._ray.get(reference)
            except self._ray.exceptions.RayError as error:
                self.last_problem = f"the actor was lost ({type(error).__name__})"
                yield running.job, running.count, None
            else:
                self._free.append(running.actor)
                yield running.job, running.count, outcome
        # An actor loads what all jobs share before its first job.
        seconds = self._limits.seconds + self._limits.start_seconds
        for reference, running in tuple(self._running.items()):
            if time.monotonic() - running.since > seconds:
                self._ray.kill(running.actor)
                del self._running[reference]
                self.last_problem = f"stopped after {seconds:g} s"
                yield running.job, running.count, None

    def close(self) -> None:
        for actor in (*self._free, *(running.actor for running in self._running.values())):
            self._ray.kill(actor)
