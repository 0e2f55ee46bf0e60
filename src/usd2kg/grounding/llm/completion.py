"""Requests to a language model and their completions, independent of the provider."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Protocol

from usd2kg.grounding.llm.limits import LIMITS

__all__ = ["Client", "Completion", "Finish", "Request", "Usage"]


class Finish(StrEnum):
    """Why a completion ended."""

    STOP = "stop"
    """The model ended the completion."""
    LENGTH = "length"
    """The completion reached the limit of output tokens."""
    DEGENERATE = "degenerate"
    """The client cut off the completion because it repeated itself."""


@dataclass(frozen=True, slots=True)
class Request:
    """One prompt with everything that determines its completion, apart from the model."""

    system: str
    """Instructions and TBox. Requests of a run share it, so servers can cache it."""
    user: str
    """Descriptions of the objects."""
    schema: Mapping[str, Any]
    """JSON Schema of the answer."""
    max_tokens: int = LIMITS.max_output_tokens
    """Limit of output tokens."""
    temperature: float = 0.0
    is_thinking: bool = False
    """Whether a reasoning model reasons before it answers."""
    sample: int = 0
    """Sample number, if a prompt is completed several times."""
    images: tuple[bytes, ...] = ()
    """PNG files shown after the text."""


@dataclass(frozen=True, slots=True)
class Usage:
    """Token counts, as reported by the server or estimated."""

    input_tokens: int = 0
    cached_tokens: int = 0
    """Input tokens that the server read from its cache."""
    output_tokens: int = 0
    estimated_tokens: int = 0
    """The part of the input and output tokens that is estimated because the server did not report it."""
    written_tokens: int = 0
    """Input tokens that the server wrote to its cache; Anthropic charges more for them."""

    def __add__(self, other: "Usage") -> "Usage":
        return Usage(
            self.input_tokens + other.input_tokens,
            self.cached_tokens + other.cached_tokens,
            self.output_tokens + other.output_tokens,
            self.estimated_tokens + other.estimated_tokens,
            self.written_tokens + other.written_tokens,
        )


@dataclass(frozen=True, slots=True)
class Completion:
    """The output of a model."""

    text: str
    finish: Finish = Finish.STOP
    usage: Usage = field(default_factory=Usage)
    tokens: tuple[tuple[str, float], ...] = ()
    """Text and natural log-probability of each token, in order; empty if the server does not return them.

    Joined, the texts contain `text`, possibly after reasoning and before an end token. If a character consists of
    several tokens, the last of them has its text and the others are empty.
    """
    thinking: str = ""
    """The model's reasoning before the answer, if the server returns it."""


class Client(Protocol):
    """Completes prompts with one model."""

    model: str
    """The model string; part of the cache key."""

    def complete(self, request: Request) -> Completion:
        """Return the model's completion.

        Raises:
            GroundingError: the request failed: no key, no server, rejected, quota exceeded.
        """
        ...
