"""Provider models of pydantic-ai, and the HTTP client that they share."""

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from contextvars import ContextVar
from functools import cache
from typing import TYPE_CHECKING, Any

from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.model_reference import ModelReference

if TYPE_CHECKING:
    from ssl import SSLContext

    from httpx2 import AsyncClient, Response
    from pydantic_ai.models import Model

__all__ = ["closing_responses", "make_provider_model", "open_http"]

_opened: ContextVar["list[Response]"] = ContextVar("opened")


def open_http(reference: ModelReference, timeout_s: float) -> "AsyncClient":
    """Return an HTTP client for a server.

    Raises:
        ImportError: the extra `llm` is not installed.
    """
    import httpx2  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.models import create_async_httpx2_client  # noqa: PLC0415

    timeout = httpx2.Timeout(timeout_s, connect=min(timeout_s, LIMITS.connect_timeout_s), pool=None)
    # An explicit transport bypasses the proxies of the environment.
    transport = httpx2.AsyncHTTPTransport(verify=_tls_context()) if reference.is_loopback else None
    http = create_async_httpx2_client(timeout=timeout, transport=transport)
    http.event_hooks = {"response": [_record_response]}
    return http


@cache
def _tls_context() -> "SSLContext":
    """Return the default settings of TLS; reading the certificates takes 40 ms."""
    import httpx2  # noqa: PLC0415 - the extra may be missing

    return httpx2.create_ssl_context()


async def _record_response(response: "Response") -> None:
    _opened.get().append(response)


@asynccontextmanager
async def closing_responses() -> AsyncIterator[None]:
    """Close all responses received inside the block; a response that is not read to its end loses its connection.

    Google's library leaves this to the garbage collector.
    """
    opened: list[Response] = []
    token = _opened.set(opened)
    try:
        yield
    finally:
        _opened.reset(token)
        for response in opened:
            await response.aclose()


def make_provider_model(reference: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    """Return the pydantic-ai model for a model reference.

    Raises:
        ImportError: the extra `llm` is not installed.
    """
    return _MODEL_FACTORIES[reference.provider](reference, key, http)


def _make_google(reference: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    from pydantic_ai.models.google import GoogleModel  # noqa: PLC0415
    from pydantic_ai.providers.google import GoogleProvider  # noqa: PLC0415

    return GoogleModel(reference.name, provider=GoogleProvider(api_key=key, base_url=reference.url, http_client=http))


def _make_anthropic(reference: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    from anthropic import AsyncAnthropic  # noqa: PLC0415
    from pydantic_ai.models.anthropic import AnthropicModel  # noqa: PLC0415
    from pydantic_ai.providers.anthropic import AnthropicProvider  # noqa: PLC0415

    client = AsyncAnthropic(api_key=key, base_url=reference.url, http_client=http, max_retries=0)
    return AnthropicModel(reference.name, provider=AnthropicProvider(anthropic_client=client))


def _make_openai(reference: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    from pydantic_ai.models.openai import OpenAIChatModel  # noqa: PLC0415
    from pydantic_ai.profiles.openai import OpenAIModelProfile  # noqa: PLC0415
    from pydantic_ai.providers.openai import OpenAIProvider  # noqa: PLC0415

    # The library infers features from OpenAI's model names. For other servers, use the basic protocol only.
    plain = OpenAIModelProfile(
        json_schema_transformer=None,
        supports_json_schema_output=True,
        supports_thinking=False,
        thinking_always_enabled=False,
        openai_supports_reasoning=False,
        openai_system_prompt_role="system",
        openai_chat_supports_max_completion_tokens=False,
    )
    provider = OpenAIProvider(base_url=reference.url, api_key=key, http_client=http)
    return OpenAIChatModel(reference.name, provider=provider, profile=plain if reference.is_openai_compatible else None)


_MODEL_FACTORIES: dict[str, Callable[[ModelReference, str, "AsyncClient"], "Model[Any]"]] = {
    "google": _make_google,
    "anthropic": _make_anthropic,
    "openai": _make_openai,
}
