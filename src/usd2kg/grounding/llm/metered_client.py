"""Asking a model within limits: what it has said once is not asked again, and everything is counted."""

from dataclasses import dataclass, field
from decimal import Decimal
from threading import Lock

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Client, Completion, Request, Usage
from usd2kg.grounding.llm.prices import Tariff, format_price
from usd2kg.grounding.llm.traffic import Traffic

__all__ = ["Budget", "MeteredClient", "RunReport"]

_FAILURES_IN_A_ROW = 3
"""After so many without an answer between, the model is not asked again."""


@dataclass(slots=True)
class RunReport:
    """What a run cost and what went wrong; it grows while the run goes on."""

    objects: int = 0
    prompts: int = 0
    """Different prompts, repairs and further samples left out."""
    completions: int = 0
    """Completions that the model was asked for."""
    cached: int = 0
    """Completions that were known already."""
    repairs: int = 0
    degenerate: int = 0
    """Completions that looped, said nothing or ran into the limit."""
    failed: int = 0
    """Prompts that nobody answered."""
    usage: Usage = field(default_factory=Usage)
    """Tokens of what was asked for; what is cached costs nothing."""
    price: Decimal | None = None
    """US dollars for these tokens, repairs among them; None where the model's price is not known.

    What a server may ask for requests that failed is not in it.
    """
    traffic: Traffic = field(default_factory=Traffic)
    """Requests and pauses that it took; none where the model is not asked over a network."""
    seconds: float = 0.0
    is_interrupted: bool = False
    """Whether the user stopped it before all was asked."""


@dataclass(frozen=True, slots=True)
class Budget:
    """When to stop asking. Prompts that are on their way then are paid, too."""

    tokens: int | None = None
    """Input and output tokens."""
    dollars: Decimal | None = None


class MeteredClient:
    """Asks one model, from any number of threads."""

    def __init__(
        self,
        client: Client,
        *,
        cache: CompletionCache | None = None,
        is_refreshed: bool = False,
        limits: Budget | None = None,
        tariff: Tariff | None = None,
        traffic: Traffic | None = None,
    ) -> None:
        """Make the asker.

        Args:
            client: the model.
            cache: where completions are kept; None for nowhere.
            is_refreshed: ask even for what is in the cache, and keep the new completion.
            limits: when to stop; None for never.
            tariff: what tokens cost; None where that is not known.
            traffic: where the client counts its requests.

        Raises:
            GroundingError: there is a limit in dollars, but no tariff.
        """
        self._limits = limits or Budget()
        if self._limits.dollars is not None and tariff is None:
            raise GroundingError(
                f"model '{client.model}': its price is not known; expected one for --budget, "
                "state it with --price INPUT/OUTPUT in dollars per million tokens"
            )
        self._client, self._cache, self._is_refreshed = client, cache, is_refreshed
        self.model = client.model
        self.tariff = tariff
        self._failures = 0
        self.lock = Lock()
        """Held while `report` changes."""
        self.report = RunReport(price=None if tariff is None else Decimal(0), traffic=traffic or Traffic())

    def complete(self, request: Request) -> Completion:
        """Return the model's completion, the kept one if there is one.

        Raises:
            GroundingError: the model cannot be asked, or a limit is reached.
        """
        known = None
        if self._cache is not None and not self._is_refreshed:
            known = self._cache.get(self.model, request)
        if known is not None:
            with self.lock:
                self.report.cached += 1
            return known
        self._check_going_on()
        try:
            completion = self._client.complete(request)
        except GroundingError:
            with self.lock:
                self._failures += 1
            raise
        self._count(completion)
        if self._cache is not None:
            self._cache.put(self.model, request, completion, replace=self._is_refreshed)
        return completion

    def _count(self, completion: Completion) -> None:
        with self.lock:
            self._failures = 0
            self.report.completions += 1
            self.report.usage += completion.usage
            if self.tariff is not None and self.report.price is not None:
                self.report.price += self.tariff(completion.usage)

    def _check_going_on(self) -> None:
        with self.lock:
            used = self.report.usage.input_tokens + self.report.usage.output_tokens
            paid, failures = self.report.price, self._failures
        max_tokens, most_dollars = self._limits.tokens, self._limits.dollars
        if max_tokens is not None and used >= max_tokens:
            raise GroundingError(f"not asked: {used} tokens are used of a budget of {max_tokens}; raise --token-budget")
        if most_dollars is not None and paid is not None and paid >= most_dollars:
            raise GroundingError(
                f"not asked: {format_price(paid)} are spent of a budget of {format_price(most_dollars)}; raise --budget"
            )
        if failures >= _FAILURES_IN_A_ROW:
            raise GroundingError(f"not asked: {failures} prompts in a row were not answered; see the first of them")
