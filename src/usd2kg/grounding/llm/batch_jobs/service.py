"""BatchService: the batch endpoint of a service, reached through the same client library as single requests."""

import json
from collections.abc import Callable, Coroutine, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from datetime import datetime
from typing import TYPE_CHECKING, Any, TypeVar

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.adapter import (
    accepts_temperature,
    convert_response,
    hide_secrets,
    make_message,
    make_parameters,
    make_settings,
)
from usd2kg.grounding.llm.batch_jobs.listing import RecentJob, find_status, library_errors, list_recent_jobs
from usd2kg.grounding.llm.capabilities import Capabilities
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.model_reference import ModelReference
from usd2kg.grounding.llm.providers import closing_responses
from usd2kg.grounding.llm.retry import Failure, Redactor, RetryPolicy, convert_error, is_transient
from usd2kg.grounding.llm.serialization import request_key

if TYPE_CHECKING:
    from pydantic_ai.models import Model
    from pydantic_ai.models.batch import Batch, BatchRequest, BatchResult, EncodedBatchRequest

__all__ = ["BatchService", "EncodedJob", "JobHandle", "JobResults", "is_refusal", "row_id"]

_T = TypeVar("_T")
_MALFORMED = (AttributeError, KeyError, TypeError, ValueError)
"""Exceptions that the libraries raise for a result with an unexpected structure, which they do not validate."""
_REFUSED, _TIMED_OUT, _TOO_MANY, _FAILED = 400, 408, 429, 500

JobHandle = Mapping[str, Any]
"""JSON that the client library needs to poll a job, without the hash of the credentials."""


@dataclass(frozen=True, slots=True)
class EncodedJob:
    """Requests in the format of the service, within its size limit for a job."""

    sources: list[Request]
    requests: "list[EncodedBatchRequest]"


@dataclass(frozen=True, slots=True)
class JobResults:
    """Results of an ended job."""

    rows: "dict[str, BatchResult]"
    """By row id."""
    problem: str = ""
    """Reason for a failure of the whole job, which costs nothing; empty otherwise."""


def row_id(key: str) -> str:
    """Return the row id of a request: the digest in its cache key, 64 characters, which is Anthropic's limit."""
    return key.removeprefix("sha256:")


