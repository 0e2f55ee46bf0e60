"""The grounder that asks a large language model."""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import replace

from usd2kg.errors import GroundingError
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.llm.answers import Answer, is_degenerate, parse_answers, repair_request
from usd2kg.grounding.llm.completion import Completion, Finish
from usd2kg.grounding.llm.grouping import group_similar_views, make_shortlists
from usd2kg.grounding.llm.metered_client import MeteredClient, RunReport
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompts import Batch, Example, build_requests
from usd2kg.grounding.llm.voting import ScoredAnswer, vote
from usd2kg.grounding.model import Prediction, Status
from usd2kg.grounding.platt_scaling import PlattScaling
from usd2kg.ontology import TBox

__all__ = ["LLMGrounder"]

_INTERRUPTED = Answer(None, Status.FAILED, "", "not asked: the run was interrupted; the same command goes on with it")


def _say_nothing(done: int, count: int) -> None:
    """Tell nobody how far a run is."""


class LLMGrounder:
    """Grounds by asking a model."""

    name = "llm"

    def __init__(
        self,
        asker: MeteredClient,
        options: PromptOptions,
        *,
        shares_answers: bool = True,
        shortlist: int | None = None,
        workers: int = 4,
        samples: int = 1,
        first_sample: int = 0,
        examples: Sequence[Example] = (),
        picture: Callable[[str], bytes | None] | None = None,
        progress: Callable[[int, int], None] = _say_nothing,
        scaling: PlattScaling | None = None,
    ) -> None:
        """Make the grounder.

        Args:
            asker: who asks the model.
            options: strategy and form of the prompts.
            shares_answers: ask once about objects whose prompts would differ in a number alone.
            shortlist: offer for each object only so many classes that the lexical grounder thinks of first, with
                those above them and the roots; None offers all.
            workers: prompts that are on their way at the same time.
            samples: completions that are asked for each prompt; the class that most of them name is taken.
            first_sample: the number of the first; repeated runs with other numbers are not served from the cache.
            examples: objects that a person has named, shown in each prompt.
            picture: gives the PNG picture of a prim, or None where there is none; pictures are sent if it is given.
            progress: told the number of objects that are done and of all, whenever some more are done.
            scaling: makes probabilities of the confidences; None leaves them as they are.

        Raises:
            GroundingError: there are no samples, or several that would all be the same.
        """
        if samples < 1:
            raise GroundingError(f"{samples} samples of each prompt; expected 1 or more")
        if samples > 1 and options.temperature == 0:
            raise GroundingError(f"{samples} samples at temperature 0 are all the same; expected a temperature above 0")
        self._asker, self._options = asker, options
        self._is_once_each, self._shortlist, self._workers = shares_answers, shortlist, workers
        self._samples, self._first_sample = samples, first_sample
        self._examples, self._picture, self._progress = examples, picture, progress
        self.tariff = asker.tariff
        self._scaling = scaling
        self.is_calibrated = scaling is not None

    @property
    def report(self) -> RunReport:
        """What the run cost so far."""
        return self._asker.report

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that its answers depend on."""
        return {
            "model": self._asker.model,
            "strategy": self._options.strategy.value,
            "classes": "tree" if self._options.is_tree else "flat",
            "objects_per_prompt": str(self._options.objects_per_prompt),
            "once_each": str(self._is_once_each).lower(),
            "thinking": str(self._options.is_thinking).lower(),
            "temperature": f"{self._options.temperature:g}",
            **({"shortlist": str(self._shortlist)} if self._shortlist is not None else {}),
            **({"samples": str(self._samples)} if self._samples > 1 else {}),
            **({"first_sample": str(self._first_sample)} if self._first_sample else {}),
            **({"examples": str(len(self._examples))} if self._examples else {}),
            **({"pictures": "true"} if self._picture is not None else {}),
            **({"shuffle": str(self._options.shuffle_seed)} if self._options.shuffle_seed is not None else {}),
        }

    def plan(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Batch]:
        """Return the prompts that `ground_views` would send once for each sample, repairs left out."""
        asked = [views[indices[0]] for indices in self._groups([view for _, view in views])]
        shown = [view for _, view in asked]
        offered = make_shortlists(shown, tbox, self._shortlist) if self._shortlist is not None else None
        pictures = self._pictures(asked)
        return build_requests(shown, tbox, self._options, offered, examples=self._examples, pictures=pictures)

    def _groups(self, views: Sequence[ObjectView]) -> list[list[int]]:
        return group_similar_views(views, self._options) if self._is_once_each else [[i] for i in range(len(views))]

    def _pictures(self, asked: Sequence[tuple[str, ObjectView]]) -> dict[int, bytes]:
        if self._picture is None:
            return {}
        drawn = {index: self._picture(path) for index, (path, _) in enumerate(asked)}
        return {index: picture for index, picture in drawn.items() if picture is not None}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view); where the user interrupts, those that are there."""
        start = time.monotonic()
        groups = self._groups([view for _, view in views])
        batches = self.plan(views, tbox)
        self.report.objects += len(views)
        self.report.prompts += len(batches)
        found: dict[int, Prediction] = {}
        for batch, replies in self._replies(batches, tbox):
            for index, reply in zip(batch.indices, replies, strict=True):
                for member in groups[index]:
                    found[member] = self._prediction(views[member][0], reply)
            self._progress(len(found), len(views))
        self.report.seconds += time.monotonic() - start
        return [found[index] for index in range(len(views))]

    def _replies(self, batches: list[Batch], tbox: TBox) -> Iterator[tuple[Batch, list[ScoredAnswer]]]:
        """Yield the batches as they are answered; after an interruption nothing more is asked."""
        left = dict(enumerate(batches))
        with ThreadPoolExecutor(max_workers=self._workers) as pool:
            pending = {pool.submit(self._ask, batch, tbox): index for index, batch in left.items()}
            try:
                for future in as_completed(pending):
                    yield left.pop(pending[future]), future.result()
            except KeyboardInterrupt:
                self.report.is_interrupted = True
                pool.shutdown(wait=False, cancel_futures=True)
        # What was on its way when the user interrupted is there by now.
        for future, index in pending.items():
            if index in left:
                batch = left[index]
                yield (
                    batch,
                    [ScoredAnswer(_INTERRUPTED, None)] * len(batch.indices) if future.cancelled() else future.result(),
                )

    def _ask(self, batch: Batch, tbox: TBox) -> list[ScoredAnswer]:
        numbers = range(self._first_sample, self._first_sample + self._samples)
        samples = [self._sample(batch, number, tbox) for number in numbers]
        return [vote([_reply(answer) for answer in answers]) for answers in zip(*samples, strict=True)]

    def _sample(self, batch: Batch, number: int, tbox: TBox) -> list[Answer]:
        batch = replace(batch, request=replace(batch.request, sample=number))
        try:
            completion = self._asker.complete(batch.request)
        except GroundingError as error:
            with self._asker.lock:
                self.report.failed += 1
            return [Answer(None, Status.FAILED, "", str(error)) for _ in batch.indices]
        answers = self._read(completion, batch, tbox)
        if any(answer.status is Status.UNREADABLE for answer in answers):
            return self._repair(batch, completion, answers, tbox)
        return answers

    def _repair(self, batch: Batch, completion: Completion, answers: list[Answer], tbox: TBox) -> list[Answer]:
        """Ask once more for what could not be read; what was right before stays."""
        try:
            second = self._asker.complete(repair_request(batch, completion.text, answers))
        except GroundingError:
            return answers
        with self._asker.lock:
            self.report.repairs += 1
        mended = self._read(second, batch, tbox)
        return [new if old.status is Status.UNREADABLE else old for old, new in zip(answers, mended, strict=True)]

    def _read(self, completion: Completion, batch: Batch, tbox: TBox) -> list[Answer]:
        answers = parse_answers(completion.text, batch, tbox, completion.tokens)
        if completion.finish is not Finish.STOP or is_degenerate(completion.text):
            with self._asker.lock:
                self.report.degenerate += 1
        return answers

    def _prediction(self, path: str, reply: ScoredAnswer) -> Prediction:
        answer = reply.answer
        return Prediction(
            prim_path=path,
            class_iri=answer.class_iri,
            confidence=self._scaled(reply.confidence),
            status=answer.status,
            grounder=self.name,
            explanation=answer.problem or answer.reasoning or f"{self._asker.model} says so",
            evidence=("name",) if self._options.strategy is Strategy.NAME_ONLY else (),
            candidates=reply.candidates,
        )

    def _scaled(self, confidence: float | None) -> float | None:
        return confidence if confidence is None or self._scaling is None else self._scaling(confidence)


def _reply(answer: Answer) -> ScoredAnswer:
    """Return a single answer, as sure as the tokens of its class are likely."""
    is_known = answer.class_iri is not None and answer.logprob is not None
    return ScoredAnswer(answer, round(math.exp(min(0.0, answer.logprob or 0.0)), 4) if is_known else None)
