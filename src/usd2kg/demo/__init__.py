"""The demo kitchen: a scene made for this project, with gold labels and true relations."""

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
    """Return the gold labels: CSV with the columns path, class, also."""
    return _file("gold.csv")


def demo_relations() -> Path:
    """Return the true `on` and `inside` relations: CSV with the columns subject, relation, object."""
    return _file("relations.csv")


def _file(name: str) -> Path:
    # The stage references its assets by relative paths, so it cannot be read from a zip file.
    return Path(str(files("usd2kg.demo") / "kitchen" / name))
