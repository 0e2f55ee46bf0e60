"""render: query results in the media types of SPARQL and RDF, cut at the limits of rows and bytes."""

import itertools
import json
import re
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple
from xml.sax.saxutils import escape, quoteattr

import pyoxigraph as ox

from usd2kg.endpoint.endpoint_limits import EndpointLimits
from usd2kg.graph.vocabulary import PREFIXES

__all__ = ["GRAPH_TYPES", "TABLE_TYPES", "Rendered", "render"]

_XSD_STRING = "http://www.w3.org/2001/XMLSchema#string"

TABLE_TYPES = (
    "application/sparql-results+json",
    "application/sparql-results+xml",
    "text/csv",
    "text/tab-separated-values",
    "application/json",
    "application/xml",
)
"""Media types of SELECT and ASK results, the default first."""
_RDF_FORMATS = {
    "text/turtle": ox.RdfFormat.TURTLE,
    "application/n-triples": ox.RdfFormat.N_TRIPLES,
    "application/rdf+xml": ox.RdfFormat.RDF_XML,
    "application/ld+json": ox.RdfFormat.JSON_LD,
}
GRAPH_TYPES = tuple(_RDF_FORMATS)
"""Media types of CONSTRUCT and DESCRIBE results, the default first."""

Row = Sequence[Any]


class Rendered(NamedTuple):
    """A serialised answer."""

    body: bytes
    rows: int
    is_cut: bool
    """Whether the limits cut off rows."""


def render(found: Any, media_type: str, limits: EndpointLimits) -> Rendered:
    """Return pyoxigraph's results in a media type, cut at the limit of rows; tables also at the limit of bytes."""
    if isinstance(found, ox.QueryBoolean):
        return Rendered(_boolean(bool(found), media_type).encode(), 1, False)
    if isinstance(found, ox.QueryTriples):
        kept = list(itertools.islice(found, limits.rows + 1))
        rdf_format = _RDF_FORMATS[media_type]
        prefixes = PREFIXES if rdf_format == ox.RdfFormat.TURTLE else None
        text = ox.serialize(kept[: limits.rows], format=rdf_format, prefixes=prefixes)
        assert text is not None, "without an output file, serialize returns the bytes"
        if rdf_format == ox.RdfFormat.RDF_XML:
            text = _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text.decode()).encode()
        return Rendered(text, min(len(kept), limits.rows), len(kept) > limits.rows)
    names = [variable.value for variable in found.variables]
    head, line, separator, tail = _WRITERS[media_type](names)
    body, rows = bytearray(head.encode()), 0
    for solution in found:
        if rows == limits.rows or len(body) > limits.answer_bytes:
            return Rendered(bytes(body) + tail.encode(), rows, True)
        body += ((separator if rows else "") + line([solution[name] for name in names])).encode()
        rows += 1
    return Rendered(bytes(body) + tail.encode(), rows, False)


class _Writer(NamedTuple):
    head: str
    line: Callable[[Row], str]
    separator: str
    tail: str


def _json(names: list[str]) -> _Writer:
    """Return a writer of the SPARQL 1.1 Query Results JSON Format."""

    def line(row: Row) -> str:
        return json.dumps({name: _json_term(term) for name, term in zip(names, row, strict=True) if term is not None})

    head = f'{{"head":{json.dumps({"vars": names})},"results":{{"bindings":[\n'
    return _Writer(head, line, ",\n", "\n]}}\n")


def _json_term(term: Any) -> dict[str, Any]:
    if isinstance(term, ox.NamedNode):
        return {"type": "uri", "value": term.value}
    if isinstance(term, ox.BlankNode):
        return {"type": "bnode", "value": term.value}
    if isinstance(term, ox.Triple):
        parts = zip(("subject", "predicate", "object"), term, strict=False)
        return {"type": "triple", "value": {name: _json_term(part) for name, part in parts}}
    about = {"xml:lang": term.language} if term.language else {}
    if not term.language and term.datatype.value != _XSD_STRING:
        about = {"datatype": term.datatype.value}
    return {"type": "literal", "value": term.value, **about}


def _xml(names: list[str]) -> _Writer:
    """Return a writer of the SPARQL Query Results XML Format."""

    def line(row: Row) -> str:
        bound = ((name, term) for name, term in zip(names, row, strict=True) if term is not None)
        cells = "".join(f"<binding name={quoteattr(name)}>{_xml_term(term)}</binding>" for name, term in bound)
        return f"<result>{cells}</result>"

    variables = "".join(f"<variable name={quoteattr(name)}/>" for name in names)
    return _Writer(f"{_XML_HEAD}<head>{variables}</head><results>\n", line, "\n", "\n</results></sparql>\n")


_XML_HEAD = '<?xml version="1.0"?>\n<sparql xmlns="http://www.w3.org/2005/sparql-results#">'


_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that RDF allows and XML 1.0 excludes even as references (section 2.2)."""


def _xml_text(text: str) -> str:
    """Return a text as XML; characters that XML excludes become U+FFFD (JSON, CSV and TSV keep them)."""
    return escape(_NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text), {"\r": "&#13;"})


def _xml_term(term: Any) -> str:
    if isinstance(term, ox.NamedNode):
        return f"<uri>{_xml_text(term.value)}</uri>"
    if isinstance(term, ox.BlankNode):
        return f"<bnode>{_xml_text(term.value)}</bnode>"
    if isinstance(term, ox.Triple):
        parts = zip(("subject", "predicate", "object"), term, strict=False)
        return "<triple>" + "".join(f"<{name}>{_xml_term(part)}</{name}>" for name, part in parts) + "</triple>"
    about = f" xml:lang={quoteattr(term.language)}" if term.language else ""
    if not term.language and term.datatype.value != _XSD_STRING:
        about = f" datatype={quoteattr(term.datatype.value)}"
    return f"<literal{about}>{_xml_text(term.value)}</literal>"


def _csv(names: list[str]) -> _Writer:
    """Return a writer of SPARQL 1.1 Query Results CSV: values without types."""

    def cell(term: Any) -> str:
        text = "" if term is None else _plain(term)
        return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\r\n') else text

    return _Writer(",".join(names) + "\r\n", lambda row: ",".join(map(cell, row)) + "\r\n", "", "")


def _plain(term: Any) -> str:
    if isinstance(term, ox.BlankNode | ox.Triple):
        return str(term)
    return str(term.value)


def _tsv(names: list[str]) -> _Writer:
    """Return a writer of SPARQL 1.1 Query Results TSV: terms in SPARQL syntax."""

    def line(row: Row) -> str:
        return "\t".join("" if term is None else str(term).replace("\t", "\\t") for term in row) + "\n"

    return _Writer("\t".join(f"?{name}" for name in names) + "\n", line, "", "")


_WRITERS: dict[str, Callable[[list[str]], _Writer]] = dict(
    zip(TABLE_TYPES, (_json, _xml, _csv, _tsv, _json, _xml), strict=True)
)


def _boolean(value: bool, media_type: str) -> str:
    text = str(value).lower()
    if media_type.endswith("json"):
        return f'{{"head":{{}},"boolean":{text}}}\n'
    return f"{_XML_HEAD}<head/><boolean>{text}</boolean></sparql>\n" if media_type.endswith("xml") else f"{text}\n"
