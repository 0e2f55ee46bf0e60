"""Requests to OpenAI and compatible servers, and their completions."""

from dataclasses import replace

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.connections import KEYS, REQUEST, SCHEMA, complete, connect, fail
from usd2kg.grounding.llm import model_reference
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Finish, Request, Usage
from usd2kg.grounding.llm.prompts import object_schema


class TestCompatibleServers:
    def test_requests_the_schema_and_logprobs(self):
        _, (received,) = complete("openai:m", servers.openai_reply("{}"), request=replace(REQUEST, sample=3))

        assert received.path == "/chat/completions"
        schema = received.body["response_format"]["json_schema"]["schema"]
        assert list(schema["properties"]) == ["reasoning", "class"]
        assert received.headers["authorization"] == "Bearer openai-secret-1"
        assert received.body == {
            "model": "m",
            "messages": [
                {"role": "system", "content": "the classes"},
                {"role": "user", "content": "the objects"},
            ],
            "response_format": {
                "type": "json_schema",
                "json_schema": {"name": "answer", "schema": SCHEMA, "strict": True},
            },
            "temperature": 0.5,
            "max_tokens": 4000,
            "seed": 3,
            "logprobs": True,
            "top_logprobs": 1,
            "stream": True,
            "stream_options": {"include_usage": True},
        }

    def test_reads_usage_thinking_and_tokens(self):
        tokens = [('{"class": "', -0.1), ("Cup", -0.3), ('"}', -0.2)]
        reply = servers.openai_reply('{"class": "Cup"}', tokens=tokens, thinking="a handle")

        completion, _ = complete("openai:m", reply)

        assert completion.text == '{"class": "Cup"}'
        assert completion.finish is Finish.STOP
        assert completion.usage == Usage(input_tokens=100, cached_tokens=60, output_tokens=7)
        assert completion.tokens == tuple(tokens)
        assert completion.thinking == "a handle"

    @pytest.mark.parametrize("is_streamed", [True, False])
    def test_assigns_a_split_character_to_its_last_token(self, is_streamed: bool):
        tokens = [("Caf", -0.1), (b"\xc3", -0.2), (b"\xa9", -0.3), ("!", -0.4)]
        reply = servers.openai_reply("Café!", tokens=tokens)
        if not is_streamed:
            reply = replace(reply, events=None)

        completion, _ = complete("openai:m", reply)

        assert completion.tokens == (("Caf", -0.1), ("", -0.2), ("é", -0.3), ("!", -0.4))

    @pytest.mark.parametrize("odd", [{"bytes": [300]}, {"bytes": "Cup"}, {"logprob": None}])
    def test_ignores_tokens_in_an_unknown_format(self, odd: dict):
        token = {"token": "Cup", "logprob": -0.1, "bytes": None, "top_logprobs": []} | odd
        choice = {"index": 0, "delta": {"content": "Cup"}, "finish_reason": "stop", "logprobs": {"content": [token]}}
        chunk = servers.sse({"id": "c1", "object": "chat.completion.chunk", "created": 1, "choices": [choice]})

        completion, _ = complete("openai:m", servers.Reply(events=lambda: [chunk]))

        assert (completion.text, completion.tokens) == ("Cup", ())

    @pytest.mark.parametrize("status", [400, 403, 422, 500])
    def test_stops_requesting_rejected_logprobs(self, status: int):
        replies = servers.refuse(status, "logprobs is not supported"), servers.openai_reply("{}")
        with servers.serve(*replies) as server, connect(server, "openai:m") as client:
            first, second = client.complete(REQUEST), client.complete(REQUEST)

            assert [received.body.get("logprobs") for received in server.received] == [True, None, None]
            assert client.traffic.attempts == 3
        assert first.tokens == second.tokens == ()

    @pytest.mark.parametrize("status", [400, 422, 500])
    def test_falls_back_to_the_json_object_format(self, status: int):
        refusal = servers.refuse(status, "'loc': ('body', 'response_format', 'type'), 'input': 'json_schema'")
        with servers.serve(refusal, servers.openai_reply("{}")) as server, connect(server, "openai:m") as client:
            client.complete(REQUEST)
            client.complete(REQUEST)
            forms = [received.body["response_format"] for received in server.received]
            assert ["top_logprobs" in received.body for received in server.received] == [True, False, False]
        assert [form["type"] for form in forms] == ["json_schema", "json_object", "json_object"]
        assert forms[1] == forms[2] == {"type": "json_object", "schema": dict(REQUEST.schema)}

    def test_does_not_retry_another_rejection(self):
        text, attempts, url = fail("openai:m", servers.refuse(400, "context of 4096 tokens exceeded"), max_retries=3)

        assert attempts == 1
        assert text == (
            f"model 'openai:m@{url}': {url}: status 400: context of 4096 tokens exceeded; "
            "the server rejected the request, check the model's limits and the options"
        )

    @pytest.mark.parametrize(
        ("name", "is_thinking", "expected"),
        [
            ("llama-3", False, None),
            ("llama-3", True, {"enable_thinking": True}),
            ("Qwen/Qwen3.5-9B", False, {"enable_thinking": False}),
            ("Qwen/Qwen3.5-9B", True, {"enable_thinking": True}),
        ],
    )
    def test_toggles_thinking_in_the_chat_template(self, name: str, is_thinking: bool, expected):
        request = replace(REQUEST, is_thinking=is_thinking)

        _, (received,) = complete(f"openai:{name}", servers.openai_reply("{}"), request=request)

        assert received.body.get("chat_template_kwargs") == expected
        assert received.body["model"] == name
        assert "reasoning_effort" not in received.body

    def test_loopback_servers_need_no_key(self):
        completion, (received,) = complete("openai:m", servers.openai_reply("{}"), environment={})

        assert completion.text == "{}"
        assert received.headers["authorization"] == "Bearer none"

    def test_does_not_infer_features_from_openai_model_names(self):
        """OpenAI's `gpt-5` rejects a temperature, but other servers may use this name for any model."""
        _, (received,) = complete("openai:gpt-5", servers.openai_reply("{}"))

        assert received.body["temperature"] == 0.5
        assert received.body["max_tokens"] == 4000


