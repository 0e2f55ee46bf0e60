"""make_update: the SPARQL 1.1 update that turns one graph exactly into another.

An update cannot name blank nodes. Annotations are found by the statement that they annotate, deleted and inserted
again; other structures, such as class expressions, are found by a pattern that matches only that structure.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import pyoxigraph as ox

from usd2kg.diff.blank_nodes import AnnotatedStatement, Component, SplitGraph, rename_blank_nodes, split_graph
from usd2kg.diff.settings import MEMORY
from usd2kg.diff.structure_deletion import format_structure_deletion
from usd2kg.errors import GraphError
from usd2kg.garbage import paused_collection
from usd2kg.graph.vocabulary import OWL, RDF, named_node

__all__ = ["GraphUpdate", "make_update"]

_Item = TypeVar("_Item")


@dataclass(frozen=True, slots=True)
class GraphUpdate:
    """A SPARQL update and its size."""

    text: str
    """Operations separated by semicolons; empty if the graphs are equal."""
    deleted: int
    """Number of deleted statements; annotations that are deleted and inserted again count in both."""
    inserted: int


def make_update(old: Iterable[ox.Triple], new: Iterable[ox.Triple], graph: str | None = None) -> GraphUpdate:
    """Return the update that replaces the statements `old` of a graph in a store by `new`.

    Args:
        old: the current statements.
        new: the wanted statements.
        graph: IRI of the named graph to update; by default the default graph.

    Raises:
        GraphError: `graph` is not an absolute IRI.
    """
    if graph is not None and named_node(graph) is None:
        raise GraphError(f"graph {graph!r} is not an absolute IRI; expected one like https://my.lab/kitchen")
    with paused_collection():
        return _make_update(split_graph(old), split_graph(new), graph)


def _make_update(old: SplitGraph, new: SplitGraph, graph: str | None) -> GraphUpdate:
    deleted, inserted = sorted(old.ground - new.ground, key=str), sorted(new.ground - old.ground, key=str)
    changes = _diff_components(old.components, new.components)
    writer = _OperationWriter(graph)
    operations = [
        *writer.write_data("DELETE DATA", deleted),
        *writer.delete_annotations(changes.annotated),
        *(format_structure_deletion(component, graph) for component in changes.structures),
        *writer.insert_components(changes.inserted),
        *writer.write_data("INSERT DATA", inserted),
    ]
    in_deleted, in_inserted = (
        sum(len(c.triples) for c in components) for components in (changes.deleted, changes.inserted)
    )
    text = " ;\n".join(operations) + "\n" if operations else ""
    return GraphUpdate(text, len(deleted) + in_deleted, len(inserted) + in_inserted)


@dataclass(frozen=True)
class _ComponentChanges:
    """Differences between the components of two graphs."""

    annotated: list[AnnotatedStatement]
    """Statements whose annotations are all deleted."""
    structures: list[Component]
    """One of each set of isomorphic components to delete that are not annotations."""
    deleted: list[Component]
    """All components to delete."""
    inserted: list[Component]


def _diff_components(old: Sequence[Component], new: Sequence[Component]) -> _ComponentChanges:
    counts = [Counter(component.key for component in components) for components in (old, new)]
    changed = {key for key in counts[0].keys() | counts[1].keys() if counts[0][key] != counts[1][key]}
    # A larger structure that annotates a statement would lose its annotating node with the statement's annotations.
    entangled = {statement for c in (*old, *new) if c.annotated is None for statement in c.find_annotated()}
    annotated = {c.annotated for c in (*old, *new) if c.key in changed and c.annotated is not None} - entangled
    deleted = [c for c in old if c.key in changed or c.annotated in annotated]
    inserted = [c for c in new if c.key in changed or c.annotated in annotated]
    present = {c.annotated for c in deleted} & annotated
    structures = {c.key: c for c in deleted if c.annotated not in annotated}
    return _ComponentChanges(
        sorted((statement for statement in present if statement is not None), key=str),
        sorted(structures.values(), key=_sort_key),
        deleted,
        sorted(inserted, key=_sort_key),
    )


def _sort_key(component: Component) -> list[str]:
    return sorted(map(str, component.key))


class _OperationWriter:
    """Writes operations on the default graph or a named one."""

    def __init__(self, graph: str | None) -> None:
        self._graph = graph

    def write_data(self, verb: str, triples: Sequence[ox.Triple]) -> Iterator[str]:
        """Yield INSERT DATA or DELETE DATA operations."""
        for chunk in _chunks(triples):
            lines = "".join(f"{triple} .\n" for triple in chunk)
            if self._graph is None:
                yield f"{verb} {{\n{lines}}}"
            else:
                yield f"{verb} {{ GRAPH <{self._graph}> {{\n{lines}}} }}"

    def insert_components(self, components: Sequence[Component]) -> Iterator[str]:
        """Yield insertions with unique blank node labels, whose scope is one operation: components are never split."""
        count = 0
        chunk: list[ox.Triple] = []
        for component in components:
            names = {node: ox.BlankNode(f"n{count + i}") for i, node in enumerate(component.nodes)}
            count += len(names)
            chunk.extend(rename_blank_nodes(triple, names) for triple in component.triples)
            if len(chunk) >= MEMORY.statements_per_operation:
                yield from self.write_data("INSERT DATA", chunk)
                chunk = []
        yield from self.write_data("INSERT DATA", chunk)

    def delete_annotations(self, statements: Sequence[AnnotatedStatement]) -> Iterator[str]:
        """Yield deletions of all annotations of some statements."""
        for chunk in _chunks([s for s in statements if not s.is_reified]):
            rows = "".join(f"({s.source} {s.property} {s.target})\n" for s in chunk)
            axiom = f"?x {OWL.annotatedSource} ?s ; {OWL.annotatedProperty} ?q ; {OWL.annotatedTarget} ?t ; ?p ?o ."
            yield self._delete(f"VALUES (?s ?q ?t) {{\n{rows}}}\n{axiom}")
        for chunk in _chunks([s for s in statements if s.is_reified]):
            rows = "".join(f"<<( {s.source} {s.property} {s.target} )>>\n" for s in chunk)
            yield self._delete(f"VALUES ?t {{\n{rows}}}\n?x {RDF.reifies} ?t ; ?p ?o .")

    def _delete(self, where: str) -> str:
        start = "" if self._graph is None else f"WITH <{self._graph}>\n"
        return f"{start}DELETE {{ ?x ?p ?o }} WHERE {{\n{where}\nFILTER(isBlank(?x))\n}}"


def _chunks(items: Sequence[_Item]) -> Iterator[Sequence[_Item]]:
    size = MEMORY.statements_per_operation
    return (items[start : start + size] for start in range(0, len(items), size))
