"""A completion read piece by piece, so that one that goes wrong is cut off instead of paid for to its end."""

from collections.abc import AsyncIterator, Mapping
from contextlib import AsyncExitStack
from typing import TYPE_CHECKING, Any

from usd2kg.grounding.llm.adapter import convert_response
from usd2kg.grounding.llm.answers import is_degenerate
from usd2kg.grounding.llm.capabilities import NO_STREAM
from usd2kg.grounding.llm.completion import Completion, Finish, Request
from usd2kg.grounding.llm.retry import Failure

if TYPE_CHECKING:
    from pydantic_ai.messages import ModelResponse, ModelResponseStreamEvent
    from pydantic_ai.models import Model, StreamedResponse

__all__ = ["StreamMonitor", "request_stream"]

_LOOKS_EVERY = 500
"""Characters between two looks for a loop, which take one or two milliseconds."""
_KEPT = 8000
"""Characters at the end that are looked at."""
_MOST_CHARACTERS_PER_TOKEN = 32
"""No text has so many on average, unless the server does not keep to the limit."""
_TRIPS = (AttributeError, KeyError, TypeError, ValueError)
"""What the libraries fall over when a piece is JSON, but not what it should be: they do not check it."""
_ODD = "a piece of the stream is not what it should be"


class StreamMonitor:
    """Watches a text grow, and tells when it should be cut off."""

    def __init__(self, max_tokens: int) -> None:
        """Start with nothing; `max_tokens` is what the server was told to keep to."""
        self._left = max_tokens * _MOST_CHARACTERS_PER_TOKEN
        self._fresh = 0
        self._tail = ""

    def add(self, piece: str, *, is_first: bool = False) -> Finish | None:
        """Return why the text must end after this piece; None where it may go on.

        The first piece of another text, such as the answer after the reasoning, goes on under the same limit.
        """
        if is_first:
            self._fresh, self._tail = 0, ""
        self._left -= len(piece)
        if self._left < 0:
            return Finish.LENGTH
        self._fresh += len(piece)
        self._tail = (self._tail + piece)[-_KEPT:]
        if self._fresh < _LOOKS_EVERY:
            return None
        self._fresh = 0
        return Finish.DEGENERATE if is_degenerate(self._tail) else None


async def request_stream(
    served: "Model[Any]", prompt: Mapping[str, Any], request: Request, provider: str
) -> Completion | Failure:
    """Return the completion that a server streams, or why it brings none.

    One that loops is cut off as degenerate, one far beyond the limit of tokens as too long: the rest is not read, what
    came so far is kept, and tokens that the server had not counted by then are estimated.

    Args:
        served: the model.
        prompt: the arguments of `pydantic_ai.direct.model_request_stream`.
        request: what the prompt was made of.
        provider: in whose format.

    Raises:
        AgentRunError: the server refused, failed or was silent for too long.
    """
    from pydantic_ai import direct  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.exceptions import UnexpectedModelBehavior  # noqa: PLC0415

    async with AsyncExitStack() as stack:
        try:
            stream = await stack.enter_async_context(direct.model_request_stream(served, **prompt))
        except UnexpectedModelBehavior:
            return Failure(NO_STREAM)
        except _TRIPS:
            return Failure(_ODD)
        return await _read_stream(stream, request, provider)


async def _read_stream(stream: "StreamedResponse", request: Request, provider: str) -> Completion | Failure:
    watch, events = StreamMonitor(request.max_tokens), aiter(stream)
    cut: Finish | None = None
    while cut is None and (event := await _next_event(events)) is not None:
        if isinstance(event, Failure):
            return event
        cut = watch.add(_new_text(event), is_first=event.event_kind == "part_start")
    response = stream.get()
    if cut is None and not _is_whole(response, provider):
        return Failure("the stream broke off", None, is_transient=True)
    return convert_response(response, request, provider, cut)


async def _next_event(events: "AsyncIterator[ModelResponseStreamEvent]") -> "ModelResponseStreamEvent | Failure | None":
    try:
        return await anext(events, None)
    except _TRIPS:
        return Failure(_ODD)


def _new_text(event: "ModelResponseStreamEvent") -> str:
    from pydantic_ai import messages as kinds  # noqa: PLC0415 - the extra may be missing

    match event:
        case kinds.PartStartEvent(part=kinds.TextPart(content=text) | kinds.ThinkingPart(content=text)):
            return text
        case kinds.PartDeltaEvent(
            delta=kinds.TextPartDelta(content_delta=text) | kinds.ThinkingPartDelta(content_delta=text)
        ):
            return text or ""
    return ""


def _is_whole(response: "ModelResponse", provider: str) -> bool:
    """Whether a stream came to its end: it said why it ended or, last of all in OpenAI's format, what it counted."""
    if "finish_reason" in (response.provider_details or {}) or response.finish_reason == "content_filter":
        return True
    return provider == "openai" and not response.usage.unmeasured_requests
