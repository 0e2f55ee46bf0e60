"""The accuracy benchmark: which scenes it measures, and what it says about the others."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.accuracy.run import describe_unmeasured, find_differences
from benchmarks.labelled_scenes import read_accuracy_matrix

ROOT = Path(__file__).parents[2]


def test_scenes_outside_the_repository_are_looked_for_in_the_shared_folder(tmp_path):
    lines = describe_unmeasured(read_accuracy_matrix(tmp_path).scenes)
    apartment = tmp_path / "scenes/iai_apartment/apartment.usdc"
    assert lines[0] == f"not measured: IAI apartment, {apartment} is missing"
    assert [line.split(": ")[1].partition(", /")[0] for line in lines] == [
        "IAI apartment",
        "AWS small house",
        "AWS small warehouse",
        "Franka kitchen",
        "AWS small house, SOMA+DFL",
        "Franka kitchen, SOMA+DFL",
    ]


def test_scenes_of_the_repository_are_always_measured(tmp_path):
    present = [spec.name for spec in read_accuracy_matrix(tmp_path).scenes if spec.missing is None]
    assert present == ["Demo kitchen", "Office", "Warehouse", "Flat (test)"]


def test_a_figure_that_changed_is_named():
    def figures(value: float) -> dict[str, object]:
        return {"Office": {"grounders": {"lexical": {"opaque": {"ema": value}}}}}

    kept = {**figures(1.0), "Hall": {"grounders": {}}}
    assert find_differences(kept, figures(1.0)) == []
    assert find_differences(kept, figures(2.0)) == ["Office, lexical, opaque: kept {'ema': 1.0}, now {'ema': 2.0}"]


@pytest.mark.slow
def test_check_lists_the_scenes_that_it_could_not_measure(tmp_path):
    command = [sys.executable, "benchmarks/accuracy/run.py", "--check"]
    environment = {**os.environ, "USD2KG_SHARED": str(tmp_path)}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=True)
    scenes = len(json.loads((ROOT / "benchmarks/accuracy/results.json").read_text("utf-8")))
    assert (
        f"not measured: Franka kitchen, {tmp_path}/scenes/franka_kitchen/franka_kitchen.usdc is missing" in done.stdout
    )
    assert f"4 of {scenes} scenes measured; the kept figures are those of the code" in done.stdout
