"""color_scene: the colours of the objects of a scene by class, concept, confidence or room."""

from collections.abc import Sequence
from enum import StrEnum

from usd2kg.diagrams.coloring import Coloring, color_by_confidence, color_by_group
from usd2kg.grounding import Grounding
from usd2kg.ontology import TBox
from usd2kg.relations import Relation

__all__ = ["ColorMode", "color_scene"]


class ColorMode(StrEnum):
    """What the colour of an object shows."""

    MATERIAL = "material"
    CLASS = "class"
    CONCEPT = "concept"
    CONFIDENCE = "confidence"
    ROOM = "room"
    ANSWER = "answer"


def color_scene(
    mode: ColorMode, tbox: TBox, grounding: Grounding, suggestions: Grounding, relations: Sequence[Relation]
) -> Coloring:
    """Return the colours of all objects by a property of theirs.

    Args:
        mode: class, concept, confidence or room.
        tbox: the classes.
        grounding: the grounding with the decisions of a person.
        suggestions: the same without; it has the confidence, and colours are given to classes by their size in it.
        relations: the relations between the objects, for rooms.
    """
    predictions = grounding.predictions
    if mode is ColorMode.CONFIDENCE:
        return color_by_confidence({p.prim_path: p.confidence for p in suggestions.predictions})
    if mode is ColorMode.CLASS:
        return color_by_group(
            {p.prim_path: p.class_iri for p in predictions},
            {cls.iri: cls.label for cls in tbox.classes},
            {p.prim_path: p.class_iri for p in suggestions.predictions},
            "no class",
        )
    if mode is ColorMode.CONCEPT:
        of_object = {p.prim_path: p.concept for p in predictions}
        labels = {iri: grounding.concepts[iri].label for iri in sorted(grounding.concepts)}
        return color_by_group(of_object, labels, of_object, "no concept")
    assert mode is ColorMode.ROOM, f"{mode} is no property of a scene"
    rooms = {relation.target: relation.anchor for relation in relations if relation.kind == "room"}
    in_room = {p.prim_path: rooms.get(p.prim_path) for p in predictions}
    labels = {room: room.rpartition("/")[2] for room in rooms.values()}
    return color_by_group(in_room, labels, in_room, "no room")
