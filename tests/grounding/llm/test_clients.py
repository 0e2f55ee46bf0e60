import asyncio
import base64
import gc
import json
import logging
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

from tests.grounding.llm import servers
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm import model_reference
from usd2kg.grounding.llm.clients import HttpClient, make_client
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.retry import Failure, Redactor, RetryPolicy

KEYS = {
    "OPENAI_API_KEY": "openai-secret-1",
    "GOOGLE_API_KEY": "google-secret-1",
    "ANTHROPIC_API_KEY": "anthropic-secret-1",
}
SCHEMA = {
    "type": "object",
    "properties": {"reasoning": {"type": "string"}, "class": {"type": "string", "enum": ["Knife", "Cup"]}},
    "required": ["reasoning", "class"],
    "additionalProperties": False,
}
REQUEST = Request("the classes", "the objects", SCHEMA, max_tokens=4000, temperature=0.5)
ANSWERS = {
    "openai:m": servers.openai_reply("{}"),
    "google:gemini-2.5-flash": servers.gemini_reply("{}"),
    "anthropic:claude-haiku-4-5": servers.anthropic_reply("{}"),
}
every_provider = pytest.mark.parametrize("model", ANSWERS)


def _connect(server, model: str, **options) -> HttpClient:
    return make_client(f"{model}@{server.url}", **({"environment": KEYS, "timeout_s": 5, "max_retries": 0} | options))


def _complete(model: str, *replies, request: Request = REQUEST, **options):
    """The completion and the requests that the server received."""
    with servers.serve(*replies) as server, _connect(server, model, **options) as client:
        return client.complete(request), server.received


def _fail(model: str, *replies, **options) -> tuple[str, int, str]:
    """The error's text, the requests sent and the server's address."""
    with servers.serve(*replies) as server, _connect(server, model, **options) as client:
        with pytest.raises(GroundingError) as caught:
            client.complete(REQUEST)
        assert caught.value.__cause__ is None and caught.value.__context__ is None
        assert client.traffic.attempts == len(server.received)
        return str(caught.value), client.traffic.attempts, server.url


