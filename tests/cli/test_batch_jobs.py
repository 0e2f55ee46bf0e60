"""Commands with --batch, behind a local server with the batch endpoint of OpenAI."""

import csv
import io
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from tests.cli.conftest import Run
from tests.evaluation.conftest import omit_png_and_pdf
from tests.grounding.llm.batch_servers import BatchServer, Reply, Row, serve_batches
from tests.scene.usda import component, cube, xform
from usd2kg.grounding.llm.batch_jobs import queue
from usd2kg.grounding.llm.cache import CompletionCache

KEY = "sk-very-secret-4711"
GOLD = "path,class\n/Room/Table_1,Table\n/Room/coffee_mug,Cup\n/Room/FruitBowl,Bowl\n/Room/Apple,DesignedArtifact\n"


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "said.sqlite"))
    monkeypatch.setenv("OPENAI_API_KEY", KEY)
    monkeypatch.setattr(queue, "LIMITS", replace(queue.LIMITS, first_poll_s=0.01, job_settle_s=0.0))


@pytest.fixture
def kitchen(write_stage) -> Path:
    return write_stage(
        xform("Kitchen", *(component(name, cube("mesh", size=0.1)) for name in ("mug_1", "mug_2", "jar")))
    )


@pytest.fixture
def server() -> Iterator[BatchServer]:
    with serve_batches(answer_cup, polls=2) as server:
        yield server


def answer_cup(prompt: str) -> Row:
    numbers = re.findall(r"^object (\d+)$", prompt, re.M)
    return Row(json.dumps({number: {"class": "Cup"} for number in numbers}))


def model(server: BatchServer, strategy: str = "B") -> str:
    return f"llm-{strategy}:openai:test@{server.url}/v1"


def classes(text: str) -> set[str]:
    return {row["class"].rpartition("#")[2] for row in csv.DictReader(io.StringIO(text))}


def test_prompts_are_one_job_at_half_the_price(run: Run, kitchen: Path, server: BatchServer):
    done = run("ground", kitchen, "--grounder", model(server), "--batch", "--price", "10000/0")

    assert done.code == 0, done.err
    assert classes(done.out) == {"Cup"}
    estimate = re.search(
        r"submitting 2 prompts to http://\S+: about ([\d,]+) input and \d+ output tokens, about \$([\d,.]+)", done.err
    )
    assert estimate is not None and done.err.index("submitting 2 prompts") < done.err.index("batch job batch_1")
    # Half a cent for each token of the input.
    assert float(estimate[2].replace(",", "")) == pytest.approx(int(estimate[1].replace(",", "")) / 200)
    assert "batch job batch_1: 2 prompts submitted to http://" in done.err
    assert re.search(r"ended 0:00:\d\d after its submission: 2 of 2 answers", done.err)
    # 100 tokens each, at half a cent.
    assert "2 new completions, 0 cached" in done.err and "200 input tokens" in done.err and "$1.00, " in done.err
    assert KEY not in done.out + done.err
    again = run("ground", kitchen, "--grounder", model(server), "--batch")
    assert again.out == done.out
    assert "0 new completions, 2 cached" in again.err
    single = run("ground", kitchen, "--grounder", model(server))
    assert single.out == done.out
    assert len(server.jobs) == 1


def test_repairs_are_a_second_job(run: Run, kitchen: Path, server: BatchServer):
    def answer(prompt: str) -> Row:
        return answer_cup(prompt) if "Chalice" in prompt else Row(json.dumps({"1": {"class": "Chalice"}}))

    server.answer = answer
    done = run("ground", kitchen, "--grounder", model(server), "--batch")

    assert classes(done.out) == {"Cup"}
    assert [len(job.rows) for job in server.jobs.values()] == [2, 2]
    assert "4 new completions, 0 cached, 2 repairs, 0 degenerate, 0 prompts failed" in done.err


def test_samples_are_one_job(run: Run, kitchen: Path, server: BatchServer):
    done = run("ground", kitchen, "--grounder", model(server), "--batch", "--samples", "3")

    assert [len(job.rows) for job in server.jobs.values()] == [6]
    assert "6 new completions, 0 cached" in done.err
    assert {row["confidence"] for row in csv.DictReader(io.StringIO(done.out))} == {"1.0000"}


