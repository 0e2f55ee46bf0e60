"""The library's models of each provider, at the user's address and with the user's key."""

from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

from usd2kg.grounding.llm.model_reference import ModelReference

if TYPE_CHECKING:
    from httpx2 import AsyncClient, Response
    from pydantic_ai.models import Model

__all__ = ["closing_responses", "make_provider_model", "open_http"]

_LONGEST_CONNECT_S = 10.0

_opened: ContextVar["list[Response]"] = ContextVar("opened")


def open_http(address: ModelReference, timeout_s: float) -> "AsyncClient":
    """Return the connections to a server.

    Raises:
        ImportError: the extra `llm` is not installed.
    """
    import httpx2  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.models import create_async_httpx2_client  # noqa: PLC0415

    timeout = httpx2.Timeout(timeout_s, connect=min(timeout_s, _LONGEST_CONNECT_S), pool=None)
    # A transport of one's own keeps requests to this machine from going through a proxy.
    transport = httpx2.AsyncHTTPTransport() if address.is_loopback else None
    http = create_async_httpx2_client(timeout=timeout, transport=transport)
    http.event_hooks = {"response": [_remember]}
    return http


async def _remember(response: "Response") -> None:
    _opened.get().append(response)


@asynccontextmanager
async def closing_responses() -> AsyncIterator[None]:
    """Close the responses to all that is sent inside, with their connections where they are not read to their ends.

    Google's library leaves those to the garbage collector.
    """
    opened: list[Response] = []
    token = _opened.set(opened)
    try:
        yield
    finally:
        _opened.reset(token)
        for response in opened:
            await response.aclose()


def make_provider_model(address: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    """Return the library's model of that name at that address.

    Raises:
        ImportError: the extra `llm` is not installed.
    """
    return _SERVED[address.provider](address, key, http)


def _serve_google(address: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    from pydantic_ai.models.google import GoogleModel  # noqa: PLC0415
    from pydantic_ai.providers.google import GoogleProvider  # noqa: PLC0415

    return GoogleModel(address.name, provider=GoogleProvider(api_key=key, base_url=address.url, http_client=http))


def _serve_anthropic(address: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
    from anthropic import AsyncAnthropic  # noqa: PLC0415
    from pydantic_ai.models.anthropic import AnthropicModel  # noqa: PLC0415
    from pydantic_ai.providers.anthropic import AnthropicProvider  # noqa: PLC0415

    client = AsyncAnthropic(api_key=key, base_url=address.url, http_client=http, max_retries=0)
    return AnthropicModel(address.name, provider=AnthropicProvider(anthropic_client=client))


def _serve_openai(address: ModelReference, key: str, http: "AsyncClient") -> "Model[Any]":
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
    return OpenAIChatModel(address.name, provider=provider, profile=plain if address.is_openai_compatible else None)


_SERVED: dict[str, Callable[[ModelReference, str, "AsyncClient"], "Model[Any]"]] = {
    "google": _serve_google,
    "anthropic": _serve_anthropic,
    "openai": _serve_openai,
}
