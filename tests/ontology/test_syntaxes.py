"""One small ontology in all syntaxes, detected by content."""

import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from usd2kg.errors import OntologyError
from usd2kg.ontology import load_tbox
from usd2kg.ontology.sniff import sniff_syntax

HOME = "http://example.com/home#"

FUNCTIONAL = """\
Prefix(:=<http://example.com/home#>)
Prefix(owl:=<http://www.w3.org/2002/07/owl#>)
Prefix(rdfs:=<http://www.w3.org/2000/01/rdf-schema#>)
Prefix(skos:=<http://www.w3.org/2004/02/skos/core#>)
Ontology(<http://example.com/home> <http://example.com/home/1.0>
Declaration(Class(:Cup))
Declaration(Class(:Crockery))
Declaration(ObjectProperty(:hasPart))
SubClassOf(:Cup :Crockery)
SubClassOf(:Mug ObjectIntersectionOf(:Cup ObjectSomeValuesFrom(:hasPart :Handle)))
AnnotationAssertion(rdfs:label :Cup "cup"@en)
AnnotationAssertion(rdfs:label :Cup "Tasse"@de)
AnnotationAssertion(skos:altLabel :Cup "teacup"@en)
AnnotationAssertion(rdfs:comment :Cup "To drink from.")
)
"""
MANCHESTER = """\
Prefix: : <http://example.com/home#>
Prefix: owl: <http://www.w3.org/2002/07/owl#>
Prefix: rdfs: <http://www.w3.org/2000/01/rdf-schema#>
Prefix: skos: <http://www.w3.org/2004/02/skos/core#>

Ontology: <http://example.com/home> <http://example.com/home/1.0>

AnnotationProperty: skos:altLabel

ObjectProperty: hasPart

Class: Crockery

Class: Cup
    Annotations: rdfs:label "cup"@en, rdfs:label "Tasse"@de, skos:altLabel "teacup"@en, rdfs:comment "To drink from."
    SubClassOf: Crockery

Class: Mug
    SubClassOf: Cup and (hasPart some Handle)
"""
OWL_XML = """\
<?xml version="1.0"?>
<Ontology xmlns="http://www.w3.org/2002/07/owl#" xml:base="http://example.com/home"
    ontologyIRI="http://example.com/home" versionIRI="http://example.com/home/1.0">
    <Prefix name="" IRI="http://example.com/home#"/>
    <Prefix name="rdfs" IRI="http://www.w3.org/2000/01/rdf-schema#"/>
    <Prefix name="skos" IRI="http://www.w3.org/2004/02/skos/core#"/>
    <Declaration><Class IRI="#Cup"/></Declaration>
    <Declaration><Class IRI="#Crockery"/></Declaration>
    <SubClassOf><Class IRI="#Cup"/><Class IRI="#Crockery"/></SubClassOf>
    <SubClassOf>
        <Class IRI="#Mug"/>
        <ObjectIntersectionOf>
            <Class IRI="#Cup"/>
            <ObjectSomeValuesFrom><ObjectProperty IRI="#hasPart"/><Class IRI="#Handle"/></ObjectSomeValuesFrom>
        </ObjectIntersectionOf>
    </SubClassOf>
    <AnnotationAssertion>
        <AnnotationProperty abbreviatedIRI="rdfs:label"/><IRI>#Cup</IRI><Literal xml:lang="en">cup</Literal>
    </AnnotationAssertion>
    <AnnotationAssertion>
        <AnnotationProperty abbreviatedIRI="rdfs:label"/><IRI>#Cup</IRI><Literal xml:lang="de">Tasse</Literal>
    </AnnotationAssertion>
    <AnnotationAssertion>
        <AnnotationProperty abbreviatedIRI="skos:altLabel"/><IRI>#Cup</IRI><Literal xml:lang="en">teacup</Literal>
    </AnnotationAssertion>
    <AnnotationAssertion>
        <AnnotationProperty abbreviatedIRI="rdfs:comment"/><IRI>#Cup</IRI><Literal>To drink from.</Literal>
    </AnnotationAssertion>
</Ontology>
"""
RDF_XML = """\
<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE rdf:RDF [
    <!ENTITY home "http://example.com/home#">
    <!ENTITY soma "http://www.ease-crc.org/ont/SOMA.owl#">
]>
<!-- <Ontology> in a comment is not the root -->
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#"
    xmlns:owl="http://www.w3.org/2002/07/owl#" xmlns:skos="http://www.w3.org/2004/02/skos/core#">
    <owl:Ontology rdf:about="http://example.com/home">
        <owl:versionIRI rdf:resource="http://example.com/home/1.0"/>
    </owl:Ontology>
    <owl:Class rdf:about="&home;Crockery"/>
    <owl:Class rdf:about="&home;Cup">
        <rdfs:subClassOf rdf:resource="&home;Crockery"/>
        <rdfs:label xml:lang="en">cup</rdfs:label>
        <rdfs:label xml:lang="de">Tasse</rdfs:label>
        <skos:altLabel xml:lang="en">teacup</skos:altLabel>
        <rdfs:comment>To drink from.</rdfs:comment>
    </owl:Class>
    <owl:Class rdf:about="&home;Mug">
        <rdfs:subClassOf>
            <owl:Class>
                <owl:intersectionOf rdf:parseType="Collection">
                    <owl:Class rdf:about="&home;Cup"/>
                    <owl:Restriction>
                        <owl:onProperty rdf:resource="&home;hasPart"/>
                        <owl:someValuesFrom rdf:resource="&home;Handle"/>
                    </owl:Restriction>
                </owl:intersectionOf>
            </owl:Class>
        </rdfs:subClassOf>
    </owl:Class>
</rdf:RDF>
"""
TURTLE = """\
@prefix : <http://example.com/home#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .

<http://example.com/home> a owl:Ontology ; owl:versionIRI <http://example.com/home/1.0> .
:Crockery a owl:Class .
:Cup a owl:Class ;
    rdfs:subClassOf :Crockery ;
    rdfs:label "cup"@en, "Tasse"@de ;
    skos:altLabel "teacup"@en ;
    rdfs:comment "To drink from." .
:Mug a owl:Class ;
    rdfs:subClassOf [ a owl:Class ; owl:intersectionOf
        ( :Cup [ a owl:Restriction ; owl:onProperty :hasPart ; owl:someValuesFrom :Handle ] ) ] .
"""
_RDF = "http://www.w3.org/1999/02/22-rdf-syntax-ns#"
_RDFS = "http://www.w3.org/2000/01/rdf-schema#"
_OWL = "http://www.w3.org/2002/07/owl#"
N_TRIPLES = f"""\
<http://example.com/home> <{_RDF}type> <{_OWL}Ontology> .
<http://example.com/home> <{_OWL}versionIRI> <http://example.com/home/1.0> .
<{HOME}Cup> <{_RDFS}subClassOf> <{HOME}Crockery> .
<{HOME}Cup> <{_RDFS}label> "cup"@en .
<{HOME}Cup> <{_RDFS}label> "Tasse"@de .
<{HOME}Cup> <http://www.w3.org/2004/02/skos/core#altLabel> "teacup"@en .
<{HOME}Cup> <{_RDFS}comment> "To drink from." .
<{HOME}Mug> <{_RDFS}subClassOf> <{HOME}Cup> .
"""
JSON_LD = """\
{
  "@context": {
    "owl": "http://www.w3.org/2002/07/owl#",
    "rdfs": "http://www.w3.org/2000/01/rdf-schema#",
    "skos": "http://www.w3.org/2004/02/skos/core#",
    "home": "http://example.com/home#"
  },
  "@graph": [
    {"@id": "http://example.com/home", "@type": "owl:Ontology",
     "owl:versionIRI": {"@id": "http://example.com/home/1.0"}},
    {"@id": "home:Crockery", "@type": "owl:Class"},
    {"@id": "home:Cup", "@type": "owl:Class", "rdfs:subClassOf": {"@id": "home:Crockery"},
     "rdfs:label": [{"@value": "cup", "@language": "en"}, {"@value": "Tasse", "@language": "de"}],
     "skos:altLabel": {"@value": "teacup", "@language": "en"}, "rdfs:comment": "To drink from."},
    {"@id": "home:Mug", "@type": "owl:Class", "rdfs:subClassOf": {"@id": "home:Cup"}}
  ]
}
"""
SYNTAXES = {
    "functional": (FUNCTIONAL, "ofn"),
    "Manchester": (MANCHESTER, "omn"),
    "OWL/XML": (OWL_XML, "owx"),
    "RDF/XML": (RDF_XML, "rdf"),
    "Turtle": (TURTLE, "ttl"),
    "N-Triples": (N_TRIPLES, "ttl"),
    "JSON-LD": (JSON_LD, "jsonld"),
}
all_syntaxes = pytest.mark.parametrize("syntax", list(SYNTAXES))