def test_a_budget_limits_the_job(run: Run, kitchen: Path, server: BatchServer):
    done = run("ground", kitchen, "--grounder", model(server), "--batch", "--token-budget", "5000")

    assert [len(job.rows) for job in server.jobs.values()] == [1]
    assert "1 new completion, 0 cached" in done.err and "1 prompt failed" in done.err
    assert classes(done.out) == {"Cup", ""}


def test_failed_rows_are_reported(run: Run, kitchen: Path, server: BatchServer):
    server.answer = lambda prompt: Row(fate="expired")
    done = run("ground", kitchen, "--grounder", model(server), "--batch")

    assert done.code == 2
    assert "0 of 2 answers, 2 failed, the first with: the batch request was expired" in done.err.replace(
        "The batch", "the batch"
    )
    assert "the same command submits it again" in done.err


def test_build_and_eval_run_submit_jobs(run: Run, kitchen: Path, server: BatchServer, tmp_path: Path):
    gold = tmp_path / "gold.csv"
    gold.write_text("path,class\n/Kitchen/jar,Cup\n", encoding="utf-8")

    assert run("build", kitchen, "--grounder", model(server), "--batch", "-o", tmp_path / "graph.ttl").code == 0
    assert "Cup" in (tmp_path / "graph.ttl").read_text("utf-8")
    assert run("eval", "run", kitchen, "--gold", gold, "--grounder", model(server, "A"), "--batch").code == 0
    assert [len(job.rows) for job in server.jobs.values()] == [2, 1]


def test_questions_about_classes_are_one_job(run: Run, server: BatchServer, tmp_path: Path):
    nouns = {"belongs": ["mug"], "not": []}
    server.answer = lambda prompt: Row(json.dumps({str(number): nouns for number in range(1, 6)}))
    target = tmp_path / "members.sssom.tsv"
    done = run("ontology", "align", "--model", model(server).removeprefix("llm-B:"), "--batch", "-o", target)

    assert done.code == 0, done.err
    assert [len(job.rows) for job in server.jobs.values()] == [21]
    assert "21 new completions, 0 cached" in done.err
    assert "mug" in target.read_text("utf-8")


def test_a_matrix_has_one_job_for_all_its_runs(
    run: Run, room: Path, server: BatchServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    omit_png_and_pdf(monkeypatch)
    gold, matrix = tmp_path / "gold.csv", tmp_path / "matrix.toml"
    gold.write_text(GOLD, encoding="utf-8")
    names = [model(server, strategy) for strategy in "AB"]
    matrix.write_text(
        f"grounders = {json.dumps(names)}\nregimes = ['semantic', 'opaque']\ncascade = [0.9]\n"
        f"[[scene]]\nname = 'room'\npath = '{room}'\ngold = '{gold}'\n",
        encoding="utf-8",
    )
    options = ("eval", "reproduce", matrix, "--batch", "--price", "1/2", "-o", tmp_path / "out")
    done = run(*options)

    assert done.code == 0, done.err
    assert len(server.jobs) == 1
    assert set(server.asked.values()) == {1}
    rows = list(csv.DictReader((tmp_path / "out/results.csv").read_text("utf-8").splitlines()))
    assert len(rows) == 2 * 2 * 2
    prompts = sum(server.asked.values())
    paid, dollars = (sum(float(row[name]) for row in rows) for name in ("paid", "dollars"))
    # 100 tokens at 1 and 7 at 2 dollars per million, at half the price. Other runs find some of them in the cache.
    assert paid == pytest.approx(prompts * (100 * 1 + 7 * 2) / 2e6)
    assert dollars > paid
    assert run(*options).code == 0
    assert len(server.jobs) == 1


def test_open_jobs_are_listed_and_can_be_forgotten(run: Run, kitchen: Path, server: BatchServer):
    server.intercept = lambda method, path: Reply({}, 404) if method == "GET" else None
    failed = run("ground", kitchen, "--grounder", model(server), "--batch")
    assert failed.code == 2 and "usd2kg completions forget batch_1" in failed.err

    listed = run("completions", "jobs")
    assert re.search(r"batch_1 +openai:test@http\S+ +2 +20", listed.out)
    assert json.loads(run("completions", "jobs", "--json").out)[0]["prompts"] == 2
    assert "discarded, with 2 prompts" in run("completions", "forget", "batch_1").err
    assert json.loads(run("completions", "jobs", "--json").out) == []
    assert "expected one listed by usd2kg completions jobs" in run("completions", "forget", "batch_1").err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--grounder", "llm-B:openai:m", "--batch", "--refresh"), "--batch resumes from the cache, which --refresh"),
        (("--grounder", "llm-B:azure:gpt-4o", "--batch"), "--batch needs a service with a batch endpoint"),
        (("--batch",), "--batch needs a language model"),
    ],
)
def test_refuses_what_has_no_effect(run: Run, kitchen: Path, monkeypatch: pytest.MonkeyPatch, options, message: str):
    monkeypatch.setenv("AZURE_OPENAI_ENDPOINT", "http://127.0.0.1:9")
    monkeypatch.setenv("AZURE_OPENAI_API_KEY", KEY)
    done = run("ground", kitchen, *options)

    assert done.code == 2
    assert message in done.err


