"""A small stage, and a function that runs the command line in this process."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pytest

from usd2kg.cli.app import main

Run = Callable[..., "Finished"]


class Finished(NamedTuple):
    """Exit code and output of a command."""

    code: int
    out: str
    err: str


@pytest.fixture
def run(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Run:
    """Return a function that runs `usd2kg` with arguments in an empty folder."""
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)

    def call(*arguments: object) -> Finished:
        monkeypatch.setattr(sys, "argv", ["usd2kg", *map(str, arguments)])
        capfd.readouterr()
        code = 0
        try:
            main()
        except SystemExit as stop:
            code = stop.code if isinstance(stop.code, int) else int(stop.code is not None)
        return Finished(code, *capfd.readouterr())

    return call


def _box(name: str, lower: tuple[float, ...], size: tuple[float, ...], extra: str = "") -> str:
    (x0, y0, z0), (x1, y1, z1) = lower, tuple(a + b for a, b in zip(lower, size, strict=True))
    points = ", ".join(f"({x}, {y}, {z})" for x in (x0, x1) for y in (y0, y1) for z in (z0, z1))
    return f"""
    def Xform "{name}" ( kind = "component" {extra} )
    {{
        def Mesh "geo"
        {{
            float3[] extent = [({x0}, {y0}, {z0}), ({x1}, {y1}, {z1})]
            point3f[] points = [{points}]
            int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
            int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
        }}
    }}"""


ROOM = (
    '( metersPerUnit = 1\n upAxis = "Z" )\ndef Xform "Room" ( kind = "group" )\n{'
    + _box("Table_1", (0, 0, 0), (1.6, 0.8, 0.7))
    + _box("coffee_mug", (1, 0.4, 0.7), (0.1, 0.1, 0.1))
    + _box("FruitBowl", (0.1, 0.2, 0.7), (0.3, 0.3, 0.1))
    + _box("Apple", (0.2, 0.3, 0.72), (0.08, 0.08, 0.08))
    + '\n    def Camera "view" {}\n}\n'
)


@pytest.fixture
def room(write_stage: Callable[..., Path]) -> Path:
    """Return a stage: a table with a mug and a bowl on it, an apple in the bowl, and a camera."""
    return write_stage(ROOM, "room.usda")


@pytest.fixture
def graph(run: Run, room: Path) -> Path:
    """Return the graph of the room."""
    path = room.parent / "room.ttl"
    assert run("build", room, "-o", path).code == 0
    return path


LAB = """@prefix : <https://lab.example/onto#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<https://lab.example/onto> a owl:Ontology .
:Equipment a owl:Class .
:Bench a owl:Class ; rdfs:subClassOf :Equipment ; rdfs:label "table"@en ; rdfs:comment "To work at."@en .
:Vessel a owl:Class ; rdfs:subClassOf :Equipment ; rdfs:label "mug"@en .
"""


@pytest.fixture
def lab(tmp_path: Path) -> Path:
    """An ontology of three classes."""
    path = tmp_path / "lab.ttl"
    path.write_text(LAB, encoding="utf-8")
    return path
