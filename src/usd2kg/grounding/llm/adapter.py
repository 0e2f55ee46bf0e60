"""A request in the words of pydantic-ai and of the servers behind it, and the completion in ours."""

from codecs import getincrementaldecoder
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.estimates import estimate_input
from usd2kg.grounding.llm.model_reference import ModelReference
from usd2kg.grounding.llm.prompt_text import estimate_tokens

if TYPE_CHECKING:
    from pydantic_ai.messages import ModelRequest, ModelResponse
    from pydantic_ai.models import Model, ModelRequestParameters

__all__ = ["convert_response", "is_sampled", "json_object_format", "make_message", "make_parameters", "make_settings"]

_LEAST_REASONING_TOKENS = 1024
"""https://platform.claude.com/docs/en/build-with-claude/extended-thinking: the smallest budget of Claude models."""


def make_message(request: Request) -> "ModelRequest":
    """The prompt: instructions, text, and the images behind it."""
    from pydantic_ai.messages import BinaryContent, ModelRequest, UserContent, UserPromptPart  # noqa: PLC0415

    if not request.images:
        return ModelRequest.user_text_prompt(request.user, instructions=request.system)
    images: list[UserContent] = [BinaryContent(image, media_type="image/png") for image in request.images]
    return ModelRequest([UserPromptPart([request.user, *images])], instructions=request.system)


def make_parameters(served: "Model[Any]", request: Request, is_openai_compatible: bool) -> "ModelRequestParameters":
    """How the answer must look: enforced by the server where it can, in the prompt where it cannot."""
    from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415
    from pydantic_ai.output import OutputObjectDefinition  # noqa: PLC0415

    is_enforced = served.profile.get("supports_json_schema_output", False)
    # At OpenAI's own the library finds out whether strict mode takes the schema.
    answer = OutputObjectDefinition(dict(request.schema), name="answer", strict=True if is_openai_compatible else None)
    return ModelRequestParameters(output_mode="native" if is_enforced else "prompted", output_object=answer)


def make_settings(
    address: ModelReference, served: "Model[Any]", request: Request, asks_logprobs: bool
) -> dict[str, Any]:
    """What goes with the prompt, in the library's words."""
    settings: dict[str, Any] = {"max_tokens": request.max_tokens}
    if is_sampled(served, request.is_thinking):
        settings["temperature"] = request.temperature
    if asks_logprobs:
        settings["openai_logprobs"] = True
        if address.is_openai_compatible:
            # llama.cpp's server tells those of twenty other tokens for each unless it is told how many.
            settings["openai_top_logprobs"] = 1
    if served.profile.get("supports_thinking", False):
        settings["thinking"] = request.is_thinking
    if address.provider == "anthropic":
        return settings | {"anthropic_cache_instructions": True} | _budget_reasoning(address, served, request)
    if address.is_openai_compatible:
        settings |= _switch_reasoning(address, request.is_thinking)
    return settings | {"seed": request.sample}


def is_sampled(served: "Model[Any]", is_thinking: bool) -> bool:
    """Whether the model takes a temperature: some that reason refuse it, with a warning or a status 400."""
    profile = cast("Mapping[str, Any]", served.profile)
    if profile.get("openai_supports_reasoning", False):
        efforts = profile.get("openai_reasoning_efforts")
        can_stop = profile.get("openai_supports_reasoning_effort_none", False) if efforts is None else "none" in efforts
        return can_stop and not is_thinking
    if served.system == "anthropic":
        always = profile.get("thinking_always_enabled", False)
        return not (is_thinking or always or profile.get("anthropic_disallows_sampling_settings", False))
    return True


def _budget_reasoning(address: ModelReference, served: "Model[Any]", request: Request) -> dict[str, Any]:
    """Half of the output tokens for models of Anthropic that need to be told how long they may reason."""
    profile = cast("Mapping[str, Any]", served.profile)
    if not request.is_thinking or profile.get("anthropic_supports_adaptive_thinking", False):
        return {}
    budget = request.max_tokens // 2
    if budget < _LEAST_REASONING_TOKENS:
        raise GroundingError(
            f"model '{address.model}': {request.max_tokens} output tokens leave no room to think; "
            f"expected at least {2 * _LEAST_REASONING_TOKENS}, allow more or switch thinking off"
        )
    return {"anthropic_thinking": {"type": "enabled", "budget_tokens": budget}}


def _switch_reasoning(address: ModelReference, is_thinking: bool) -> dict[str, Any]:
    """The field of the request that turns reasoning on or off, which every server names its own way.

    Left out when off, save for Qwen models: they reason unless told not to.
    """
    if not is_thinking and "qwen" not in address.name.lower():
        return {}
    host = urlsplit(address.url).hostname or ""
    if host.endswith(".aliyuncs.com"):
        return {"extra_body": {"enable_thinking": is_thinking}}
    if host == "openrouter.ai":
        return {"extra_body": {"reasoning": {"enabled": is_thinking}}}
    return {"extra_body": {"chat_template_kwargs": {"enable_thinking": is_thinking}}}


def convert_response(
    response: "ModelResponse", request: Request, provider: str, cut: Finish | None = None
) -> Completion:
    """Return the library's response as a completion.

    Args:
        response: what came, whole or not.
        request: what was asked.
        provider: in whose format.
        cut: why we ended it before the server did; None where the server ended it.
    """
    from pydantic_ai.messages import TextPart, ThinkingPart  # noqa: PLC0415

    text = "".join(part.content for part in response.parts if isinstance(part, TextPart))
    thinking = "".join(part.content for part in response.parts if isinstance(part, ThinkingPart))
    finish = Finish.LENGTH if response.finish_reason == "length" else Finish.STOP
    usage = response.usage
    counted = Usage(
        usage.input_tokens, usage.cache_read_tokens, usage.output_tokens, written_tokens=usage.cache_write_tokens
    )
    if cut is not None and provider != "google":
        # Only Gemini counts as it goes; what Anthropic's servers tell at the start of a message is a stand-in.
        counted = replace(counted, output_tokens=0)
    tokens = _read_tokens(response.provider_details or {})
    if not counted.output_tokens:
        counted = replace(counted, output_tokens=len(tokens))
    if cut is not None or usage.unmeasured_requests:
        counted += _estimate_missing(counted, request, thinking + text)
    return Completion(text, cut or finish, counted, tokens, thinking)


def _estimate_missing(counted: Usage, request: Request, said: str) -> Usage:
    """Return an estimate of about four bytes a token for the counts that the server did not tell."""
    input_tokens = 0 if counted.input_tokens else estimate_input(request)
    output_tokens = 0 if counted.output_tokens else estimate_tokens(said)
    return Usage(input_tokens, 0, output_tokens, input_tokens + output_tokens)


def _read_tokens(details: Mapping[str, Any]) -> tuple[tuple[str, float], ...]:
    """Return the text and log-probability of each token; nothing where a server tells them in a way of its own."""
    decode = getincrementaldecoder("utf-8")("replace").decode
    try:
        return tuple((_piece(token, decode), float(token["logprob"])) for token in details.get("logprobs", ()))
    except (LookupError, TypeError, ValueError):
        return ()


def _piece(token: Mapping[str, Any], decode: Callable[[bytes], str]) -> str:
    """Return the text that a token adds: its bytes tell it where it ends within a character, its name does not."""
    raw = token.get("bytes")
    return str(token["token"]) if raw is None else decode(bytes(raw))


def json_object_format(request: Request) -> dict[str, Any]:
    """The schema in the words of llama-cpp-python's server, which enforces it by a grammar."""
    return {"type": "json_object", "schema": dict(request.schema)}
