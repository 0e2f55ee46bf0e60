"""validate_graph: check a graph against shapes, its ontology and plausibility rules."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pyoxigraph as ox

from usd2kg.errors import GraphError
from usd2kg.graph.literal_numbers import parse_numbers
from usd2kg.graph.vocabulary import OWL, RDFS, U2K
from usd2kg.ontology import Closure, compact_iri
from usd2kg.query.graph_store import GraphStore
from usd2kg.tracing import traced
from usd2kg.validation.checked_scene import CheckedScene
from usd2kg.validation.clashes import find_clashes, read_axioms
from usd2kg.validation.elk import ElkAnswer
from usd2kg.validation.finding import Finding, Severity, sort_findings
from usd2kg.validation.graph_objects import (
    GraphObject,
    find_owner,
    profile_of,
    read_graph_objects,
    values_of,
)
from usd2kg.validation.object_classes import ObjectClasses
from usd2kg.validation.plausibility import SkippedCheck, find_implausible, find_skipped
from usd2kg.validation.plausibility_rules import Rules, read_rules
from usd2kg.validation.shacl import compile_shapes, find_violations

__all__ = ["ValidationReport", "imports_of", "ontology_of", "validate_graph"]

_CORRECT_ONTOLOGY = "Correct the ontology, or choose another class with a decision (usd2kg build --decisions)."
_CORRECT_STATEMENT = "Correct the class with a decision (usd2kg build --decisions), or remove one of these statements."


@dataclass(frozen=True)
class ValidationReport:
    """The findings about a graph."""

    profile: str
    objects: int
    findings: tuple[Finding, ...]
    """Sorted by severity and rule, see `sort_findings`."""
    skipped: tuple[SkippedCheck, ...] = ()
    """Plausibility rules that the graph lacks the facts for."""

    def counts(self) -> dict[str, int]:
        """Return severity → number of findings."""
        return {severity.value: sum(f.severity == severity for f in self.findings) for severity in Severity}


def ontology_of(graph: GraphStore) -> str | None:
    """Return the IRI of the ontology that a graph was grounded to; None if the graph does not state it."""
    return next((value.value for values in values_of(graph.store, U2K.ontologyIri).values() for value in values), None)


def imports_of(graph: GraphStore) -> tuple[str, ...]:
    """Return the IRIs of the ontologies that a graph imports, sorted."""
    return tuple(sorted(v.value for values in values_of(graph.store, OWL.imports).values() for v in values))


@traced("validate")
def validate_graph(
    graph: GraphStore,
    closure: Closure | None = None,
    rules: Rules | None = None,
    answer: ElkAnswer | None = None,
) -> ValidationReport:
    """Return the findings for a graph that usd2kg built.

    Args:
        graph: the graph.
        closure: the ontology that its objects were grounded to, with its imports; without it, contradictions with the
            ontology are not checked, and superclasses are those in the graph.
        rules: the plausibility rules; by default those of `plausibility.toml`.
        answer: the result of a reasoner, see `ask_elk`; None for no reasoner.

    Raises:
        GraphError: the graph contains no objects.
    """
    profile = profile_of(graph.store)
    if profile is None:
        raise GraphError(
            f"{graph.source}: contains no usd:Prim and no u2k:Object; expected a graph that usd2kg build wrote"
        )
    run = _Run(graph.store, closure)
    scene = run.scene(read_rules() if rules is None else rules)
    findings = [*run.shapes(profile), *run.clashes(), *run.implausible(scene)]
    if answer is not None and not answer.is_consistent:
        findings += run.inconsistencies(answer)
    return ValidationReport(profile, len(run.objects), sort_findings(findings), find_skipped(scene))


class _Run:
    """One graph under validation."""

    def __init__(self, store: ox.Store, closure: Closure | None) -> None:
        self._store = store
        self._closure = closure
        self._axioms = read_axioms(closure) if closure is not None else None
        self.objects = read_graph_objects(store)
        self._by_iri = {obj.iri: obj for obj in self.objects}

    def shapes(self, profile: str) -> Iterator[Finding]:
        """Yield the violations of the profile's shapes."""
        for rule in compile_shapes(profile):
            for violation in find_violations(self._store, rule):
                found = ", ".join(violation.found)
                yield self._finding(rule.severity, rule.id, violation.focus, found, rule.expected, rule.advice)

    def clashes(self) -> Iterator[Finding]:
        """Yield the contradictions with the ontology."""
        if self._axioms is not None and self._closure is not None:
            yield from find_clashes(self._store, self.objects, self._axioms, self._closure.missing, self._finding)

    def inconsistencies(self, answer: ElkAnswer) -> Iterator[Finding]:
        """Yield the inconsistencies that a reasoner reports."""
        for clash in answer.clashes:
            node = ox.NamedNode(clash.iri) if not clash.iri.startswith("_:") else ox.BlankNode(clash.iri[2:])
            if clash.impossible is not None:
                found = f"it is {compact_iri(clash.impossible)}, which is unsatisfiable in the ontology itself"
                rule, expected, advice = "elk-impossible-class", "a satisfiable class", _CORRECT_ONTOLOGY
            else:
                found = f"its statements: {'; '.join(clash.statements)}"
                rule, expected, advice = "elk-clash", "consistent statements", _CORRECT_STATEMENT
            yield self._finding(Severity.ERROR, rule, node, found, expected, advice)
        if not answer.clashes:
            found = "ELK finds the graph inconsistent, but no single individual contradictory"
            yield Finding(
                Severity.ERROR, "elk-inconsistent", "", "", "", found, "a consistent graph", _CORRECT_STATEMENT
            )

    def scene(self, rules: Rules) -> CheckedScene:
        """Return the objects prepared for the plausibility checks."""
        calibrated = values_of(self._store, U2K.isCalibrated).values()
        units = [v.value for values in values_of(self._store, U2K.metresPerUnit).values() for v in values]
        unit = parse_numbers(units[0]) if len(units) == 1 else ()
        return CheckedScene(
            self.objects,
            ObjectClasses(self._store, self._axioms, self.objects),
            rules,
            has_probabilities=not any(value.value in {"false", "0"} for values in calibrated for value in values),
            metres_per_unit=unit[0] if len(unit) == 1 and unit[0] > 0 else None,
        )

    def implausible(self, scene: CheckedScene) -> Iterator[Finding]:
        """Yield the violations of the plausibility rules."""
        for rule, (obj, found, expected) in find_implausible(scene):
            if obj is None:
                yield Finding(rule.severity, rule.id, "", "", "", found, expected, rule.advice)
            else:
                yield _about(obj, rule.severity, rule.id, obj.iri, found, expected, rule.advice)

    def _finding(self, severity: Severity, rule: str, node: Any, found: str, expected: str, advice: str) -> Finding:
        owner = find_owner(self._store, node, self._by_iri)
        name = node.value if isinstance(node, ox.NamedNode | ox.BlankNode | ox.Literal) else str(node)
        if owner is not None:
            return _about(owner, severity, rule, name, found, expected, advice)
        label, path = (self._text(node, term) for term in (RDFS.label, U2K.definingPrim))
        return Finding(severity, rule, label, path, name, found, expected, advice)

    def _text(self, node: Any, name: ox.NamedNode) -> str:
        if not isinstance(node, ox.NamedNode | ox.BlankNode):
            return ""
        values = (quad.object for quad in self._store.quads_for_pattern(node, name, None))
        return min((value.value for value in values if isinstance(value, ox.Literal)), default="")


def _about(
    obj: GraphObject, severity: Severity, rule: str, iri: str, found: str, expected: str, advice: str
) -> Finding:
    return Finding(severity, rule, obj.label, obj.prim_path, iri, found, expected, advice)
