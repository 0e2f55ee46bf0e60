"""request_stream: a streamed completion, cut off early if it is degenerate or too long."""

from collections.abc import AsyncIterator, Mapping
from contextlib import AsyncExitStack
from typing import TYPE_CHECKING, Any

from usd2kg.grounding.llm.adapter import convert_response
from usd2kg.grounding.llm.capabilities import NO_STREAM
from usd2kg.grounding.llm.completion import Completion, Finish, Request
from usd2kg.grounding.llm.degeneration import is_degenerate
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.retry import Failure
from usd2kg.grounding.llm.settings import DEGENERATION

if TYPE_CHECKING:
    from pydantic_ai.messages import ModelResponse, ModelResponseStreamEvent
    from pydantic_ai.models import Model, StreamedResponse

__all__ = ["StreamMonitor", "request_stream"]

_EVENT_ERRORS = (AttributeError, KeyError, TypeError, ValueError)
"""Exceptions that the libraries raise for an event with an unexpected structure, which they do not validate."""
_MALFORMED = "an event of the stream is malformed"


class StreamMonitor:
    """Decides when to cut off a text that is being streamed."""

    def __init__(self, max_tokens: int) -> None:
        """Create a monitor for a completion of at most `max_tokens` tokens."""
        self._left = max_tokens * LIMITS.max_characters_per_token
        self._unchecked = 0
        self._tail = ""

    def add(self, piece: str, *, is_first: bool = False) -> Finish | None:
        """Return why to cut off the text after this piece; None to continue.

        `is_first` begins another text, such as the answer after the reasoning. The limit applies to all texts together.
        """
        if is_first:
            self._unchecked, self._tail = 0, ""
        self._left -= len(piece)
        if self._left < 0:
            return Finish.LENGTH
        self._unchecked += len(piece)
        self._tail = (self._tail + piece)[-DEGENERATION.window_characters :]
        if self._unchecked < DEGENERATION.check_interval_characters:
            return None
        self._unchecked = 0
        return Finish.DEGENERATE if is_degenerate(self._tail) else None


async def request_stream(
    provider_model: "Model[Any]", prompt: Mapping[str, Any], request: Request, provider: str
) -> Completion | Failure:
    """Return the completion that a server streams, or the failure.

    A degenerate completion, or one far beyond the token limit, is cut off: the connection is closed, the text so far is
    kept, and tokens that the server has not reported yet are estimated.

    Args:
        provider_model: the model.
        prompt: the arguments of `pydantic_ai.direct.model_request_stream`.
        request: the request that the prompt was made from.
        provider: name of the provider, whose format the response has.

    Raises:
        AgentRunError: the server rejected the request, failed or timed out.
    """
    from pydantic_ai import direct  # noqa: PLC0415 - the extra may be missing
    from pydantic_ai.exceptions import UnexpectedModelBehavior  # noqa: PLC0415

    async with AsyncExitStack() as stack:
        try:
            stream = await stack.enter_async_context(direct.model_request_stream(provider_model, **prompt))
        except UnexpectedModelBehavior:
            return Failure(NO_STREAM)
        except _EVENT_ERRORS:
            return Failure(_MALFORMED)
        return await _read_stream(stream, request, provider)


async def _read_stream(stream: "StreamedResponse", request: Request, provider: str) -> Completion | Failure:
    monitor, events = StreamMonitor(request.max_tokens), aiter(stream)
    cutoff: Finish | None = None
    while cutoff is None and (event := await _next_event(events)) is not None:
        if isinstance(event, Failure):
            return event
        cutoff = monitor.add(_new_text(event), is_first=event.event_kind == "part_start")
    response = stream.get()
    if cutoff is None and not _is_complete(response, provider):
        return Failure("the stream broke off", None, is_transient=True)
    return convert_response(response, request, provider, cutoff)


async def _next_event(events: "AsyncIterator[ModelResponseStreamEvent]") -> "ModelResponseStreamEvent | Failure | None":
    try:
        return await anext(events, None)
    except _EVENT_ERRORS:
        return Failure(_MALFORMED)


def _new_text(event: "ModelResponseStreamEvent") -> str:
    from pydantic_ai import messages as kinds  # noqa: PLC0415 - the extra may be missing

    match event:
        case kinds.PartStartEvent(part=kinds.TextPart(content=text) | kinds.ThinkingPart(content=text)):
            return text
        case kinds.PartDeltaEvent(
            delta=kinds.TextPartDelta(content_delta=text) | kinds.ThinkingPartDelta(content_delta=text)
        ):
            return text or ""
        case kinds.PartDeltaEvent(delta=kinds.ToolCallPartDelta(args_delta=str(text))):
            return text
    return ""


def _is_complete(response: "ModelResponse", provider: str) -> bool:
    """Return whether a stream is complete: it has a finish reason or, at the end of OpenAI's format, the usage."""
    if "finish_reason" in (response.provider_details or {}) or response.finish_reason == "content_filter":
        return True
    return provider in ("openai", "azure") and not response.usage.unmeasured_requests
