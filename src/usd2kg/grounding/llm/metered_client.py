"""MeteredClient: a client with a cache, a budget and a report of what was sent and spent."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from decimal import Decimal
from threading import Lock

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.answers import Defect
from usd2kg.grounding.llm.batch_jobs.queue import BatchQueue
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Client, Completion, Request, Usage
from usd2kg.grounding.llm.estimates import estimate_run, estimate_usage
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
    """Reason for the first failure among prompts that were sent; empty if there was none."""
    first_refusal: str = ""
    """Reason for the first prompt that was not sent, such as a spent budget; empty if all were sent."""
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

    @property
    def problem(self) -> str:
        """Why prompts have no completion; empty if all have one. Prompts may be unsent because others failed."""
        return self.first_failure or self.first_refusal


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
    reserved_tokens: int = 0
    """Estimated tokens of prompts in batch jobs that have not ended."""
    reserved_dollars: Decimal = Decimal(0)
    """Estimated price of these prompts."""
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)

    def add(self, tokens: int, dollars: Decimal) -> None:
        """Add the tokens and dollars of one completion."""
        with self._lock:
            self.tokens += tokens
            self.dollars += dollars

    def reserve(self, tokens: int, dollars: Decimal) -> None:
        """Add the estimated tokens and dollars of a prompt in a batch job; negative ones when the job has ended."""
        with self._lock:
            self.reserved_tokens += tokens
            self.reserved_dollars += dollars


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
        queue: BatchQueue | None = None,
    ) -> None:
        """Create a metered client.

        Args:
            client: the client of the model.
            cache: the cache of completions; None for none.
            is_refreshed: ignore cached completions and replace them.
            budget: None for no limits.
            spending: the spending of all clients that share the budget; None if this client has its own budget.
            tariff: the price of tokens, at batch rates if there is a queue; None if unknown.
            traffic: the counter of `client`.
            queue: submits uncached prompts as batch jobs; None to send each of them with `client`.

        Raises:
            GroundingError: the budget is in dollars, but there is no tariff.
        """
        self._budget = budget or Budget()
        if self._budget.dollars is not None and tariff is None:
            raise GroundingError(
                f"model '{client.model}': has no list price, which --budget requires; "
                "give one with --price INPUT/OUTPUT in dollars per million tokens"
            )
        self._client, self._cache, self._is_refreshed = client, cache, is_refreshed
        self._spending = spending or Spending()
        self._traffic = traffic or Traffic()
        self._queue = queue
        self._reserved = 0, Decimal(0)
        """Estimated tokens and dollars of the prompts in pending jobs."""
        self._refused: dict[str, str] = {}
        """Cache key of a prompt beyond the budget → reason."""
        self._fetched: set[str] = set()
        """Keys of completions from batch jobs of this run, reported as new although they are in the cache."""
        self._reported: set[str] = set()
        """The subset of `_fetched` that the report already includes."""
        self.is_planning = False
        """Whether prompts are only collected for a batch job; see `planning`."""
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
        """Reset the report except for the HTTP traffic; the spending towards the budget is kept."""
        with self.lock:
            self.report = self._empty_report()
            self._fetched -= self._reported
            self._reported.clear()

    @contextmanager
    def planning(self) -> Iterator[None]:
        """Defer uncached prompts instead of sending them, and discard the report of runs in this context."""
        before, self.report, self.is_planning = self.report, self._empty_report(), True
        try:
            yield
        finally:
            self.report, self.is_planning = before, False

    def submit_deferred(self) -> bool:
        """Submit the prompts deferred by `complete` as batch jobs, within the budget; return whether there are any.

        Raises:
            GroundingError: see `BatchQueue.submit`.
        """
        return self._queue is not None and self._queue.submit(self._refuse_beyond_budget, self._describe_estimate)

    def collect_deferred(self) -> None:
        """Wait for the submitted jobs and count their tokens towards the budget.

        Afterwards, `complete` returns their completions.

        Raises:
            KeyboardInterrupt: the user stops waiting.
        """
        assert self._queue is not None
        for key, completion in self._queue.collect().items():
            self._fetched.add(key)
            usage = completion.usage
            self._spending.add(usage.input_tokens + usage.output_tokens, self._price(usage))
        self._spending.reserve(-self._reserved[0], -self._reserved[1])
        self._reserved = 0, Decimal(0)

    def complete(self, request: Request) -> Completion:
        """Return the cached completion of a request, or else the model's.

        Raises:
            GroundingError: the request failed, the budget is spent, or too many prompts in a row have failed;
                `DeferredError` if the prompt is deferred to the next batch job.
        """
        cached = None
        if self._cache is not None and not self._is_refreshed:
            cached = self._cache.get(self.model, request)
        if cached is not None:
            self._count_cached(request, cached)
            return cached
        if self._queue is not None:
            if (problem := self._refused.get(request_key(self.model, request))) is not None:
                raise NotAskedError(problem)
            self._queue.defer(request)
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
        if self.is_planning:
            return
        key = request_key(self.model, request)
        with self.lock:
            is_counted, is_new = key in self._reported, key in self._fetched
            if is_new:
                self._reported.add(key)
        if is_new:
            # After a batch job, the run requests every prompt again: count each new completion once.
            if not is_counted:
                self._report_new(key, completion.usage)
            return
        with self.lock:
            self.report.cached += 1
            self.report.cached_usage += completion.usage
            self.report.keys.add(key)
            if self.tariff is not None and self.report.cached_price is not None:
                self.report.cached_price += self.tariff(completion.usage)

    def _count(self, request: Request, completion: Completion) -> None:
        usage = completion.usage
        self._spending.add(usage.input_tokens + usage.output_tokens, self._price(usage))
        with self.lock:
            self._consecutive_failures = 0
        self._report_new(request_key(self.model, request), usage)

    def _report_new(self, key: str, usage: Usage) -> None:
        with self.lock:
            self.report.completions += 1
            self.report.usage += usage
            self.report.keys.add(key)
            if self.report.price is not None:
                self.report.price += self._price(usage)

    def _price(self, usage: Usage) -> Decimal:
        return Decimal(0) if self.tariff is None else self.tariff(usage)

    def _refuse_beyond_budget(self, running: Mapping[str, Request], new: Mapping[str, Request]) -> set[str]:
        """Reserve the estimated price of prompts in batch jobs; return the keys of new prompts beyond it."""
        for key, request in (*running.items(), *new.items()):
            usage = estimate_usage(request)
            tokens, dollars = usage.input_tokens + usage.output_tokens, self._price(usage)
            problem = self._exceeds_budget(tokens, dollars) if key in new else None
            if problem is not None:
                self._refused[key] = problem
                continue
            self._spending.reserve(tokens, dollars)
            self._reserved = self._reserved[0] + tokens, self._reserved[1] + dollars
        return self._refused.keys() & new.keys()

    def _describe_estimate(self, requests: Sequence[Request]) -> str:
        usage, price = estimate_run(requests, self.tariff)
        return f"about {usage.input_tokens:,} input and {usage.output_tokens:,} output tokens, {price}"

    def _exceeds_budget(self, tokens: int, dollars: Decimal) -> str | None:
        """Return why a prompt with this estimate exceeds the budget; None if it does not."""
        used = self._spending.tokens + self._spending.reserved_tokens + tokens
        spent = self._spending.dollars + self._spending.reserved_dollars + dollars
        if self._budget.tokens is not None and used > self._budget.tokens:
            return f"not asked: about {used} tokens exceed the budget of {self._budget.tokens}; raise --token-budget"
        if self._budget.dollars is not None and spent > self._budget.dollars:
            budget = format_price(self._budget.dollars)
            return f"not asked: about {format_price(spent)} exceed the budget of {budget}; raise --budget"
        return None

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
            raise NotAskedError(f"not asked: {failures} consecutive prompts failed; see the first failure")
