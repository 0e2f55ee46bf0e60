"""The classes in scope and their parents."""

import pytest

from tests.conftest import shared_file
from usd2kg.errors import OntologyError
from usd2kg.ontology import load_tbox

TREE = """
dul:DesignedArtifact rdfs:subClassOf dul:PhysicalObject .
:Crockery rdfs:subClassOf dul:DesignedArtifact .
:Cup rdfs:subClassOf :Crockery .
:Mug rdfs:subClassOf :Cup .
:Plan rdfs:subClassOf dul:Description .
"""


def parents(tbox):
    """Return local name → local names of the parents."""
    return {cls.local_name: tuple(tbox.by_iri[up].local_name for up in cls.parents) for cls in tbox.classes}


# --- the default scope -------------------------------------------------------------------------------


def test_scope_is_the_physical_classes_below_dul(load):
    assert parents(load(TREE)) == {
        "Crockery": ("DesignedArtifact",),
        "Cup": ("Crockery",),
        "Mug": ("Cup",),
        "DesignedArtifact": (),
    }


def test_imported_classes_placed_by_the_file_are_in_scope(write_turtle):
    upper = "soma:Appliance rdfs:subClassOf dul:PhysicalObject . soma:Unused rdfs:subClassOf dul:PhysicalObject ."
    write_turtle(upper, "upper.ttl")
    home = "<http://x> a owl:Ontology ; owl:imports <http://x/upper> . :Toaster rdfs:subClassOf soma:Appliance ."
    assert parents(load_tbox(write_turtle(home))) == {"Toaster": ("Appliance",), "Appliance": ()}


@pytest.mark.parametrize(
    "root",
    [
        "http://purl.obolibrary.org/obo/BFO_0000040",
        "https://spec.industrialontologies.org/ontology/core/Core/MaterialArtifact",
    ],
)
def test_recognises_other_upper_classes(load, root):
    assert list(parents(load(f":Cup rdfs:subClassOf <{root}> . :Plan rdfs:subClassOf :Idea ."))) == ["Cup"]


def test_scope_without_a_known_upper_class(load):
    assert list(parents(load(":Cup rdfs:subClassOf :Thing . :Plan rdfs:subClassOf :Idea . :Alone a owl:Class ."))) == [
        "Cup",
        "Idea",
        "Plan",
        "Thing",
    ]


def test_a_flat_list_of_classes_is_in_scope(load):
    assert parents(load(":Cup a owl:Class . :Mug a rdfs:Class . :has a owl:ObjectProperty .")) == {"Cup": (), "Mug": ()}


def test_a_class_of_objects_in_general_needs_no_subclasses(load):
    text = ":Storey rdfs:subClassOf :Zone . :Element a owl:Class . :Interface a owl:Class . other:Item a owl:Class ."
    tbox = load("@prefix other: <http://example.com/other#> . " + text)
    assert parents(tbox) == {"Element": (), "Storey": ("Zone",), "Zone": ()}
    assert [iri.rpartition("#")[2] for iri in tbox.isolated] == ["Interface", "Item"]


def test_top_classes_are_not_parents(load):
    assert parents(load(":Cup rdfs:subClassOf owl:Thing, :Crockery . :Pan rdfs:subClassOf rdfs:Resource .")) == {
        "Cup": ("Crockery",),
        "Crockery": (),
    }


def test_deprecated_classes_are_skipped(load):
    text = """
    :Bowl rdfs:subClassOf :Cup . :Cup rdfs:subClassOf :Old .
    :Old rdfs:subClassOf :Crockery ; owl:deprecated true .
    """
    assert parents(load(text)) == {"Bowl": ("Cup",), "Crockery": (), "Cup": ("Crockery",)}


@pytest.mark.parametrize(("value", "is_in"), [('"true"', False), ("true", False), ("1", False), ("false", True)])
def test_recognises_deprecation_values(load, value, is_in):
    text = f":Cup rdfs:subClassOf :Crockery . :Old rdfs:subClassOf :Crockery ; owl:deprecated {value} ."
    assert ("Old" in parents(load(text))) is is_in


# --- explicit scopes ---------------------------------------------------------------------------------


def test_roots_include_their_subclasses(load):
    assert parents(load(TREE, roots=["http://example.com/home#Cup"])) == {"Cup": (), "Mug": ("Cup",)}


def test_roots_may_be_curies(load):
    assert list(parents(load(TREE, roots=["dul:DesignedArtifact"]))) == ["Crockery", "Cup", "Mug", "DesignedArtifact"]


def test_roots_may_have_prefixes_of_the_file(load):
    tbox = load("@prefix my: <http://example.com/home#> . " + TREE, roots=["my:Cup"])
    assert parents(tbox) == {"Cup": (), "Mug": ("Cup",)}


