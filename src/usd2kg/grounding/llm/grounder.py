"""LLMGrounder: grounds objects by prompting a large language model."""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import AbstractContextManager
from copy import copy
from dataclasses import dataclass, replace
from typing import NamedTuple

from usd2kg.errors import GroundingError
from usd2kg.grounding.context.views import ObjectView
from usd2kg.grounding.lexical.alignment.alignment_rows import format_rows
from usd2kg.grounding.lexical.concepts.taxonomy import load_taxonomy
from usd2kg.grounding.llm.answers import Defect, ParsedAnswer, parse_answers, repair_request
from usd2kg.grounding.llm.batch_jobs.queue import DeferredError
from usd2kg.grounding.llm.class_lists import name_classes
from usd2kg.grounding.llm.completion import Completion, Finish
from usd2kg.grounding.llm.concept_alignment import ConceptAnswer, rows_of_answers
from usd2kg.grounding.llm.concept_groups import ConceptGroup, group_by_concept
from usd2kg.grounding.llm.concept_rows import describe_group
from usd2kg.grounding.llm.degeneration import is_degenerate
from usd2kg.grounding.llm.grouping import group_similar_views, make_shortlists
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.metered_client import MeteredClient, NotAskedError, RunReport
from usd2kg.grounding.llm.prompt_options import PromptOptions, Strategy
from usd2kg.grounding.llm.prompts import Batch, Example, ObjectPictures, build_requests
from usd2kg.grounding.llm.voting import ScoredAnswer, vote
from usd2kg.grounding.model import Prediction, Status
from usd2kg.grounding.platt_scaling import PlattScaling
from usd2kg.ontology import TBox

__all__ = ["LLMGrounder"]

_INTERRUPTED = ParsedAnswer(
    None, Status.FAILED, "", "not asked: the run was interrupted; run the same command to resume"
)
_DEFERRED = ParsedAnswer(None, Status.FAILED, "", "not asked: deferred to a batch job")


class _Plan(NamedTuple):
    """The prompts about some views."""

    groups: list[list[int]]
    """The indices of the views that share each answer."""
    batches: list[Batch]
    """Requests about `groups`, by index."""
    concepts: list[ConceptGroup] | None
    """The same groups with their concepts; None unless the strategy is `BY_CONCEPT`."""


@dataclass(slots=True)
class _Sample:
    """The answers of one sample of a prompt, with their counts for the report."""

    answers: list[ParsedAnswer]
    repairs: int = 0
    degenerate: int = 0
    failure: GroundingError | None = None


