"""Batch jobs at services that behave like OpenAI, Anthropic and Gemini."""

import json
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import pytest
from pydantic_ai.models.anthropic import AnthropicModel

from tests.grounding.llm.batch_servers import BatchServer, Reply, Row, refuse, serve_batches
from tests.grounding.llm.connections import KEYS, locate
from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.batch_jobs.journal import JobJournal
from usd2kg.grounding.llm.batch_jobs.queue import BatchQueue, DeferredError, Reporting
from usd2kg.grounding.llm.cache import CompletionCache
from usd2kg.grounding.llm.clients import make_client
from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.metered_client import Budget, MeteredClient, NotAskedError
from usd2kg.grounding.llm.prices import parse_price
from usd2kg.grounding.llm.prompts import object_schema

MODELS = ("openai:m", "anthropic:claude-haiku-4-5", "google:gemini-2.5-flash")
every_service = pytest.mark.parametrize("model", MODELS)
CUP = json.dumps({"1": {"class": "Cup"}})
SCHEMA = object_schema({"1": object_schema({"class": {"type": "string", "enum": ["Knife", "Cup"]}})})


def about(number: int) -> Request:
    return Request("the classes", f"object {number}", SCHEMA, max_tokens=4000)


def cup(prompt: str) -> Row:
    return Row(CUP)


class Session:
    """A metered client with batch jobs, as one run of a command has it."""

    def __init__(self, server: BatchServer, model: str, path: Path, **options) -> None:
        self.said: list[str] = []
        self.slept: list[float] = []
        self.cache = CompletionCache(path / "said.sqlite")
        self.client = make_client(at(server, model), environment=KEYS, sleep=self.slept.append)
        self.journal = JobJournal(self.cache)
        reporting = Reporting(self.said.append, lambda text: None, self.slept.append)
        queue = BatchQueue(self.client.model, self.journal, self.client.open_batch_service(), reporting)
        self.metered = MeteredClient(self.client, cache=self.cache, queue=queue, **options)

    def complete(self, *requests: Request) -> list[Completion | str]:
        """Return the completions, or why there are none, after as many jobs as it takes."""
        while True:
            outcomes = [self._ask(request) for request in requests]
            if None not in outcomes:
                return outcomes
            self.metered.submit_deferred()
            self.metered.collect_deferred()

    def _ask(self, request: Request) -> Completion | str | None:
        try:
            return self.metered.complete(request)
        except DeferredError:
            return None
        except GroundingError as error:
            return str(error)

    def close(self) -> None:
        self.client.close()
        self.cache.close()


def at(server: BatchServer, model: str) -> str:
    return locate(model, f"{server.url}/v1" if model.startswith("openai:") else server.url)


@contextmanager
def session(server: BatchServer, model: str, path: Path, **options) -> Iterator[Session]:
    opened = Session(server, model, path, **options)
    try:
        yield opened
    finally:
        opened.close()


@every_service
def test_answers_are_those_of_single_requests(model: str, tmp_path: Path):
    with serve_batches(cup, polls=3) as server, session(server, model, tmp_path) as run:
        completions = run.complete(about(1), about(2))

        assert [(one.text, one.finish, one.usage) for one in completions] == [(CUP, Finish.STOP, Usage(100, 60, 7))] * 2
        assert server.asked == {"object 1": 1, "object 2": 1}
        assert len(server.jobs) == 1
        assert run.metered.report.completions == 2
        assert run.metered.report.cached == 0
        assert run.metered.report.usage == Usage(200, 120, 14)
        # The second wait is longer than the first.
        assert [wait for wait in run.slept if wait] == [LIMITS.first_poll_s, LIMITS.first_poll_s * LIMITS.poll_growth]
    with session(server, model, tmp_path) as again:
        assert again.complete(about(1), about(2)) == completions
        assert again.metered.report.cached == 2
        assert len(server.jobs) == 1


@every_service
def test_requests_are_those_of_single_requests(model: str, tmp_path: Path):
    with serve_batches(cup) as server, session(server, model, tmp_path) as run:
        run.complete(replace(about(1), temperature=0.5))

        (row,) = next(iter(server.jobs.values())).rows.values()
    assert "the classes" in json.dumps(row)
    assert '"enum": ["Knife", "Cup"]' in json.dumps(row)
    assert '"temperature": 0.5' in json.dumps(row)
    assert "stream" not in row


def test_openai_returns_token_probabilities(tmp_path: Path):
    with serve_batches(cup) as server, session(server, "openai:m", tmp_path) as run:
        (completion,) = run.complete(about(1))

    assert "".join(text for text, _ in completion.tokens) == CUP


@every_service
def test_a_failed_row_does_not_affect_the_others_and_is_submitted_again_by_the_next_run(model: str, tmp_path: Path):
    rows = {"object 1": Row(error="the prompt is odd")}
    with serve_batches(lambda prompt: rows.get(prompt, Row(CUP))) as server:
        with session(server, model, tmp_path) as run:
            failed, answered = run.complete(about(1), about(2))

            assert answered.text == CUP
            assert "status 400: the prompt is odd; the same command submits it again" in failed
            assert "1 of 2 answers, 1 failed" in run.said[-1]
        rows.clear()
        with session(server, model, tmp_path) as again:
            assert [one.text for one in again.complete(about(1), about(2))] == [CUP, CUP]
        assert server.asked == {"object 1": 2, "object 2": 1}


