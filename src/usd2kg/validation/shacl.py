"""Compile the package's SHACL shapes to SPARQL, which is much faster than a SHACL processor.

The compiler supports the subset of SHACL Core that those shapes use: targets by class, subjects and objects of a
property; predicate, sequence and inverse paths; counts, bounds, patterns, node kinds, lessThanOrEquals, qualified
shapes with sh:class or sh:not sh:in, and sh:or of properties with a minimum count.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.vocabulary import RDF, Namespace
from usd2kg.validation.finding import Severity

__all__ = ["ShapeRule", "Violation", "compile_shapes", "find_violations", "read_shapes"]

_PROFILES = ("soma", "plain")
SH = Namespace("http://www.w3.org/ns/shacl#")
_SEVERITIES = {SH.Violation: Severity.ERROR, SH.Warning: Severity.WARNING, SH.Info: Severity.NOTE}
_BOUNDS = {"minInclusive": ">=", "maxInclusive": "<=", "minExclusive": ">", "maxExclusive": "<"}
_DESCRIBING = {RDF.type, SH.path, SH.severity, SH.message, SH.description, SH.property}
_TARGETS = {
    SH.targetClass: "?focus a {}",
    SH.targetSubjectsOf: "?focus {} ?_o",
    SH.targetObjectsOf: "?_s {} ?focus",
}

Node = Any
"""A term of the shapes graph; pyoxigraph's union types would need a cast at each use."""


@dataclass(frozen=True)
class ShapeRule:
    """One shape as queries that return each `?focus` that violates it, with the `?value` or the `?count`."""

    id: str
    severity: Severity
    expected: str
    advice: str
    queries: tuple[str, ...]


@dataclass(frozen=True)
class Violation:
    """A focus node that violates a shape."""

    rule: ShapeRule
    focus: Node
    found: tuple[str, ...]
    """The violating values, or their number."""


def read_shapes(profile: str) -> str:
    """Return the SHACL shapes of a profile, `soma` or `plain`, as Turtle.

    Raises:
        GraphError: the profile is unknown.
    """
    if profile not in _PROFILES:
        raise GraphError(f"profile {profile!r} has no shapes; expected one of {', '.join(_PROFILES)}")
    return (files("usd2kg.validation") / f"shapes-{profile}.ttl").read_text("utf-8")


@cache
def compile_shapes(profile: str) -> tuple[ShapeRule, ...]:
    """Return a profile's shapes as rules, sorted by id."""
    return tuple(sorted(_Compiler(read_shapes(profile)).rules(), key=lambda rule: rule.id))


def find_violations(store: ox.Store, rule: ShapeRule) -> Iterator[Violation]:
    """Yield each focus node that violates a rule, once."""
    broken: dict[Node, dict[str, None]] = {}
    for query in rule.queries:
        solutions: Any = store.query(query, use_default_graph_as_union=True)
        names = {variable.value for variable in solutions.variables}
        for row in solutions:
            found = broken.setdefault(row["focus"], {})
            if "count" in names:
                found[f"{row['count'].value} values"] = None
            elif "value" in names:
                found[_text(row["value"])] = None
    for focus, found in broken.items():
        yield Violation(rule, focus, tuple(sorted(found)) or ("none",))


def _text(term: Node) -> str:
    return str(term) if isinstance(term, ox.Triple) else str(term.value)


