"""usd2kg diff and the decisions that usd2kg build --previous carries over."""

import json
from collections.abc import Callable
from pathlib import Path

import pyoxigraph as ox
import pytest

from tests.cli.conftest import ROOM, Run

WriteStage = Callable[..., Path]


@pytest.fixture
def edited(write_stage: WriteStage) -> Path:
    """Return the room with the mug renamed, the apple removed, and the bowl moved by 20 cm."""
    renamed = ROOM.replace("coffee_mug", "teaMug")
    start, end = (renamed.index(text) for text in ('    def Xform "Apple"', '    def Camera "view"'))
    text = renamed[:start] + renamed[end:]
    for corner in ("(0.1, 0.2, 0.7)", "(0.4, 0.5, 0.7)"):
        assert corner in text
    for before, after in (("(0.4, ", "(0.6, "), ("(0.1, 0.2", "(0.3, 0.2"), ("(0.1, 0.5", "(0.3, 0.5")):
        text = text.replace(before, after)
    return write_stage(text, "edited.usda")


def test_prints_changes_of_two_scenes(run: Run, room: Path, edited: Path) -> None:
    done = run("diff", room, edited)
    assert done.code == 1
    assert done.err == ""
    lines = done.out.splitlines()
    assert lines[0] == f"{room} → {edited}"
    assert "Removed, 1 object" in lines
    assert "  /Room/coffee_mug → /Room/teaMug (cup): renamed: same size, same class, in place" in lines
    assert any(line.startswith("  /Room/FruitBowl (bowl): 0.20 m, from ") for line in lines)
    assert lines[-1] == "4 objects before, 3 after: 1 removed, 1 renamed, 1 moved; 1 unchanged"


def test_reports_no_change_in_every_format(run: Run, room: Path) -> None:
    done = run("diff", room, room)
    assert (done.code, done.out.splitlines()[-1]) == (0, "no changes in 4 objects")
    done = run("diff", room, room, "--json", "--no-ground")
    assert done.code == 0
    assert json.loads(done.out)["changed"] == []
    done = run("diff", room, room, "--format", "sparql")
    assert done.code == 0
    assert "0 statements deleted, 0 inserted" in done.err


def test_json_has_pairs_of_iris(run: Run, graph: Path, edited: Path) -> None:
    done = run("diff", graph, edited, "--json")
    assert done.code == 1
    data = json.loads(done.out)
    assert data["counts"]["renamed"] == 1
    base = "https://example.org/room/"
    assert data["same_as"] == [{"old": f"{base}Room.coffee_mug", "new": f"{base}Room.teaMug"}]
    assert data["removed"][0]["path"] == "/Room/Apple"
    (mug,) = (each for each in data["changed"] if each["path"]["new"] == "/Room/teaMug")
    assert mug["match"]["by"] == "place"
    (bowl,) = (each for each in data["changed"] if "moved" in each)
    assert bowl["moved"]["distance_m"] == pytest.approx(0.2, abs=1e-6)


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_update_turns_the_old_store_into_the_new(run: Run, room: Path, edited: Path, profile: str) -> None:
    for scene in (room, edited):
        options = ("--base", "https://my.lab/k/", "--profile", profile, "-o", f"{scene.stem}.ttl")
        assert run("build", scene, *options).code == 0
    done = run("diff", "room.ttl", "edited.ttl", "--format", "sparql", "--graph", "https://my.lab/g", "-o", "change.ru")
    assert (done.code, done.out) == (1, "")
    named = ox.NamedNode("https://my.lab/g")
    old, new = ox.Store(), ox.Store()
    old.load(path="room.ttl", format=ox.RdfFormat.TURTLE, to_graph=named)
    new.load(path="edited.ttl", format=ox.RdfFormat.TURTLE, to_graph=named)
    old.update(Path("change.ru").read_text("utf-8"))
    both = ox.Dataset(old), ox.Dataset(new)
    for dataset in both:
        dataset.canonicalize(ox.CanonicalizationAlgorithm.RDFC_1_0)
    assert both[0] == both[1]


def test_builds_a_stage_like_the_graph_it_is_compared_with(run: Run, room: Path) -> None:
    assert run("build", room, "--profile", "plain", "--annotations", "rdf12", "-o", "room.ttl").code == 0
    assert run("diff", "room.ttl", room, "--format", "sparql").code == 0


def test_asks_for_the_ontology_that_a_graph_states(run: Run, room: Path, tmp_path: Path) -> None:
    ontology = tmp_path / "own.ttl"
    ontology.write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
        "<https://my.lab/o> a owl:Ontology . <https://my.lab/o#Cup> a owl:Class ; rdfs:label 'cup' .\n"
        "<https://my.lab/o#Bowl> a owl:Class ; rdfs:label 'bowl' .\n"
    )
    graph = tmp_path / "own_graph.ttl"
    assert run("build", room, "-o", graph, "--ontology", ontology).code == 0
    done = run("diff", graph, room)
    assert (done.code, "<https://my.lab/o>, which is not built in; give the ontology" in done.err) == (2, True), (
        done.err
    )
    done = run("diff", graph, room, "--ontology", ontology)
    assert (done.code, done.out.splitlines()[-1]) == (0, "no changes in 4 objects")


