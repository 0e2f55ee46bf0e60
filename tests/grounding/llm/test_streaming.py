"""Streamed completions in the formats of the three providers: complete, degenerate, broken and rejected."""

import itertools
import logging
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.connections import connect
from tests.grounding.llm.servers import FakeServer, Reply, sse
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.streaming import StreamMonitor

SCHEMA = {"type": "object", "properties": {"class": {"type": "string"}}, "required": ["class"]}
REQUEST = Request("the classes", "the objects", SCHEMA, max_tokens=4000)
"""Estimated at (11 + 11) / 4 tokens, rounded up to 6."""
CUP = '{"class": "Cup"}'
OPENAI, GOOGLE, ANTHROPIC = "openai:m", "google:gemini-2.5-flash", "anthropic:claude-haiku-4-5"
REPLIES: dict[str, Callable[..., Reply]] = {
    OPENAI: servers.openai_reply,
    GOOGLE: servers.gemini_reply,
    ANTHROPIC: servers.anthropic_reply,
}
EVENTS: dict[str, Callable[..., Iterator[str]]] = {
    OPENAI: servers.openai_events,
    GOOGLE: servers.gemini_events,
    ANTHROPIC: servers.anthropic_events,
}
every_format = pytest.mark.parametrize("model", REPLIES)


def complete(model: str, *replies: Reply, request: Request = REQUEST, **options) -> tuple[Completion, FakeServer]:
    with servers.serve(*replies) as server, connect(server, model, sleep=lambda _: None, **options) as client:
        return client.complete(request), server


def fail(model: str, *replies: Reply, **options) -> tuple[str, int]:
    """Return the error message and the number of requests."""
    with servers.serve(*replies) as server, connect(server, model, sleep=lambda _: None, **options) as client:
        with pytest.raises(GroundingError) as caught:
            client.complete(REQUEST)
        return str(caught.value), len(server.received)


def streaming(model: str, texts: Callable[[], Iterable[str]], pause_s: float = 0.0, **options) -> Reply:
    return Reply(events=lambda: EVENTS[model](texts(), **options), pause_s=pause_s)


def la_la_la() -> Iterator[str]:
    """Yield eight characters forever."""
    return itertools.repeat("la la la")


def numbers() -> Iterator[str]:
    """Yield an endless text without repetition."""
    return (f"{number * 7919 % 10007} " for number in itertools.count())


def wait_until(is_met: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + 5
    while not is_met() and time.monotonic() < deadline:
        time.sleep(0.01)
    return is_met()


class TestCompleteStreams:
    @every_format
    def test_joins_text_thinking_and_usage(self, model: str):
        completion, server = complete(model, REPLIES[model](CUP, thinking="a handle"))

        output = 12 if model == GOOGLE else 7
        assert completion == Completion(CUP, Finish.STOP, Usage(100, 60, output), (), "a handle")
        assert server.received[0].asks_for_stream
        assert server.events_sent > 4

    def test_reports_a_reached_token_limit(self):
        for model, finish in ((OPENAI, "length"), (GOOGLE, "MAX_TOKENS"), (ANTHROPIC, "max_tokens")):
            completion, _ = complete(model, REPLIES[model]('{"cl', finish=finish))
            assert (completion.text, completion.finish) == ('{"cl', Finish.LENGTH)

    def test_usage_marks_a_stream_without_finish_reason_as_complete(self):
        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: [CUP], finish=None))

        assert (completion.text, completion.finish) == (CUP, Finish.STOP)

    def test_estimates_usage_that_the_server_does_not_report(self):
        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: [CUP], usage=None))

        assert completion.usage == Usage(6, 0, 4, estimated_tokens=10)

    def test_counts_returned_tokens_without_reported_usage(self):
        tokens = [('{"class": "', -0.1), ("Cup", -0.3), ('"}', -0.2)]

        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: [CUP], usage=None, tokens=tokens))

        assert completion.usage == Usage(6, 0, 3, estimated_tokens=6)

    @every_format
    def test_accepts_an_empty_completion(self, model: str):
        completion, _ = complete(model, REPLIES[model](""))

        assert (completion.text, completion.finish) == ("", Finish.STOP)

    @every_format
    def test_reuses_connections(self, model: str):
        with servers.serve(REPLIES[model](CUP)) as server, connect(server, model) as client:
            for _ in range(3):
                client.complete(REQUEST)

            assert len({received.port for received in server.received}) == 1
            assert server.streams_cut_off == 0


