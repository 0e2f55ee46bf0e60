"""Spatial relations between objects, from their surfaces, boxes and classes; no RDF.

Each relation carries its measurements and the id of its rule. `knowledge/spatial.toml` holds the thresholds;
docs/relations.md defines each kind.
"""

from usd2kg.relations.derived_room import DerivedRoom
from usd2kg.relations.find import find_relations
from usd2kg.relations.model import (
    ALL_KINDS,
    DEFAULT_KINDS,
    ROOM_KINDS,
    SYMMETRIC_KINDS,
    VIEWPOINT_KINDS,
    Relation,
    Viewpoint,
    parse_kinds,
    parse_viewpoint,
)
from usd2kg.relations.options import RelationOptions
from usd2kg.relations.rule_file import load_rules
from usd2kg.relations.thresholds import RelationRules

__all__ = [
    "ALL_KINDS",
    "DEFAULT_KINDS",
    "ROOM_KINDS",
    "SYMMETRIC_KINDS",
    "VIEWPOINT_KINDS",
    "DerivedRoom",
    "Relation",
    "RelationOptions",
    "RelationRules",
    "Viewpoint",
    "find_relations",
    "load_rules",
    "parse_kinds",
    "parse_viewpoint",
]
