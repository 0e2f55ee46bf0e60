"""The documents agree with the software."""

import doctest
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import shared_file

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


def test_readme_shows_the_output_of_build(tmp_path: Path) -> None:
    scene, graph = shared_file("scenes/aws_robomaker/small_house.usdc"), tmp_path / "house.ttl"
    done = subprocess.run(
        [sys.executable, "-m", "usd2kg", "build", str(scene), "-o", str(graph)],
        check=True,
        capture_output=True,
        text=True,
    )
    counted, confidence, relations, _written = (done.stdout + done.stderr).splitlines()
    readme = (ROOT / "README.md").read_text("utf-8")
    # The duration after " in " varies.
    for line in (
        f"small_house.usdc:{counted.partition('small_house.usdc:')[2]}",
        confidence,
        relations.partition(" in ")[0],
    ):
        assert f"\n{line}" in readme


def test_python_page_runs() -> None:
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    done = doctest.testfile(
        str(ROOT / "docs" / "python.md"), module_relative=False, optionflags=flags, encoding="utf-8"
    )
    assert done.attempted > 20
    assert done.failed == 0
