"""HttpClient: language models of Google, Anthropic, OpenAI, Azure, Bedrock, and servers with OpenAI's protocol.

Model strings are described in `model_reference`. API keys come from the environment only.
"""

import asyncio
import os
import random as random_numbers
import time
import weakref
from collections.abc import Callable, Coroutine, Mapping
from dataclasses import replace
from functools import partial
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.adapter import (
    accepts_temperature,
    convert_response,
    hide_secrets,
    json_object_format,
    make_message,
    make_parameters,
    make_settings,
    prompted_parameters,
    tool_parameters,
)
from usd2kg.grounding.llm.batch_jobs.service import BatchService
from usd2kg.grounding.llm.capabilities import Capabilities
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.event_loop import EventLoopThread
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.model_reference import (
    KEY_VARIABLES,
    SECRET_VARIABLES,
    ModelReference,
    add_endpoint,
    find_key,
    parse_model_reference,
)
from usd2kg.grounding.llm.providers import (
    Access,
    close_connections,
    closing_responses,
    make_batch_model,
    make_provider_model,
    open_http,
)
from usd2kg.grounding.llm.retry import Failure, Redactor, RetryPolicy, advise, convert_error
from usd2kg.grounding.llm.streaming import request_stream
from usd2kg.grounding.llm.traffic import RateLimiter, Traffic

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.models import Model

__all__ = ["HttpClient", "make_client"]


def make_client(
    model: str,
    *,
    environment: Mapping[str, str] = os.environ,
    timeout_s: float = LIMITS.request_timeout_s,
    max_retries: int = LIMITS.max_retries,
    sleep: Callable[[float], object] = time.sleep,
    random: Callable[[], float] = random_numbers.random,
    requests_per_minute: float | None = None,
    clock: Callable[[], float] = time.monotonic,
) -> "HttpClient":
    """Return a client for the model, without sending a request.

    Args:
        model: the model string.
        environment: the environment variables with the API keys.
        timeout_s: duration of one request, from connecting to the last byte of its stream.
        max_retries: attempts after the first, for the status 408, 409, 429 or 5xx, a timeout or a broken connection.
        sleep: waits for a number of seconds.
        random: returns a number from 0 to 1, for the jitter.
        requests_per_minute: rate limit, retries included; None for no limit.
        clock: returns monotonic seconds, for the rate limit.

    Raises:
        GroundingError: the model string is malformed, the key is missing, or the extra `llm` is not installed.
    """
    reference = add_endpoint(parse_model_reference(model), environment)
    key = find_key(reference, environment)
    redact = Redactor([key, *(environment.get(name, "").strip() for name in SECRET_VARIABLES)])
    try:
        http = open_http(reference, timeout_s)
        provider_model = make_provider_model(reference, Access(key, http, environment, timeout_s))
    except ImportError as error:
        extra = "bedrock" if reference.provider == "bedrock" else "llm"
        missing = error.name or getattr(error.__cause__, "name", None) or "pydantic_ai"
        raise GroundingError(
            f"model '{model}': the module {missing} is not installed; "
            f"expected the extra `{extra}`, run pip install 'usd2kg[{extra}]'"
        ) from error
    traffic = Traffic()
    wait = traffic.counting(sleep)
    rate_limiter = RateLimiter(requests_per_minute, wait, clock)
    return HttpClient(
        reference,
        provider_model,
        http,
        redact,
        RetryPolicy(max_retries, wait, random),
        rate_limiter,
        traffic,
        timeout_s,
    )


