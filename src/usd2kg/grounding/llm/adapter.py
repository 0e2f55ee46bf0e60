"""Adapter between `Request`/`Completion` and the messages, settings and responses of pydantic-ai."""

import json
from codecs import getincrementaldecoder
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.estimates import estimate_input
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.model_reference import ModelReference
from usd2kg.grounding.llm.prompt_text import estimate_tokens

if TYPE_CHECKING:
    from pydantic_ai.messages import ModelRequest, ModelResponse
    from pydantic_ai.models import Model, ModelRequestParameters

__all__ = [
    "accepts_temperature",
    "convert_response",
    "define_rows_once",
    "hide_secrets",
    "json_object_format",
    "make_message",
    "make_parameters",
    "make_settings",
    "prompted_parameters",
    "tool_parameters",
]

_MIN_REASONING_TOKENS = 1024
"""Smallest budget, https://platform.claude.com/docs/en/build-with-claude/extended-thinking."""


def make_message(request: Request) -> "ModelRequest":
    """Return the prompt: instructions, text, and images."""
    from pydantic_ai.messages import BinaryContent, ModelRequest, UserContent, UserPromptPart  # noqa: PLC0415

    if not request.images:
        return ModelRequest.user_text_prompt(request.user, instructions=request.system)
    images: list[UserContent] = [BinaryContent(image, media_type="image/png") for image in request.images]
    return ModelRequest([UserPromptPart([request.user, *images])], instructions=request.system)


def make_parameters(
    provider_model: "Model[Any]", request: Request, is_openai_compatible: bool
) -> "ModelRequestParameters":
    """Return the output format: enforced by the server if it supports JSON Schema, else described in the prompt."""
    from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415
    from pydantic_ai.output import OutputObjectDefinition  # noqa: PLC0415

    is_enforced = provider_model.profile.get("supports_json_schema_output", False)
    # For OpenAI itself, the library determines whether strict mode accepts the schema.
    schema = define_rows_once(request.schema)
    answer = OutputObjectDefinition(schema, name="answer", strict=True if is_openai_compatible else None)
    return ModelRequestParameters(output_mode="native" if is_enforced else "prompted", output_object=answer)


def tool_parameters(request: Request) -> "ModelRequestParameters":
    """Return the output format of an answer given as the arguments of a required tool call."""
    from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415
    from pydantic_ai.tools import ToolDefinition  # noqa: PLC0415

    schema = define_rows_once(request.schema)
    tool = ToolDefinition(name="answer", parameters_json_schema=schema, description="Give the answer.", kind="output")
    return ModelRequestParameters(output_mode="tool", output_tools=[tool], allow_text_output=False)


def prompted_parameters(request: Request) -> "ModelRequestParameters":
    """Return the output format of a plain-text answer, with the schema in the instructions."""
    from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415
    from pydantic_ai.output import OutputObjectDefinition  # noqa: PLC0415

    answer = OutputObjectDefinition(define_rows_once(request.schema), name="answer")
    return ModelRequestParameters(output_mode="prompted", output_object=answer)


def define_rows_once(schema: Mapping[str, Any]) -> dict[str, Any]:
    """Return an answer schema that defines the row schema once if its enums exceed OpenAI's limit on enum values.

    Otherwise each row keeps its inline schema, which more servers support.
    """
    rows = list(schema.get("properties", {}).values())
    sizes = [len(value.get("enum", ())) for row in rows for value in row.get("properties", {}).values()]
    if sum(sizes) <= LIMITS.max_enum_values or any(row != rows[0] for row in rows):
        return dict(schema)
    references = {number: {"$ref": "#/$defs/row"} for number in schema["properties"]}
    return {**schema, "properties": references, "$defs": {"row": rows[0]}}


def make_settings(
    reference: ModelReference, provider_model: "Model[Any]", request: Request, asks_logprobs: bool
) -> dict[str, Any]:
    """Return the model settings of a request under their pydantic-ai names."""
    settings: dict[str, Any] = {"max_tokens": request.max_tokens}
    if accepts_temperature(provider_model, request.is_thinking):
        settings["temperature"] = request.temperature
    if asks_logprobs:
        settings["openai_logprobs"] = True
        if reference.is_openai_compatible:
            # By default, llama.cpp's server returns twenty alternatives for each token.
            settings["openai_top_logprobs"] = 1
    if provider_model.profile.get("supports_thinking", False):
        settings["thinking"] = request.is_thinking
    if reference.provider == "anthropic":
        return settings | {"anthropic_cache_instructions": True} | _budget_reasoning(reference, provider_model, request)
    if reference.provider == "bedrock":
        # Bedrock has no seed parameter.
        return settings | {"bedrock_cache_instructions": True}
    if reference.is_openai_compatible:
        settings |= _toggle_reasoning(reference, request.is_thinking)
    return settings | {"seed": request.sample}


def accepts_temperature(provider_model: "Model[Any]", is_thinking: bool) -> bool:
    """Return whether the model accepts a temperature; some reasoning models reject it with status 400."""
    profile = cast("Mapping[str, Any]", provider_model.profile)
    if profile.get("openai_supports_reasoning", False):
        efforts = profile.get("openai_reasoning_efforts")
        can_stop = profile.get("openai_supports_reasoning_effort_none", False) if efforts is None else "none" in efforts
        return can_stop and not is_thinking
    if provider_model.system in ("anthropic", "bedrock"):
        flags = "thinking_always_enabled", *(f"{name}_disallows_sampling_settings" for name in ("anthropic", "bedrock"))
        return not (is_thinking or any(profile.get(flag, False) for flag in flags))
    return True


