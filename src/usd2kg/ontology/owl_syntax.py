"""Class axioms from OWL syntaxes (functional, Manchester, OWL/XML), by py-horned-owl."""

from collections.abc import Iterator
from typing import Any, Literal
from xml.etree import ElementTree

import pyhornedowl

from usd2kg.ontology.class_axioms import HAS_DISPOSITION, ClassAxioms
from usd2kg.ontology.nesting import refuse_deep_nesting
from usd2kg.ontology.xml_entities import refuse_entity_bomb

__all__ = ["owl_as_rdf", "read_owl_axioms"]


def read_owl_axioms(text: str, syntax: Literal["ofn", "omn", "owx"]) -> ClassAxioms:
    """Return the axioms of a document; `syntax` is `ofn`, `omn` or `owx`.

    Raises:
        ValueError, SyntaxError: the text does not parse.
    """
    axioms = ClassAxioms()
    ontology = _open(text, syntax)
    axioms.prefixes = dict(ontology.prefix_mapping)
    for item in ontology.get_components():
        handler = _HANDLERS.get(type(item.component).__name__)
        if handler is not None:
            handler(item.component, axioms)
    return axioms


def owl_as_rdf(text: str, syntax: Literal["ofn", "omn", "owx"]) -> str:
    """Return a document as RDF/XML; `syntax` is `ofn`, `omn` or `owx`.

    Raises:
        ValueError, SyntaxError: the text does not parse.
    """
    return str(_open(text, syntax).save_to_string("rdf"))


def _open(text: str, syntax: Literal["ofn", "omn", "owx"]) -> Any:
    if syntax == "owx":
        refuse_entity_bomb(text)
    refuse_deep_nesting(text, syntax)
    if syntax == "owx":
        # py-horned-owl does not return from a document that ends inside a literal.
        ElementTree.fromstring(text)
    return pyhornedowl.open_ontology_from_string(text, serialization=syntax)


def _identify(component: Any, axioms: ClassAxioms) -> None:
    axioms.ontology_iri = str(component.iri) if component.iri else None
    axioms.version_iri = str(component.viri) if component.viri else None


def _import(component: Any, axioms: ClassAxioms) -> None:
    axioms.imports.add(str(component.first))


def _declare(component: Any, axioms: ClassAxioms) -> None:
    axioms.declare(str(component.first.first))


def _subclass(component: Any, axioms: ClassAxioms) -> None:
    child = _named(component.sub)
    if child is not None:
        _add_superclass(child, component.sup, axioms)


def _equivalent(component: Any, axioms: ClassAxioms) -> None:
    named = [iri for expression in component.first if (iri := _named(expression))]
    axioms.add_equivalents(named)
    for expression in component.first:
        if type(expression).__name__ == "ObjectIntersectionOf":
            for iri in named:
                _add_superclass(iri, expression, axioms)


def _add_superclass(child: str, expression: Any, axioms: ClassAxioms) -> None:
    for part in _conjuncts(expression):
        parent = _named(part)
        if parent is not None:
            axioms.add_parent(child, parent)
        elif type(part).__name__ == "ObjectSomeValuesFrom" and _property(part.ope) == HAS_DISPOSITION:
            axioms.dispositions[child].update(iri for fill in _conjuncts(part.bce) if (iri := _named(fill)))


def _conjuncts(expression: Any) -> Iterator[Any]:
    pending = [expression]
    while pending:
        part = pending.pop()
        if type(part).__name__ == "ObjectIntersectionOf":
            pending.extend(reversed(part.first))
        else:
            yield part


def _named(expression: Any) -> str | None:
    return str(expression.first) if type(expression).__name__ == "Class" else None


def _property(expression: Any) -> str:
    return str(expression.first) if type(expression).__name__ == "ObjectProperty" else ""


def _annotate(component: Any, axioms: ClassAxioms) -> None:
    value = component.ann.av
    text = getattr(value, "literal", None)
    if text is not None:
        axioms.annotate(str(component.subject), str(component.ann.ap.first), text, getattr(value, "lang", ""))
    else:
        axioms.link(str(component.subject), str(component.ann.ap.first), str(value))


_HANDLERS = {
    "OntologyID": _identify,
    "Import": _import,
    "DeclareClass": _declare,
    "SubClassOf": _subclass,
    "EquivalentClasses": _equivalent,
    "AnnotationAssertion": _annotate,
}
