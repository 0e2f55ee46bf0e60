"""Clients of the fake servers, and the outcome of one request."""

import pytest

from tests.grounding.llm import servers
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import HttpClient, make_client
from usd2kg.grounding.llm.completion import Request

KEYS = {
    "OPENAI_API_KEY": "openai-secret-1",
    "GOOGLE_API_KEY": "google-secret-1",
    "ANTHROPIC_API_KEY": "anthropic-secret-1",
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
}
every_provider = pytest.mark.parametrize("model", ANSWERS)


def connect(server, model: str, **options) -> HttpClient:
    return make_client(f"{model}@{server.url}", **({"environment": KEYS, "timeout_s": 60, "max_retries": 0} | options))


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