class HttpClient:
    """One model behind HTTP. Thread-safe.

    Requests run in an `EventLoopThread`, so connections are reused between calls.
    """

    def __init__(
        self,
        reference: ModelReference,
        provider_model: "Model[Any]",
        http: "AsyncClient",
        redact: Redactor,
        retries: RetryPolicy,
        rate_limiter: RateLimiter,
        traffic: Traffic,
        timeout_s: float,
    ) -> None:
        self.model = reference.model
        self.traffic = traffic
        """Counters of the requests and waits."""
        self._reference = reference
        self._provider_model = provider_model
        self._redact = redact
        self._retries = retries
        self._rate_limiter = rate_limiter
        self._timeout_s = timeout_s
        self._capabilities = Capabilities(
            logprobs=reference.provider in ("openai", "azure"),
            json_schemas=reference.is_openai_compatible,
            json_objects=reference.is_openai_compatible,
            tools=reference.is_openai_compatible,
        )
        self._event_loop = EventLoopThread()
        self._close = weakref.finalize(self, self._event_loop.stop, partial(close_connections, http, provider_model))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the connections; closing twice does nothing."""
        self._close()

    def complete(self, request: Request) -> Completion:
        """Return the model's completion, after retries if necessary.

        Raises:
            GroundingError: the server cannot be reached, rejects the request, or keeps failing; the message contains
                the URL, the status and the server's message.
        """
        if not self._close.alive:
            raise GroundingError(f"model '{self.model}': the client is closed; expected an open one, create another")
        attempts = 0

        def send() -> Completion | Failure:
            nonlocal attempts
            attempts += 1
            self.traffic.add(retries=1 if attempts > 1 else 0)
            return self._send(request)

        outcome = self._retries.run(send)
        if isinstance(outcome, Failure):
            # Raised outside any handler, so that the library's exception with its unredacted message is not chained.
            raise GroundingError(self._explain(outcome, attempts))
        return hide_secrets(outcome, self._redact.hide)

    def open_batch_service(self) -> BatchService:
        """Return the batch endpoint of the service, which uses the connections of this client.

        Raises:
            GroundingError: the service has none.
        """
        provider_model = make_batch_model(self._reference, self._provider_model)
        if provider_model is None:
            raise GroundingError(
                f"model '{self.model}': --batch needs a service with a batch endpoint; expected a model of OpenAI, "
                "Anthropic or Gemini, or leave out --batch"
            )
        return BatchService(
            self._reference, provider_model, self._run, self._redact, self._retries, Capabilities(logprobs=True)
        )

    def _run(self, work: Coroutine[Any, Any, Any]) -> Any:
        self._rate_limiter.wait_for_turn()
        self.traffic.add(attempts=1)
        return self._event_loop.run(work)

    def _send(self, request: Request) -> Completion | Failure:
        """Send a request; repeat it without each feature that the server rejects, which is not requested again."""
        features = self._capabilities
        if not accepts_temperature(self._provider_model, request.is_thinking):
            features = replace(features, logprobs=False)
        outcome = self._send_once(request, features)
        while isinstance(outcome, Failure) and (rest := features.without(outcome)) != features:
            # Start from the current value: other threads may have removed other features meanwhile.
            self._capabilities = self._capabilities.without(outcome)
            features = rest
            outcome = self._send_once(request, features)
        return outcome

    def _send_once(self, request: Request, features: Capabilities) -> Completion | Failure:
        prompt = self._make_prompt(request, features)
        self._rate_limiter.wait_for_turn()
        self.traffic.add(attempts=1)
        return self._event_loop.run(self._ask(request, prompt, features))

    async def _ask(self, request: Request, prompt: dict[str, Any], features: Capabilities) -> Completion | Failure:
        from pydantic_ai import direct  # noqa: PLC0415 - the extra may be missing
        from pydantic_ai.exceptions import AgentRunError, UserError  # noqa: PLC0415

        provider = self._reference.provider
        try:
            async with asyncio.timeout(self._timeout_s), closing_responses():
                if features.streams:
                    return await request_stream(self._provider_model, prompt, request, provider)
                response = await direct.model_request(self._provider_model, **prompt)
        except TimeoutError:
            return Failure(f"timed out after {self._timeout_s:g} seconds", None, is_transient=True)
        except AgentRunError as error:
            return convert_error(error, self._redact)
        except UserError as error:
            return Failure(self._redact(str(error)))
        return convert_response(response, request, provider)

    def _make_prompt(self, request: Request, features: Capabilities) -> dict[str, Any]:
        """Return the arguments of `pydantic_ai.direct.model_request` and `model_request_stream`."""
        from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415 - the extra may be missing

        settings = make_settings(self._reference, self._provider_model, request, features.logprobs)
        if self._reference.provider != "bedrock":
            # Bedrock's client has its timeouts from its creation.
            settings |= {"timeout": self._timeout_s, "max_retries": 0}
        parameters = make_parameters(self._provider_model, request, self._reference.is_openai_compatible)
        if self._reference.is_openai_compatible and not features.json_schemas:
            # llama-cpp-python's server would sort its vocabulary for each token, which takes longer than decoding it.
            settings.pop("openai_top_logprobs", None)
            if features.json_objects:
                parameters = ModelRequestParameters()
                body = {**settings.get("extra_body", {}), "response_format": json_object_format(request)}
                settings |= {"extra_body": body}
            else:
                parameters = tool_parameters(request) if features.tools else prompted_parameters(request)
        return {
            "messages": [make_message(request)],
            "model_settings": settings,
            "model_request_parameters": parameters,
            "instrument": False,
        }

    def _explain(self, failure: Failure, attempts: int) -> str:
        status = "no readable answer" if failure.status is None else f"status {failure.status}"
        after = "" if attempts == 1 else f" after {attempts} attempts"
        key_variables = " or ".join(KEY_VARIABLES[self._reference.provider])
        return (
            f"model '{self.model}': {self._reference.url}: {status}{after}: {failure.message}; "
            f"{advise(failure, key_variables)}"
        )
