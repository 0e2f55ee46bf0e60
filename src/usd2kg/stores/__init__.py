"""Stores: many scenes in a folder or on a server, each in its own named graph."""

from usd2kg.stores.embedded import EmbeddedStore
from usd2kg.stores.named_graph import NamedGraph, make_named_graph, make_ontology_graph, read_named_graph
from usd2kg.stores.named_graphs import StoredGraph, choose_graph
from usd2kg.stores.opening import SceneStore, is_store, open_graph, open_store, select_graphs, view_scenes
from usd2kg.stores.remote import RemoteStore

__all__ = [
    "EmbeddedStore",
    "NamedGraph",
    "RemoteStore",
    "SceneStore",
    "StoredGraph",
    "choose_graph",
    "is_store",
    "make_named_graph",
    "make_ontology_graph",
    "open_graph",
    "open_store",
    "read_named_graph",
    "select_graphs",
    "view_scenes",
]
