"""ModelReference: provider, model name and URL from a model string, and the API key from the environment.

A model string is `google:NAME`, `anthropic:NAME` or `openai:NAME`, optionally followed by `@URL` for another server,
`azure:DEPLOYMENT` or `bedrock:MODEL`, whose URL is in the environment.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from ipaddress import ip_address
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.endpoints import find_endpoint, find_url_problem
from usd2kg.grounding.llm.retry import Redactor

__all__ = [
    "KEY_VARIABLES",
    "PROVIDER_URLS",
    "SECRET_VARIABLES",
    "ModelReference",
    "add_endpoint",
    "find_key",
    "parse_model_reference",
]

KEY_VARIABLES = {
    "google": ("GOOGLE_API_KEY", "GEMINI_API_KEY"),
    "anthropic": ("ANTHROPIC_API_KEY",),
    "openai": ("OPENAI_API_KEY",),
    "azure": ("AZURE_OPENAI_API_KEY",),
    "bedrock": ("AWS_BEARER_TOKEN_BEDROCK", "AWS_ACCESS_KEY_ID"),
}
"""Provider → environment variables of its API key, in order of precedence."""
SECRET_VARIABLES = (
    *(name for names in KEY_VARIABLES.values() for name in names),
    "AWS_SECRET_ACCESS_KEY",
    "AWS_SESSION_TOKEN",
)
"""Environment variables that no message may show."""
PROVIDER_URLS = {
    "google": "https://generativelanguage.googleapis.com",
    "anthropic": "https://api.anthropic.com",
    "openai": "https://api.openai.com/v1",
}
"""Provider → base URL of its own service."""
_EXPECTED = (
    "expected google:NAME, anthropic:NAME or openai:NAME, optionally followed by @http://HOST:PORT/v1, "
    "azure:DEPLOYMENT or bedrock:MODEL"
)
_NO_KEY = "none"
"""Placeholder for loopback servers without a key, since the client libraries require one."""


@dataclass(frozen=True, slots=True)
class ModelReference:
    """A parsed model string."""

    model: str
    """The model string itself."""
    provider: str
    name: str
    url: str
    """Base URL of the server; empty until `add_endpoint` for a provider without one URL for all customers."""
    has_custom_url: bool
    """Whether the URL is in the model string."""

    @property
    def is_loopback(self) -> bool:
        """Whether the server runs on this machine."""
        host = urlsplit(self.url).hostname or ""
        try:
            return ip_address(host).is_loopback
        except ValueError:
            return host == "localhost" or host.endswith(".localhost")

    @property
    def is_openai_compatible(self) -> bool:
        """Whether the server implements OpenAI's API but is not run by OpenAI."""
        return self.provider == "openai" and self.has_custom_url


def parse_model_reference(model: str) -> ModelReference:
    """Return the parts of a model string.

    Raises:
        GroundingError: the provider is unknown, the name is missing, or the URL has no scheme, is malformed or contains
            credentials.
    """
    provider, _, rest = model.partition(":")
    # A model name may contain an @ if a URL follows it; the URL begins with its scheme.
    at = max(rest.find("@http://"), rest.find("@https://"))
    name, url = (rest, None) if at < 0 else (rest[:at], rest[at + 1 :].rstrip("/"))
    if provider not in KEY_VARIABLES or not name or any(map(str.isspace, model)):
        raise GroundingError(f"model '{Redactor([])(model)}': no known provider and name; {_EXPECTED}")
    if url is None and "@" in name:
        # No service of a provider has such a name. Its own URL would get prompts and key that are meant for the server.
        raise GroundingError(
            f"model '{provider}:{name.partition('@')[0]}@…': no http:// or https:// after the @; {_EXPECTED}"
        )
    if url is not None:
        _check_url(provider, name, url)
    return ModelReference(model, provider, name, url or PROVIDER_URLS.get(provider, ""), url is not None)


def add_endpoint(reference: ModelReference, environment: Mapping[str, str]) -> ModelReference:
    """Return the reference with its URL, which for Azure and Bedrock is in the environment.

    Raises:
        GroundingError: a variable is missing or malformed.
    """
    return reference if reference.url else replace(reference, url=find_endpoint(reference.provider, environment))


def _check_url(provider: str, name: str, url: str) -> None:
    # The messages omit the URL, since it may contain a password.
    problem = find_url_problem(url)
    if provider not in PROVIDER_URLS:
        raise GroundingError(
            f"model '{provider}:{name}@…': a URL in the model string; expected it in the environment, see docs/llm.md"
        )
    if problem is not None:
        raise GroundingError(
            f"model '{provider}:{name}@…': {problem}; expected only scheme, host, port and path, "
            f"put the key into {KEY_VARIABLES[provider][0]}"
        )


def find_key(reference: ModelReference, environment: Mapping[str, str]) -> str:
    """Return the API key of a model from the environment, or a placeholder for servers on this machine.

    Raises:
        GroundingError: the key is missing or is not printable ASCII.
    """
    names = KEY_VARIABLES[reference.provider]
    key = next((key for name in names if (key := environment.get(name, "").strip())), "")
    if not key and not reference.is_loopback:
        raise GroundingError(
            f"model '{reference.model}': no key in the environment; expected one, set {' or '.join(names)}"
        )
    if not (key.isascii() and key.isprintable()):
        raise GroundingError(
            f"model '{reference.model}': the key contains characters that an HTTP header cannot; "
            f"expected printable ASCII, correct {' or '.join(names)}"
        )
    return key or _NO_KEY
