"""The registry that asset functions enter themselves in, with how each file is named and made."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from examples.demo_kitchen.asset import Asset

Fill = Callable[[Asset], None]


class Entry(NamedTuple):
    """One asset as its maker left it."""

    fill: Fill
    file: str
    """File name without ending; half are descriptive, half are codes."""
    root: str
    """Name of the default prim."""
    looks: str
    """Name of the material scope; empty: displayColor only."""
    is_component: bool
    """Whether the file itself authors the kind; otherwise the scene does, where it does at all."""
    is_model: bool
    """Whether the file is a simulator's model: parts below `base_link/visual`, `base_link/collision` beside."""


ENTRIES: dict[str, Entry] = {}


def asset(
    file: str, root: str = "", looks: str = "Looks", is_component: bool = True, is_model: bool = False
) -> Callable[[Fill], Fill]:
    """Registers a function that fills an empty asset, under the function's own name."""

    def register(fill: Fill) -> Fill:
        ENTRIES[fill.__name__] = Entry(fill, file, root or file, looks, is_component and not is_model, is_model)
        return fill

    return register


def build_asset(key: str) -> Asset:
    """The asset of that key; raises KeyError for an unknown one."""
    entry = ENTRIES[key]
    made = Asset(entry.root, looks=entry.looks)
    entry.fill(made)
    return made
