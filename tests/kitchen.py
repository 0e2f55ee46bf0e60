"""The demo kitchen, read and built once in each process."""

from functools import cache

from usd2kg import build
from usd2kg.demo import demo_scene
from usd2kg.graph import KnowledgeGraph
from usd2kg.scene import Scene, read_scene

__all__ = ["kitchen_graph", "kitchen_scene"]


@cache
def kitchen_scene() -> Scene:
    """Return the scene."""
    return read_scene(demo_scene())


@cache
def kitchen_graph(profile: str = "soma") -> KnowledgeGraph:
    """Return the graph that the defaults give, in a profile."""
    return build(kitchen_scene(), profile=profile).graph
