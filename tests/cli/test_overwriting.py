"""No command overwrites a file that it reads."""

from pathlib import Path

import pytest

from tests.cli.conftest import Run

DECISIONS = "path,decision\n/Room/coffee_mug,Cup\n"


@pytest.mark.parametrize("option", ["-o", "--queue", "--unplaced", "--carried"])
@pytest.mark.parametrize("command", ["ground", "build"])
@pytest.mark.parametrize("input_file", ["decisions.csv", "room.ttl", "room.usda"])
def test_ground_and_build_overwrite_no_input(
    run: Run, room: Path, graph: Path, command: str, option: str, input_file: str
):
    decisions = room.parent / "decisions.csv"
    decisions.write_text(DECISIONS)
    target = room.parent / input_file
    before = target.read_bytes()
    done = run(command, room, "--decisions", decisions, "--previous", graph, option, target)
    assert done.code == 2
    # build rejects other graph formats first.
    if (command, option) != ("build", "-o") or input_file == "room.ttl":
        assert done.err == f"usd2kg: {target}: is an input, too, and would be overwritten; choose another output\n"
    assert target.read_bytes() == before


def test_checks_the_default_name_of_the_graph(run: Run, room: Path):
    Path("decisions.csv").write_text(DECISIONS)
    assert run("build", room).code == 0
    done = run("build", room, "--decisions", "decisions.csv", "--previous", "room.ttl")
    assert (done.code, done.err) == (
        2,
        "usd2kg: room.ttl: is an input, too, and would be overwritten; choose another output\n",
    )


def test_label_diff_and_graph_overwrite_no_input(run: Run, room: Path, graph: Path):
    message = f"usd2kg: {graph}: is an input, too, and would be overwritten; choose another output\n"
    before = graph.read_bytes(), room.read_bytes()
    assert run("diff", graph, room, "-o", graph).err == message
    assert run("graph", "convert", graph, "-o", graph).err == message
    assert run("label", room, graph, "-o", room).err == message.replace(str(graph), str(room))
    Path("link.svg").symlink_to(graph)
    assert "is an input, too" in run("graph", "draw", graph, "-o", "link.svg").err
    Path("link.ttl").symlink_to(room)
    assert "is an input, too" in run("build", room, "-o", "link.ttl").err
    assert (graph.read_bytes(), room.read_bytes()) == before


def test_label_overwrites_only_its_own_layers(run: Run, room: Path):
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
