"""WorkerPool: processes that answer queries and are killed where a query takes too long or too much memory."""

import asyncio
import json
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["BusyError", "Limits", "Result", "TimeLimitError", "WorkerLostError", "WorkerPool"]

_LONGEST_LINE = 1 << 20
_WAITING_PER_WORKER = 8
"""Queries that may wait for each worker; more are turned away at once."""


class BusyError(Exception):
    """Too many queries wait already."""


class TimeLimitError(Exception):
    """The query took too long, and was stopped."""


class WorkerLostError(Exception):
    """The process died: the query needed more memory than it may have."""


@dataclass(frozen=True)
class Limits:
    """What one query and one client may take."""

    seconds: float = 10.0
    rows: int = 10_000
    body_bytes: int = 1 << 20
    """Of a request."""
    memory_mib: int = 1024
    """Of one query, beyond what a worker needs by itself."""
    workers: int = 2


class Result(NamedTuple):
    """What a worker answered."""

    told: dict[str, Any]
    body: bytes


class WorkerPool:
    """Some workers over one folder. A worker that is killed is replaced when it is next needed."""

    def __init__(self, folder: Path, limits: Limits) -> None:
        self._folder = folder
        self._limits = limits
        self._places = asyncio.Semaphore(limits.workers)
        self._idle: list[Process] = []
        self._waiting = 0

    async def run(self, request: dict[str, Any]) -> Result:
        """Return the answer to a request.

        Raises:
            BusyError: too many wait already.
            TimeLimitError: it took too long.
            WorkerLostError: it took too much memory.
        """
        if self._waiting >= _WAITING_PER_WORKER * self._limits.workers:
            raise BusyError
        self._waiting += 1
        try:
            async with self._places:
                worker = self._idle.pop() if self._idle else await self._start()
                return await self._run_in(worker, request)
        finally:
            self._waiting -= 1

    async def _run_in(self, worker: Process, request: dict[str, Any]) -> Result:
        is_done = False
        try:
            result = await asyncio.wait_for(_ask(worker, request), self._limits.seconds)
            is_done = True
        except TimeoutError as error:
            raise TimeLimitError from error
        except (asyncio.IncompleteReadError, ConnectionError) as error:
            raise WorkerLostError from error
        finally:
            # Also where the client has left and this task is cancelled: half an answer may be in the pipe.
            if is_done:
                self._idle.append(worker)
            else:
                _kill(worker)
        return result

    async def _start(self) -> Process:
        limits = map(str, (self._limits.rows, self._limits.memory_mib, self._limits.seconds))
        module = "usd2kg.endpoint.worker"
        worker = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", module, str(self._folder), *limits),
            stdin=PIPE,
            stdout=PIPE,
            stderr=DEVNULL,
            limit=_LONGEST_LINE,
        )
        try:
            await _read_reply(worker)
        except asyncio.IncompleteReadError as error:
            raise WorkerLostError from error
        return worker

    async def warm(self) -> None:
        """Start all workers, so that the first query need not wait for one."""
        self._idle += await asyncio.gather(*(self._start() for _ in range(self._limits.workers)))

    async def close(self) -> None:
        """Stop all workers that are idle."""
        while self._idle:
            worker = self._idle.pop()
            _kill(worker)
            await worker.wait()


async def _ask(worker: Process, request: dict[str, Any]) -> Result:
    assert worker.stdin is not None, "workers are started with pipes"
    worker.stdin.write(json.dumps(request).encode() + b"\n")
    await worker.stdin.drain()
    return await _read_reply(worker)


async def _read_reply(worker: Process) -> Result:
    assert worker.stdout is not None, "workers are started with pipes"
    told = json.loads(await worker.stdout.readuntil(b"\n"))
    return Result(told, await worker.stdout.readexactly(told["length"]))


def _kill(worker: Process) -> None:
    with suppress(ProcessLookupError):
        worker.kill()
