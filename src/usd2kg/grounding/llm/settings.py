"""What a user says about asking a model, and the grounder made from it."""

import weakref
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Client, Completion, Request
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.local.client import is_local_model, open_local
from usd2kg.grounding.llm.prompts import PromptOptions, Strategy

__all__ = ["LLMSettings", "make_llm_grounder", "open_client", "open_llm_grounder", "parse_llm_name"]

_WORKERS = 4
"""Prompts that are on their way to a server at the same time."""


@dataclass(frozen=True, slots=True)
class LLMSettings:
    """Which model is asked, how, and for how much."""

    model: str
    strategy: Strategy = Strategy.CONTEXT
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
        strategy=settings.strategy,
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
        client: Client = _NoClient(settings.model)
        if not settings.is_replayed:
            client = stack.enter_context(open_client(settings.model))
        yield LLMGrounder(
            client,
            options,
            cache=cache,
            is_refreshed=settings.is_refreshed,
            # A model in this process serves one prompt at a time: others would only wait, and an interrupt for them.
            workers=1 if is_local_model(settings.model) else _WORKERS,
            token_budget=settings.token_budget,
            **form,
        )


def open_client(model: str) -> AbstractContextManager[Client]:
    """Return a client for a model behind HTTP, or in this process where the string names a file of weights.

    Raises:
        GroundingError: the model is malformed, an extra, a key or the file is missing.
    """
    return open_local(model) if is_local_model(model) else make_client(model)


def parse_llm_name(name: str) -> tuple[str, Strategy]:
    """Return model and strategy of a grounder's name: `llm-C:google:gemini-2.5-flash`; without a letter it is B.

    Raises:
        GroundingError: it is no such name.
    """
    kind, _, model = name.partition(":")
    letter = kind.removeprefix("llm").removeprefix("-").upper() or Strategy.CONTEXT.value
    if letter not in set(Strategy) or not model:
        raise GroundingError(
            f"grounder {name!r} names no strategy and model; expected llm-A:MODEL, llm-B:MODEL or llm-C:MODEL, "
            "with a MODEL like google:gemini-2.5-flash, openai:NAME@http://localhost:8000/v1 or gguf:FILE"
        )
    return model, Strategy(letter)


def make_llm_grounder(name: str) -> LLMGrounder:
    """Return the grounder of such a name, with the user's cache; it is closed when nobody holds it any more.

    Raises:
        GroundingError: the name or model is unknown, a key is missing, the cache cannot be opened.
    """
    model, strategy = parse_llm_name(name)
    stack = ExitStack()
    grounder = stack.enter_context(open_llm_grounder(LLMSettings(model, strategy)))
    weakref.finalize(grounder, stack.close)
    return grounder


@dataclass(frozen=True, slots=True)
class _NoClient(Client):
    model: str

    def complete(self, request: Request) -> Completion:
        raise GroundingError(f"not asked: what {self.model} says to this is not kept; leave out --replay to ask it")
