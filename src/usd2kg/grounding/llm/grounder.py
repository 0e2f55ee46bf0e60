"""The grounder that asks a large language model."""

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from decimal import Decimal
from threading import Lock

from usd2kg.errors import GroundingError
from usd2kg.grounding.embedded.grounder import EmbeddedGrounder
from usd2kg.grounding.llm.answers import Answer, is_degenerate, parse_answers, repair_request
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.completion import Client, Completion, Finish, Request, Usage
from usd2kg.grounding.llm.prices import Tariff, format_price
from usd2kg.grounding.llm.prompts import Batch, PromptOptions, Strategy, build_requests
from usd2kg.grounding.llm.traffic import Traffic
from usd2kg.grounding.model import Prediction, Status
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.scene import ObjectView

__all__ = ["LLMGrounder", "RunReport", "distinct_views"]

_FAILURES_IN_A_ROW = 3
"""After so many without an answer between, the model is not asked again."""


@dataclass(slots=True)
class RunReport:
    """What a run cost and what went wrong; it grows while the run goes on."""

    objects: int = 0
    prompts: int = 0
    """Different prompts, repairs left out."""
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


class LLMGrounder:
    """Grounds by asking a model; what it has said once is not asked again."""

    name = "llm"
    is_calibrated = False

    def __init__(
        self,
        client: Client,
        options: PromptOptions,
        *,
        cache: CompletionCache | None = None,
        is_refreshed: bool = False,
        is_once_each: bool = True,
        shortlist: int | None = None,
        workers: int = 4,
        token_budget: int | None = None,
        tariff: Tariff | None = None,
        budget: Decimal | None = None,
        traffic: Traffic | None = None,
    ) -> None:
        """Make the grounder.

        Args:
            client: the model.
            options: strategy and form of the prompts.
            cache: where completions are kept; None for nowhere.
            is_refreshed: ask even for what is in the cache, and keep the new completion.
            is_once_each: ask once about objects whose prompts would differ in a number alone.
            shortlist: offer for each object only so many classes that the embedded grounder thinks of first, with
                those above them and the roots; None offers all.
            workers: prompts that are on their way at the same time.
            token_budget: input and output tokens after which nothing more is asked.
            tariff: what tokens cost; None where that is not known.
            budget: US dollars after which nothing more is asked. Prompts that are on their way then are paid, too.
            traffic: where the client counts its requests.

        Raises:
            GroundingError: there is a budget, but no tariff.
        """
        if budget is not None and tariff is None:
            raise GroundingError(
                f"model '{client.model}': its price is not known; expected one for --budget, "
                "state it with --price INPUT/OUTPUT in dollars per million tokens"
            )
        self._client, self._options, self._cache = client, options, cache
        self._is_refreshed, self._is_once_each, self._workers = is_refreshed, is_once_each, workers
        self._shortlist, self._token_budget = shortlist, token_budget
        self.tariff, self._budget = tariff, budget
        self._lock = Lock()
        self._failures = 0
        self.report = RunReport(price=None if tariff is None else Decimal(0), traffic=traffic or Traffic())

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that its answers depend on."""
        return {
            "model": self._client.model,
            "strategy": self._options.strategy.value,
            "classes": "tree" if self._options.is_tree else "flat",
            "objects_per_prompt": str(self._options.objects_per_prompt),
            "once_each": str(self._is_once_each).lower(),
            "thinking": str(self._options.is_thinking).lower(),
            "temperature": f"{self._options.temperature:g}",
            **({"shortlist": str(self._shortlist)} if self._shortlist is not None else {}),
            **({"shuffle": str(self._options.shuffle_seed)} if self._options.shuffle_seed is not None else {}),
        }

    def plan(self, views: Sequence[ObjectView], tbox: TBox) -> list[Batch]:
        """Return the prompts that `ground_views` would send, repairs left out."""
        asked = [views[indices[0]] for indices in self._groups(views)]
        offered = _shortlists(asked, tbox, self._shortlist) if self._shortlist is not None else None
        return build_requests(asked, tbox, self._options, offered)

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view)."""
        start = time.monotonic()
        groups = self._groups([view for _, view in views])
        batches = self.plan([view for _, view in views], tbox)
        self.report.objects += len(views)
        self.report.prompts += len(batches)
        found: dict[int, Prediction] = {}
        for batch, answers in zip(batches, self._answers(batches, tbox), strict=True):
            for index, answer in zip(batch.indices, answers, strict=True):
                for member in groups[index]:
                    found[member] = self._prediction(views[member][0], answer)
        self.report.seconds += time.monotonic() - start
        return [found[index] for index in range(len(views))]

    def _groups(self, views: Sequence[ObjectView]) -> list[list[int]]:
        return distinct_views(views, self._options.strategy) if self._is_once_each else [[i] for i in range(len(views))]

    def _answers(self, batches: list[Batch], tbox: TBox) -> Iterator[list[Answer]]:
        with ThreadPoolExecutor(max_workers=self._workers) as pool:
            pending = [pool.submit(self._ask, batch, tbox) for batch in batches]
            try:
                for future in pending:
                    yield future.result()
            except KeyboardInterrupt:
                for future in pending:
                    future.cancel()
                raise

    def _ask(self, batch: Batch, tbox: TBox) -> list[Answer]:
        try:
            completion = self._complete(batch.request)
        except GroundingError as error:
            with self._lock:
                self.report.failed += 1
            return [Answer(None, Status.FAILED, "", str(error)) for _ in batch.indices]
        answers = self._read(completion, batch, tbox)
        if any(answer.status is Status.UNREADABLE for answer in answers):
            return self._repair(batch, completion, answers, tbox)
        return answers

    def _repair(self, batch: Batch, completion: Completion, answers: list[Answer], tbox: TBox) -> list[Answer]:
        """Ask once more for what could not be read; what was right before stays."""
        try:
            second = self._complete(repair_request(batch, completion.text, answers))
        except GroundingError:
            return answers
        with self._lock:
            self.report.repairs += 1
        mended = self._read(second, batch, tbox)
        return [new if old.status is Status.UNREADABLE else old for old, new in zip(answers, mended, strict=True)]

    def _read(self, completion: Completion, batch: Batch, tbox: TBox) -> list[Answer]:
        answers = parse_answers(completion.text, batch, tbox, completion.tokens)
        if completion.finish is not Finish.STOP or is_degenerate(completion.text):
            with self._lock:
                self.report.degenerate += 1
        return answers

    def _complete(self, request: Request) -> Completion:
        known = None
        if self._cache is not None and not self._is_refreshed:
            known = self._cache.get(self._client.model, request)
        if known is not None:
            with self._lock:
                self.report.cached += 1
            return known
        self._check_going_on()
        try:
            completion = self._client.complete(request)
        except GroundingError:
            with self._lock:
                self._failures += 1
            raise
        with self._lock:
            self._failures = 0
            self.report.completions += 1
            self.report.usage += completion.usage
            if self.tariff is not None and self.report.price is not None:
                self.report.price += self.tariff(completion.usage)
        if self._cache is not None:
            self._cache.put(self._client.model, request, completion, replace=self._is_refreshed)
        return completion

    def _check_going_on(self) -> None:
        with self._lock:
            used = self.report.usage.input_tokens + self.report.usage.output_tokens
            paid, failures = self.report.price, self._failures
        if self._token_budget is not None and used >= self._token_budget:
            raise GroundingError(
                f"not asked: {used} tokens are used of a budget of {self._token_budget}; raise --token-budget"
            )
        if self._budget is not None and paid is not None and paid >= self._budget:
            raise GroundingError(
                f"not asked: {format_price(paid)} are spent of a budget of {format_price(self._budget)}; raise --budget"
            )
        if failures >= _FAILURES_IN_A_ROW:
            raise GroundingError(f"not asked: {failures} prompts in a row were not answered; see the first of them")

    def _prediction(self, path: str, answer: Answer) -> Prediction:
        is_known = answer.class_iri is not None and answer.logprob is not None
        return Prediction(
            prim_path=path,
            class_iri=answer.class_iri,
            confidence=round(math.exp(min(0.0, answer.logprob or 0.0)), 4) if is_known else None,
            status=answer.status,
            grounder=self.name,
            explanation=answer.problem or answer.reasoning or f"{self._client.model} says so",
            evidence=("name",) if self._options.strategy is Strategy.NAME_ONLY else (),
        )


