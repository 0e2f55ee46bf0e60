"""The assets of the office: what builds each, and how its file is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from examples.demo_kitchen.asset import Asset
from examples.demo_kitchen.layout import Layout

Build = Callable[[Asset], None]


@dataclass(frozen=True)
class Spec:
    """How an asset comes to be and how its file is written."""

    build: Build
    file: str
    """Name of the file and of its default prim."""
    kind: bool = True
    """Whether the default prim says that it is a component."""
    materials: bool = True
    """Whether materials are written; without them parts have colours only."""
    y_up: bool = False
    """Whether the file is Y up in centimetres, to be put right where it is referenced."""


SPECS: dict[str, Spec] = {}


def asset(file: str, *, kind: bool = True, materials: bool = True, y_up: bool = False) -> Callable[[Build], Build]:
    """Registers a function that fills an empty asset; the asset is known by the function's name."""

    def register(build: Build) -> Build:
        SPECS[build.__name__] = Spec(build, file, kind, materials, y_up)
        return build

    return register


class Office(Layout):
    """A layout whose assets are those of the office; centimetres, Y up, until it is written."""

    def asset(self, name: str) -> Asset:
        """The asset of that name, built once; raises KeyError for an unknown one."""
        if name not in self.assets:
            made = Asset(name)
            SPECS[name].build(made)
            self.assets[name] = made
        return self.assets[name]
