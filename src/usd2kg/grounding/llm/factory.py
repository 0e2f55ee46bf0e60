"""LLMSettings: the user's settings of a language model, and the grounders and clients made from them."""

import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from decimal import Decimal
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.batch_jobs.journal import JobJournal
from usd2kg.grounding.llm.batch_jobs.queue import BatchQueue, Reporting
from usd2kg.grounding.llm.cache import CompletionCache, default_cache_path
from usd2kg.grounding.llm.clients import HttpClient, make_client
from usd2kg.grounding.llm.completion import Client, Completion, Request
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.client import is_local_model, open_local
from usd2kg.grounding.llm.metered_client import Budget, MeteredClient, Spending
from usd2kg.grounding.llm.prices import Tariff, discount_batch, find_tariff, parse_price
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompts import Example, ObjectPictures
from usd2kg.grounding.llm.settings import CONCEPTS, SAMPLING
from usd2kg.grounding.llm.traffic import Traffic
from usd2kg.grounding.platt_scaling import describe_settings, read_scaling

__all__ = [
    "LLMSettings",
    "make_llm_grounder",
    "open_llm_grounder",
    "open_llm_grounders",
    "open_metered_client",
    "parse_llm_name",
]


@dataclass(frozen=True, slots=True)
class LLMSettings:
    """A model, the form of its prompts, and the limits of a run."""

    model: str
    """The model string: `google:gemini-2.5-flash`, `gguf:FILE`…"""
    strategy: Strategy = Strategy.CONTEXT
    objects_per_prompt: int | None = None
    """Objects, or for `BY_CONCEPT` concepts, that a prompt asks about; None for 1, or the default of [concepts]."""
    is_tree: bool = False
    """List the classes as a tree, as `BY_CONCEPT` always does."""
    is_thinking: bool = False
    is_each_object: bool = False
    """Ask about each object, even if it is similar to another."""
    has_more_evidence: bool = False
    """Include labels, documentation, asset, materials and parts, which the study omits."""
    shuffle_seed: int | None = None
    """Seed of a random order of the classes; None for alphabetical order."""
    has_candidates_first: bool = False
    """List the classes of a shortlist by their rank instead of alphabetically."""
    shortlist: int | None = None
    """Number of candidates of the lexical grounder to offer for each object; None for all classes."""
    samples: int = 1
    """Completions per prompt; the class that most of them name is chosen."""
    first_sample: int = 0
    """Number of the first sample; other numbers are not served from the cache of earlier ones."""
    temperature: float | None = None
    """None for 0, or for the default of [sampling] if there are several samples."""
    token_budget: int | None = None
    """Input and output tokens after which no prompt is sent."""
    price: str | None = None
    """US dollars per million tokens, as INPUT/OUTPUT; None for the list price."""
    budget: Decimal | None = None
    """US dollars after which no prompt is sent."""
    concurrency: int = LIMITS.concurrency
    """Prompts in flight at the same time."""
    threads: int = 1
    """Processor threads of a model in this process; they do not affect its answers."""
    requests_per_minute: int | None = None
    calibration: Path | None = None
    """File of a `PlattScaling` for the confidences; None for none."""
    completions: Path | None = None
    """File of the cache; None for the default."""
    is_refreshed: bool = False
    """Replace cached completions."""
    is_replayed: bool = False
    """Use only cached completions."""
    is_batched: bool = False
    """Submit uncached prompts as batch jobs, at batch prices, and wait for the answers."""


