"""Language models behind HTTP: Gemini, Anthropic, OpenAI and every server that speaks OpenAI's chat completions.

A model is named `google:NAME`, `anthropic:NAME` or `openai:NAME`, each with `@URL` behind it for another address.
Keys come from the environment, never from the name.
"""

import asyncio
import os
import random as random_numbers
import time
import weakref
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.adapter import (
    convert_response,
    is_sampled,
    json_object_format,
    make_message,
    make_parameters,
    make_settings,
)
from usd2kg.grounding.llm.capabilities import Capabilities
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.event_loop import EventLoopThread
from usd2kg.grounding.llm.model_reference import KEY_VARIABLES, ModelReference, find_key, parse_model_reference
from usd2kg.grounding.llm.providers import closing_responses, make_provider_model, open_http
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
    timeout_s: float = 120,
    retries: int = 4,
    sleep: Callable[[float], object] = time.sleep,
    random: Callable[[], float] = random_numbers.random,
    requests_per_minute: float | None = None,
    clock: Callable[[], float] = time.monotonic,
) -> "HttpClient":
    """Return a client for the model; nothing is sent yet.

    Args:
        model: `google:NAME`, `anthropic:NAME` or `openai:NAME`, or one of them with `@URL` for another server.
        environment: where the keys are.
        timeout_s: seconds that one request may take in all, from the first byte to the last of its stream.
        retries: how often a request is sent again after 408, 409, 429, 5xx, a timeout or a broken connection.
        sleep: waits so many seconds between two requests.
        random: a number from 0 to 1, for the jitter.
        requests_per_minute: how many requests may be sent, those sent again among them; None for any number.
        clock: seconds since whenever, for the rate.

    Raises:
        GroundingError: the model is malformed, its key is missing, or the extra `llm` is not installed.
    """
    address = parse_model_reference(model)
    key = find_key(address, environment)
    redact = Redactor([key, *(environment.get(name, "").strip() for names in KEY_VARIABLES.values() for name in names)])
    try:
        http = open_http(address, timeout_s)
        served = make_provider_model(address, key, http)
    except ImportError as error:
        missing = error.name or getattr(error.__cause__, "name", None) or "pydantic_ai"
        raise GroundingError(
            f"model '{model}': the module {missing} is not installed; "
            "expected the extra `llm`, run pip install 'usd2kg[llm]'"
        ) from error
    traffic = Traffic()
    wait = traffic.counting(sleep)
    pace = RateLimiter(requests_per_minute, wait, clock)
    return HttpClient(address, served, http, redact, RetryPolicy(retries, wait, random), pace, traffic, timeout_s)


class HttpClient:
    """One model behind HTTP, to be used from any number of threads.

    Requests run on an event loop of its own, in a thread of its own, so that connections are kept from one to the
    next, whether or not the caller has an event loop.
    """

    def __init__(
        self,
        address: ModelReference,
        served: "Model[Any]",
        http: "AsyncClient",
        redact: Redactor,
        retries: RetryPolicy,
        pace: RateLimiter,
        traffic: Traffic,
        timeout_s: float,
    ) -> None:
        self.model = address.model
        self.traffic = traffic
        """What was sent so far."""
        self._address = address
        self._served = served
        self._redact = redact
        self._retries = retries
        self._pace = pace
        self._timeout_s = timeout_s
        self._abilities = Capabilities(logprobs=address.provider == "openai", json_schemas=address.is_openai_compatible)
        self._background = EventLoopThread()
        self._close = weakref.finalize(self, self._background.stop, http.aclose)

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
        """Return the model's completion, after as many requests as it takes.

        Raises:
            GroundingError: the server cannot be reached, refused the request, or kept failing; the message says
                which server, its status and its words.
        """
        if not self._close.alive:
            raise GroundingError(f"model '{self.model}': the client is closed; expected an open one, make another")
        tries = 0

        def send() -> Completion | Failure:
            nonlocal tries
            tries += 1
            self.traffic.add(retries=1 if tries > 1 else 0)
            return self._send(request)

        outcome = self._retries.run(send)
        if isinstance(outcome, Failure):
            # Raised outside any handler: the library's error, and with it the server's unredacted words, stays behind.
            raise GroundingError(self._explain(outcome, tries))
        return outcome

    def _send(self, request: Request) -> Completion | Failure:
        """Send a request, again without what the server refuses; what it refused once it is not asked for again."""
        asked = self._abilities
        if not is_sampled(self._served, request.is_thinking):
            asked = replace(asked, logprobs=False)
        outcome = self._send_once(request, asked)
        while isinstance(outcome, Failure) and (rest := asked.without(outcome)) != asked:
            # Other threads may have found out more meanwhile.
            self._abilities = self._abilities.without(outcome)
            asked = rest
            outcome = self._send_once(request, asked)
        return outcome

    def _send_once(self, request: Request, asked: Capabilities) -> Completion | Failure:
        prompt = self._make_prompt(request, asked)
        self._pace.wait_for_turn()
        self.traffic.add(attempts=1)
        return self._background.run(self._ask(request, prompt, asked))

    async def _ask(self, request: Request, prompt: dict[str, Any], asked: Capabilities) -> Completion | Failure:
        from pydantic_ai import direct  # noqa: PLC0415 - the extra may be missing
        from pydantic_ai.exceptions import AgentRunError, UserError  # noqa: PLC0415

        provider = self._address.provider
        try:
            async with asyncio.timeout(self._timeout_s), closing_responses():
                if asked.streams:
                    return await request_stream(self._served, prompt, request, provider)
                response = await direct.model_request(self._served, **prompt)
        except TimeoutError:
            return Failure(f"timed out after {self._timeout_s:g} seconds", None, is_transient=True)
        except AgentRunError as error:
            return convert_error(error, self._redact)
        except UserError as error:
            return Failure(self._redact(str(error)))
        return convert_response(response, request, provider)

    def _make_prompt(self, request: Request, asked: Capabilities) -> dict[str, Any]:
        """The arguments of the library's functions that send a request."""
        from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415 - the extra may be missing

        settings = make_settings(self._address, self._served, request, asked.logprobs)
        settings |= {"timeout": self._timeout_s, "max_retries": 0}
        parameters = make_parameters(self._served, request, self._address.is_openai_compatible)
        if self._address.is_openai_compatible and not asked.json_schemas:
            parameters = ModelRequestParameters()
            # llama-cpp-python's server would sort its whole vocabulary for each token, longer than that takes to come.
            settings.pop("openai_top_logprobs", None)
            body = {**settings.get("extra_body", {}), "response_format": json_object_format(request)}
            settings |= {"extra_body": body}
        return {
            "messages": [make_message(request)],
            "model_settings": settings,
            "model_request_parameters": parameters,
            "instrument": False,
        }

    def _explain(self, failure: Failure, tries: int) -> str:
        status = "no readable answer" if failure.status is None else f"status {failure.status}"
        after = "" if tries == 1 else f" after {tries} tries"
        key_variable = KEY_VARIABLES[self._address.provider][0]
        return (
            f"model '{self.model}': {self._address.url}: {status}{after}: {failure.message}; "
            f"{advise(failure, key_variable)}"
        )
