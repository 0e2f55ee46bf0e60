"""The examples run offline and print what their README says."""

import runpy
import sys
from pathlib import Path

import pytest
from pxr import Usd

EXAMPLES = Path(__file__).parents[1] / "examples"


def run_example(name: str, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    monkeypatch.setattr(sys, "argv", [name, str(folder)])
    runpy.run_path(str(EXAMPLES / name), run_name="__main__")
    return capsys.readouterr().out


def test_semantic_map_answers_questions_about_the_kitchen(tmp_path, monkeypatch, capsys):
    output = run_example("semantic_map.py", tmp_path, monkeypatch, capsys)
    assert output.startswith("294 objects, ")
    assert "what is on the dining table?  →  " in output
    assert "'on': 'Worktop'" in output
    assert "mug_dirty: -0.6137647 1.86826 0.765 m, sink_steel" in output
    assert "owl:imports <http://www.ease-crc.org/ont/SOMA-HOME.owl>" in (tmp_path / "kitchen.ttl").read_text("utf-8")


def test_label_stage_labels_the_certain_objects_and_queues_the_others(tmp_path, monkeypatch, capsys):
    output = run_example("label_stage.py", tmp_path, monkeypatch, capsys)
    assert "Fridge_01  semantics:labels:class = ['Refrigerator']" in output
    queued = (tmp_path / "review.csv").read_text("utf-8").splitlines()[1:]
    assert f"{len(queued)} objects for review" in output
    assert f"{294 - len(queued)} labelled prims" in output
    stage = Usd.Stage.Open(str(tmp_path / "kitchen_labelled.usda"))
    assert stage.GetDefaultPrim().GetName() == "KitchenDining"


def test_own_ontology_is_repaired_grounded_and_validated(tmp_path, monkeypatch, capsys):
    output = run_example("own_ontology.py", tmp_path, monkeypatch, capsys)
    before, after = output.split("14 classes, 13 with a label")[1].split("14 classes, 14 with a label")
    assert "error: “PKG_07”" in before
    assert "error: “" not in after
    assert "drinking vessel\n" in after
    assert "294 objects, findings {'error': 0" in after


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.py")), ids=lambda path: path.name)
def test_examples_stay_short_and_are_listed_in_the_readme(path):
    assert len(path.read_text("utf-8").splitlines()) <= 60
    assert f"]({path.name})" in (EXAMPLES / "README.md").read_text("utf-8")
