"""The context of an object: its neighbours, its placement, and its view under a naming regime."""

from usd2kg.grounding.context.neighbours import Nearness, Neighbour, Neighbourhood, size_distance
from usd2kg.grounding.context.placement import Appearance, BoxGrid, PlacedObject, Placement
from usd2kg.grounding.context.views import (
    ABBREVIATED_LENGTH,
    EVIDENCE_GROUPS,
    STUDY_GROUPS,
    NamingRegime,
    ObjectView,
    abbreviate,
    view_objects,
)

__all__ = [
    "ABBREVIATED_LENGTH",
    "EVIDENCE_GROUPS",
    "STUDY_GROUPS",
    "Appearance",
    "BoxGrid",
    "NamingRegime",
    "Nearness",
    "Neighbour",
    "Neighbourhood",
    "ObjectView",
    "PlacedObject",
    "Placement",
    "abbreviate",
    "size_distance",
    "view_objects",
]
