"""usd2kg eval reproduce with language models: the matrix of the study, its budget, its recording, and cascades."""

import csv
import json
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from benchmarks.llm.gold_server import GoldServer
from tests.evaluation.conftest import omit_png_and_pdf
from tests.grounding.llm.servers import Received, Reply
from usd2kg.evaluation import Matrix, read_gold, run_matrix
from usd2kg.evaluation.matrix import SceneSpec
from usd2kg.grounding import NamingRegime
from usd2kg.grounding.llm.factory import LLMSettings
from usd2kg.ontology import load_home_tbox
from usd2kg.scene import read_scene

GOLD = "path,class\n/Room/Table_1,Table\n/Room/coffee_mug,Cup\n/Room/FruitBowl,Bowl\n/Room/Apple,DesignedArtifact\n"
CELLS = 3 * 4 + 6
"""Results of a language model in the study's matrix."""


class Study(NamedTuple):
    """The options of the study on the room, and its server."""

    options: tuple[object, ...]
    server: GoldServer


@pytest.fixture
def gold(room: Path) -> Path:
    path = room.parent / "gold.csv"
    path.write_text(GOLD, encoding="utf-8")
    return path


@pytest.fixture
def study(room: Path, gold: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Study]:
    omit_png_and_pdf(monkeypatch)
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "completions.sqlite"))
    tbox = load_home_tbox()
    server = GoldServer(read_scene(room), read_gold(gold, tbox), tbox)
    model = f"openai:scripted@{server.url}/v1"
    try:
        yield Study(("--study", "--scene", room, "--gold", gold, "--model", model, "--price", "1/2"), server)
    finally:
        server.close()


def rows(folder: Path) -> list[dict[str, str]]:
    return list(csv.DictReader((folder / "results.csv").read_text("utf-8").splitlines()))


def prompts(server: GoldServer) -> list[str]:
    return [json.dumps(received.body["messages"]) for received in server.received]


@pytest.mark.slow
def test_study_prints_published_and_measured_figures_and_is_replayed_without_the_server(
    run, study: Study, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = run("eval", "reproduce", *study.options, "-o", tmp_path / "out")
    assert done.code == 0, done.err
    assert f"[{3 * 4 + 10 + CELLS}/{3 * 4 + 10 + CELLS}] room, llm-C:openai:scripted@" in done.err
    for title in ("measured and published", "classes of errors", "Cost of language models"):
        assert title in done.out
    measured = rows(tmp_path / "out")
    asked = [row for row in measured if row["method"].startswith("llm-")]
    assert len(asked) == CELLS
    spent = sum(float(row["paid"]) for row in asked)
    assert 0 < spent <= sum(float(row["dollars"]) for row in asked)
    for row in asked:
        tokens = float(row["input_tokens"]), float(row["output_tokens"])
        assert float(row["dollars"]) == pytest.approx((tokens[0] * 1 + tokens[1] * 2) / 1e6)
        assert row["end_to_end_ema"] == row["ema"], "the selection finds all four"

    study.server.close()
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "elsewhere.sqlite"))
    replayed = tmp_path / "replayed"
    replayed.mkdir()
    shutil.copy(tmp_path / "out/recording.jsonl.gz", replayed)
    again = run("eval", "reproduce", *study.options, "--replay", "-o", replayed)
    assert again.code == 0, again.err
    varying = ("seconds", "seconds_per_object", "cached", "paid")
    assert [drop(row, varying) for row in rows(replayed)] == [drop(row, varying) for row in measured]
    assert {row["paid"] for row in rows(replayed) if row["method"].startswith("llm-")} == {"0"}
    assert (replayed / "recording.jsonl.gz").read_bytes() == (tmp_path / "out/recording.jsonl.gz").read_bytes()


def drop(row: dict[str, str], keys: tuple[str, ...]) -> dict[str, str]:
    return {key: value for key, value in row.items() if key not in keys}


@pytest.mark.slow
def test_a_spent_budget_ends_the_run_and_the_next_one_pays_only_for_the_rest(run, study: Study, tmp_path: Path) -> None:
    options = (*study.options, "--concurrency", 1, "-o", tmp_path / "out")
    stopped = run("eval", "reproduce", *options, "--budget", 0.05)
    assert stopped.code == 2
    assert "are spent of a budget of $0.0500; raise --budget" in stopped.err
    assert "run the same command again to complete them" in stopped.err
    assert "incomplete: " in stopped.out
    # One prompt of 4,400 tokens costs about half a cent: the last one crosses the budget.
    assert 0.05 <= sum(float(row["paid"] or 0) for row in rows(tmp_path / "out") if "llm" in row["method"]) < 0.06
    assert run("eval", "reproduce", *options).code == 0
    asked = prompts(study.server)
    assert len(asked) == len(set(asked)), "no prompt is paid twice"
    assert "incomplete" not in (tmp_path / "out/report.md").read_text("utf-8")


class KillingServer(GoldServer):
    """Kills the client instead of answering its prompt number `fatal`; 0 to answer all."""

    fatal = 0
    client: "subprocess.Popen[bytes] | None" = None

    def _take(self, received: Received) -> Reply:
        reply = super()._take(received)
        if len(self.received) == self.fatal:
            assert self.client is not None
            os.kill(self.client.pid, signal.SIGKILL)
            return Reply(hangs=True)
        return reply


