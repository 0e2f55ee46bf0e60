"""Split a graph into ground statements and connected components of blank nodes."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import pyoxigraph as ox

from usd2kg.graph.vocabulary import OWL, RDF

__all__ = ["AnnotatedStatement", "Component", "SplitGraph", "Term", "rename_blank_nodes", "split_graph"]

Term = ox.NamedNode | ox.BlankNode | ox.Literal | ox.Triple
_SINGLE = ox.BlankNode("single")
"""Name of the blank node in the key of a component that has only one."""


class AnnotatedStatement(NamedTuple):
    """A statement that a blank node annotates."""

    source: Term
    property: Term
    target: Term
    is_reified: bool
    """Whether the node annotates it by rdf:reifies (RDF 1.2); otherwise as an owl:Axiom."""


@dataclass(frozen=True)
class Component:
    """Statements connected by blank nodes that no other statement uses."""

    triples: tuple[ox.Triple, ...]
    nodes: tuple[ox.BlankNode, ...]

    @cached_property
    def key(self) -> frozenset[ox.Triple]:
        """The statements with canonical blank node names; isomorphic components have equal keys."""
        if len(self.nodes) == 1:
            return frozenset(rename_blank_nodes(triple, {self.nodes[0]: _SINGLE}) for triple in self.triples)
        dataset = ox.Dataset(ox.Quad(*triple) for triple in self.triples)
        # W3C RDF Dataset Canonicalization, 2024.
        dataset.canonicalize(ox.CanonicalizationAlgorithm.RDFC_1_0)
        return frozenset(quad.triple for quad in dataset)

    @property
    def annotated(self) -> AnnotatedStatement | None:
        """The statement annotated by the only node; None if it annotates none or several, or is itself an object."""
        found = list(self.find_annotated())
        is_alone = len(self.nodes) == 1 and all(triple.subject == self.nodes[0] for triple in self.triples)
        return found[0] if len(found) == 1 and is_alone else None

    def find_annotated(self) -> Iterator[AnnotatedStatement]:
        """Yield the statements that any node of the component annotates."""
        values: dict[tuple[object, ox.NamedNode], list[Term]] = {}
        for subject, predicate, value in self.triples:
            values.setdefault((subject, predicate), []).append(value)
        for node in self.nodes:
            for value in values.get((node, RDF.reifies), ()):
                if isinstance(value, ox.Triple):
                    yield AnnotatedStatement(value.subject, value.predicate, value.object, is_reified=True)
            for source in values.get((node, OWL.annotatedSource), ()):
                for name in values.get((node, OWL.annotatedProperty), ()):
                    for target in values.get((node, OWL.annotatedTarget), ()):
                        yield AnnotatedStatement(source, name, target, is_reified=False)


class SplitGraph(NamedTuple):
    """The statements of a graph."""

    ground: frozenset[ox.Triple]
    """Statements without blank nodes."""
    components: tuple[Component, ...]
    """All other statements."""


def split_graph(triples: Iterable[ox.Triple]) -> SplitGraph:
    """Return the ground statements of a graph and its components of blank nodes."""
    ground, others = [], []
    for triple in triples:
        nodes = tuple(_blank_nodes(triple))
        (others.append((triple, nodes)) if nodes else ground.append(triple))
    sets = _DisjointSets()
    for _, nodes in others:
        sets.join(nodes)
    members: dict[ox.BlankNode, list[ox.Triple]] = {}
    for triple, nodes in others:
        members.setdefault(sets.find(nodes[0]), []).append(triple)
    return SplitGraph(frozenset(ground), tuple(_component(triples) for triples in members.values()))


def rename_blank_nodes(triple: ox.Triple, names: dict[ox.BlankNode, ox.BlankNode]) -> ox.Triple:
    """Return a statement with its blank nodes replaced."""
    subject, _, value = triple
    new_subject = names[subject] if isinstance(subject, ox.BlankNode) else subject
    if isinstance(value, ox.BlankNode):
        return ox.Triple(new_subject, triple.predicate, names[value])
    if isinstance(value, ox.Triple):
        return ox.Triple(new_subject, triple.predicate, rename_blank_nodes(value, names))
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


class _DisjointSets:
    """Union-find over blank nodes."""

    def __init__(self) -> None:
        self._parents: dict[ox.BlankNode, ox.BlankNode] = {}

    def find(self, node: ox.BlankNode) -> ox.BlankNode:
        """Return the representative of the set of a node."""
        while (parent := self._parents.setdefault(node, node)) != node:
            self._parents[node] = node = self._parents[parent]
        return node

    def join(self, nodes: tuple[ox.BlankNode, ...]) -> None:
        """Merge the sets of some nodes."""
        for node in nodes[1:]:
            self._parents[self.find(node)] = self.find(nodes[0])
