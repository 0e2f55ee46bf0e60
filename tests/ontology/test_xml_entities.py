"""Limits on the expansion of XML entities."""

import pytest

from usd2kg.errors import GraphError, OntologyError
from usd2kg.graph.rdf_document import read_document, read_statements
from usd2kg.ontology import load_tbox
from usd2kg.ontology.xml_entities import refuse_entity_bomb
from usd2kg.query import load_graph

OWL = 'xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:owl="http://www.w3.org/2002/07/owl#"'
LAUGHS = '<!ENTITY a "' + "x" * 100 + '">' + "".join(f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in ("ab", "bc", "cd"))


def document(entities: str, content: str = "x", root: str = "rdf:RDF") -> str:
    return f'<?xml version="1.0"?><!DOCTYPE r [{entities}]><{root} {OWL}><!-- {content} --></{root}>'


@pytest.mark.parametrize(
    "entities",
    [
        "",
        '<!ENTITY owl "http://www.w3.org/2002/07/owl#"><!ENTITY iof "http://iof.example/">',
        '<!ENTITY base "http://iof.example/"><!ENTITY core "&base;Core/"><!ENTITY part "&core;Part">',
        '<!ENTITY a "x"><!ENTITY b "&a;"><!ENTITY c "&b;"><!ENTITY d "&c;"><!ENTITY e "&d;">',
        f'<!ENTITY a "{"x" * 1000}"><!ENTITY b "{"&a;" * 9}">',
    ],
)
def test_accepts_namespace_entities(entities):
    refuse_entity_bomb(document(entities))
    with pytest.raises(SyntaxError, match="expands to more than 10,000"):
        refuse_entity_bomb(document(entities + LAUGHS.replace("ENTITY ", "ENTITY laughs-").replace("&", "&laughs-")))


@pytest.mark.parametrize(
    ("entities", "reason"),
    [
        (LAUGHS, "'d' expands to more than 10,000"),
        ("<!-- <!ENTITY x ' -->" + LAUGHS, "'x' expands to more than 10,000"),
        (LAUGHS.replace('"', "'"), "'d' expands to more than 10,000"),
        (LAUGHS.replace("&", "&#38;"), "'d' expands to more than 10,000"),
        (LAUGHS.replace("ENTITY ", "ENTITY%"), "'d' expands to more than 10,000"),
        (f'<!ENTITY a "{"x" * 10_001}">', "'a' expands to more than 10,000"),
        ('<!ENTITY a "x"><!ENTITY a "&a;&a;">', "more than 5 deep"),
        ('<!ENTITY a "&b;"><!ENTITY b "&a;">', "more than 5 deep"),
        ('<!ENTITY a "x">' + "".join(f'<!ENTITY {b} "&{a};">' for a, b in ("ab", "bc", "cd", "de", "ef")), "5 deep"),
    ],
)
def test_rejects_expanding_entities(entities, reason):
    with pytest.raises(SyntaxError, match=reason):
        refuse_entity_bomb(document(entities))


def test_rejects_many_references_to_a_long_entity():
    # 1,000 × 9,000 = 9 million characters from 13,000.
    with pytest.raises(SyntaxError, match="expand to 9,000,000 characters"):
        refuse_entity_bomb(document(f'<!ENTITY a "{"x" * 9000}">', "&a;" * 1000))


@pytest.mark.parametrize("root", ["rdf:RDF", "Ontology"])
def test_rejects_an_ontology_before_parsing(tmp_path, root):
    path = tmp_path / "laughs.owl"
    path.write_text(document(LAUGHS, root=root), encoding="utf-8")
    with pytest.raises(OntologyError, match=r"laughs\.owl.*expands to more than 10,000 characters"):
        load_tbox(path)


@pytest.mark.parametrize("read", [load_graph, read_document, read_statements])
def test_rejects_a_graph_before_parsing(tmp_path, read):
    path = tmp_path / "laughs.rdf"
    # The declarations span the end of the first chunk.
    start = '<?xml version="1.0"?><!--'
    path.write_text(start + " " * (2**20 - len(start) - 20) + "-->" + document(LAUGHS)[21:], encoding="utf-8")
    with pytest.raises(GraphError, match=r"laughs\.rdf.*expands to more than 10,000 characters"):
        read(path)


def test_reads_a_graph_with_namespace_entities(tmp_path):
    path = tmp_path / "flat.rdf"
    about = (
        f'<rdf:RDF {OWL}><rdf:Description rdf:about="&b;C"><rdf:type rdf:resource="&b;D"/></rdf:Description></rdf:RDF>'
    )
    path.write_text(f'<!DOCTYPE r [<!ENTITY b "http://b.example/">]>{about}', encoding="utf-8")
    (triple,) = read_document(path).triples
    assert (triple.subject.value, triple.object.value) == ("http://b.example/C", "http://b.example/D")
