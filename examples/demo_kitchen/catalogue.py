"""The registry that asset functions enter themselves in."""

from __future__ import annotations

from collections.abc import Callable

from .asset import Asset

ASSETS: dict[str, Callable[[Asset], None]] = {}


def asset(build: Callable[[Asset], None]) -> Callable[[Asset], None]:
    """Registers a function that fills an empty asset of the function's own name."""
    ASSETS[build.__name__] = build
    return build


def build_asset(name: str) -> Asset:
    """The asset of that name; raises KeyError for an unknown one."""
    made = Asset(name)
    ASSETS[name](made)
    return made
