"""What changed between two graphs of a scene, told by things, and as an update that turns the one into the other."""

from usd2kg.diff.carry import CarriedDecisions, Unplaced, carry_decisions
from usd2kg.diff.compare import USUAL_KINDS, Change, Changes, Move, compare_things
from usd2kg.diff.graph_things import Writing, read_statements, things_of_graph, writing_of
from usd2kg.diff.match import Match, Matching, match_things
from usd2kg.diff.reason import tell_match
from usd2kg.diff.thing import Link, Thing, things_of_scene
from usd2kg.diff.tolerances import Tolerances
from usd2kg.diff.update import Update, make_update

__all__ = [
    "USUAL_KINDS",
    "CarriedDecisions",
    "Change",
    "Changes",
    "Link",
    "Match",
    "Matching",
    "Move",
    "Thing",
    "Tolerances",
    "Unplaced",
    "Update",
    "Writing",
    "carry_decisions",
    "compare_things",
    "make_update",
    "match_things",
    "read_statements",
    "tell_match",
    "things_of_graph",
    "things_of_scene",
    "writing_of",
]
