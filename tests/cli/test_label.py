"""usd2kg label: layers from runs, reports, and the exit codes of the linter."""

import json
from pathlib import Path

import pytest
from pxr import Usd

from tests.cli.conftest import Run
from tests.conftest import shared_file
from usd2kg.demo import demo_gold, demo_scene


@pytest.fixture
def mapping(run: Run, room: Path) -> Path:
    path = room.parent / "room.csv"
    assert run("ground", room, "-o", path).code == 0
    return path


def classes(path: Path) -> dict[str, list[str]]:
    stage = Usd.Stage.Open(str(path))
    found = {str(prim.GetPath()): prim.GetAttribute("semantics:labels:class") for prim in stage.Traverse()}
    return {prim: list(attribute.Get()) for prim, attribute in found.items() if attribute}


def test_writes_labels_of_a_mapping(run: Run, room: Path, mapping: Path):
    before = room.read_bytes()
    done = run("label", room, mapping)
    assert (done.code, done.out) == (0, "")
    assert done.err == "4 prims: 4 written\nwritten to room.labels.usda\n"
    assert room.read_bytes() == before
    assert classes(Path("room.labels.usda"))["/Room/Table_1"] == ["Table"]
    assert run("label", "lint", "room.labels.usda", "--run", mapping).out == "0 findings on 4 labelled prims\n"


def test_lint_asks_for_the_ontology_that_the_labels_name(run: Run, room: Path, tmp_path: Path):
    own = tmp_path / "own.ttl"
    own.write_text(
        "@prefix : <https://lab.example/o#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . <https://lab.example/o> a owl:Ontology .\n"
        ":Thing a owl:Class . :Cup rdfs:subClassOf :Thing . :Table rdfs:subClassOf :Thing ."
    )
    assert run("ground", room, "--ontology", own, "--format", "json", "-o", "own.json").code == 0
    assert run("label", room, "own.json", "--ontology", own, "-o", "own.usda").code == 0
    done = run("label", "lint", "own.usda")
    assert done.code == 2
    assert "the labels are classes of <https://lab.example/o>; give the file of that ontology" in done.err
    assert run("label", "lint", "own.usda", "--ontology", own).code == 0


@pytest.mark.parametrize("kind", ["json", "ttl"])
def test_every_kind_of_run_gives_the_same_layer(run: Run, room: Path, mapping: Path, kind: str):
    other = room.parent / f"room.{kind}"
    if kind == "json":
        run("ground", room, "--format", "json", "-o", other)
    else:
        run("build", room, "-o", other)
    run("label", room, mapping, "-o", "a.usda")
    run("label", room, other, "-o", "b.usda")
    assert classes(Path("a.usda")) == classes(Path("b.usda"))


def test_reports_why_prims_get_no_label(run: Run, room: Path):
    chosen = room.parent / "some.csv"
    chosen.write_text(
        "path,class,confidence,status\n/Room/Table_1,Table,0.4,grounded\n/Room/coffee_mug,,,refused\n"
        "/Room/None,Cup,1,grounded\n/Room/Apple,Cup,,grounded\n/Room/FruitBowl,Bowl,0.9,grounded\n"
    )
    done = run("label", room, chosen, "--at-least", "0.5", "-o", "x.usda")
    assert done.err.splitlines() == [
        "5 prims: 1 written, 4 left out",
        "  1 left out, unknown confidence, expected at least 0.5: /Room/Apple",
        "  1 left out, no such prim on the stage: /Room/None",
        "  1 left out, confidence below 0.5: /Room/Table_1",
        "  1 left out, the run has no class for it: refused: /Room/coffee_mug",
        "written to x.usda",
    ]
    report = json.loads(run("label", room, chosen, "-o", "x.usda", "--json").out)
    assert report["counts"] == {"written": 3, "left out": 2}
    assert report["prims"][0] == {"prim_path": "/Room/Apple", "outcome": "written", "reason": ""}


def test_writes_names_ancestors_and_encodings_as_asked(run: Run, room: Path, mapping: Path):
    done = run("label", "write", room, mapping, "--names", "snake", "--ancestors", "--bare", "-o", "x.usda",
               "--encoding", "semantics,isaac,multiverse")  # fmt: skip
    assert done.code == 0
    text = Path("x.usda").read_text()
    assert "subLayers" not in text
    assert 'semantics:labels:class = ["artifact", "furniture", "table"]' in text
    assert 'semantic:Semantics_hierarchy:params:semanticData = "artifact/furniture/table"' in text
    assert 'string rdf:conceptName = "Table"' in text


