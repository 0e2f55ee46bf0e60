"""Each kind of server, in the form in which it gets the schema, with answers that are right, wrong, late or missing."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.bedrock_server import converse_reply
from tests.grounding.llm.connections import connect
from tests.grounding.records import make_class, make_tbox
from usd2kg.grounding import ObjectView, Prediction, Status
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.grounder import LLMGrounder
from usd2kg.grounding.llm.metered_client import MeteredClient
from usd2kg.grounding.llm.prompt_options import PromptOptions

TBOX = make_tbox(make_class("Cup"), make_class("Knife"))
CUP = '{"1": {"class": "Cup"}}'
NO_SCHEMA = servers.refuse(400, "response_format: json_schema is not supported")
NO_OBJECT = servers.refuse(422, "response_format: extra inputs are not permitted")
NO_TOOLS = servers.refuse(400, "registry.ollama.ai/library/m does not support tools")


class _Reply:
    """The replies of a wire format: an answer, and how it says that the answer is truncated or refused."""

    def __init__(self, make: Callable[..., servers.Reply], truncated: str, refused: str) -> None:
        self.answer = make
        self.truncated = make('{"1": {"class": "Cu', finish=truncated)
        self.refusal = make("", finish=refused)


OPENAI = _Reply(servers.openai_reply, "length", "content_filter")


@dataclass(frozen=True)
class Kind:
    """A kind of server."""

    model: str
    replies: _Reply = OPENAI
    rejections: Sequence[servers.Reply] = field(default=())
    """What it replies to the forms of the schema that it does not know."""


KINDS = {
    "vLLM, Ollama, llama.cpp: JSON Schema": Kind("openai:m"),
    "llama-cpp-python: grammar": Kind("openai:m", OPENAI, (NO_SCHEMA,)),
    "gateway: tool": Kind("openai:m", _Reply(servers.openai_call, "length", "content_filter"), (NO_SCHEMA, NO_OBJECT)),
    "gateway: text": Kind("openai:m", OPENAI, (NO_SCHEMA, NO_OBJECT, NO_TOOLS)),
    "Azure": Kind("azure:gpt-4o"),
    "Gemini": Kind("google:gemini-2.5-flash", _Reply(servers.gemini_reply, "MAX_TOKENS", "SAFETY")),
    "Anthropic": Kind("anthropic:claude-haiku-4-5", _Reply(servers.anthropic_reply, "max_tokens", "refusal")),
    "Bedrock": Kind(
        "bedrock:us.anthropic.claude-haiku-4-5-20251001-v1:0",
        _Reply(converse_reply, "max_tokens", "guardrail_intervened"),
    ),
}
every_kind = pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)


def ask(kind: Kind, folder: Path, *replies: servers.Reply) -> tuple[Prediction, LLMGrounder, int]:
    """Return the prediction for a cup, the grounder, and the number of requests after the rejections."""
    with (
        servers.serve(*kind.rejections, *replies) as server,
        connect(server, kind.model, max_retries=1, timeout_s=2, sleep=lambda _: None) as client,
        CompletionCache(folder / "cache.sqlite") as cache,
    ):
        grounder = LLMGrounder(MeteredClient(client, cache=cache), PromptOptions())
        (prediction,) = grounder.ground_views([("/Cup_1", ObjectView(name="Cup_1"))], TBOX)
        return prediction, grounder, len(server.received) - len(kind.rejections)


def is_cup(prediction: Prediction) -> bool:
    return prediction.status is Status.GROUNDED and prediction.class_iri == TBOX.classes[0].iri


@every_kind
def test_a_right_answer_takes_one_request(kind: Kind, tmp_path: Path):
    prediction, _, requests = ask(kind, tmp_path, kind.replies.answer(CUP))
    assert (is_cup(prediction), requests) == (True, 1)


@every_kind
@pytest.mark.parametrize(
    "text", ['{"1": {"class": "Spaceship"}}', "A cup, I think.", '{"2": {"class": "Knife"}}', "[]"]
)
def test_a_wrong_answer_is_asked_for_again(kind: Kind, text: str, tmp_path: Path):
    prediction, grounder, requests = ask(kind, tmp_path, kind.replies.answer(text), kind.replies.answer(CUP))
    assert (is_cup(prediction), requests, grounder.report.repairs) == (True, 2, 1)


@every_kind
def test_a_server_that_never_answers_right_introduces_no_class(kind: Kind, tmp_path: Path):
    prediction, _, requests = ask(kind, tmp_path, kind.replies.answer('{"1": {"class": "Spaceship"}}'))
    assert (prediction.status, prediction.class_iri, requests) == (Status.UNREADABLE, None, 2)


@every_kind
def test_a_truncated_answer_is_asked_for_again(kind: Kind, tmp_path: Path):
    prediction, grounder, requests = ask(kind, tmp_path, kind.replies.truncated, kind.replies.answer(CUP))
    assert (is_cup(prediction), requests, grounder.report.degenerate) == (True, 2, 1)


@every_kind
@pytest.mark.parametrize("failure", [servers.refuse(429, "slow down", Retry_After="1"), servers.Reply(hangs=True)])
def test_a_limit_or_a_server_that_hangs_is_waited_for(kind: Kind, failure: servers.Reply, tmp_path: Path):
    prediction, grounder, requests = ask(kind, tmp_path, failure, kind.replies.answer(CUP))
    assert (is_cup(prediction), requests, grounder.report.failed) == (True, 2, 0)


@every_kind
def test_a_limit_that_stays_leaves_the_object_without_a_class(kind: Kind, tmp_path: Path):
    prediction, grounder, _ = ask(kind, tmp_path, servers.refuse(429, "slow down"))
    assert (prediction.status, grounder.report.failed) == (Status.FAILED, 1)
    assert "slow down" in grounder.report.first_failure


@every_kind
def test_a_refusal_leaves_the_object_without_a_class(kind: Kind, tmp_path: Path):
    prediction, grounder, _ = ask(kind, tmp_path, kind.replies.refusal)
    assert (prediction.status, prediction.class_iri, grounder.report.failed) == (Status.UNREADABLE, None, 0)
