"""Example queries of the page: the ready questions, with parameters from the served graph."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import pyoxigraph as ox

from usd2kg.graph.vocabulary import PREFIXES, RDFS
from usd2kg.query.questions import Parameter, Question, list_questions, parse_number

__all__ = ["ExampleQuery", "make_examples"]

# A sample is enough for examples, and takes milliseconds on any graph.
_BEST = """
SELECT ?o (COUNT(DISTINCT ?x) AS ?n) WHERE {{
  {{ SELECT ?x ?o WHERE {{ {pattern} }} LIMIT 2000 }}
}} GROUP BY ?o ORDER BY DESC(?n) ?o LIMIT 1"""
_SUPPORT = _BEST.format(pattern="?x soma:isOntopOf|u2k:on ?o")
_OBJECT = "SELECT ?o WHERE { ?o u2k:primPath ?p } ORDER BY ?o LIMIT 1"
_CLASS = """
SELECT ?c (COUNT(*) AS ?n) WHERE {
  { SELECT ?o WHERE { ?o u2k:primPath ?p } LIMIT 2000 }
  ?o a ?c . ?c a owl:Class ; rdfs:label ?l
} GROUP BY ?c ORDER BY DESC(?n) ?c LIMIT 1"""
_POSITION = "SELECT ?center WHERE {{ {object} (soma:hasShape/dul:hasRegion)?/u2k:boxCenter ?center }} LIMIT 1"
_FIRST = "count"
"""Id of the initial question on the page; every graph answers it."""

_Term = ox.NamedNode | ox.Literal


@dataclass(frozen=True)
class ExampleQuery:
    """A query with its question in English."""

    title: str
    query: str


def make_examples(store: ox.Store) -> tuple[ExampleQuery, ...]:
    """Return the ready questions as queries, with each parameter replaced by a term of the store or its default.

    Questions about relations or values that the store lacks are left out, and those about two objects.
    """
    thing = _first(store, _SUPPORT) or _first(store, _OBJECT)
    terms = {
        "object": thing,
        "class": _first(store, _CLASS),
        "position": None if thing is None else _first(store, _POSITION.format(object=thing)),
    }
    about_one = [q for q in list_questions() if [p.kind for p in q.parameters].count("object") < 2]
    questions = sorted(about_one, key=lambda question: question.id != _FIRST)
    return tuple(example for q in questions if (example := _fill(store, q, terms)) is not None)


def _fill(store: ox.Store, question: Question, terms: Mapping[str, _Term | None]) -> ExampleQuery | None:
    """Return a question with each parameter replaced by a term; None if the graph has no suitable term."""
    if question.example:
        best = _first(store, _BEST.format(pattern=question.example))
        if best is None:
            return None
        terms = {**terms, "object": best}
    title, bound = question.text, {}
    for parameter in question.parameters:
        term = _term(parameter, terms)
        if term is None:
            return None
        bound[parameter] = term
        unit = f" {parameter.kind}" if parameter.kind in {"m", "kg"} else ""
        title = title.replace(f"{{{parameter.name}}}", _shown(store, term) + unit)
    return ExampleQuery(
        title, f"# {_line(title)}\n{question.bind({parameter: [term] for parameter, term in bound.items()})}"
    )


def _term(parameter: Parameter, terms: Mapping[str, _Term | None]) -> _Term | None:
    if parameter.kind in terms:
        return terms[parameter.kind]
    return None if parameter.default is None else ox.Literal(parse_number(parameter.default, parameter.kind))


def _shown(store: ox.Store, term: _Term) -> str:
    if isinstance(term, ox.Literal):
        return str(term.value)
    labels = sorted(_labels(store, term))
    return labels[0] if labels else term.value


def _labels(store: ox.Store, term: ox.NamedNode) -> Iterator[str]:
    found = (quad.object for quad in store.quads_for_pattern(term, RDFS.label, None))
    return (label.value for label in found if isinstance(label, ox.Literal))


def _line(text: str) -> str:
    return " ".join(text.split())


def _first(store: ox.Store, query: str) -> _Term | None:
    """Return the first value of the first row; None without one."""
    found = store.query(query, prefixes=PREFIXES, use_default_graph_as_union=True)
    assert isinstance(found, ox.QuerySolutions)
    node = next((row[0] for row in found), None)
    return node if isinstance(node, ox.NamedNode | ox.Literal) else None
