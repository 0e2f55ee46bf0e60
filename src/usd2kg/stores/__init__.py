"""Stores of graphs: many scenes in a folder or on a server, each in a named graph of its own."""

from usd2kg.stores.catalog import StoredGraph, choose_graph
from usd2kg.stores.embedded import EmbeddedStore
from usd2kg.stores.named_graph import NamedGraph, named_graph, ontology_graph, read_named_graph
from usd2kg.stores.opening import SceneStore, chosen_graphs, is_store, open_graph, open_store
from usd2kg.stores.remote import RemoteStore

__all__ = [
    "EmbeddedStore",
    "NamedGraph",
    "RemoteStore",
    "SceneStore",
    "StoredGraph",
    "choose_graph",
    "chosen_graphs",
    "is_store",
    "named_graph",
    "ontology_graph",
    "open_graph",
    "open_store",
    "read_named_graph",
]
