"""Write the table of our own terms in docs/vocabulary.md from the ontology that defines them.

Usage: python tools/write_vocabulary_docs.py [--check]
"""

import sys
from pathlib import Path

import pyoxigraph as ox

from usd2kg.graph.declarations import vocabulary_triples
from usd2kg.graph.vocabulary import OWL, RDF, RDFS, SKOS, U2K

OUTPUT = Path(__file__).parent.parent / "docs/vocabulary.md"
START = "<!-- table: written by tools/write_vocabulary_docs.py -->\n"
END = "<!-- end of table -->\n"
KINDS = {
    OWL.Class: "class",
    OWL.ObjectProperty: "object property",
    OWL.DatatypeProperty: "data property",
    OWL.AnnotationProperty: "annotation",
}


def table() -> str:
    """Return the table, in the order in which the ontology defines its terms."""
    rows: dict[str, dict[ox.NamedNode, str]] = {}
    for triple in vocabulary_triples():
        subject, value = triple.subject, triple.object
        if isinstance(subject, ox.NamedNode) and subject.value.startswith(U2K.iri):
            row = rows.setdefault(subject.value.removeprefix(U2K.iri), {})
            if triple.predicate == RDF.type and isinstance(value, ox.NamedNode) and value in KINDS:
                row[RDF.type] = KINDS[value]
            elif isinstance(value, ox.Literal):
                row[triple.predicate] = value.value
    lines = ["| term | kind | on | meaning |", "| --- | --- | --- | --- |"]
    for name, row in rows.items():
        lines.append(f"| `u2k:{name}` | {row[RDF.type]} | {row[SKOS.scopeNote]} | {row[RDFS.comment]} |")
    return "\n".join(lines) + "\n"


def page() -> str:
    """Return the page with the table as it should be."""
    before, rest = OUTPUT.read_text("utf-8").split(START)
    return before + START + table() + END + rest.split(END)[1]


def main() -> None:
    """Write the page, or check that it is what would be written."""
    if "--check" in sys.argv:
        if OUTPUT.read_text("utf-8") != page():
            raise SystemExit(f"{OUTPUT} is not what the ontology says; run python tools/write_vocabulary_docs.py")
        return
    OUTPUT.write_text(page(), "utf-8")


if __name__ == "__main__":
    main()
