"""What goes to a language model and what comes back, whoever serves it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from statistics import fmean
from typing import Any, Protocol

__all__ = ["Client", "Completion", "Finish", "Request", "Usage"]


class Finish(StrEnum):
    """Why a completion ended."""

    STOP = "stop"
    """The model was done."""
    LENGTH = "length"
    """It ran into the limit of output tokens."""
    DEGENERATE = "degenerate"
    """It looped or said nothing, and was cut off."""


@dataclass(frozen=True, slots=True)
class Request:
    """One prompt, with all that its completion depends on beside the model."""

    system: str
    """Instructions and TBox: what requests of one run share, so that servers can keep it."""
    user: str
    """The objects that are asked about."""
    schema: Mapping[str, Any]
    """JSON Schema of the answer."""
    max_tokens: int = 4096
    """Output tokens after which the model is cut off."""
    temperature: float = 0.0
    is_thinking: bool = False
    """Whether a model that can reason before it answers does."""
    sample: int = 0
    """Which of several completions of one prompt this is."""
    images: tuple[bytes, ...] = ()
    """PNG files that are shown after the text."""


@dataclass(frozen=True, slots=True)
class Usage:
    """Tokens, as the server counts them where it does."""

    input_tokens: int = 0
    cached_tokens: int = 0
    """Those of the input that the server had already read."""
    output_tokens: int = 0
    estimated_tokens: int = 0
    """Those of input and output that we estimate, as the server did not count them: about one for four bytes."""
    written_tokens: int = 0
    """Those of the input that the server wrote into its cache, which costs more at Anthropic's."""

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
    """What a model said."""

    text: str
    finish: Finish = Finish.STOP
    usage: Usage = field(default_factory=Usage)
    tokens: tuple[tuple[str, float], ...] = ()
    """Text and natural logarithm of the probability of each token, in order; empty where the server does not tell.

    Joined, the texts hold `text`, maybe with reasoning before and a mark of the end behind. A token that ends within a
    character has none of it; the one that completes it has all.
    """
    thinking: str = ""
    """What it reasoned before, where the server tells."""

    @property
    def mean_logprob(self) -> float | None:
        """Mean natural logarithm of the tokens' probabilities; None where the server does not tell."""
        return fmean(logprob for _, logprob in self.tokens) if self.tokens else None


class Client(Protocol):
    """Completes prompts with one model."""

    model: str
    """The model as the user named it; part of what answers depend on."""

    def complete(self, request: Request) -> Completion:
        """Return the model's completion.

        Raises:
            GroundingError: the model cannot be asked: no key, no server, refused, out of quota.
        """
        ...
