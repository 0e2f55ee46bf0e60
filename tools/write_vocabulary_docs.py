"""Write the table of u2k terms in docs/vocabulary.md from the ontology that defines them.

Usage: python -m tools.write_vocabulary_docs [--check]
"""

import pyoxigraph as ox

from tools.generated_docs import DOCS, write_or_check
from usd2kg.graph.declarations import vocabulary_triples
from usd2kg.graph.vocabulary import OWL, RDF, RDFS, SKOS, U2K

PAGE = DOCS / "vocabulary.md"
START = "<!-- table: written by tools/write_vocabulary_docs.py -->\n"
END = "<!-- end of table -->\n"
KINDS = {
    OWL.Class: "class",
    OWL.ObjectProperty: "object property",
    OWL.DatatypeProperty: "data property",
    OWL.AnnotationProperty: "annotation",
}


def build_table() -> str:
    """Return the table in the order of the ontology."""
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


def build_page() -> str:
    """Return the page with its table replaced."""
    before, rest = PAGE.read_text("utf-8").split(START)
    return before + START + build_table() + END + rest.split(END)[1]


if __name__ == "__main__":
    write_or_check(PAGE, build_page(), "tools.write_vocabulary_docs")
