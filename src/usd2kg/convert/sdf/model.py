"""What an SDFormat file describes, as records; poses are not yet resolved."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from usd2kg.convert.sdf.values import Matrix
from usd2kg.convert.sdf.xml_tree import XmlElement

__all__ = ["Asset", "Axis", "Frame", "Joint", "Link", "Model", "Pose", "Visual", "World"]


@dataclass(frozen=True, eq=False)
class Pose:
    """A pose in metres and radians."""

    matrix: Matrix
    relative_to: str = ""
    """Name of a frame in the scope; empty for the default frame of the element."""


@dataclass(frozen=True, eq=False)
class Frame:
    """A named frame of a model or world."""

    name: str
    pose: Pose
    attached_to: str = ""


@dataclass(frozen=True, eq=False)
class Visual:
    """A shape that is seen."""

    name: str
    pose: Pose
    """By default relative to the link."""
    geometry: XmlElement
    path: Path
    """The file that states it."""
    material: XmlElement | None = None
    transparency: float = 0.0


@dataclass(frozen=True, eq=False)
class Link:
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
    """Name of a frame; empty for that of the joint."""
    lower: float | None = None
    """Radians or metres; None if it is unlimited."""
    upper: float | None = None


@dataclass(frozen=True, eq=False)
class Joint:
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
    """The model that an include names, of which there may be several copies."""

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
    """The frame of the model that its pose places; empty for its own frame."""
    canonical_link: str = ""
    is_static: bool = False
    is_person: bool = False
    """Whether it is an actor with a skin."""
    asset: Asset | None = None
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    frames: tuple[Frame, ...] = ()
    models: tuple["Model", ...] = ()


@dataclass(frozen=True, eq=False)
class World:
    """A world, or the models of a file without one."""

    name: str
    """Empty for a file without a world."""
    models: tuple[Model, ...]
    frames: tuple[Frame, ...] = ()
    joints: tuple[Joint, ...] = ()
