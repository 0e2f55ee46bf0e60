"""Requests to Google and Anthropic, and images for all providers."""

import base64
import json
from dataclasses import replace

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.connections import ANSWERS, REQUEST, SCHEMA, complete, connect, every_provider
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Usage


class TestGoogle:
    def test_requests_the_schema(self):
        _, (received,) = complete("google:gemini-2.5-flash", servers.gemini_reply("{}"))

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
    def test_sets_a_thinking_budget_or_level(self, name: str, is_thinking: bool, expected):
        request = replace(REQUEST, is_thinking=is_thinking)

        _, (received,) = complete(f"google:{name}", servers.gemini_reply("{}"), request=request)

        assert received.body["generationConfig"]["thinkingConfig"] == expected

    def test_counts_thoughts_as_output(self):
        completion, _ = complete("google:gemini-2.5-flash", servers.gemini_reply("{}", thinking="a blade"))

        assert completion == Completion("{}", Finish.STOP, Usage(100, 60, 7 + 5), (), "a blade")

    def test_accepts_the_older_key_variable(self):
        _, (received,) = complete(
            "google:gemini-2.5-flash", servers.gemini_reply("{}"), environment={"GEMINI_API_KEY": " other-key\n"}
        )

        assert received.headers["x-goog-api-key"] == "other-key"


class TestAnthropic:
    def test_requests_the_schema_and_caches_the_system_prompt(self):
        _, (received,) = complete("anthropic:claude-haiku-4-5", servers.anthropic_reply("{}"))

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

    def test_older_models_get_half_the_tokens_as_thinking_budget(self):
        request = replace(REQUEST, is_thinking=True)

        _, (received,) = complete("anthropic:claude-haiku-4-5", servers.anthropic_reply("{}"), request=request)

        assert received.body["thinking"] == {"type": "enabled", "budget_tokens": 2000}
        assert received.body["max_tokens"] == 4000
        assert "temperature" not in received.body

    def test_newer_models_get_adaptive_thinking(self):
        request = replace(REQUEST, is_thinking=True)

        _, (received,) = complete("anthropic:claude-opus-4-8", servers.anthropic_reply("{}"), request=request)

        assert received.body["thinking"] == {"type": "adaptive"}

    def test_rejects_a_token_limit_too_small_for_thinking(self):
        request = replace(REQUEST, is_thinking=True, max_tokens=2047)
        with (
            servers.serve(servers.anthropic_reply("{}")) as server,
            connect(server, "anthropic:claude-haiku-4-5") as client,
        ):
            with pytest.raises(
                GroundingError, match="2047 output tokens leave no room to think; expected at least 2048"
            ):
                client.complete(request)

            assert client.traffic.attempts == 0 and server.received == []

    def test_counts_cached_tokens_as_input(self):
        reply = servers.anthropic_reply("{}", thinking="a blade")

        completion, _ = complete("anthropic:claude-haiku-4-5", reply)

        assert completion == Completion("{}", Finish.STOP, Usage(40 + 60, 60, 7), (), "a blade")

    def test_counts_tokens_written_to_the_cache(self):
        reply = servers.anthropic_reply("{}")
        reply.body["usage"] = servers.ANTHROPIC_USAGE | {"cache_creation_input_tokens": 30}

        completion, _ = complete("anthropic:claude-haiku-4-5", replace(reply, events=None))

        assert completion.usage == Usage(40 + 60 + 30, 60, 7, written_tokens=30)

    def test_describes_the_schema_in_the_prompt_of_models_without_support(self):
        _, (received,) = complete("anthropic:claude-unheard-of", servers.anthropic_reply("{}"))

        assert "output_config" not in received.body
        assert '"Knife"' in json.dumps(received.body["system"]).replace('\\"', '"')


class TestImages:
    """Two images, whose bytes arrive unchanged."""

    IMAGES = (b"\x89PNG\r\n\x1a\n first", b"\x89PNG\r\n\x1a\n second")
    BASE64 = tuple(base64.b64encode(image).decode() for image in IMAGES)
    REQUEST = replace(REQUEST, images=IMAGES)

    def test_openai_gets_data_urls(self):
        _, (received,) = complete("openai:m", servers.openai_reply("{}"), request=self.REQUEST)

        text, *images = received.body["messages"][1]["content"]
        assert text == {"type": "text", "text": "the objects"}
        assert [image["type"] for image in images] == ["image_url"] * 2
        assert [image["image_url"]["url"] for image in images] == [
            f"data:image/png;base64,{data}" for data in self.BASE64
        ]

    def test_google_gets_inline_data(self):
        _, (received,) = complete("google:gemini-2.5-flash", servers.gemini_reply("{}"), request=self.REQUEST)

        ((text, *images),) = [content["parts"] for content in received.body["contents"]]
        assert text == {"text": "the objects"}
        assert [image["inlineData"]["mime_type"] for image in images] == ["image/png"] * 2
        sent = [base64.urlsafe_b64decode(image["inlineData"]["data"]) for image in images]
        assert sent == list(self.IMAGES)

    def test_anthropic_gets_sources(self):
        _, (received,) = complete("anthropic:claude-haiku-4-5", servers.anthropic_reply("{}"), request=self.REQUEST)

        text, *images = received.body["messages"][0]["content"]
        assert (text["type"], text["text"]) == ("text", "the objects")
        assert [image["type"] for image in images] == ["image"] * 2
        assert [image["source"] for image in images] == [
            {"type": "base64", "media_type": "image/png", "data": data} for data in self.BASE64
        ]

    @every_provider
    def test_are_sent_without_streaming_too(self, model: str):
        whole = replace(ANSWERS[model], events=None)
        completion, received = complete(model, servers.refuse(400, "no stream"), whole, request=self.REQUEST)

        assert completion.text == "{}"
        assert [self.BASE64[1] in json.dumps(sent.body).replace("-", "+").replace("_", "/") for sent in received] == [
            True,
            True,
        ]
