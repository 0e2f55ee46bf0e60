"""Language models behind HTTP: Gemini, Anthropic, OpenAI and every server that speaks OpenAI's chat completions.

A model is named `google:NAME`, `anthropic:NAME` or `openai:NAME`, each with `@URL` behind it for another address.
Keys come from the environment, never from the name.
"""

import asyncio
import os
import random as random_numbers
import threading
import time
import weakref
from collections.abc import Callable, Coroutine, Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self, TypeVar, cast

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.addresses import KEY_VARIABLES, Address, find_key, parse_address
from usd2kg.grounding.llm.completion import Completion, Request
from usd2kg.grounding.llm.retry import Failure, Redactor, Retries, advise, read_failure
from usd2kg.grounding.llm.wire import is_sampled, make_parameters, make_settings, older_format, read_completion

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.models import Model
    from pydantic_ai.settings import ModelSettings

__all__ = ["HttpClient", "make_client"]

_T = TypeVar("_T")

_LONGEST_CONNECT_S = 10.0


def make_client(
    model: str,
    *,
    environment: Mapping[str, str] = os.environ,
    timeout_s: float = 120,
    retries: int = 4,
    sleep: Callable[[float], object] = time.sleep,
    random: Callable[[], float] = random_numbers.random,
) -> "HttpClient":
    """Return a client for the model; nothing is sent yet.

    Args:
        model: `google:NAME`, `anthropic:NAME` or `openai:NAME`, or one of them with `@URL` for another server.
        environment: where the keys are.
        timeout_s: seconds that one request may take in all.
        retries: how often a request is sent again after 408, 409, 429, 5xx, a timeout or a broken connection.
        sleep: waits so many seconds between two requests.
        random: a number from 0 to 1, for the jitter.

    Raises:
        GroundingError: the model is malformed, its key is missing, or the extra `llm` is not installed.
    """
    address = parse_address(model)
    key = find_key(address, environment)
    redact = Redactor([key, *(environment.get(name, "").strip() for names in KEY_VARIABLES.values() for name in names)])
    try:
        http = _open_http(address, timeout_s)
        served = _SERVED[address.provider](address, key, http)
    except ImportError as error:
        missing = error.name or getattr(error.__cause__, "name", None) or "pydantic_ai"
        raise GroundingError(
            f"model '{model}': the module {missing} is not installed; "
            "expected the extra `llm`, run pip install 'usd2kg[llm]'"
        ) from error
    return HttpClient(address, served, http, redact, Retries(retries, sleep, random), timeout_s)


class HttpClient:
    """One model behind HTTP, to be used from any number of threads.

    Requests run on an event loop of its own, in a thread of its own, so that connections are kept from one to the
    next, whether or not the caller has an event loop.
    """

    def __init__(
        self,
        address: Address,
        served: "Model[Any]",
        http: "AsyncClient",
        redact: Redactor,
        retries: Retries,
        timeout_s: float,
    ) -> None:
        self.model = address.model
        self.attempts = 0
        """HTTP requests sent so far, failed ones among them."""
        self._address = address
        self._served = served
        self._redact = redact
        self._retries = retries
        self._timeout_s = timeout_s
        self._offers_logprobs = address.provider == "openai"
        self._knows_json_schema = address.is_compatible
        """Whether to ask for a JSON Schema in OpenAI's words, as long as the server has not refused them."""
        self._background = _Background()
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
            return self._background.run(self._send(request))

        outcome = self._retries.run(send)
        if isinstance(outcome, Failure):
            # Raised outside any handler: the library's error, and with it the server's unredacted words, stays behind.
            raise GroundingError(self._explain(outcome, tries))
        return outcome

    async def _send(self, request: Request) -> Completion | Failure:
        asks_logprobs = self._offers_logprobs and is_sampled(self._served, request.is_thinking)
        outcome = await self._ask(request, asks_logprobs)
        if self._knows_json_schema and isinstance(outcome, Failure) and _refuses_json_schema(outcome):
            self._knows_json_schema = False
            outcome = await self._ask(request, asks_logprobs)
        if asks_logprobs and isinstance(outcome, Failure) and _refuses_logprobs(outcome):
            self._offers_logprobs = False
            outcome = await self._ask(request, False)
        return outcome

    async def _ask(self, request: Request, asks_logprobs: bool) -> Completion | Failure:
        from pydantic_ai import direct  # noqa: PLC0415 - the extra may be missing
        from pydantic_ai.exceptions import AgentRunError, UserError  # noqa: PLC0415
        from pydantic_ai.messages import ModelRequest  # noqa: PLC0415
        from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415

        settings = make_settings(self._address, self._served, request, asks_logprobs)
        settings |= {"timeout": self._timeout_s, "request_timeout": self._timeout_s, "max_retries": 0}
        parameters = make_parameters(self._served, request, self._address.is_compatible)
        if self._address.is_compatible and not self._knows_json_schema:
            parameters = ModelRequestParameters()
            body = {**settings.get("extra_body", {}), "response_format": older_format(request)}
            settings |= {"extra_body": body}
        self.attempts += 1
        try:
            response = await direct.model_request(
                self._served,
                [ModelRequest.user_text_prompt(request.user, instructions=request.system)],
                model_settings=cast("ModelSettings", settings),
                model_request_parameters=parameters,
                instrument=False,
            )
        except AgentRunError as error:
            return read_failure(error, self._redact)
        except UserError as error:
            return Failure(self._redact(str(error)))
        return read_completion(response)

    def _explain(self, failure: Failure, tries: int) -> str:
        status = "no readable answer" if failure.status is None else f"status {failure.status}"
        after = "" if tries == 1 else f" after {tries} tries"
        key_variable = KEY_VARIABLES[self._address.provider][0]
        return (
            f"model '{self.model}': {self._address.url}: {status}{after}: {failure.message}; "
            f"{advise(failure, key_variable)}"
        )


