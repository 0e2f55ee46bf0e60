"""AxiomIndex: the axioms of an ontology that a graph can contradict."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import pyoxigraph as ox

from usd2kg.graph.vocabulary import OWL, RDF, RDFS
from usd2kg.ontology import compact_iri
from usd2kg.ontology.components import Components, find_components

__all__ = ["Alternatives", "AxiomIndex", "Disjointness"]

Alternatives = tuple[str, ...]
"""IRI of a class, or IRIs of the members of a union."""
_CLASS_KINDS = {OWL.Class, RDFS.Class}
_LANGUAGES = ("en", "")


@dataclass(frozen=True, slots=True)
class Disjointness:
    """Two classes that the ontology states to be disjoint."""

    first: str
    second: str


class AxiomIndex:
    """Named superclasses, disjoint classes, domains and ranges, from the triples of an ontology with its imports.

    Supported class expressions are intersections, whose members are superclasses, and unions as domains and ranges.
    Others (restrictions, complements, keys) need a reasoner.
    """

    def __init__(self, triples: Iterable[ox.Triple]) -> None:
        self._by_predicate: dict[Any, dict[Any, list[Any]]] = {}
        for triple in triples:
            values = self._by_predicate.setdefault(triple.predicate, {}).setdefault(triple.subject, [])
            if triple.object not in values:
                values.append(triple.object)
        self._closures: dict[int, frozenset[str]] = {}
        self._clashes: dict[tuple[str, str], Disjointness | None] = {}

    def _all(self, name: ox.NamedNode) -> dict[Any, list[Any]]:
        return self._by_predicate.get(name, {})

    def _list(self, node: Any) -> Iterator[Any]:
        seen = set()
        while node != RDF.nil and node not in seen:
            seen.add(node)
            yield from self._all(RDF.first).get(node, ())[:1]
            node = next(iter(self._all(RDF.rest).get(node, ())), RDF.nil)

    def _named(self, nodes: Iterable[Any]) -> list[str]:
        return [node.value for node in nodes if isinstance(node, ox.NamedNode)]

    def _lists(self, node: Any, name: ox.NamedNode) -> list[str]:
        """Return the named members of the RDF lists that are values of a property."""
        return [iri for head in self._all(name).get(node, ()) for iri in self._named(self._list(head))]

    @cached_property
    def classes(self) -> frozenset[str]:
        """IRIs of all declared classes."""
        return frozenset(
            node.value
            for node, kinds in self._all(RDF.type).items()
            if isinstance(node, ox.NamedNode) and not _CLASS_KINDS.isdisjoint(kinds)
        )

    @cached_property
    def deprecated(self) -> frozenset[str]:
        """IRIs of all deprecated terms."""
        found = {n for n, values in self._all(OWL.deprecated).items() if any(v.value in {"true", "1"} for v in values)}
        found |= {node for node, kinds in self._all(RDF.type).items() if OWL.DeprecatedClass in kinds}
        return frozenset(self._named(found))

    @cached_property
    def parents(self) -> dict[str, set[str]]:
        """Class → its stated superclasses, including equivalent classes."""
        found: dict[str, set[str]] = {}
        for name in (RDFS.subClassOf, OWL.equivalentClass):
            for node, values in self._all(name).items():
                if isinstance(node, ox.NamedNode):
                    found.setdefault(node.value, set()).update(*(self._above(value) for value in values))
        for node, values in self._all(OWL.equivalentClass).items():
            for iri in self._named(values):
                found.setdefault(iri, set()).update(self._above(node))
        for node in self._all(OWL.intersectionOf):
            if isinstance(node, ox.NamedNode):
                found.setdefault(node.value, set()).update(self._lists(node, OWL.intersectionOf))
        return found

    def _above(self, node: Any) -> list[str]:
        if isinstance(node, ox.NamedNode):
            return [node.value]
        return self._lists(node, OWL.intersectionOf)

    @cached_property
    def disjoint(self) -> dict[str, set[str]]:
        """Class → the classes stated to be disjoint with it; symmetric."""
        groups = [
            [*self._named([node]), iri]
            for node, values in self._all(OWL.disjointWith).items()
            for iri in self._named(values)
        ]
        kinds = self._all(RDF.type)
        groups += [
            self._lists(n, OWL.members) for n in self._all(OWL.members) if OWL.AllDisjointClasses in kinds.get(n, ())
        ]
        groups += [self._lists(n, OWL.disjointUnionOf) for n in self._all(OWL.disjointUnionOf)]
        found: dict[str, set[str]] = {}
        for group in groups:
            for iri in group:
                found.setdefault(iri, set()).update(other for other in group if other != iri)
        return found

    def closure(self, iri: str) -> frozenset[str]:
        """Return a class and all its named superclasses."""
        group = self._components.component_of.get(iri)
        if group is None:
            return frozenset({iri})
        pending = [group]
        while pending:
            missing = [up for up in self._components.above[pending[-1]] if up not in self._closures]
            if missing:
                pending.extend(missing)
                continue
            done = pending.pop()
            ups = (self._closures[up] for up in self._components.above[done])
            self._closures[done] = frozenset(self._components.members[done]).union(*ups)
        return self._closures[group]

    @cached_property
    def _components(self) -> Components:
        return find_components(self.parents)

    def clash(self, first: str, second: str) -> Disjointness | None:
        """Return the most specific axiom by which two classes are disjoint; None if they are not."""
        key = (first, second)
        if key not in self._clashes:
            above = self.closure(second)
            pairs = [(a, b) for a in self.closure(first) & self.disjoint.keys() for b in self.disjoint[a] & above]
            # A class with more superclasses is more specific; ties are broken by IRI.
            pairs.sort(key=lambda pair: (-len(self.closure(pair[0])) - len(self.closure(pair[1])), pair))
            self._clashes[key] = Disjointness(*pairs[0]) if pairs else None
        return self._clashes[key]

    @cached_property
    def _property_parents(self) -> dict[str, set[str]]:
        found: dict[str, set[str]] = {}
        for name in (RDFS.subPropertyOf, OWL.equivalentProperty):
            for node, values in self._all(name).items():
                found.setdefault(node.value, set()).update(self._named(values))
        return found

    @cached_property
    def _inverses(self) -> dict[str, set[str]]:
        found: dict[str, set[str]] = {}
        for node, values in self._all(OWL.inverseOf).items():
            for iri in self._named(values) if isinstance(node, ox.NamedNode) else ():
                found.setdefault(node.value, set()).add(iri)
                found.setdefault(iri, set()).add(node.value)
        return found

    @cached_property
    def properties(self) -> frozenset[str]:
        """IRIs of the properties with a stated domain, range or superproperty, and their inverses."""
        stated = {*self._all(RDFS.domain), *self._all(RDFS.range), *self._all(RDFS.subPropertyOf)}
        named = set(self._named(stated))
        return frozenset(named | {inverse for iri in named for inverse in self._inverses.get(iri, ())})

    def ends(self, iri: str, *, is_subject: bool) -> list[tuple[str, Alternatives]]:
        """Return the domains (`is_subject`) or ranges of a property, including those of superproperties and inverses.

        Returns:
            Pairs of the property with the axiom (`iri`, a superproperty or an inverse) and the alternatives.
        """
        own, other = (RDFS.domain, RDFS.range) if is_subject else (RDFS.range, RDFS.domain)
        found = []
        for above in sorted(self._properties_above(iri)):
            found += [(above, alternatives) for alternatives in self._alternatives(above, own)]
            for inverse in sorted(self._inverses.get(above, ())):
                found += [(inverse, alternatives) for alternatives in self._alternatives(inverse, other)]
        return found

    def _properties_above(self, iri: str) -> set[str]:
        found, pending = {iri}, [iri]
        while pending:
            new = self._property_parents.get(pending.pop(), set()) - found
            found |= new
            pending.extend(new)
        return found

    def _alternatives(self, iri: str, name: ox.NamedNode) -> Iterator[Alternatives]:
        for node in self._all(name).get(ox.NamedNode(iri), ()):
            if isinstance(node, ox.NamedNode):
                yield (node.value,)
                continue
            yield from ((above,) for above in self._above(node))
            for head in self._all(OWL.unionOf).get(node, ()):
                members = list(self._list(head))
                if members and all(isinstance(member, ox.NamedNode) for member in members):
                    yield tuple(member.value for member in members)

    def label(self, iri: str) -> str:
        """Return the label of a term, preferably English; without a label its CURIE or IRI."""
        labels = self._all(RDFS.label).get(ox.NamedNode(iri), [])
        ranked = sorted(
            (_LANGUAGES.index(x.language or "") if (x.language or "") in _LANGUAGES else 2, x.value) for x in labels
        )
        return ranked[0][1] if ranked else compact_iri(iri)

    def named(self, iri: str) -> str:
        """Return the label and the CURIE or IRI of a term: “Cup” (soma:Cup); without a label, only the CURIE or IRI."""
        label, short = self.label(iri), compact_iri(iri)
        return short if label == short else f"“{label}” ({short})"
