"""SPARQL operations that delete a structure of blank nodes exactly."""

from collections.abc import Iterator
from itertools import combinations

import pyoxigraph as ox

from usd2kg.diff.blank_nodes import Component, Term

__all__ = ["format_structure_deletion"]


def format_structure_deletion(component: Component, graph: str | None) -> str:
    """Return the operation that deletes every structure isomorphic to a component, and nothing else.

    The graph pattern of the component alone also matches parts of larger structures, and two of its variables can bind
    the same node. Filters therefore require distinct blank nodes without further statements.
    """
    names = {node: f"?b{i}" for i, node in enumerate(component.nodes)}
    pattern = [tuple(_format_term(term, names) for term in triple) for triple in component.triples]
    lines = "".join(f"{' '.join(each)} .\n" for each in pattern)
    filters = "".join(f"FILTER({test})\n" for test in _node_tests(list(names.values())))
    closed = "".join(_no_other_statement(name, pattern) for name in names.values())
    start = "" if graph is None else f"WITH <{graph}>\n"
    return f"{start}DELETE {{\n{lines}}} WHERE {{\n{lines}{filters}{closed}}}"


def _format_term(term: Term, names: dict[ox.BlankNode, str]) -> str:
    if isinstance(term, ox.BlankNode):
        return names[term]
    if isinstance(term, ox.Triple):
        return f"<<( {' '.join(_format_term(part, names) for part in term)} )>>"
    return str(term)


def _node_tests(names: list[str]) -> Iterator[str]:
    yield from (f"isBlank({name})" for name in names)
    yield from (f"!sameTerm({one}, {other})" for one, other in combinations(names, 2))


def _no_other_statement(name: str, pattern: list[tuple[str, ...]]) -> str:
    """Return filters that require that a node occurs in no statement outside the pattern."""
    as_subject = [f"(sameTerm(?p, {p}) && sameTerm(?o, {o}))" for s, p, o in pattern if s == name]
    as_object = [f"(sameTerm(?p, {p}) && sameTerm(?s, {s}))" for s, p, o in pattern if o == name]
    outward = f"FILTER NOT EXISTS {{ {name} ?p ?o . FILTER(!({' || '.join(as_subject) or 'false'})) }}\n"
    return outward + f"FILTER NOT EXISTS {{ ?s ?p {name} . FILTER(!({' || '.join(as_object) or 'false'})) }}\n"
