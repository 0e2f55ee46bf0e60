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
from dataclasses import dataclass
from ipaddress import ip_address
from statistics import fmean
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self, TypeVar, cast
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.retry import Failure, Redactor, Retries, advise, read_failure

if TYPE_CHECKING:
    from httpx2 import AsyncClient
    from pydantic_ai.messages import ModelResponse
    from pydantic_ai.models import Model, ModelRequestParameters
    from pydantic_ai.settings import ModelSettings

__all__ = ["HttpClient", "make_client"]

_T = TypeVar("_T")

_KEY_VARIABLES = {
    "google": ("GOOGLE_API_KEY", "GEMINI_API_KEY"),
    "anthropic": ("ANTHROPIC_API_KEY",),
    "openai": ("OPENAI_API_KEY",),
}
_ADDRESSES = {
    "google": "https://generativelanguage.googleapis.com",
    "anthropic": "https://api.anthropic.com",
    "openai": "https://api.openai.com/v1",
}
_EXPECTED = (
    "expected google:NAME, anthropic:NAME or openai:NAME, with @http://HOST:PORT/v1 behind it for another server"
)
_LONGEST_CONNECT_S = 10.0
_NO_KEY = "none"
"""Sent to loopback servers without a key, as the library insists on one."""

_LEAST_REASONING_TOKENS = 1024
"""https://platform.claude.com/docs/en/build-with-claude/extended-thinking: the smallest budget of Claude models."""


@dataclass(frozen=True, slots=True)
class _Address:
    """A model string, taken apart."""

    model: str
    provider: str
    name: str
    url: str
    is_own_server: bool
    """Whether the user named the server."""

    @property
    def is_loopback(self) -> bool:
        host = urlsplit(self.url).hostname or ""
        try:
            return ip_address(host).is_loopback
        except ValueError:
            return host == "localhost" or host.endswith(".localhost")

    @property
    def is_compatible(self) -> bool:
        """Whether this is a server that speaks OpenAI's language without being OpenAI's."""
        return self.provider == "openai" and self.is_own_server


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
    address = _parse(model)
    key = _find_key(address, environment)
    redact = Redactor(
        [key, *(environment.get(name, "").strip() for names in _KEY_VARIABLES.values() for name in names)]
    )
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
        address: _Address,
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
        asks_logprobs = self._offers_logprobs and _is_sampled(self._served, request.is_thinking)
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

        settings = _make_settings(self._address, self._served, request, asks_logprobs)
        settings |= {"timeout": self._timeout_s, "request_timeout": self._timeout_s, "max_retries": 0}
        parameters = _make_parameters(self._served, request, self._address.is_compatible)
        if self._address.is_compatible and not self._knows_json_schema:
            parameters = ModelRequestParameters()
            body = {**settings.get("extra_body", {}), "response_format": _older_format(request)}
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
        return _read_completion(response)

    def _explain(self, failure: Failure, tries: int) -> str:
        status = "no readable answer" if failure.status is None else f"status {failure.status}"
        after = "" if tries == 1 else f" after {tries} tries"
        key_variable = _KEY_VARIABLES[self._address.provider][0]
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


def _parse(model: str) -> _Address:
    provider, _, rest = model.partition(":")
    # A model's name may hold an @, an address begins with a scheme.
    at = max(rest.find("@http://"), rest.find("@https://"))
    name, url = (rest, None) if at < 0 else (rest[:at], rest[at + 1 :].rstrip("/"))
    if provider not in _ADDRESSES or not name or any(map(str.isspace, model)):
        raise GroundingError(f"model '{Redactor([])(model)}': no provider and name in it; {_EXPECTED}")
    if url is not None:
        _check_url(provider, name, url)
    return _Address(model, provider, name, url or _ADDRESSES[provider], url is not None)