@contextmanager
def open_llm_grounder(
    settings: LLMSettings,
    *,
    is_dry: bool = False,
    examples: Sequence[Example] = (),
    pictures: Callable[[str], ObjectPictures | None] | None = None,
    progress: Callable[[int, int], None] | None = None,
    reporting: Reporting | None = None,
) -> Iterator[LLMGrounder]:
    """Open a grounder with its connections and its cache.

    Args:
        settings: the model, the form of its prompts, and the limits of the run.
        is_dry: plan prompts without connecting to a model.
        examples: objects with known classes, shown in each prompt.
        pictures: returns the pictures of a prim, or None if it has none; None to send no pictures.
        progress: called with the number of objects that are done and the total.
        reporting: what the user sees of batch jobs; None for log messages.

    Raises:
        GroundingError: the model is unknown, a key is missing, the cache cannot be opened, the price is malformed,
            there is a budget in dollars but no known price, the service has no batch jobs, the calibration was
            fitted for another model or other prompts, or the cache to replay does not exist.
    """
    with ExitStack() as stack:
        client = _open_metered_client(settings, stack, reporting, is_dry=is_dry)
        yield _make_grounder(settings, client, examples, pictures, progress)


@contextmanager
def open_llm_grounders(
    names: Iterable[str],
    settings: LLMSettings,
    progress: Callable[[int, int], None] | None = None,
    reporting: Reporting | None = None,
) -> Iterator[Mapping[str, LLMGrounder]]:
    """Open grounders by name, like `llm-B:MODEL`, with one client for each model and one budget for all.

    Args:
        names: strategies and models.
        settings: all other settings; its model and strategy have no effect.
        progress: called with the number of objects that are done and the total of one call of a grounder.
        reporting: what the user sees of batch jobs; None for log messages.

    Raises:
        GroundingError: see `open_llm_grounder`, or a name has another form.
    """
    spending = Spending()
    clients: dict[str, MeteredClient] = {}
    grounders = {}
    with ExitStack() as stack:
        for name in names:
            model, strategy = parse_llm_name(name)
            own = replace(settings, model=model, strategy=strategy)
            if model not in clients:
                clients[model] = _open_metered_client(own, stack, reporting, spending)
            grounders[name] = _make_grounder(own, clients[model], progress=progress)
        yield grounders


