"""What a user says about asking a model, and the grounder made from it."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict

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
    has_more_evidence: bool = False
    """Show what the study does not: labels, documentation, asset, materials, parts."""
    shuffle_seed: int | None = None
    """Seed of a random order of the classes; None for the alphabet."""
    shortlist: int | None = None
    """Classes of the embedded grounder that are offered for each object; None for all."""
    token_budget: int | None = None
    completions: Path | None = None
    """File of the cache; None for the user's."""
    is_refreshed: bool = False
    is_replayed: bool = False
    """Take only what is in the cache, and ask nobody."""


class _Form(TypedDict):
    is_once_each: bool
    shortlist: int | None


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
        has_more_evidence=settings.has_more_evidence,
        shuffle_seed=settings.shuffle_seed,
    )
    form: _Form = {"is_once_each": not settings.is_each_object, "shortlist": settings.shortlist}
    if is_dry:
        yield LLMGrounder(_NoClient(settings.model), options, **form)
        return
    with ExitStack() as stack:
        cache = stack.enter_context(CompletionCache(settings.completions or default_cache_path()))
        client: Client = (
            _NoClient(settings.model) if settings.is_replayed else stack.enter_context(make_client(settings.model))
        )
        yield LLMGrounder(
            client,
            options,
            cache=cache,
            is_refreshed=settings.is_refreshed,
            token_budget=settings.token_budget,
            **form,
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
        raise GroundingError(f"not asked: what {self.model} says to this is not kept; leave out --replay to ask it")