def _check_url(provider: str, name: str, url: str) -> None:
    try:
        parts = urlsplit(url)
        is_address = bool(parts.hostname) and parts.port != 0
    except ValueError:
        is_address = False
    # The address itself is not repeated: what is wrong with it may be a password inside.
    if not is_address:
        raise GroundingError(f"model '{provider}:{name}@…': no host and port in its address; {_EXPECTED}")
    if parts.username is not None or parts.query or parts.fragment:
        raise GroundingError(
            f"model '{provider}:{name}@…': its address holds a user, a query or a fragment; "
            f"expected scheme, host, port and path alone, put the key into {_KEY_VARIABLES[provider][0]}"
        )


def _find_key(address: _Address, environment: Mapping[str, str]) -> str:
    names = _KEY_VARIABLES[address.provider]
    key = next((key for name in names if (key := environment.get(name, "").strip())), "")
    if not key and not address.is_loopback:
        raise GroundingError(
            f"model '{address.model}': no key in the environment; expected one, set {' or '.join(names)}"
        )
    if not (key.isascii() and key.isprintable()):
        raise GroundingError(
            f"model '{address.model}': the key holds characters that no header can; "
            f"expected printable ASCII, set {' or '.join(names)} anew"
        )
    return key or _NO_KEY


def _open_http(address: _Address, timeout_s: float) -> "AsyncClient":
    import httpx2  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.models import create_async_httpx2_client  # noqa: PLC0415

    timeout = httpx2.Timeout(timeout_s, connect=min(timeout_s, _LONGEST_CONNECT_S), pool=None)
    # A transport of one's own keeps requests to this machine from going through a proxy.
    transport = httpx2.AsyncHTTPTransport() if address.is_loopback else None
    return create_async_httpx2_client(timeout=timeout, transport=transport)


def _serve_google(address: _Address, key: str, http: "AsyncClient") -> "Model[Any]":
    from pydantic_ai.models.google import GoogleModel  # noqa: PLC0415
    from pydantic_ai.providers.google import GoogleProvider  # noqa: PLC0415

    return GoogleModel(address.name, provider=GoogleProvider(api_key=key, base_url=address.url, http_client=http))


def _serve_anthropic(address: _Address, key: str, http: "AsyncClient") -> "Model[Any]":
    from anthropic import AsyncAnthropic  # noqa: PLC0415
    from pydantic_ai.models.anthropic import AnthropicModel  # noqa: PLC0415
    from pydantic_ai.providers.anthropic import AnthropicProvider  # noqa: PLC0415

    client = AsyncAnthropic(api_key=key, base_url=address.url, http_client=http, max_retries=0)
    return AnthropicModel(address.name, provider=AnthropicProvider(anthropic_client=client))


def _serve_openai(address: _Address, key: str, http: "AsyncClient") -> "Model[Any]":
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


_SERVED: dict[str, Callable[[_Address, str, "AsyncClient"], "Model[Any]"]] = {
    "google": _serve_google,
    "anthropic": _serve_anthropic,
    "openai": _serve_openai,
}


def _make_parameters(served: "Model[Any]", request: Request, is_compatible: bool) -> "ModelRequestParameters":
    """How the answer must look: enforced by the server where it can, in the prompt where it cannot."""
    from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415
    from pydantic_ai.output import OutputObjectDefinition  # noqa: PLC0415

    is_enforced = served.profile.get("supports_json_schema_output", False)
    # At OpenAI's own the library finds out whether strict mode takes the schema.
    answer = OutputObjectDefinition(dict(request.schema), name="answer", strict=True if is_compatible else None)
    return ModelRequestParameters(output_mode="native" if is_enforced else "prompted", output_object=answer)