def _make_grounder(
    settings: LLMSettings,
    client: MeteredClient,
    examples: Sequence[Example] = (),
    pictures: Callable[[str], ObjectPictures | None] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> LLMGrounder:
    scaling = read_scaling(settings.calibration) if settings.calibration is not None else None
    grounder = LLMGrounder(
        client,
        _prompt_options(settings),
        shares_answers=not settings.is_each_object,
        shortlist=settings.shortlist,
        # A model in this process serves one prompt at a time; further workers would only delay an interrupt.
        workers=1 if is_local_model(settings.model) else settings.concurrency,
        samples=settings.samples,
        first_sample=settings.first_sample,
        examples=examples,
        pictures=pictures,
        scaling=scaling,
        progress=progress,
    )
    own = describe_settings(grounder.settings)
    if scaling is not None and scaling.grounder != own:
        raise GroundingError(
            f"{settings.calibration}: was fitted for other confidences ({scaling.grounder}); expected those of this "
            f"model and its options ({own}); fit a calibration on such runs with usd2kg eval calibrate"
        )
    return grounder


@contextmanager
def open_metered_client(settings: LLMSettings, reporting: Reporting | None = None) -> Iterator[MeteredClient]:
    """Open a client for prompts of any kind, with its connections and its cache.

    Raises:
        GroundingError: see `open_llm_grounder`.
    """
    with ExitStack() as stack:
        yield _open_metered_client(settings, stack, reporting)


def _prompt_options(settings: LLMSettings) -> PromptOptions:
    default = SAMPLING.temperature if settings.samples > 1 else 0.0
    is_by_concept = settings.strategy is Strategy.BY_CONCEPT
    per_prompt = settings.objects_per_prompt
    if per_prompt is None:
        per_prompt = CONCEPTS.concepts_per_prompt if is_by_concept else 1
    return PromptOptions(
        strategy=settings.strategy,
        is_tree=settings.is_tree or is_by_concept,
        objects_per_prompt=per_prompt,
        is_thinking=settings.is_thinking,
        has_more_evidence=settings.has_more_evidence,
        shuffle_seed=settings.shuffle_seed,
        has_candidates_first=settings.has_candidates_first,
        temperature=default if settings.temperature is None else settings.temperature,
    )


def _open_metered_client(
    settings: LLMSettings,
    stack: ExitStack,
    reporting: Reporting | None,
    spending: Spending | None = None,
    *,
    is_dry: bool = False,
) -> MeteredClient:
    if settings.is_batched and settings.is_refreshed:
        raise GroundingError(
            "--batch resumes from the cache, which --refresh ignores; expected one of the two: name another cache with "
            "--completions, or draw new samples with --first-sample"
        )
    tariff = _find_tariff(settings)
    budget = Budget(settings.token_budget, settings.budget)
    if is_dry:
        return MeteredClient(_OfflineClient(settings.model), tariff=tariff, budget=budget)
    path = settings.completions or default_cache_path()
    cache = stack.enter_context(CompletionCache(path, creates=not settings.is_replayed))
    client, traffic = _open_client(settings, stack)
    queue = (
        _open_queue(settings, client, cache, reporting) if settings.is_batched and not settings.is_replayed else None
    )
    return MeteredClient(
        client,
        cache=cache,
        is_refreshed=settings.is_refreshed,
        budget=budget,
        spending=spending,
        tariff=tariff,
        traffic=traffic,
        queue=queue,
    )


def _find_tariff(settings: LLMSettings) -> Tariff | None:
    if settings.price is None:
        return find_tariff(settings.model, is_batched=settings.is_batched)
    stated = parse_price(settings.price)
    return discount_batch(stated) if settings.is_batched else stated


def _open_queue(
    settings: LLMSettings, client: Client, cache: CompletionCache, reporting: Reporting | None
) -> BatchQueue:
    if not isinstance(client, HttpClient):
        raise GroundingError(f"model '{settings.model}': runs locally and has no batch jobs; leave out --batch")
    return BatchQueue(settings.model, JobJournal(cache), client.open_batch_service(), reporting or Reporting())


def _open_client(settings: LLMSettings, stack: ExitStack) -> tuple[Client, Traffic]:
    if settings.is_replayed:
        return _OfflineClient(settings.model), Traffic()
    if is_local_model(settings.model):
        return stack.enter_context(open_local(settings.model, threads=settings.threads)), Traffic()
    client = make_client(settings.model, requests_per_minute=settings.requests_per_minute)
    return stack.enter_context(client), client.traffic


def parse_llm_name(name: str) -> tuple[str, Strategy]:
    """Return model and strategy from a grounder name like `llm-C:google:gemini-2.5-flash`; `llm:MODEL` is strategy B.

    Raises:
        GroundingError: the name has another form.
    """
    kind, _, model = name.partition(":")
    letter = kind.removeprefix("llm").removeprefix("-") or Strategy.CONTEXT.value
    strategies = {strategy.value.lower(): strategy for strategy in Strategy}
    if letter.lower() not in strategies or not model:
        raise GroundingError(
            f"grounder {name!r} names no strategy and model; expected llm-A:MODEL, llm-B:MODEL, llm-C:MODEL, "
            "llm-auto:MODEL or llm-concept:MODEL, with a MODEL like google:gemini-2.5-flash, "
            "openai:NAME@http://localhost:8000/v1, gguf:FILE"
        )
    return model, strategies[letter.lower()]


def make_llm_grounder(name: str) -> LLMGrounder:
    """Return the grounder called `name` with the default cache, both closed when the grounder is garbage-collected.

    Raises:
        GroundingError: the name or model is unknown, a key is missing, or the cache cannot be opened.
    """
    model, strategy = parse_llm_name(name)
    stack = ExitStack()
    grounder = stack.enter_context(open_llm_grounder(LLMSettings(model, strategy)))
    weakref.finalize(grounder, stack.close)
    return grounder


@dataclass(frozen=True, slots=True)
class _OfflineClient(Client):
    """A client that cannot send requests, for dry runs and replay."""

    model: str

    def complete(self, request: Request) -> Completion:
        raise GroundingError(f"not asked: the cache has no completion of {self.model}; leave out --replay to ask it")
