"""Labels, synonyms, definitions and dispositions of a class."""

import pytest

from usd2kg.ontology import load_tbox

SOMA = "http://www.ease-crc.org/ont/SOMA.owl#"


def cup(load, text):
    """Return the class :Cup of an ontology with the statements `text`."""
    return load(f":Cup rdfs:subClassOf :Crockery . {text}").by_iri["http://example.com/home#Cup"]


@pytest.mark.parametrize(
    ("labels", "label"),
    [
        ('"Tasse"@de, "cup"@en, "plain"', "cup"),
        ('"Tasse"@de, "teacup"@en-GB', "teacup"),
        ('"Tasse"@de, "plain"', "plain"),
        ('"Tasse"@de, "aaa"@fr', "Tasse"),  # neither English nor untagged: first language code
        ('"zebra"@en, "cup"@en', "cup"),
    ],
)
def test_english_labels_come_first_then_untagged_then_others(load, labels, label):
    assert cup(load, f":Cup rdfs:label {labels} .").label == label


def test_preferred_label_precedes_the_label(load):
    cls = cup(load, ':Cup rdfs:label "cup"@en ; skos:prefLabel "drinking cup"@en .')
    assert (cls.label, cls.alt_labels) == ("drinking cup", ("cup",))


def test_local_name_is_the_fallback_label(load):
    cls = cup(load, "")
    assert (cls.label, cls.local_name, cls.alt_labels, cls.comment) == ("Cup", "Cup", (), "")


def test_synonyms_of_all_languages_are_sorted(load):
    cls = cup(
        load,
        """
        :Cup rdfs:label "cup"@en, "Tasse"@de ; skos:altLabel "teacup" ; skos:hiddenLabel "cupp" ;
            <http://purl.obolibrary.org/obo/IAO_0000118> "beaker" ;
            <http://www.geneontology.org/formats/oboInOwl#hasExactSynonym> "chalice" ;
            <http://www.geneontology.org/formats/oboInOwl#hasBroadSynonym> "vessel" .
        """,
    )
    assert cls.alt_labels == ("Tasse", "beaker", "chalice", "cupp", "teacup")  # broader synonyms are omitted


@pytest.mark.parametrize(
    ("properties", "comment"),
    [
        ('skos:definition "D"@en ; rdfs:comment "C"@en', "D"),
        ('rdfs:comment "C"@en ; <http://purl.org/dc/terms/description> "T"', "T"),
        ('<http://purl.obolibrary.org/obo/IAO_0000115> "I" ; rdfs:comment "C"', "I"),
        ('rdfs:comment "Zum Trinken."@de, "To drink from."@en', "To drink from."),
        ('rdfs:comment "To drink\\n   from."@en', "To drink from."),
        ("rdfs:comment :Other", ""),
    ],
)
def test_definition_precedes_description_and_comment(load, properties, comment):
    assert cup(load, f":Cup {properties} .").comment == comment


def test_reads_texts_of_imports(write_turtle):
    write_turtle(':Cup rdfs:label "cup"@en .', "labels.ttl")
    path = write_turtle("<http://x> a owl:Ontology ; owl:imports <http://x/labels> . :Cup rdfs:subClassOf :Crockery .")
    assert load_tbox(path).by_iri["http://example.com/home#Cup"].label == "cup"


def test_dispositions_are_inherited_with_their_superclasses(load):
    cls = cup(
        load,
        """
        :Crockery rdfs:subClassOf [ a owl:Restriction ; owl:onProperty soma:hasDisposition ;
            owl:someValuesFrom soma:Graspability ] .
        :Cup rdfs:subClassOf [ a owl:Restriction ; owl:onProperty soma:hasDisposition ;
            owl:someValuesFrom [ a owl:Class ; owl:intersectionOf ( soma:Containment
                [ a owl:Restriction ; owl:onProperty soma:affords ; owl:allValuesFrom :X ] ) ] ] .
        soma:Containment rdfs:subClassOf soma:Enclosing .
        """,
    )
    assert cls.dispositions == (f"{SOMA}Containment", f"{SOMA}Enclosing", f"{SOMA}Graspability")


@pytest.mark.parametrize(
    "restriction",
    [
        "owl:onProperty soma:hasPart ; owl:someValuesFrom soma:Containment",
        "owl:onProperty soma:hasDisposition ; owl:allValuesFrom soma:Containment",
        "owl:onProperty [ owl:inverseOf soma:hasDisposition ] ; owl:someValuesFrom soma:Containment",
    ],
)
def test_ignores_other_restrictions(load, restriction):
    assert cup(load, f":Cup rdfs:subClassOf [ a owl:Restriction ; {restriction} ] .").dispositions == ()


def test_dispositions_are_not_inherited_upwards(load):
    restriction = "[ a owl:Restriction ; owl:onProperty soma:hasDisposition ; owl:someValuesFrom soma:Containment ]"
    assert cup(load, f":Mug rdfs:subClassOf :Cup, {restriction} .").dispositions == ()


def test_dispositions_in_functional_syntax(tmp_path):
    path = tmp_path / "home.owl"
    path.write_text(
        f"Prefix(:=<http://x#>)\nPrefix(soma:=<{SOMA}>)\nOntology(<http://x>\n"
        "SubClassOf(:Cup :Crockery)\n"
        "SubClassOf(:Cup ObjectSomeValuesFrom(soma:hasDisposition "
        "ObjectIntersectionOf(soma:Containment ObjectAllValuesFrom(soma:affords :X))))\n"
        "SubClassOf(:Cup ObjectSomeValuesFrom(ObjectInverseOf(soma:hasDisposition) soma:Other))\n)\n"
    )
    assert load_tbox(path).by_iri["http://x#Cup"].dispositions == (f"{SOMA}Containment",)
