"""Completions that come piece by piece, in the three wire formats: whole, looping, endless, broken and refused."""

import itertools
import logging
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.servers import FakeServer, Reply, sse
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import HttpClient, make_client
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.streaming import StreamMonitor

KEYS = {"OPENAI_API_KEY": "none", "GOOGLE_API_KEY": "none", "ANTHROPIC_API_KEY": "none"}
SCHEMA = {"type": "object", "properties": {"class": {"type": "string"}}, "required": ["class"]}
REQUEST = Request("the classes", "the objects", SCHEMA, max_tokens=4000)
"""Estimated at (11 + 11) / 4, rounded up: 6 tokens."""
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


def connect(server: FakeServer, model: str, **options) -> HttpClient:
    return make_client(f"{model}@{server.url}", **({"environment": KEYS, "timeout_s": 10, "max_retries": 0} | options))


def complete(model: str, *replies: Reply, request: Request = REQUEST, **options) -> tuple[Completion, FakeServer]:
    with servers.serve(*replies) as server, connect(server, model, sleep=lambda _: None, **options) as client:
        return client.complete(request), server


def fail(model: str, *replies: Reply, **options) -> tuple[str, int]:
    """The error's text and the requests sent."""
    with servers.serve(*replies) as server, connect(server, model, sleep=lambda _: None, **options) as client:
        with pytest.raises(GroundingError) as caught:
            client.complete(REQUEST)
        return str(caught.value), len(server.received)


def streaming(model: str, texts: Callable[[], Iterable[str]], pause_s: float = 0.0, **options) -> Reply:
    return Reply(events=lambda: EVENTS[model](texts(), **options), pause_s=pause_s)


def la_la_la() -> Iterator[str]:
    """Eight characters for ever."""
    return itertools.repeat("la la la")


def numbers() -> Iterator[str]:
    """A text that neither ends nor loops."""
    return (f"{number * 7919 % 10007} " for number in itertools.count())


def wait_until(is_met: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + 5
    while not is_met() and time.monotonic() < deadline:
        time.sleep(0.01)
    return is_met()


class TestWhole:
    @every_format
    def test_pieces_come_together_with_thinking_and_usage(self, model: str):
        completion, server = complete(model, REPLIES[model](CUP, thinking="a handle"))

        output = 12 if model == GOOGLE else 7
        assert completion == Completion(CUP, Finish.STOP, Usage(100, 60, output), (), "a handle")
        assert server.received[0].asks_for_stream
        assert server.events_sent > 4

    def test_openai_is_asked_to_count(self):
        _, server = complete(OPENAI, REPLIES[OPENAI](CUP))

        assert server.received[0].body["stream_options"] == {"include_usage": True}

    def test_the_limit_of_tokens_is_told(self):
        for model, finish in ((OPENAI, "length"), (GOOGLE, "MAX_TOKENS"), (ANTHROPIC, "max_tokens")):
            completion, _ = complete(model, REPLIES[model]('{"cl', finish=finish))
            assert (completion.text, completion.finish) == ('{"cl', Finish.LENGTH)

    def test_tokens_are_collected_from_the_pieces(self):
        tokens = [('{"class": "', -0.1), ("Cup", -0.3), ('"}', -0.2)]

        completion, _ = complete(OPENAI, servers.openai_reply(CUP, tokens=tokens))

        assert completion.tokens == tuple(tokens)

    def test_a_server_that_never_says_why_it_ended_is_believed_by_its_count(self):
        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: [CUP], finish=None))

        assert (completion.text, completion.finish) == (CUP, Finish.STOP)

    def test_a_server_that_does_not_count_gets_an_estimate(self):
        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: [CUP], usage=None))

        assert completion.usage == Usage(6, 0, 4, estimated_tokens=10)

    def test_a_server_that_tells_the_tokens_has_them_counted(self):
        tokens = [('{"class": "', -0.1), ("Cup", -0.3), ('"}', -0.2)]

        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: [CUP], usage=None, tokens=tokens))

        assert completion.usage == Usage(6, 0, 3, estimated_tokens=6)

    @every_format
    def test_an_empty_answer_is_an_answer(self, model: str):
        completion, _ = complete(model, REPLIES[model](""))

        assert (completion.text, completion.finish) == ("", Finish.STOP)

    @every_format
    def test_connections_are_kept(self, model: str):
        with servers.serve(REPLIES[model](CUP)) as server, connect(server, model) as client:
            for _ in range(3):
                client.complete(REQUEST)

            assert len({received.port for received in server.received}) == 1
            assert server.streams_cut_off == 0


