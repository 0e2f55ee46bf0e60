"""make_bedrock_model: models of Amazon Bedrock's Converse API, with credentials from the environment alone."""

import logging
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.endpoints import find_region
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.model_reference import ModelReference

if TYPE_CHECKING:
    from pydantic_ai.models import Model

__all__ = ["make_bedrock_model"]

_ID, _SECRET, _SESSION = "AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY", "AWS_SESSION_TOKEN"
_BEARER = "AWS_BEARER_TOKEN_BEDROCK"
_MAX_CONNECTIONS = 64
"""The largest `--concurrency`."""


def make_bedrock_model(
    reference: ModelReference, key: str, environment: Mapping[str, str], timeout_s: float
) -> "Model[Any]":
    """Return the pydantic-ai model for a model of Bedrock.

    Requests are signed with the access key of the environment, or have an API key of Bedrock as bearer token.

    Args:
        reference: the model.
        key: the API key of Bedrock or the access key's id.
        environment: the environment variables, with the secret of the access key.
        timeout_s: seconds to wait for a response, and for each part of it.

    Raises:
        ImportError: the extra `bedrock` is not installed.
        GroundingError: the secret of the access key or the region is missing, an API key would be sent unencrypted, or
            AWS's configuration files are damaged.
    """
    import boto3  # noqa: PLC0415 - the extra may be missing
    from botocore.config import Config  # noqa: PLC0415
    from botocore.exceptions import BotoCoreError  # noqa: PLC0415
    from pydantic_ai.models.bedrock import BedrockConverseModel  # noqa: PLC0415
    from pydantic_ai.providers.bedrock import BedrockProvider  # noqa: PLC0415

    # At its debug level, botocore logs bearer tokens and session tokens.
    logging.getLogger("botocore").setLevel(logging.INFO)
    is_signed = key != environment.get(_BEARER, "").strip()
    if not is_signed and not reference.url.startswith("https:"):
        raise GroundingError(
            f"model '{reference.model}': {reference.url} is not encrypted; expected https for the key in {_BEARER}, "
            f"correct the address or set {_ID} and {_SECRET} instead"
        )
    config = Config(
        connect_timeout=min(timeout_s, LIMITS.connect_timeout_s),
        read_timeout=timeout_s,
        retries={"total_max_attempts": 1},
        max_pool_connections=_MAX_CONNECTIONS,
        # Proxies of the environment are for other machines.
        proxies={} if reference.is_loopback else None,
        signature_version="v4" if is_signed else "bearer",
    )
    try:
        session = boto3.Session(
            **(_read_access_key(reference, key, environment) if is_signed else _bear(key)),
            region_name=find_region(environment),
        )
        client = session.client("bedrock-runtime", endpoint_url=reference.url, config=config)
    except BotoCoreError as error:
        raise GroundingError(
            f"model '{reference.model}': {error}; expected the configuration files of AWS to be readable, "
            "correct them or unset AWS_PROFILE"
        ) from error
    return BedrockConverseModel(reference.name, provider=BedrockProvider(bedrock_client=client))


def _read_access_key(reference: ModelReference, key: str, environment: Mapping[str, str]) -> dict[str, str | None]:
    # A server on this machine needs no key, but the client signs all requests.
    secret = environment.get(_SECRET, "").strip() if environment.get(_ID, "").strip() else key
    if not secret:
        raise GroundingError(f"model '{reference.model}': {_ID} has no secret; expected one, set {_SECRET}")
    token = environment.get(_SESSION, "").strip() or None
    return {"aws_access_key_id": key, "aws_secret_access_key": secret, "aws_session_token": token}


def _bear(key: str) -> dict[str, Any]:
    from botocore.session import Session  # noqa: PLC0415 - the extra may be missing
    from botocore.tokens import FrozenAuthToken  # noqa: PLC0415

    session = Session()
    # botocore reads bearer tokens from the variables of the process only.
    session.get_auth_token = lambda **_: FrozenAuthToken(key)
    return {"botocore_session": session}