class TestCutoff:
    @every_format
    def test_cuts_off_a_loop_and_counts_its_tokens(self, model: str, caplog: pytest.LogCaptureFixture):
        with (
            servers.serve(streaming(model, la_la_la, pause_s=0.001)) as server,
            connect(server, model) as client,
        ):
            completion = client.complete(REQUEST)
            assert wait_until(lambda: server.streams_cut_off == 1)
            sent = server.events_sent

        # Checked every 500 characters, after 63 pieces of eight. Gemini reports usage; for others it is estimated.
        assert completion.text == "la la la" * 63
        assert completion.finish is Finish.DEGENERATE
        expected = {
            OPENAI: Usage(6, 0, 126, estimated_tokens=132),
            GOOGLE: Usage(100, 60, 63),
            ANTHROPIC: Usage(100, 60, 126, estimated_tokens=126),
        }
        assert completion.usage == expected[model]
        # The server sends on until the connection is closed, longer on a busy machine.
        assert sent < 1_000
        assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []

    @every_format
    def test_cuts_off_a_loop_in_the_thinking(self, model: str):
        completion, _ = complete(model, streaming(model, lambda: [CUP], thinking="hm, a cup. " * 400))

        assert (completion.text, completion.finish) == ("", Finish.DEGENERATE)
        assert completion.thinking == ("hm, a cup. " * 400)[:500]

    @pytest.mark.parametrize("unit", [" ", "\n", "x", '{"1": {"class": "Cup"}}, '])
    def test_cuts_off_endless_repetitions(self, unit: str):
        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: itertools.repeat(unit * 4)))

        assert completion.finish is Finish.DEGENERATE
        assert len(completion.text) < 2000

    def test_does_not_cut_off_many_equal_rows(self):
        text = "{" + ", ".join(f'"{number}": {{"class": "Cup"}}' for number in range(1, 401)) + "}"

        completion, _ = complete(OPENAI, servers.openai_reply(text))

        assert (completion.text, completion.finish) == (text, Finish.STOP)

    @every_format
    def test_cuts_off_a_server_that_ignores_the_token_limit(self, model: str):
        completion, _ = complete(model, streaming(model, numbers), request=replace(REQUEST, max_tokens=100))

        assert completion.finish is Finish.LENGTH
        assert 3200 < len(completion.text) < 3300

    @every_format
    def test_stays_usable_after_a_cutoff(self, model: str):
        with (
            servers.serve(streaming(model, la_la_la), REPLIES[model](CUP)) as server,
            connect(server, model) as client,
        ):
            assert client.complete(REQUEST).finish is Finish.DEGENERATE
            assert client.complete(REQUEST).text == CUP


class TestStreamMonitor:
    def test_checks_a_text_at_intervals(self):
        watch = StreamMonitor(max_tokens=1000)

        found = [watch.add("la la la ") for _ in range(60)]

        # 55 pieces of nine are 495 characters.
        assert found.index(Finish.DEGENERATE) == 55

    def test_checks_each_text_separately(self):
        watch = StreamMonitor(max_tokens=1000)

        assert {watch.add("la la la ") for _ in range(50)} == {None}
        assert {watch.add("la la la ", is_first=number == 0) for number in range(50)} == {None}

    def test_all_texts_count_towards_the_limit(self):
        watch = StreamMonitor(max_tokens=1)

        assert watch.add("x" * 20) is None
        assert watch.add("y" * 12, is_first=True) is None
        assert watch.add("z") is Finish.LENGTH


