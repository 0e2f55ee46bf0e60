"""Assets of a scene: their parts in memory, and the conventions of their files."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from types import ModuleType
from typing import NamedTuple

import numpy as np

from scenes.writer.mesh import Floats, Mesh, Vec3


class Part(NamedTuple):
    """One mesh of an asset."""

    path: str
    """Relative to the asset's root, e.g. `door/handle`."""
    mesh: Mesh
    material: str
    purpose: str = "default"


class Hinge(NamedTuple):
    """A part that turns about a vertical axis."""

    part: str
    """Path of the part's Xform."""
    pivot: Vec3
    """A point of the axis, centimetres."""
    opened: float
    """Angle about y of the open state, degrees."""


@dataclass
class Asset:
    """Parts in centimetres, Y up, front towards +z; the origin is where the asset rests or is fixed."""

    name: str
    """Name of the default prim."""
    looks: str = "Looks"
    """Name of the material scope; empty: display colours only."""
    parts: list[Part] = field(default_factory=list)
    subcomponents: list[str] = field(default_factory=list)
    """Paths of Xforms with kind `subcomponent`."""
    surfaces: dict[str, float] = field(default_factory=dict)
    """Name → height above the origin at which objects can stand; `top` defaults to the highest point."""
    hinges: list[Hinge] = field(default_factory=list)
    documentation: str = ""

    def add(self, path: str, mesh: Mesh, material: str) -> None:
        """Add a mesh."""
        self.parts.append(Part(path, mesh, material))

    def add_proxy(self, path: str, mesh: Mesh) -> None:
        """Add a mesh of purpose `proxy`."""
        self.parts.append(Part(path, mesh, "", "proxy"))

    def points(self) -> Floats:
        """Return the (N, 3) rendered points, centimetres, Y up."""
        return np.concatenate([part.mesh.points for part in self.parts if part.purpose == "default"])

    def surface(self, name: str) -> float:
        """Return the height of a named surface in centimetres."""
        if name == "top" and "top" not in self.surfaces:
            return float(self.points()[:, 1].max())
        return self.surfaces[name]


@dataclass(frozen=True)
class AssetFile:
    """One asset and the conventions of its file."""

    build: Callable[[Asset], None]
    file: str
    """File name without suffix."""
    root: str
    """Name of the default prim."""
    looks: str
    has_kind: bool
    """Whether the default prim has kind `component`; otherwise the referencing prim may author it."""
    is_y_up: bool
    """Whether the file is Y up in centimetres in any scene; the referencing prim corrects it."""
    is_model: bool
    """Whether the file is a simulation model: meshes below `base_link/visual`, a box in `base_link/collision`."""

    def make(self) -> Asset:
        """Return the asset with its parts."""
        made = Asset(self.root, self.looks)
        self.build(made)
        return made


def asset(
    file: str = "",
    root: str = "",
    *,
    looks: str = "Looks",
    has_kind: bool = True,
    is_y_up: bool = False,
    is_model: bool = False,
) -> Callable[[Callable[[Asset], None]], AssetFile]:
    """Return a decorator that turns a function that fills an empty asset into an `AssetFile`.

    The file is named after the function unless `file` is given, the default prim after the file unless `root` is given.
    """

    def describe(build: Callable[[Asset], None]) -> AssetFile:
        name = file or build.__name__
        return AssetFile(build, name, root or name, looks, has_kind and not is_model, is_y_up, is_model)

    return describe


def collect_assets(modules: Iterable[ModuleType]) -> dict[str, AssetFile]:
    """Return the assets defined in the modules by function name."""
    return {name: value for module in modules for name, value in vars(module).items() if isinstance(value, AssetFile)}