def test_modes_keep_replace_or_complete_labels(run: Run, room: Path, mapping: Path):
    run("label", room, mapping, "-o", "a.usda")
    other = room.parent / "other.csv"
    other.write_text("path,class\n/Room/Table_1,Bottle\n")
    kept = run("label", "a.usda", other, "-o", "b.usda")
    assert "1 prim: 1 kept\n  1 kept, has labels already: /Room/Table_1\n" in kept.err
    assert run("label", "a.usda", other, "-o", "b.usda", "--mode", "overwrite").err.startswith("1 prim: 1 replaced\n")
    assert classes(Path("b.usda"))["/Room/Table_1"] == ["Bottle"]
    assert (
        "1 kept, its labels name another class" in run("label", "a.usda", other, "-o", "c.usda", "--mode", "skip").err
    )
    stale = run("label", "lint", "b.usda", "--run", mapping)
    assert stale.code == 1
    assert stale.out.splitlines()[0] == "warning [label-stale] Table_1 /Room/Table_1"
    assert stale.out.endswith("1 finding (1 warning) on 4 labelled prims\n")
    assert json.loads(run("label", "lint", "b.usda", "--run", mapping, "--json").out)["counts"]["warning"] == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--encoding", "rdf"], "--encoding rdf: expected a comma-separated list of semantics, isaac, multiverse"),
        (["--mode", "append"], "--mode append: expected one of new, overwrite, skip"),
        (["--names", "camel"], "class names 'camel' are unknown; expected one of local, label, snake"),
        (["-o", "x.usdz"], "expected a label layer with a name ending in one of .usda, .usdc, .usd"),
        (["-o", "none/x.usda"], "the folder none does not exist"),
    ],
)
def test_rejects_invalid_options(run: Run, room: Path, mapping: Path, arguments: list[str], message: str):
    done = run("label", room, mapping, *arguments)
    assert (done.code, done.out) == (2, "")
    assert message in done.err
    assert done.err.count("\n") == 1


def test_rejects_the_source_as_output(run: Run, room: Path, mapping: Path):
    done = run("label", room, mapping, "-o", room)
    assert done.code == 2
    assert "is an input, too, and would be overwritten" in done.err


def test_rejects_missing_files(run: Run, room: Path, mapping: Path):
    assert "no such file" in run("label", "none.usda", mapping).err
    assert run("label", room, "none.csv").code == 2
    assert run("label", "lint", "none.usda").code == 2


def test_labels_the_demo_kitchen_by_its_gold(run: Run):
    done = run("label", demo_scene(), demo_gold(), "-o", "k.usda", "--encoding", "semantics,isaac,multiverse")
    assert done.code == 0
    assert done.err.startswith("294 prims: 294 written\n")
    assert len(classes(Path("k.usda"))) == 294
    assert run("label", "lint", "k.usda").out == "0 findings on 294 labelled prims\n"


def test_labels_a_house_by_its_grounding(run: Run):
    house = shared_file("scenes/aws_robomaker/small_house.usdc")
    assert run("ground", house, "-o", "house.csv").code == 0
    done = run("label", house, "house.csv", "--at-least", "0.8", "-o", "house.usda", "--ancestors")
    assert done.code == 0
    labelled = classes(Path("house.usda"))
    assert labelled["/default/BalconyTable_01_001"] == ["DesignedArtifact", "DesignedFurniture", "Table"]
    assert f"{len(labelled)} written" in done.err
    assert run("label", "lint", "house.usda", "--run", "house.csv").code == 0


def test_a_room_group_is_no_prim_without_a_class(run: Run, room: Path, graph: Path):
    group = '<https://example.org/room/Room> a u2k:RoomGroup ; u2k:primPath "/Room" .\n'
    graph.write_text(graph.read_text("utf-8") + group, "utf-8")
    done = run("label", room, graph, "-o", "x.usda")
    assert done.err.splitlines() == ["4 prims: 4 written", "written to x.usda"]
