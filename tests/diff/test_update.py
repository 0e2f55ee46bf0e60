"""SPARQL updates that turn a store with the old graph exactly into one with the new graph."""

from collections.abc import Iterable
from dataclasses import replace

import pyoxigraph as ox
import pytest
import rdflib
from hypothesis import given, settings
from hypothesis import strategies as st
from rdflib.compare import isomorphic

from tests.graph.records import build_graph, thing
from tests.graph.test_joint_patterns import make_joint
from usd2kg.diff import make_update
from usd2kg.errors import GraphError
from usd2kg.graph import GraphOptions, KnowledgeGraph, merge_imports
from usd2kg.ontology import TBox, read_closure

NAMED = "https://my.lab/graphs/kitchen"
PREFIXES = "@prefix : <https://e.org/> . @prefix owl: <http://www.w3.org/2002/07/owl#> .\n"


def read(turtle: str) -> list[ox.Triple]:
    return [quad.triple for quad in ox.parse(PREFIXES + turtle, format=ox.RdfFormat.TURTLE)]


def canonical(triples: Iterable[ox.Triple]) -> ox.Dataset:
    # A store normalizes numbers, so both sides pass through one.
    store = ox.Store()
    store.extend(ox.Quad(*triple) for triple in triples)
    dataset = ox.Dataset(store)
    dataset.canonicalize(ox.CanonicalizationAlgorithm.RDFC_1_0)
    return dataset


def apply(old: Iterable[ox.Triple], update: str, graph: str | None = None) -> list[ox.Triple]:
    place = ox.NamedNode(graph) if graph else ox.DefaultGraph()
    store = ox.Store()
    store.extend(ox.Quad(*triple, place) for triple in old)
    store.update(update)
    assert all(quad.graph_name == place for quad in store)
    return [quad.triple for quad in store]


def check_update(old: Iterable[ox.Triple], new: Iterable[ox.Triple], graph: str | None = None) -> str:
    """Check that the update gives the new graph, and return its text."""
    old, new = list(old), list(new)
    update = make_update(old, new, graph)
    assert canonical(apply(old, update.text, graph)) == canonical(new)
    return update.text


def room(home_tbox: TBox, *, changed: bool, **options: object) -> KnowledgeGraph:
    table = thing("/Room/Table", (0, 0, 0), (2, 1, 0.7), mass_kg=20.0)
    cup = thing("/Room/Cup", (0.3, 0.3, 0.7), (0.1, 0.1, 0.1), mass_kg=0.2, display_color=(1.0, 0.0, 0.0))
    mug = replace(cup, prim_path="/Room/Mug", name="Mug") if changed else cup
    plate = thing("/Room/Plate", (1.0, 0.3, 0.8 if changed else 0.7), (0.2, 0.2, 0.02))
    hinge = make_joint(prim_path="/Room/Table/hinge", body0=None, body1="/Room/Table")
    placed = [(table, "Table"), (mug, "Cup"), (plate, "DinnerPlate" if changed else "Plate")]
    return build_graph(home_tbox, placed, joints=[hinge], **options)


@pytest.mark.parametrize("graph", [None, NAMED])
@pytest.mark.parametrize("annotations", ["owl", "rdf12"])
@pytest.mark.parametrize("profile", ["soma", "plain"])
def test_updates_graphs_of_all_styles(home_tbox: TBox, profile: str, annotations: str, graph: str | None) -> None:
    options = {"profile": profile, "options": GraphOptions(annotations=annotations)}
    old, new = (room(home_tbox, changed=changed, **options).triples for changed in (False, True))
    text = check_update(old, new, graph)
    assert "Room.Mug" in text
    assert "Room.Table-shape" not in text, "unchanged objects are not part of the update"
    check_update(new, old, graph)


def test_updates_class_expressions_of_merged_ontologies(home_tbox: TBox) -> None:
    old, new = (room(home_tbox, changed=changed) for changed in (False, True))
    merged = merge_imports(new, read_closure(home_tbox, new.imports))
    check_update(old.triples, merged.triples)
    check_update(merged.triples, old.triples)


def test_update_of_isomorphic_graphs_is_empty(home_tbox: TBox) -> None:
    old = room(home_tbox, changed=False).triples
    renamed = ox.parse(
        ox.serialize(old, format=ox.RdfFormat.N_TRIPLES), format=ox.RdfFormat.N_TRIPLES, rename_blank_nodes=True
    )
    update = make_update(old, [quad.triple for quad in renamed])
    assert (update.text, update.deleted, update.inserted) == ("", 0, 0)


