"""Build the Turtle of the home TBox from `knowledge/home_classes.csv`."""

from collections.abc import Mapping

from tools.data_files import read_source_rows
from usd2kg.ontology.prefixes import PREFIXES

HEADER = """\
# Built by make data from knowledge/home_classes.csv. Class IRIs and hierarchy are SOMA-HOME's; all texts are our own.
<https://w3id.org/usd2kg/home> a owl:Ontology ;
    rdfs:label "usd2kg home TBox"@en ;
    rdfs:comment "The classes of SOMA-HOME that objects of a home belong to, with labels and synonyms."@en .

soma:hasDisposition a owl:ObjectProperty .
soma:Containment a owl:Class .
dul:PhysicalObject a owl:Class .
"""
ROOT_CLASS = "dul:PhysicalObject"
CONTAINMENT = "[ a owl:Restriction ; owl:onProperty soma:hasDisposition ; owl:someValuesFrom soma:Containment ]"


def build_home_tbox() -> bytes:
    """Return the ontology document: one block a class."""
    prefixes = "".join(f"@prefix {name}: <{PREFIXES[name]}> .\n" for name in ("dul", "owl", "rdfs", "skos", "soma"))
    blocks = map(describe_class, read_source_rows("home_classes.csv"))
    return (prefixes + "\n" + HEADER + "\n" + "\n".join(blocks)).encode()


def describe_class(row: Mapping[str, str]) -> str:
    """Return the Turtle of one class."""
    superclasses = (row["parents"] or ROOT_CLASS).split("|")
    if row["is_container"]:
        superclasses.append(CONTAINMENT)
    synonyms = ",\n        ".join(f'"{synonym}"' for synonym in sorted(row["synonyms"].split("|")))
    lines = [
        f"{row['class']} a owl:Class",
        f"    rdfs:subClassOf {', '.join(superclasses)}",
        f'    rdfs:label "{row["label"]}"@en',
        f'    rdfs:comment "{row["description"]}"@en',
        f"    skos:altLabel {synonyms}",
    ]
    return " ;\n".join(lines) + " .\n"
