"""The demo kitchen: a scene authored for this project, with gold labels and the relations that hold in it."""

from importlib.resources import files
from pathlib import Path

__all__ = [
    "demo_gold",
    "demo_relations",
    "demo_scene",
]


def demo_scene() -> Path:
    """Return the root layer of the demo kitchen."""
    return _file("kitchen.usda")


def demo_gold() -> Path:
    """Return its gold labels: CSV with the columns path, class, also."""
    return _file("gold.csv")


def demo_relations() -> Path:
    """Return what is on and inside what by construction: CSV with the columns subject, relation, object."""
    return _file("relations.csv")


def _file(name: str) -> Path:
    # The stage refers to its assets by relative paths, so that it must lie in a real folder.
    return Path(str(files("usd2kg.demo") / "kitchen" / name))
