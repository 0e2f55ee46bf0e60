"""Which model a string names, where it is served, and which key opens it.

A model is named `google:NAME`, `anthropic:NAME` or `openai:NAME`, each with `@URL` behind it for another address.
Keys come from the environment, never from the name.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from ipaddress import ip_address
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.retry import Redactor

__all__ = ["KEY_VARIABLES", "PROVIDER_URLS", "ModelReference", "find_key", "parse_model_reference"]

KEY_VARIABLES = {
    "google": ("GOOGLE_API_KEY", "GEMINI_API_KEY"),
    "anthropic": ("ANTHROPIC_API_KEY",),
    "openai": ("OPENAI_API_KEY",),
}
PROVIDER_URLS = {
    "google": "https://generativelanguage.googleapis.com",
    "anthropic": "https://api.anthropic.com",
    "openai": "https://api.openai.com/v1",
}
_EXPECTED = (
    "expected google:NAME, anthropic:NAME or openai:NAME, with @http://HOST:PORT/v1 behind it for another server"
)
_NO_KEY = "none"
"""Sent to loopback servers without a key, as the library insists on one."""


@dataclass(frozen=True, slots=True)
class ModelReference:
    """A model string, taken apart."""

    model: str
    provider: str
    name: str
    url: str
    has_custom_url: bool
    """Whether the user named the server."""

    @property
    def is_loopback(self) -> bool:
        """Whether the server is this machine."""
        host = urlsplit(self.url).hostname or ""
        try:
            return ip_address(host).is_loopback
        except ValueError:
            return host == "localhost" or host.endswith(".localhost")

    @property
    def is_openai_compatible(self) -> bool:
        """Whether this is a server that speaks OpenAI's language without being OpenAI's."""
        return self.provider == "openai" and self.has_custom_url


def parse_model_reference(model: str) -> ModelReference:
    """Return a model string taken apart.

    Raises:
        GroundingError: it names no known provider and model, or its address is none or holds a secret.
    """
    provider, _, rest = model.partition(":")
    # A model's name may hold an @, an address begins with a scheme.
    at = max(rest.find("@http://"), rest.find("@https://"))
    name, url = (rest, None) if at < 0 else (rest[:at], rest[at + 1 :].rstrip("/"))
    if provider not in PROVIDER_URLS or not name or any(map(str.isspace, model)):
        raise GroundingError(f"model '{Redactor([])(model)}': no provider and name in it; {_EXPECTED}")
    if url is not None:
        _check_url(provider, name, url)
    return ModelReference(model, provider, name, url or PROVIDER_URLS[provider], url is not None)


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
            f"expected scheme, host, port and path alone, put the key into {KEY_VARIABLES[provider][0]}"
        )


def find_key(address: ModelReference, environment: Mapping[str, str]) -> str:
    """Return the key for a model from the environment; servers of this machine need none.

    Raises:
        GroundingError: there is none, or it cannot stand in a header.
    """
    names = KEY_VARIABLES[address.provider]
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
