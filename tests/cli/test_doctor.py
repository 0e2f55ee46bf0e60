"""usd2kg doctor: what is installed and configured."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.conftest import Run
from usd2kg.cli import doctor

KEY = "sk-planted-0123456789"


def test_lists_versions_extras_and_caches(run: Run, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("USD2KG_TABLE_CACHE", "off")
    done = run("doctor", "--json")
    assert done.code == 0
    report = json.loads(done.out)
    assert all(re.match(r"\d+\.", found) for found in report["packages"].values())
    assert {"numpy", "pyoxigraph", "usd-core"} <= report["packages"].keys()
    assert report["extras"]["serve"] == {
        "is_installed": True,
        "packages": report["extras"]["serve"]["packages"],
        "install": "",
    }
    assert set(report["extras"]["serve"]["packages"]) == {"starlette", "uvicorn"}
    assert report["caches"]["tables"] == {"path": None, "mib": 0.0}
    assert report["caches"]["completions"]["path"].endswith(".sqlite")


def test_a_missing_extra_names_its_command(run: Run, monkeypatch: pytest.MonkeyPatch):
    found = doctor._version
    monkeypatch.setattr(doctor, "_version", lambda name: None if name == "uvicorn" else found(name))
    done = run("doctor")
    assert done.code == 0
    assert re.search(r"\[serve\] +pip install 'usd2kg\[serve\]' +starlette \S+, uvicorn missing", done.out)


def test_a_missing_package_is_a_finding(run: Run, monkeypatch: pytest.MonkeyPatch):
    found = doctor._version
    monkeypatch.setattr(doctor, "_version", lambda name: None if name == "numpy" else found(name))
    done = run("doctor")
    assert done.code == 1
    assert re.search(r"numpy +missing", done.out)


@pytest.mark.parametrize("form", [[], ["--json"], ["--verbose"]])
def test_keys_are_never_shown(run: Run, monkeypatch: pytest.MonkeyPatch, form: list[str]):
    for name in ("OPENAI_API_KEY", "USD2KG_STORE_PASSWORD", "USD2KG_STUDIO_PASSWORD"):
        monkeypatch.setenv(name, KEY)
    monkeypatch.delenv("ANTHROPIC_API_KEY", raising=False)
    done = run("doctor", *form)
    assert KEY not in done.out + done.err
    if not form:
        assert re.search(r"OPENAI_API_KEY +set\n", done.out)
        assert re.search(r"ANTHROPIC_API_KEY +not set\n", done.out)


def test_needs_no_extra():
    # A package that is None in sys.modules cannot be imported.
    extras = [
        "starlette",
        "uvicorn",
        "trimesh",
        "PIL",
        "scipy",
        "pandas",
        "mcp",
        "pydantic_ai",
        "onnxruntime",
        "resvg_py",
    ]
    code = f"""
import sys
from pathlib import Path
sys.modules.update(dict.fromkeys({extras!r}))
sys.argv = ["usd2kg", "doctor"]
from usd2kg.cli.app import main
main()
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    assert "USD2KG_STUDIO_PASSWORD" in done.stdout


def test_a_user_without_a_home_folder_has_no_caches(run: Run, monkeypatch: pytest.MonkeyPatch):
    def fail() -> None:
        raise RuntimeError("Could not determine home directory.")

    for name in ("USD2KG_CACHE", "USD2KG_GRAPH_CACHE", "USD2KG_TABLE_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(Path, "home", fail)
    done = run("doctor", "--json")
    assert done.code == 0
    assert {found["path"] for found in json.loads(done.out)["caches"].values()} == {None}
