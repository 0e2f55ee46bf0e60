"""What is known of one thing for telling what became of it, whether it comes from a graph or from a scene."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from usd2kg.scene import Scene, SceneObject

__all__ = ["Link", "ObjectState", "Vector", "objects_of_scene"]

Vector = tuple[float, float, float]


class Link(NamedTuple):
    """A spatial relation, seen from the thing that has it."""

    kind: str
    """One of `relations.ALL_KINDS`."""
    anchor: str
    """Prim path of the other one."""


@dataclass(frozen=True, slots=True)
class ObjectState:
    """One thing at one time. Lengths are metres and masses kilograms in the z-up world frame; None is not known."""

    prim_path: str
    iri: str = ""
    """IRI of its individual; empty where there is no graph."""
    classes: tuple[str, ...] = ()
    """IRIs of the classes it was grounded to, sorted; empty if none, or where nobody was asked."""
    class_label: str = ""
    """The same in words."""
    size: Vector | None = None
    """Extents along its own axes where those are known, else along the world's."""
    center: Vector | None = None
    """Middle of its world box, with all that is nested below it."""
    position: Vector | None = None
    """Origin of its own frame."""
    orientation: tuple[float, float, float, float] | None = None
    """Of its own frame, quaternion x y z w."""
    mass_kg: float | None = None
    assets: frozenset[str] = frozenset()
    """Identifiers of the asset it comes from."""
    links: frozenset[Link] = frozenset()
    """What it is on, inside, part of, near…; symmetric relations are told of both."""

    @property
    def name(self) -> str:
        """The last step of its prim path."""
        return self.prim_path.rpartition("/")[2]

    @property
    def parent(self) -> str:
        """Path of the prim that it is in; / at the top."""
        return self.prim_path.rpartition("/")[0] or "/"

    @property
    def place(self) -> Vector | None:
        """Where it is: the middle of its box, or else the origin of its frame."""
        return self.center if self.center is not None else self.position


def objects_of_scene(scene: Scene) -> tuple[ObjectState, ...]:
    """Return the objects of a scene as things, without IRIs, classes and relations; sorted by prim path."""
    return tuple(sorted(_things(scene), key=lambda thing: thing.prim_path))


def _things(scene: Scene) -> Iterator[ObjectState]:
    for obj in scene.objects:
        yield ObjectState(
            obj.prim_path,
            size=_size(obj),
            center=obj.box.center if obj.box else None,
            position=obj.position,
            orientation=obj.orientation,
            mass_kg=obj.mass_kg,
            assets=frozenset(obj.asset),
        )


def _size(obj: SceneObject) -> Vector | None:
    return obj.oriented_size or (obj.box.size if obj.box else None)
