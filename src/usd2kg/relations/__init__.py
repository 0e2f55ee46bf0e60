"""Spatial relations between objects, from their boxes: what is on, in, above, beside, between and part of what.

Each relation carries the numbers it rests on and the id of its rule. The thresholds are in `data/spatial.toml`;
docs/relations.md tells what each kind means.
"""

from usd2kg.relations.find import find_relations
from usd2kg.relations.model import (
    ALL_KINDS,
    DEFAULT_KINDS,
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
    "SYMMETRIC_KINDS",
    "VIEWPOINT_KINDS",
    "Relation",
    "RelationOptions",
    "RelationRules",
    "Viewpoint",
    "find_relations",
    "load_rules",
    "parse_kinds",
    "parse_viewpoint",
]