def _make_settings(address: _Address, served: "Model[Any]", request: Request, asks_logprobs: bool) -> dict[str, Any]:
    """What goes with the prompt, in the library's words."""
    settings: dict[str, Any] = {"max_tokens": request.most_tokens}
    if _is_sampled(served, request.is_thinking):
        settings["temperature"] = request.temperature
    if asks_logprobs:
        settings["openai_logprobs"] = True
    if served.profile.get("supports_thinking", False):
        settings["thinking"] = request.is_thinking
    if address.provider == "anthropic":
        return settings | {"anthropic_cache_instructions": True} | _budget_reasoning(address, served, request)
    if address.is_compatible:
        settings |= _switch_reasoning(address, request.is_thinking)
    return settings | {"seed": request.sample}


def _is_sampled(served: "Model[Any]", is_thinking: bool) -> bool:
    """Whether the model takes a temperature: some that reason refuse it, with a warning or a status 400."""
    profile = cast("Mapping[str, Any]", served.profile)
    if profile.get("openai_supports_reasoning", False):
        efforts = profile.get("openai_reasoning_efforts")
        can_stop = profile.get("openai_supports_reasoning_effort_none", False) if efforts is None else "none" in efforts
        return can_stop and not is_thinking
    if served.system == "anthropic":
        always = profile.get("thinking_always_enabled", False)
        return not (is_thinking or always or profile.get("anthropic_disallows_sampling_settings", False))
    return True


def _budget_reasoning(address: _Address, served: "Model[Any]", request: Request) -> dict[str, Any]:
    """Half of the output tokens for models of Anthropic that need to be told how long they may reason."""
    profile = cast("Mapping[str, Any]", served.profile)
    if not request.is_thinking or profile.get("anthropic_supports_adaptive_thinking", False):
        return {}
    budget = request.most_tokens // 2
    if budget < _LEAST_REASONING_TOKENS:
        raise GroundingError(
            f"model '{address.model}': {request.most_tokens} output tokens leave no room to think; "
            f"expected at least {2 * _LEAST_REASONING_TOKENS}, allow more or switch thinking off"
        )
    return {"anthropic_thinking": {"type": "enabled", "budget_tokens": budget}}


def _switch_reasoning(address: _Address, is_thinking: bool) -> dict[str, Any]:
    """The field of the request that turns reasoning on or off, which every server names its own way.

    Left out when off, save for Qwen models: they reason unless told not to.
    """
    if not is_thinking and "qwen" not in address.name.lower():
        return {}
    host = urlsplit(address.url).hostname or ""
    if host.endswith(".aliyuncs.com"):
        return {"extra_body": {"enable_thinking": is_thinking}}
    if host == "openrouter.ai":
        return {"extra_body": {"reasoning": {"enabled": is_thinking}}}
    return {"extra_body": {"chat_template_kwargs": {"enable_thinking": is_thinking}}}


def _read_completion(response: "ModelResponse") -> Completion:
    from pydantic_ai.messages import TextPart, ThinkingPart  # noqa: PLC0415

    usage = response.usage
    return Completion(
        "".join(part.content for part in response.parts if isinstance(part, TextPart)),
        Finish.LENGTH if response.finish_reason == "length" else Finish.STOP,
        Usage(usage.input_tokens, usage.cache_read_tokens, usage.output_tokens),
        _average_logprob(response.provider_details or {}),
        "".join(part.content for part in response.parts if isinstance(part, ThinkingPart)),
    )


def _average_logprob(details: Mapping[str, Any]) -> float | None:
    logprobs = [float(token["logprob"]) for token in details.get("logprobs", ())]
    return fmean(logprobs) if logprobs else None


def _older_format(request: Request) -> dict[str, Any]:
    """The schema in the words of llama-cpp-python's server, which enforces it by a grammar."""
    return {"type": "json_object", "schema": dict(request.schema)}


def _refuses_json_schema(failure: Failure) -> bool:
    # llama-cpp-python's server answers 500 for a form of answer that it does not know.
    return failure.status in (400, 422, 500) and "response_format" in failure.message


def _refuses_logprobs(failure: Failure) -> bool:
    # OpenAI answers 403 for models that do not offer them, servers that check fields 422.
    return failure.status in (400, 403, 422) and "logprob" in failure.message.lower()
