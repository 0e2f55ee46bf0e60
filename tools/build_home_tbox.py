"""Write the built-in home TBox: facts of SOMA-HOME joined with texts of our own.

Usage: python tools/build_home_tbox.py SOMA-HOME.owl

From the ontology come facts only: class IRIs, which class is below which, and which can contain. Labels, synonyms and
descriptions are ours, in `tools/home_tbox_text.csv`.
"""

import csv
import sys
from pathlib import Path

from usd2kg.ontology import TBox, load_tbox
from usd2kg.ontology.prefixes import PREFIXES, compact_iri

HERE = Path(__file__).parent
OUTPUT = HERE.parent / "src/usd2kg/data/home.ttl"
CONTAINMENT = PREFIXES["soma"] + "Containment"
HEADER = """\
# Written by tools/build_home_tbox.py; do not edit. Class IRIs and hierarchy are SOMA-HOME's; all texts are our own.
<https://w3id.org/usd2kg/home> a owl:Ontology ;
    rdfs:label "usd2kg home TBox"@en ;
    rdfs:comment "The classes of SOMA-HOME that objects of a home belong to, with labels and synonyms."@en .

soma:hasDisposition a owl:ObjectProperty .
soma:Containment a owl:Class .
dul:PhysicalObject a owl:Class .
"""


def main() -> None:
    """Write the file."""
    tbox = load_tbox(sys.argv[1])
    with (HERE / "home_tbox_text.csv").open(encoding="utf-8") as file:
        texts = {row["iri"]: row for row in csv.DictReader(file)}
    if set(texts) != set(tbox.by_iri):
        raise SystemExit(f"texts and classes differ: {sorted(set(texts) ^ set(tbox.by_iri))[:5]}")
    prefixes = "".join(f"@prefix {name}: <{PREFIXES[name]}> .\n" for name in ("dul", "owl", "rdfs", "skos", "soma"))
    blocks = [describe(tbox, iri, texts[iri]) for iri in sorted(texts)]
    OUTPUT.write_text(prefixes + "\n" + HEADER + "\n" + "\n".join(blocks), encoding="utf-8")
    print(f"{OUTPUT}: {len(blocks)} classes")


def describe(tbox: TBox, iri: str, text: dict[str, str]) -> str:
    """Return the Turtle of one class."""
    cls = tbox.by_iri[iri]
    above = [compact_iri(parent) for parent in cls.parents] or ["dul:PhysicalObject"]
    if CONTAINMENT in cls.dispositions and not any(
        CONTAINMENT in tbox.by_iri[parent].dispositions for parent in cls.parents
    ):
        above.append("[ a owl:Restriction ; owl:onProperty soma:hasDisposition ; owl:someValuesFrom soma:Containment ]")
    lines = [
        f"{compact_iri(iri)} a owl:Class",
        f"    rdfs:subClassOf {', '.join(above)}",
        f'    rdfs:label "{text["label"]}"@en',
        f'    rdfs:comment "{text["description"]}"@en',
    ]
    synonyms = sorted(set(text["synonyms"].split("|")))
    if synonyms:
        lines.append("    skos:altLabel " + ",\n        ".join(f'"{synonym}"' for synonym in synonyms))
    return " ;\n".join(lines) + " .\n"


if __name__ == "__main__":
    main()
