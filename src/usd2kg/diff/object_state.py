"""ObjectState: the properties of one object of a graph or scene that a comparison needs."""

from dataclasses import dataclass
from typing import NamedTuple

from usd2kg.scene import Scene

__all__ = ["Link", "ObjectState", "Quaternion", "Vector", "objects_of_scene"]

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w."""


class Link(NamedTuple):
    """A spatial relation of an object."""

    kind: str
    """One of `relations.ALL_KINDS`."""
    anchor: str
    """Prim path of the other object."""


@dataclass(frozen=True, slots=True)
class ObjectState:
    """One object in one version of a scene, in metres, kilograms and the z-up world frame. None means unknown."""

    prim_path: str
    iri: str = ""
    """IRI of the individual; empty if the object comes from a scene."""
    classes: tuple[str, ...] = ()
    """IRIs of its classes, sorted; empty if it has none or was not grounded."""
    class_label: str = ""
    """Labels of the classes."""
    size: Vector | None = None
    """Extents along the object's axes if they are known, else of the world box."""
    box_size: Vector | None = None
    """Extents of the world box, nested objects included."""
    center: Vector | None = None
    """Centre of the world box, nested objects included."""
    position: Vector | None = None
    """Origin of the object's frame."""
    orientation: Quaternion | None = None
    """Orientation of the object's frame."""
    mass_kg: float | None = None
    assets: frozenset[str] = frozenset()
    """Identifiers of the asset that the object comes from."""
    links: frozenset[Link] = frozenset()
    """Relations; both objects of a symmetric relation have it."""

    @property
    def name(self) -> str:
        """The last element of the prim path."""
        return self.prim_path.rpartition("/")[2]

    @property
    def parent(self) -> str:
        """Path of the parent prim; / for a root prim."""
        return self.prim_path.rpartition("/")[0] or "/"

    @property
    def place(self) -> Vector | None:
        """Centre of the box, else origin of the frame."""
        return self.center if self.center is not None else self.position


def objects_of_scene(scene: Scene) -> tuple[ObjectState, ...]:
    """Return the objects of a scene sorted by prim path, without IRIs, classes and relations."""
    states = (
        ObjectState(
            obj.prim_path,
            size=obj.oriented_size or (obj.box.size if obj.box else None),
            box_size=obj.box.size if obj.box else None,
            center=obj.box.center if obj.box else None,
            position=obj.position,
            orientation=obj.orientation,
            mass_kg=obj.mass_kg,
            assets=frozenset(obj.asset),
        )
        for obj in scene.objects
    )
    return tuple(sorted(states, key=lambda state: state.prim_path))
