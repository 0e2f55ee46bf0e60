"""The statements about blank nodes, in components: what hangs together by them, and when two of them say the same."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.graph.vocabulary import OWL, RDF

__all__ = ["Annotated", "Component", "Parted", "part_statements", "renamed"]

Term = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple
_ONLY = ox.BlankNode("only")


class Annotated(NamedTuple):
    """The statement that a blank node annotates."""

    source: Term
    property: Term
    target: Term
    is_reified: bool
    """Whether in RDF 1.2's way, by rdf:reifies; otherwise as OWL annotates axioms."""


@dataclass(frozen=True)
class Component:
    """Statements that share blank nodes with each other and with no other statement."""

    triples: tuple[ox.Triple, ...]
    nodes: tuple[ox.BlankNode, ...]

    @cached_property
    def key(self) -> frozenset[ox.Triple]:
        """What it says, whatever its nodes are called: equal keys, equal statements."""
        if len(self.nodes) == 1:
            return frozenset(renamed(triple, {self.nodes[0]: _ONLY}) for triple in self.triples)
        dataset = ox.Dataset(ox.Quad(*triple) for triple in self.triples)
        # W3C RDF Dataset Canonicalization, 2024.
        dataset.canonicalize(ox.CanonicalizationAlgorithm.RDFC_1_0)
        return frozenset(quad.triple for quad in dataset)

    @property
    def annotated(self) -> Annotated | None:
        """The statement, where it is one node that annotates one and has no other place in the graph; else None."""
        found = list(self.annotates())
        is_alone = len(self.nodes) == 1 and all(triple.subject == self.nodes[0] for triple in self.triples)
        return found[0] if len(found) == 1 and is_alone else None

    def annotates(self) -> Iterator[Annotated]:
        """Yield all statements that a node of it can be found to annotate."""
        said: dict[tuple[object, ox.NamedNode], list[Term]] = {}
        for subject, predicate, value in self.triples:
            said.setdefault((subject, predicate), []).append(value)
        for node in self.nodes:
            for value in said.get((node, RDF.reifies), ()):
                if isinstance(value, ox.Triple):
                    yield Annotated(value.subject, value.predicate, value.object, is_reified=True)
            for source in said.get((node, OWL.annotatedSource), ()):
                for name in said.get((node, OWL.annotatedProperty), ()):
                    for target in said.get((node, OWL.annotatedTarget), ()):
                        yield Annotated(source, name, target, is_reified=False)


class Parted(NamedTuple):
    """The statements of a graph in two parts."""

    ground: frozenset[ox.Triple]
    """Those without blank nodes."""
    components: tuple[Component, ...]


def part_statements(triples: Iterable[ox.Triple]) -> Parted:
    """Return the statements without blank nodes, and the others in components."""
    ground, about = [], []
    for triple in triples:
        nodes = tuple(_blank_nodes(triple))
        (about.append((triple, nodes)) if nodes else ground.append(triple))
    roots = _Roots()
    for _, nodes in about:
        roots.join(nodes)
    members: dict[ox.BlankNode, list[ox.Triple]] = {}
    for triple, nodes in about:
        members.setdefault(roots.find(nodes[0]), []).append(triple)
    return Parted(frozenset(ground), tuple(_component(triples) for triples in members.values()))


def renamed(triple: ox.Triple, names: dict[ox.BlankNode, ox.BlankNode]) -> ox.Triple:
    """Return a statement with other names for its blank nodes."""
    subject, _, value = triple
    new_subject = names[subject] if isinstance(subject, ox.BlankNode) else subject
    if isinstance(value, ox.BlankNode):
        return ox.Triple(new_subject, triple.predicate, names[value])
    if isinstance(value, ox.Triple):
        return ox.Triple(new_subject, triple.predicate, renamed(value, names))
    return ox.Triple(new_subject, triple.predicate, value)


def _component(triples: list[ox.Triple]) -> Component:
    ordered = tuple(sorted(triples, key=str))
    return Component(ordered, tuple(dict.fromkeys(node for triple in ordered for node in _blank_nodes(triple))))


def _blank_nodes(triple: ox.Triple) -> Iterator[ox.BlankNode]:
    for term in (triple.subject, triple.object):
        if isinstance(term, ox.BlankNode):
            yield term
        elif isinstance(term, ox.Triple):
            yield from _blank_nodes(term)


class _Roots:
    """Blank nodes that hang together, each set under one of them."""

    def __init__(self) -> None:
        self._above: dict[ox.BlankNode, ox.BlankNode] = {}

    def find(self, node: ox.BlankNode) -> ox.BlankNode:
        """Return the node that stands for the set."""
        while (above := self._above.setdefault(node, node)) != node:
            self._above[node] = node = self._above[above]
        return node

    def join(self, nodes: tuple[ox.BlankNode, ...]) -> None:
        """Put nodes into one set."""
        for node in nodes[1:]:
            self._above[self.find(node)] = self.find(nodes[0])