@every_service
@pytest.mark.parametrize("fate", ["expired", "missing", "stray", "malformed"])
def test_rows_without_an_answer_fail(model: str, fate: str, tmp_path: Path):
    rows = {"object 1": Row(CUP, fate=fate)}
    with (
        serve_batches(lambda prompt: rows.get(prompt, Row(CUP))) as server,
        session(server, model, tmp_path) as run,
    ):
        failed, answered = run.complete(about(1), about(2))

        assert isinstance(failed, str) and answered.text == CUP
        assert ("1 rows ignored" in run.said[-1]) == (fate == "stray")
        assert run.journal.open_jobs() == []
        assert len(run.cache) == 1


@every_service
def test_an_expired_job_costs_nothing_and_is_submitted_again_by_the_next_run(model: str, tmp_path: Path):
    rows = [Row(fate="expired")]
    with serve_batches(lambda prompt: rows[0]) as server:
        with session(server, model, tmp_path) as run:
            outcomes = run.complete(about(1), about(2))

            assert all("expired" in outcome for outcome in outcomes)
            assert run.metered.report.completions == 0
        rows[0] = Row(CUP)
        with session(server, model, tmp_path) as again:
            assert [one.text for one in again.complete(about(1), about(2))] == [CUP, CUP]


@every_service
def test_a_refused_submission_is_reported_and_forgotten(model: str, tmp_path: Path):
    with serve_batches(cup) as server, session(server, model, tmp_path) as run:
        server.intercept = lambda method, path: refuse(403, "no access to batches") if method == "POST" else None

        (outcome,) = run.complete(about(1))

        assert "the service rejected the batch job: status 403: no access to batches" in outcome
        assert run.journal.open_jobs() == []


@every_service
def test_a_submission_without_a_response_is_looked_for_and_not_repeated(model: str, tmp_path: Path):
    with serve_batches(cup, polls=2) as server:
        server.after_create = lambda job: Reply(is_lost=True)
        with session(server, model, tmp_path) as run:
            outcomes = run.complete(about(1), about(2))

            assert all("it is unknown whether the service received the batch job" in outcome for outcome in outcomes)
            assert [job.id for job in run.journal.open_jobs()] == [None]
        server.after_create = lambda job: None
        with session(server, model, tmp_path) as again:
            assert [one.text for one in again.complete(about(1), about(2))] == [CUP, CUP]
        assert server.asked == {"object 1": 1, "object 2": 1}


@every_service
def test_a_submission_that_never_arrived_is_repeated_and_jobs_of_others_are_left_alone(model: str, tmp_path: Path):
    with serve_batches(cup) as server:
        other = tmp_path / "other"
        other.mkdir()
        with session(server, model, other) as someone:
            someone.complete(about(8), about(9))
        creating = lost_on_creation(server)
        with session(server, model, tmp_path) as run:
            run.complete(about(1), about(2))
        creating.clear()
        with session(server, model, tmp_path) as again:
            assert [one.text for one in again.complete(about(1), about(2))] == [CUP, CUP]
        assert server.asked == {f"object {number}": 1 for number in (1, 2, 8, 9)}


def lost_on_creation(server: BatchServer) -> list[bool]:
    """Lose requests that create jobs before the server reads them, until the list is cleared."""
    active = [True]

    def lose(method: str, path: str) -> Reply | None:
        is_creation = method == "POST" and any(part in path for part in ("batches", ":batchGenerateContent"))
        return Reply(is_lost=True) if active and is_creation else None

    server.intercept = lose
    return active


@every_service
def test_an_interrupt_during_the_wait_leaves_the_job_to_the_next_run(model: str, tmp_path: Path):
    with serve_batches(cup, polls=5) as server:
        with session(server, model, tmp_path) as run:
            with pytest.raises(DeferredError):
                run.metered.complete(about(1))
            run.metered.submit_deferred()

            def interrupt(seconds: float) -> None:
                raise KeyboardInterrupt

            run.metered._queue._reporting = replace(run.metered._queue._reporting, sleep=interrupt)
            with pytest.raises(KeyboardInterrupt):
                run.metered.collect_deferred()
            assert "still running at the service; the same command fetches its answers" in run.said[-1]
        with session(server, model, tmp_path) as again:
            assert [one.text for one in again.complete(about(1))] == [CUP]
            assert "prompts running at http" in again.said[0]
            assert again.metered.report.completions == 1
        assert server.asked == {"object 1": 1}


@every_service
def test_answers_that_the_resuming_run_does_not_need_are_stored_too(model: str, tmp_path: Path):
    with serve_batches(cup) as server:
        with session(server, model, tmp_path) as run:
            for number in (1, 2):
                with pytest.raises(DeferredError):
                    run.metered.complete(about(number))
            run.metered.submit_deferred()
        with session(server, model, tmp_path) as again:
            again.complete(about(2), about(3))
            assert len(again.cache) == 3
        assert server.asked == {"object 1": 1, "object 2": 1, "object 3": 1}


