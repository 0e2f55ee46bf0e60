"""What a store holds: the graphs that describe themselves, and the one that a person means."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from usd2kg.errors import GraphError, StoreError
from usd2kg.graph.vocabulary import OWL, RDFS, U2K
from usd2kg.stores.named_graph import short_name

__all__ = ["Select", "StoredGraph", "choose_graph", "list_graphs", "read_number"]

Select = Callable[[str], list[dict[str, str | None]]]
"""Runs a SELECT over a store as it is, and returns rows: variable → text."""

# A graph of ours says in itself that it is an ontology of its own name: so what others keep in the same store, and
# what is still being uploaded, is told apart without looking through it.
_GRAPHS = f"""
SELECT ?g (SAMPLE(?l) AS ?label) (SAMPLE(?r) AS ?run) WHERE {{
  GRAPH ?g {{
    ?g a <{OWL.Ontology.value}> .
    OPTIONAL {{ ?g <{RDFS.label.value}> ?l }}
    OPTIONAL {{ ?g <{U2K.run.value}> ?r }}
  }}
}} GROUP BY ?g"""
_TRIPLES = "SELECT (COUNT(*) AS ?n) WHERE { GRAPH <IRI> { ?s ?p ?o } }"
# Groups that are called rooms have a prim, too, and are no objects.
_OBJECTS = f"""
SELECT (COUNT(DISTINCT ?o) AS ?n) WHERE {{
  GRAPH <IRI> {{ ?o <{U2K.primPath.value}> ?p FILTER NOT EXISTS {{ ?o a <{U2K.RoomGroup.value}> }} }}
}}"""


@dataclass(frozen=True)
class StoredGraph:
    """One of the graphs in a store."""

    iri: str
    label: str
    is_scene: bool
    """False for an ontology that scenes share."""

    @property
    def name(self) -> str:
        """The last part of the IRI."""
        return short_name(self.iri)

    def count_triples(self, select: Select) -> int:
        """Return how many triples the graph has."""
        return read_number(select(_TRIPLES.replace("IRI", self.iri)))

    def count_objects(self, select: Select) -> int:
        """Return how many objects of a stage the graph describes."""
        return read_number(select(_OBJECTS.replace("IRI", self.iri)))


def list_graphs(select: Select) -> tuple[StoredGraph, ...]:
    """Return the graphs in a store that name themselves, scenes first, then by IRI."""
    rows = [row for row in select(_GRAPHS) if row.get("g")]
    found = [StoredGraph(str(row["g"]), row.get("label") or "", bool(row.get("run"))) for row in rows]
    return tuple(sorted(found, key=lambda graph: (not graph.is_scene, graph.iri)))


def choose_graph(graphs: Sequence[StoredGraph], name: str, address: str) -> StoredGraph:
    """Return the graph that a person means by its IRI, the last part of it, or its label.

    Raises:
        GraphError: there is none, or there are several.
    """
    wanted = name.rstrip("/#")
    for key in ("iri", "name", "label"):
        found = [graph for graph in graphs if getattr(graph, key) == (wanted if key == "iri" else name)]
        if len(found) == 1:
            return found[0]
        if found:
            raise GraphError(f"{address}: {name!r} may be {_listed(found)}; expected one, by its IRI")
    raise GraphError(f"{address}: holds no graph {name!r}; it holds {_listed(graphs) or 'none'}")


def _listed(graphs: Sequence[StoredGraph]) -> str:
    most = 8
    rest = f" and {len(graphs) - most} more" if len(graphs) > most else ""
    return ", ".join(graph.iri for graph in graphs[:most]) + rest


def read_number(rows: list[dict[str, str | None]]) -> int:
    """Return the number that a store answers to a query for one, ?n.

    Raises:
        StoreError: the answer holds none.
    """
    text = rows[0].get("n") if rows else None
    if text is None or not (text.isascii() and text.isdecimal()):
        raise StoreError(f"the store answers {_cut(text)} where a number was asked for; is it a SPARQL server?")
    return int(text)


def _cut(text: str | None) -> str:
    return "nothing" if text is None else repr(text[:50])
