"""Ontologies whose labels are in German, Spanish, French or Italian."""

from pathlib import Path

import pytest

from usd2kg.grounding import ObjectView, Status
from usd2kg.grounding.lexical.alignment.english_labels import in_english
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.ontology import TBox, load_tbox

HEAD = """
@prefix : <https://werk.example/halle#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
"""


def load(folder: Path, *classes: str) -> TBox:
    """Return a TBox of classes below the first, each written as `local name: properties`."""
    names = [line.split(": ", 1) for line in classes]
    text = "".join(
        f":{name} a owl:Class ; {properties} {f'; rdfs:subClassOf :{names[0][0]} ' if name != names[0][0] else ''}.\n"
        for name, properties in names
    )
    (folder / "halle.ttl").write_text(HEAD + text, "utf-8")
    return load_tbox(folder / "halle.ttl")


def classes_of(tbox: TBox, *names: str) -> list[str | None]:
    predictions = LexicalGrounder().ground_views([(name, ObjectView(name=name)) for name in names], tbox)
    return [p.class_iri and p.class_iri.rpartition("#")[2] for p in predictions]


@pytest.fixture
def german(tmp_path: Path) -> TBox:
    return load(
        tmp_path,
        'Gegenstand: rdfs:label "Gegenstand"@de',
        'Wand: rdfs:label "Wand"@de',
        'Stuhl: rdfs:label "Stuhl"@de ; skos:altLabel "Bürostuhl"@de',
        'Eimer: rdfs:label "Eimer"@de',
        'Karton: rdfs:label "Karton"@de',
    )


def test_english_names_are_found_in_a_german_ontology(german: TBox):
    assert classes_of(german, "Wall_North", "office_chair_2", "Bucket_12L") == ["Wand", "Stuhl", "Eimer"]


def test_german_names_are_found_with_modifiers_and_umlauts(german: TBox):
    names = ("roter_Stuhl", "Stuhl_rot", "Buerostuhl", "Bürostuhl_3", "Karton_gross_03")
    assert classes_of(german, *names) == ["Stuhl"] * 4 + ["Karton"]


def test_names_that_are_also_english_words_are_found_as_they_are_written(tmp_path: Path):
    words = ("Regal", "Brief", "Bad", "Angel", "Stern", "Mantel", "Bank", "Hammer")
    tbox = load(tmp_path, 'Ding: rdfs:label "Ding"@de', *(f'{word}: rdfs:label "{word}"@de' for word in words))
    assert classes_of(tbox, *(f"{word}_3" for word in words)) == [*words]
    assert classes_of(tbox, "shelf_2", "coat", "bench", "hammer") == ["Regal", "Mantel", "Bank", "Hammer"]


def test_labels_in_the_file_stay_as_they_are(german: TBox):
    wall = german.resolve("Wand")
    assert (german.by_iri[wall].label, german.by_iri[wall].foreign_names) == ("Wand", (("de", "Wand"),))
    assert in_english(german).by_iri[wall].label == "wall"


def test_names_without_a_tag_are_in_the_language_that_most_reveal(tmp_path: Path):
    tbox = load(
        tmp_path,
        'Cosa: rdfs:label "cosa"',
        'Silla: rdfs:label "silla de oficina"',
        'Mesa: rdfs:label "mesa de cocina"',
        'Cubo: rdfs:label "cubo de basura"',
    )
    assert [cls.label for cls in in_english(tbox).classes][-2:] == ["kitchen table", "office chair"]
    assert classes_of(tbox, "trash_can_1") == ["Cubo"]


def test_a_foreign_word_beside_an_english_label_is_no_english_noun(tmp_path: Path):
    tbox = load(
        tmp_path,
        'Thing: rdfs:label "thing"@en, "Ding"@de',
        'Skirt: rdfs:label "skirt"@en, "Rock"@de',
        'Boat: rdfs:label "boat"@en, "Boot"@de',
        'Sofa: rdfs:label "sofa"@en, "Sofa"@de',
    )
    assert classes_of(tbox, "rock_03", "boot_left", "skirt", "sofa_2") == ["Thing", "Thing", "Skirt", "Sofa"]


def test_a_name_that_might_be_foreign_is_english_among_english_names(tmp_path: Path):
    # `media` is Spanish for half.
    tbox = load(tmp_path, "Item: rdfs:label 'item'", "Media: rdfs:label 'media'", "Furniture: rdfs:label 'furniture'")
    assert in_english(tbox) is tbox


def test_a_name_of_an_equivalent_class_may_be_english(tmp_path: Path):
    (tmp_path / "t.ttl").write_text(
        f'{HEAD} :T rdfs:subClassOf :X ; rdfs:label "Tank"@de ; owl:equivalentClass :U . :U rdfs:label "Tank"@en .'
    )
    assert [cls.foreign_names for cls in load_tbox(tmp_path / "t.ttl").classes] == [(), ()]


def test_an_english_ontology_is_unchanged(tmp_path: Path):
    tbox = load(tmp_path, 'Thing: rdfs:label "thing"', 'Chair: rdfs:label "chair"@en-GB', "Pan: rdfs:comment 'a pan'")
    assert in_english(tbox) is tbox
    (prediction,) = LexicalGrounder().ground_views([("/a", ObjectView(name="chair"))], tbox)
    assert prediction.status is Status.GROUNDED
