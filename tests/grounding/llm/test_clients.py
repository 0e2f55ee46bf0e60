"""HttpClient with threads, event loops and interrupts."""

import asyncio
import gc
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.grounding.llm import servers
from tests.grounding.llm.connections import REQUEST, complete, connect
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.clients import HttpClient, make_client


class TestHttpClient:
    def test_threads_share_a_client(self):
        with servers.serve(servers.openai_reply("{}")) as server, connect(server, "openai:m") as client:
            with ThreadPoolExecutor(8) as pool:
                completions = list(pool.map(lambda _: client.complete(REQUEST).text, range(40)))

            assert completions == ["{}"] * 40
            assert client.traffic.attempts == len(server.received) == 40

    def test_threads_count_their_own_attempts(self):
        def fail(client: HttpClient) -> str:
            with pytest.raises(GroundingError) as caught:
                client.complete(REQUEST)
            return str(caught.value)

        with (
            servers.serve(servers.refuse(500, "oops")) as server,
            connect(server, "openai:m", max_retries=1, sleep=lambda _: None) as client,
            ThreadPoolExecutor(4) as pool,
        ):
            texts = list(pool.map(fail, [client] * 8))
            assert client.traffic.attempts == 16
        assert all("status 500 after 2 attempts: oops" in text for text in texts)

    def test_works_inside_an_event_loop(self):
        async def ask() -> str:
            return complete("openai:m", servers.openai_reply("{}"))[0].text

        assert asyncio.run(ask()) == "{}"

    def test_stays_usable_after_an_interrupted_wait(self):
        def interrupt(_: float) -> None:
            raise KeyboardInterrupt

        replies = servers.refuse(500, "oops"), servers.openai_reply("{}")
        with servers.serve(*replies) as server, connect(server, "openai:m", max_retries=1, sleep=interrupt) as client:
            with pytest.raises(KeyboardInterrupt):
                client.complete(REQUEST)

            assert client.complete(REQUEST).text == "{}"

    def test_reports_use_after_close(self):
        client = make_client("openai:m@http://localhost:1/v1", environment={})
        client.close()
        client.close()

        with pytest.raises(GroundingError, match="the client is closed"):
            client.complete(REQUEST)

    def test_garbage_collection_ends_the_thread(self):
        before = set(threading.enumerate())
        client = make_client("openai:m@http://localhost:1/v1", environment={})
        assert len(set(threading.enumerate()) - before) == 1

        del client
        gc.collect()

        assert set(threading.enumerate()) <= before
