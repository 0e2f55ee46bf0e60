"""Contradictions between a graph and its ontology: disjoint classes, domains, ranges, deprecated and unknown classes.

Only named classes, disjointness, domains and ranges are used. The check is sound but incomplete: a reasoner can find
further contradictions.
"""

from collections.abc import Callable, Iterator
from itertools import combinations
from typing import Any

import pyoxigraph as ox

from usd2kg.graph.declarations import vocabulary_triples
from usd2kg.graph.vocabulary import OWL, RDF
from usd2kg.ontology import Closure, compact_iri
from usd2kg.validation.axiom_index import AxiomIndex, Disjointness
from usd2kg.validation.finding import Finding, Severity
from usd2kg.validation.graph_objects import GraphObject, values_of

__all__ = ["find_clashes", "read_axioms"]

_CORRECT_CLASS = "Correct the class with a decision (usd2kg build --decisions), or remove the other statement."

FindingFactory = Callable[..., Finding]
"""(severity, rule, node, found, expected, advice) → finding about a node."""
_Types = frozenset[str]


def read_axioms(closure: Closure) -> AxiomIndex:
    """Return the axioms of an ontology, its imports and the u2k vocabulary."""
    return AxiomIndex((*closure.triples, *vocabulary_triples()))


def find_clashes(
    store: ox.Store, objects: list[GraphObject], axioms: AxiomIndex, missing: tuple[str, ...], make: FindingFactory
) -> Iterator[Finding]:
    """Yield each contradiction between a graph and an ontology.

    Args:
        store: the graph.
        objects: its objects.
        axioms: the axioms of the ontology.
        missing: IRIs of unavailable imports; classes in their namespaces are not reported as unknown.
        make: creates a finding about a node.
    """
    types = _types(store)
    yield from _disjoint(types, axioms, make)
    yield from _ends(store, types, axioms, make)
    yield from _odd_classes(objects, axioms, missing, make)


def _types(store: ox.Store) -> dict[Any, _Types]:
    """Return individual → its classes; equal sets are the same Python object, whose hash is computed once."""
    known: dict[_Types, _Types] = {}
    found = {}
    for node, values in values_of(store, RDF.type).items():
        types = frozenset(v.value for v in values if isinstance(v, ox.NamedNode) and v != OWL.NamedIndividual)
        found[node] = known.setdefault(types, types)
    return found


def _with_superclass(axioms: AxiomIndex, cls: str, above: str) -> str:
    return axioms.named(cls) if cls == above else f"{axioms.named(cls)}, a subclass of {axioms.named(above)},"


def _explain(axioms: AxiomIndex, first: str, second: str, clash: Disjointness) -> str:
    return (
        f"{_with_superclass(axioms, first, clash.first)} and {_with_superclass(axioms, second, clash.second)}; "
        f"axiom: {compact_iri(clash.first)} owl:disjointWith {compact_iri(clash.second)}"
    ).replace(",;", ";")


def _disjoint(types: dict[Any, _Types], axioms: AxiomIndex, make: FindingFactory) -> Iterator[Finding]:
    clashes: dict[_Types, str | None] = {}
    for node, own in types.items():
        if own not in clashes:
            pairs = ((a, b, axioms.clash(a, b)) for a, b in combinations(sorted(own), 2))
            clashes[own] = next((_explain(axioms, a, b, clash) for a, b, clash in pairs if clash is not None), None)
        found = clashes[own]
        if found is not None:
            yield make(
                Severity.ERROR, "disjoint-classes", node, f"it is {found}", "no disjoint classes", _CORRECT_CLASS
            )


def _ends(store: ox.Store, types: dict[Any, _Types], axioms: AxiomIndex, make: FindingFactory) -> Iterator[Finding]:
    for iri in sorted(axioms.properties):
        name = ox.NamedNode(iri)
        if next(iter(store.quads_for_pattern(None, name, None)), None) is None:
            continue
        for rule, is_subject in (("domain-clash", True), ("range-clash", False)):
            demands = axioms.ends(iri, is_subject=is_subject)
            if demands:
                quads = store.quads_for_pattern(None, name, None)
                nodes = dict.fromkeys(quad.subject if is_subject else quad.object for quad in quads)
                yield from _unfit(rule, iri, nodes, demands, types, axioms, make)


def _unfit(
    rule: str,
    iri: str,
    nodes: dict[Any, None],
    demands: list[tuple[str, tuple[str, ...]]],
    types: dict[Any, _Types],
    axioms: AxiomIndex,
    make: FindingFactory,
) -> Iterator[Finding]:
    """Yield the nodes at one end of a property whose classes are disjoint with its domain or range."""
    end = "domain" if rule == "domain-clash" else "range"
    verdicts: dict[_Types, tuple[str, str] | None] = {}
    for node in nodes:
        own = types.get(node, frozenset())
        if own not in verdicts:
            verdicts[own] = _verdict(axioms, iri, end, own, demands)
        verdict = verdicts[own]
        if verdict is not None:
            yield make(Severity.ERROR, rule, node, *verdict, _CORRECT_CLASS)


def _verdict(
    axioms: AxiomIndex, iri: str, end: str, own: _Types, demands: list[tuple[str, tuple[str, ...]]]
) -> tuple[str, str] | None:
    """Return the texts found and expected if a class is disjoint with all alternatives of a domain or range."""
    for stated, alternatives in demands:
        for cls in sorted(own):
            clashes = [(other, axioms.clash(cls, other)) for other in alternatives]
            other, first = clashes[0]
            if first is not None and all(clash is not None for _, clash in clashes):
                role = "has" if end == "domain" else "is a value of"
                found = f"it {role} {axioms.named(iri)}, and is {_explain(axioms, cls, other, first)}"
                named = " or ".join(axioms.named(alternative) for alternative in alternatives)
                return found, f"{named}: the {end} of {axioms.named(stated)}, or of its inverse"
    return None


def _odd_classes(
    objects: list[GraphObject], axioms: AxiomIndex, missing: tuple[str, ...], make: FindingFactory
) -> Iterator[Finding]:
    unavailable = tuple(f"{iri.rstrip('#/')}{end}" for iri in missing for end in "#/")
    for obj in objects:
        node = ox.NamedNode(obj.iri)
        for cls in obj.classes:
            if cls in axioms.deprecated:
                advice = "Use the replacement that the ontology names, with a decision (usd2kg build --decisions)."
                found = f"its class {axioms.named(cls)} is deprecated"
                yield make(Severity.WARNING, "class-deprecated", node, found, "a class that is not deprecated", advice)
            if cls not in axioms.classes and cls not in axioms.parents and not cls.startswith(unavailable):
                advice = "Give the ontology that the graph was built with (--ontology), or build the graph again."
                found = f"its class {compact_iri(cls)} is not in the ontology"
                yield make(Severity.ERROR, "class-unknown", node, found, "a class of the ontology", advice)
