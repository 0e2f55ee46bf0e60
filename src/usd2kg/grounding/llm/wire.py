"""A request in the words of pydantic-ai and of the servers behind it, and the completion in ours."""

from collections.abc import Mapping
from dataclasses import replace
from statistics import fmean
from typing import TYPE_CHECKING, Any, cast
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.addresses import Address
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.prompts import estimate_tokens

if TYPE_CHECKING:
    from pydantic_ai.messages import ModelResponse
    from pydantic_ai.models import Model, ModelRequestParameters

__all__ = ["is_sampled", "make_parameters", "make_settings", "older_format", "read_completion"]

_LEAST_REASONING_TOKENS = 1024
"""https://platform.claude.com/docs/en/build-with-claude/extended-thinking: the smallest budget of Claude models."""


def make_parameters(served: "Model[Any]", request: Request, is_compatible: bool) -> "ModelRequestParameters":
    """How the answer must look: enforced by the server where it can, in the prompt where it cannot."""
    from pydantic_ai.models import ModelRequestParameters  # noqa: PLC0415
    from pydantic_ai.output import OutputObjectDefinition  # noqa: PLC0415

    is_enforced = served.profile.get("supports_json_schema_output", False)
    # At OpenAI's own the library finds out whether strict mode takes the schema.
    answer = OutputObjectDefinition(dict(request.schema), name="answer", strict=True if is_compatible else None)
    return ModelRequestParameters(output_mode="native" if is_enforced else "prompted", output_object=answer)


def make_settings(address: Address, served: "Model[Any]", request: Request, asks_logprobs: bool) -> dict[str, Any]:
    """What goes with the prompt, in the library's words."""
    settings: dict[str, Any] = {"max_tokens": request.most_tokens}
    if is_sampled(served, request.is_thinking):
        settings["temperature"] = request.temperature
    if asks_logprobs:
        settings["openai_logprobs"] = True
    if served.profile.get("supports_thinking", False):
        settings["thinking"] = request.is_thinking
    if address.provider == "anthropic":
        return settings | {"anthropic_cache_instructions": True} | _budget_reasoning(address, served, request)
    if address.is_compatible:
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


def _budget_reasoning(address: Address, served: "Model[Any]", request: Request) -> dict[str, Any]:
    """Half of the output tokens for models of Anthropic that need to be told how long they may reason."""
    profile = cast("Mapping[str, Any]", served.profile)
    if not request.is_thinking or profile.get("anthropic_supports_adaptive_thinking", False):
        return {}
    budget = request.most_tokens // 2
    if budget < _LEAST_REASONING_TOKENS:
        raise GroundingError(
            f"model '{address.model}': {request.most_tokens} output tokens leave no room to think; "
            f"expected at least {2 * _LEAST_REASONING_TOKENS}, allow more or switch thinking off"
        )
    return {"anthropic_thinking": {"type": "enabled", "budget_tokens": budget}}


def _switch_reasoning(address: Address, is_thinking: bool) -> dict[str, Any]:
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


def read_completion(
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
    counted = Usage(usage.input_tokens, usage.cache_read_tokens, usage.output_tokens)
    if cut is not None and provider != "google":
        # Only Gemini counts as it goes; what Anthropic's servers tell at the start of a message is a stand-in.
        counted = replace(counted, output_tokens=0)
    if cut is not None or usage.unmeasured_requests:
        counted = _estimate_missing(counted, request, thinking + text)
    return Completion(text, cut or finish, counted, _average_logprob(response.provider_details or {}), thinking)


def _estimate_missing(counted: Usage, request: Request, said: str) -> Usage:
    """Return the counts, with an estimate of about four bytes a token for those that the server did not tell."""
    return replace(
        counted,
        input_tokens=counted.input_tokens or estimate_tokens(request.system + request.user),
        output_tokens=counted.output_tokens or estimate_tokens(said),
    )


def _average_logprob(details: Mapping[str, Any]) -> float | None:
    logprobs = [float(token["logprob"]) for token in details.get("logprobs", ())]
    return fmean(logprobs) if logprobs else None


def older_format(request: Request) -> dict[str, Any]:
    """The schema in the words of llama-cpp-python's server, which enforces it by a grammar."""
    return {"type": "json_object", "schema": dict(request.schema)}