class LLMGrounder:
    """Grounds objects by prompting a model, with a repair prompt for unreadable answers."""

    name = "llm"

    def __init__(
        self,
        client: MeteredClient,
        options: PromptOptions,
        *,
        shares_answers: bool = True,
        shortlist: int | None = None,
        workers: int = LIMITS.concurrency,
        samples: int = 1,
        first_sample: int = 0,
        examples: Sequence[Example] = (),
        pictures: Callable[[str], ObjectPictures | None] | None = None,
        progress: Callable[[int, int], None] | None = None,
        scaling: PlattScaling | None = None,
    ) -> None:
        """Create a grounder.

        Args:
            client: the client of the model.
            options: strategy and format of the prompts.
            shares_answers: prompt once for objects that `group_similar_views` groups; no effect on `BY_CONCEPT`, which
                always asks about the groups of `group_by_concept`.
            shortlist: number of candidates of the lexical grounder to offer for each object, with their superclasses
                and the roots; None offers all classes.
            workers: prompts in flight at the same time.
            samples: completions per prompt; the class that most of them name is chosen.
            first_sample: number of the first sample; other numbers are not served from the cache of earlier ones.
            examples: objects with known classes, shown in each prompt.
            pictures: returns the pictures of a prim, or None if it has none; None sends no pictures.
            progress: called with the number of objects that are done and the total, after each prompt.
            scaling: converts confidences to probabilities; None leaves them unchanged.

        Raises:
            GroundingError: `samples` is below 1, or above 1 at temperature 0; or candidates are to be listed first,
                but all classes are offered.
        """
        if samples < 1:
            raise GroundingError(f"{samples} samples of each prompt; expected 1 or more")
        if samples > 1 and options.temperature == 0:
            raise GroundingError(f"{samples} samples at temperature 0 are all the same; expected a temperature above 0")
        if options.has_candidates_first and shortlist is None:
            raise GroundingError(
                "all classes are offered and no candidates; expected --shortlist K with --candidates-first"
            )
        self._client, self._options = client, options
        self._shares_answers, self._shortlist, self._workers = shares_answers, shortlist, workers
        self._samples, self._first_sample = samples, first_sample
        self._examples, self._pictures_of, self._progress = examples, pictures, progress
        self.tariff = client.tariff
        self._scaling = scaling
        self.concept_answers: list[ConceptAnswer] = []
        """The model's answers about groups of objects that share a concept; empty for other strategies."""
        self.is_calibrated = scaling is not None

    @property
    def _is_by_concept(self) -> bool:
        return self._options.strategy is Strategy.BY_CONCEPT

    @property
    def report(self) -> RunReport:
        """Counts and cost of the run so far."""
        return self._client.report

    def restart_report(self) -> None:
        """Reset the counts; grounders with the same client share its report."""
        self._client.restart_report()

    def planning(self) -> AbstractContextManager[None]:
        """Return a context in which `ground_views` defers uncached prompts to batch jobs."""
        return self._client.planning()

    def submit_deferred(self) -> bool:
        """Submit the deferred prompts as batch jobs; return whether there are any."""
        return self._client.submit_deferred()

    def collect_deferred(self) -> None:
        """Wait for the submitted batch jobs."""
        self._client.collect_deferred()

    def repeated(self, repeat: int) -> "LLMGrounder":
        """Return a grounder with the same client that draws the samples of a repeat; the first, 1, is this one.

        Raises:
            GroundingError: there is nothing to draw, since all samples are the same.
        """
        if repeat == 1:
            return self
        if self._options.temperature == 0:
            raise GroundingError(
                f"repeat {repeat} of {self._client.model} at temperature 0 has the answers of the first; expected a "
                "--temperature above 0, or one repeat"
            )
        other = copy(self)
        other._first_sample += (repeat - 1) * self._samples
        return other

    @property
    def settings(self) -> Mapping[str, str]:
        """The settings that affect its predictions."""
        return {
            "model": self._client.model,
            "strategy": self._options.strategy.value,
            "classes": "tree" if self._options.is_tree else "flat",
            "objects_per_prompt": str(self._options.objects_per_prompt),
            "once_each": str(self._shares_answers).lower(),
            "thinking": str(self._options.is_thinking).lower(),
            "temperature": f"{self._options.temperature:g}",
            **({"shortlist": str(self._shortlist)} if self._shortlist is not None else {}),
            **({"order": "candidates first"} if self._options.has_candidates_first else {}),
            **({"samples": str(self._samples)} if self._samples > 1 else {}),
            **({"first_sample": str(self._first_sample)} if self._first_sample else {}),
            **({"examples": str(len(self._examples))} if self._examples else {}),
            **({"pictures": "true"} if self._pictures_of is not None else {}),
            **({"calibration": self._scaling.formula} if self._scaling is not None else {}),
            **({"shuffle": str(self._options.shuffle_seed)} if self._options.shuffle_seed is not None else {}),
        }

    def format_alignment(self, tbox: TBox) -> tuple[str, int, int]:
        """Return the answers about concepts as an alignment file, with the numbers of rows and of omitted subjects.

        The rows change the alignment that is built; see `rows_of_answers` for the omitted subjects.
        """
        rows, left_out = rows_of_answers(self.concept_answers, self._client.model, load_taxonomy())
        return format_rows(rows, tbox), len(rows), left_out

    def plan(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Batch]:
        """Return the prompts that `ground_views` would send for each sample, without repairs."""
        return self._plan(views, tbox).batches

    def _plan(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> _Plan:
        everything = [view for _, view in views]
        rows = concepts = None
        if self._is_by_concept:
            concepts = group_by_concept(everything, tbox, has_more_evidence=self._options.has_more_evidence)
            names = name_classes(tbox)
            rows = [describe_group(group, everything, names, self._options) for group in concepts]
            groups = [list(group.members) for group in concepts]
        else:
            groups = self._groups(everything)
        representatives = [views[indices[0]] for indices in groups]
        shown = [view for _, view in representatives]
        batches = build_requests(
            shown,
            tbox,
            self._options,
            make_shortlists(shown, tbox, self._shortlist) if self._shortlist is not None else None,
            examples=self._examples,
            pictures=self._pictures(representatives),
            rows=rows,
        )
        return _Plan(groups, batches, concepts)

    def _groups(self, views: Sequence[ObjectView]) -> list[list[int]]:
        return group_similar_views(views, self._options) if self._shares_answers else [[i] for i in range(len(views))]

    def _pictures(self, views: Sequence[tuple[str, ObjectView]]) -> dict[int, ObjectPictures]:
        if self._pictures_of is None:
            return {}
        pictures = ((index, self._pictures_of(path)) for index, (path, _) in enumerate(views))
        return {index: pair for index, pair in pictures if pair is not None}

    def ground_views(self, views: Sequence[tuple[str, ObjectView]], tbox: TBox) -> list[Prediction]:
        """Return one prediction for each (prim path, view); after an interrupt, the remaining ones are failures."""
        start = time.monotonic()
        groups, batches, concepts = self._plan(views, tbox)
        self.report.objects += len(views)
        self.report.prompts += len(batches)
        predictions: dict[int, Prediction] = {}
        for batch, answers in self._run_in_rounds(batches, tbox):
            for index, answer in zip(batch.indices, answers, strict=True):
                if answer.answer.defect is not None:
                    self.report.defects[answer.answer.defect] += len(groups[index])
                for member in groups[index]:
                    predictions[member] = self._predict(views[member][0], answer, len(groups[index]))
                if concepts is not None and answer.answer.class_iri is not None:
                    self.concept_answers.append(ConceptAnswer(concepts[index], answer.answer.class_iri))
            if self._progress is not None:
                self._progress(len(predictions), len(views))
        self.report.seconds += time.monotonic() - start
        return [predictions[index] for index in range(len(views))]

    def _run_in_rounds(self, batches: list[Batch], tbox: TBox) -> Iterator[tuple[Batch, list[ScoredAnswer]]]:
        """Yield the batches with their answers; after each round, batch jobs complete the deferred prompts.

        Repair prompts, which depend on answers, are deferred to a second round.
        """
        left = batches
        while left:
            deferred = []
            for batch, answers in self._run(left, tbox):
                if answers is None:
                    deferred.append(batch)
                else:
                    yield batch, answers
            left = deferred
            if left and (self._client.is_planning or not self._fetch_deferred()):
                answer = _DEFERRED if self._client.is_planning else _INTERRUPTED
                yield from ((batch, [ScoredAnswer(answer, None)] * len(batch.indices)) for batch in left)
                return

    def _fetch_deferred(self) -> bool:
        """Complete the deferred prompts by batch jobs; return False if the user interrupts the wait."""
        if self.report.is_interrupted:
            return False
        try:
            self._client.submit_deferred()
            self._client.collect_deferred()
        except KeyboardInterrupt:
            self.report.is_interrupted = True
        return not self.report.is_interrupted

    def _run(self, batches: list[Batch], tbox: TBox) -> Iterator[tuple[Batch, list[ScoredAnswer] | None]]:
        """Yield the batches with their answers as they complete; an interrupt cancels the pending ones.

        The answers are None if a prompt is deferred.
        """
        left = dict(enumerate(batches))
        with ThreadPoolExecutor(max_workers=self._workers) as pool:
            pending = {pool.submit(self._ask, batch, tbox): index for index, batch in left.items()}
            try:
                for future in as_completed(pending):
                    yield left.pop(pending[future]), future.result()
            except KeyboardInterrupt:
                self.report.is_interrupted = True
                pool.shutdown(wait=False, cancel_futures=True)
        # Prompts that were in flight at the interrupt have completed by now.
        for future, index in pending.items():
            if index in left:
                batch = left[index]
                interrupted = [ScoredAnswer(_INTERRUPTED, None)] * len(batch.indices)
                yield batch, interrupted if future.cancelled() else future.result()

    def _ask(self, batch: Batch, tbox: TBox) -> list[ScoredAnswer] | None:
        numbers = range(self._first_sample, self._first_sample + self._samples)
        samples = []
        for number in numbers:
            try:
                samples.append(self._sample(batch, number, tbox))
            except DeferredError:
                # The other samples are deferred to the same job.
                continue
        if len(samples) < len(numbers):
            return None
        self._count(samples)
        answers = zip(*(sample.answers for sample in samples), strict=True)
        return [vote([_score(answer) for answer in row]) for row in answers]

    def _count(self, samples: Sequence[_Sample]) -> None:
        with self._client.lock:
            for sample in samples:
                self.report.repairs += sample.repairs
                self.report.degenerate += sample.degenerate
                self.report.failed += sample.failure is not None
                if isinstance(sample.failure, NotAskedError):
                    self.report.first_refusal = self.report.first_refusal or str(sample.failure)
                elif sample.failure is not None:
                    self.report.first_failure = self.report.first_failure or str(sample.failure)

    def _sample(self, batch: Batch, number: int, tbox: TBox) -> _Sample:
        """Return the answers of a sample.

        Raises:
            DeferredError: the prompt is deferred to the next batch job.
        """
        batch = replace(batch, request=replace(batch.request, sample=number))
        try:
            completion = self._client.complete(batch.request)
        except DeferredError:
            raise
        except GroundingError as error:
            failed = [ParsedAnswer(None, Status.FAILED, "", str(error)) for _ in batch.indices]
            return _Sample(failed, failure=error)
        sample = _read(completion, batch, tbox)
        if any(answer.status is Status.UNREADABLE for answer in sample.answers):
            self._repair(sample, batch, completion, tbox)
        return sample

    def _repair(self, sample: _Sample, batch: Batch, completion: Completion, tbox: TBox) -> None:
        """Replace unreadable answers with the answers to a repair prompt."""
        try:
            second = self._client.complete(repair_request(batch, completion.text, sample.answers))
        except DeferredError:
            raise
        except GroundingError:
            return
        repaired = _read(second, batch, tbox)
        pairs = zip(sample.answers, repaired.answers, strict=True)
        sample.answers = [new if old.status is Status.UNREADABLE else old for old, new in pairs]
        sample.repairs += 1
        sample.degenerate += repaired.degenerate

    def _predict(self, path: str, scored: ScoredAnswer, sharing: int) -> Prediction:
        answer = scored.answer
        shared = f" about {sharing} objects that share a concept" if sharing > 1 and self._is_by_concept else ""
        return Prediction(
            prim_path=path,
            class_iri=answer.class_iri,
            confidence=self._scale(scored.confidence),
            status=answer.status,
            grounder=self.name,
            explanation=answer.problem or answer.reasoning or f"answer of {self._client.model}{shared}",
            evidence=("name",) if self._options.strategy is Strategy.NAME_ONLY else (),
            candidates=scored.candidates,
        )

    def _scale(self, confidence: float | None) -> float | None:
        return confidence if confidence is None or self._scaling is None else self._scaling(confidence)


def _read(completion: Completion, batch: Batch, tbox: TBox) -> _Sample:
    answers = parse_answers(completion.text, batch, tbox, completion.tokens)
    if completion.finish is not Finish.STOP or is_degenerate(completion.text):
        return _Sample([_as_degenerate(answer) for answer in answers], degenerate=1)
    return _Sample(answers)


def _as_degenerate(answer: ParsedAnswer) -> ParsedAnswer:
    is_lost = answer.status is Status.UNREADABLE and answer.defect is None
    return replace(answer, defect=Defect.DEGENERATE) if is_lost else answer


def _score(answer: ParsedAnswer) -> ScoredAnswer:
    """Return an answer with the probability of its class name as confidence."""
    if answer.class_iri is None or answer.logprob is None:
        return ScoredAnswer(answer, None)
    return ScoredAnswer(answer, round(math.exp(min(0.0, answer.logprob)), 4))
