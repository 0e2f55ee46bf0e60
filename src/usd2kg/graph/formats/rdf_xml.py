"""Streamed RDF/XML (RDF 1.1 XML Syntax), one rdf:Description per run of triples with the same subject."""

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby, islice

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.rdf_document import refuse_rdf12
from usd2kg.graph.vocabulary import RDF
from usd2kg.graph.xml_text import find_illegal_character, xml_attribute, xml_text

__all__ = ["rdf_xml_pieces"]

_START = (
    "A-Z_a-z\u00c0-\u00d6\u00d8-\u00f6\u00f8-\u02ff\u0370-\u037d\u037f-\u1fff\u200c\u200d\u2070-\u218f"
    "\u2c00-\u2fef\u3001-\ud7ff\uf900-\ufdcf\ufdf0-\ufffd\U00010000-\U000effff"
)
"""NameStartChar without the colon (Namespaces in XML 1.0, section 3)."""
_NAME = re.compile(f"(.*?)([{_START}][{_START}\\-.0-9\u00b7\u0300-\u036f\u203f\u2040]*)\\Z", flags=re.DOTALL)
"""Longest suffix of an IRI that is an NCName."""
_RESERVED = {
    "Description",
    "RDF",
    "ID",
    "about",
    "aboutEach",
    "aboutEachPrefix",
    "bagID",
    "li",
    "nodeID",
    "parseType",
    "resource",
}
"""Local names of the RDF namespace that cannot be property elements (RDF 1.1 XML Syntax, section 6.2)."""
_PREFIX = re.compile(r"[A-Za-z_][\w.-]*\Z", flags=re.ASCII)
_SUBJECTS = 10_000
"""Runs of triples per chunk."""


def rdf_xml_pieces(triples: Sequence[ox.Triple], prefixes: Mapping[str, str], source: str) -> Iterator[bytes]:
    """Yield the file in chunks.

    Raises:
        GraphError: a property IRI does not end in an NCName, or a literal contains an illegal character.
    """
    names = _Names(prefixes, source)
    yield b'<?xml version="1.0" encoding="UTF-8"?>\n<rdf:RDF'
    yield "".join(f'\n  xmlns:{prefix}="{xml_attribute(iri)}"' for iri, prefix in names.by_iri.items()).encode()
    yield b">\n"
    runs = groupby(triples, key=lambda triple: triple.subject)
    while piece := "".join(_description(subject, run, names) for subject, run in islice(runs, _SUBJECTS)):
        yield piece.encode()
    yield b"</rdf:RDF>\n"


class _Names:
    """Qualified element names of property IRIs."""

    def __init__(self, prefixes: Mapping[str, str], source: str) -> None:
        self.source = source
        usable = {iri: prefix for prefix, iri in sorted(prefixes.items()) if _PREFIX.match(prefix) and prefix != "rdf"}
        self.by_iri = {RDF.iri: "rdf", **{iri: prefix for iri, prefix in usable.items() if prefix[:3].lower() != "xml"}}
        self._known: dict[str, tuple[str, str]] = {}

    def element(self, iri: str) -> tuple[str, str]:
        """Return the element name and its namespace declaration, if needed."""
        if iri not in self._known:
            self._known[iri] = self._find(iri)
        return self._known[iri]

    def _find(self, iri: str) -> tuple[str, str]:
        found = _NAME.match(iri)
        if found is None or not found[1] or (found[1] == RDF.iri and found[2] in _RESERVED):
            raise GraphError(
                f"{self.source}: the property <{iri}> does not end in an XML name, as RDF/XML requires; "
                "choose .ttl, .nt or .jsonld"
            )
        namespace, name = found.groups()
        known = self.by_iri.get(namespace)
        return (f"{known}:{name}", "") if known else (f"p:{name}", f' xmlns:p="{xml_attribute(namespace)}"')


def _description(subject: ox.NamedNode | ox.BlankNode | ox.Triple, run: Iterator[ox.Triple], names: _Names) -> str:
    about = _reference(subject, "about")
    lines = "".join(_property(triple, names) for triple in run)
    return f"  <rdf:Description {about}>\n{lines}  </rdf:Description>\n"


def _property(triple: ox.Triple, names: _Names) -> str:
    refuse_rdf12(triple, "RDF/XML", names.source)
    name, declaration = names.element(triple.predicate.value)
    value = triple.object
    if not isinstance(value, ox.Literal):
        return f"    <{name}{declaration} {_reference(value, 'resource')}/>\n"
    if wrong := find_illegal_character(value.value):
        raise GraphError(
            f"{names.source}: a value of <{triple.predicate.value}> of {triple.subject} contains {wrong!r}; "
            "XML cannot represent it, choose .ttl, .nt or .jsonld"
        )
    if value.language:
        kind = f' xml:lang="{value.language}"'
    elif value.datatype.value.endswith("#string"):
        kind = ""
    else:
        kind = f' rdf:datatype="{xml_attribute(value.datatype.value)}"'
    return f"    <{name}{declaration}{kind}>{xml_text(value.value)}</{name}>\n"


def _reference(node: ox.NamedNode | ox.BlankNode | ox.Triple, attribute: str) -> str:
    if isinstance(node, ox.BlankNode):
        return f'rdf:nodeID="{_node_id(node.value)}"'
    assert isinstance(node, ox.NamedNode), "triple terms were refused"
    return f'rdf:{attribute}="{xml_attribute(node.value)}"'


def _node_id(label: str) -> str:
    """Return an NCName for a blank node label; different labels have different names."""
    found = _NAME.match(label)
    is_name = found is not None and not found[1] and not label.startswith("b_")
    return label if is_name else f"b_{label}"
