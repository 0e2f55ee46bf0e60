"""No command writes over a file that it reads."""

from pathlib import Path

import pytest

from tests.cli.conftest import Run

DECISIONS = "path,decision\n/Room/coffee_mug,Cup\n"


@pytest.mark.parametrize("option", ["-o", "--queue", "--unplaced", "--carried"])
@pytest.mark.parametrize("command", ["ground", "build"])
@pytest.mark.parametrize("victim", ["decisions.csv", "room.ttl", "room.usda"])
def test_ground_and_build(run: Run, room: Path, graph: Path, command: str, option: str, victim: str):
    decisions = room.parent / "decisions.csv"
    decisions.write_text(DECISIONS)
    target = room.parent / victim
    before = target.read_bytes()
    done = run(command, room, "--decisions", decisions, "--previous", graph, option, target)
    assert done.code == 2
    # build refuses names of other formats before.
    if (command, option) != ("build", "-o") or victim == "room.ttl":
        assert done.err == f"usd2kg: {target}: is an input, too, and would be overwritten; choose another output\n"
    assert target.read_bytes() == before


def test_the_default_name_of_a_graph_counts(run: Run, room: Path):
    Path("decisions.csv").write_text(DECISIONS)
    assert run("build", room).code == 0
    done = run("build", room, "--decisions", "decisions.csv", "--previous", "room.ttl")
    assert (done.code, done.err) == (
        2,
        "usd2kg: room.ttl: is an input, too, and would be overwritten; choose another output\n",
    )


def test_label_diff_and_graph(run: Run, room: Path, graph: Path):
    told = f"usd2kg: {graph}: is an input, too, and would be overwritten; choose another output\n"
    before = graph.read_bytes(), room.read_bytes()
    assert run("diff", graph, room, "-o", graph).err == told
    assert run("graph", "convert", graph, "-o", graph).err == told
    assert run("label", room, graph, "-o", room).err == told.replace(str(graph), str(room))
    Path("link.svg").symlink_to(graph)
    assert "is an input, too" in run("graph", "draw", graph, "-o", "link.svg").err
    Path("link.ttl").symlink_to(room)
    assert "is an input, too" in run("build", room, "-o", "link.ttl").err
    assert (graph.read_bytes(), room.read_bytes()) == before


def test_a_layer_that_only_another_variant_needs(run: Run, room: Path):
    mapping = room.parent / "room.csv"
    run("ground", room, "-o", mapping)
    other = room.parent / "other.usda"
    other.write_text(room.read_text())
    done = run("label", room, mapping, "-o", other)
    assert (done.code, done.err) == (
        2,
        f"usd2kg: {other}: exists and is not a label layer of usd2kg; choose another name\n",
    )
    assert run("label", room, mapping).code == run("label", room, mapping).code == 0
