"""RateLimiter, and the counters of requests and waits."""

import heapq
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.grounding.llm import servers
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Request
from usd2kg.grounding.llm.traffic import RateLimiter, Traffic

REQUEST = Request("the classes", "the objects", {"type": "object", "properties": {}})


class Clock:
    """A clock that advances only while all threads sleep.

    When all threads of the test sleep, time jumps to the end of the shortest sleep.
    """

    def __init__(self, threads: int = 1) -> None:
        self._now = 0.0
        self._threads = threads
        self._ends: list[float] = []
        self._changed = threading.Condition()

    def now(self) -> float:
        with self._changed:
            return self._now

    def sleep(self, seconds: float) -> None:
        with self._changed:
            end = self._now + seconds
            heapq.heappush(self._ends, end)
            self._advance()
            self._changed.wait_for(lambda: self._now >= end)

    def leave(self) -> None:
        """End a thread."""
        with self._changed:
            self._threads -= 1
            self._advance()

    def _advance(self) -> None:
        if self._ends and len(self._ends) >= self._threads:
            self._now = self._ends[0]
            while self._ends and self._ends[0] <= self._now:
                heapq.heappop(self._ends)
            self._changed.notify_all()


class TestRateLimiter:
    def test_spaces_requests_evenly(self):
        clock = Clock()
        limiter = RateLimiter(30, clock.sleep, clock.now)

        times = []
        for _ in range(5):
            limiter.wait_for_turn()
            times.append(clock.now())

        assert times == [0, 2, 4, 6, 8]

    def test_allows_no_burst_after_a_pause(self):
        clock = Clock()
        limiter = RateLimiter(60, clock.sleep, clock.now)

        limiter.wait_for_turn()
        clock.sleep(10)
        times = []
        for _ in range(3):
            limiter.wait_for_turn()
            times.append(clock.now())

        assert times == [10, 11, 12]

    def test_does_not_wait_without_a_rate(self):
        waits: list[float] = []
        limiter = RateLimiter(None, waits.append, lambda: 0.0)

        for _ in range(100):
            limiter.wait_for_turn()

        assert waits == []

    def test_limits_the_rate_over_all_threads(self):
        """Eight threads send ten requests each at 60 per minute, the last one in second 79."""
        clock = Clock(threads=8)
        limiter = RateLimiter(60, clock.sleep, clock.now)
        times: list[float] = []

        def send() -> None:
            for _ in range(10):
                limiter.wait_for_turn()
                times.append(clock.now())
            clock.leave()

        threads = [threading.Thread(target=send) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(30)

        assert sorted(times) == list(range(80))
        in_a_minute = [sum(1 for time in times if start <= time < start + 60) for start in range(80)]
        assert max(in_a_minute) == 60


class TestTraffic:
    def test_counts_waits(self):
        traffic, slept = Traffic(), []

        sleep = traffic.counting(slept.append)
        sleep(1.5)
        sleep(0.25)

        assert slept == [1.5, 0.25]
        assert traffic == Traffic(waits=2, waited_s=1.75)

    def test_is_thread_safe(self):
        traffic = Traffic()

        with ThreadPoolExecutor(8) as pool:
            list(pool.map(lambda _: traffic.add(attempts=1, waited_s=0.5), range(1000)))

        assert traffic == Traffic(attempts=1000, waited_s=500.0)


class TestClient:
    def test_counts_attempts_retries_and_waits(self):
        replies = servers.refuse(429, "slow", Retry_After="7"), servers.refuse(503, "oops"), servers.openai_reply("{}")
        with (
            servers.serve(*replies) as server,
            make_client(f"openai:m@{server.url}", environment={}, sleep=lambda _: None, random=lambda: 0.5) as client,
        ):
            client.complete(REQUEST)
            # Seven seconds as requested, then half of the two-second bound.
            assert client.traffic == Traffic(attempts=3, retries=2, waits=2, waited_s=8.0)
            client.complete(REQUEST)
            assert client.traffic == Traffic(attempts=4, retries=2, waits=2, waited_s=8.0)

    def test_counts_a_dropped_feature_as_an_attempt_but_not_a_retry(self):
        replies = servers.refuse(400, "logprobs is not supported"), servers.openai_reply("{}")
        with servers.serve(*replies) as server, make_client(f"openai:m@{server.url}", environment={}) as client:
            client.complete(REQUEST)
            assert client.traffic == Traffic(attempts=2)

    def test_applies_the_rate_limit_to_every_attempt(self):
        """This includes dropped features and retries."""
        clock = Clock()
        replies = (
            servers.refuse(400, "logprobs is not supported"),
            servers.refuse(503, "oops"),
            servers.openai_reply("{}"),
        )
        with (
            servers.serve(*replies) as server,
            make_client(
                f"openai:m@{server.url}",
                environment={},
                sleep=clock.sleep,
                random=lambda: 0.25,
                requests_per_minute=6,
                clock=clock.now,
            ) as client,
        ):
            client.complete(REQUEST)
            # Sent in seconds 0, 10 and, including a backoff of 0.25 s, 20.
            assert clock.now() == 20
            assert client.traffic == Traffic(attempts=3, retries=1, waits=3, waited_s=20.0)
            client.complete(REQUEST)
            assert clock.now() == 30

    def test_counts_failed_requests(self):
        with (
            servers.serve(servers.refuse(500, "oops")) as server,
            make_client(f"openai:m@{server.url}", environment={}, max_retries=2, sleep=lambda _: None) as client,
        ):
            with pytest.raises(GroundingError):
                client.complete(REQUEST)
            assert (client.traffic.attempts, client.traffic.retries, client.traffic.waits) == (3, 2, 2)
