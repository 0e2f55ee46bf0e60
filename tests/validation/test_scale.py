"""Validation of many objects takes seconds."""

import time

import pyoxigraph as ox
import pytest

from tests.graph.records import BASE
from usd2kg.graph.vocabulary import DUL, OWL, RDF, RDFS, SOMA, U2K, USD, number, text
from usd2kg.ontology import Closure
from usd2kg.query import Dataset, GraphStore
from usd2kg.validation import validate_graph
from usd2kg.validation.shacl import compile_shapes, find_violations

SECONDS_PER_OBJECT = 30.0 / 20_000
"""Limit of processor time: about three times the usual."""
counts = pytest.mark.parametrize("count", [3_000, pytest.param(20_000, marks=pytest.mark.slow)])


def crowd(count: int, same_place: bool) -> GraphStore:
    """Return a graph in the plain profile: cups in rows on one table, or all at the same position."""
    quads = []
    table = ox.NamedNode(BASE + "Table")
    for i in range(count):
        node = ox.NamedNode(f"{BASE}Cup{i}")
        x, y = (0, 0) if same_place else (i % 200, i // 200)
        statements = [
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
        quads.extend(ox.Quad(node, name, value) for name, value in statements)
    quads.extend(
        ox.Quad(table, name, value)
        for name, value in ((RDF.type, SOMA.Table), (U2K.primPath, text("/Table")), (RDFS.label, text("Table")))
    )
    store = ox.Store()
    store.bulk_extend(quads)
    return GraphStore(Dataset(store), "crowd.ttl")


@counts
@pytest.mark.parametrize("same_place", [False, True])
def test_validates_many_objects(same_place: bool, count: int):
    graph = crowd(count, same_place)
    axioms = tuple(ox.Triple(cls, RDF.type, OWL.Class) for cls in (SOMA.Cup, SOMA.Table))
    start = time.process_time()
    report = validate_graph(graph, Closure(axioms, (), ()))
    assert time.process_time() - start < SECONDS_PER_OBJECT * count
    assert len(report.findings) == (count - 1 if same_place else 1)
    assert report.findings[0].rule == "box-width"


@counts
def test_checks_qualified_shapes_of_many_objects(count: int):
    quads = []
    for i in range(count):
        cup, shape, box = (ox.NamedNode(f"{BASE}Cup{i}{part}") for part in ("", "-shape", "-box"))
        quads += [
            ox.Quad(cup, RDF.type, USD.Prim),
            ox.Quad(cup, RDF.type, SOMA.Cup),
            ox.Quad(cup, U2K.primPath, text(f"/Cup{i}")),
            ox.Quad(cup, RDFS.label, text(f"Cup{i}")),
            ox.Quad(cup, SOMA.hasShape, shape),
            ox.Quad(shape, RDF.type, SOMA.Shape),
            ox.Quad(shape, DUL.hasRegion, box),
            ox.Quad(box, RDF.type, SOMA.MeshShape if i == 7 else SOMA.BoxShape),
        ]
    store = ox.Store()
    store.bulk_extend(quads)
    rule = next(rule for rule in compile_shapes("soma") if rule.id == "box-missing")
    start = time.process_time()
    broken = list(find_violations(store, rule))
    assert time.process_time() - start < SECONDS_PER_OBJECT * count
    assert [found.focus.value for found in broken] == [f"{BASE}Cup7"]
