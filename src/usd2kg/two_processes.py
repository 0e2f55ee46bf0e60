"""Compute the halves of a long sequence at the same time, the second one in a forked process."""

import os
import pickle
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import TypeVar

__all__ = ["compute_in_halves"]

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")


def compute_in_halves(
    compute: Callable[[Sequence[_Item]], _Result], items: Sequence[_Item], *, least: int
) -> list[_Result]:
    """Return [compute(first half), compute(second half)], or [compute(items)] if a second process is not worth it.

    Changes that `compute` makes to its surroundings are lost in the second half.

    Args:
        compute: a function without OpenUSD, whose thread pool does not survive a fork; its result can be pickled.
        items: what it computes.
        least: number of items below which the fork takes longer than it saves.
    """
    if len(items) < least or not _may_fork():
        return [compute(items)]
    middle = len(items) // 2
    child, output = _fork(lambda: compute(items[middle:]))
    try:
        with os.fdopen(output, "rb") as pipe, ExitStack() as if_unfinished:
            if_unfinished.callback(os.kill, child, signal.SIGKILL)
            first = compute(items[:middle])
            answer = pipe.read()
            if_unfinished.pop_all()
    finally:
        _, status = os.waitpid(child, 0)
    # A child that failed or ran out of memory: the same error, if any, is raised here.
    second: _Result = pickle.loads(answer) if status == 0 else compute(items[middle:])
    return [first, second]


def _may_fork() -> bool:
    # The threads of a server share locks, which a fork may copy while they are held; that of a progress bar does not.
    is_safe = sys.platform == "linux" and threading.current_thread() is threading.main_thread()
    return is_safe and len(os.sched_getaffinity(0)) > 1


def _fork(compute: Callable[[], object]) -> tuple[int, int]:
    """Return the process that computes a result, and the file descriptor from which it is read, pickled."""
    reading, writing = os.pipe()
    with warnings.catch_warnings():
        # Python 3.12 warns of any other thread, also of the idle ones of OpenUSD and OpenBLAS.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child:
        os.close(writing)
        return child, reading
    status = 1
    try:
        os.close(reading)
        with os.fdopen(writing, "wb") as pipe:
            pickle.dump(compute(), pipe, protocol=pickle.HIGHEST_PROTOCOL)
        status = 0
    finally:
        # Without the clean-up of the parent: exit handlers, buffered output, a traceback.
        os._exit(status)
