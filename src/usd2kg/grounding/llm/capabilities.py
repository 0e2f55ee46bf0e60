"""What a server can do beside the plain request, found out by what it refuses."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from usd2kg.grounding.llm.retry import Failure

__all__ = ["NO_STREAM", "Capabilities"]

NO_STREAM = "the server answered a request for a stream without one"


@dataclass(frozen=True, slots=True)
class Capabilities:
    """What a server is asked for as long as it has not refused it."""

    streams: bool = True
    """To send the completion piece by piece."""
    logprobs: bool = False
    """To tell the probability of each token."""
    json_schemas: bool = False
    """To take a JSON Schema in OpenAI's words, where it only speaks OpenAI's language."""

    def without(self, failure: Failure) -> "Capabilities":
        """Return them less the one that the failure refuses; all of them where it is about something else."""
        for name, refuses in _REFUSALS.items():
            if getattr(self, name) and refuses(failure):
                return replace(self, **{name: False})
        return self


def _refuses_logprobs(failure: Failure) -> bool:
    # OpenAI answers 403 for models that do not offer them, servers that check fields 422, llama-cpp-python's 500.
    return failure.status in (400, 403, 422, 500) and "logprob" in failure.message.lower()


def _refuses_json_schemas(failure: Failure) -> bool:
    # llama-cpp-python's server answers 500 for a form of answer that it does not know.
    return failure.status in (400, 422, 500) and "response_format" in failure.message


def _refuses_streams(failure: Failure) -> bool:
    # Some servers stream, but do not know `stream_options`, without which they would not count the tokens.
    is_refusal = failure.status in (400, 403, 404, 405, 415, 422, 500, 501)
    return failure.message == NO_STREAM or (is_refusal and re.search(r"\bstream", failure.message, re.I) is not None)


_REFUSALS: dict[str, Callable[[Failure], bool]] = {
    "logprobs": _refuses_logprobs,
    "json_schemas": _refuses_json_schemas,
    "streams": _refuses_streams,
}
