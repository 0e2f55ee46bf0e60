"""EventLoopThread: results, and tasks that others start in its loop."""

import asyncio
import gc

from usd2kg.grounding.llm.event_loop import EventLoopThread


class _ClosesWhenCollected:
    """A client whose finalizer starts a task in the running loop, as google-genai's clients do."""

    def __init__(self, closed: list[str]) -> None:
        self._closed = closed

    def __del__(self) -> None:
        asyncio.get_running_loop().create_task(_close(self._closed))


async def _close(closed: list[str]) -> None:
    await asyncio.sleep(0)
    closed.append("closed")


class TestEventLoopThread:
    def test_finishes_the_tasks_that_finalizers_start_while_it_stops(self):
        closed: list[str] = []
        loop = EventLoopThread()

        async def collect_a_client() -> None:
            client = _ClosesWhenCollected(closed)
            del client
            gc.collect()

        loop.stop(collect_a_client)

        assert closed == ["closed"]

    def test_returns_the_result_of_a_coroutine(self):
        loop = EventLoopThread()

        async def answer() -> int:
            return 42

        assert loop.run(answer()) == 42
        loop.stop(lambda: asyncio.sleep(0))
