"""FROM and FROM NAMED in queries."""

import pyoxigraph as ox
import pytest

from usd2kg.query.dataset import Dataset
from usd2kg.query.dataset_clause import graphs_named, names_dataset
from usd2kg.query.graph_store import GraphStore

A, B = ox.NamedNode("urn:a"), ox.NamedNode("urn:b")
LABEL = ox.NamedNode("http://www.w3.org/2000/01/rdf-schema#label")


@pytest.fixture
def store() -> ox.Store:
    """One label in each of two graphs, and one in the default graph."""
    made = ox.Store()
    for name, graph in (("first", A), ("second", B), ("none", ox.DefaultGraph())):
        made.add(ox.Quad(ox.NamedNode(f"urn:{name}"), LABEL, ox.Literal(name), graph))
    return made


def labels(graph: GraphStore, clause: str, pattern: str = "?s rdfs:label ?l") -> list[str | None]:
    return [row[0] for row in graph.sparql(f"SELECT ?l {clause} WHERE {{ {pattern} }} ORDER BY ?l").rows]


@pytest.mark.parametrize("graphs", [None, (A,), (A, B)])
def test_from_chooses_the_graphs(store: ox.Store, graphs: tuple[ox.NamedNode, ...] | None):
    graph = GraphStore(Dataset(store, graphs), "store")
    assert labels(graph, "FROM <urn:b>") == ["second"]
    assert labels(graph, "FROM <urn:a> FROM <urn:b>") == ["first", "second"]
    named = "GRAPH ?g { ?s rdfs:label ?l }"
    assert labels(graph, "FROM NAMED <urn:b>", named) == ["second"]
    # By section 13.2, the default graph is then empty.
    assert labels(graph, "FROM NAMED <urn:b>") == []


def test_without_a_clause_the_union_is_queried(store: ox.Store):
    assert labels(GraphStore(Dataset(store), "store"), "") == ["first", "none", "second"]
    assert labels(GraphStore(Dataset(store, (A,)), "store"), "") == ["first"]


@pytest.mark.parametrize(
    "query",
    [
        "SELECT * FROM <urn:a> { ?s ?p ?o }",
        "select * from named<urn:a> { graph ?g { ?s ?p ?o } }",
        "PREFIX x: <http://x/#> SELECT (STRLEN(?l) < 3 AS ?short) FROM x:a { ?s ?p ?l }",
        "ASK # in a comment\nFROM # and one more\n<urn:a> { ?s ?p ?o }",
    ],
)
def test_finds_the_clause(query: str):
    assert names_dataset(query)


@pytest.mark.parametrize(
    "query",
    [
        "SELECT ?from { ?from ?p ?o }",
        "SELECT * { ?s u2k:from ?o ; rdfs:label 'x'@from }",
        "PREFIX from: <urn:> SELECT * { ?s from:from ?o }",
        'SELECT * { ?s rdfs:label \'FROM <urn:a>\' , """it\'s FROM <urn:a>""" } # FROM <urn:a>',
        "SELECT * { <http://x/?from=FROM> ?p ?o }",
    ],
)
def test_other_uses_of_the_word_are_no_clause(query: str):
    assert not names_dataset(query)


def test_an_unknown_graph_is_reported(store: ox.Store):
    query = "SELECT * FROM <urn:c> FROM NAMED <urn:a> { ?s ?p ?o }"
    assert graphs_named(query) == ["urn:c", "urn:a"]
    assert GraphStore(Dataset(store), "store").hints(query) == ["FROM <urn:c>: there is no such graph"]
    assert GraphStore(Dataset(ox.Store()), "file").hints("SELECT * FROM <urn:c> { ?s ?p ?o }") == [
        "FROM <urn:c>: there is no such graph; a file that names no graphs is queried without FROM"
    ]