class TestDuration:
    @every_format
    def test_limits_the_duration_of_a_slow_stream(self, model: str):
        start = time.monotonic()

        text, requests = fail(model, streaming(model, numbers, pause_s=0.02), timeout_s=0.4)

        assert 0.4 <= time.monotonic() - start < 3
        assert requests == 1
        assert "timed out after 0.4 seconds; expected a server that is up" in text

    def test_reads_a_long_stream_in_linear_time(self):
        """Half a million characters without repetition."""
        words = numbers()
        pieces = ["".join(itertools.islice(words, 100)) for _ in range(1000)]
        start = time.monotonic()

        completion, _ = complete(
            OPENAI, streaming(OPENAI, lambda: pieces), request=replace(REQUEST, max_tokens=60_000), timeout_s=60
        )

        assert completion.text == "".join(pieces)
        assert len(completion.text) > 475_000
        assert time.monotonic() - start < 30


class TestFailures:
    @every_format
    @pytest.mark.parametrize("after", [1, 3])
    def test_retries_a_broken_stream(self, model: str, after: int):
        whole = REPLIES[model](CUP)

        completion, server = complete(model, servers.broken_off(whole, after), whole, max_retries=1)

        assert completion.text == CUP
        assert len(server.received) == 2

    @every_format
    def test_retries_a_truncated_stream(self, model: str):
        """The response is complete, but the completion is not, as with a proxy whose server has failed."""
        whole = REPLIES[model](CUP)
        early = replace(servers.broken_off(whole, 4), is_broken=False)

        assert complete(model, early, whole, max_retries=1)[0].text == CUP
        text, requests = fail(model, early, max_retries=1)
        assert requests == 2
        assert "no readable answer after 2 attempts: the stream broke off; expected a server that is up" in text

    @pytest.mark.parametrize(
        ("model", "error", "status"),
        [
            (OPENAI, sse({"error": {"message": "overloaded", "type": "server_error", "code": 503}}), "status 500"),
            (OPENAI, sse({"error": {"message": "overloaded"}}), "no readable answer"),
            (GOOGLE, sse({"error": {"code": 503, "message": "overloaded", "status": "UNAVAILABLE"}}), "status 503"),
            (
                ANTHROPIC,
                sse({"type": "error", "error": {"type": "overloaded_error", "message": "overloaded"}}, "error"),
                "status 529",
            ),
        ],
    )
    @pytest.mark.parametrize("before", [0, 3])
    def test_retries_a_transient_error_inside_a_stream(
        self, model: str, error: str, status: str, before: int, caplog: pytest.LogCaptureFixture
    ):
        whole = REPLIES[model](CUP)
        failing = replace(whole, events=lambda: [*itertools.islice(whole.events(), before), error])

        assert complete(model, failing, whole, max_retries=1)[0].text == CUP
        text, requests = fail(model, failing, max_retries=1)
        assert requests == 2
        assert f"{status} after 2 attempts: overloaded" in text
        assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []

    @pytest.mark.parametrize(
        ("model", "error"),
        [
            (OPENAI, sse({"error": {"message": "bad prompt", "type": "invalid_request_error", "code": 400}})),
            (GOOGLE, sse({"error": {"code": 400, "message": "bad prompt", "status": "INVALID_ARGUMENT"}})),
            (
                ANTHROPIC,
                sse({"type": "error", "error": {"type": "invalid_request_error", "message": "bad prompt"}}, "error"),
            ),
        ],
    )
    def test_does_not_retry_a_permanent_error_inside_a_stream(self, model: str, error: str):
        text, requests = fail(model, Reply(events=lambda: [error]), max_retries=3)

        assert requests == 1
        assert "status 400: bad prompt" in text

    @pytest.mark.parametrize(
        ("model", "piece"),
        [
            (OPENAI, "data: {nonsense\n\n"),
            (OPENAI, "data: [1, 2]\n\n"),
            (OPENAI, 'data: {"choices": "x"}\n\n'),
            (GOOGLE, "data: {nonsense\n\n"),
            (GOOGLE, 'data: {"error": {"message": "no code"}}\n\n'),
        ],
    )
    @pytest.mark.parametrize("before", [0, 2])
    def test_reports_a_malformed_event(self, model: str, piece: str, before: int, caplog: pytest.LogCaptureFixture):
        whole = REPLIES[model](CUP)
        odd = Reply(events=lambda: [*itertools.islice(whole.events(), before), piece])

        text, requests = fail(model, odd, max_retries=3)

        assert requests == 1
        assert "expected an answer in the provider's format" in text
        assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []

    def test_closing_the_client_closes_its_streams(self):
        reply = streaming(OPENAI, numbers, pause_s=0.01)
        with servers.serve(reply) as server, connect(server, OPENAI) as client:
            with ThreadPoolExecutor(1) as pool:
                future = pool.submit(client.complete, REQUEST)
                assert wait_until(lambda: server.events_sent > 3)
                client.close()
                assert future.exception(timeout=5) is not None
            assert wait_until(lambda: server.streams_cut_off == 1)


