"""Packed triples give back what was packed, in order, and are written as the same bytes as unpacked ones."""

import pyoxigraph as ox
import pytest

from usd2kg.graph import packed_triples, serialize_graph
from usd2kg.graph.packed_triples import PackedTriples, subject_chunks
from usd2kg.graph.rdf_document import GraphDocument, GraphPart
from usd2kg.graph.vocabulary import RDFS, U2K, XSD, text

BASE = "https://my.lab/k/"
PREFIXES = {"": BASE, "rdfs": RDFS.iri, "xsd": XSD.iri}
CUP = ox.NamedNode(BASE + "Cup")
AXIOM = ox.BlankNode("axiom0a1b")
STATED = (
    ox.Triple(CUP, RDFS.label, text('a "cup"\nof tea \\ \u00e9')),
    ox.Triple(CUP, RDFS.label, ox.Literal("Tasse", language="de")),
    ox.Triple(CUP, U2K.mass, ox.Literal("0.250", datatype=XSD.double)),
    ox.Triple(CUP, U2K.copies, ox.Literal("007", datatype=XSD.integer)),
    ox.Triple(AXIOM, U2K.run, ox.NamedNode(BASE + "World.Books%5B7%5D-shape")),
    ox.Triple(AXIOM, U2K.run, ox.Triple(CUP, RDFS.seeAlso, AXIOM)),
    ox.Triple(CUP, U2K.run, AXIOM),
)


@pytest.fixture(params=[1, 3, 20_000])
def packed(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> PackedTriples:
    monkeypatch.setattr(packed_triples, "_CHUNK", request.param)
    return PackedTriples(iter(STATED), PREFIXES)


def test_iteration_gives_back_the_triples_in_order(packed: PackedTriples) -> None:
    assert tuple(packed) == STATED
    assert tuple(packed) == STATED, "a second iteration begins anew"


def test_it_is_a_sequence(packed: PackedTriples) -> None:
    assert len(packed) == len(STATED)
    assert packed[2] == STATED[2]
    assert packed[-2:] == STATED[-2:]
    assert STATED[4] in packed
    assert ox.Triple(CUP, RDFS.label, text("mug")) not in packed


def test_the_size_of_the_chunks_does_not_change_the_turtle(packed: PackedTriples) -> None:
    unpacked = GraphDocument((GraphPart("", STATED),), PREFIXES, "test")
    document = GraphDocument((GraphPart("", packed),), PREFIXES, "test")
    for syntax in (ox.RdfFormat.TURTLE, ox.RdfFormat.TRIG, ox.RdfFormat.N_TRIPLES):
        assert serialize_graph(document, syntax) == serialize_graph(unpacked, syntax)


def test_other_prefixes_than_those_of_the_packing_are_used_in_files(packed: PackedTriples) -> None:
    written = serialize_graph(GraphDocument((GraphPart("", packed),), {"k": BASE}, "test"), ox.RdfFormat.TURTLE)
    assert b"k:Cup " in written
    assert [quad.triple for quad in ox.parse(written, format=ox.RdfFormat.TURTLE)] == list(STATED)


def test_sums_hold_both_in_order() -> None:
    first, second = PackedTriples(STATED[:4], PREFIXES), PackedTriples(STATED[4:], PREFIXES)
    assert tuple(first + second) == STATED
    assert len(first + second) == len(STATED)
    assert (first + second).prefixes == PREFIXES


def test_equal_triples_with_equal_prefixes_are_equal() -> None:
    packed = PackedTriples(STATED, PREFIXES)
    assert packed == PackedTriples(STATED, PREFIXES)
    assert packed != PackedTriples(STATED[:-1], PREFIXES)
    assert packed != PackedTriples(STATED, {"k": BASE})


def test_chunks_end_where_the_subject_changes() -> None:
    assert [len(chunk) for chunk in subject_chunks(STATED, 2)] == [4, 2, 1]
    assert [len(chunk) for chunk in subject_chunks(STATED, 5)] == [6, 1]
    assert list(subject_chunks((), 5)) == []
