"""The command as a process: help, exit codes, pipes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.conftest import Run

# Prints the names of the heavy modules that --help loads.
HELP = """
import sys
from usd2kg.cli.app import main
sys.argv = ["usd2kg", *sys.argv[1:], "--help"]
try:
    main()
finally:
    heavy = {"pxr", "pyhornedowl", "pyoxigraph", "numpy", "rapidfuzz", "usd2kg.scene", "usd2kg.ontology"}
    print("LOADED", sorted(heavy & set(sys.modules)))
"""


def process(*arguments: object, code: str | None = None, **options: object) -> subprocess.CompletedProcess[str]:
    start = ["-c", code] if code is not None else ["-m", "usd2kg"]
    return subprocess.run(
        [sys.executable, *start, *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        **options,
    )


@pytest.mark.parametrize("command", [[], ["build"], ["ground"], ["ontology", "show"]])
def test_help_loads_no_heavy_module(command: list[str]):
    done = process(*command, code=HELP)
    assert done.returncode == 0
    assert "Usage: usd2kg" in done.stdout
    assert done.stdout.splitlines()[-1] == "LOADED []"


def test_a_call_loads_only_the_command_that_it_names():
    code = HELP.replace("heavy = {", "heavy = {'usd2kg.cli.build', 'usd2kg.cli.studio', 'usd2kg.cli.evaluate', ")
    assert process("build", code=code).stdout.splitlines()[-1] == "LOADED ['usd2kg.cli.build']"
    every = process(code=code).stdout.splitlines()[-1]
    assert every == "LOADED ['usd2kg.cli.build', 'usd2kg.cli.evaluate', 'usd2kg.cli.studio']"


def test_a_misspelt_command_names_the_one_that_is_meant():
    done = process("biuld", "s.usd")
    assert done.returncode == 2
    assert "build" in done.stderr


def test_short_and_long_help_option_are_the_same(run: Run):
    done = run("build", "--help")
    assert (done.code, done.err) == (0, "")
    assert run("build", "-h") == done


def test_process_exit_codes(room: Path, tmp_path: Path):
    good = process("build", room, "-o", tmp_path / "room.ttl")
    assert (good.returncode, good.stdout) == (0, "")
    assert (tmp_path / "room.ttl").is_file()
    bad = process("build", tmp_path / "none.usda", "-o", tmp_path / "none.ttl")
    assert (bad.returncode, bad.stdout) == (2, "")
    assert len(bad.stderr.splitlines()) == 1
    assert not (tmp_path / "none.ttl").exists()


def test_openusd_warnings_become_diagnostics(write_stage, tmp_path: Path):
    # OpenUSD warns about a missing reference and an unknown schema.
    scene = write_stage(
        'def Xform "a" ( kind = "component"\n references = @none.usda@ )\n'
        '{\n    def Cube "c" {}\n    def Nonsense "d" {}\n}\n'
    )
    done = process("build", scene, "-o", tmp_path / "a.ttl")
    assert done.returncode == 0
    assert "Warning:" not in done.stderr
    assert "1 object of 1 class (" in done.stderr
    assert "diagnostic" in done.stderr


def test_closed_pipe_is_no_error(room: Path):
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as closed:
        done = subprocess.run(
            [sys.executable, "-m", "usd2kg", "ground", str(room)],
            stdout=closed,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
            timeout=60,
        )
    assert done.returncode == 0
    assert done.stderr == ""


def test_output_is_utf_8_in_every_locale(room: Path, tmp_path: Path):
    scene = tmp_path / "küche.usda"
    scene.write_bytes(room.read_bytes().replace(b"Room", "Küche".encode()))
    environment = {
        key: value for key, value in os.environ.items() if not key.startswith(("LC_", "LANG", "PYTHONIO", "PYTHONUTF8"))
    }
    environment["LC_ALL"] = "C"
    done = subprocess.run(
        [sys.executable, "-m", "usd2kg", "ground", str(scene)],
        capture_output=True,
        check=False,
        timeout=60,
        env=environment,
    )
    assert done.returncode == 0, done.stderr
    assert "/Küche/coffee_mug" in done.stdout.decode("utf-8")
