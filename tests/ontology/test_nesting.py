"""Small documents that are nested deeply or in circles end as one error, or are read; none ends the process."""

import io
from time import process_time

import pytest

from tests.ontology.conftest import PREFIXES
from usd2kg.errors import OntologyError
from usd2kg.ontology import load_tbox
from usd2kg.ontology.limits import NESTING
from usd2kg.ontology.nesting import refuse_deep_nesting, refuse_deep_nesting_in_file

OFN = "Prefix(:=<http://x#>)\nOntology(<http://x>\nSubClassOf(:A {})\n)"
OMN = "Prefix: : <http://x#>\nOntology: <http://x>\nObjectProperty: :p\nClass: :A\n  SubClassOf: {}\n"
OWX = (
    '<Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="http://x"><SubClassOf><Class IRI="http://x#A"/>{}'
    "</SubClassOf></Ontology>"
)
RDF = '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:x="http://x#">{}</rdf:RDF>'


def nested(template: str, start: str, core: str, end: str, depth: int) -> str:
    """Return a document with `core` inside `depth` pairs of `start` and `end`."""
    return template.format(start * depth + core + end * depth)


DOCUMENTS = {
    "Manchester parentheses": (nested(OMN, "(", ":B", ")", 2_000), "line 5: class expressions"),
    "Manchester restrictions": (nested(OMN, ":p some ", ":B", "", 20_000), "line 5: class expressions"),
    "functional intersections": (
        nested(OFN, "ObjectIntersectionOf(:B ", ":C", ")", 20_000),
        "line 3: class expressions",
    ),
    "functional complements": (nested(OFN, "ObjectComplementOf(", ":C", ")", 20_000), "line 3: class expressions"),
    "OWL/XML complements": (
        nested(OWX, "<ObjectComplementOf>", '<Class IRI="http://x#C"/>', "</ObjectComplementOf>", 20_000),
        "line 1: elements",
    ),
    "RDF/XML": (nested(RDF, "<x:a><x:b>", "", "</x:b></x:a>", 50_000), "line 1: elements"),
    "JSON-LD": ('{"@id":"http://x","http://x/p":' * 10_000 + "1" + "}" * 10_000, "line 1: objects"),
    "triple terms": (PREFIXES + ":A :p " + "<<( :a :b " * 20_000 + ":c" + " )>>" * 20_000 + " .", "triple terms"),
}


@pytest.mark.parametrize("case", DOCUMENTS)
def test_deep_document_is_one_error(tmp_path, case):
    document, expected = DOCUMENTS[case]
    path = tmp_path / "deep.owl"
    path.write_text(document, encoding="utf-8")
    start = process_time()
    with pytest.raises(OntologyError) as caught:
        load_tbox(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: looks like ")
    assert f"{expected} are nested more than" in message
    assert "expected at most" in message
    assert "\n" not in message
    assert process_time() - start < 3


@pytest.mark.parametrize(
    "document",
    [
        nested(OMN, "(", ":B", ")", 200),
        nested(OMN, ":B, " + ":p some " * 200, ":B", "", 1),
        OMN.format(":B, " + " and ".join([":p some :B"] * 1_000)),
        nested(OFN, "ObjectIntersectionOf(:B ", ":C", ")", 200),
        OFN.format(':B)\nAnnotationAssertion(:note :A "' + "(" * 5_000 + '")\nSubClassOf(:A <http://x#((>'),
        nested(RDF, "<x:a><x:b>", "", "</x:b></x:a>", 2_000).replace("<x:a>", "<x:a rdf:about='http://x#A'>", 1),
        PREFIXES + ":A rdfs:subClassOf :B . " + ":A :p <<( :a :b :c )>> . " * 5_000,
    ],
)
def test_wide_document_is_read(tmp_path, document):
    path = tmp_path / "wide.owl"
    path.write_text(document, encoding="utf-8")
    if document.startswith("<rdf"):
        with pytest.raises(OntologyError, match="no class in scope"):
            load_tbox(path)
    else:
        assert {cls.local_name for cls in load_tbox(path).classes} >= {"A", "B"}


@pytest.mark.parametrize("chunk", [1, 7, 1 << 20])
@pytest.mark.parametrize(
    ("syntax", "start", "end", "limit"),
    [
        ("jsonld", b'{"\\\\": "\\"{", "p":', b"}", NESTING.json_levels),
        ("ttl", b"<<( _:a :p ", b" )>>", NESTING.term_levels),
    ],
)
def test_chunks_of_a_file_are_one_document(monkeypatch, chunk, syntax, start, end, limit):
    monkeypatch.setattr("usd2kg.ontology.nesting._CHUNK", chunk)
    refuse_deep_nesting_in_file(io.BytesIO(start * limit + b"1" + end * limit), syntax)
    with pytest.raises(SyntaxError):
        refuse_deep_nesting_in_file(io.BytesIO(start * (limit + 1) + b"1" + end * (limit + 1)), syntax)


def test_unclosed_text_is_scanned_in_linear_time():
    start = process_time()
    refuse_deep_nesting('"' + '\\"' * 500_000, "ofn")
    assert process_time() - start < 1


HEADER = "<http://x> a owl:Ontology . :A a owl:Class . :C a owl:Class ; rdfs:subClassOf :A . "


@pytest.mark.parametrize(
    "statements",
    [
        ":C owl:equivalentClass _:b . _:b owl:intersectionOf ( :A _:b ) .",
        ":C owl:equivalentClass _:b . _:b owl:intersectionOf _:l . _:l rdf:first :A ; rdf:rest _:l .",
        ":C owl:equivalentClass _:b0 . "
        + " ".join(f"_:b{i} owl:intersectionOf ( :A _:b{i + 1} ) ." for i in range(1_000)),
        "<http://x> owl:imports <<( :a :b :c )>> , [] , 'text' .",
        "<http://x> owl:versionIRI <<( :a :b :c )>> , [] , 'text' .",
        ":C rdfs:label <<( :a :b :c )>> , [] .",
        ":C rdfs:subClassOf <<( :a :b :c )>> , 'text' ; owl:equivalentClass <<( :a :b :c )>> .",
    ],
)
def test_nodes_of_an_unexpected_kind_are_left_out(load, statements):
    rdf = "@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .\n"
    tbox = load(rdf + HEADER + statements)
    assert {cls.local_name for cls in tbox.classes} == {"A", "C"}
    assert tbox.by_iri["http://example.com/home#C"].parents == ("http://example.com/home#A",)


def test_long_chain_of_equivalences_is_one_class(load):
    start = process_time()
    tbox = load(":E0 rdfs:subClassOf :A . " + " ".join(f":E{i} owl:equivalentClass :E{i + 1} ." for i in range(5_000)))
    assert process_time() - start < 5
    assert [len(cls.equivalents) for cls in tbox.classes] == [0, 5_000]


def test_many_classes_in_one_equivalence_axiom(tmp_path):
    path = tmp_path / "same.ofn"
    names = " ".join(f":E{i}" for i in range(5_000))
    path.write_text(OFN.format(f":B)\nSubClassOf(:E0 :A)\nEquivalentClasses({names}"), encoding="utf-8")
    start = process_time()
    assert [len(cls.equivalents) for cls in load_tbox(path).classes] == [0, 0, 4_999]
    assert process_time() - start < 5