@all_syntaxes
def test_recognises_all_syntaxes(syntax):
    text, key = SYNTAXES[syntax]
    assert sniff_syntax(text) == key


@all_syntaxes
@pytest.mark.parametrize("ending", [".owl", ".xml", ".txt", ""])
def test_classes_are_the_same_in_all_syntaxes(tmp_path, syntax, ending):
    path = tmp_path / f"home{ending}"
    path.write_text(SYNTAXES[syntax][0], encoding="utf-8")
    tbox = load_tbox(path)
    assert [(cls.iri, cls.label, cls.alt_labels, cls.comment, cls.parents) for cls in tbox.classes] == [
        (f"{HOME}Crockery", "Crockery", (), "", ()),
        (f"{HOME}Cup", "cup", ("Tasse", "teacup"), "To drink from.", (f"{HOME}Crockery",)),
        (f"{HOME}Mug", "Mug", (), "", (f"{HOME}Cup",)),
    ]
    assert (tbox.ontology_iri, tbox.version_iri) == ("http://example.com/home", "http://example.com/home/1.0")
    assert tbox.notes == ()


@all_syntaxes
def test_accepts_a_byte_order_mark(tmp_path, syntax):
    path = tmp_path / "home.owl"
    path.write_bytes(b"\xef\xbb\xbf" + SYNTAXES[syntax][0].encode())
    assert [cls.local_name for cls in load_tbox(path).classes] == ["Crockery", "Cup", "Mug"]


