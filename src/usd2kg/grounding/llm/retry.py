"""When a request that failed is sent again, and how a failure is told without its credentials."""

import random
import re
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from pydantic_ai.exceptions import AgentRunError

__all__ = ["Failure", "Redactor", "RetryPolicy", "advise", "convert_error"]

_Answer = TypeVar("_Answer")

_FIRST_WAIT_S = 1.0
_LONGEST_WAIT_S = 60.0
_LONGEST_ASKED_WAIT_S = 120.0
"""A server that asks for more has run out of a quota: the user should know at once."""

_MOST_CHARACTERS = 300
_LEAST_KEY_CHARACTERS = 6
"""What is shorter is no secret, and blotting it out would make every message unreadable."""

_KEY_SHAPES = re.compile(r"\b(?:sk-|AIza)[\w*-]{6,}|(?<=://)[^/\s@]+(?=@)")
"""How keys of the known providers begin, and the user part of an address."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A request that brought no completion."""

    message: str
    """One line, redacted."""
    status: int | None = None
    """HTTP status; None where no answer came."""
    is_transient: bool = False
    """Whether the same request may work later."""
    retry_after_s: float | None = None
    """Seconds that the server asks to wait before the next request; None where it does not say."""


@dataclass(frozen=True, slots=True)
class RetryPolicy:
    """Exponential backoff with full jitter: a wait is uniform between 0 and a bound that doubles.

    A server that names the wait is obeyed to the second, unless it asks for more than two minutes.
    """

    most: int = 4
    """Requests after the first."""
    sleep: Callable[[float], object] = time.sleep
    random: Callable[[], float] = random.random

    def run(self, send: Callable[[], _Answer | Failure]) -> _Answer | Failure:
        """Return what the first request brings that is no transient failure, or the last failure."""
        outcome = send()
        for done in range(self.most):
            if not isinstance(outcome, Failure) or not _may_wait(outcome):
                return outcome
            self.sleep(self._wait_s(done, outcome))
            outcome = send()
        return outcome

    def _wait_s(self, done: int, failure: Failure) -> float:
        if failure.retry_after_s is not None:
            return max(failure.retry_after_s, 0.0)
        return self.random() * min(_FIRST_WAIT_S * 2.0**done, _LONGEST_WAIT_S)


class Redactor:
    """Makes texts of servers and libraries fit to be shown."""

    def __init__(self, secrets: Iterable[str]) -> None:
        """Remember the secrets; longer ones first, as one may begin another."""
        known = {secret for secret in secrets if len(secret) >= _LEAST_KEY_CHARACTERS}
        self._secrets = sorted(known, key=lambda secret: (-len(secret), secret))

    def __call__(self, text: str) -> str:
        """Return the text without secrets, on one line, of at most 300 characters."""
        for secret in self._secrets:
            text = text.replace(secret, "[key]")
        line = " ".join(_KEY_SHAPES.sub("[key]", text).split())
        return line if len(line) <= _MOST_CHARACTERS else line[: _MOST_CHARACTERS - 1] + "…"


def convert_error(error: "AgentRunError", redact: Redactor) -> Failure:
    """Return what the library's error says, without the library's words around it."""
    from pydantic_ai.exceptions import (  # noqa: PLC0415 - the extra may be missing
        ModelAPIError,
        ModelConnectionError,
        ModelHTTPError,
        ModelRequestTimeout,
    )

    if not isinstance(error, ModelAPIError):
        return Failure(redact(str(error)))
    if isinstance(error, ModelHTTPError):
        status = error.status_code
        message = redact(_find_message(error.body)) or "no message"
        if (error.retry_after or 0.0) > _LONGEST_ASKED_WAIT_S:
            message += f" (asks to wait {error.retry_after:.0f} s)"
        return Failure(message, status, _is_transient(status), error.retry_after)
    # Inside a stream the server had taken the request already: it is not to blame.
    is_transient = error.in_stream or isinstance(error, ModelConnectionError | ModelRequestTimeout)
    return Failure(redact(str(error)), None, is_transient)


def advise(failure: Failure, key_variable: str) -> str:
    """Return what was expected instead of the failure and what the user can do."""
    match failure.status:
        case 401 | 403:
            return f"expected a key that may use the model, check {key_variable}"
        case 404:
            return "expected a model that the server knows, check its name and the address"
        case None if not failure.is_transient:
            return "expected an answer in the provider's format, check the address and the options"
        case None | 408 | 409 | 429:
            return "expected a server that is up and within its limits, check it or try again later"
        case status if status >= 500:
            return "expected a server that works, try again later"
    return "expected a request that the server takes, check the model's limits and the options"


def _is_transient(status: int) -> bool:
    return status in (408, 409, 429) or status >= 500


def _find_message(body: object) -> str:
    """The server's words in the body of an error; every provider wraps them another way."""
    if isinstance(body, list) and body:
        return _find_message(body[0])
    if isinstance(body, Mapping):
        inner = next((body[key] for key in ("message", "error", "detail") if body.get(key)), None)
        return str(dict(body)) if inner is None else _find_message(inner)
    return "" if body is None else str(body)


def _may_wait(failure: Failure) -> bool:
    return failure.is_transient and (failure.retry_after_s or 0.0) <= _LONGEST_ASKED_WAIT_S