def _budget_reasoning(reference: ModelReference, provider_model: "Model[Any]", request: Request) -> dict[str, Any]:
    """Return a budget of half the output tokens for Anthropic models that require a reasoning budget."""
    profile = cast("Mapping[str, Any]", provider_model.profile)
    if not request.is_thinking or profile.get("anthropic_supports_adaptive_thinking", False):
        return {}
    budget = request.max_tokens // 2
    if budget < _MIN_REASONING_TOKENS:
        raise GroundingError(
            f"model '{reference.model}': {request.max_tokens} output tokens leave no room to think; "
            f"expected at least {2 * _MIN_REASONING_TOKENS}, allow more or switch thinking off"
        )
    return {"anthropic_thinking": {"type": "enabled", "budget_tokens": budget}}


def _toggle_reasoning(reference: ModelReference, is_thinking: bool) -> dict[str, Any]:
    """Return the request field that turns reasoning on or off, whose name depends on the server.

    Reasoning is turned off explicitly only for Qwen models, which reason by default.
    """
    if not is_thinking and "qwen" not in reference.name.lower():
        return {}
    host = urlsplit(reference.url).hostname or ""
    if host.endswith(".aliyuncs.com"):
        return {"extra_body": {"enable_thinking": is_thinking}}
    if host == "openrouter.ai":
        return {"extra_body": {"reasoning": {"enabled": is_thinking}}}
    return {"extra_body": {"chat_template_kwargs": {"enable_thinking": is_thinking}}}


def convert_response(
    response: "ModelResponse", request: Request, provider: str, cutoff: Finish | None = None
) -> Completion:
    """Convert a pydantic-ai response to a completion.

    Args:
        response: the response, complete or not.
        request: the request, for estimates.
        provider: name of the provider.
        cutoff: why the client ended the response; None if the server did.
    """
    from pydantic_ai.messages import TextPart, ThinkingPart, ToolCallPart  # noqa: PLC0415

    text = "".join(part.content for part in response.parts if isinstance(part, TextPart))
    # The answer is the arguments of the tool call; the model may also write text before the call.
    calls = (part.args for part in response.parts if isinstance(part, ToolCallPart))
    text = next((args if isinstance(args, str) else json.dumps(args or {}) for args in calls), text)
    thinking = "".join(part.content for part in response.parts if isinstance(part, ThinkingPart))
    finish = Finish.LENGTH if response.finish_reason == "length" else Finish.STOP
    usage = response.usage
    counted = Usage(
        usage.input_tokens, usage.cache_read_tokens, usage.output_tokens, written_tokens=usage.cache_write_tokens
    )
    if cutoff is not None and provider != "google":
        # Only Gemini reports output tokens during a stream; Anthropic's count at the start is a placeholder.
        counted = replace(counted, output_tokens=0)
    # OpenAI's Chat Completions API returns logprobs beside the text; its Responses API (batch jobs) in the text part.
    details = [response.provider_details, *(p.provider_details for p in response.parts if isinstance(p, TextPart))]
    tokens = next((read for one in details if (read := _read_tokens(one or {}))), ())
    if not counted.output_tokens:
        counted = replace(counted, output_tokens=len(tokens))
    if cutoff is not None or usage.unmeasured_requests:
        counted += _estimate_missing(counted, request, thinking + text)
    return Completion(text, cutoff or finish, counted, tokens, thinking)


def hide_secrets(completion: Completion, hide: Callable[[str], str]) -> Completion:
    """Return a completion with echoed API keys removed; if there were any, token probabilities are dropped, too."""
    text, thinking = hide(completion.text), hide(completion.thinking)
    spelled = "".join(piece for piece, _ in completion.tokens)
    if (text, thinking, hide(spelled)) == (completion.text, completion.thinking, spelled):
        return completion
    return replace(completion, text=text, thinking=thinking, tokens=())


def _estimate_missing(counted: Usage, request: Request, text: str) -> Usage:
    """Return an estimate of the token counts that the server did not report."""
    input_tokens = 0 if counted.input_tokens else estimate_input(request)
    output_tokens = 0 if counted.output_tokens else estimate_tokens(text)
    return Usage(input_tokens, 0, output_tokens, input_tokens + output_tokens)


def _read_tokens(details: Mapping[str, Any]) -> tuple[tuple[str, float], ...]:
    """Return text and log-probability of each token; empty if the server uses another format."""
    decode = getincrementaldecoder("utf-8")("replace").decode
    try:
        return tuple((_piece(token, decode), float(token["logprob"])) for token in details.get("logprobs", ()))
    except (LookupError, TypeError, ValueError):
        return ()


def _piece(token: Mapping[str, Any], decode: Callable[[bytes], str]) -> str:
    """Return the text that a token adds, from its bytes: its name is wrong if the token ends inside a character."""
    raw = token.get("bytes")
    return str(token["token"]) if raw is None else decode(bytes(raw))


def json_object_format(request: Request) -> dict[str, Any]:
    """Return the response format of llama-cpp-python's server, which enforces the schema by a grammar."""
    return {"type": "json_object", "schema": dict(request.schema)}