class TestRejections:
    @every_format
    @pytest.mark.parametrize(
        ("status", "message"),
        [
            (400, "'stream' must be false"),
            (422, "body.stream_options: Extra inputs are not permitted"),
            (400, "Your organization must be verified to stream this model."),
            (501, "Streaming is not implemented"),
        ],
    )
    def test_stops_streaming_after_a_rejection(self, model: str, status: int, message: str):
        with (
            servers.serve(servers.refuse(status, message), REPLIES[model](CUP)) as server,
            connect(server, model) as client,
        ):
            completions = [client.complete(REQUEST), client.complete(REQUEST)]

            assert [received.asks_for_stream for received in server.received] == [True, False, False]
        assert [completion.text for completion in completions] == [CUP, CUP]
        assert completions[0].usage.input_tokens == 100

    @every_format
    def test_accepts_a_response_that_is_not_streamed(self, model: str):
        whole = replace(REPLIES[model](CUP), events=None)
        with servers.serve(whole) as server, connect(server, model) as client:
            completions = [client.complete(REQUEST), client.complete(REQUEST)]
        assert [completion.text for completion in completions] == [CUP, CUP]
        assert completions[0].usage.input_tokens == 100

    def test_drops_several_rejected_features(self):
        replies = [
            servers.refuse(400, "logprobs is not supported"),
            servers.refuse(422, "stream_options: extra fields not permitted"),
            servers.refuse(400, "response_format json_schema is unknown"),
            servers.openai_reply(CUP),
        ]
        with servers.serve(*replies) as server, connect(server, OPENAI) as client:
            client.complete(REQUEST)
            client.complete(REQUEST)
            body = server.received[-1].body
            assert len(server.received) == 5
        assert body["stream"] is False
        assert "logprobs" not in body
        assert body["response_format"]["type"] == "json_object"

    def test_concurrent_requests_all_recover_from_a_rejection(self):
        """Four requests are rejected before the client can drop the feature."""
        refusal = servers.refuse(400, "response_format json_schema is unknown")
        refusal = replace(refusal, together=threading.Barrier(4))
        with (
            servers.serve(*[refusal] * 4, servers.openai_reply(CUP)) as server,
            connect(server, OPENAI) as client,
            ThreadPoolExecutor(4) as pool,
        ):
            texts = list(pool.map(lambda _: client.complete(REQUEST).text, range(4)))
        assert texts == [CUP] * 4

    def test_an_upstream_failure_does_not_disable_streaming(self):
        text, requests = fail(OPENAI, servers.refuse(500, "upstream connect error"))

        assert requests == 1
        assert "status 500: upstream connect error" in text
