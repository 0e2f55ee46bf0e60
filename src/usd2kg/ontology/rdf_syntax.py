"""Class axioms from RDF syntaxes (RDF/XML, Turtle, N-Triples, JSON-LD), by pyoxigraph.

The triples are read directly, without an OWL parser: much published RDF is not valid OWL (plain `rdfs:Class`,
undeclared annotation properties, SHACL shapes as classes), but has a usable hierarchy.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Any

import pyoxigraph as ox

from usd2kg.ontology.class_axioms import HAS_DISPOSITION, ClassAxioms
from usd2kg.ontology.namespaces import OWL, RDF, RDFS, XSD
from usd2kg.ontology.nesting import refuse_deep_nesting
from usd2kg.ontology.xml_entities import refuse_entity_bomb

__all__ = ["parse_rdf", "read_rdf_axioms"]

_CLASS_TYPES = (f"{OWL}Class", f"{RDFS}Class")
_FORMATS = {
    "rdf": ox.RdfFormat.RDF_XML,
    "ttl": ox.RdfFormat.TURTLE,
    "jsonld": ox.RdfFormat.JSON_LD,
}

_XMLNS = re.compile(r"xmlns:([\w.-]+)\s*=\s*[\"']([^\"'&<>]+)[\"']")
"""Prefix declaration of an XML document; declarations that use entities do not match."""
_Triples = dict[Any, dict[str, list[Any]]]
"""Subject → predicate IRI → objects."""


def parse_rdf(text: str, syntax: str) -> ox.QuadParser:
    """Return the statements of a document; `syntax` is `rdf`, `ttl` or `jsonld`.

    Raises:
        SyntaxError: the text does not parse (raised while the quads are consumed), its XML entities expand too far, or
            it is nested too deeply.
    """
    if syntax == "rdf":
        refuse_entity_bomb(text)
    refuse_deep_nesting(text, syntax)
    # Some documents use relative IRIs without declaring a base.
    return ox.parse(text, format=_FORMATS[syntax], base_iri="http://example.org/")


def read_rdf_axioms(text: str, syntax: str) -> ClassAxioms:
    """Return the axioms of a document; `syntax` is `rdf`, `ttl` or `jsonld`.

    Raises:
        SyntaxError: the text does not parse.
    """
    triples: _Triples = defaultdict(lambda: defaultdict(list))
    quads = parse_rdf(text, syntax)
    for quad in quads:
        triples[quad.subject][quad.predicate.value].append(quad.object)
    # The RDF/XML parser does not report prefixes.
    declared = _XMLNS.findall(text) if syntax == "rdf" else quads.prefixes.items()
    axioms = ClassAxioms(prefixes=dict(declared))
    for subject, statements in triples.items():
        if isinstance(subject, ox.NamedNode):
            _read_subject(subject.value, statements, triples, axioms)
    return axioms


def _read_subject(iri: str, statements: dict[str, list[Any]], triples: _Triples, axioms: ClassAxioms) -> None:
    types = set(_iris(statements.get(f"{RDF}type", ())))
    if f"{OWL}Ontology" in types:
        axioms.ontology_iri = iri
        axioms.version_iri = next(iter(_iris(statements.get(f"{OWL}versionIRI", ()))), None)
        axioms.imports.update(_iris(statements.get(f"{OWL}imports", ())))
        return
    if not types.isdisjoint(_CLASS_TYPES):
        axioms.declare(iri)
    for node in statements.get(f"{RDFS}subClassOf", ()):
        _add_superclass(iri, node, triples, axioms)
    for node in statements.get(f"{OWL}equivalentClass", ()):
        if _is_intersection(node, triples):
            _add_superclass(iri, node, triples, axioms)
        elif isinstance(node, ox.NamedNode) and not _is_datatype(types, node, triples):
            axioms.add_equivalents((iri, node.value))
    for predicate, objects in statements.items():
        for node in objects:
            if isinstance(node, ox.Literal):
                axioms.annotate(iri, predicate, node.value, node.language or "")
            elif isinstance(node, ox.NamedNode):
                axioms.link(iri, predicate, node.value)


def _iris(nodes: Iterable[Any]) -> list[str]:
    """Return the IRIs among nodes; literals, blank nodes and triple terms are left out."""
    return [node.value for node in nodes if isinstance(node, ox.NamedNode)]


def _add_superclass(child: str, expression: Any, triples: _Triples, axioms: ClassAxioms) -> None:
    for part in _conjuncts(expression, triples):
        if isinstance(part, ox.NamedNode):
            axioms.add_parent(child, part.value)
            continue
        restriction = triples.get(part, {})
        if _iris(restriction.get(f"{OWL}onProperty", ())) == [HAS_DISPOSITION]:
            fillers = [f for node in restriction.get(f"{OWL}someValuesFrom", ()) for f in _conjuncts(node, triples)]
            axioms.dispositions[child].update(_iris(fillers))


def _is_datatype(types: set[str], other: ox.NamedNode, triples: _Triples) -> bool:
    # owl:equivalentClass also defines datatypes.
    datatype = ox.NamedNode(f"{RDFS}Datatype")
    is_other = other.value.startswith(XSD) or datatype in triples.get(other, {}).get(f"{RDF}type", ())
    return datatype.value in types or is_other


def _is_intersection(node: Any, triples: _Triples) -> bool:
    return isinstance(node, ox.BlankNode) and f"{OWL}intersectionOf" in triples.get(node, {})


def _conjuncts(node: Any, triples: _Triples) -> Iterator[Any]:
    """Yield the conjuncts of an intersection, with nested ones flattened; another node is its only conjunct."""
    pending, seen = [node], set()
    while pending:
        part = pending.pop()
        if not _is_intersection(part, triples):
            yield part
        elif part not in seen:
            # Blank nodes may form a cycle.
            seen.add(part)
            inside = [item for head in triples[part][f"{OWL}intersectionOf"] for item in _list(head, triples)]
            pending.extend(reversed(inside))


def _list(head: Any, triples: _Triples) -> Iterator[Any]:
    seen = set()
    while head in triples and head not in seen:
        seen.add(head)
        yield from triples[head].get(f"{RDF}first", ())
        head = next(iter(triples[head].get(f"{RDF}rest", ())), None)