class _Background:
    """An event loop in a daemon thread."""

    def __init__(self) -> None:
        self._loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._serve, name="usd2kg-llm", daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        try:
            self._loop.run_forever()
        finally:
            self._loop.close()

    def run(self, work: Coroutine[Any, Any, _T]) -> _T:
        """Return what the work returns; where the caller is interrupted, the work is cancelled."""
        future = asyncio.run_coroutine_threadsafe(work, self._loop)
        try:
            return future.result()
        finally:
            future.cancel()

    def stop(self, last: Callable[[], Coroutine[Any, Any, None]]) -> None:
        """Do the last work, then end the thread and close the loop."""

        async def finish() -> None:
            pending = asyncio.all_tasks() - {asyncio.current_task()}
            for task in pending:
                task.cancel()
            await asyncio.gather(*pending, return_exceptions=True)
            await last()
            await self._loop.shutdown_asyncgens()
            self._loop.stop()

        asyncio.run_coroutine_threadsafe(finish(), self._loop)
        # The garbage collector may drop the client in its own thread.
        if threading.current_thread() is not self._thread:
            self._thread.join()


def _open_http(address: Address, timeout_s: float) -> "AsyncClient":
    import httpx2  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.models import create_async_httpx2_client  # noqa: PLC0415

    timeout = httpx2.Timeout(timeout_s, connect=min(timeout_s, _LONGEST_CONNECT_S), pool=None)
    # A transport of one's own keeps requests to this machine from going through a proxy.
    transport = httpx2.AsyncHTTPTransport() if address.is_loopback else None
    return create_async_httpx2_client(timeout=timeout, transport=transport)


def _serve_google(address: Address, key: str, http: "AsyncClient") -> "Model[Any]":
    from pydantic_ai.models.google import GoogleModel  # noqa: PLC0415
    from pydantic_ai.providers.google import GoogleProvider  # noqa: PLC0415

    return GoogleModel(address.name, provider=GoogleProvider(api_key=key, base_url=address.url, http_client=http))


def _serve_anthropic(address: Address, key: str, http: "AsyncClient") -> "Model[Any]":
    from anthropic import AsyncAnthropic  # noqa: PLC0415
    from pydantic_ai.models.anthropic import AnthropicModel  # noqa: PLC0415
    from pydantic_ai.providers.anthropic import AnthropicProvider  # noqa: PLC0415

    client = AsyncAnthropic(api_key=key, base_url=address.url, http_client=http, max_retries=0)
    return AnthropicModel(address.name, provider=AnthropicProvider(anthropic_client=client))


def _serve_openai(address: Address, key: str, http: "AsyncClient") -> "Model[Any]":
    from pydantic_ai.models.openai import OpenAIChatModel  # noqa: PLC0415
    from pydantic_ai.profiles.openai import OpenAIModelProfile  # noqa: PLC0415
    from pydantic_ai.providers.openai import OpenAIProvider  # noqa: PLC0415

    # What the library knows by a model's name holds at OpenAI; other servers get the plain protocol.
    plain = OpenAIModelProfile(
        json_schema_transformer=None,
        supports_json_schema_output=True,
        supports_thinking=False,
        thinking_always_enabled=False,
        openai_supports_reasoning=False,
        openai_system_prompt_role="system",
        openai_chat_supports_max_completion_tokens=False,
    )
    provider = OpenAIProvider(base_url=address.url, api_key=key, http_client=http)
    return OpenAIChatModel(address.name, provider=provider, profile=plain if address.is_compatible else None)


_SERVED: dict[str, Callable[[Address, str, "AsyncClient"], "Model[Any]"]] = {
    "google": _serve_google,
    "anthropic": _serve_anthropic,
    "openai": _serve_openai,
}


def _refuses_json_schema(failure: Failure) -> bool:
    # llama-cpp-python's server answers 500 for a form of answer that it does not know.
    return failure.status in (400, 422, 500) and "response_format" in failure.message


def _refuses_logprobs(failure: Failure) -> bool:
    # OpenAI answers 403 for models that do not offer them, servers that check fields 422.
    return failure.status in (400, 403, 422) and "logprob" in failure.message.lower()
