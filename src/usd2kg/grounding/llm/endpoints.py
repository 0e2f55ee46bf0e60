"""find_endpoint: the URL of a service with one endpoint per customer or region: Azure OpenAI or Amazon Bedrock."""

import re
from collections.abc import Callable, Mapping
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError

__all__ = ["API_VERSION_VARIABLE", "find_endpoint", "find_region", "find_url_problem"]

API_VERSION_VARIABLE = "OPENAI_API_VERSION"
"""Names a dated version of Azure's API, such as `2024-10-21`; without it, requests go to the undated API, `v1`."""
_AZURE_VARIABLE = "AZURE_OPENAI_ENDPOINT"
_BEDROCK_VARIABLE = "AWS_ENDPOINT_URL_BEDROCK_RUNTIME"
_REGION_VARIABLES = ("AWS_REGION", "AWS_DEFAULT_REGION")
_REGION = re.compile(r"[a-z0-9]+(-[a-z0-9]+)+")


def find_url_problem(url: str) -> str | None:
    """Return the problem with the base URL of a server, or None. The message omits the URL: it may hold a password."""
    try:
        parts = urlsplit(url)
        is_valid = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:
        is_valid = False
    if not is_valid:
        return "no host and port in its URL"
    if parts.username is not None or parts.query or parts.fragment:
        return "its URL contains a user, a query or a fragment"
    return None


def find_endpoint(provider: str, environment: Mapping[str, str]) -> str:
    """Return the base URL of a customer's service, from the environment.

    Args:
        provider: `azure` or `bedrock`.
        environment: the environment variables.

    Raises:
        GroundingError: a variable is missing or malformed.
    """
    return _ENDPOINTS[provider](environment)


def _find_azure(environment: Mapping[str, str]) -> str:
    url = _read_url(_AZURE_VARIABLE, environment)
    if not url:
        raise GroundingError(
            "azure: no endpoint in the environment; expected one like https://NAME.openai.azure.com "
            f"in {_AZURE_VARIABLE}"
        )
    is_dated = bool(environment.get(API_VERSION_VARIABLE, "").strip())
    if url.endswith("/v1"):
        return url
    url = url.removesuffix("/openai")
    return url if is_dated else f"{url}/openai/v1"


def _find_bedrock(environment: Mapping[str, str]) -> str:
    return _read_url(_BEDROCK_VARIABLE, environment) or (
        f"https://bedrock-runtime.{find_region(environment)}.amazonaws.com"
    )


def find_region(environment: Mapping[str, str]) -> str:
    """Return the AWS region, which is part of the URL and of each signature.

    Raises:
        GroundingError: it is missing or malformed.
    """
    region = next((found for name in _REGION_VARIABLES if (found := environment.get(name, "").strip())), "")
    if not _REGION.fullmatch(region):
        raise GroundingError(
            f"bedrock: no region in the environment; expected one like us-east-1 in {' or '.join(_REGION_VARIABLES)}"
        )
    return region


def _read_url(variable: str, environment: Mapping[str, str]) -> str:
    """Return the URL in a variable without a slash at its end; empty if there is none."""
    url = environment.get(variable, "").strip().rstrip("/")
    if url and (problem := find_url_problem(url)) is not None:
        raise GroundingError(f"{variable}: {problem}; expected only scheme, host, port and path")
    return url


_ENDPOINTS: dict[str, Callable[[Mapping[str, str]], str]] = {"azure": _find_azure, "bedrock": _find_bedrock}
