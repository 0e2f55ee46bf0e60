"""Questions about what changed since an older version."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from tests.graph.records import build_graph, open_store, thing
from usd2kg.assistant import InterpretedAnswer, ask_offline
from usd2kg.cli.app import make_app
from usd2kg.errors import GraphError
from usd2kg.graph import write_graph
from usd2kg.ontology import TBox
from usd2kg.query import GraphStore

FLOOR = (thing("/R/Floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor")
TABLE = thing("/R/Table", (0, 0, 0), (1.6, 0.8, 0.7))


def cup(x: float):
    return thing("/R/Cup", (x, 0.4, 0.7), (0.1, 0.1, 0.1))


BEFORE = [FLOOR, (TABLE, "Table"), (cup(0.2), "Cup"), (thing("/R/Jar", (3, 3, 0), (0.2, 0.2, 0.3)), "Bottle")]
# The cup moved by 0.5 m and is called a bowl, the jar is gone, a plate stands on the table.
AFTER = [
    FLOOR,
    (TABLE, "Table"),
    (cup(0.7), "Bowl"),
    (thing("/R/Plate", (1.2, 0.2, 0.7), (0.25, 0.25, 0.02)), "DinnerPlate"),
]


@pytest.fixture(scope="module", params=["soma", "plain"])
def versions(home_tbox: TBox, request: pytest.FixtureRequest, tmp_path_factory) -> tuple[Path, Path, GraphStore]:
    """The file of the older version, that of the newer one, and the newer one."""
    folder = tmp_path_factory.mktemp("versions")
    files = []
    for name, placed in (("old", BEFORE), ("new", AFTER)):
        graph = build_graph(home_tbox, placed, profile=request.param)
        write_graph(graph, folder / f"{name}.ttl")
        files.append(folder / f"{name}.ttl")
    return files[0], files[1], open_store(build_graph(home_tbox, AFTER, profile=request.param))


def ask(versions: tuple[Path, Path, GraphStore], question: str) -> InterpretedAnswer:
    return ask_offline(versions[2], question, versions[0])


def changes(asked: InterpretedAnswer) -> list[tuple[str, str]]:
    return [(str(row[0]), str(row[3])) for row in asked.answer.rows]


@pytest.mark.parametrize(
    "question", ["what changed?", "What has changed since yesterday?", "what is different?", "changes"]
)
def test_what_changed(versions: tuple[Path, Path, GraphStore], question: str):
    asked = ask(versions, question)
    assert asked.sentence == (
        "1 appeared: the dinner plate Plate (on Table). 1 disappeared: the bottle Jar (on Floor). "
        "1 moved: the bowl Cup by 50 cm. 1 changed class: Cup from cup to bowl."
    )
    assert changes(asked) == [("Plate", "appeared"), ("Jar", "disappeared"), ("Cup", "moved"), ("Cup", "reclassified")]
    assert asked.answer.values[2][4] == 0.5


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("what moved?", [("Cup", "moved")]),
        ("which objects are new?", [("Plate", "appeared")]),
        ("is anything missing?", [("Jar", "disappeared")]),
        ("what was removed since last week", [("Jar", "disappeared")]),
        ("did the bowl move?", [("Cup", "moved")]),
        ("has the table moved?", []),
    ],
)
def test_one_kind_of_change(versions: tuple[Path, Path, GraphStore], question: str, expected: list[tuple[str, str]]):
    asked = ask(versions, question)
    assert changes(asked) == expected
    assert asked.verdict is bool(expected)


def test_the_same_version_has_no_changes(versions: tuple[Path, Path, GraphStore]):
    asked = ask_offline(versions[2], "what changed?", versions[1])
    assert (asked.sentence, asked.answer.rows) == ("Nothing changed; 4 objects were compared with 4.", ())


def test_without_an_older_version_the_answer_says_what_to_pass(versions: tuple[Path, Path, GraphStore]):
    with pytest.raises(GraphError, match="--since OLD"):
        ask_offline(versions[2], "what changed?")


def test_the_command_compares_files(versions: tuple[Path, Path, GraphStore]):
    old, new, _ = versions
    done = CliRunner().invoke(make_app(), ["ask", str(new), "what moved?", "--since", str(old)])
    assert done.exit_code == 0
    assert "1 moved: the bowl Cup by 50 cm." in done.output