@every_service
def test_a_job_that_the_service_does_not_know_is_not_submitted_again(model: str, tmp_path: Path):
    with serve_batches(cup) as server:
        with session(server, model, tmp_path) as run:
            with pytest.raises(DeferredError):
                run.metered.complete(about(1))
            run.metered.submit_deferred()
            server.jobs.clear()
            (outcome,) = run.complete(about(1))
            assert "status 404" in outcome and "usd2kg completions forget" in outcome
            assert len(run.journal.open_jobs()) == 1
        assert server.asked == {"object 1": 1}


@every_service
def test_polls_that_fail_for_a_while_are_repeated(model: str, tmp_path: Path):
    with serve_batches(cup, polls=2) as server, session(server, model, tmp_path) as run:
        failures = [refuse(503, "overloaded")] * 9
        server.intercept = lambda method, path: failures.pop() if method == "GET" and failures else None

        assert [one.text for one in run.complete(about(1))] == [CUP]
        assert not failures


def test_an_option_that_the_service_rejects_is_left_out_of_a_second_job(tmp_path: Path):
    def answer(prompt: str) -> Row:
        (job,) = list(server.jobs.values())[-1:]
        asks = any("include" in request for request in job.rows.values())
        return Row(error="logprobs are not supported with this model") if asks else Row(CUP)

    with serve_batches(answer) as server, session(server, "openai:m", tmp_path) as run:
        assert [one.text for one in run.complete(about(1), about(2))] == [CUP, CUP]
        assert server.asked == {"object 1": 2, "object 2": 2}
        assert [text.partition(" prompts to ")[0] for text in run.said[::3]] == ["submitting 2"] * 2
        assert "2 submitted again without an option that the service rejects" in run.said[2]


def test_jobs_have_as_many_requests_as_the_service_allows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(AnthropicModel, "batch_max_requests", 2)
    with serve_batches(cup) as server, session(server, MODELS[1], tmp_path) as run:
        assert len(run.complete(*map(about, range(5)))) == 5
        assert [len(job.rows) for job in server.jobs.values()] == [2, 2, 1]


class TestBudget:
    """Each prompt about `about(…)` has an estimated price, since the answers are not known yet."""

    def test_prompts_beyond_it_are_not_submitted(self, tmp_path: Path):
        with serve_batches(cup) as server:
            tariff = parse_price("1000000/0")
            with session(server, MODELS[1], tmp_path, tariff=tariff, budget=Budget(dollars=Decimal(11))) as run:
                outcomes = run.complete(*map(about, range(1, 4)))
        # Five tokens of four bytes each.
        assert [isinstance(one, Completion) for one in outcomes] == [True, True, False]
        assert "exceed the budget of $11.00; raise --budget" in outcomes[2]
        assert server.asked == {"object 1": 1, "object 2": 1}

    def test_what_was_spent_counts_in_the_next_round(self, tmp_path: Path):
        with (
            serve_batches(cup) as server,
            session(server, MODELS[1], tmp_path, budget=Budget(tokens=100)) as run,
        ):
            assert isinstance(run.complete(about(1))[0], Completion)
            with pytest.raises(DeferredError):
                run.metered.complete(about(2))
            run.metered.submit_deferred()
            run.metered.collect_deferred()
            with pytest.raises(NotAskedError, match="budget"):
                run.metered.complete(about(2))
        assert server.asked == {"object 1": 1}


@every_service
def test_no_key_is_written_or_said(model: str, tmp_path: Path):
    with serve_batches(lambda prompt: Row(f"the key is {KEYS[variable]}")) as server:
        variable = {"openai": "OPENAI", "anthropic": "ANTHROPIC", "google": "GOOGLE"}[
            model.partition(":")[0]
        ] + "_API_KEY"
        with session(server, model, tmp_path) as run:
            (completion,) = run.complete(about(1))
            run.cache.export_recording(tmp_path / "recording.jsonl")
            with sqlite3.connect(run.cache.path) as connection:
                dump = "\n".join(connection.iterdump())
        written = b"".join(path.read_bytes() for path in tmp_path.iterdir())
    assert completion.text == "the key is [key]"
    assert any(KEYS[variable] in "".join(headers.values()) for headers in server.headers)
    assert KEYS[variable].encode() not in written
    assert KEYS[variable] not in dump + "".join(run.said)
    assert '"credential": ""' in dump.replace("\\", "")


@pytest.mark.parametrize("model", ["azure:gpt-4o", "bedrock:us.anthropic.claude-haiku-4-5-20251001-v1:0"])
def test_services_without_a_batch_endpoint_are_refused(model: str):
    environment = KEYS | {"AZURE_OPENAI_ENDPOINT": "http://127.0.0.1:9", "AWS_REGION": "eu-west-1"}
    environment |= {"AWS_ENDPOINT_URL_BEDROCK_RUNTIME": "http://127.0.0.1:9"}
    with make_client(model, environment=environment) as client, pytest.raises(GroundingError, match="--batch needs"):
        client.open_batch_service()
