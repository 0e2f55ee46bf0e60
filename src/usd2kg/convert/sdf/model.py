"""Records of the contents of an SDFormat file, with unresolved poses."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from usd2kg.convert.sdf.values import Matrix
from usd2kg.convert.sdf.xml_tree import XmlElement

__all__ = ["Asset", "Axis", "Model", "Pose", "SdfFrame", "SdfJoint", "SdfLink", "SdfWorld", "Visual"]


@dataclass(frozen=True, eq=False)
class Pose:
    """A pose in metres and radians."""

    matrix: Matrix
    relative_to: str = ""
    """Name of a frame in the scope; empty for the default frame of the element."""


@dataclass(frozen=True, eq=False)
class SdfFrame:
    """A named frame of a model or world."""

    name: str
    pose: Pose
    attached_to: str = ""


@dataclass(frozen=True, eq=False)
class Visual:
    """A visual shape."""

    name: str
    pose: Pose
    """By default relative to the link."""
    geometry: XmlElement
    path: Path
    """File that contains the element."""
    material: XmlElement | None = None
    transparency: float = 0.0


@dataclass(frozen=True, eq=False)
class SdfLink:
    """A body of a model."""

    name: str
    pose: Pose
    visuals: tuple[Visual, ...] = ()
    mass: float | None = None
    """Kilograms; None if the file does not state it."""
    center_of_mass: Pose | None = None


@dataclass(frozen=True)
class Axis:
    """The axis of a joint."""

    xyz: tuple[float, ...]
    """(3,), in the frame `expressed_in`."""
    expressed_in: str = ""
    """Name of a frame; empty for the frame of the joint."""
    lower: float | None = None
    """Radians or metres; None if unlimited."""
    upper: float | None = None


@dataclass(frozen=True, eq=False)
class SdfJoint:
    """A joint between two links, or a link and the world."""

    name: str
    type: str
    parent: str
    child: str
    pose: Pose
    """By default relative to the child."""
    element: XmlElement
    path: Path
    axis: Axis | None = None


@dataclass(frozen=True)
class Asset:
    """A model referenced by an include; several includes may share it."""

    name: str
    uri: str
    texts: Mapping[str, str] = field(default_factory=dict)
    """Name and description in its model.config."""


@dataclass(frozen=True, eq=False)
class Model:
    """A model, or an actor."""

    name: str
    pose: Pose
    element: XmlElement
    path: Path
    placement_frame: str = ""
    """Frame of the model that its pose refers to; empty for the model frame."""
    canonical_link: str = ""
    is_static: bool = False
    is_person: bool = False
    """Whether it is an actor with a skin."""
    asset: Asset | None = None
    links: tuple[SdfLink, ...] = ()
    joints: tuple[SdfJoint, ...] = ()
    frames: tuple[SdfFrame, ...] = ()
    models: tuple["Model", ...] = ()


@dataclass(frozen=True, eq=False)
class SdfWorld:
    """A world, or the models of a file without one."""

    name: str
    """Empty for a file without a world."""
    models: tuple[Model, ...]
    frames: tuple[SdfFrame, ...] = ()
    joints: tuple[SdfJoint, ...] = ()
