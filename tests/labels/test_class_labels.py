"""Labels of classes."""

import pytest

from usd2kg.errors import OutputError
from usd2kg.labels import label_maker
from usd2kg.ontology import load_tbox

MUG = "http://x.example/lab#Mug"
ONTOLOGY = """
@prefix : <http://x.example/lab#> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
:Mug rdfs:subClassOf :Cup, :Gift ; rdfs:label "coffee Mug" ; skos:exactMatch <http://www.wikidata.org/entity/Q23498> ;
    rdfs:comment "For coffee." ; skos:altLabel "beaker" .
:Cup rdfs:subClassOf :Vessel . :Gift rdfs:subClassOf :Thing . :Vessel rdfs:subClassOf :Thing .
"""


@pytest.fixture
def tbox(tmp_path):
    path = tmp_path / "lab.ttl"
    path.write_text(ONTOLOGY)
    return load_tbox(path)


@pytest.mark.parametrize(("style", "token"), [("local", "Mug"), ("label", "coffee Mug"), ("snake", "coffee_mug")])
def test_token_has_the_chosen_style(tbox, style, token):
    assert label_maker(tbox, style)(MUG).token == token


def test_label_has_ancestors_wikidata_items_and_names(tbox):
    label = label_maker(tbox, has_ancestors=True)(MUG)
    assert label.ancestors == ("Thing", "Gift", "Vessel", "Cup"), "by depth, most general first, each once"
    assert label.qcodes == ("Q23498",)
    assert (label.namespace, label.local_name, label.definition) == ("http://x.example/lab#", "Mug", "For coffee.")
    assert label.names == {"coffee Mug", "beaker"}
    assert label_maker(tbox)(MUG).ancestors == ()


def test_rejects_an_unknown_style(tbox):
    with pytest.raises(OutputError, match="expected one of local, label, snake"):
        label_maker(tbox, "camel")
