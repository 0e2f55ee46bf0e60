"""BatchQueue: collects prompts, submits them as batch jobs, polls the jobs and stores their completions."""

import logging
import time
from collections.abc import Callable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from datetime import UTC, datetime, timedelta
from threading import Lock
from typing import TypeVar

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.batch_jobs.journal import JobJournal, JobRecord
from usd2kg.grounding.llm.batch_jobs.service import BatchService, JobHandle, JobResults, is_refusal, row_id
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.retry import Failure
from usd2kg.grounding.llm.serialization import request_key

__all__ = ["BatchQueue", "DeferredError", "Reporting"]

logger = logging.getLogger(__name__)

_T = TypeVar("_T")
_ENDED = "ended"
_NOT_FOUND = 404
_RESUME = "the same command fetches its answers"
_AGAIN = "the same command submits it again, or asks it alone without --batch"


class DeferredError(GroundingError):
    """The prompt is deferred to the next batch job."""


@dataclass(frozen=True)
class Reporting:
    """Callbacks for progress messages and delays."""

    say: Callable[[str], object] = logger.info
    """Prints a line."""
    show: Callable[[str], object] = logger.debug
    """Shows the state while jobs are pending."""
    sleep: Callable[[float], object] = time.sleep
    """Waits for a number of seconds."""


@dataclass(slots=True)
class _Outcome:
    """Results of a job by cache key."""

    completions: dict[str, Completion] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)
    repeated: int = 0
    """Rows that are submitted again without a feature that the service rejects."""
    unknown: int = 0
    """Rows that match no request of the job."""