class TestOpenAI:
    def test_request_asks_for_the_schema_and_the_logprobs(self):
        _, (received,) = _complete("openai:m", servers.openai_reply("{}"), request=replace(REQUEST, sample=3))

        assert received.path == "/chat/completions"
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

    def test_schema_keeps_the_order_of_its_properties(self):
        _, (received,) = _complete("openai:m", servers.openai_reply("{}"))

        schema = received.body["response_format"]["json_schema"]["schema"]
        assert list(schema["properties"]) == ["reasoning", "class"]

    def test_completion_carries_usage_thinking_and_the_tokens(self):
        tokens = [('{"class": "', -0.1), ("Cup", -0.3), ('"}', -0.2)]
        reply = servers.openai_reply('{"class": "Cup"}', tokens=tokens, thinking="a handle")

        completion, _ = _complete("openai:m", reply)

        assert completion.text == '{"class": "Cup"}'
        assert completion.finish is Finish.STOP
        assert completion.usage == Usage(input_tokens=100, cached_tokens=60, output_tokens=7)
        assert completion.tokens == tuple(tokens)
        assert completion.mean_logprob == pytest.approx(-0.2)
        assert completion.thinking == "a handle"

    @pytest.mark.parametrize("is_streamed", [True, False])
    def test_a_token_that_ends_within_a_character_leaves_it_to_the_next(self, is_streamed: bool):
        tokens = [("Caf", -0.1), (b"\xc3", -0.2), (b"\xa9", -0.3), ("!", -0.4)]
        reply = servers.openai_reply("Café!", tokens=tokens)
        if not is_streamed:
            reply = replace(reply, events=None)

        completion, _ = _complete("openai:m", reply)

        assert completion.tokens == (("Caf", -0.1), ("", -0.2), ("é", -0.3), ("!", -0.4))

    @pytest.mark.parametrize("odd", [{"bytes": [300]}, {"bytes": "Cup"}, {"logprob": None}])
    def test_tokens_that_are_told_in_a_way_of_its_own_are_left_out(self, odd: dict):
        token = {"token": "Cup", "logprob": -0.1, "bytes": None, "top_logprobs": []} | odd
        choice = {"index": 0, "delta": {"content": "Cup"}, "finish_reason": "stop", "logprobs": {"content": [token]}}
        chunk = servers.sse({"id": "c1", "object": "chat.completion.chunk", "created": 1, "choices": [choice]})

        completion, _ = _complete("openai:m", servers.Reply(events=lambda: [chunk]))

        assert (completion.text, completion.tokens) == ("Cup", ())

    @pytest.mark.parametrize("status", [400, 403, 422, 500])
    def test_refused_logprobs_are_left_out_from_then_on(self, status: int):
        replies = servers.refuse(status, "logprobs is not supported"), servers.openai_reply("{}")
        with servers.serve(*replies) as server, _connect(server, "openai:m") as client:
            first, second = client.complete(REQUEST), client.complete(REQUEST)

            assert [received.body.get("logprobs") for received in server.received] == [True, None, None]
            assert client.traffic.attempts == 3
        assert first.tokens == second.tokens == ()
        assert first.mean_logprob is None

    @pytest.mark.parametrize("status", [400, 422, 500])
    def test_a_server_of_the_older_form_gets_the_schema_in_its_words_from_then_on(self, status: int):
        refusal = servers.refuse(status, "'loc': ('body', 'response_format', 'type'), 'input': 'json_schema'")
        with servers.serve(refusal, servers.openai_reply("{}")) as server, _connect(server, "openai:m") as client:
            client.complete(REQUEST)
            client.complete(REQUEST)
            forms = [received.body["response_format"] for received in server.received]
            assert ["top_logprobs" in received.body for received in server.received] == [True, False, False]
        assert [form["type"] for form in forms] == ["json_schema", "json_object", "json_object"]
        assert forms[1] == forms[2] == {"type": "json_object", "schema": dict(REQUEST.schema)}

    def test_another_refusal_is_not_asked_again(self):
        text, attempts, url = _fail("openai:m", servers.refuse(400, "context of 4096 tokens exceeded"), max_retries=3)

        assert attempts == 1
        assert text == (
            f"model 'openai:m@{url}': {url}: status 400: context of 4096 tokens exceeded; "
            "expected a request that the server takes, check the model's limits and the options"
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
    def test_thinking_is_switched_in_the_chat_template(self, name: str, is_thinking: bool, expected):
        request = replace(REQUEST, is_thinking=is_thinking)

        _, (received,) = _complete(f"openai:{name}", servers.openai_reply("{}"), request=request)

        assert received.body.get("chat_template_kwargs") == expected
        assert received.body["model"] == name
        assert "reasoning_effort" not in received.body

    def test_loopback_server_needs_no_key(self):
        completion, (received,) = _complete("openai:m", servers.openai_reply("{}"), environment={})

        assert completion.text == "{}"
        assert received.headers["authorization"] == "Bearer none"

    def test_names_that_other_companies_reason_by_mean_nothing_elsewhere(self):
        """`gpt-5` refuses a temperature at OpenAI's; a server of one's own may call anything so."""
        _, (received,) = _complete("openai:gpt-5", servers.openai_reply("{}"))

        assert received.body["temperature"] == 0.5
        assert received.body["max_tokens"] == 4000


class TestOpenAIItself:
    """The parameters for OpenAI's own models, sent to a server that stands in for OpenAI's."""

    def _receive(self, monkeypatch: pytest.MonkeyPatch, name: str, request: Request, *replies) -> list[dict]:
        with servers.serve(*replies, servers.openai_reply("{}")) as server:
            monkeypatch.setitem(model_reference.PROVIDER_URLS, "openai", server.url)
            with make_client(f"openai:{name}", environment=KEYS, max_retries=0) as client:
                client.complete(request)
            return [received.body for received in server.received]

    def test_models_that_do_not_reason_get_a_temperature(self, monkeypatch: pytest.MonkeyPatch):
        (body,) = self._receive(monkeypatch, "gpt-4o", REQUEST)

        assert (body["temperature"], body["logprobs"], body["max_completion_tokens"]) == (0.5, True, 4000)
        assert body["response_format"]["json_schema"]["strict"] is True
        assert not {"reasoning_effort", "chat_template_kwargs", "max_tokens", "top_logprobs"} & body.keys()

    @pytest.mark.parametrize("is_thinking", [True, False])
    def test_models_that_always_reason_get_none(self, is_thinking: bool, monkeypatch: pytest.MonkeyPatch):
        (body,) = self._receive(monkeypatch, "gpt-5", replace(REQUEST, is_thinking=is_thinking))

        assert not {"temperature", "logprobs"} & body.keys()

    def test_models_that_can_stop_reasoning_get_one_then(self, monkeypatch: pytest.MonkeyPatch):
        (off,) = self._receive(monkeypatch, "gpt-5.1", REQUEST)
        (on,) = self._receive(monkeypatch, "gpt-5.1", replace(REQUEST, is_thinking=True))

        assert (off["temperature"], off["logprobs"], off["reasoning_effort"]) == (0.5, True, "none")
        assert not {"temperature", "logprobs"} & on.keys()
        assert on["reasoning_effort"] == "medium"

    def test_schema_that_strict_mode_does_not_take_is_sent_all_the_same(self, monkeypatch: pytest.MonkeyPatch):
        """Strict mode requires every property."""
        schema = SCHEMA | {"required": ["class"]}

        (body,) = self._receive(monkeypatch, "gpt-4o", replace(REQUEST, schema=schema))

        sent = body["response_format"]["json_schema"]
        assert sent["strict"] is False
        assert sent["schema"] == schema


class TestGoogle:
    def test_request_asks_for_the_schema(self):
        _, (received,) = _complete("google:gemini-2.5-flash", servers.gemini_reply("{}"))

        assert received.path == "/v1beta/models/gemini-2.5-flash:streamGenerateContent?alt=sse"
        assert received.headers["x-goog-api-key"] == "google-secret-1"
        assert received.body["systemInstruction"]["parts"] == [{"text": "the classes"}]
        assert received.body["contents"] == [{"role": "user", "parts": [{"text": "the objects"}]}]
        options = received.body["generationConfig"]
        assert options["responseMimeType"] == "application/json"
        assert options["responseJsonSchema"] == SCHEMA | {"title": "answer"}
        assert (options["temperature"], options["maxOutputTokens"]) == (0.5, 4000)

    @pytest.mark.parametrize(
        ("name", "is_thinking", "expected"),
        [
            ("gemini-2.5-flash", False, {"thinking_budget": 0}),
            ("gemini-2.5-flash", True, {"include_thoughts": True}),
            ("gemini-3-flash-preview", False, {"thinking_level": "MINIMAL"}),
            ("gemini-3-flash-preview", True, {"include_thoughts": True}),
        ],
    )
    def test_thinking_is_a_budget_or_a_level(self, name: str, is_thinking: bool, expected):
        request = replace(REQUEST, is_thinking=is_thinking)

        _, (received,) = _complete(f"google:{name}", servers.gemini_reply("{}"), request=request)

        assert received.body["generationConfig"]["thinkingConfig"] == expected

    def test_completion_counts_thoughts_as_output(self):
        completion, _ = _complete("google:gemini-2.5-flash", servers.gemini_reply("{}", thinking="a blade"))

        assert completion == Completion("{}", Finish.STOP, Usage(100, 60, 7 + 5), (), "a blade")

    def test_older_key_variable_works(self):
        _, (received,) = _complete(
            "google:gemini-2.5-flash", servers.gemini_reply("{}"), environment={"GEMINI_API_KEY": " other-key\n"}
        )

        assert received.headers["x-goog-api-key"] == "other-key"


class TestAnthropic:
    def test_request_asks_for_the_schema_and_keeps_the_classes(self):
        _, (received,) = _complete("anthropic:claude-haiku-4-5", servers.anthropic_reply("{}"))

        assert received.path == "/v1/messages"
        sent = received.headers.get("authorization", ""), received.headers.get("x-api-key", "")
        assert "anthropic-secret-1" in "".join(sent)
        (system,) = received.body["system"]
        assert (system["text"], system["cache_control"]["type"]) == ("the classes", "ephemeral")
        form = received.body["output_config"]["format"]
        assert form["type"] == "json_schema"
        assert form["schema"]["properties"]["class"]["enum"] == ["Knife", "Cup"]
        assert (received.body["temperature"], received.body["max_tokens"]) == (0.5, 4000)
        assert "thinking" not in received.body

    def test_older_models_reason_in_half_of_the_tokens_without_a_temperature(self):
        request = replace(REQUEST, is_thinking=True)

        _, (received,) = _complete("anthropic:claude-haiku-4-5", servers.anthropic_reply("{}"), request=request)

        assert received.body["thinking"] == {"type": "enabled", "budget_tokens": 2000}
        assert received.body["max_tokens"] == 4000
        assert "temperature" not in received.body

    def test_newer_models_reason_as_they_see_fit(self):
        request = replace(REQUEST, is_thinking=True)

        _, (received,) = _complete("anthropic:claude-opus-4-8", servers.anthropic_reply("{}"), request=request)

        assert received.body["thinking"] == {"type": "adaptive"}

    def test_too_few_tokens_to_reason_are_refused_before_any_request(self):
        request = replace(REQUEST, is_thinking=True, max_tokens=2047)
        with (
            servers.serve(servers.anthropic_reply("{}")) as server,
            _connect(server, "anthropic:claude-haiku-4-5") as client,
        ):
            with pytest.raises(
                GroundingError, match="2047 output tokens leave no room to think; expected at least 2048"
            ):
                client.complete(request)

            assert client.traffic.attempts == 0 and server.received == []

    def test_completion_counts_cached_tokens_as_input(self):
        reply = servers.anthropic_reply("{}", thinking="a blade")

        completion, _ = _complete("anthropic:claude-haiku-4-5", reply)

        assert completion == Completion("{}", Finish.STOP, Usage(40 + 60, 60, 7), (), "a blade")

    def test_completion_tells_what_was_written_into_the_cache(self):
        reply = servers.anthropic_reply("{}")
        reply.body["usage"] = servers.ANTHROPIC_USAGE | {"cache_creation_input_tokens": 30}

        completion, _ = _complete("anthropic:claude-haiku-4-5", replace(reply, events=None))

        assert completion.usage == Usage(40 + 60 + 30, 60, 7, written_tokens=30)

    def test_model_without_schemas_gets_it_in_the_prompt(self):
        _, (received,) = _complete("anthropic:claude-unheard-of", servers.anthropic_reply("{}"))

        assert "output_config" not in received.body
        assert '"Knife"' in json.dumps(received.body["system"]).replace('\\"', '"')


class TestImages:
    """Two pictures, of which no byte is touched on the way."""

    IMAGES = (b"\x89PNG\r\n\x1a\n first", b"\x89PNG\r\n\x1a\n second")
    BASE64 = tuple(base64.b64encode(image).decode() for image in IMAGES)
    REQUEST = replace(REQUEST, images=IMAGES)

    def test_openai_gets_addresses_with_the_data_inside(self):
        _, (received,) = _complete("openai:m", servers.openai_reply("{}"), request=self.REQUEST)

        text, *images = received.body["messages"][1]["content"]
        assert text == {"type": "text", "text": "the objects"}
        assert [image["type"] for image in images] == ["image_url"] * 2
        assert [image["image_url"]["url"] for image in images] == [
            f"data:image/png;base64,{data}" for data in self.BASE64
        ]

    def test_google_gets_inline_data(self):
        _, (received,) = _complete("google:gemini-2.5-flash", servers.gemini_reply("{}"), request=self.REQUEST)

        ((text, *images),) = [content["parts"] for content in received.body["contents"]]
        assert text == {"text": "the objects"}
        assert [image["inlineData"]["mime_type"] for image in images] == ["image/png"] * 2
        sent = [base64.urlsafe_b64decode(image["inlineData"]["data"]) for image in images]
        assert sent == list(self.IMAGES)

    def test_anthropic_gets_sources(self):
        _, (received,) = _complete("anthropic:claude-haiku-4-5", servers.anthropic_reply("{}"), request=self.REQUEST)

        text, *images = received.body["messages"][0]["content"]
        assert (text["type"], text["text"]) == ("text", "the objects")
        assert [image["type"] for image in images] == ["image"] * 2
        assert [image["source"] for image in images] == [
            {"type": "base64", "media_type": "image/png", "data": data} for data in self.BASE64
        ]

    @every_provider
    def test_whole_answers_get_them_too(self, model: str):
        whole = replace(ANSWERS[model], events=None)
        completion, received = _complete(model, servers.refuse(400, "no stream"), whole, request=self.REQUEST)

        assert completion.text == "{}"
        assert [self.BASE64[1] in json.dumps(sent.body).replace("-", "+").replace("_", "/") for sent in received] == [
            True,
            True,
        ]


@pytest.mark.parametrize(
    ("model", "reply"),
    [
        ("openai:m", servers.openai_reply('{"cl', finish="length")),
        ("google:gemini-2.5-flash", servers.gemini_reply('{"cl', finish="MAX_TOKENS")),
        ("anthropic:claude-haiku-4-5", servers.anthropic_reply('{"cl', finish="max_tokens")),
    ],
)
def test_cut_off_answer_is_told(model: str, reply):
    completion, _ = _complete(model, reply)

    assert (completion.text, completion.finish) == ('{"cl', Finish.LENGTH)


class TestRetries:
    @every_provider
    def test_server_that_names_the_wait_is_obeyed(self, model: str):
        waits: list[float] = []

        completion, received = _complete(
            model, servers.refuse(429, "slow down", Retry_After="7"), ANSWERS[model], max_retries=1, sleep=waits.append
        )

        assert (completion.text, len(received), waits) == ("{}", 2, [7.0])

    @every_provider
    def test_wait_doubles_with_full_jitter(self, model: str):
        waits: list[float] = []
        failures = [servers.refuse(status, "oops") for status in (500, 503, 408, 409)]

        _, received = _complete(
            model,
            *failures,
            ANSWERS[model],
            max_retries=4,
            sleep=waits.append,
            random=iter([0.5, 0.25, 1.0, 0.0]).__next__,
        )

        assert waits == [0.5 * 1, 0.25 * 2, 1.0 * 4, 0.0 * 8]
        assert len(received) == 5

    @every_provider
    @pytest.mark.parametrize("fault", ["broken", "hanging", "not JSON from a proxy"])
    def test_faults_on_the_way_are_tried_again(self, model: str, fault: str):
        first = {
            "broken": servers.broken_off(ANSWERS[model], after=2),
            "hanging": servers.Reply(hangs=True),
            "not JSON from a proxy": servers.Reply("<html>Bad Gateway", 502, is_raw=True),
        }[fault]

        completion, received = _complete(
            model, first, ANSWERS[model], max_retries=1, timeout_s=0.3, sleep=lambda _: None
        )

        assert (completion.text, len(received)) == ("{}", 2)

    @every_provider
    def test_last_failure_is_told_with_the_number_of_tries(self, model: str):
        text, attempts, url = _fail(model, servers.refuse(503, "over\nloaded"), max_retries=2, sleep=lambda _: None)

        assert attempts == 3
        assert text == (
            f"model '{model}@{url}': {url}: status 503 after 3 attempts: over loaded; "
            "expected a server that works, try again later"
        )

    @every_provider
    @pytest.mark.parametrize(
        ("status", "advice"), [(401, "check {KEY}"), (403, "check {KEY}"), (404, "check its name and the address")]
    )
    def test_refusals_are_told_at_once(self, model: str, status: int, advice: str):
        key = f"{model.partition(':')[0].upper()}_API_KEY"

        text, attempts, _ = _fail(model, servers.refuse(status, "no"), max_retries=3)

        assert attempts == 1
        assert f"status {status}: no; expected" in text
        assert text.endswith(advice.replace("{KEY}", key))

    def test_wait_of_hours_is_told_at_once(self):
        text, attempts, _ = _fail("openai:m", servers.refuse(429, "quota", Retry_After="3600"), max_retries=3)

        assert attempts == 1
        assert "status 429: quota (asks to wait 3600 s); expected" in text

    @every_provider
    def test_hanging_server_is_told(self, model: str):
        text, attempts, url = _fail(model, servers.Reply(hangs=True), timeout_s=0.2)

        assert attempts == 1
        assert text.startswith(f"model '{model}@{url}': {url}: no readable answer: ")
        assert "try again later" in text

    @every_provider
    def test_answer_that_is_not_json_is_told(self, model: str):
        text, attempts, _ = _fail(model, servers.Reply("<html>", is_raw=True), max_retries=2)

        # Once as a stream, and where that brings nothing once as a whole.
        assert attempts == (1 if model.startswith("google") else 2)
        assert "no readable answer: " in text
        assert text.endswith("expected an answer in the provider's format, check the address and the options")

    def test_absent_server_is_told(self):
        with servers.serve(servers.Reply()) as server:
            url = server.url
        waits: list[float] = []
        with make_client(
            f"openai:m@{url}", environment={}, max_retries=2, sleep=waits.append, random=lambda: 1.0
        ) as client:
            with pytest.raises(GroundingError, match="no readable answer after 3 attempts: "):
                client.complete(REQUEST)

            assert client.traffic.attempts == 3
        assert waits == [1.0, 2.0]

    def test_bound_of_a_wait_is_a_minute(self):
        waits: list[float] = []
        failure = Failure("down", 503, is_transient=True)

        assert RetryPolicy(8, waits.append, lambda: 1.0).run(lambda: failure) is failure
        assert waits == [1, 2, 4, 8, 16, 32, 60, 60]


class TestModelStrings:
    @pytest.mark.parametrize("model", ["", "gemini", "google:", "gguf:/m.gguf", "openai:@http://h/v1", "openai:a b"])
    def test_malformed_ones_are_refused(self, model: str):
        with pytest.raises(GroundingError, match="no known provider and name; expected google:NAME, anthropic:NAME or"):
            make_client(model, environment=KEYS)

    @pytest.mark.parametrize("url", ["http://", "http://:80/v1", "http://h:99999/v1", "http://[::1/v1"])
    def test_malformed_addresses_are_refused(self, url: str):
        with pytest.raises(GroundingError, match="model 'openai:m@…': no host and port in its URL"):
            make_client(f"openai:m@{url}", environment=KEYS)

    @pytest.mark.parametrize("url", ["http://me:hunter2x@h/v1", "http://hunter2x@h/v1", "https://h/v1?key=hunter2x"])
    def test_credentials_in_an_address_are_refused_without_being_shown(self, url: str):
        with pytest.raises(GroundingError, match="put the key into OPENAI_API_KEY") as caught:
            make_client(f"openai:m@{url}", environment=KEYS)

        assert "hunter2x" not in str(caught.value)

    @pytest.mark.parametrize(
        ("model", "variables"),
        [
            ("google:gemini-2.5-flash", "GOOGLE_API_KEY or GEMINI_API_KEY"),
            ("anthropic:claude-haiku-4-5", "ANTHROPIC_API_KEY"),
            ("openai:gpt-4o", "OPENAI_API_KEY"),
            ("openai:m@https://openrouter.ai/api/v1", "OPENAI_API_KEY"),
        ],
    )
    def test_missing_key_is_told(self, model: str, variables: str):
        with pytest.raises(GroundingError) as caught:
            make_client(model, environment={"OPENAI_API_KEY": " "})

        assert str(caught.value) == f"model '{model}': no key in the environment; expected one, set {variables}"

    @pytest.mark.parametrize("key", ["schlüssel", "two\nlines"])
    def test_key_that_no_header_can_hold_is_refused_without_being_shown(self, key: str):
        with pytest.raises(GroundingError, match="the key contains characters that an HTTP header cannot") as caught:
            make_client("openai:gpt-4o", environment={"OPENAI_API_KEY": key})

        assert key not in str(caught.value)

    @pytest.mark.parametrize("host", ["localhost", "127.0.0.2", "[::1]", "gpu.localhost"])
    def test_loopback_addresses_need_no_key(self, host: str):
        model = f"openai:org/m@v2@http://{host}:8000/v1"
        with make_client(model, environment={}) as client:
            assert client.model == model
            assert client.traffic.attempts == 0

    def test_missing_extra_names_its_install_command(self, monkeypatch: pytest.MonkeyPatch):
        monkeypatch.setitem(sys.modules, "pydantic_ai.models", None)

        with pytest.raises(GroundingError) as caught:
            make_client("openai:gpt-4o", environment=KEYS)

        assert str(caught.value) == (
            "model 'openai:gpt-4o': the module pydantic_ai.models is not installed; "
            "expected the extra `llm`, run pip install 'usd2kg[llm]'"
        )


class TestSecrets:
    @every_provider
    @pytest.mark.parametrize("status", [401, 429])
    def test_key_shows_neither_in_errors_nor_in_logs(self, model: str, status: int, caplog: pytest.LogCaptureFixture):
        caplog.set_level(logging.DEBUG)
        words = " ".join(KEYS.values()) + " sk-proj-abcdef123 at http://me:hunter2x@proxy/"

        text, _, _ = _fail(model, servers.refuse(status, words))

        assert "status" in text and "[key] [key] [key] [key] at http://[key]@proxy/" in text
        for secret in [*KEYS.values(), "hunter2x", "abcdef123"]:
            assert secret not in text
            assert secret not in "".join(map(str, caplog.text.split(words)))

    @every_provider
    def test_key_does_not_show_in_logs_of_what_works(self, model: str, caplog: pytest.LogCaptureFixture):
        caplog.set_level(logging.DEBUG)

        _complete(model, ANSWERS[model])

        assert not [secret for secret in KEYS.values() if secret in caplog.text]

    def test_long_messages_are_cut_after_they_are_redacted(self):
        text = Redactor(["long-secret"])("x" * 295 + "long-secret" + "y" * 100)

        assert len(text) == 300
        assert text == "x" * 295 + "[key…"

    def test_what_is_too_short_to_be_a_secret_stays(self):
        assert Redactor(["none", ""])("none of it\n\tfits") == "none of it fits"


class TestLife:
    def test_threads_share_a_client(self):
        with servers.serve(servers.openai_reply("{}")) as server, _connect(server, "openai:m") as client:
            with ThreadPoolExecutor(8) as pool:
                completions = list(pool.map(lambda _: client.complete(REQUEST).text, range(40)))

            assert completions == ["{}"] * 40
            assert client.traffic.attempts == len(server.received) == 40

    def test_threads_count_their_own_tries(self):
        def fail(client: HttpClient) -> str:
            with pytest.raises(GroundingError) as caught:
                client.complete(REQUEST)
            return str(caught.value)

        with (
            servers.serve(servers.refuse(500, "oops")) as server,
            _connect(server, "openai:m", max_retries=1, sleep=lambda _: None) as client,
            ThreadPoolExecutor(4) as pool,
        ):
            texts = list(pool.map(fail, [client] * 8))
            assert client.traffic.attempts == 16
        assert all("status 500 after 2 attempts: oops" in text for text in texts)

    def test_works_inside_an_event_loop(self):
        async def ask() -> str:
            return _complete("openai:m", servers.openai_reply("{}"))[0].text

        assert asyncio.run(ask()) == "{}"

    def test_interrupted_wait_leaves_the_client_usable(self):
        def interrupt(_: float) -> None:
            raise KeyboardInterrupt

        replies = servers.refuse(500, "oops"), servers.openai_reply("{}")
        with servers.serve(*replies) as server, _connect(server, "openai:m", max_retries=1, sleep=interrupt) as client:
            with pytest.raises(KeyboardInterrupt):
                client.complete(REQUEST)

            assert client.complete(REQUEST).text == "{}"

    def test_connection_is_kept_from_one_request_to_the_next(self):
        with servers.serve(servers.openai_reply("{}")) as server, _connect(server, "openai:m") as client:
            client.complete(REQUEST)
            client.complete(REQUEST)

            assert len({received.port for received in server.received}) == 1

    def test_closed_client_says_so(self):
        client = make_client("openai:m@http://localhost:1/v1", environment={})
        client.close()
        client.close()

        with pytest.raises(GroundingError, match="the client is closed"):
            client.complete(REQUEST)

    def test_forgotten_client_ends_its_thread(self):
        before = set(threading.enumerate())
        client = make_client("openai:m@http://localhost:1/v1", environment={})
        assert len(set(threading.enumerate()) - before) == 1

        del client
        gc.collect()

        assert set(threading.enumerate()) <= before
