"""Twenty thousand objects are checked in seconds, and each broken one of them is found."""

import time

import pyoxigraph as ox
import pytest

from tests.graph.records import BASE
from usd2kg.graph import GraphStore
from usd2kg.graph.validation import validate_graph
from usd2kg.graph.vocabulary import OWL, RDF, RDFS, SOMA, U2K, number, text
from usd2kg.ontology import Closure

COUNT = 20_000
SECONDS = 30.0
"""Three is usual; a quadratic step takes minutes."""


def crowd(same_place: bool) -> GraphStore:
    """Return a plain graph of cups in rows, on one table; or all in one place."""
    quads = []
    table = ox.NamedNode(BASE + "Table")
    for i in range(COUNT):
        node = ox.NamedNode(f"{BASE}Cup{i}")
        x, y = (0, 0) if same_place else (i % 200, i // 200)
        said = [
            (RDF.type, OWL.NamedIndividual),
            (RDF.type, U2K.Object),
            (RDF.type, SOMA.Cup),
            (RDFS.label, text(f"Cup{i}")),
            (U2K.primPath, text(f"/Cup{i}")),
            (U2K.width, number(-0.1 if i == 7 else 0.1)),
            (U2K.depth, number(0.1)),
            (U2K.height, number(0.1)),
            (U2K.boxCenter, text(f"{x} {y} 0.05")),
            *([(U2K.on, table)] if i % 2 else []),
        ]
        quads.extend(ox.Quad(node, name, value) for name, value in said)
    quads.extend(
        ox.Quad(table, name, value)
        for name, value in ((RDF.type, SOMA.Table), (U2K.primPath, text("/Table")), (RDFS.label, text("Table")))
    )
    store = ox.Store()
    store.bulk_extend(quads)
    return GraphStore(store, "crowd.ttl")


@pytest.mark.parametrize(("same_place", "count"), [(False, 1), (True, COUNT - 1)])
def test_twenty_thousand_objects(same_place: bool, count: int):
    graph = crowd(same_place)
    axioms = tuple(ox.Triple(cls, RDF.type, OWL.Class) for cls in (SOMA.Cup, SOMA.Table))
    start = time.perf_counter()
    report = validate_graph(graph, Closure(axioms, (), ()))
    assert time.perf_counter() - start < SECONDS
    assert len(report.findings) == count
    assert report.findings[0].rule == "box-width"
