"""Patterns that fit one structure of blank nodes and nothing larger."""

from collections.abc import Iterator
from itertools import combinations

import pyoxigraph as ox

from usd2kg.diff.blank_nodes import Component, Term

__all__ = ["delete_structure"]


def delete_structure(component: Component, graph: str | None) -> str:
    """Return the operation that deletes every structure which states the same as this one, and no other.

    A pattern alone would fit part of a larger structure, too, and one node in place of two: so each node must be blank,
    no two the same, and no node may have a statement more.
    """
    names = {node: f"?b{i}" for i, node in enumerate(component.nodes)}
    pattern = [tuple(_text(term, names) for term in triple) for triple in component.triples]
    lines = "".join(f"{' '.join(each)} .\n" for each in pattern)
    filters = "".join(f"FILTER({test})\n" for test in _tests(list(names.values())))
    limits = "".join(_nothing_more(name, pattern) for name in names.values())
    start = "" if graph is None else f"WITH <{graph}>\n"
    return f"{start}DELETE {{\n{lines}}} WHERE {{\n{lines}{filters}{limits}}}"


def _text(term: Term, names: dict[ox.BlankNode, str]) -> str:
    if isinstance(term, ox.BlankNode):
        return names[term]
    if isinstance(term, ox.Triple):
        return f"<<( {' '.join(_text(part, names) for part in term)} )>>"
    return str(term)


def _tests(names: list[str]) -> Iterator[str]:
    yield from (f"isBlank({name})" for name in names)
    yield from (f"!sameTerm({one}, {other})" for one, other in combinations(names, 2))


def _nothing_more(name: str, pattern: list[tuple[str, ...]]) -> str:
    """Return that a node has no statements but those of the pattern, neither from it nor to it."""
    said = [f"(sameTerm(?p, {p}) && sameTerm(?o, {o}))" for s, p, o in pattern if s == name]
    of_it = [f"(sameTerm(?p, {p}) && sameTerm(?s, {s}))" for s, p, o in pattern if o == name]
    outward = f"FILTER NOT EXISTS {{ {name} ?p ?o . FILTER(!({' || '.join(said) or 'false'})) }}\n"
    return outward + f"FILTER NOT EXISTS {{ ?s ?p {name} . FILTER(!({' || '.join(of_it) or 'false'})) }}\n"