@pytest.mark.parametrize("name", ["Cup", "coffee cup"])
def test_roots_may_be_local_names_and_labels(load, name):
    assert list(parents(load(TREE + ':Cup rdfs:label "coffee cup" .', roots=[name]))) == ["Cup", "Mug"]


def test_roots_exclude_deprecated_subclasses(load):
    text = TREE + ":Jug rdfs:subClassOf :Crockery ; owl:deprecated true ."
    assert list(parents(load(text, roots=["http://example.com/home#Crockery"]))) == ["Crockery", "Cup", "Mug"]


def test_scope_of_listed_classes(load):
    # Cup is between Mug and Crockery but not listed: Crockery is the nearest parent in scope.
    classes = ["http://example.com/home#Mug", "http://example.com/home#Crockery"]
    assert parents(load(TREE, classes=classes)) == {"Crockery": (), "Mug": ("Crockery",)}


@pytest.mark.parametrize("option", ["roots", "classes"])
def test_rejects_unknown_classes(load, option):
    with pytest.raises(OntologyError) as caught:
        load(TREE, **{option: ["http://example.com/home#Cup", "soma:Spaceship"]})
    assert "<http://www.ease-crc.org/ont/SOMA.owl#Spaceship> is not a class of the ontology" in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("option", ["roots", "classes"])
def test_rejects_an_empty_scope(load, option):
    with pytest.raises(OntologyError, match="no class in scope"):
        load(TREE, **{option: []})


# --- superclasses ------------------------------------------------------------------------------------


def test_stated_grandparents_are_not_parents(load):
    text = ":Mug rdfs:subClassOf :Cup, :Crockery . :Cup rdfs:subClassOf :Crockery ."
    assert parents(load(text)) == {"Crockery": (), "Cup": ("Crockery",), "Mug": ("Cup",)}


def test_several_parents_are_kept_sorted(load):
    text = ":SofaBed rdfs:subClassOf :Sofa, :Bed . :Sofa rdfs:subClassOf :Seat . :Bed rdfs:subClassOf :Furniture ."
    assert parents(load(text))["SofaBed"] == ("Bed", "Sofa")


def test_named_conjuncts_of_superclasses_and_definitions_are_parents(load):
    text = """
    :Mug owl:equivalentClass [ a owl:Class ; owl:intersectionOf ( :Cup [ a owl:Class ; owl:intersectionOf ( :Big ) ]
        [ a owl:Restriction ; owl:onProperty :has ; owl:someValuesFrom :Handle ] ) ] .
    :Cup rdfs:subClassOf :Crockery . :Big rdfs:subClassOf :Sized .
    """
    assert parents(load(text))["Mug"] == ("Big", "Cup")


def test_unions_and_complements_are_not_parents(load):
    text = ":Cup rdfs:subClassOf :Crockery, [ a owl:Class ; owl:unionOf ( :A :B ) ], [ owl:complementOf :Plate ] ."
    assert parents(load(text)) == {"Crockery": (), "Cup": ("Crockery",)}


def test_reports_and_ignores_cycles(load):
    text = ":A rdfs:subClassOf :B . :B rdfs:subClassOf :A . :B rdfs:subClassOf :Top . :C rdfs:subClassOf :A ."
    tbox = load(text)
    assert parents(tbox) == {"A": ("Top",), "B": ("Top",), "C": ("A", "B"), "Top": ()}
    assert [(note.code, note.message.split(" ")[0]) for note in tbox.notes] == [
        ("cycle", "<http://example.com/home#A>"),
        ("cycle", "<http://example.com/home#B>"),
    ]
    assert tbox.notes[0].message.endswith("is a subclass of itself; the edges of that cycle are ignored")


def test_reflexive_subclass_axiom_is_not_a_cycle(load):
    tbox = load(":Cup rdfs:subClassOf :Cup, :Crockery .")
    assert (parents(tbox), tbox.notes) == ({"Crockery": (), "Cup": ("Crockery",)}, ())


# --- SOMA-HOME ---------------------------------------------------------------------------------------


def test_scope_of_soma_home_matches_the_reference():
    expected = shared_file("reference/soma_home_scope.txt").read_text(encoding="utf-8").split()
    tbox = load_tbox(shared_file("ontologies/soma/SOMA-HOME.owl"))
    assert [cls.iri for cls in tbox.classes] == sorted(expected)
    assert len(expected) == 102
    assert tbox.ontology_iri == "http://www.ease-crc.org/ont/SOMA-HOME.owl"
    assert tbox.notes == ()
