"""MeteredClient: a client with a cache, a budget and a report of what was sent and spent."""

from collections import Counter
from dataclasses import dataclass, field
from decimal import Decimal
from threading import Lock

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.answers import Defect
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Client, Completion, Request, Usage
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.prices import Tariff, format_price
from usd2kg.grounding.llm.serialization import request_key
from usd2kg.grounding.llm.traffic import Traffic

__all__ = ["Budget", "MeteredClient", "NotAskedError", "RunReport", "Spending"]


@dataclass(slots=True)
class RunReport:
    """Counts and cost of a run, updated while it is in progress."""

    objects: int = 0
    prompts: int = 0
    """Distinct prompts, without repairs and repeated samples."""
    completions: int = 0
    """Completions received from the model."""
    cached: int = 0
    """Completions served from the cache."""
    repairs: int = 0
    degenerate: int = 0
    """Completions that are empty, repeat themselves or were truncated."""
    failed: int = 0
    """Prompts without a completion."""
    first_failure: str = ""
    """Why the model failed on the first of them; empty if it failed on none of those that it was asked."""
    usage: Usage = field(default_factory=Usage)
    """Tokens of the completions received from the model."""
    price: Decimal | None = None
    """US dollars for `usage`; None if the price of the model is unknown.

    Charges for failed requests are not included.
    """
    cached_usage: Usage = field(default_factory=Usage)
    """Tokens of the completions served from the cache."""
    cached_price: Decimal | None = None
    """US dollars that `cached_usage` cost when it was new; None if the price of the model is unknown."""
    defects: Counter[Defect] = field(default_factory=Counter)
    """Objects without a class, by the defect of the last answer about them."""
    keys: set[str] = field(default_factory=set)
    """Cache keys of all completions, new and cached."""
    traffic: Traffic = field(default_factory=Traffic)
    """HTTP requests and waits; zero for models in this process."""
    seconds: float = 0.0
    is_interrupted: bool = False
    """Whether the user interrupted the run."""


@dataclass(frozen=True, slots=True)
class Budget:
    """The spending after which no more prompts are sent. Prompts in flight are completed and paid."""

    tokens: int | None = None
    """Input and output tokens; None for no limit."""
    dollars: Decimal | None = None
    """US dollars; None for no limit."""


@dataclass(slots=True)
class Spending:
    """What the clients that share a budget have spent. Thread-safe."""

    tokens: int = 0
    """Input and output tokens."""
    dollars: Decimal = Decimal(0)
    """US dollars, of models with a known price."""
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)

    def add(self, tokens: int, dollars: Decimal) -> None:
        """Add the tokens and dollars of one completion."""
        with self._lock:
            self.tokens += tokens
            self.dollars += dollars


class NotAskedError(GroundingError):
    """A prompt was not sent: the budget is spent, or too many prompts failed in a row."""


class MeteredClient:
    """Completes prompts from the cache, or else from the model within the budget. Thread-safe."""

    def __init__(
        self,
        client: Client,
        *,
        cache: CompletionCache | None = None,
        is_refreshed: bool = False,
        budget: Budget | None = None,
        spending: Spending | None = None,
        tariff: Tariff | None = None,
        traffic: Traffic | None = None,
    ) -> None:
        """Create a metered client.

        Args:
            client: the client of the model.
            cache: the cache of completions; None for none.
            is_refreshed: ignore cached completions and replace them.
            budget: None for no limits.
            spending: what other clients with the same budget have spent, and add to; None for a budget of its own.
            tariff: the price of tokens; None if unknown.
            traffic: the counter of `client`.

        Raises:
            GroundingError: the budget is in dollars, but there is no tariff.
        """
        self._budget = budget or Budget()
        if self._budget.dollars is not None and tariff is None:
            raise GroundingError(
                f"model '{client.model}': its price is not known; expected one for --budget, "
                "state it with --price INPUT/OUTPUT in dollars per million tokens"
            )
        self._client, self._cache, self._is_refreshed = client, cache, is_refreshed
        self._spending = spending or Spending()
        self._traffic = traffic or Traffic()
        self.model = client.model
        self.tariff = tariff
        self._consecutive_failures = 0
        self.lock = Lock()
        """Held while `report` changes."""
        self.report = self._empty_report()

    def _empty_report(self) -> RunReport:
        nothing = None if self.tariff is None else Decimal(0)
        return RunReport(price=nothing, cached_price=nothing, traffic=self._traffic)

    def restart_report(self) -> None:
        """Replace the report by an empty one, except for the HTTP traffic; the budget counts on."""
        with self.lock:
            self.report = self._empty_report()

    def complete(self, request: Request) -> Completion:
        """Return the cached completion of a request, or else the model's.

        Raises:
            GroundingError: the request failed, the budget is spent, or too many prompts in a row have failed.
        """
        cached = None
        if self._cache is not None and not self._is_refreshed:
            cached = self._cache.get(self.model, request)
        if cached is not None:
            self._count_cached(request, cached)
            return cached
        self._check_budget()
        try:
            completion = self._client.complete(request)
        except GroundingError:
            with self.lock:
                self._consecutive_failures += 1
            raise
        self._count(request, completion)
        if self._cache is not None:
            self._cache.put(self.model, request, completion, replace=self._is_refreshed)
        return completion

    def _count_cached(self, request: Request, completion: Completion) -> None:
        with self.lock:
            self.report.cached += 1
            self.report.cached_usage += completion.usage
            self.report.keys.add(request_key(self.model, request))
            if self.tariff is not None and self.report.cached_price is not None:
                self.report.cached_price += self.tariff(completion.usage)

    def _count(self, request: Request, completion: Completion) -> None:
        usage = completion.usage
        price = Decimal(0) if self.tariff is None else self.tariff(usage)
        self._spending.add(usage.input_tokens + usage.output_tokens, price)
        with self.lock:
            self._consecutive_failures = 0
            self.report.completions += 1
            self.report.usage += usage
            self.report.keys.add(request_key(self.model, request))
            if self.report.price is not None:
                self.report.price += price

    def _check_budget(self) -> None:
        failures = self._consecutive_failures
        used, spent = self._spending.tokens, self._spending.dollars
        tokens, dollars = self._budget.tokens, self._budget.dollars
        if tokens is not None and used >= tokens:
            raise NotAskedError(f"not asked: {used} tokens are used of a budget of {tokens}; raise --token-budget")
        if dollars is not None and spent >= dollars:
            raise NotAskedError(
                f"not asked: {format_price(spent)} are spent of a budget of {format_price(dollars)}; raise --budget"
            )
        if failures >= LIMITS.max_consecutive_failures:
            raise NotAskedError(f"not asked: {failures} prompts in a row failed; see the first of them")