def test_rdflib_applies_the_update(home_tbox: TBox, monkeypatch: pytest.MonkeyPatch) -> None:
    """rdflib compares literals by lexical form here, so the update must quote them exactly."""
    monkeypatch.setattr(rdflib, "NORMALIZE_LITERALS", False)
    old, new = (room(home_tbox, changed=changed).triples for changed in (False, True))
    graph, wanted = (
        rdflib.Graph().parse(data=ox.serialize(triples, format=ox.RdfFormat.N_TRIPLES).decode(), format="nt")
        for triples in (old, new)
    )
    graph.update(make_update(old, new).text)
    assert isomorphic(graph, wanted)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        pytest.param(
            ":a :p 0.30, 01 . :b :q 'x\\n\\\\ \"y\"'@en .", ":a :p 0.3, 1 . :b :q 'x \\\\u0041'@en-GB .", id="literals"
        ),
        pytest.param(":a :p [ :q 1 ], [ :q 1 ] .", ":a :p [ :q 1 ] .", id="isomorphic nodes, one removed"),
        pytest.param(":a :p [ :q 1 ] .", ":a :p [ :q 1 ], [ :q 1 ] .", id="isomorphic nodes, one added"),
        pytest.param(":a :p [ :q 1 ], [ :q 1 ; :r 2 ] .", ":a :p [ :q 1 ; :r 2 ] .", id="part of a larger structure"),
        pytest.param(
            "_:s :p _:a, _:b . _:a :q 1 . _:b :q 1 . _:t :p _:c . _:c :q 1 .",
            "_:t :p _:c . _:c :q 1 .",
            id="two nodes in place of one",
        ),
        pytest.param(":a :p ( :x :y :z ) .", ":a :p ( :x :z ) .", id="list"),
        pytest.param("_:x :p _:y . _:y :p _:x .", "_:x :p _:y . _:y :p _:z . _:z :p _:x .", id="cycles"),
        pytest.param("_:x :p _:x .", ":x :p _:x .", id="node related to itself"),
        pytest.param(
            "[] a owl:Axiom ; owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ; :c 0.5 ."
            "[] a owl:Axiom ; owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ; :c 0.6 .",
            "[] a owl:Axiom ; owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ; :c 0.6 .",
            id="one of two annotations",
        ),
        pytest.param(
            "[] a owl:Axiom ; owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ; :c 5 ."
            "_:x owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ; :c [ :d 1 ].",
            "_:x owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ; :c [ :d 1 ].",
            id="annotation next to a structure",
        ),
        pytest.param(
            ":a :p [ owl:annotatedSource :a ; owl:annotatedProperty :p ; owl:annotatedTarget 1 ] .",
            "",
            id="removal",
        ),
        pytest.param("", ":a :p [ :q ( 1 2 ) ] .", id="addition"),
    ],
)
def test_finds_structures_of_blank_nodes_exactly(old: str, new: str) -> None:
    for graph in (None, NAMED):
        check_update(read(old), read(new), graph)
        check_update(read(new), read(old), graph)


NODES = [ox.NamedNode("https://e.org/a"), *(ox.BlankNode(name) for name in "vwxyz")]
PROPERTIES = [ox.NamedNode(f"https://e.org/{name}") for name in ("p", "q")]
TRIPLES = st.builds(
    ox.Triple,
    st.sampled_from(NODES),
    st.sampled_from(PROPERTIES),
    st.sampled_from([*NODES, ox.Literal("1"), ox.Literal(2)]),
)


@settings(max_examples=150, deadline=None)
@given(old=st.lists(TRIPLES, max_size=8), new=st.lists(TRIPLES, max_size=8))
def test_updates_any_graph_to_any_other(old: list[ox.Triple], new: list[ox.Triple]) -> None:
    check_update(old, new)


def test_splits_a_large_update_into_operations() -> None:
    name = ox.NamedNode("https://e.org/p")
    old = [ox.Triple(ox.NamedNode(f"https://e.org/{i}"), name, ox.Literal(i)) for i in range(12_000)]
    text = check_update(old, [])
    assert text.count("DELETE DATA") == 3


def test_rejects_a_graph_name_that_is_not_an_iri() -> None:
    with pytest.raises(GraphError, match="'my graph' is not an absolute IRI"):
        make_update([], [], "my graph")
