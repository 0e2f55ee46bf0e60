"""Namespaces of RDF terms, prefixes, and constructors of literals and IRIs."""

from collections.abc import Iterable

import pyoxigraph as ox

from usd2kg.ontology import namespaces

__all__ = [
    "DCTERMS",
    "DUL",
    "KNOWROB",
    "OWL",
    "PREFIXES",
    "PROV",
    "QUDT",
    "RDF",
    "RDFS",
    "SEMAPV",
    "SKOS",
    "SOMA",
    "SSSOM",
    "U2K",
    "USD",
    "WORDNET",
    "XSD",
    "Namespace",
    "Triple",
    "named_node",
    "number",
    "text",
    "vector_text",
]

Triple = tuple[ox.NamedNode | ox.BlankNode, ox.NamedNode, ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple]
"""Subject, predicate and object; triple terms need RDF 1.2."""


class Namespace:
    """A namespace with its terms as attributes: `SOMA.Cup`.

    >>> SOMA["6DPose"].value
    'http://www.ease-crc.org/ont/SOMA.owl#6DPose'
    """

    def __init__(self, iri: str) -> None:
        self.iri = iri

    def __getattr__(self, name: str) -> ox.NamedNode:
        if name.startswith("__"):
            raise AttributeError(name)
        node = ox.NamedNode(self.iri + name)
        # Cached as an attribute: terms are looked up millions of times.
        setattr(self, name, node)
        return node

    def __getitem__(self, name: str) -> ox.NamedNode:
        node: ox.NamedNode = getattr(self, name)
        return node


RDF = Namespace(namespaces.RDF)
RDFS = Namespace(namespaces.RDFS)
OWL = Namespace(namespaces.OWL)
XSD = Namespace(namespaces.XSD)
SHACL = Namespace(namespaces.SHACL)
SKOS = Namespace(namespaces.SKOS)
DCTERMS = Namespace(namespaces.DCTERMS)
PROV = Namespace(namespaces.PROV)
QUDT = Namespace("http://qudt.org/schema/qudt/")
SSSOM = Namespace(namespaces.SSSOM)
SEMAPV = Namespace("https://w3id.org/semapv/vocab/")
SOMA = Namespace(namespaces.SOMA)
DUL = Namespace(namespaces.DUL)
USD = Namespace(namespaces.USD)
KNOWROB = Namespace(namespaces.KNOWROB)
U2K = Namespace(namespaces.U2K)
WORDNET = Namespace(namespaces.WORDNET)

PREFIXES = {
    "rdf": RDF.iri,
    "rdfs": RDFS.iri,
    "owl": OWL.iri,
    "xsd": XSD.iri,
    "skos": SKOS.iri,
    "dcterms": DCTERMS.iri,
    "prov": PROV.iri,
    "sssom": SSSOM.iri,
    "semapv": SEMAPV.iri,
    "soma": SOMA.iri,
    "dul": DUL.iri,
    "usd": USD.iri,
    "knowrob": KNOWROB.iri,
    "u2k": U2K.iri,
    "concept": namespaces.CONCEPT,
    "wn": WORDNET.iri,
}


def number(value: float, datatype: str = "double") -> ox.Literal:
    """Return an XML Schema literal of a number with seven significant digits.

    >>> number(0.1 + 0.2).value
    '0.3'
    """
    return ox.Literal(f"{value + 0.0:.7g}", datatype=XSD[datatype])


def text(value: str) -> ox.Literal:
    """Return a string literal; characters that RDF syntaxes cannot encode become U+FFFD."""
    if value.isprintable():
        return ox.Literal(value)
    return ox.Literal("".join(c if c in "\t\n\r" or _is_character(c) else "\ufffd" for c in value))


def _is_character(c: str) -> bool:
    """Return whether a character is legal in XML 1.0 (no control code, lone surrogate or non-character)."""
    return c >= " " and not "\ud800" <= c <= "\udfff" and c not in "\ufffe\uffff"


def vector_text(values: Iterable[float]) -> str:
    """Return space-separated numbers with seven significant digits.

    >>> vector_text((1.0, -0.0, 0.33333333333))
    '1 0 0.3333333'
    """
    return " ".join(f"{value + 0.0:.7g}" for value in values)


def named_node(iri: str) -> ox.NamedNode | None:
    """Return the node of an external IRI; None if it is not absolute.

    >>> named_node("a cup") is None
    True
    """
    try:
        return ox.NamedNode(iri)
    except ValueError:
        return None
