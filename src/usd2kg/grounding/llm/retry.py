"""Failures of requests, the retry policy, and redaction of credentials in error messages."""

import random
import re
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from usd2kg.grounding.llm.limits import LIMITS

if TYPE_CHECKING:
    from pydantic_ai.exceptions import AgentRunError

__all__ = ["Failure", "Redactor", "RetryPolicy", "advise", "convert_error", "is_transient"]

_Answer = TypeVar("_Answer")

_MESSAGE_KEYS = ("message", "Message", "error", "Error", "detail")
"""Where the providers put a message or the object that contains it; Bedrock's client capitalises them."""
_KEY_SHAPES = re.compile(r"\b(?:sk-|AIza)[\w*-]{6,}|(?<=://)[^/\s@]+(?=@)")
"""API keys of the known providers, recognised by their prefixes, and the user part of a URL."""


@dataclass(frozen=True, slots=True)
class Failure:
    """The failure of a request."""

    message: str
    """One line, redacted."""
    status: int | None = None
    """HTTP status; None if there was no response."""
    is_transient: bool = False
    """Whether the same request may succeed later."""
    retry_after_s: float | None = None
    """Seconds to wait before the next request, as requested by the server; None if it did not."""


@dataclass(frozen=True, slots=True)
class RetryPolicy:
    """Exponential backoff with full jitter: a wait is uniform between 0 and a bound that doubles.

    A wait that the server asks for takes precedence; if it exceeds `LIMITS.max_retry_after_s`, there is no retry.
    """

    max_retries: int = LIMITS.max_retries
    """Attempts after the first."""
    sleep: Callable[[float], object] = time.sleep
    random: Callable[[], float] = random.random

    def run(self, send: Callable[[], _Answer | Failure]) -> _Answer | Failure:
        """Return the first outcome that is not a transient failure, or the last failure."""
        outcome = send()
        for done in range(self.max_retries):
            if not isinstance(outcome, Failure) or not _may_wait(outcome):
                return outcome
            self.sleep(self._wait_s(done, outcome))
            outcome = send()
        return outcome

    def _wait_s(self, done: int, failure: Failure) -> float:
        if failure.retry_after_s is not None:
            return max(failure.retry_after_s, 0.0)
        return self.random() * min(LIMITS.first_backoff_s * 2.0**done, LIMITS.max_backoff_s)


class Redactor:
    """Removes credentials from messages of servers and libraries."""

    def __init__(self, secrets: Iterable[str]) -> None:
        """Create a redactor. Longer secrets are replaced first, since one may be the prefix of another."""
        known = {secret for secret in secrets if len(secret) >= LIMITS.min_secret_characters}
        self._secrets = sorted(known, key=lambda secret: (-len(secret), secret))

    def hide(self, text: str) -> str:
        """Return the text without secrets."""
        for secret in self._secrets:
            text = text.replace(secret, "[key]")
        return text

    def __call__(self, text: str) -> str:
        """Return the text without secrets, on one line of at most `LIMITS.max_error_characters`."""
        text = self.hide(text)
        line = " ".join(_KEY_SHAPES.sub("[key]", text).split())
        return line if len(line) <= LIMITS.max_error_characters else line[: LIMITS.max_error_characters - 1] + "…"


def convert_error(error: "AgentRunError", redact: Redactor) -> Failure:
    """Return the failure that an exception of pydantic-ai reports, with the server's message alone."""
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
        if (error.retry_after or 0.0) > LIMITS.max_retry_after_s:
            message += f" (asks to wait {error.retry_after:.0f} s)"
        return Failure(message, status, is_transient(status), error.retry_after)
    # An error inside a stream follows an accepted request, so the request itself is valid.
    may_pass = error.in_stream or isinstance(error, ModelConnectionError | ModelRequestTimeout)
    return Failure(redact(str(error)), None, may_pass)


def advise(failure: Failure, key_variables: str) -> str:
    """Return what was expected and what the user can do."""
    match failure.status:
        case 401 | 403:
            return f"expected a key with access to the model, check {key_variables}"
        case 404:
            return "expected a model that the server knows, check its name and the address"
        case None if not failure.is_transient:
            return "expected an answer in the provider's format, check the address and the options"
        case None | 408 | 409 | 429:
            return "expected a server that is up and within its limits, check it or try again later"
        case status if status >= 500:
            return "the server failed, try again later"
    return "the server rejected the request, check the model's limits and the options"


def is_transient(status: int) -> bool:
    """Return whether a request with this HTTP status may succeed later."""
    # 424: the model failed during a stream of Bedrock.
    return status in (408, 409, 424, 429) or status >= 500


def _find_message(body: object) -> str:
    """Return the message in the body of an error response, whose structure depends on the provider."""
    if isinstance(body, list) and body:
        return _find_message(body[0])
    if isinstance(body, Mapping):
        inner = next((body[key] for key in _MESSAGE_KEYS if body.get(key)), None)
        return str(dict(body)) if inner is None else _find_message(inner)
    return "" if body is None else str(body)


def _may_wait(failure: Failure) -> bool:
    return failure.is_transient and (failure.retry_after_s or 0.0) <= LIMITS.max_retry_after_s
