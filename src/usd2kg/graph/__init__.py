"""From a Scene and its Grounding to RDF: individuals, relations, provenance, files and questions."""

from usd2kg.graph.instantiate import PROFILES, KnowledgeGraph, instantiate
from usd2kg.graph.iris import individual_iri, prim_path_of
from usd2kg.graph.query import Answer, GraphStore, load_graph
from usd2kg.graph.relations import Relation, RelationOptions, find_relations
from usd2kg.graph.serialize import GRAPH_FORMATS, graph_format, serialize_graph, write_graph

__all__ = [
    "GRAPH_FORMATS",
    "PROFILES",
    "Answer",
    "GraphStore",
    "KnowledgeGraph",
    "Relation",
    "RelationOptions",
    "find_relations",
    "graph_format",
    "individual_iri",
    "instantiate",
    "load_graph",
    "prim_path_of",
    "serialize_graph",
    "write_graph",
]