def _shortlists(views: Sequence[ObjectView], tbox: TBox, most: int) -> list[list[ClassIRI]]:
    """Return for each view the classes that the embedded grounder thinks of first, all above them, and the roots."""
    first = EmbeddedGrounder().ground_views([("", view) for view in views], tbox)
    likely = [[candidate.class_iri for candidate in found.candidates[:most]] for found in first]
    return [sorted({*tbox.roots, *(up for iri in iris for up in tbox.closure(iri))}) for iris in likely]


def distinct_views(views: Sequence[ObjectView], strategy: Strategy) -> list[list[int]]:
    """Return the indices of views in groups that one answer serves: they differ in numbers and in where they stand.

    By strategy A only the name counts; by B and C also the names above and the size, to the centimetre. A masked view
    is always alone: that it looks like another may be the mask's doing.
    """
    groups: dict[object, list[int]] = {}
    for index, view in enumerate(views):
        key: object = index if view.is_masked else _signature(view, strategy)
        groups.setdefault(key, []).append(index)
    return list(groups.values())


def _signature(view: ObjectView, strategy: Strategy) -> object:
    bare = replace(view, name=_stem(view.name), position=None, siblings=(), company=None)
    if strategy is Strategy.NAME_ONLY:
        return bare.name
    size = tuple(round(side, 2) for side in sorted(view.own_size)) if view.own_size else None
    return bare.name, tuple(map(_stem, view.parents)), size, view.mass_kg, view.asset


def _stem(name: str) -> str:
    return name.rstrip("0123456789_")
