"""Placing assets on the hall's floor plan: x east, y north, z up; centimetres, degrees, kilograms."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from examples.demo_kitchen.asset import Asset
from examples.demo_kitchen.mesh import Floats, Vec3, rotation

from .catalogue import build_asset
from .writer import Z_UP

GAP = 0.05
"""Air between a thing and what it rests on, so that no faces coincide."""


class Extras(NamedTuple):
    """What an artist may add to a placement."""

    mass: float | None = None
    """Kilograms; in the simulated area every body has one."""
    instanceable: bool = False
    display_name: str = ""
    documentation: str = ""
    scale: float = 1.0
    kinematic: bool = False
    link: str = "link"
    """Name of the Xform between a simulation model and its visual; empty: none."""


PLAIN = Extras()
"""Nothing added."""
INSTANCE = Extras(instanceable=True)
"""A reference that shares its prototype."""


def kg(mass: float, kinematic: bool = False) -> Extras:
    """A mass (kilograms), for what can be moved or, if kinematic, what stays put."""
    return Extras(mass=mass, kinematic=kinematic)


@dataclass(frozen=True)
class Placed:
    """One object of the scene."""

    path: str
    key: str
    style: str
    """`kind`: a component; `body`: a rigid body without kind; `sdf`: an Xform with visual and collision."""
    position: Vec3
    turn: Vec3
    extras: Extras


@dataclass
class Layout:
    """The scene as it is being laid out."""

    root: str
    groups: dict[str, str] = field(default_factory=dict)
    """Paths of grouping prims, parents first, with their kind; empty: no kind."""
    placed: dict[str, Placed] = field(default_factory=dict)
    assets: dict[str, Asset] = field(default_factory=dict)

    def asset(self, key: str) -> Asset:
        """The asset of that key, built once."""
        if key not in self.assets:
            self.assets[key] = build_asset(key)
        return self.assets[key]

    def points(self, key: str, turn: Vec3 = (0, 0, 0), scale: float = 1.0) -> Floats:
        """(N, 3) z-up points of an asset, scaled and turned about its origin."""
        return scale * self.asset(key).points() @ Z_UP.T @ rotation(turn).T


@dataclass(frozen=True)
class Area:
    """A group of the scene and the habits of whoever filled it."""

    scene: Layout
    path: str
    style: str = "kind"

    def area(self, name: str, kind: str = "group", style: str = "") -> Area:
        """A group below this one."""
        path = f"{self.path}/{name}"
        self.scene.groups[path] = kind
        return Area(self.scene, path, style or self.style)

    def fix(
        self, name: str, key: str, at: Vec3, yaw: float = 0.0, turn: Vec3 | None = None, extras: Extras = PLAIN
    ) -> str:
        """Puts an asset's origin at a point; returns the prim path. Raises ValueError for a name used twice."""
        path = f"{self.path}/{name}"
        if path in self.scene.placed:
            raise ValueError(f"{path}: placed twice; give the second a name of its own")
        self.scene.asset(key)
        self.scene.placed[path] = Placed(path, key, self.style, at, turn or (0.0, 0.0, yaw), extras)
        return path

    def put(
        self,
        name: str,
        key: str,
        at: tuple[float, float],
        on: str | float = 0.0,
        yaw: float = 0.0,
        turn: Vec3 | None = None,
        extras: Extras = PLAIN,
    ) -> str:
        """Sets an asset down by its lowest point, on a height or on a placed thing (`PATH#surface`)."""
        turn = turn or (0.0, 0.0, yaw)
        lowest = float(self.scene.points(key, turn, extras.scale)[:, 2].min())
        height = round(self._height(on) - lowest + GAP, 4)
        return self.fix(name, key, (at[0], at[1], height), turn=turn, extras=extras)

    def _height(self, on: str | float) -> float:
        if isinstance(on, float | int):
            return float(on)
        path, _, surface = on.partition("#")
        carrier = self.scene.placed[path]
        made = self.scene.asset(carrier.key)
        if surface or "top" in made.surfaces:
            return carrier.position[2] + made.surfaces[surface or "top"]
        points = self.scene.points(carrier.key, carrier.turn, carrier.extras.scale)
        return carrier.position[2] + float(points[:, 2].max())