@pytest.mark.slow
def test_a_killed_study_resumes(room: Path, gold: Path, tmp_path: Path) -> None:
    tbox = load_home_tbox()
    server = KillingServer(read_scene(room), read_gold(gold, tbox), tbox)
    arguments = ("--study", "--scene", room, "--gold", gold, "--model", f"openai:scripted@{server.url}/v1")
    command = [sys.executable, "-m", "usd2kg", "eval", "reproduce", *map(str, arguments), "--concurrency", "1"]
    environment = {**os.environ, "USD2KG_CACHE": str(tmp_path / "completions.sqlite")}
    try:
        for server.fatal in (10, 30, 0):
            with subprocess.Popen(
                [*command, "-o", str(tmp_path / "out")], env=environment, stderr=subprocess.PIPE, stdout=subprocess.PIPE
            ) as server.client:
                _, said = server.client.communicate(timeout=300)
            assert server.client.returncode == (-signal.SIGKILL if server.fatal else 0), said.decode()
    finally:
        server.close()
    assert b"(stored)" in said
    asked = prompts(server)
    assert len(asked) == len(set(asked)) + 2, "only the prompts at the kills were in flight, and are sent again"


def test_an_interrupt_ends_the_matrix(room: Path, gold: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class InterruptingServer(GoldServer):
        def _take(self, received: Received) -> Reply:
            os.kill(os.getpid(), signal.SIGINT)
            return super()._take(received)

    tbox = load_home_tbox()
    server = InterruptingServer(read_scene(room), read_gold(gold, tbox), tbox)
    scene = SceneSpec("room", room, gold, None, "", is_optional=False)
    names = tuple(f"llm-{letter}:openai:scripted@{server.url}/v1" for letter in "AB")
    settings = LLMSettings("", concurrency=1, completions=tmp_path / "completions.sqlite")
    try:
        with pytest.raises(KeyboardInterrupt):
            run_matrix(Matrix("m", (scene,), names, (NamingRegime.SEMANTIC,), 1), tmp_path / "out", settings=settings)
    finally:
        server.close()
    # The prompt that is in flight, and perhaps the one after it: the worker takes it before it is cancelled.
    assert len(server.received) <= 2


def test_cascades_of_a_matrix_are_measured_and_drawn(run, study: Study, room: Path, gold: Path, tmp_path: Path) -> None:
    matrix = tmp_path / "matrix.toml"
    matrix.write_text(
        f'grounders = ["lexical", "llm-A:openai:scripted@{study.server.url}/v1"]\nregimes = ["semantic"]\n'
        f"cascade = [0, 0.5, 0.8, 0.9, 1]\n"
        f'[[scene]]\nname = "room"\npath = "{room.name}"\ngold = "{gold.name}"\n',
        encoding="utf-8",
    )
    done = run("eval", "reproduce", matrix, "--price", "1/2", "-o", tmp_path / "out")
    assert done.code == 0, done.err
    cascades = [row for row in rows(tmp_path / "out") if "cascade" in row["method"]]
    objects = [int(row["objects"]) for row in cascades]
    assert (objects[0], objects[-1], objects) == (0, 4, sorted(objects))
    dollars = [float(row["dollars"]) for row in cascades]
    assert (dollars[0], dollars) == (0, sorted(dollars))
    assert dollars[-1] > 0
    assert "US dollars for 1,000 objects" in (tmp_path / "out/plots/scene1_cascade.svg").read_text("utf-8")
    assert "scene1_cascade.svg" in (tmp_path / "out/report.md").read_text("utf-8")
    assert "cascades" in (tmp_path / "out/report.tex").read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("m.toml", "--study"), "m.toml: --study has its own matrix; leave out one of the two"),
        ((), "no matrix is given; expected MATRIX, a TOML file, or --study"),
        (("m.toml", "--model", "openai:m"), "--model openai:m: requires --study; a matrix file contains this setting"),
        (("m.toml", "--gold", "g.csv"), "--gold g.csv: requires --study; a matrix file contains this setting"),
        (("--study", "--scene", "{room}"), "has no gold labels; label it with usd2kg eval annotate"),
        (("--study", "--gold", "{gold}"), "--gold needs a scene; give it with --scene or --kitchen-set"),
        (("--study", "--scene", "none.usda", "--gold", "{gold}"), "none.usda: no such file; correct the path"),
        (("--study", "--scene", "{room}", "--gold", "none.csv"), "none.csv: no such file; correct the path"),
        (
            ("--study", "--scene", "{room}", "--gold", "{gold}", "--kitchen-set", "."),
            "--scene and --kitchen-set exclude each other; leave out one of them",
        ),
        (("--study", "--kitchen-set", ".", "--gold", "{gold}"), "no Kitchen_set.usd in it"),
        (("--study", "--budget", "1"), "--budget needs a language model; name one with --model MODEL"),
        (("--study", "--model", "openai:m", "--budget", "1"), "has no list price, which --budget requires"),
        (("--study", "--model", "mistral:m"), "model 'mistral:m': no known provider and name"),
    ],
)
def test_options_that_exclude_each_other(
    run, room: Path, gold: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], message: str
) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "planted-key")
    done = run("eval", "reproduce", *(argument.format(room=room, gold=gold) for argument in arguments))
    assert (done.code, done.out) == (2, "")
    assert message in done.err
    assert done.err.count("\n") == 1


def test_options_of_the_study_in_a_project_file_do_not_disturb_a_matrix(
    run: Callable[..., object], room: Path, gold: Path, tmp_path: Path
) -> None:
    (tmp_path / "usd2kg.toml").write_text('ontology = "home"\nmodel = "openai:m"\n', encoding="utf-8")
    matrix = tmp_path / "matrix.toml"
    matrix.write_text(
        f'grounders = ["dictionary"]\nregimes = ["semantic"]\n'
        f'[[scene]]\nname = "room"\npath = "{room.name}"\ngold = "{gold.name}"\n',
        encoding="utf-8",
    )
    assert run("eval", "reproduce", matrix, "-o", tmp_path / "out").code == 0
