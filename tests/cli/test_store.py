"""usd2kg store, and the commands that read a store."""

import json
from pathlib import Path

import pytest

from tests.cli.conftest import Run


@pytest.fixture
def folder(run: Run, room: Path) -> Path:
    """Return a store with the room and its ontology."""
    place = room.parent / "store"
    done = run("build", room, "--store", place, "--merge-imports")
    assert done.code == 0, done.err
    assert f"{place}: loaded <https://example.org/room>" in done.err
    assert f"written to {place}" in done.err
    return place


def test_build_into_a_store_writes_no_file(folder: Path):
    assert [path.name for path in Path().iterdir()] == []


def test_lists_scenes_and_ontologies(run: Run, folder: Path):
    rows = json.loads(run("store", "list", "--store", folder, "--json").out)
    assert [(row["name"], row["kind"], row["objects"]) for row in rows] == [
        ("room", "scene", 4),
        ("SOMA-HOME.owl", "ontology", 0),
    ]
    assert run("store", "list", "--store", folder).out.splitlines()[1].split()[:3] == ["room", "scene", "4"]


def test_query_validate_and_draw_read_a_store(run: Run, folder: Path, graph: Path):
    assert run("store", "remove", "SOMA-HOME.owl", "--store", folder).code == 0
    for question in (["on", "Table_1"], ["--sparql", "SELECT ?p { ?o u2k:primPath ?p } ORDER BY ?p"]):
        asked = run("query", folder, *question)
        assert asked.out == run("query", graph, *question).out
        assert "coffee_mug" in asked.out
    assert run("validate", folder).out == run("validate", graph).out
    assert run("graph", "draw", folder, "--scene", "room").code == 0
    assert Path("room.svg").read_text("utf-8").startswith("<svg")


def test_loads_removes_and_updates_graphs(run: Run, graph: Path, tmp_path: Path):
    place = tmp_path / "new" / "store"
    assert "loaded <https://example.org/room>" in run("store", "load", graph, "--store", place).err
    assert "loaded <urn:mine>" in run("store", "load", graph, "--store", place, "--scene", "urn:mine").err
    update = "DELETE WHERE { GRAPH <urn:mine> { ?s ?p ?o } }"
    assert run("store", "update", update, "--store", place).err == f"{place}: updated\n"
    assert run("store", "remove", "room", "--store", place).code == 0
    assert json.loads(run("store", "list", "--store", place, "--json").out) == []
    assert run("query", place, "on", "table").err == (
        f"usd2kg: {place}: contains no usd2kg graph; load one with usd2kg build SCENE --store\n"
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["store", "list", "--store", "nowhere"],
            "nowhere: is not a store; expected a folder that usd2kg build --store",
        ),
        (["store", "load", "nothing.ttl", "--store", "s"], "nothing.ttl: no such file"),
        (
            ["store", "list", "--store", "http://me:secret@x/"],
            "store http://…@x/: its address contains a user or password",
        ),
        (["store", "list", "--store", "gopher://x/"], "is not a server address"),
        (
            ["query", "no.ttl", "--scene", "x", "on", "y"],
            "no.ttl: is a single graph; --scene selects one of a store",
        ),
        (["serve", "http://x/"], "http://x/: is already a server; expected a graph file or a store folder"),
        (["serve", "no.ttl", "--port", "0"], "no.ttl: no such file"),
    ],
)
def test_rejects_invalid_stores(run: Run, arguments: list[str], message: str):
    done = run(*arguments)
    assert done.code == 2
    assert done.err.startswith("usd2kg: ")
    assert message in done.err
    assert done.err.count("\n") == 1
    assert "secret" not in done.err


def test_loads_no_graph_if_one_file_is_invalid(run: Run, graph: Path, tmp_path: Path):
    (tmp_path / "bad.ttl").write_text("<urn:a> <urn:b> 1 .")
    done = run("store", "load", graph, tmp_path / "bad.ttl", "--store", tmp_path / "s")
    assert (done.code, "states no graph IRI; expected a graph that usd2kg build wrote" in done.err) == (2, True)
    assert not (tmp_path / "s").exists()


def test_rejects_two_graphs_with_the_same_iri(run: Run, room: Path, tmp_path: Path):
    done = run("build", room, room, "--store", tmp_path / "s")
    assert (done.code, "two graphs have the IRI <https://example.org/room/>" in done.err) == (2, True)


def test_several_scenes_are_asked_one_by_one(run: Run, graph: Path, tmp_path: Path):
    place = tmp_path / "store"
    run("store", "load", graph, "--store", place)
    other = tmp_path / "other.ttl"
    text = graph.read_text("utf-8").replace("coffee_mug", "tea_mug").replace("example.org/room", "example.org/second")
    other.write_text(text, encoding="utf-8")
    run("store", "load", other, "--store", place)
    lines = run("query", place, "on", "Table_1").out.splitlines()
    assert lines[0].split()[0] == "scene"
    found = {tuple(line.split()[:2]) for line in lines[1:-1]}
    assert {("room", "coffee_mug"), ("second", "tea_mug")} <= found
    assert {("room", "tea_mug"), ("second", "coffee_mug")}.isdisjoint(found)
    rows = json.loads(run("query", place, "--question", "close-to", "--with", "thing=Table_1", "--json").out)
    assert {row["scene"] for row in rows} == {"room", "second"}
    assert len(rows) == 2 * len({row["path"].replace("tea_mug", "coffee_mug") for row in rows})
    # A scene that lacks the object adds no rows.
    only = run("query", place, "where", "is", "tea_mug")
    assert [line.split()[0] for line in only.out.splitlines()[1:-1]] == ["second"]
    assert run("query", place, "--scene", "room", "on", "Table_1").out.split()[0] == "object"
    missing = run("query", place, "on", "helicopter")
    assert missing.code != 0
    assert "there is no helicopter" in missing.err
    count = run("query", place, "--sparql", "SELECT (COUNT(DISTINCT ?o) AS ?n) { ?o u2k:primPath ?p }")
    assert count.out.splitlines()[1] == "8"


def test_explain_prints_a_query_that_gives_the_same_answer(run: Run, graph: Path):
    for question in (
        ["on", "Table_1"],
        ["near", "Table_1"],
        ["parts", "of", "Table_1"],
        ["where", "is", "Table_1"],
        ["all", "of", "table"],
        ["--question", "close-to", "--with", "thing=Table_1"],
        ["--question", "contents", "--with", "thing=Table_1"],
    ):
        query = run("query", graph, *question, "--explain").out
        assert query.startswith("PREFIX ")
        asked, edited = run("query", graph, *question), run("query", graph, "--sparql", query)
        assert edited.out.splitlines()[1:] == asked.out.splitlines()[1:], question
