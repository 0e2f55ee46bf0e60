"""The notebooks run offline, have the outputs of a run, and show what their README says."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
NOTEBOOKS = sorted(EXAMPLES.glob("*.ipynb"))
_MAX_BYTES = 200_000
"""All notebooks with their pictures."""


def code_cells(path: Path) -> list[dict[str, Any]]:
    return [cell for cell in json.loads(path.read_text("utf-8"))["cells"] if cell["cell_type"] == "code"]


def outputs(path: Path) -> list[dict[str, Any]]:
    return [output for cell in code_cells(path) for output in cell["outputs"]]


def shown(name: str) -> str:
    """Return what a notebook shows as text."""
    found = outputs(EXAMPLES / f"{name}.ipynb")
    return "\n".join("".join(output.get("text") or output["data"]["text/plain"]) for output in found)


@pytest.mark.docs
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_outputs_are_those_of_a_run(path: Path):
    check = [sys.executable, "-m", "tools.write_notebooks", "--check", path.stem]
    done = subprocess.run(check, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_there_is_a_notebook_for_each_kind_of_reader():
    assert [path.stem for path in NOTEBOOKS] == ["label_twin", "own_ontology", "semantic_map"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_are_short_and_listed_in_the_readme(path: Path):
    assert sum(len(cell["source"]) for cell in code_cells(path)) <= 60
    assert f"]({path.name})" in (EXAMPLES / "README.md").read_text("utf-8")


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_outputs_have_no_errors_and_nothing_of_the_machine(path: Path):
    assert all(cell["outputs"] and cell["execution_count"] for cell in code_cells(path))
    assert {output.get("name", "stdout") for output in outputs(path)} == {"stdout"}
    text = path.read_text("utf-8")
    assert not re.search(r"(?<![\w.])/(tmp|home|root|Users|usr)/|\d seconds\b|0x[0-9a-f]{6}", text)
    assert str(ROOT) not in text


def test_pictures_are_small():
    assert sum(path.stat().st_size for path in NOTEBOOKS) < _MAX_BYTES
    assert "data:image/png;base64," in (EXAMPLES / "semantic_map.ipynb").read_text("utf-8")


def test_semantic_map_answers_questions_about_the_kitchen():
    text = shown("semantic_map")
    assert text.startswith("kitchen.usda: 294 objects of ")
    assert "are on the bar table" in text
    assert "where is the toaster?  →  toaster is on the worktop, at" in text
    assert re.search(r"mug_dirty +-0\.6137647 1\.86826 0\.765 +sink_steel", text)
    assert "imports http://www.ease-crc.org/ont/SOMA-HOME.owl" in text
    assert "Wasserkocher is on the worktop" in text


def test_label_twin_labels_the_certain_objects_and_queues_the_others():
    text = shown("label_twin")
    assert "Fridge_01  semantics:labels:class = ['Refrigerator']" in text
    queued = len(re.findall(r"^0\.[0-7]\d  /", text, re.MULTILINE))
    assert f"{{'written': {294 - queued}}}" in text
    assert f"{294 - queued} labelled prims" in text


def test_own_ontology_is_repaired_grounded_and_validated():
    text = shown("own_ontology")
    before, after = text.split("14 classes, 13 with a label")[1].split("14 classes, 14 with a label")
    assert "error: “PKG_07”" in before
    assert "error: “" not in after
    assert re.search(r"DrinkingVessel +\d+ ", after)
    assert "294 objects, findings {'error': 0" in after
