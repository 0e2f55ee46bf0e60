"""Build the Turtle of the built-in TBoxes: `home.ttl` and `places.ttl`."""

from collections.abc import Mapping

from tools.data_files import read_source_rows
from usd2kg.ontology.prefixes import PREFIXES

__all__ = ["build_home_tbox", "build_places_tbox"]

_HEADER = """\
# Built by make data from {sources}.
<{iri}> a owl:Ontology ;
    rdfs:label "{label}"@en ;
    rdfs:comment "{comment}"@en .

soma:hasDisposition a owl:ObjectProperty .
soma:Containment a owl:Class .
dul:PhysicalObject a owl:Class .
"""
_ROOT_CLASS = "dul:PhysicalObject"
_CONTAINMENT = "[ a owl:Restriction ; owl:onProperty soma:hasDisposition ; owl:someValuesFrom soma:Containment ]"
_PREFIXES = ("dul", "owl", "rdfs", "skos", "soma")


def build_home_tbox() -> bytes:
    """Return the ontology document of `home_classes.csv`: one block a class."""
    header = _HEADER.format(
        sources="knowledge/home_classes.csv. Class IRIs and hierarchy are SOMA-HOME's; all texts are our own",
        iri="https://w3id.org/usd2kg/home",
        label="usd2kg home TBox",
        comment="The classes of SOMA-HOME that objects of a home belong to, with labels and synonyms.",
    )
    return _document(_PREFIXES, header, read_source_rows("home_classes.csv"))


def build_places_tbox() -> bytes:
    """Return the ontology document of `place_classes.csv`, with the classes of the home TBox, which it extends.

    A synonym of a home class that `place_classes.csv` names is left out there: the place class is more specific.
    """
    header = _HEADER.format(
        sources="knowledge/place_classes.csv and knowledge/home_classes.csv",
        iri="https://w3id.org/usd2kg/places",
        label="usd2kg places TBox",
        comment="What offices, shops, warehouses, hospitals, workshops, laboratories and streets hold, below the upper "
        "classes of SOMA and DUL. CC0 1.0, but for the class IRIs of SOMA and DUL.",
    )
    places = read_source_rows("place_classes.csv")
    named = {name for row in places for name in _names(row)}
    homes = read_source_rows("home_classes.csv")
    for row in homes:
        row["synonyms"] = "|".join(name for name in row["synonyms"].split("|") if name not in named)
    return _document(("place", *_PREFIXES), header, [*homes, *places])


def _names(row: Mapping[str, str]) -> list[str]:
    return [row["label"], *filter(None, f"{row['synonyms']}|{row['things']}".split("|"))]


def _document(prefixes: tuple[str, ...], header: str, rows: list[dict[str, str]]) -> bytes:
    lines = "".join(f"@prefix {name}: <{PREFIXES[name]}> .\n" for name in sorted(prefixes))
    return (lines + "\n" + header + "\n" + "\n".join(map(_describe_class, rows))).encode()


def _describe_class(row: Mapping[str, str]) -> str:
    """Return the Turtle of one class."""
    superclasses = (row["parents"] or _ROOT_CLASS).split("|")
    if row.get("is_container"):
        superclasses.append(_CONTAINMENT)
    lines = [
        f"{row['class']} a owl:Class",
        f"    rdfs:subClassOf {', '.join(superclasses)}",
        f'    rdfs:label "{row["label"]}"@en',
        f'    rdfs:comment "{row["description"]}"@en',
    ]
    if row["synonyms"]:
        names = ",\n        ".join(f'"{name}"' for name in sorted(row["synonyms"].split("|")))
        lines.append(f"    skos:altLabel {names}")
    return " ;\n".join(lines) + " .\n"
