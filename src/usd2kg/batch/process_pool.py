"""run_in_processes: do jobs in worker processes with time and memory limits."""

import multiprocessing
import os
import signal
import time
from collections import deque
from collections.abc import Generator, Iterable, Iterator, Mapping
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import TYPE_CHECKING, Any

from usd2kg.batch.job import Job, Outcome, Task, attempt

if TYPE_CHECKING:
    from multiprocessing.context import ForkServerContext, SpawnContext

__all__ = ["PoolLimits", "run_in_processes"]

_POLL_S = 0.2
"""Seconds between two checks of the time and memory of the workers."""
_MIB = 1 << 20


@dataclass(frozen=True)
class PoolLimits:
    """Limits of the workers."""

    workers: int
    """Jobs that run at the same time."""
    seconds: float
    """Wall time of one job, without that of loading what all jobs share."""
    memory_mib: int
    """Resident memory of a worker, on Linux."""
    attempts: int = 2
    """Maximum number of attempts at a job whose worker dies or exceeds a limit."""
    start_seconds: float = 300.0
    """Wall time until a worker is ready."""


def run_in_processes(task: Task, jobs: Iterable[Job], limits: PoolLimits) -> Generator[Outcome]:
    """Yield the outcome of each job in order of completion.

    Workers load what all jobs share once, and share its memory where the system can fork. A worker that dies or exceeds
    a limit is replaced, and its job is begun again at the end, once. When the iterator is closed, the workers are
    killed.

    Raises:
        ChildProcessError: no worker gets ready.
    """
    pool = _Pool(task, limits)
    waiting = deque((job, 1) for job in jobs)
    try:
        while waiting or pool.is_busy:
            pool.assign(waiting)
            for job, count, outcome in pool.collect():
                if outcome.summary is None and isinstance(outcome, _Lost) and count < limits.attempts:
                    waiting.append((job, count + 1))
                else:
                    yield Outcome(job, outcome.summary, outcome.error, outcome.seconds, count)
    finally:
        pool.close()


@dataclass(frozen=True)
class _Ended:
    """The answer of a worker."""

    summary: Mapping[str, Any] | None
    error: str
    seconds: float


class _Lost(_Ended):
    """A job without an answer: the worker died, or was killed."""


@dataclass
class _Worker:
    process: BaseProcess
    connection: Connection
    since: float
    """When it was started, or given its job."""
    is_ready: bool = False
    job: Job | None = None
    count: int = 0
    """Attempts at the job, including this one."""


class _Pool:
    def __init__(self, task: Task, limits: PoolLimits) -> None:
        self._task = task
        self._limits = limits
        self._context = _context()
        self._workers: list[_Worker] = []
        self._failed_starts = 0

    @property
    def is_busy(self) -> bool:
        return any(worker.job is not None for worker in self._workers)

    def assign(self, waiting: deque[tuple[Job, int]]) -> None:
        """Assign a job to each idle worker, and start further workers for the remaining jobs."""
        for worker in self._workers:
            if waiting and worker.is_ready and worker.job is None:
                worker.job, worker.count = waiting.popleft()
                worker.since = time.monotonic()
                try:
                    worker.connection.send(worker.job)
                except OSError:
                    # The worker died while idle; `collect` will report the job as lost.
                    continue
        starting = sum(not worker.is_ready for worker in self._workers)
        for _ in range(min(self._limits.workers - len(self._workers), len(waiting) - starting)):
            self._workers.append(self._start())

    def collect(self) -> Iterator[tuple[Job, int, _Ended]]:
        """Wait a moment, and yield the jobs that have ended."""
        ready = set(wait([worker.connection for worker in self._workers], _POLL_S))
        for worker in tuple(self._workers):
            problem = ""
            if worker.connection in ready:
                try:
                    message = worker.connection.recv()
                except (EOFError, OSError):
                    worker.process.join(1)
                    problem = f"the process died ({_cause(worker.process.exitcode)})"
                else:
                    ended = self._receive(worker, message)
                    if ended is not None:
                        yield ended
                    continue
            problem = problem or self._exceeded(worker)
            if problem:
                yield from self._replace(worker, problem)

    def _receive(self, worker: _Worker, message: object) -> tuple[Job, int, _Ended] | None:
        if not worker.is_ready:
            worker.is_ready = True
            self._failed_starts = 0
            return None
        assert isinstance(message, _Ended) and worker.job is not None, "workers answer jobs"
        job, worker.job = worker.job, None
        # Memory retained from a large scene must not count against the next one.
        if _resident_mib(worker.process.pid) > self._limits.memory_mib / 2:
            self._stop(worker)
        return job, worker.count, message

    def _exceeded(self, worker: _Worker) -> str:
        """Return the limit that a worker exceeds, as the reason for stopping it; empty if there is none."""
        seconds = self._limits.seconds if worker.is_ready else self._limits.start_seconds
        if (worker.job is not None or not worker.is_ready) and time.monotonic() - worker.since > seconds:
            return f"stopped after {seconds:g} s"
        if _resident_mib(worker.process.pid) > self._limits.memory_mib:
            return f"stopped at {self._limits.memory_mib} MiB of memory"
        return ""

    def _replace(self, worker: _Worker, problem: str) -> Iterator[tuple[Job, int, _Ended]]:
        self._stop(worker)
        if worker.job is not None:
            error = f"{worker.job.source}: {problem}"
            yield worker.job, worker.count, _Lost(None, error, time.monotonic() - worker.since)
        elif not worker.is_ready:
            self._failed_starts += 1
            if self._failed_starts > self._limits.workers:
                raise ChildProcessError(f"no worker gets ready: {problem}")

    def _start(self) -> _Worker:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(target=_work, args=(theirs, self._task), daemon=True)
        process.start()
        theirs.close()
        return _Worker(process, ours, time.monotonic())

    def _stop(self, worker: _Worker) -> None:
        self._workers.remove(worker)
        worker.process.kill()
        worker.process.join()
        worker.connection.close()

    def close(self) -> None:
        for worker in tuple(self._workers):
            self._stop(worker)


def _work(connection: Connection, task: Task) -> None:
    """Do jobs until the main process closes the connection."""
    # Ctrl+C reaches all processes of a terminal; the main process decides when to stop the workers.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    work = task.prepare()
    try:
        connection.send("ready")
        while True:
            job = connection.recv()
            start = time.monotonic()
            summary, error = attempt(work, job)
            connection.send(_Ended(summary, error, time.monotonic() - start))
    except (EOFError, OSError):
        return


def _context() -> "ForkServerContext | SpawnContext":
    """Return the start method: a fork server with everything imported, otherwise spawn."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(["usd2kg.batch.worker_preload"])
    return context


def _cause(code: int | None) -> str:
    if code is None or code >= 0:
        return f"exit code {code}"
    try:
        return signal.Signals(-code).name
    except ValueError:
        return f"signal {-code}"


def _resident_mib(pid: int | None) -> float:
    """Return the resident memory of a process; 0 if the system does not report it."""
    try:
        pages = int(Path(f"/proc/{pid}/statm").read_text("ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / _MIB
