"""Mappings of classes to Wikidata items."""

import pytest

from usd2kg.ontology import load_home_tbox, load_tbox

CUP = "http://example.com/home#Cup"
WD = "http://www.wikidata.org/entity/"


def items(load, text):
    return load(f":Cup rdfs:subClassOf :Crockery . {text}").by_iri[CUP].wikidata


@pytest.mark.parametrize(
    "text",
    [
        f":Cup skos:exactMatch <{WD}Q81727> .",
        ":Cup skos:exactMatch <https://www.wikidata.org/wiki/Q81727> .",
        f":Cup owl:equivalentClass <{WD}Q81727> .",
        f":Cup rdfs:seeAlso <{WD}Q81727> .",
        f':Cup rdfs:seeAlso "{WD}Q81727" .',
        ':Cup <http://www.geneontology.org/formats/oboInOwl#hasDbXref> "WIKIDATA:Q81727" .',
        f":Cup <http://purl.org/dc/terms/source> <{WD}Q81727> .",
        f":Mug owl:equivalentClass :Cup . :Mug skos:exactMatch <{WD}Q81727> .",
    ],
)
def test_reads_all_mapping_properties(load, text):
    assert items(load, text) == ("Q81727",)


def test_strongest_mapping_property_wins(load):
    text = f":Cup rdfs:seeAlso <{WD}Q5> ; skos:exactMatch <{WD}Q811>, <{WD}Q81> ; skos:closeMatch <{WD}Q7> ."
    assert items(load, text) == ("Q81", "Q811")


@pytest.mark.parametrize(
    "text",
    [
        f":Cup skos:broadMatch <{WD}Q81727> .",
        f":Cup rdfs:subClassOf <{WD}Q81727> .",
        f":Cup owl:disjointWith <{WD}Q81727> .",
        f':Cup rdfs:label "{WD}Q81727" .',
        f':Cup rdfs:comment "see {WD}Q81727" .',
        ":Cup rdfs:seeAlso <http://www.wikidata.org/entity/P31>, <http://evil.example/wikidata.org/entity/Q1> .",
        "",
    ],
)
def test_ignores_other_statements(load, text):
    assert items(load, text) == ()


def test_mappings_of_functional_syntax(tmp_path):
    path = tmp_path / "onto.owl"
    path.write_text(
        "Prefix(:=<http://example.com/home#>)\nPrefix(skos:=<http://www.w3.org/2004/02/skos/core#>)\n"
        "Ontology(<http://example.com/home>\nDeclaration(Class(:Cup))\nDeclaration(Class(:Crockery))\n"
        f"SubClassOf(:Cup :Crockery)\nAnnotationAssertion(skos:exactMatch :Cup <{WD}Q81727>)\n)\n"
    )
    assert load_tbox(path).by_iri[CUP].wikidata == ("Q81727",)


def test_home_tbox_has_no_mappings():
    assert not any(cls.wikidata for cls in load_home_tbox().classes)