class _Compiler:
    """Compiles a shapes graph to queries."""

    def __init__(self, text: str) -> None:
        self._store = ox.Store()
        self._store.load(text.encode(), format=ox.RdfFormat.TURTLE)

    def rules(self) -> Iterator[ShapeRule]:
        for quad in self._store.quads_for_pattern(None, RDF.type, SH.NodeShape):
            node = quad.subject
            targets = [
                pattern.format(value) for name, pattern in _TARGETS.items() for value in self._values(node, name)
            ]
            target = " UNION ".join(f"{{ {pattern} }}" for pattern in targets)
            focus = f"{{ SELECT DISTINCT ?focus WHERE {{ {target} }} }}"
            for shape in self._values(node, SH.property):
                yield self._rule(shape, focus)
            if self._values(node, SH["or"]):
                yield self._rule(node, focus)

    def _values(self, node: Node, name: ox.NamedNode) -> list[Node]:
        return sorted((quad.object for quad in self._store.quads_for_pattern(node, name, None)), key=str)

    def _value(self, node: Node, name: ox.NamedNode) -> Node:
        values = self._values(node, name)
        return values[0] if values else None

    def _list(self, node: Node) -> Iterator[Node]:
        while node != RDF.nil:
            yield self._value(node, RDF.first)
            node = self._value(node, RDF.rest)

    def _rule(self, shape: Node, focus: str) -> ShapeRule:
        return ShapeRule(
            id=shape.value.rpartition("#")[2],
            severity=_SEVERITIES[self._value(shape, SH.severity)],
            expected=self._value(shape, SH.message).value,
            advice=self._value(shape, SH.description).value,
            queries=tuple(self._queries(shape, focus)),
        )

    def _path(self, shape: Node) -> str:
        path = self._value(shape, SH.path)
        if isinstance(path, ox.NamedNode):
            return str(path)
        inverse = self._value(path, SH.inversePath)
        return f"^{inverse}" if inverse is not None else "/".join(map(str, self._list(path)))

    def _queries(self, shape: Node, focus: str) -> Iterator[str]:
        qualified = self._value(shape, SH.qualifiedValueShape)
        for quad in self._store.quads_for_pattern(shape, None, None):
            name, value = quad.predicate, quad.object
            if name in _DESCRIBING or name in _TARGETS or name == SH.qualifiedValueShape:
                continue
            yield self._query(name.value.rpartition("#")[2], value, shape, focus, qualified)

    def _query(self, name: str, value: Node, shape: Node, focus: str, qualified: Node) -> str:
        if name == "or":
            absent = " ".join(f"FILTER NOT EXISTS {{ ?focus {self._path(member)} ?v }}" for member in self._list(value))
            return f"SELECT ?focus WHERE {{ {focus} {absent} }}"
        path = self._path(shape)
        values = f"?focus {path} ?v . {self._qualified(qualified)}" if qualified is not None else f"?focus {path} ?v ."
        match name:
            case "minCount" | "qualifiedMinCount":
                # With NOT EXISTS, the engine scans all members of the qualified class for each focus.
                return f"SELECT ?focus WHERE {{ {focus} MINUS {{ {values} }} }}"
            case "maxCount" | "qualifiedMaxCount":
                return (
                    f"SELECT ?focus (COUNT(DISTINCT ?v) AS ?count) WHERE {{ {focus} {values} }} "
                    f"GROUP BY ?focus HAVING (COUNT(DISTINCT ?v) > {value.value})"
                )
            case "lessThanOrEquals":
                return _filtered(focus, f"?focus {path} ?value ; {value} ?other .", "?value <= ?other")
        return _filtered(focus, f"?focus {path} ?value .", _condition(name, value))

    def _qualified(self, shape: Node) -> str:
        cls = self._value(shape, SH["class"])
        if cls is not None:
            return f"?v a {cls} ."
        members = self._list(self._value(self._value(shape, SH["not"]), SH["in"]))
        return f"FILTER(?v NOT IN ({', '.join(map(str, members))}))"


def _filtered(focus: str, values: str, condition: str) -> str:
    # Incomparable values, such as a string and a number, violate a bound (SHACL, section 4.3).
    return f"SELECT ?focus ?value WHERE {{ {focus} {values} FILTER(!COALESCE({condition}, false)) }}"


def _condition(name: str, value: Node) -> str:
    if name in _BOUNDS:
        return f"?value {_BOUNDS[name]} {value}"
    if name == "pattern":
        return f"REGEX(STR(?value), {value})"
    if name == "nodeKind" and value == SH.Literal:
        return "ISLITERAL(?value)"
    raise GraphError(f"shapes: sh:{name} is not supported; run these shapes with a SHACL processor")
