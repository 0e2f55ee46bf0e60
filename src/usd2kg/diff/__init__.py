"""Compare two versions of a scene or graph: changed objects, and the update that turns one graph into the other."""

from usd2kg.diff.carry import CarriedDecisions, UnplacedDecision, carry_decisions
from usd2kg.diff.compare import USUAL_KINDS, Change, Changes, Move, compare_objects
from usd2kg.diff.graph_states import (
    GraphStyle,
    detect_graph_style,
    objects_of_graph,
)
from usd2kg.diff.match import Matching, ObjectMatch, match_objects
from usd2kg.diff.match_description import describe_match
from usd2kg.diff.object_state import Link, ObjectState, objects_of_scene
from usd2kg.diff.tolerances import DEFAULT_TOLERANCES, Tolerances
from usd2kg.diff.update import GraphUpdate, make_update

__all__ = [
    "DEFAULT_TOLERANCES",
    "USUAL_KINDS",
    "CarriedDecisions",
    "Change",
    "Changes",
    "GraphStyle",
    "GraphUpdate",
    "Link",
    "Matching",
    "Move",
    "ObjectMatch",
    "ObjectState",
    "Tolerances",
    "UnplacedDecision",
    "carry_decisions",
    "compare_objects",
    "describe_match",
    "detect_graph_style",
    "make_update",
    "match_objects",
    "objects_of_graph",
    "objects_of_scene",
]
