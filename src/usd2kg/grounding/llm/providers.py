"""Provider models of pydantic-ai, and the HTTP client that they share."""

from collections.abc import AsyncIterator, Callable, Mapping
from contextlib import asynccontextmanager
from contextvars import ContextVar
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from usd2kg.grounding.llm.bedrock import make_bedrock_model
from usd2kg.grounding.llm.endpoints import API_VERSION_VARIABLE
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.model_reference import ModelReference

if TYPE_CHECKING:
    from ssl import SSLContext

    from httpx2 import AsyncClient, Response
    from pydantic_ai.models import Model
    from pydantic_ai.models.bedrock import BedrockConverseModel
    from pydantic_ai.models.openai import OpenAIChatModel
    from pydantic_ai.profiles.openai import OpenAIModelProfile

__all__ = [
    "Access",
    "close_connections",
    "closing_responses",
    "make_batch_model",
    "make_provider_model",
    "open_http",
]

_opened: ContextVar["list[Response]"] = ContextVar("opened")


class Access(NamedTuple):
    """What a model needs to send requests."""

    key: str
    http: "AsyncClient"
    """Unused by Bedrock, whose client has its own connections."""
    environment: Mapping[str, str]
    timeout_s: float


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


async def close_connections(http: "AsyncClient", provider_model: "Model[Any]") -> None:
    """Close the connections of a model."""
    await http.aclose()
    if provider_model.system == "bedrock":
        # It has connections of its own, which its library leaves open.
        cast("BedrockConverseModel", provider_model).client.close()


def make_provider_model(reference: ModelReference, access: Access) -> "Model[Any]":
    """Return the pydantic-ai model for a model reference.

    Raises:
        ImportError: the extra `llm`, or `bedrock`, is not installed.
        GroundingError: the settings of Bedrock are incomplete.
    """
    return _MODEL_FACTORIES[reference.provider](reference, access)


def make_batch_model(reference: ModelReference, provider_model: "Model[Any]") -> "Model[Any] | None":
    """Return the pydantic-ai model for batch jobs; None if the service has no batch endpoint that the library knows."""
    if reference.provider == "openai":
        from pydantic_ai.models.openai import OpenAIResponsesModel  # noqa: PLC0415
        from pydantic_ai.providers.openai import OpenAIProvider  # noqa: PLC0415

        # The library's jobs contain requests to the Responses API.
        chat = cast("OpenAIChatModel", provider_model)
        provider = OpenAIProvider(openai_client=chat.client)
        provider_model = OpenAIResponsesModel(reference.name, provider=provider, profile=_openai_profile(reference))
    return provider_model if provider_model.batch_max_requests is not None else None


def _make_google(reference: ModelReference, access: Access) -> "Model[Any]":
    from pydantic_ai.models.google import GoogleModel  # noqa: PLC0415
    from pydantic_ai.providers.google import GoogleProvider  # noqa: PLC0415

    provider = GoogleProvider(api_key=access.key, base_url=reference.url, http_client=access.http)
    return GoogleModel(reference.name, provider=provider)


def _make_anthropic(reference: ModelReference, access: Access) -> "Model[Any]":
    from anthropic import AsyncAnthropic  # noqa: PLC0415
    from pydantic_ai.models.anthropic import AnthropicModel  # noqa: PLC0415
    from pydantic_ai.providers.anthropic import AnthropicProvider  # noqa: PLC0415

    client = AsyncAnthropic(api_key=access.key, base_url=reference.url, http_client=access.http, max_retries=0)
    return AnthropicModel(reference.name, provider=AnthropicProvider(anthropic_client=client))


def _make_openai(reference: ModelReference, access: Access) -> "Model[Any]":
    from pydantic_ai.models.openai import OpenAIChatModel  # noqa: PLC0415
    from pydantic_ai.providers.openai import OpenAIProvider  # noqa: PLC0415

    provider = OpenAIProvider(base_url=reference.url, api_key=access.key, http_client=access.http)
    return OpenAIChatModel(reference.name, provider=provider, profile=_openai_profile(reference))


def _openai_profile(reference: ModelReference) -> "OpenAIModelProfile | None":
    """Return the features of a server with OpenAI's protocol; None for OpenAI itself."""
    from pydantic_ai.profiles.openai import OpenAIModelProfile  # noqa: PLC0415

    if not reference.is_openai_compatible:
        return None
    # The library infers features from OpenAI's model names. For other servers, use the basic protocol only.
    return OpenAIModelProfile(
        json_schema_transformer=None,
        supports_json_schema_output=True,
        supports_json_object_output=False,
        supports_thinking=False,
        thinking_always_enabled=False,
        openai_supports_reasoning=False,
        openai_system_prompt_role="system",
        openai_chat_supports_max_completion_tokens=False,
    )


def _make_azure(reference: ModelReference, access: Access) -> "Model[Any]":
    from pydantic_ai.models.openai import OpenAIChatModel  # noqa: PLC0415
    from pydantic_ai.providers.azure import AzureProvider  # noqa: PLC0415

    # None if the URL is that of the undated API.
    is_undated = (reference.url or "").endswith("/v1")
    version = None if is_undated else access.environment.get(API_VERSION_VARIABLE, "").strip() or None
    provider = AzureProvider(
        azure_endpoint=reference.url, api_version=version, api_key=access.key, http_client=access.http
    )
    return OpenAIChatModel(reference.name, provider=provider)


def _make_bedrock(reference: ModelReference, access: Access) -> "Model[Any]":
    return make_bedrock_model(reference, access.key, access.environment, access.timeout_s)


_MODEL_FACTORIES: dict[str, Callable[[ModelReference, Access], "Model[Any]"]] = {
    "google": _make_google,
    "anthropic": _make_anthropic,
    "openai": _make_openai,
    "azure": _make_azure,
    "bedrock": _make_bedrock,
}
