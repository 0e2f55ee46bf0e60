"""Clients of the fake servers, and the outcome of one request."""

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.bedrock_server import converse_reply
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import HttpClient, make_client
from usd2kg.grounding.llm.completion import Request

KEYS = {
    "OPENAI_API_KEY": "openai-secret-1",
    "GOOGLE_API_KEY": "google-secret-1",
    "ANTHROPIC_API_KEY": "anthropic-secret-1",
    "AZURE_OPENAI_API_KEY": "azure-secret-1",
    "AWS_ACCESS_KEY_ID": "aws-id-1",
    "AWS_SECRET_ACCESS_KEY": "aws-secret-1",
}
SCHEMA = {
    "type": "object",
    "properties": {"reasoning": {"type": "string"}, "class": {"type": "string", "enum": ["Knife", "Cup"]}},
    "required": ["reasoning", "class"],
    "additionalProperties": False,
}
REQUEST = Request("the classes", "the objects", SCHEMA, max_tokens=4000, temperature=0.5)
ANSWERS = {
    "openai:m": servers.openai_reply("{}"),
    "google:gemini-2.5-flash": servers.gemini_reply("{}"),
    "anthropic:claude-haiku-4-5": servers.anthropic_reply("{}"),
    "azure:gpt-4o": servers.openai_reply("{}"),
    "bedrock:us.anthropic.claude-haiku-4-5-20251001-v1:0": converse_reply("{}"),
}
every_provider = pytest.mark.parametrize("model", ANSWERS)


def connect(server, model: str, *, environment: dict[str, str] = KEYS, **options) -> HttpClient:
    endpoints = {
        "AZURE_OPENAI_ENDPOINT": server.url,
        "AWS_ENDPOINT_URL_BEDROCK_RUNTIME": server.url,
        "AWS_REGION": "eu-west-1",
    }
    defaults = {"environment": endpoints | environment, "timeout_s": 60, "max_retries": 0}
    return make_client(locate(model, server.url), **(defaults | options))


def locate(model: str, url: str) -> str:
    """Return the model string for a model at a URL; for Azure and Bedrock the environment has the URL."""
    return model if model.startswith(("azure:", "bedrock:")) else f"{model}@{url}"


def endpoint(model: str, url: str) -> str:
    """Return the base URL of requests to a server."""
    return f"{url}/openai/v1" if model.startswith("azure:") else url


def complete(model: str, *replies, request: Request = REQUEST, **options):
    """Return the completion and the requests that the server received."""
    with servers.serve(*replies) as server, connect(server, model, **options) as client:
        return client.complete(request), server.received


def fail(model: str, *replies, **options) -> tuple[str, int, str]:
    """Return the error message, the number of requests, and the URL of the server."""
    with servers.serve(*replies) as server, connect(server, model, **options) as client:
        with pytest.raises(GroundingError) as caught:
            client.complete(REQUEST)
        assert caught.value.__cause__ is None and caught.value.__context__ is None
        assert client.traffic.attempts == len(server.received)
        return str(caught.value), client.traffic.attempts, server.url
