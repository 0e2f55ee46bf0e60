"""The bill of materials: dependencies, extras and the packages that the pages bundle."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

from tools.merge_sbom import merge_sbom, read_npm_components

ROOT = Path(__file__).parents[1]
LOCK = json.loads((ROOT / "web/package-lock.json").read_text("utf-8"))
NAME = re.compile(r"^([A-Za-z0-9._-]+)")


def bill(*names: str) -> dict[str, Any]:
    components = [
        {"bom-ref": f"requirements-L{line}", "description": "line", "name": name, "purl": f"pkg:pypi/{name}@1"}
        for line, name in enumerate(names)
    ]
    return {"bomFormat": "CycloneDX", "metadata": {"component": {"bom-ref": "root"}}, "components": components}


def test_what_only_an_extra_needs_is_optional():
    merged = merge_sbom(bill("numpy"), bill("anyio", "numpy"), {"packages": {}})
    assert [(one["bom-ref"], one["scope"]) for one in merged["components"]] == [
        ("pkg:pypi/anyio@1", "optional"),
        ("pkg:pypi/numpy@1", "required"),
    ]
    assert merged["dependencies"][0] == {"ref": "root", "dependsOn": ["pkg:pypi/anyio@1", "pkg:pypi/numpy@1"]}
    assert "description" not in merged["components"][0]


def test_bundled_packages_are_listed_and_tools_are_not():
    found = {one["name"]: one for one in read_npm_components(LOCK)}
    assert set(found) >= {"preact", "three", "@preact/signals", "@preact/signals-core"}
    assert found.keys().isdisjoint({"vite", "vitest", "typescript", "@types/three"})
    signals = found["@preact/signals"]
    assert signals["purl"] == f"pkg:npm/%40preact/signals@{signals['version']}"
    assert signals["licenses"] == [{"license": {"id": "MIT"}}]
    assert signals["hashes"][0]["alg"] == "SHA-512"
    assert len(signals["hashes"][0]["content"]) == 128


def test_all_extras_are_pinned():
    pinned = {found[1].lower() for line in (ROOT / "requirements/extras.txt").read_text("utf-8").splitlines()
              if (found := NAME.match(line))}  # fmt: skip
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    named = [*project["dependencies"], *(name for extra in project["optional-dependencies"].values() for name in extra)]
    assert {NAME.match(name)[1].lower() for name in named} <= pinned