class BatchService:
    """The batch endpoint of one model's service. All methods that send requests return a `Failure` if they fail."""

    def __init__(
        self,
        reference: ModelReference,
        provider_model: "Model[Any]",
        run: Callable[[Coroutine[Any, Any, Any]], Any],
        redact: Redactor,
        retries: RetryPolicy,
        capabilities: Capabilities,
    ) -> None:
        """Create a service.

        Args:
            reference: the model.
            provider_model: a pydantic-ai model whose service has a batch endpoint.
            run: returns the result of a coroutine that sends a request.
            redact: removes credentials from messages.
            retries: when to repeat a request.
            capabilities: the features to request.
        """
        self._reference, self._model = reference, provider_model
        self._run, self._redact, self._retries = run, redact, retries
        self.capabilities = capabilities
        """The features to request."""
        self.url = reference.url

    def encode_jobs(self, requests: Iterable[Request]) -> Iterator[EncodedJob]:
        """Yield the requests grouped into as few jobs as the service allows.

        Raises:
            GroundingError: a request cannot be part of a job.
        """
        max_requests, max_bytes = self._model.batch_max_requests, self._model.batch_max_bytes
        job, size = EncodedJob([], []), 0
        for request in requests:
            encoded = self._run(self._encode(request))
            if isinstance(encoded, Failure):
                raise GroundingError(f"model '{self._reference.model}': {encoded.message}")
            added = self._model.batch_request_size(encoded)
            is_full = len(job.requests) == max_requests or (max_bytes is not None and size + added > max_bytes)
            is_other = bool(job.requests) and job.requests[0].group != encoded.group
            if job.requests and (is_full or is_other):
                yield job
                job, size = EncodedJob([], []), 0
            job.sources.append(request)
            job.requests.append(encoded)
            size += added
        if job.requests:
            yield job

    def draft_handle(self, job: EncodedJob) -> JobHandle:
        """Return the handle of a job before submission: without id or creation time."""
        from pydantic_ai.models.batch import Batch  # noqa: PLC0415 - the extra may be missing

        handle = Batch(
            id="",
            model_name=self._model.model_name,
            provider_name=self._model.system,
            group=job.requests[0].group,
            status="in_progress",
            created_at=datetime.fromtimestamp(0).astimezone(),
            request_count=len(job.requests),
        )
        return _dump(handle)

    def submit(self, job: EncodedJob) -> JobHandle | Failure:
        """Submit a job and return its handle; `is_refusal` distinguishes failures that created no job."""

        def send() -> JobHandle | Failure:
            outcome = self._send(self._model.batch_create(job.requests))
            if isinstance(outcome, Failure):
                # The only transient failure that guarantees that no job was created.
                return replace(outcome, is_transient=outcome.status == _TOO_MANY)
            return _dump(outcome)

        return self._retries.run(send)

    def refresh(self, handle: JobHandle) -> JobHandle | Failure:
        """Return the current handle of a job."""

        def send() -> JobHandle | Failure:
            outcome = self._send(self._model.batch_status(_load(handle)))
            return outcome if isinstance(outcome, Failure) else _dump(outcome)

        return self._retries.run(send)

    def fetch_results(self, handle: JobHandle) -> JobResults | Failure:
        """Return the results of an ended job."""
        return self._retries.run(lambda: self._send(self._fetch_results(_load(handle))))

    async def _fetch_results(self, handle: "Batch") -> JobResults:
        from pydantic_ai.models._batch_codec import BatchJobError  # noqa: PLC0415 - the extra may be missing

        try:
            results = await self._model.batch_results(handle)
        except BatchJobError as error:
            return JobResults({}, convert_error(error, self._redact).message)
        return JobResults({result.custom_id: result for result in results})

    def list_recent(self, since: datetime) -> list[RecentJob] | Failure:
        """Return the jobs that the service received since a time, given with its time zone."""
        return self._retries.run(lambda: self._send(list_recent_jobs(self._model, since)))

    def read_result(self, result: "BatchResult", request: Request) -> Completion | Failure:
        """Return the completion in a result, or the failure of its row."""
        from pydantic_ai.exceptions import AgentRunError  # noqa: PLC0415 - the extra may be missing

        try:
            response = self._model.batch_decode(result, self._make_request(request))
            completion = convert_response(response, request, self._reference.provider)
        except AgentRunError as error:
            return convert_error(error, self._redact)
        except _MALFORMED as error:
            return Failure(self._redact(f"its row is malformed ({error})"))
        return hide_secrets(completion, self._redact.hide)

    async def _encode(self, request: Request) -> "EncodedBatchRequest":
        return await self._model.batch_encode(self._make_request(request))

    def _make_request(self, request: Request) -> "BatchRequest":
        from pydantic_ai.messages import InstructionPart  # noqa: PLC0415 - the extra may be missing
        from pydantic_ai.models.batch import BatchRequest  # noqa: PLC0415

        asks_logprobs = self.capabilities.logprobs and accepts_temperature(self._model, request.is_thinking)
        parameters = make_parameters(self._model, request, self._reference.is_openai_compatible)
        return BatchRequest(
            custom_id=row_id(request_key(self._reference.model, request)),
            messages=[make_message(request)],
            model_settings=make_settings(self._reference, self._model, request, asks_logprobs),  # type: ignore[arg-type]
            model_request_parameters=replace(parameters, instruction_parts=[InstructionPart(content=request.system)]),
        )

    def _send(self, work: Coroutine[Any, Any, _T]) -> _T | Failure:
        outcome: _T | Failure = self._run(self._attempt(work))
        return outcome

    async def _attempt(self, work: Coroutine[Any, Any, _T]) -> _T | Failure:
        from pydantic_ai.exceptions import AgentRunError, UserError  # noqa: PLC0415 - the extra may be missing

        try:
            async with closing_responses():
                return await work
        except library_errors(self._model.system) as error:
            status = find_status(error)
            return Failure(self._redact(str(error)), status, status is None or is_transient(status))
        except AgentRunError as error:
            return convert_error(error, self._redact)
        except UserError as error:
            # The library rejects the request before sending it.
            return Failure(self._redact(str(error)), _REFUSED)
        except _MALFORMED as error:
            return Failure(self._redact(f"the answer is malformed ({error})"))


def is_refusal(failure: Failure) -> bool:
    """Return whether a failed submission certainly created no job."""
    return failure.status is not None and failure.status < _FAILED and failure.status != _TIMED_OUT


def _dump(handle: "Batch") -> JobHandle:
    from pydantic import TypeAdapter  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.models.batch import Batch  # noqa: PLC0415

    # The library hashes the API key to group requests for submission; the hash is not needed afterwards.
    group = json.dumps(json.loads(handle.group) | {"credential": ""}, sort_keys=True)
    data: JobHandle = TypeAdapter(Batch).dump_python(replace(handle, group=group), mode="json")
    return data


def _load(handle: JobHandle) -> "Batch":
    from pydantic import TypeAdapter  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.models.batch import Batch  # noqa: PLC0415

    return TypeAdapter(Batch).validate_python(handle)