@all_syntaxes
def test_accepts_windows_line_endings(tmp_path, syntax):
    path = tmp_path / "home.owl"
    path.write_bytes(SYNTAXES[syntax][0].replace("\n", "\r\n").encode())
    assert [cls.local_name for cls in load_tbox(path).classes] == ["Crockery", "Cup", "Mug"]


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("# a comment\n# and one more\nPrefix(:=<http://x#>)", "ofn"),
        ("Ontology(<http://x>)", "ofn"),
        ("Ontology (\n)", "ofn"),
        ("Ontology: <http://x>", "omn"),
        ("# a comment\n@prefix : <http://x#> .", "ttl"),
        ("PREFIX : <http://x#>", "ttl"),
        ("@base <http://x> .", "ttl"),
        ("BASE <http://x>", "ttl"),
        ("<http://x/a> <http://x/b> <http://x/c> .", "ttl"),
        ("_:b0 <http://x/b> <http://x/c> .", "ttl"),
        ("[] a <http://x/c> .", "ttl"),
        ("ex:Cup a ex:Thing .", "ttl"),
        ("urn:x a <urn:y> .", "ttl"),
        ('[{"@id": "http://x"}]', "jsonld"),
        ('  {"@id": "http://x"}', "jsonld"),
        ("<rdf:RDF xmlns:rdf='x'>", "rdf"),
        ("<RDF xmlns='x'>", "rdf"),
        ("<!DOCTYPE rdf:RDF [ <!ENTITY trap '<Ontology'> ]>\n<rdf:RDF xmlns:rdf='x'>", "rdf"),
        ("<!-- <rdf:RDF> --><owl:Ontology xmlns:owl='x'>", "owx"),
        ("<?xml version='1.0'?>\n<Ontology xmlns='x'>", "owx"),
        ("<html><body>", None),
        ("<?xml version='1.0'?><catalog/>", None),
        ("The cup is a thing.", None),
        ("{not json", None),
        ("", None),
        ("# nothing but a comment\n", None),
    ],
)
def test_detects_the_syntax(text, key):
    assert sniff_syntax(text) == key


@pytest.mark.parametrize("syntax", [name for name in SYNTAXES if name != "OWL/XML"])
@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_damaged_documents_raise_one_line_errors(tmp_path_factory, syntax, data):
    text = SYNTAXES[syntax][0]
    start = data.draw(st.integers(0, len(text) - 1))
    end = start + data.draw(st.sampled_from([1, 10, len(text)]))
    damaged = text[:start] + data.draw(st.sampled_from(["", "<", '"', "(", "\0", "}"])) + text[end:]
    path = tmp_path_factory.getbasetemp() / "damaged.owl"
    path.write_text(damaged, encoding="utf-8")
    try:
        tbox = load_tbox(path)
    except OntologyError as error:
        assert str(error).startswith(f"{path}: ")
        assert "\n" not in str(error)
    else:
        assert tbox.classes


def test_rejects_truncated_owl_xml(tmp_path):
    # py-horned-owl hangs and allocates memory on documents that end inside a literal, so use a separate process.
    text = OWL_XML.rstrip()
    for end in range(60, len(text), 37):
        (tmp_path / f"cut{end}.owl").write_text(text[:end], encoding="utf-8")
    (tmp_path / "cut_in_literal.owl").write_text(text[: text.index("To drink")], encoding="utf-8")
    code = (
        "import resource, sys; from pathlib import Path; resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))\n"
        "from usd2kg.errors import OntologyError; from usd2kg.ontology import load_tbox\n"
        "for path in Path(sys.argv[1]).iterdir():\n"
        "    try: load_tbox(path); print('read', path)\n"
        "    except OntologyError as error: print('refused', str(error).count(chr(10)))\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=20, check=True)
    assert done.stdout.splitlines() == ["refused 0"] * len(list(tmp_path.iterdir()))
