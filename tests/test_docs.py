"""The documents agree with the software."""

import doctest
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from tests.conftest import shared_file
from tests.doc_console import matches, read_blocks, read_commands, run_command
from usd2kg.demo import demo_scene
from usd2kg.validation import read_rules

ROOT = Path(__file__).parents[1]


def test_cli_page_is_up_to_date() -> None:
    subprocess.run([sys.executable, "-m", "tools.write_cli_docs", "--check"], check=True, cwd=ROOT)


def test_vocabulary_page_is_up_to_date() -> None:
    subprocess.run([sys.executable, "-m", "tools.write_vocabulary_docs", "--check"], check=True, cwd=ROOT)


def test_questions_page_is_up_to_date() -> None:
    subprocess.run([sys.executable, "-m", "tools.write_questions_docs", "--check"], check=True, cwd=ROOT)


@pytest.mark.parametrize("command", ["make demo", "make test"])
def test_readme_shows_how_to_start(command: str) -> None:
    assert command in (ROOT / "README.md").read_text("utf-8")


SMALL_HOUSE = "scenes/aws_robomaker/small_house.usdc"
DOCS = ROOT / "docs"


def test_readme_shows_the_output_of_build(tmp_path: Path) -> None:
    shutil.copy(shared_file(SMALL_HOUSE), tmp_path)
    run_examples(ROOT / "README.md", tmp_path)


def test_examples_of_the_labels_page(tmp_path: Path) -> None:
    shutil.copy(shared_file(SMALL_HOUSE), tmp_path / "house.usdc")
    run_examples(DOCS / "labels.md", tmp_path)
    layer = next(block for block in read_blocks(DOCS / "labels.md", "text") if block.startswith("#usda"))
    assert matches(layer.splitlines(), (tmp_path / "house.labels.usda").read_text("utf-8").rstrip().splitlines())
    run_python(DOCS / "labels.md", tmp_path)


def test_examples_of_the_validation_page(tmp_path: Path) -> None:
    shutil.copytree(demo_scene().parent, tmp_path, dirs_exist_ok=True)
    shutil.copytree(shared_file("ontologies/soma"), tmp_path, dirs_exist_ok=True)
    run_examples(DOCS / "validation.md", tmp_path)
    (rules,) = read_blocks(DOCS / "validation.md", "toml")
    (tmp_path / "rules.toml").write_text(rules, encoding="utf-8")
    read_rules(tmp_path / "rules.toml")
    run_python(DOCS / "validation.md", tmp_path)


def test_examples_of_the_robots_page(tmp_path: Path) -> None:
    shutil.copytree(demo_scene().parent, tmp_path, dirs_exist_ok=True)
    run_examples(DOCS / "robots.md", tmp_path)
    (record,) = read_blocks(DOCS / "robots.md", "yaml")
    assert record in (tmp_path / "tf/tf_static.yaml").read_text("utf-8")
    (relation,) = read_blocks(DOCS / "robots.md", "json")
    assert relation.strip() in (tmp_path / "ros2/relations.json").read_text("utf-8")
    if shutil.which("swipl") is None:
        pytest.skip("needs SWI-Prolog: apt-get install swi-prolog-nox")
    shutil.copy(ROOT / "integrations/knowrob/questions.pl", tmp_path)
    questions = [block for block in read_blocks(DOCS / "robots.md", "console") if block.startswith("$ swipl ")]
    assert len(questions) > 10
    for block in questions:
        command, *shown = block.removeprefix("$ ").splitlines()
        done = subprocess.run(shlex.split(command), check=True, cwd=tmp_path, capture_output=True, encoding="utf-8")
        assert matches(shown, done.stdout.splitlines()), done.stdout


def test_commands_of_the_relations_page(tmp_path: Path, write_room: Callable[[str], Path]) -> None:
    write_room("kitchen.usda")
    (rules,) = read_blocks(DOCS / "relations.md", "toml")
    (tmp_path / "my_rules.toml").write_text(rules, encoding="utf-8")
    commands = re.findall(r"^    usd2kg (.*)$", (DOCS / "relations.md").read_text("utf-8"), re.MULTILINE)
    assert len(commands) >= 3
    run_silent(commands, tmp_path)


def test_commands_of_the_stores_page(tmp_path: Path, write_room: Callable[[str], Path]) -> None:
    for name in ("kitchen.usd", "office.usd"):
        write_room(name)
    commands = re.findall(r"^usd2kg (.*)$", read_blocks(DOCS / "stores.md", "sh")[0], re.MULTILINE)
    local = [line for line in commands if "http" not in line]
    assert len(local) >= 6
    run_silent(["build kitchen.usd -o kitchen.ttl", *local], tmp_path)


@pytest.fixture
def write_room(tmp_path: Path) -> Callable[[str], Path]:
    """A function that writes a room with a cup on a table, in the format that the name's extension states."""
    parts = (("table", "0 0 0", "1.2 0.8 0.75"), ("cup", "0.2 0.2 0.75", "0.08 0.08 0.1"))

    def write(name: str) -> Path:
        stage = Usd.Stage.CreateNew(str(tmp_path / name))
        UsdGeom.SetStageMetersPerUnit(stage, 1)
        UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
        for label, lower, size in parts:
            prim = UsdGeom.Xform.Define(stage, f"/Room/{label}").GetPrim()
            Usd.ModelAPI(prim).SetKind("component")
            cube = UsdGeom.Cube.Define(stage, f"/Room/{label}/shape")
            cube.CreateSizeAttr(1.0)
            corner, sides = ([float(word) for word in text.split()] for text in (lower, size))
            cube.AddTranslateOp().Set(tuple(low + side / 2 for low, side in zip(corner, sides, strict=True)))
            cube.AddScaleOp().Set(tuple(sides))
        stage.Save()
        return tmp_path / name

    return write


def run_examples(page: Path, folder: Path) -> None:
    """Run the commands of a page in their order and compare what they print with what the page shows."""
    commands = read_commands(page)
    assert commands
    for arguments, shown in commands:
        if "elk" in arguments:
            # Needs Java and a graph that was edited; tests/validation/test_elk.py covers it.
            continue
        code, printed = run_command(arguments, folder)
        assert code in ({0, 1} if shown else {0}), printed
        assert not shown or matches(shown, printed), "\n".join([" ".join(arguments), *printed])


def run_silent(commands: Iterable[str], folder: Path) -> None:
    """Run commands whose output a page does not show."""
    for line in commands:
        code, printed = run_command(tuple(shlex.split(line, comments=True)), folder)
        assert code in ({0, 1} if line.startswith("validate") else {0}), "\n".join([line, *printed])


def run_python(page: Path, folder: Path) -> None:
    """Run the Python blocks of a page."""
    for block in read_blocks(page, "python"):
        subprocess.run([sys.executable, "-c", block], check=True, cwd=folder, capture_output=True)


def test_python_page_runs() -> None:
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    done = doctest.testfile(
        str(ROOT / "docs" / "python.md"), module_relative=False, optionflags=flags, encoding="utf-8"
    )
    assert done.attempted > 20
    assert done.failed == 0
