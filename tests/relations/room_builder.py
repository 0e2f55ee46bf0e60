"""Small rooms of boxes with given classes, and their relations."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from typing import Any

from tests.graph.records import Corner, ground_as, thing
from tests.grounding.records import make_scene
from usd2kg.ontology import TBox, load_home_tbox
from usd2kg.relations import Relation, RelationOptions, find_relations, load_rules
from usd2kg.scene import SceneObject
from usd2kg.shapes.surface import Surface

RULES = load_rules()
HAIR = 1e-4
"""Metres: far above rounding, far below every threshold."""

Placed = tuple[SceneObject, str]
"""An object and the local name of its class, empty for none."""

FLOOR: Placed = (thing("/floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor")
TABLE: Placed = (thing("/table", (0, 0, 0), (1, 1, 0.7)), "Table")

home = cache(load_home_tbox)


def relate(
    *placed: Placed,
    kinds: Iterable[str] | None = ("on", "inside"),
    tbox: TBox | None = None,
    joints: Any = (),
    surfaces: Mapping[str, Surface] | None = None,
    **options: Any,
) -> tuple[Relation, ...]:
    """Return the relations of the given kinds in a scene of these objects."""
    tbox = tbox or home()
    scene = replace(make_scene(*(obj for obj, _ in placed), joints=joints), surfaces=surfaces or {})
    grounding = ground_as(tbox, scene, {obj.prim_path: cls for obj, cls in placed if cls})
    chosen = tuple(kinds) if kinds is not None else None
    return find_relations(scene, tbox, grounding, RelationOptions(kinds=chosen, **options))


def cup(lower: Corner, size: Corner = (0.1, 0.1, 0.1), name: str = "cup") -> Placed:
    return thing(f"/{name}", lower, size), "Cup"


def artifact(name: str, lower: Corner, size: Corner, **known: Any) -> Placed:
    return thing(f"/{name}", lower, size, **known), "DesignedArtifact"


def pairs(relations: Iterable[Relation]) -> set[tuple[str, frozenset[str]]]:
    """Return symmetric relations as (kind, the two names)."""
    return {(r.kind, frozenset({r.target.rpartition("/")[2], r.anchor.rpartition("/")[2]})) for r in relations}
