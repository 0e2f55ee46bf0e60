"""The IRIs that graphs are written in. Exact spelling matters: mind http and https."""

import pyoxigraph as ox

__all__ = [
    "DUL",
    "KNOWROB",
    "OWL",
    "PREFIXES",
    "PROV",
    "RDF",
    "RDFS",
    "SKOS",
    "SOMA",
    "SSSOM",
    "U2K",
    "USD",
    "XSD",
    "Namespace",
    "number",
    "text",
]


class Namespace:
    """A namespace whose attributes are its terms: `SOMA.Cup`.

    >>> SOMA["6DPose"].value
    'http://www.ease-crc.org/ont/SOMA.owl#6DPose'
    """

    def __init__(self, iri: str) -> None:
        self.iri = iri

    def __getattr__(self, name: str) -> ox.NamedNode:
        return ox.NamedNode(self.iri + name)

    def __getitem__(self, name: str) -> ox.NamedNode:
        return ox.NamedNode(self.iri + name)


RDF = Namespace("http://www.w3.org/1999/02/22-rdf-syntax-ns#")
RDFS = Namespace("http://www.w3.org/2000/01/rdf-schema#")
OWL = Namespace("http://www.w3.org/2002/07/owl#")
XSD = Namespace("http://www.w3.org/2001/XMLSchema#")
SKOS = Namespace("http://www.w3.org/2004/02/skos/core#")
PROV = Namespace("http://www.w3.org/ns/prov#")
SSSOM = Namespace("https://w3id.org/sssom/")
SOMA = Namespace("http://www.ease-crc.org/ont/SOMA.owl#")
DUL = Namespace("http://www.ontologydesignpatterns.org/ont/dul/DUL.owl#")
KNOWROB = Namespace("http://knowrob.org/kb/knowrob.owl#")
USD = Namespace("https://ease-crc.org/ont/USD.owl#")
U2K = Namespace("https://w3id.org/usd2kg#")
"""Our own terms; docs/vocabulary.md describes each."""

PREFIXES = {
    "rdf": RDF.iri,
    "rdfs": RDFS.iri,
    "owl": OWL.iri,
    "xsd": XSD.iri,
    "prov": PROV.iri,
    "sssom": SSSOM.iri,
    "soma": SOMA.iri,
    "dul": DUL.iri,
    "usd": USD.iri,
    "knowrob": KNOWROB.iri,
    "u2k": U2K.iri,
}


def number(value: float, datatype: str = "double") -> ox.Literal:
    """Return a number with seven significant digits, as an XML Schema literal.

    >>> number(0.1 + 0.2).value
    '0.3'
    """
    return ox.Literal(f"{value + 0.0:.7g}", datatype=XSD[datatype])


def text(value: str) -> ox.Literal:
    """Return a plain string literal; characters that RDF's syntaxes cannot hold become U+FFFD."""
    return ox.Literal("".join(c if c in "\t\n\r" or _is_character(c) else "\ufffd" for c in value))


def _is_character(c: str) -> bool:
    """Return whether XML and RDF can hold a character: no control code, no half of a surrogate pair."""
    return c >= " " and not "\ud800" <= c <= "\udfff" and c not in "\ufffe\uffff"
