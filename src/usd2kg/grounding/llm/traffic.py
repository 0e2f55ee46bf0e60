"""How many requests go over the wire, and when."""

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Lock

__all__ = ["RateLimiter", "Traffic"]

Sleep = Callable[[float], object]
"""Waits so many seconds."""


@dataclass(slots=True)
class Traffic:
    """What was sent to a model and waited for, by all threads; it grows while a run goes on."""

    attempts: int = 0
    """HTTP requests, failed ones among them."""
    retries: int = 0
    """Those of them that were sent again after a failure that may pass."""
    waits: int = 0
    """Pauses before a request: after a failure, or to keep to the rate."""
    waited_s: float = 0.0
    """Seconds of all pauses; those of threads that wait side by side add up."""
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)

    def add(self, *, attempts: int = 0, retries: int = 0, waits: int = 0, waited_s: float = 0.0) -> None:
        """Count what has happened."""
        with self._lock:
            self.attempts += attempts
            self.retries += retries
            self.waits += waits
            self.waited_s += waited_s

    def counting(self, sleep: Sleep) -> Sleep:
        """Return what sleeps and counts it."""

        def wait(seconds: float) -> None:
            self.add(waits=1, waited_s=seconds)
            sleep(seconds)

        return wait


class RateLimiter:
    """Spaces requests evenly over all threads, so that no minute has more of them than allowed.

    There are no bursts, not even after a pause: servers may count by the second what they allow by the minute.
    """

    def __init__(
        self, requests_per_minute: float | None, sleep: Sleep = time.sleep, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Start now; None lets every request go at once.

        Args:
            requests_per_minute: how many, above 0.
            sleep: waits so many seconds.
            clock: seconds since whenever.
        """
        self._interval_s = 60.0 / requests_per_minute if requests_per_minute is not None else 0.0
        self._sleep, self._clock = sleep, clock
        self._lock = Lock()
        self._next_s = clock()

    def wait_for_turn(self) -> None:
        """Return when the next request may be sent; threads come in the order in which they call."""
        with self._lock:
            now = self._clock()
            turn = max(now, self._next_s)
            self._next_s = turn + self._interval_s
        # Outside of the lock, so that others can queue up meanwhile.
        if turn > now:
            self._sleep(turn - now)