class BatchQueue:
    """The jobs of one model. `defer` is thread-safe."""

    def __init__(self, model: str, journal: JobJournal, service: BatchService, reporting: Reporting) -> None:
        """Create an empty queue.

        Args:
            model: the model string.
            journal: the record of jobs on disk.
            service: the batch endpoint of the model.
            reporting: callbacks for progress messages and delays.
        """
        self._model, self._journal, self._service, self._reporting = model, journal, service, reporting
        self._deferred: dict[str, Request] = {}
        self._failures: dict[str, str] = {}
        self._answered: set[str] = set()
        self._pending: list[JobRecord] = []
        self._failed_polls: dict[int, int] = {}
        """Job number → consecutive failed polls."""
        self._lock = Lock()

    def defer(self, request: Request) -> None:
        """Queue a prompt for the next job.

        Raises:
            GroundingError: always; `DeferredError`, or the failure of an earlier job of this run for this prompt.
        """
        key = request_key(self._model, request)
        with self._lock:
            if (failure := self._failures.get(key)) is None:
                assert key not in self._answered, "a completion from a batch job is missing from the cache"
                self._deferred[key] = request
        if failure is not None:
            raise GroundingError(failure)
        raise DeferredError("deferred to the next batch job")

    def submit(
        self,
        refuse: Callable[[Mapping[str, Request], Mapping[str, Request]], Set[str]],
        describe: Callable[[Sequence[Request]], str],
    ) -> bool:
        """Submit the deferred prompts that are not part of an open job; return whether any were deferred.

        Args:
            refuse: takes the prompts of open jobs and the new prompts by cache key, and returns the keys of the new
                prompts not to submit.
            describe: returns the estimated cost of prompts, which is reported before they are submitted.

        Raises:
            GroundingError: the service does not answer whether it received a job of an earlier run, or a prompt cannot
                be part of a job.
        """
        deferred, self._deferred = self._deferred, {}
        if not deferred:
            return False
        while unsettled := [job for job in self._open_jobs(deferred) if job.id is None]:
            for job in unsettled:
                self._settle(job)
        with self._journal.submitting():
            # Another process may have submitted these prompts in the meantime.
            running = self._open_jobs(deferred)
            covered = {key for job in running for key in job.keys}
            new = {key: request for key, request in deferred.items() if key not in covered}
            refused = refuse({key: deferred[key] for key in deferred.keys() & covered}, new)
            for job in running:
                self._report_running(job)
            accepted = [request for key, request in new.items() if key not in refused]
            if accepted:
                self._reporting.say(f"submitting {len(accepted)} prompts to {self._service.url}: {describe(accepted)}")
            submitted = self._submit_new(accepted)
        self._pending = [*running, *submitted]
        return True

    def collect(self) -> dict[str, Completion]:
        """Wait for the jobs of `submit`, store their completions, and return them by cache key.

        Raises:
            KeyboardInterrupt: the user stops waiting; the jobs keep running at the service.
        """
        completions: dict[str, Completion] = {}
        start, wait_s = time.monotonic(), LIMITS.first_poll_s
        try:
            while self._pending:
                for job in list(self._pending):
                    if (outcome := self._collect_if_ended(job)) is not None:
                        self._pending.remove(job)
                        completions |= outcome.completions
                        self._answered |= outcome.completions.keys()
                        self._failures |= outcome.failures
                if self._pending:
                    elapsed = timedelta(seconds=round(time.monotonic() - start))
                    self._reporting.show(f"waiting for {_enumerate(self._pending)}, {elapsed}")
                    self._reporting.sleep(wait_s)
                    wait_s = min(wait_s * LIMITS.poll_growth, LIMITS.max_poll_s)
        except KeyboardInterrupt:
            self._reporting.say(f"{_enumerate(self._pending)}: still running at the service; {_RESUME}")
            raise
        return completions

    def _open_jobs(self, wanted: Mapping[str, Request]) -> list[JobRecord]:
        return [job for job in self._journal.open_jobs(self._model) if not job.keys.isdisjoint(wanted)]

    def _submit_new(self, requests: Sequence[Request]) -> list[JobRecord]:
        records = []
        for job in self._service.encode_jobs(requests):
            record = self._journal.begin(self._model, job.sources, self._service.draft_handle(job))
            outcome = self._service.submit(job)
            if isinstance(outcome, Failure):
                self._fail_submission(record, outcome)
            else:
                records.append(self._confirm(record, outcome))
        return records

    def _confirm(self, record: JobRecord, handle: JobHandle) -> JobRecord:
        record = self._journal.confirm(record, handle["id"], handle)
        self._reporting.say(
            f"batch job {record.id}: {len(record.keys)} prompts submitted to {self._service.url}; "
            f"Ctrl-C stops waiting, {_RESUME}"
        )
        return record

    def _fail_submission(self, record: JobRecord, failure: Failure) -> None:
        problem = _explain(failure)
        if is_refusal(failure):
            self._journal.close(record, {})
            reason = f"model '{self._model}': {self._service.url}: the service rejected the batch job: {problem}"
        else:
            reason = (
                f"model '{self._model}': {self._service.url}: it is unknown whether the service received the batch "
                f"job ({problem}); run the same command again to check"
            )
        self._failures.update(dict.fromkeys(record.keys, reason))

    def _report_running(self, job: JobRecord) -> None:
        when = datetime.fromtimestamp(job.recorded_s).astimezone().isoformat(" ", "minutes")
        self._reporting.say(f"batch job {job.id}: {len(job.keys)} prompts running at {self._service.url} since {when}")

    def _settle(self, record: JobRecord) -> None:
        """Confirm a job without id if the service received it, or else close it.

        Not all services accept a client-supplied job name, so the job is identified by its rows: each unknown job that
        the service received since the submission is polled until it ends.

        Raises:
            GroundingError: the service cannot be reached.
        """
        age_s = time.time() - record.recorded_s
        # The service's job list lags behind submissions.
        self._reporting.sleep(max(0.0, LIMITS.job_settle_s - age_s))
        since = datetime.fromtimestamp(record.recorded_s, UTC) - timedelta(seconds=LIMITS.clock_skew_s)
        recent = self._checked(self._service.list_recent(since))
        known = self._journal.known_ids()
        for job in recent:
            if job.id not in known and job.request_count in (None, len(record.keys)):
                handle: JobHandle = {**record.handle, "id": job.id, "created_at": job.created.isoformat()}
                if self._has_rows_of(record, handle):
                    self._confirm(record, handle)
                    return
        self._journal.close(record, {})

    def _has_rows_of(self, record: JobRecord, handle: JobHandle) -> bool:
        handle = self._checked(self._service.refresh(handle))
        wait_s = LIMITS.first_poll_s
        while handle["status"] != _ENDED:
            self._reporting.show(f"waiting for {handle['id']}, which may contain the prompts")
            self._reporting.sleep(wait_s)
            wait_s = min(wait_s * LIMITS.poll_growth, LIMITS.max_poll_s)
            handle = self._checked(self._service.refresh(handle))
        results = self._service.fetch_results(handle)
        return not self._checked(results).rows.keys().isdisjoint(map(row_id, record.keys))

    def _checked(self, outcome: _T | Failure) -> _T:
        if isinstance(outcome, Failure):
            raise GroundingError(
                f"model '{self._model}': {self._service.url}: cannot check whether the batch job of an earlier run "
                f"exists ({_explain(outcome)}); run the same command again later"
            )
        return outcome

    def _collect_if_ended(self, job: JobRecord) -> _Outcome | None:
        """Return the results of a job after storing them; None if it has not ended."""
        handle = self._service.refresh(job.handle)
        if isinstance(handle, Failure):
            return self._fail_poll(job, handle)
        self._failed_polls.pop(job.number, None)
        if handle["status"] != _ENDED:
            return None
        results = self._service.fetch_results(handle)
        if isinstance(results, Failure):
            return self._fail_poll(job, results)
        outcome = self._read_results(job, results)
        self._journal.close(job, outcome.completions)
        self._report_outcome(job, outcome)
        return outcome

    def _fail_poll(self, job: JobRecord, failure: Failure) -> _Outcome | None:
        """Return the failure of a poll for all prompts of the job, or None to poll again. The job stays open."""
        self._failed_polls[job.number] = count = self._failed_polls.get(job.number, 0) + 1
        if failure.is_transient and count < LIMITS.max_failed_polls:
            return None
        unknown = f", or discard it with usd2kg completions forget {job.id}" if failure.status == _NOT_FOUND else ""
        reason = f"batch job {job.id}: {self._service.url}: {_explain(failure)}; {_RESUME}{unknown}"
        return _Outcome(failures=dict.fromkeys(job.keys, reason))

    def _read_results(self, job: JobRecord, results: JobResults) -> _Outcome:
        outcome = _Outcome()
        requests = self._journal.read_requests(job)
        outcome.unknown = len(results.rows.keys() - {row_id(key) for key in requests})
        asked = self._service.capabilities
        for key, request in requests.items():
            result = results.rows.get(row_id(key))
            if result is None:
                outcome.failures[key] = f"batch job {job.id}: {results.problem or 'no answer'}; {_AGAIN}"
                continue
            read = self._service.read_result(result, request)
            if isinstance(read, Completion):
                outcome.completions[key] = read
            elif asked.without(read) != asked:
                self._service.capabilities = self._service.capabilities.without(read)
                outcome.repeated += 1
            else:
                outcome.failures[key] = f"batch job {job.id}: {_explain(read)}; {_AGAIN}"
        return outcome

    def _report_outcome(self, job: JobRecord, outcome: _Outcome) -> None:
        parts = [f"{len(outcome.completions)} of {len(job.keys)} answers"]
        if outcome.failures:
            reason = next(iter(outcome.failures.values())).removeprefix(f"batch job {job.id}: ")
            parts.append(f"{len(outcome.failures)} failed, the first with: {reason}")
        if outcome.repeated:
            parts.append(f"{outcome.repeated} submitted again without an option that the service rejects")
        if outcome.unknown:
            parts.append(f"{outcome.unknown} rows ignored that match no prompt of the job")
        elapsed = timedelta(seconds=round(time.time() - job.recorded_s))
        self._reporting.say(f"batch job {job.id}: ended {elapsed} after its submission: {', '.join(parts)}")


def _explain(failure: Failure) -> str:
    return failure.message if failure.status is None else f"status {failure.status}: {failure.message}"


def _enumerate(jobs: Sequence[JobRecord]) -> str:
    return ", ".join(f"batch job {job.id} ({len(job.keys)} prompts)" for job in jobs)
