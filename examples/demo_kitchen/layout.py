"""Placing assets: what stands on what, what is inside what; centimetres, degrees."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .asset import Asset
from .catalogue import build_asset
from .mesh import Floats, Vec3, rotation

GAP = 0.05
"""Air between a thing and what it rests on: half a millimetre, so that no faces coincide."""


class Frame(NamedTuple):
    """A place on the floor plan and a heading, to give positions relative to."""

    x: float = 0.0
    z: float = 0.0
    yaw: float = 0.0

    def world(self, x: float, z: float) -> tuple[float, float]:
        """World x and z of a point of the frame."""
        turned = rotation((0, self.yaw, 0)) @ np.array([x, 0.0, z])
        return self.x + float(turned[0]), self.z + float(turned[2])

    def within(self, x: float, z: float, yaw: float = 0.0) -> Frame:
        """A frame given relative to this one."""
        return Frame(*self.world(x, z), self.yaw + yaw)


WORLD = Frame()


@dataclass(frozen=True)
class Extras:
    """What an artist may add to a reference."""

    mass: float | None = None
    """Kilograms."""
    instanceable: bool = False
    display_name: str = ""
    documentation: str = ""


@dataclass(frozen=True)
class Placed:
    """One object of the scene."""

    path: str
    asset: Asset
    position: Vec3
    turn: Vec3
    extras: Extras

    def points(self) -> Floats:
        """(N, 3), centimetres, world."""
        return np.asarray(self.asset.points() @ rotation(self.turn).T + self.position, dtype=float)


@dataclass
class Layout:
    """The scene as it is being laid out."""

    root: str
    groups: list[str] = field(default_factory=list)
    """Paths of group prims, parents first."""
    placed: dict[str, Placed] = field(default_factory=dict)
    relations: list[tuple[str, str, str]] = field(default_factory=list)
    """(subject path, `on` or `inside`, object path)."""
    assets: dict[str, Asset] = field(default_factory=dict)

    def group(self, name: str) -> str:
        """Adds a group below the root; returns its path."""
        path = f"{self.root}/{name}"
        self.groups.append(path)
        return path

    def asset(self, name: str) -> Asset:
        """The asset of that name, built once."""
        if name not in self.assets:
            self.assets[name] = build_asset(name)
        return self.assets[name]

    def fix(
        self,
        path: str,
        asset: str,
        at: Vec3,
        frame: Frame = WORLD,
        turn: Vec3 = (0, 0, 0),
        extras: Extras | None = None,
        inside: str = "",
    ) -> str:
        """Puts an asset's origin at a point: what is built in or hangs; returns its path."""
        if path in self.placed:
            raise ValueError(f"{path}: placed twice; give the second a name of its own")
        made = self.asset(asset)
        x, z = frame.world(at[0], at[2])
        heading = (turn[0], turn[1] + frame.yaw, turn[2])
        self.placed[path] = Placed(path, made, (x, at[1], z), heading, extras or Extras())
        if inside:
            self.relations.append((path, "inside", inside))
        return path

    def put(
        self,
        path: str,
        asset: str,
        at: tuple[float, float],
        on: str = "",
        inside: str = "",
        surface: str = "",
        frame: Frame = WORLD,
        turn: Vec3 = (0, 0, 0),
        extras: Extras | None = None,
    ) -> str:
        """Sets an asset down on the surface of another, by its lowest point; returns its path.

        The supporter is `on`; without one, the container itself carries the thing.
        """
        carrier = self.placed[on or inside]
        name = surface or ("inside" if inside and not on else "top")
        height = carrier.position[1] + carrier.asset.surface(name) + GAP
        made = self.asset(asset)
        heading = (turn[0], turn[1] + frame.yaw, turn[2])
        lowest = float((made.points() @ rotation(heading).T)[:, 1].min())
        self.fix(path, asset, (at[0], round(height - lowest, 4), at[1]), frame, turn, extras)
        if on:
            self.relations.append((path, "on", on))
        if inside:
            self.relations.append((path, "inside", inside))
        return path


def kg(mass: float) -> Extras:
    """Extras that hold nothing but a mass (kilograms)."""
    return Extras(mass=mass)


INSTANCE = Extras(instanceable=True)
"""Extras of a reference that shares its prototype."""