def test_an_interrupt_keeps_the_job_and_the_next_run_fetches_its_answers(
    run: Run, kitchen: Path, server: BatchServer, monkeypatch: pytest.MonkeyPatch
):
    def interrupt(method: str, path: str) -> None:
        if method == "GET":
            os.kill(os.getpid(), signal.SIGINT)

    server.polls = 1000
    server.intercept = interrupt
    stopped = run("ground", kitchen, "--grounder", model(server), "--batch")
    assert stopped.code == 130
    assert (
        "batch job batch_1 (2 prompts): still running at the service; the same command fetches its answers"
        in stopped.err
    )
    server.polls, server.intercept = 1, lambda method, path: None
    done = run("ground", kitchen, "--grounder", model(server), "--batch")
    assert classes(done.out) == {"Cup"}
    assert "batch job batch_1: 2 prompts running at http" in done.err
    assert len(server.jobs) == 1


KILLS = 20
LONGEST = 9
"""Requests of a run that is killed, at most; some runs need no more."""
JOB_SIZE = 3
OBJECTS = JOB_SIZE * KILLS
_IMPATIENT = f"""
from dataclasses import replace
from pydantic_ai.models.openai import OpenAIResponsesModel
from usd2kg.cli.app import main
from usd2kg.grounding.llm.batch_jobs import queue
queue.LIMITS = replace(queue.LIMITS, first_poll_s=0.01, max_poll_s=0.01, job_settle_s=0.0)
OpenAIResponsesModel.batch_max_requests = {JOB_SIZE}
main()
"""


class KillingServer(BatchServer):
    """Kills the client at a request, after the server has acted on it or before."""

    client: "subprocess.Popen[bytes] | None" = None
    fatal = 0
    """Number of the request, from 1; 0 to kill no client."""
    acts_first = False

    def _route(self, method: str, path: str, headers: dict[str, str], body: bytes) -> Reply:
        is_fatal = len(self.requests) == self.fatal
        reply = super()._route(method, path, headers, body) if self.acts_first or not is_fatal else Reply(is_lost=True)
        if not is_fatal:
            return reply
        assert self.client is not None
        os.kill(self.client.pid, signal.SIGKILL)
        return Reply(is_lost=True)


@pytest.mark.slow
def test_kill_9_at_twenty_moments_loses_no_answer_and_submits_none_twice(write_stage, tmp_path: Path):
    objects = (component(f"mug_{number}", cube("mesh", size=0.1)) for number in range(OBJECTS))
    scene = write_stage(xform("Kitchen", *objects))
    cache, output = tmp_path / "completions.sqlite", tmp_path / "classes.csv"
    server = KillingServer(answer_cup, polls=2)
    arguments = ("ground", scene, "--grounder", model(server, "A"), "--each-object", "--batch", "-o", output)
    command = [sys.executable, "-c", _IMPATIENT, *map(str, arguments), "--completions", str(cache)]
    try:
        for kill in range(KILLS + 1):
            server.requests.clear()
            # Two requests submit a job; in later runs, requests that list, poll and fetch come first.
            server.fatal = kill % LONGEST + 1 if kill < KILLS else 0
            server.acts_first = kill % 2 == 0
            with subprocess.Popen(command, stderr=subprocess.PIPE) as server.client:
                _, said = server.client.communicate(timeout=300)
            assert server.client.returncode == (0 if kill == KILLS else -signal.SIGKILL), (kill, said.decode())
    finally:
        server.close()
    assert len(server.asked) == OBJECTS
    assert set(server.asked.values()) == {1}, "no prompt is submitted twice"
    with CompletionCache(cache) as stored:
        assert len(stored) == OBJECTS
    with output.open(encoding="utf-8", newline="") as file:
        assert [row["class"].rpartition("#")[2] for row in csv.DictReader(file)] == ["Cup"] * OBJECTS
