"""WorkerPool: processes that answer queries, killed if a query exceeds its time or memory limit."""

import asyncio
import json
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any, NamedTuple

from usd2kg.endpoint.endpoint_limits import EndpointLimits

__all__ = ["BusyError", "TimeLimitError", "WorkerAnswer", "WorkerLostError", "WorkerPool"]

_HEADER_BYTES = 1 << 20
"""Longest header line of a worker."""


class BusyError(Exception):
    """The queue of waiting queries is full."""


class TimeLimitError(Exception):
    """The query exceeded its time limit and was stopped."""


class WorkerLostError(Exception):
    """The worker died, presumably because the query exceeded its memory limit."""


class WorkerAnswer(NamedTuple):
    """The answer of a worker, see `worker`."""

    header: dict[str, Any]
    body: bytes


class WorkerPool:
    """Workers over one store folder. A killed worker is replaced when it is next needed."""

    def __init__(self, folder: Path, limits: EndpointLimits, tables: Path | None = None) -> None:
        """Wrap a store folder; `tables` is the folder for tables derived from it."""
        self._folder = folder
        self._tables = tables
        self._limits = limits
        self._free = asyncio.Semaphore(limits.workers)
        self._idle: list[Process] = []
        self._waiting = 0

    async def run(self, request: dict[str, Any]) -> WorkerAnswer:
        """Return the answer to a request.

        Raises:
            BusyError: too many requests are waiting.
            TimeLimitError: the query exceeded its time limit.
            WorkerLostError: the worker died, presumably at its memory limit.
        """
        if self._waiting >= self._limits.queued_per_worker * self._limits.workers:
            raise BusyError
        self._waiting += 1
        try:
            async with self._free:
                worker = self._idle.pop() if self._idle else await self._start()
                return await self._run_in(worker, request)
        finally:
            self._waiting -= 1

    async def _run_in(self, worker: Process, request: dict[str, Any]) -> WorkerAnswer:
        is_done = False
        try:
            answer = await asyncio.wait_for(_send(worker, request), self._limits.seconds)
            is_done = True
        except TimeoutError as error:
            raise TimeLimitError from error
        except (asyncio.IncompleteReadError, ConnectionError) as error:
            raise WorkerLostError from error
        finally:
            # A disconnected client cancels this task, possibly with a partial answer in the pipe.
            if is_done:
                self._idle.append(worker)
            else:
                _kill(worker)
        return answer

    async def _start(self) -> Process:
        tables = () if self._tables is None else (str(self._tables),)
        worker = await asyncio.create_subprocess_exec(
            *(sys.executable, "-m", "usd2kg.endpoint.worker", str(self._folder), json.dumps(asdict(self._limits))),
            *tables,
            stdin=PIPE,
            stdout=PIPE,
            stderr=DEVNULL,
            limit=_HEADER_BYTES,
        )
        try:
            await _read_answer(worker)
        except asyncio.IncompleteReadError as error:
            raise WorkerLostError from error
        return worker

    async def warm(self) -> None:
        """Start all workers, so that the first queries do not wait."""
        self._idle += await asyncio.gather(*(self._start() for _ in range(self._limits.workers)))

    async def close(self) -> None:
        """Stop all idle workers."""
        while self._idle:
            worker = self._idle.pop()
            _kill(worker)
            await worker.wait()


async def _send(worker: Process, request: dict[str, Any]) -> WorkerAnswer:
    assert worker.stdin is not None, "workers are started with pipes"
    worker.stdin.write(json.dumps(request).encode() + b"\n")
    await worker.stdin.drain()
    return await _read_answer(worker)


async def _read_answer(worker: Process) -> WorkerAnswer:
    assert worker.stdout is not None, "workers are started with pipes"
    header = json.loads(await worker.stdout.readuntil(b"\n"))
    return WorkerAnswer(header, await worker.stdout.readexactly(header["length"]))


def _kill(worker: Process) -> None:
    with suppress(ProcessLookupError):
        worker.kill()
