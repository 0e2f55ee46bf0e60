"""Files that are not ontologies raise one-line errors with advice."""

import gzip
from time import process_time

import pytest

from usd2kg.errors import OntologyError
from usd2kg.ontology import load_tbox


def refusal(path):
    """Return the error message for `path`, which is one line, without the path."""
    with pytest.raises(OntologyError) as caught:
        load_tbox(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert "\n" not in message
    return message.removeprefix(f"{path}: ")


@pytest.fixture
def write(tmp_path):
    """Return a function that writes a file and returns its path."""

    def run(content, name="home.owl"):
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return run


def test_missing_file(tmp_path):
    assert refusal(tmp_path / "nope.owl").startswith("no such file; expected an ontology (.jsonld, .nt, .ofn, ")


def test_folder(tmp_path):
    assert refusal(tmp_path) == "is a folder, expected an ontology file; name the file inside it"


@pytest.mark.parametrize(
    "content", [gzip.compress(b"Prefix(:=<http://x#>)", mtime=0), b"PXR-USDC\xff\xfe", "ü".encode("latin-1")]
)
def test_binary_file(write, content):
    message = refusal(write(content))
    assert "is not UTF-8 text, expected an ontology; is it a binary or compressed file?" in message


def test_reports_the_first_invalid_byte(write):
    assert refusal(write(b"abc\xff")).startswith("byte 3 is not UTF-8 text")


@pytest.mark.parametrize(
    ("content", "begins"),
    [
        ("", "''"),
        ("Dear reader,\n  this is not an ontology.", "'Dear reader, this is not an ontology.'"),
        ("<!DOCTYPE html>\n<html><body/></html>", "'<!DOCTYPE html> <html><body/></html>'"),
        ("#usda 1.0\n(\n)\n", "'#usda 1.0 ( )'"),
    ],
)
def test_quotes_text_that_is_not_an_ontology(write, content, begins):
    assert refusal(write(content)) == (
        f"not an ontology (begins with {begins}), expected one of OWL functional syntax, Manchester syntax, OWL/XML, "
        "RDF/XML, Turtle or N-Triples, JSON-LD"
    )


def test_truncates_quoted_text(write):
    assert len(refusal(write("word " * 10_000))) < 250


@pytest.mark.parametrize(
    ("content", "syntax"),
    [
        ("Prefix(:=<http://x#>)\nOntology(<http://x>\nSubClassOf(:A", "OWL functional syntax"),
        ("Ontology: <http://x>\nClass: A SubClassOf B", "Manchester syntax"),
        ("<Ontology xmlns='http://www.w3.org/2002/07/owl#'><SubClassOf>", "OWL/XML"),
        ("<rdf:RDF xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'><a", "RDF/XML"),
        ("@prefix : <http://x#> .\n:A a", "Turtle or N-Triples"),
        ("note: this is a letter", "Turtle or N-Triples"),
        ('{"@context": "http://example.com/remote.jsonld", "@id": "http://x"}', "JSON-LD"),
    ],
)
def test_names_the_syntax_of_malformed_documents(write, content, syntax):
    message = refusal(write(content))
    assert message.startswith(f"looks like {syntax} but does not parse (")
    assert message.endswith("); fix or re-export it")
    assert len(message) < 300


@pytest.mark.parametrize(
    "content",
    [
        "Prefix(:=<http://x#>)\nOntology(<http://x>)",
        "<http://x> a <http://www.w3.org/2002/07/owl#Ontology> .",
        "<http://x/a> <http://x/b> <http://x/c> .",
        '{"a": 1}',
    ],
)
def test_ontology_without_classes(write, content):
    message = refusal(write(content))
    assert message.startswith("no class in scope (0 classes found, none placed in a hierarchy)")


def test_ontology_with_imports_only(write):
    write("<http://x/b> <http://www.w3.org/2000/01/rdf-schema#subClassOf> <http://x/c> .", "upper.nt")
    owl = "http://www.w3.org/2002/07/owl#"
    path = write(f"<http://x> a <{owl}Ontology> ; <{owl}imports> <http://x/upper> .")
    assert [cls.local_name for cls in load_tbox(path).classes] == ["b", "c"]
    assert [cls.local_name for cls in load_tbox(path, roots=["http://x/b"]).classes] == ["b"]


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("a" + "\n" * 200_000, "not an ontology (begins with 'a')"),
        ("<?xml version='1.0'?>" + "<!--" * 60_000, "not an ontology (begins with "),
        ("<!DOCTYPE r [" + "<!--" * 60_000, "not an ontology (begins with "),
        ("[" * 200_000, "looks like JSON-LD but does not parse (line 1: objects are nested more than 1,000 deep"),
    ],
)
def test_rejects_pathological_documents_quickly(write, content, reason):
    start = process_time()
    assert refusal(write(content)).startswith(reason)
    assert process_time() - start < 2


def test_rejects_text_beyond_the_parser_limit(write):
    said = refusal(write(f'<a:a> <a:b> "{"x" * 2**24}" .', "long.ttl"))
    assert said.startswith("looks like Turtle or N-Triples but does not parse (Reached the buffer maximal size of ")
