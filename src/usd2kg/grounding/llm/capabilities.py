"""Capabilities: optional request features of a server, dropped once it rejects them."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from usd2kg.grounding.llm.retry import Failure

__all__ = ["NO_STREAM", "Capabilities"]

NO_STREAM = "the server answered a request for a stream without one"
"""Message of the failure that disables streaming without an HTTP error."""


@dataclass(frozen=True, slots=True)
class Capabilities:
    """The features to request from a server."""

    streams: bool = True
    """Stream the completion."""
    logprobs: bool = False
    """Return token log-probabilities."""
    json_schemas: bool = False
    """Accept OpenAI's `json_schema` response format. This and the next two are for servers compatible with OpenAI."""
    json_objects: bool = False
    """Accept a schema in the `json_object` response format, as llama-cpp-python's server does."""
    tools: bool = False
    """Accept a tool that must be called with the answer. Without it, the schema is text in the prompt."""

    def without(self, failure: Failure) -> "Capabilities":
        """Return a copy without the first feature that the failure rejects; unchanged if it has another cause."""
        for name, rejects in _REJECTIONS.items():
            if getattr(self, name) and rejects(failure):
                return replace(self, **{name: False})
        return self


def _rejects_logprobs(failure: Failure) -> bool:
    # 403: OpenAI, for models without log-probabilities; 422: strict field validation; 500: llama-cpp-python.
    return failure.status in (400, 403, 422, 500) and "logprob" in failure.message.lower()


def _rejects_schemas(failure: Failure) -> bool:
    # 500: llama-cpp-python, for an unknown response format. vLLM and llama.cpp's server name the schema or the grammar
    # that they cannot make from it.
    is_named = re.search(r"response_format|json.?schema|grammar", failure.message, re.I) is not None
    return failure.status in (400, 422, 500) and is_named


def _rejects_tools(failure: Failure) -> bool:
    # 501: llama.cpp's server without a template for tools.
    is_named = re.search(r"\btools?\b|tool_choice", failure.message, re.I) is not None
    return (failure.status in (400, 404, 422, 500, 501) and is_named) or _rejects_schemas(failure)


def _rejects_streams(failure: Failure) -> bool:
    # Also matches `stream_options`: some servers stream without it, but would not report usage.
    is_rejection = failure.status in (400, 403, 404, 405, 415, 422, 500, 501)
    return failure.message == NO_STREAM or (is_rejection and re.search(r"\bstream", failure.message, re.I) is not None)


_REJECTIONS: dict[str, Callable[[Failure], bool]] = {
    "logprobs": _rejects_logprobs,
    "json_schemas": _rejects_schemas,
    "json_objects": _rejects_schemas,
    "tools": _rejects_tools,
    "streams": _rejects_streams,
}
