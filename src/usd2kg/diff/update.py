"""make_update: the SPARQL 1.1 update that turns one graph into another, exactly.

Blank nodes have no names that an update could use. An annotated axiom is found by the statement that it is about, and
written anew; what else hangs on blank nodes, such as a class expression, by a pattern that fits just that structure.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

import pyoxigraph as ox

from usd2kg.diff.blank_nodes import Annotated, Component, Parted, part_statements, renamed
from usd2kg.diff.structure_deletion import delete_structure
from usd2kg.errors import GraphError
from usd2kg.garbage import paused_collection
from usd2kg.graph.vocabulary import OWL, RDF, named_node

__all__ = ["GraphUpdate", "make_update"]

_Each = TypeVar("_Each")
_CHUNK = 5_000
"""Statements in one operation."""


@dataclass(frozen=True, slots=True)
class GraphUpdate:
    """A SPARQL update, and how much it does."""

    text: str
    """Operations, parted by semicolons; empty if there is nothing to do."""
    deleted: int
    """Statements that it deletes; annotations that are written anew count as deleted and as inserted."""
    inserted: int


def make_update(old: Iterable[ox.Triple], new: Iterable[ox.Triple], graph: str | None = None) -> GraphUpdate:
    """Return the update that turns a store that holds `old` into one that holds `new`.

    Args:
        old: what the graph states now.
        new: what it is to state.
        graph: IRI of the named graph that is updated; by default the store's default graph.

    Raises:
        GraphError: `graph` is no IRI.
    """
    if graph is not None and named_node(graph) is None:
        raise GraphError(f"graph {graph!r} is no absolute IRI; expected one like https://my.lab/kitchen")
    with paused_collection():
        return _make(part_statements(old), part_statements(new), graph)


def _make(before: Parted, after: Parted, graph: str | None) -> GraphUpdate:
    gone, came = sorted(before.ground - after.ground, key=str), sorted(after.ground - before.ground, key=str)
    plan = _plan(before.components, after.components)
    writer = _Writer(graph)
    operations = [
        *writer.data("DELETE DATA", gone),
        *writer.annotations(plan.annotated),
        *(delete_structure(component, graph) for component in plan.structures),
        *writer.components(plan.inserted),
        *writer.data("INSERT DATA", came),
    ]
    deleted, inserted = (sum(len(c.triples) for c in components) for components in (plan.deleted, plan.inserted))
    text = " ;\n".join(operations) + "\n" if operations else ""
    return GraphUpdate(text, len(gone) + deleted, len(came) + inserted)


@dataclass(frozen=True)
class _Plan:
    """What happens to the components."""

    annotated: list[Annotated]
    """Statements whose annotations are all deleted."""
    structures: list[Component]
    """One of each kind of other components that are deleted, all alike ones together."""
    deleted: list[Component]
    inserted: list[Component]


def _plan(old: Sequence[Component], new: Sequence[Component]) -> _Plan:
    counts = [Counter(component.key for component in components) for components in (old, new)]
    changed = {key for key in counts[0].keys() | counts[1].keys() if counts[0][key] != counts[1][key]}
    # Where a larger structure annotates a statement, too, finding annotations by it would take that one apart.
    entangled = {statement for c in (*old, *new) if c.annotated is None for statement in c.annotates()}
    simple = {c.annotated for c in (*old, *new) if c.key in changed and c.annotated is not None} - entangled
    deleted = [c for c in old if c.key in changed or c.annotated in simple]
    inserted = [c for c in new if c.key in changed or c.annotated in simple]
    present = {c.annotated for c in deleted} & simple
    structures = {c.key: c for c in deleted if c.annotated not in simple}
    return _Plan(
        sorted((statement for statement in present if statement is not None), key=str),
        sorted(structures.values(), key=_text_of),
        deleted,
        sorted(inserted, key=_text_of),
    )


def _text_of(component: Component) -> list[str]:
    return sorted(map(str, component.key))


class _Writer:
    """Writes operations on the default graph or a named one."""

    def __init__(self, graph: str | None) -> None:
        self._graph = graph

    def data(self, verb: str, triples: Sequence[ox.Triple]) -> Iterator[str]:
        """Yield operations on statements that have no variables."""
        for chunk in _portions(triples):
            lines = "".join(f"{triple} .\n" for triple in chunk)
            yield (
                f"{verb} {{\n{lines}}}" if self._graph is None else f"{verb} {{ GRAPH <{self._graph}> {{\n{lines}}} }}"
            )

    def components(self, components: Sequence[Component]) -> Iterator[str]:
        """Yield insertions of components, each whole in one of them, under names that are used once."""
        count = 0
        chunk: list[ox.Triple] = []
        for component in components:
            names = {node: ox.BlankNode(f"n{count + i}") for i, node in enumerate(component.nodes)}
            count += len(names)
            chunk.extend(renamed(triple, names) for triple in component.triples)
            if len(chunk) >= _CHUNK:
                yield from self.data("INSERT DATA", chunk)
                chunk = []
        yield from self.data("INSERT DATA", chunk)

    def annotations(self, statements: Sequence[Annotated]) -> Iterator[str]:
        """Yield deletions of all that annotates these statements."""
        for chunk in _portions([s for s in statements if not s.is_reified]):
            rows = "".join(f"({s.source} {s.property} {s.target})\n" for s in chunk)
            found = f"?x {OWL.annotatedSource} ?s ; {OWL.annotatedProperty} ?q ; {OWL.annotatedTarget} ?t ; ?p ?o ."
            yield self._delete(f"VALUES (?s ?q ?t) {{\n{rows}}}\n{found}")
        for chunk in _portions([s for s in statements if s.is_reified]):
            rows = "".join(f"<<( {s.source} {s.property} {s.target} )>>\n" for s in chunk)
            yield self._delete(f"VALUES ?t {{\n{rows}}}\n?x {RDF.reifies} ?t ; ?p ?o .")

    def _delete(self, where: str) -> str:
        start = "" if self._graph is None else f"WITH <{self._graph}>\n"
        return f"{start}DELETE {{ ?x ?p ?o }} WHERE {{\n{where}\nFILTER(isBlank(?x))\n}}"


def _portions(items: Sequence[_Each]) -> Iterator[Sequence[_Each]]:
    return (items[start : start + _CHUNK] for start in range(0, len(items), _CHUNK))
