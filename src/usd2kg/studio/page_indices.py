"""PageIndices: the numbers by which the page names objects, classes and concepts; -1 is none."""

from collections.abc import Mapping, Sequence
from functools import cached_property

from usd2kg.grounding import Grounding
from usd2kg.ontology import ClassIRI, TBox
from usd2kg.relations import Relation
from usd2kg.scene import Scene

__all__ = ["NONE", "PageIndices"]

NONE = -1


class PageIndices:
    """Indices of the objects of a scene, the classes of a TBox, and the concepts of a grounding."""

    def __init__(self, scene: Scene, tbox: TBox, grounding: Grounding, relations: Sequence[Relation]) -> None:
        self.scene = scene
        self.tbox = tbox
        self.concept_iris = tuple(sorted(grounding.concepts))
        self._objects = {obj.prim_path: index for index, obj in enumerate(scene.objects)}
        self._classes = {cls.iri: index for index, cls in enumerate(tbox.classes)}
        self._concepts = {iri: index for index, iri in enumerate(self.concept_iris)}
        self._room_of = {r.target: r.anchor for r in relations if r.kind == "room"}

    def object(self, prim_path: str | None) -> int:
        """Return the index of an object."""
        return self._objects.get(prim_path or "", NONE)

    def class_(self, iri: ClassIRI | None) -> int:
        """Return the index of a class."""
        return self._classes.get(iri or "", NONE)

    def concept(self, iri: str | None) -> int:
        """Return the index of a concept."""
        return self._concepts.get(iri or "", NONE)

    @cached_property
    def rooms(self) -> tuple[str, ...]:
        """Prim paths of the rooms, which may be groups and no objects."""
        return tuple(dict.fromkeys(self._room_of.values()))

    @cached_property
    def room_of(self) -> Mapping[str, int]:
        """Prim path of an object → index of its room in `rooms`."""
        index = {path: number for number, path in enumerate(self.rooms)}
        return {path: index[room] for path, room in self._room_of.items()}
