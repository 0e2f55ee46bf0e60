"""The graphs of a store: list them, and choose one by name."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from usd2kg.errors import GraphError, StoreError
from usd2kg.graph.vocabulary import OWL, RDFS, U2K
from usd2kg.stores.named_graph import last_segment

__all__ = ["Select", "StoredGraph", "choose_graph", "list_graphs", "read_number"]

Select = Callable[[str], list[dict[str, str | None]]]
"""Runs a SELECT over all graphs of a store and returns rows: variable → text."""

# Each usd2kg graph declares itself an owl:Ontology with its own IRI. That excludes graphs of other programs and
# unfinished uploads without reading them.
_GRAPHS = f"""
SELECT ?g (SAMPLE(?l) AS ?label) (SAMPLE(?r) AS ?run) WHERE {{
  GRAPH ?g {{
    ?g a <{OWL.Ontology.value}> .
    OPTIONAL {{ ?g <{RDFS.label.value}> ?l }}
    OPTIONAL {{ ?g <{U2K.run.value}> ?r }}
  }}
}} GROUP BY ?g"""
_MAX_LISTED = 8
"""Graphs named in a message."""
_TRIPLES = "SELECT (COUNT(*) AS ?n) WHERE { GRAPH <IRI> { ?s ?p ?o } }"
# Groups named like rooms have a prim path but are not objects.
_OBJECTS = f"""
SELECT (COUNT(DISTINCT ?o) AS ?n) WHERE {{
  GRAPH <IRI> {{ ?o <{U2K.primPath.value}> ?p FILTER NOT EXISTS {{ ?o a <{U2K.RoomGroup.value}> }} }}
}}"""


@dataclass(frozen=True)
class StoredGraph:
    """A graph in a store."""

    iri: str
    label: str
    is_scene: bool
    """False for an ontology that scenes share."""

    @property
    def name(self) -> str:
        """The last segment of the IRI."""
        return last_segment(self.iri)

    def count_triples(self, select: Select) -> int:
        """Return the number of triples."""
        return read_number(select(_TRIPLES.replace("IRI", self.iri)))

    def count_objects(self, select: Select) -> int:
        """Return the number of scene objects."""
        return read_number(select(_OBJECTS.replace("IRI", self.iri)))


def list_graphs(select: Select) -> tuple[StoredGraph, ...]:
    """Return the self-describing graphs of a store: scenes, then ontologies, each by IRI."""
    rows = [row for row in select(_GRAPHS) if row.get("g")]
    found = [StoredGraph(str(row["g"]), row.get("label") or "", bool(row.get("run"))) for row in rows]
    return tuple(sorted(found, key=lambda graph: (not graph.is_scene, graph.iri)))


def choose_graph(graphs: Sequence[StoredGraph], name: str, address: str) -> StoredGraph:
    """Return the graph with this IRI, last segment of the IRI, or label.

    Raises:
        GraphError: no graph matches, or several do.
    """
    wanted = name.rstrip("/#")
    for key in ("iri", "name", "label"):
        found = [graph for graph in graphs if getattr(graph, key) == (wanted if key == "iri" else name)]
        if len(found) == 1:
            return found[0]
        if found:
            raise GraphError(f"{address}: {name!r} is ambiguous: {_join(found)}; expected the IRI of one")
    raise GraphError(f"{address}: has no graph {name!r}; expected one of {_join(graphs) or 'none'}")


def _join(graphs: Sequence[StoredGraph]) -> str:
    rest = f" and {len(graphs) - _MAX_LISTED} more" if len(graphs) > _MAX_LISTED else ""
    return ", ".join(graph.iri for graph in graphs[:_MAX_LISTED]) + rest


def read_number(rows: list[dict[str, str | None]]) -> int:
    """Return the value of `?n` in the answer to a counting query.

    Raises:
        StoreError: the answer contains no number.
    """
    text = rows[0].get("n") if rows else None
    if text is None or not (text.isascii() and text.isdecimal()):
        found = "nothing" if text is None else repr(text[:50])
        raise StoreError(f"the store answers {found}; expected a number; check that it is a SPARQL server")
    return int(text)
