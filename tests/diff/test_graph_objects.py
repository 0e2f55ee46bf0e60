"""Reading objects and relations from graphs of both profiles."""

from pathlib import Path

import pytest

from tests.graph.records import BASE, build_graph, thing
from usd2kg.diff import Link, detect_graph_style, objects_of_graph
from usd2kg.errors import GraphError
from usd2kg.graph import GraphOptions, write_graph
from usd2kg.graph.rdf_document import read_statements
from usd2kg.ontology import TBox

ROOM = [
    (thing("/Room/Table", (0, 0, 0), (2, 1, 0.7), mass_kg=20.0), "Table"),
    (thing("/Room/Cup", (0.3, 0.3, 0.7), (0.1, 0.1, 0.1)), "Cup"),
    (thing("/Room/Bowl", (0.45, 0.3, 0.7), (0.2, 0.2, 0.1)), None),
]


@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_reads_classes_masses_and_relations(home_tbox: TBox, profile: str) -> None:
    graph = build_graph(home_tbox, ROOM, profile=profile)
    bowl, cup, table = objects_of_graph(graph.triples, "room.ttl")
    assert (bowl.prim_path, cup.prim_path, table.prim_path) == ("/Room/Bowl", "/Room/Cup", "/Room/Table")
    assert (bowl.class_label, cup.class_label, table.class_label) == ("", "cup", "table")
    assert {Link("on", "/Room/Table"), Link("next-to", "/Room/Bowl")} <= cup.links
    assert Link("next-to", "/Room/Cup") in bowl.links, "both objects have a symmetric relation"
    assert {link.kind for link in table.links} <= {"room", "near", "next-to"}
    assert (table.mass_kg, cup.mass_kg) == (20.0, None)


@pytest.mark.parametrize(("profile", "annotations"), [("soma", "owl"), ("plain", "rdf12")])
def test_detects_the_style_of_a_graph(home_tbox: TBox, profile: str, annotations: str, tmp_path: Path) -> None:
    graph = build_graph(home_tbox, ROOM, profile=profile, options=GraphOptions(annotations=annotations))
    path = tmp_path / "room.ttl"
    write_graph(graph, path)
    statements = read_statements(path)
    assert frozenset(statements) == frozenset(graph.triples)
    assert detect_graph_style(statements) == (BASE, profile, annotations)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.ttl", None, r"a\.ttl: no such file; expected a graph"),
        ("a.ttl", "<x> <y", r"a\.ttl: does not parse as Turtle"),
        ("a.csv", "", r"a\.csv: the ending '\.csv' names no RDF format; expected one of \.ttl"),
    ],
)
def test_rejects_files_that_are_not_graphs(tmp_path: Path, name: str, text: str | None, message: str) -> None:
    if text is not None:
        (tmp_path / name).write_text(text)
    with pytest.raises(GraphError, match=message):
        read_statements(tmp_path / name)


def test_rejects_a_graph_without_objects() -> None:
    with pytest.raises(GraphError, match=r"room\.ttl: contains no object"):
        objects_of_graph([], "room.ttl")


def test_rejects_a_graph_of_two_scenes(home_tbox: TBox) -> None:
    bases = ("https://a.org/", "https://b.org/")
    triples = [triple for base in bases for triple in build_graph(home_tbox, ROOM, base=base).triples]
    with pytest.raises(GraphError, match="both have the prim path /Room/Bowl; expected the graph of one scene"):
        objects_of_graph(triples, "room.ttl")
