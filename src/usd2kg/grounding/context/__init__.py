"""What surrounds an object: its neighbours, its placement, and the view of it that a naming regime allows."""

from usd2kg.grounding.context.neighbours import Companion, Company, Nearness, size_distance
from usd2kg.grounding.context.placement import Look, Neighbour
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
    "Companion",
    "Company",
    "Look",
    "NamingRegime",
    "Nearness",
    "Neighbour",
    "ObjectView",
    "abbreviate",
    "size_distance",
    "view_objects",
]
