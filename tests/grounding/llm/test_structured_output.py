"""The form in which each kind of server gets the schema of the answer."""

import json
from collections.abc import Iterator
from dataclasses import replace

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.bedrock_server import converse_events, converse_reply, frame
from tests.grounding.llm.connections import REQUEST, complete, connect, fail
from usd2kg.grounding.llm.completion import Completion, Finish, Usage

ANSWER = '{"class": "Cup"}'
NO_SCHEMA = servers.refuse(400, "response_format: json_schema is not supported")
NO_OBJECT = servers.refuse(422, "response_format: extra inputs are not permitted")
NO_TOOLS = servers.refuse(400, "registry.ollama.ai/library/m does not support tools")
XGRAMMAR = servers.refuse(400, "The provided JSON schema contains features not supported by xgrammar.")
LLAMA = servers.refuse(400, "Failed to parse grammar")


def form_of(body: dict) -> str:
    if "response_format" in body:
        return body["response_format"]["type"]
    return "tool" if "tools" in body else "text"


def ask_twice(*replies: servers.Reply) -> tuple[Completion, list[dict]]:
    """Return the second completion, and the bodies of all requests."""
    with servers.serve(*replies) as server, connect(server, "openai:m") as client:
        client.complete(REQUEST)
        return client.complete(REQUEST), [received.body for received in server.received]


@pytest.mark.parametrize(
    ("replies", "forms"),
    [
        ([servers.openai_reply(ANSWER)], ["json_schema", "json_schema"]),
        ([NO_SCHEMA, servers.openai_reply(ANSWER)], ["json_schema", "json_object", "json_object"]),
        ([NO_SCHEMA, NO_OBJECT, servers.openai_call(ANSWER)], ["json_schema", "json_object", "tool", "tool"]),
        ([XGRAMMAR, XGRAMMAR, servers.openai_call(ANSWER)], ["json_schema", "json_object", "tool", "tool"]),
        (
            [NO_SCHEMA, NO_OBJECT, NO_TOOLS, servers.openai_reply(ANSWER)],
            ["json_schema", "json_object", "tool", "text", "text"],
        ),
        (
            [LLAMA, LLAMA, LLAMA, servers.openai_reply(ANSWER)],
            ["json_schema", "json_object", "tool", "text", "text"],
        ),
    ],
    ids=[
        "vLLM, Ollama, llama.cpp",
        "llama-cpp-python",
        "only tools",
        "vLLM's grammar",
        "no form",
        "llama.cpp's grammar",
    ],
)
def test_takes_the_first_form_that_is_not_rejected_and_keeps_it(replies: list[servers.Reply], forms: list[str]):
    completion, bodies = ask_twice(*replies)

    assert [form_of(body) for body in bodies] == forms
    assert (completion.text, completion.finish, completion.usage) == (ANSWER, Finish.STOP, Usage(100, 60, 7))


def test_the_tool_must_be_called_with_the_enum():
    _, bodies = ask_twice(NO_SCHEMA, NO_OBJECT, servers.openai_call(ANSWER))

    (tool,) = bodies[-1]["tools"]
    assert bodies[-1]["tool_choice"] == "required" or bodies[-1]["tool_choice"]["function"]["name"] == "answer"
    assert tool["function"]["parameters"]["properties"]["class"]["enum"] == ["Knife", "Cup"]


def test_plain_text_has_the_schema_in_the_instructions():
    _, bodies = ask_twice(NO_SCHEMA, NO_OBJECT, NO_TOOLS, servers.openai_reply(ANSWER))

    system = json.dumps([message for message in bodies[-1]["messages"] if message["role"] == "system"])
    assert "the classes" in system
    assert '"Knife"' in system.replace('\\"', '"')


def test_a_truncated_call_is_a_truncated_completion():
    completion, _ = ask_twice(NO_SCHEMA, NO_OBJECT, servers.openai_call('{"class": "Cu', finish="length"))

    assert (completion.text, completion.finish) == ('{"class": "Cu', Finish.LENGTH)


def test_a_call_without_end_is_cut_off():
    completion, _ = ask_twice(NO_SCHEMA, NO_OBJECT, servers.openai_call('{"class": "' + "Cup, " * 2000))

    assert completion.finish is Finish.DEGENERATE


def test_another_error_changes_no_form():
    text, attempts, _ = fail("openai:m", servers.refuse(400, "context of 4096 tokens exceeded"))

    assert (attempts, "context of 4096 tokens exceeded" in text) == (1, True)


def anthropic_call(arguments: str) -> servers.Reply:
    """Return a message of Anthropic that calls a tool."""
    reply = servers.anthropic_reply("")
    call = {"type": "tool_use", "id": "t", "name": "answer", "input": {}}

    def events() -> Iterator[str]:
        start, *_, end, stop = servers.anthropic_events([], finish="tool_use")
        yield start
        yield servers.sse({"type": "content_block_start", "index": 0, "content_block": call}, "content_block_start")
        for piece in servers.pieces(arguments):
            delta = {"type": "input_json_delta", "partial_json": piece}
            yield servers.sse({"type": "content_block_delta", "index": 0, "delta": delta}, "content_block_delta")
        yield servers.sse({"type": "content_block_stop", "index": 0}, "content_block_stop")
        yield from (end, stop)

    content = [call | {"input": json.loads(arguments)}]
    return replace(reply, body={**reply.body, "content": content, "stop_reason": "tool_use"}, events=events)


def bedrock_call(arguments: str) -> servers.Reply:
    """Return a message of Bedrock that calls a tool."""
    reply = converse_reply("")
    call = {"toolUseId": "t", "name": "answer"}

    def events() -> Iterator[bytes]:
        start, *_, end, metadata = converse_events([], finish="tool_use")
        yield start
        yield frame("contentBlockStart", {"contentBlockIndex": 0, "start": {"toolUse": call}})
        for piece in servers.pieces(arguments):
            yield frame("contentBlockDelta", {"contentBlockIndex": 0, "delta": {"toolUse": {"input": piece}}})
        yield frame("contentBlockStop", {"contentBlockIndex": 0})
        yield from (end, metadata)

    message = {"role": "assistant", "content": [{"toolUse": call | {"input": json.loads(arguments)}}]}
    return replace(reply, body={**reply.body, "output": {"message": message}, "stopReason": "tool_use"}, events=events)


@pytest.mark.parametrize("is_streamed", [True, False])
@pytest.mark.parametrize(
    ("model", "reply"),
    [
        ("anthropic:claude-haiku-4-5", anthropic_call(ANSWER)),
        ("anthropic:claude-unheard-of", anthropic_call(ANSWER)),
        ("bedrock:us.anthropic.claude-haiku-4-5-20251001-v1:0", bedrock_call(ANSWER)),
        ("bedrock:meta.llama3-1-8b-instruct-v1:0", bedrock_call(ANSWER)),
    ],
)
def test_an_answer_as_a_tool_call_is_read_like_text(model: str, reply: servers.Reply, is_streamed: bool):
    """Some models call a tool that they were never offered, by the schema in their instructions."""
    replies = [reply] if is_streamed else [servers.refuse(400, "no stream"), replace(reply, events=None)]
    completion, received = complete(model, *replies)

    assert "tools" not in received[-1].body and "toolConfig" not in received[-1].body
    assert json.loads(completion.text) == json.loads(ANSWER)
    assert (completion.finish, completion.usage) == (Finish.STOP, Usage(100, 60, 7))