def test_reports_different_bases(run: Run, room: Path, edited: Path) -> None:
    for scene in (room, edited):
        assert run("build", scene, "-o", f"{scene.stem}.ttl").code == 0
    assert "4 objects before, 3 after" in run("diff", "room.ttl", "edited.ttl").out
    message = run("diff", "room.ttl", "edited.ttl", "--format", "sparql").err
    assert "base: the namespaces of the individuals differ, <https://example.org/room/> and <https" in message


def test_reports_versions_without_classes(run: Run, graph: Path, room: Path) -> None:
    done = run("diff", graph, room, "--no-ground", "--relation-kinds", "none")
    assert (done.code, done.out.splitlines()[-1]) == (0, "no changes in 4 objects")
    assert "classes: only one version has classes" in done.err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--format", "xml"], "format 'xml' is unknown; expected one of text, json, sparql"),
        (["--graph", "https://my.lab/g"], "--graph names the graph of an update; use it with --format sparql"),
        (["--graph", "g", "--format", "sparql"], "graph 'g' is not an absolute IRI"),
        (["--relation-kinds", "on,under"], "--relation-kinds: kind 'under' is unknown; expected a list of on, inside"),
        (["--moved", "-1"], "moved m -1.0: expected a number that is not negative"),
        (["-o", "no/such/file"], "the folder no/such does not exist"),
    ],
)
def test_rejects_invalid_options(run: Run, graph: Path, options: list[str], message: str) -> None:
    done = run("diff", graph, graph, *options)
    assert done.code == 2
    assert message in done.err
    assert done.err.count("\n") == 1


def test_limits_changes_of_a_kind_without_all(run: Run, write_stage: WriteStage) -> None:
    def scene(name: str, shift: float) -> Path:
        cubes = "".join(
            f'def Cube "Cup_{i}" ( kind = "component" ) {{\ndouble size = 0.1\n double3 xformOp:translate = '
            f'({i}, {shift * i}, 0)\n uniform token[] xformOpOrder = ["xformOp:translate"]\n}}\n'
            for i in range(1, 31)
        )
        head = '( metersPerUnit = 1\n upAxis = "Z" )\n'
        return write_stage(f'{head}def Xform "Room" ( kind = "group" )\n{{\n{cubes}}}\n', name)

    old, new = scene("old.usda", 0), scene("new.usda", 0.5)
    cut, whole = run("diff", old, new, "--no-ground"), run("diff", old, new, "--no-ground", "--all")
    assert "  … 10 more (--all shows them)" in cut.out
    assert cut.out.count(" m, from ") == 20
    assert whole.out.count(" m, from ") == 30


def test_carries_decisions_over_to_renamed_objects(run: Run, room: Path, edited: Path) -> None:
    Path("decisions.csv").write_text("path,decision\n/Room/coffee_mug,Bowl\n/Room/Apple,Cup\n/Room/Table_1,Table\n")
    files = ("--unplaced", "unplaced.csv", "--carried", "carried.csv")
    done = run("build", edited, "-o", "edited.ttl", "--decisions", "decisions.csv", "--previous", room, *files)
    assert done.code == 0
    messages = done.err.splitlines()
    assert "decision: /Room/coffee_mug → /Room/teaMug (renamed: same size, in place)" in messages
    assert any(line.startswith("decision not placed: /Room/Apple <") for line in messages)
    assert "3 decisions: 1 kept, 1 carried over, 1 not placed" in messages
    assert 'decidedFor "/Room/coffee_mug"' in Path("edited.ttl").read_text("utf-8")
    assert Path("unplaced.csv").read_text().splitlines()[1].startswith("/Room/Apple,http")
    # The carried decisions need no earlier scene.
    again = run("build", edited, "-o", "again.ttl", "--decisions", "carried.csv")
    assert again.code == 0
    same = run("diff", "edited.ttl", "again.ttl")
    assert same.code == 0
    done = run("ground", edited, "--decisions", "decisions.csv", "--previous", room)
    (row,) = (line for line in done.out.splitlines() if line.startswith("/Room/teaMug,"))
    assert row.endswith(",bowl,1.0000,reviewed,lexical,,,")


@pytest.mark.parametrize("command", ["ground", "build"])
def test_decisions_without_an_object_are_reported(run: Run, room: Path, tmp_path: Path, command: str):
    (tmp_path / "made.csv").write_text("path,decision\n/Room/Apple,Cup\n/Room/Gone,Cup\n")
    output = ["-o", tmp_path / "room.ttl"] if command == "build" else []
    done = run(command, room, "--decisions", tmp_path / "made.csv", *output)
    assert done.code == 0
    assert "1 decision not used: no object of" in done.err
    assert "has the path (" in done.err
    assert "/Room/Gone" in done.err


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--previous", "old.ttl"], "--previous needs a person's decisions; give their file with --decisions"),
        (["--unplaced", "lost.csv"], "--unplaced and --carried need the earlier scene; give it with --previous OLD"),
    ],
)
def test_previous_needs_decisions(run: Run, room: Path, options: list[str], message: str) -> None:
    done = run("build", room, *options)
    assert done.code == 2
    assert message in done.err


def test_reads_a_compressed_graph(run: Run, graph: Path):
    packed = graph.parent / "packed.ttl.gz"
    run("graph", "convert", graph, "-o", packed)
    assert run("diff", graph, packed).code == 0
