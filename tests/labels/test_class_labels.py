"""What labels say of a class."""

import pytest

from usd2kg.errors import OutputError
from usd2kg.labels import label_maker
from usd2kg.ontology import load_tbox

TEXT = """
@prefix : <http://x.example/lab#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
:Mug rdfs:subClassOf :Cup, :Gift ; rdfs:label "coffee Mug" ; skos:exactMatch <http://www.wikidata.org/entity/Q23498> ;
    rdfs:comment "For coffee." ; skos:altLabel "beaker" .
:Cup rdfs:subClassOf :Vessel . :Gift rdfs:subClassOf :Thing . :Vessel rdfs:subClassOf :Thing .
"""


@pytest.fixture
def tbox(tmp_path):
    path = tmp_path / "lab.ttl"
    path.write_text(TEXT)
    return load_tbox(path)


@pytest.mark.parametrize(("naming", "token"), [("local", "Mug"), ("label", "coffee Mug"), ("snake", "coffee_mug")])
def test_namings(tbox, naming, token):
    assert label_maker(tbox, naming)("http://x.example/lab#Mug").token == token


def test_all_that_is_said(tbox):
    said = label_maker(tbox, has_ancestors=True)("http://x.example/lab#Mug")
    assert said.above == ("Thing", "Gift", "Vessel", "Cup")  # by depth, the most general first, each once
    assert said.qcodes == ("Q23498",)
    assert (said.namespace, said.concept, said.definition) == ("http://x.example/lab#", "Mug", "For coffee.")
    assert said.names == {"coffee Mug", "beaker"}
    assert label_maker(tbox)("http://x.example/lab#Mug").above == ()


def test_an_unknown_naming(tbox):
    with pytest.raises(OutputError, match="expected one of local, label, snake"):
        label_maker(tbox, "camel")
