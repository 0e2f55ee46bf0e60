"""Answers of a language model about concepts that become an alignment file."""

import csv
import io
import json
from pathlib import Path

import pytest

from tests.cli.conftest import Run
from tests.grounding.llm.servers import openai_reply, serve
from tests.scene.usda import component, cube, xform


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("USD2KG_CACHE", str(tmp_path / "said.sqlite"))


def classes(text: str) -> dict[str, str]:
    rows = csv.DictReader(io.StringIO(text))
    return {row["path"].rpartition("/")[2]: row["class"].rpartition("#")[2] for row in rows}


def stage_of(write_stage, *names: str) -> Path:
    return write_stage(xform("Kitchen", *(component(name, cube("mesh", size=0.1)) for name in names)))


def rows_of(path: Path) -> list[dict[str, str]]:
    lines = [line for line in path.read_text("utf-8").splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines, delimiter="\t"))


def test_answers_settle_later_objects_of_their_concepts(run: Run, write_stage, tmp_path: Path):
    answers, scene = tmp_path / "answers.sssom.tsv", stage_of(write_stage, "mug_1", "mug_2", "qzxv_1")
    text = json.dumps({"1": {"class": "Bowl"}, "2": {"class": "Knife"}})
    with serve(openai_reply(text)) as server:
        grounder = f"llm-concept:openai:m@{server.url}/v1"
        asked = run("ground", scene, "--grounder", grounder, "--write-alignment", answers)
    later = stage_of(write_stage, "SM_Mug_07", "QZXV_44", "fork")
    before, after = run("ground", later), run("ground", later, "--alignment", answers)

    assert (asked.code, after.code) == (0, 0)
    assert classes(asked.out) == {"mug_1": "Bowl", "mug_2": "Bowl", "qzxv_1": "Knife"}
    assert f"3 rows for --alignment in {answers}; 0 omitted because of conflicting answers" in asked.err
    found = [(row["subject_label"], row["object_id"], row["mapping_tool"]) for row in rows_of(answers)]
    model = f"openai:m@{server.url}/v1"
    assert sorted(found) == [("mug", "soma:Bowl", model), ("mug", "soma:Bowl", model), ("qzxv", "soma:Knife", model)]
    assert classes(before.out)["SM_Mug_07"] == "Cup"
    assert classes(after.out) == {"SM_Mug_07": "Bowl", "QZXV_44": "Knife", "fork": classes(before.out)["fork"]}


def test_needs_questions_about_concepts(run: Run, write_stage, tmp_path: Path):
    scene, target = stage_of(write_stage, "mug"), tmp_path / "answers.sssom.tsv"

    of_objects = run("ground", scene, "--grounder", "llm-B:openai:m@http://127.0.0.1:1", "--write-alignment", target)
    without = run("ground", scene, "--write-alignment", target)

    assert "--write-alignment needs answers about concepts; expected --grounder llm-concept:MODEL" in of_objects.err
    assert "--write-alignment needs a language model" in without.err
    assert of_objects.code == without.code == 2
    assert not target.exists()
