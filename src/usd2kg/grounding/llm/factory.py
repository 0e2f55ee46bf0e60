"""What a user says about asking a model, and the grounder made from it."""

import weakref
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Client, Completion, Request
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.local.client import is_local_model, open_local
from usd2kg.grounding.llm.metered_client import Budget, MeteredClient
from usd2kg.grounding.llm.prices import find_tariff, parse_price
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompts import Example
from usd2kg.grounding.llm.traffic import Traffic
from usd2kg.grounding.platt_scaling import read_scaling

__all__ = ["LLMSettings", "make_llm_grounder", "open_llm_grounder", "open_metered_client", "parse_llm_name"]


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
    """Classes of the lexical grounder that are offered for each object; None for all."""
    samples: int = 1
    """Completions of each prompt; the class that most of them name is taken."""
    first_sample: int = 0
    """Number of the first of them; repeated runs have different ones."""
    temperature: float | None = None
    """None for 0, or 0.7 where there are several samples."""
    token_budget: int | None = None
    price: str | None = None
    """Dollars for a million tokens, as INPUT/OUTPUT; None for the list price."""
    budget: Decimal | None = None
    """US dollars."""
    concurrency: int = 4
    """Prompts that are on their way at the same time."""
    requests_per_minute: int | None = None
    calibration: Path | None = None
    """File that makes probabilities of its confidences; None for none."""
    completions: Path | None = None
    """File of the cache; None for the user's."""
    is_refreshed: bool = False
    is_replayed: bool = False
    """Take only what is in the cache, and ask nobody."""


_SAMPLING_TEMPERATURE = 0.7
"""As in the paper on self-consistency (Wang et al., 2023)."""


@contextmanager
def open_llm_grounder(
    settings: LLMSettings,
    *,
    is_dry: bool = False,
    examples: Sequence[Example] = (),
    picture: Callable[[str], bytes | None] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[LLMGrounder]:
    """Open a grounder, its connections and its cache; a dry one plans its prompts and cannot ask.

    Args:
        settings: which model is asked, how, and for how much.
        is_dry: whether nobody is asked.
        examples: objects that a person has named, shown in each prompt.
        picture: gives the PNG picture of a prim; pictures are sent if it is given.
        progress: told the number of objects that are done and of all.

    Raises:
        GroundingError: the strategy or model is unknown, a key is missing, the cache cannot be opened, a price is
            malformed or, though there is a budget in dollars, unknown.
    """
    scaling = read_scaling(settings.calibration) if settings.calibration is not None else None
    with ExitStack() as stack:
        asker = _open_asker(settings, stack, is_dry=is_dry)
        yield LLMGrounder(
            asker,
            _prompt_options(settings),
            shares_answers=not settings.is_each_object,
            shortlist=settings.shortlist,
            # A model in this process serves one prompt at a time: others would only wait, and an interrupt for them.
            workers=1 if is_local_model(settings.model) else settings.concurrency,
            samples=settings.samples,
            first_sample=settings.first_sample,
            examples=examples,
            picture=picture,
            scaling=scaling,
            **({"progress": progress} if progress is not None else {}),
        )


@contextmanager
def open_metered_client(settings: LLMSettings) -> Iterator[MeteredClient]:
    """Open a model to be asked anything, with its connections and its cache.

    Raises:
        GroundingError: as `open_llm_grounder`.
    """
    with ExitStack() as stack:
        yield _open_asker(settings, stack)


def _prompt_options(settings: LLMSettings) -> PromptOptions:
    usual = _SAMPLING_TEMPERATURE if settings.samples > 1 else 0.0
    return PromptOptions(
        strategy=settings.strategy,
        is_tree=settings.is_tree,
        objects_per_prompt=settings.objects_per_prompt,
        is_thinking=settings.is_thinking,
        has_more_evidence=settings.has_more_evidence,
        shuffle_seed=settings.shuffle_seed,
        temperature=usual if settings.temperature is None else settings.temperature,
    )


def _open_asker(settings: LLMSettings, stack: ExitStack, *, is_dry: bool = False) -> MeteredClient:
    tariff = find_tariff(settings.model) if settings.price is None else parse_price(settings.price)
    limits = Budget(settings.token_budget, settings.budget)
    if is_dry:
        return MeteredClient(_NoClient(settings.model), tariff=tariff, limits=limits)
    cache = stack.enter_context(CompletionCache(settings.completions or default_cache_path()))
    client, traffic = _open_client(settings, stack)
    return MeteredClient(
        client, cache=cache, is_refreshed=settings.is_refreshed, limits=limits, tariff=tariff, traffic=traffic
    )


def _open_client(settings: LLMSettings, stack: ExitStack) -> tuple[Client, Traffic]:
    if settings.is_replayed:
        return _NoClient(settings.model), Traffic()
    if is_local_model(settings.model):
        return stack.enter_context(open_local(settings.model)), Traffic()
    client = make_client(settings.model, requests_per_minute=settings.requests_per_minute)
    return stack.enter_context(client), client.traffic


def parse_llm_name(name: str) -> tuple[str, Strategy]:
    """Return model and strategy of a grounder's name: `llm-C:google:gemini-2.5-flash`; without a letter it is B.

    Raises:
        GroundingError: it is no such name.
    """
    kind, _, model = name.partition(":")
    said = kind.removeprefix("llm").removeprefix("-") or Strategy.CONTEXT.value
    strategies = {strategy.value.lower(): strategy for strategy in Strategy}
    if said.lower() not in strategies or not model:
        raise GroundingError(
            f"grounder {name!r} names no strategy and model; expected llm-A:MODEL, llm-B:MODEL, llm-C:MODEL or "
            "llm-auto:MODEL, with a MODEL like google:gemini-2.5-flash, openai:NAME@http://localhost:8000/v1, gguf:FILE"
        )
    return model, strategies[said.lower()]


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
