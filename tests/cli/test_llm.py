"""usd2kg ground --model: a language model behind a real local server."""

import csv
import io
import json
from pathlib import Path

import pytest

from tests.cli.conftest import Run
from tests.grounding.llm.servers import openai_reply, refuse, serve
from tests.scene.usda import component, cube, xform

KEY = "sk-very-secret-4711"


@pytest.fixture
def kitchen(write_stage) -> Path:
    return write_stage(
        xform("Kitchen", *(component(name, cube("mesh", size=0.1)) for name in ("mug_1", "mug_2", "jar")))
    )


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "said.sqlite"))
    monkeypatch.setenv("OPENAI_API_KEY", KEY)


def classes(text: str) -> dict[str, str]:
    return {row["path"]: row["class"].rpartition("#")[2] for row in csv.DictReader(io.StringIO(text))}


def cup(count: int = 1) -> str:
    return json.dumps({str(number): {"class": "Cup"} for number in range(1, count + 1)})


def test_a_model_grounds_a_scene_and_a_rerun_costs_nothing(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        model = f"openai:test@{server.url}/v1"
        first = run("ground", kitchen, "--model", model)
        asked = len(server.received)
        again = run("ground", kitchen, "--model", model)
    assert first.code == again.code == 0
    assert classes(first.out) == {f"/Kitchen/{name}": "Cup" for name in ("mug_1", "mug_2", "jar")}
    assert again.out == first.out
    # The mugs differ in a number alone.
    assert asked == len(server.received) == 2
    assert "2 completions asked for, 0 known before" in first.err
    assert "0 completions asked for, 2 known before" in again.err
    assert KEY not in first.out + first.err


def test_the_schema_on_the_wire_offers_the_classes_of_the_ontology_alone(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        run("ground", kitchen, "--model", f"openai:test@{server.url}/v1", "--strategy", "c")
        body = server.received[0].body
    row = body["response_format"]["json_schema"]["schema"]["properties"]["1"]
    assert list(row["properties"]) == ["reasoning", "class"]
    assert "Cup" in row["properties"]["class"]["enum"]
    assert "Chalice" not in row["properties"]["class"]["enum"]
    assert body["temperature"] == 0


def test_many_objects_in_a_prompt_save_prompts(run: Run, kitchen: Path):
    with serve(openai_reply(cup(2))) as server:
        done = run("ground", kitchen, "--model", f"openai:test@{server.url}/v1", "--objects-per-prompt", "10")
        assert len(server.received) == 1
    assert set(classes(done.out).values()) == {"Cup"}


def test_a_dry_run_prints_prompts_and_asks_nobody(run: Run, kitchen: Path):
    with serve(openai_reply(cup())) as server:
        done = run("ground", kitchen, "--model", f"openai:test@{server.url}/v1", "--dry-run")
        assert server.received == []
    assert done.code == 0
    assert done.out.count("=== prompt ") == 2
    assert 'name: "mug_1"' in done.out
    assert "2 prompts for 3 objects, about" in done.err


def test_a_server_that_refuses_fails_the_objects_and_says_why_once_each(run: Run, kitchen: Path):
    with serve(refuse(401, f"bad key {KEY}")) as server:
        done = run("ground", kitchen, "--model", f"openai:test@{server.url}/v1", "--format", "json")
    predictions = json.loads(done.out)["predictions"]
    assert {p["status"] for p in predictions} == {"failed"}
    assert "status 401" in predictions[0]["explanation"]
    assert KEY not in done.out + done.err
    assert "3 objects without a class" in done.err


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--model", "nobody:model"), "expected google:NAME, anthropic:NAME or openai:NAME"),
        (
            ("--model", "openai:x@http://localhost:1/v1", "--strategy", "D"),
            "strategy 'D' is unknown; expected A, B or C",
        ),
        (("--dry-run",), "say which one with --model"),
    ],
)
def test_what_cannot_be_asked_is_told_before_anything_is_read(run: Run, kitchen: Path, arguments, told: str):
    done = run("ground", kitchen, *arguments)
    assert done.code == 2
    assert told in done.err
    assert done.out == ""
