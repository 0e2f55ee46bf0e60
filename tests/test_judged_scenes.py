"""Scenes that are modelled by script and judged by eye: the committed stages are what the scripts write."""

import re
from types import ModuleType

import pytest
from pxr import Kind, Usd

from benchmarks.relations.judged import KINDS, SCENES, read_judged
from benchmarks.scenes.bakery import build as bakery
from benchmarks.scenes.bicycle_shop import build as bicycle_shop
from benchmarks.scenes.command import run_command
from benchmarks.scenes.hotel import build as hotel
from benchmarks.scenes.pottery import build as pottery
from benchmarks.scenes.vet import build as vet

SCRIPTS = {"bicycle_shop": bicycle_shop, "pottery": pottery, "hotel": hotel, "vet": vet, "bakery": bakery}


@pytest.mark.parametrize("script", SCRIPTS.values(), ids=SCRIPTS)
def test_the_script_writes_the_committed_stage(script: ModuleType, tmp_path):
    count = script.build(tmp_path / "stage.usdc")
    written, committed = (Usd.Stage.Open(str(path)) for path in (tmp_path / "stage.usdc", script.STAGE))
    assert rounded_text(written) == rounded_text(committed)
    assert count == len(components(committed))


@pytest.mark.parametrize("scene", SCRIPTS)
def test_every_object_is_judged(scene: str):
    objects = components(Usd.Stage.Open(str(SCENES[scene].stage)))
    facts = [fact for path in SCENES[scene].judged for fact in read_judged(path)]
    assert {fact.subject for fact in facts} == objects
    assert {path for fact in facts for path in fact.objects} - {"*", ""} <= objects
    assert {kind for fact in facts for kind in fact.kinds} <= {*KINDS, "nothing"}


def test_the_command_says_what_it_wrote(tmp_path, monkeypatch, capsys):
    out = tmp_path / "stage.usdc"
    monkeypatch.setattr("sys.argv", ["build.py", "-o", str(out)])
    run_command("Write it.\n\nUsage: …", tmp_path / "default.usdc", lambda path: path.write_bytes(b"usd"))
    assert capsys.readouterr().out == f"{out}: 3 objects\n"
    assert out.exists()


def rounded_text(stage: Usd.Stage) -> list[str]:
    """Return the lines of a stage, with numbers to the micrometre: processors differ in the last digits of sines."""
    text = stage.GetRootLayer().ExportToString()
    number = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.])")
    return number.sub(lambda found: f"{round(float(found[0]), 6) + 0.0:g}", text).splitlines()


def components(stage: Usd.Stage) -> set[str]:
    """Return the prim paths of the objects."""
    return {str(prim.GetPath()) for prim in stage.Traverse() if Usd.ModelAPI(prim).GetKind() == Kind.Tokens.component}