class TestCutOff:
    @every_format
    def test_a_loop_is_cut_off_and_counted(self, model: str, caplog: pytest.LogCaptureFixture):
        with (
            servers.serve(streaming(model, la_la_la, pause_s=0.001)) as server,
            connect(server, model) as client,
        ):
            completion = client.complete(REQUEST)
            assert wait_until(lambda: server.streams_cut_off == 1)
            sent = server.events_sent

        # Looked at every 500 characters: 63 pieces of eight. Gemini counts pieces as it goes, four bytes elsewhere.
        assert completion.text == "la la la" * 63
        assert completion.finish is Finish.DEGENERATE
        expected = {
            OPENAI: Usage(6, 0, 126, estimated_tokens=132),
            GOOGLE: Usage(100, 60, 63),
            ANTHROPIC: Usage(100, 60, 126, estimated_tokens=126),
        }
        assert completion.usage == expected[model]
        assert sent < 200
        assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []

    @every_format
    def test_a_loop_in_the_thinking_is_cut_off(self, model: str):
        completion, _ = complete(model, streaming(model, lambda: [CUP], thinking="hm, a cup. " * 400))

        assert (completion.text, completion.finish) == ("", Finish.DEGENERATE)
        assert completion.thinking == ("hm, a cup. " * 400)[:500]

    @pytest.mark.parametrize("unit", [" ", "\n", "x", '{"1": {"class": "Cup"}}, '])
    def test_what_never_ends_is_cut_off(self, unit: str):
        completion, _ = complete(OPENAI, streaming(OPENAI, lambda: itertools.repeat(unit * 4)))

        assert completion.finish is Finish.DEGENERATE
        assert len(completion.text) < 2000

    def test_rows_for_many_objects_are_no_loop(self):
        text = "{" + ", ".join(f'"{number}": {{"class": "Cup"}}' for number in range(1, 401)) + "}"

        completion, _ = complete(OPENAI, servers.openai_reply(text))

        assert (completion.text, completion.finish) == (text, Finish.STOP)

    @every_format
    def test_a_server_that_does_not_keep_to_the_limit_is_cut_off(self, model: str):
        completion, _ = complete(model, streaming(model, numbers), request=replace(REQUEST, max_tokens=100))

        assert completion.finish is Finish.LENGTH
        assert 3200 < len(completion.text) < 3300

    @every_format
    def test_the_client_goes_on_after_a_cut(self, model: str):
        with (
            servers.serve(streaming(model, la_la_la), REPLIES[model](CUP)) as server,
            connect(server, model) as client,
        ):
            assert client.complete(REQUEST).finish is Finish.DEGENERATE
            assert client.complete(REQUEST).text == CUP


class TestWatch:
    def test_a_text_is_looked_at_when_there_is_enough_of_it(self):
        watch = StreamMonitor(max_tokens=1000)

        found = [watch.add("la la la ") for _ in range(60)]

        # 55 pieces of nine are 495 characters.
        assert found.index(Finish.DEGENERATE) == 55

    def test_another_text_is_looked_at_by_itself(self):
        watch = StreamMonitor(max_tokens=1000)

        assert {watch.add("la la la ") for _ in range(50)} == {None}
        assert {watch.add("la la la ", is_first=number == 0) for number in range(50)} == {None}

    def test_all_texts_count_towards_the_limit(self):
        watch = StreamMonitor(max_tokens=1)

        assert watch.add("x" * 20) is None
        assert watch.add("y" * 12, is_first=True) is None
        assert watch.add("z") is Finish.LENGTH


