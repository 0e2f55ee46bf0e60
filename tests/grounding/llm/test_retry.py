"""Retries of failed requests, and redaction of credentials."""

import logging

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.connections import ANSWERS, KEYS, REQUEST, complete, endpoint, every_provider, fail, locate
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.model_reference import KEY_VARIABLES
from usd2kg.grounding.llm.retry import Failure, Redactor, RetryPolicy


class TestRetries:
    @every_provider
    def test_waits_as_long_as_the_server_asks(self, model: str):
        waits: list[float] = []

        completion, received = complete(
            model, servers.refuse(429, "slow down", Retry_After="7"), ANSWERS[model], max_retries=1, sleep=waits.append
        )

        assert (completion.text, len(received), waits) == ("{}", 2, [7.0])

    @every_provider
    def test_backoff_doubles_with_full_jitter(self, model: str):
        waits: list[float] = []
        failures = [servers.refuse(status, "oops") for status in (500, 503, 408, 409)]

        _, received = complete(
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
    def test_retries_broken_and_hanging_connections(self, model: str, fault: str):
        first = {
            "broken": servers.broken_off(ANSWERS[model], after=2),
            "hanging": servers.Reply(hangs=True),
            "not JSON from a proxy": servers.Reply("<html>Bad Gateway", 502, is_raw=True),
        }[fault]

        completion, received = complete(
            model, first, ANSWERS[model], max_retries=1, timeout_s=0.3, sleep=lambda _: None
        )

        assert (completion.text, len(received)) == ("{}", 2)

    @every_provider
    def test_reports_the_last_failure_with_the_number_of_attempts(self, model: str):
        text, attempts, url = fail(model, servers.refuse(503, "over\nloaded"), max_retries=2, sleep=lambda _: None)

        assert attempts == 3
        assert text == (
            f"model '{locate(model, url)}': {endpoint(model, url)}: status 503 after 3 attempts: over loaded; "
            "the server failed, try again later"
        )

    @every_provider
    @pytest.mark.parametrize(
        ("status", "advice"), [(401, "check {KEY}"), (403, "check {KEY}"), (404, "check its name and the address")]
    )
    def test_reports_rejections_without_retry(self, model: str, status: int, advice: str):
        key = " or ".join(KEY_VARIABLES[model.partition(":")[0]])

        text, attempts, _ = fail(model, servers.refuse(status, "no"), max_retries=3)

        assert attempts == 1
        assert f"status {status}: no; expected" in text
        assert text.endswith(advice.replace("{KEY}", key))

    def test_reports_a_long_requested_wait_without_retry(self):
        text, attempts, _ = fail("openai:m", servers.refuse(429, "quota", Retry_After="3600"), max_retries=3)

        assert attempts == 1
        assert "status 429: quota (asks to wait 3600 s); expected" in text

    @every_provider
    def test_reports_a_timeout(self, model: str):
        text, attempts, url = fail(model, servers.Reply(hangs=True), timeout_s=1)

        assert attempts == 1
        assert text.startswith(f"model '{locate(model, url)}': {endpoint(model, url)}: no readable answer: ")
        assert "try again later" in text

    @pytest.mark.parametrize("model", [model for model in ANSWERS if not model.startswith("bedrock")])
    def test_reports_a_response_that_is_not_json(self, model: str):
        text, attempts, _ = fail(model, servers.Reply("<html>", is_raw=True), max_retries=2)

        # One attempt with streaming and, without a result, one without.
        assert attempts == (1 if model.startswith("google") else 2)
        assert "no readable answer: " in text
        assert text.endswith("expected an answer in the provider's format, check the address and the options")

    def test_a_body_that_is_no_stream_of_bedrock_counts_as_broken(self):
        model = next(model for model in ANSWERS if model.startswith("bedrock"))

        text, attempts, _ = fail(model, servers.Reply("<html>", is_raw=True), max_retries=1, sleep=lambda _: None)

        assert attempts == 2
        assert "no readable answer after 2 attempts: the stream broke off; expected a server that is up" in text

    def test_reports_an_unreachable_server(self):
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

    def test_backoff_is_at_most_a_minute(self):
        waits: list[float] = []
        failure = Failure("down", 503, is_transient=True)

        assert RetryPolicy(8, waits.append, lambda: 1.0).run(lambda: failure) is failure
        assert waits == [1, 2, 4, 8, 16, 32, 60, 60]


class TestSecrets:
    @every_provider
    @pytest.mark.parametrize("status", [401, 429])
    def test_keys_appear_neither_in_errors_nor_in_logs(self, model: str, status: int, caplog: pytest.LogCaptureFixture):
        caplog.set_level(logging.DEBUG)
        words = " ".join(KEYS.values()) + " sk-proj-abcdef123 at http://me:hunter2x@proxy/"

        text, _, _ = fail(model, servers.refuse(status, words))

        assert "status" in text and "[key] [key] [key] [key] at http://[key]@proxy/" in text
        for secret in [*KEYS.values(), "hunter2x", "abcdef123"]:
            assert secret not in text
            assert secret not in "".join(map(str, caplog.text.split(words)))

    @every_provider
    def test_keys_do_not_appear_in_logs_of_successful_requests(self, model: str, caplog: pytest.LogCaptureFixture):
        caplog.set_level(logging.DEBUG)

        complete(model, ANSWERS[model])

        assert not [secret for secret in KEYS.values() if secret in caplog.text]

    def test_truncates_messages_after_redaction(self):
        text = Redactor(["long-secret"])("x" * 295 + "long-secret" + "y" * 100)

        assert len(text) == 300
        assert text == "x" * 295 + "[key…"

    def test_does_not_redact_very_short_keys(self):
        assert Redactor(["none", ""])("none of it\n\tfits") == "none of it fits"
