"""What a user says about asking a model, and the grounder made from it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Client, Completion, Request
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.prompts import PromptOptions, Strategy

__all__ = ["LLMSettings", "open_llm_grounder"]


@dataclass(frozen=True, slots=True)
class LLMSettings:
    """Which model is asked, how, and for how much."""

    model: str
    strategy: str = "B"
    objects_per_prompt: int = 1
    is_tree: bool = False
    is_thinking: bool = False
    is_each_object: bool = False
    token_budget: int | None = None
    completions: Path | None = None
    """File of the cache; None for the user's."""
    is_refreshed: bool = False


@contextmanager
def open_llm_grounder(settings: LLMSettings, *, is_dry: bool = False) -> Iterator[LLMGrounder]:
    """Open a grounder, its connections and its cache; a dry one plans its prompts and cannot ask.

    Raises:
        GroundingError: the strategy or model is unknown, a key is missing, the cache cannot be opened.
    """
    options = PromptOptions(
        strategy=_strategy(settings.strategy),
        is_tree=settings.is_tree,
        objects_per_prompt=settings.objects_per_prompt,
        is_thinking=settings.is_thinking,
    )
    if is_dry:
        yield LLMGrounder(_NoClient(settings.model), options, is_once_each=not settings.is_each_object)
        return
    with (
        make_client(settings.model) as client,
        CompletionCache(settings.completions or default_cache_path()) as cache,
    ):
        yield LLMGrounder(
            client,
            options,
            cache=cache,
            is_refreshed=settings.is_refreshed,
            is_once_each=not settings.is_each_object,
            token_budget=settings.token_budget,
        )


def _strategy(text: str) -> Strategy:
    try:
        return Strategy(text.upper())
    except ValueError as error:
        raise GroundingError(f"strategy {text!r} is unknown; expected A, B or C") from error


@dataclass(frozen=True, slots=True)
class _NoClient(Client):
    model: str

    def complete(self, request: Request) -> Completion:
        raise GroundingError(f"a dry run does not ask {self.model}")