class TestTime:
    @every_format
    def test_a_server_that_trickles_for_ever_is_bounded_in_all(self, model: str):
        start = time.monotonic()

        text, requests = fail(model, streaming(model, numbers, pause_s=0.02), timeout_s=0.4)

        assert 0.4 <= time.monotonic() - start < 3
        assert requests == 1
        assert "timed out after 0.4 seconds; expected a server that is up" in text

    def test_a_huge_stream_is_read_in_little_time(self):
        """Half a million characters without a loop."""
        words = numbers()
        pieces = ["".join(itertools.islice(words, 100)) for _ in range(1000)]
        start = time.monotonic()

        completion, _ = complete(
            OPENAI, streaming(OPENAI, lambda: pieces), request=replace(REQUEST, max_tokens=60_000), timeout_s=60
        )

        assert completion.text == "".join(pieces)
        assert len(completion.text) > 475_000
        assert time.monotonic() - start < 30


class TestTrouble:
    @every_format
    @pytest.mark.parametrize("after", [1, 3])
    def test_a_stream_that_breaks_off_is_asked_for_again(self, model: str, after: int):
        whole = REPLIES[model](CUP)

        completion, server = complete(model, servers.broken_off(whole, after), whole, max_retries=1)

        assert completion.text == CUP
        assert len(server.received) == 2

    @every_format
    def test_a_stream_that_ends_too_early_is_asked_for_again(self, model: str):
        """As servers do that fall over behind a proxy: the body is whole, the answer is not."""
        whole = REPLIES[model](CUP)
        early = replace(servers.broken_off(whole, 4), is_broken=False)

        assert complete(model, early, whole, max_retries=1)[0].text == CUP
        text, requests = fail(model, early, max_retries=1)
        assert requests == 2
        assert "no readable answer after 2 attempts: the stream broke off; expected a server that is up" in text

    @every_format
    def test_a_refusal_before_the_stream_is_waited_for(self, model: str):
        waits: list[float] = []
        replies = servers.refuse(429, "slow down", Retry_After="7"), REPLIES[model](CUP)
        with servers.serve(*replies) as server, connect(server, model, max_retries=1, sleep=waits.append) as client:
            assert client.complete(REQUEST).text == CUP
        assert waits == [7.0]

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
    def test_an_error_inside_a_stream_is_tried_again(
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
    def test_an_error_that_stays_is_not_tried_again(self, model: str, error: str):
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
    def test_nonsense_is_told_in_a_line(self, model: str, piece: str, before: int, caplog: pytest.LogCaptureFixture):
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


class TestRefusals:
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
    def test_a_refused_stream_is_asked_for_whole_from_then_on(self, model: str, status: int, message: str):
        with (
            servers.serve(servers.refuse(status, message), REPLIES[model](CUP)) as server,
            connect(server, model) as client,
        ):
            completions = [client.complete(REQUEST), client.complete(REQUEST)]

            assert [received.asks_for_stream for received in server.received] == [True, False, False]
        assert [completion.text for completion in completions] == [CUP, CUP]
        assert completions[0].usage.input_tokens == 100

    @every_format
    def test_a_server_that_answers_whole_all_the_same_is_understood(self, model: str):
        whole = replace(REPLIES[model](CUP), events=None)
        with servers.serve(whole) as server, connect(server, model) as client:
            completions = [client.complete(REQUEST), client.complete(REQUEST)]
        assert [completion.text for completion in completions] == [CUP, CUP]
        assert completions[0].usage.input_tokens == 100

    def test_several_refusals_are_learnt_one_after_another(self):
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

    def test_requests_on_their_way_together_all_get_over_a_refusal(self):
        """Four are refused before the first of them can tell the others."""
        refusal = servers.refuse(400, "response_format json_schema is unknown")
        refusal = replace(refusal, together=threading.Barrier(4))
        with (
            servers.serve(*[refusal] * 4, servers.openai_reply(CUP)) as server,
            connect(server, OPENAI) as client,
            ThreadPoolExecutor(4) as pool,
        ):
            texts = list(pool.map(lambda _: client.complete(REQUEST).text, range(4)))
        assert texts == [CUP] * 4

    def test_an_upstream_failure_is_no_refusal_to_stream(self):
        text, requests = fail(OPENAI, servers.refuse(500, "upstream connect error"))

        assert requests == 1
        assert "status 500: upstream connect error" in text
