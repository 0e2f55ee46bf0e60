"""Things and relations are read from both profiles, and bad files are refused in one line."""

from pathlib import Path

import pytest

from tests.graph.records import BASE, build_graph, thing
from usd2kg.diff import Link, detect_graph_style, objects_of_graph, read_statements
from usd2kg.errors import GraphError
from usd2kg.graph import GraphOptions, write_graph
from usd2kg.ontology import TBox

PLACED = [
    (thing("/Room/Table", (0, 0, 0), (2, 1, 0.7), mass_kg=20.0), "Table"),
    (thing("/Room/Cup", (0.3, 0.3, 0.7), (0.1, 0.1, 0.1)), "Cup"),
    (thing("/Room/Bowl", (0.45, 0.3, 0.7), (0.2, 0.2, 0.1)), None),
]


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_relations_and_classes_are_read(home_tbox: TBox, profile: str) -> None:
    graph = build_graph(home_tbox, PLACED, profile=profile)
    bowl, cup, table = objects_of_graph(graph.triples, "room.ttl")
    assert (bowl.prim_path, cup.prim_path, table.prim_path) == ("/Room/Bowl", "/Room/Cup", "/Room/Table")
    assert (bowl.class_label, cup.class_label, table.class_label) == ("", "cup", "table")
    assert {Link("on", "/Room/Table"), Link("next-to", "/Room/Bowl")} <= cup.links
    assert Link("next-to", "/Room/Cup") in bowl.links, "symmetric relations are told of both"
    assert {link.kind for link in table.links} <= {"room", "near", "next-to"}
    assert (table.mass_kg, cup.mass_kg) == (20.0, None)


@pytest.mark.parametrize(("profile", "annotations"), [("soma", "owl"), ("plain", "rdf12")])
def test_how_a_graph_is_written_is_found(home_tbox: TBox, profile: str, annotations: str, tmp_path: Path) -> None:
    graph = build_graph(home_tbox, PLACED, profile=profile, options=GraphOptions(annotations=annotations))
    path = tmp_path / "room.ttl"
    write_graph(graph, path)
    statements = read_statements(path)
    assert statements == frozenset(graph.triples)
    assert detect_graph_style(statements) == (BASE, profile, annotations)


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("a.ttl", None, r"a\.ttl: cannot be read as Turtle \(No such file"),
        ("a.ttl", "<x> <y", r"a\.ttl: cannot be read as Turtle"),
        ("a.csv", "", r"a\.csv: the ending '\.csv' names no RDF format; expected one of \.ttl"),
    ],
)
def test_files_that_are_no_graphs_are_refused(tmp_path: Path, name: str, text: str | None, told: str) -> None:
    if text is not None:
        (tmp_path / name).write_text(text)
    with pytest.raises(GraphError, match=told):
        read_statements(tmp_path / name)


def test_a_graph_without_things_or_with_two_of_one_path_is_refused(home_tbox: TBox) -> None:
    with pytest.raises(GraphError, match=r"room\.ttl: holds no object"):
        objects_of_graph([], "room.ttl")
    twice = [
        t for base in ("https://a.org/", "https://b.org/") for t in build_graph(home_tbox, PLACED, base=base).triples
    ]
    with pytest.raises(GraphError, match="both have the prim path /Room/Bowl; expected the graph of one scene"):
        objects_of_graph(twice, "room.ttl")
