"""color_scene: the colours of the objects of a scene by class, concept, confidence, room or support."""

from collections.abc import Sequence
from enum import StrEnum

from usd2kg.diagrams.coloring import Coloring, color_by_confidence, color_by_group
from usd2kg.grounding import Grounding
from usd2kg.ontology import TBox
from usd2kg.relations import Relation

__all__ = ["ColorMode", "color_scene"]


class ColorMode(StrEnum):
    """The property shown by the colour of an object."""

    MATERIAL = "material"
    CLASS = "class"
    CONCEPT = "concept"
    CONFIDENCE = "confidence"
    ROOM = "room"
    SUPPORT = "support"
    ANSWER = "answer"


def color_scene(
    mode: ColorMode, tbox: TBox, grounding: Grounding, suggestions: Grounding, relations: Sequence[Relation]
) -> Coloring:
    """Return the colours of all objects by one of their properties.

    Args:
        mode: class, concept, confidence, room or support.
        tbox: the classes.
        grounding: the grounding with the decisions of a person.
        suggestions: the same without; it has the confidence, and colours are given to classes by their size in it.
        relations: the relations between the objects, for rooms and supports.
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
    kinds, none = (("room",), "no room") if mode is ColorMode.ROOM else (("on", "inside"), "not on or in anything")
    # Later kinds win: an object in a box on a shelf is in the box.
    anchor_of = {r.target: r.anchor for kind in kinds for r in relations if r.kind == kind}
    groups = {p.prim_path: anchor_of.get(p.prim_path) for p in predictions}
    # Rooms may be groups, which are not objects.
    order = dict.fromkeys([*(path for path in groups if path in anchor_of.values()), *anchor_of.values()])
    labels = {path: path.rpartition("/")[2] for path in order}
    return color_by_group(groups, labels, groups, none)
