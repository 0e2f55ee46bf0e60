"""Turn an OpenUSD scene into an OWL knowledge graph.

>>> import usd2kg
>>> usd2kg.__all__[:3]
['BuildResult', 'Grounding', 'KnowledgeGraph']
"""

from typing import TYPE_CHECKING, Any

from usd2kg.version import VERSION

if TYPE_CHECKING:
    from usd2kg.errors import Usd2kgError
    from usd2kg.graph import KnowledgeGraph, instantiate, write_graph
    from usd2kg.grounding import Grounding, ground, make_grounder
    from usd2kg.ontology import TBox, load_home_tbox, load_tbox
    from usd2kg.pipeline import BuildResult, build
    from usd2kg.query import load_graph
    from usd2kg.scene import Scene, read_scene
    from usd2kg.tables import Tables, to_tables
    from usd2kg.world import World
    from usd2kg.world import open as open

__version__ = VERSION

_PACKAGES = {
    "BuildResult": "pipeline",
    "Grounding": "grounding",
    "KnowledgeGraph": "graph",
    "Scene": "scene",
    "Tables": "tables",
    "TBox": "ontology",
    "Usd2kgError": "errors",
    "World": "world",
    "build": "pipeline",
    "ground": "grounding",
    "instantiate": "graph",
    "load_graph": "query",
    "load_home_tbox": "ontology",
    "load_tbox": "ontology",
    "make_grounder": "grounding",
    "open": "world",
    "read_scene": "scene",
    "to_tables": "tables",
    "write_graph": "graph",
}

# Without `open`: `from usd2kg import *` keeps the built-in one.
__all__ = [
    "BuildResult",
    "Grounding",
    "KnowledgeGraph",
    "Scene",
    "TBox",
    "Tables",
    "Usd2kgError",
    "World",
    "build",
    "ground",
    "instantiate",
    "load_graph",
    "load_home_tbox",
    "load_tbox",
    "make_grounder",
    "read_scene",
    "to_tables",
    "write_graph",
]


def __dir__() -> list[str]:
    return sorted([*_PACKAGES, "__version__"])


def __getattr__(name: str) -> Any:
    # Lazy loading, so that `usd2kg --help` does not load OpenUSD.
    if name not in _PACKAGES:
        raise AttributeError(f"module 'usd2kg' has no attribute {name!r}")
    from importlib import import_module  # noqa: PLC0415

    return getattr(import_module(f"usd2kg.{_PACKAGES[name]}"), name)