class TestOpenAI:
    """Parameters for OpenAI's own models, sent to a fake server."""

    def _receive(self, monkeypatch: pytest.MonkeyPatch, name: str, request: Request, *replies) -> list[dict]:
        with servers.serve(*replies, servers.openai_reply("{}")) as server:
            monkeypatch.setitem(model_reference.PROVIDER_URLS, "openai", server.url)
            with make_client(f"openai:{name}", environment=KEYS, max_retries=0) as client:
                client.complete(request)
            return [received.body for received in server.received]

    def test_sends_a_temperature_to_models_without_reasoning(self, monkeypatch: pytest.MonkeyPatch):
        (body,) = self._receive(monkeypatch, "gpt-4o", REQUEST)

        assert (body["temperature"], body["logprobs"], body["max_completion_tokens"]) == (0.5, True, 4000)
        assert body["response_format"]["json_schema"]["strict"] is True
        assert not {"reasoning_effort", "chat_template_kwargs", "max_tokens", "top_logprobs"} & body.keys()

    @pytest.mark.parametrize("is_thinking", [True, False])
    def test_sends_no_temperature_to_reasoning_models(self, is_thinking: bool, monkeypatch: pytest.MonkeyPatch):
        (body,) = self._receive(monkeypatch, "gpt-5", replace(REQUEST, is_thinking=is_thinking))

        assert not {"temperature", "logprobs"} & body.keys()

    def test_sends_a_temperature_if_reasoning_is_off(self, monkeypatch: pytest.MonkeyPatch):
        (off,) = self._receive(monkeypatch, "gpt-5.1", REQUEST)
        (on,) = self._receive(monkeypatch, "gpt-5.1", replace(REQUEST, is_thinking=True))

        assert (off["temperature"], off["logprobs"], off["reasoning_effort"]) == (0.5, True, "none")
        assert not {"temperature", "logprobs"} & on.keys()
        assert on["reasoning_effort"] == "medium"

    def test_sends_a_schema_that_strict_mode_rejects(self, monkeypatch: pytest.MonkeyPatch):
        """Strict mode requires every property."""
        schema = SCHEMA | {"required": ["class"]}

        (body,) = self._receive(monkeypatch, "gpt-4o", replace(REQUEST, schema=schema))

        sent = body["response_format"]["json_schema"]
        assert sent["strict"] is False
        assert sent["schema"] == schema


class TestManyEnumValues:
    """OpenAI accepts 1,000 enum values in a schema."""

    def schema(self, rows: int, values: int) -> dict:
        row = object_schema({"class": {"type": "string", "enum": [f"Class{number}" for number in range(values)]}})
        return object_schema({str(number): row for number in range(1, rows + 1)})

    def sent(self, schema: dict) -> dict:
        _, (received,) = complete("openai:m", servers.openai_reply("{}"), request=replace(REQUEST, schema=schema))
        return received.body["response_format"]["json_schema"]["schema"]

    def test_equal_rows_are_defined_once(self):
        schema = self.schema(11, 100)
        sent = self.sent(schema)
        assert sent["$defs"] == {"row": schema["properties"]["1"]}
        assert sent["properties"] == {str(number): {"$ref": "#/$defs/row"} for number in range(1, 12)}
        assert sent["required"] == schema["required"]

    def test_rows_of_a_smaller_schema_stay_in_their_place(self):
        assert self.sent(self.schema(10, 100)) == self.schema(10, 100)


def test_a_key_that_the_server_echoes_is_removed_from_the_completion():
    secret = KEYS["OPENAI_API_KEY"]
    tokens = [("the key is ", -0.1), (secret[:4], -0.1), (secret[4:], -0.1)]
    completion, _ = complete("openai:m", servers.openai_reply(f"the key is {secret}", tokens=tokens, thinking=secret))
    assert (completion.text, completion.thinking, completion.tokens) == ("the key is [key]", "[key]", ())
