"""Traffic and RateLimiter: counters of HTTP requests and waits, and the spacing of requests."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Lock

__all__ = ["RateLimiter", "Traffic"]

Sleep = Callable[[float], object]
"""Function that waits for a number of seconds."""


@dataclass(slots=True)
class Traffic:
    """Counters of HTTP requests and waits over all threads, updated while a run is in progress."""

    attempts: int = 0
    """HTTP requests, including failed ones."""
    retries: int = 0
    """Attempts that repeat a request after a failure that may pass."""
    waits: int = 0
    """Waits before a request: backoff after a failure, or the rate limit."""
    waited_s: float = 0.0
    """Total duration of the waits, summed over threads."""
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)

    def add(self, *, attempts: int = 0, retries: int = 0, waits: int = 0, waited_s: float = 0.0) -> None:
        """Increment the counters."""
        with self._lock:
            self.attempts += attempts
            self.retries += retries
            self.waits += waits
            self.waited_s += waited_s

    def counting(self, sleep: Sleep) -> Sleep:
        """Return a version of `sleep` that counts its waits."""

        def wait(seconds: float) -> None:
            self.add(waits=1, waited_s=seconds)
            sleep(seconds)

        return wait


class RateLimiter:
    """Spaces requests evenly over all threads.

    There are no bursts, not even after a pause: servers may enforce a limit per minute by the second.
    """

    def __init__(
        self, requests_per_minute: float | None, sleep: Sleep = time.sleep, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Create a rate limiter.

        Args:
            requests_per_minute: above 0; None for no limit.
            sleep: waits for a number of seconds.
            clock: returns monotonic seconds.
        """
        self._interval_s = 60.0 / requests_per_minute if requests_per_minute is not None else 0.0
        self._sleep, self._clock = sleep, clock
        self._lock = Lock()
        self._next_s = clock()

    def wait_for_turn(self) -> None:
        """Wait until the next request may be sent. Threads proceed in the order of their calls."""
        with self._lock:
            now = self._clock()
            turn = max(now, self._next_s)
            self._next_s = turn + self._interval_s
        # Outside the lock, so that other threads can take their turns meanwhile.
        if turn > now:
            self._sleep(turn - now)
