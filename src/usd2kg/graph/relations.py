"""Spatial relations between objects, from their boxes: what is on what, what is inside what.

Each relation carries the numbers it rests on and the id of its rule. The thresholds are in `data/spatial.toml`.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from usd2kg.grounding import Grounding
from usd2kg.ontology import ClassIRI, TBox, expand_curie
from usd2kg.scene import Box, Scene, SceneObject

__all__ = ["Relation", "find_relations"]


@dataclass(frozen=True, slots=True)
class Relation:
    """One relation between two objects."""

    kind: str
    """`on` or `inside`."""
    target: str
    """Prim path of the thing that is on or inside."""
    anchor: str
    """Prim path of what it is on or inside of."""
    rule: str
    numbers: Mapping[str, float]
    """What was measured: metres for `gap`, no unit for ratios."""


@lru_cache(maxsize=1)
def _load_rules() -> dict[str, Any]:
    return tomllib.loads((files("usd2kg.graph") / "data" / "spatial.toml").read_text("utf-8"))


class _ClassLists:
    """Which objects may take which part, by their grounded class."""

    def __init__(self, rules: Mapping[str, Any], tbox: TBox, grounding: Grounding) -> None:
        self._tbox = tbox
        self._grounding = grounding
        self._lists = {
            name: frozenset(expand_curie(item) for item in value)
            for name, value in rules.items()
            if isinstance(value, list)
        }
        self._disposition = expand_curie(rules["containment_disposition"])
        self._tells_containers = any(self._disposition in cls.dispositions for cls in tbox.classes)

    def is_in(self, name: str, obj: SceneObject) -> bool:
        """Return whether the object's class is in the list `name`, or below a class that is."""
        iri = self._class(obj)
        return iri is not None and not self._lists[name].isdisjoint(self._tbox.closure(iri))

    def can_contain(self, obj: SceneObject) -> bool:
        """Return whether things can be inside the object; any object can where the ontology does not tell."""
        iri = self._class(obj)
        if not self._tells_containers or iri is None:
            return True
        if self.is_in("not_containers", obj):
            return False
        return self._disposition in self._tbox.by_iri[iri].dispositions or self.is_in("containers", obj)

    def _class(self, obj: SceneObject) -> ClassIRI | None:
        prediction = self._grounding.by_path.get(obj.prim_path)
        return prediction.class_iri if prediction else None


def find_relations(scene: Scene, tbox: TBox, grounding: Grounding) -> tuple[Relation, ...]:
    """Return the relations of all objects that have a box, in scene order.

    An object is on one other at most, the nearest below it (a book on a tray on a table is on the tray), and inside
    one other at most, the smallest. Boxes are each object's own, without the objects nested below it.
    """
    rules = _load_rules()
    lists = _ClassLists(rules["classes"], tbox, grounding)
    objects = [obj for obj in scene.objects if obj.own_box is not None]
    if not objects:
        return ()
    finder = _Finder(objects, lists, rules)
    placed = [index for index, obj in enumerate(objects) if not lists.is_in("not_placed", obj)]
    inside = {index: found for index in placed if (found := finder.container(index))}
    container_of = {index: found.anchor for index, found in inside.items()}
    relations: list[Relation] = []
    for index in placed:
        on = finder.supporter(index)
        if on is not None and index in inside:
            # What lies in a bowl on a table is not on the table, and the bowl's own bottom adds nothing.
            supporter = finder.index(on.anchor)
            if container_of.get(supporter) != container_of[index]:
                on = None
        relations.extend(found for found in (on, inside.get(index)) if found is not None)
    return tuple(relations)


class _Finder:
    """Finds the anchors of one target at a time among all objects.

    Anchors of "on" are the parts of objects, in arrays sorted by the height of their tops, so that only those at the
    right height are compared.
    """

    def __init__(self, objects: list[SceneObject], lists: _ClassLists, rules: Mapping[str, Any]) -> None:
        self._objects = objects
        self._indices = {obj.prim_path: index for index, obj in enumerate(objects)}
        self._lists = lists
        self._on = rules["on"]
        self._inside = rules["inside"]
        boxes = [_box(obj) for obj in objects]
        self._lower = np.array([box.lower for box in boxes])
        self._upper = np.array([box.upper for box in boxes])
        size = self._upper - self._lower
        self._height = size[:, 2]
        self._area = size[:, 0] * size[:, 1]
        self._volume = self._area * size[:, 2]
        self._by_top = np.argsort(self._upper[:, 2], kind="stable")
        self._tops = self._upper[self._by_top, 2]
        self._can_contain = np.array([lists.can_contain(obj) for obj in objects])
        self._sort_parts()

    def _sort_parts(self) -> None:
        owners: list[int] = []
        boxes: list[Box] = []
        for index, obj in enumerate(self._objects):
            if not self._lists.is_in("not_supporting", obj):
                parts = obj.part_boxes or (_box(obj),)
                owners.extend([index] * len(parts))
                boxes.extend(parts)
        order = np.argsort(np.array([box.upper[2] for box in boxes]), kind="stable")
        self._part_owner = np.array(owners, dtype=int)[order]
        self._part_lower = np.array([box.lower for box in boxes]).reshape(-1, 3)[order]
        self._part_upper = np.array([box.upper for box in boxes]).reshape(-1, 3)[order]

    def index(self, prim_path: str) -> int:
        """Return the place of an object among those that have a box."""
        return self._indices[prim_path]

    def supporter(self, target: int) -> Relation | None:
        """Return what `target` is on: of all parts that can carry it, the one that lies nearest below."""
        rule = self._on
        bottom = self._lower[target, 2]
        allowed = min(max(rule["gap_share"] * self._height[target], rule["min_gap"]), rule["max_gap"])
        tops = self._part_upper[:, 2]
        highest = bottom + max(allowed, rule["max_sink"])
        near = slice(*np.searchsorted(tops, (bottom - allowed, np.nextafter(highest, np.inf)), side="left"))
        owner, lower, upper = self._part_owner[near], self._part_lower[near], self._part_upper[near]
        gap = bottom - upper[:, 2]
        may_sink = np.maximum(allowed, np.minimum(rule["sink_share"] * (upper[:, 2] - lower[:, 2]), rule["max_sink"]))
        ratio = _overlap(self._lower[target], self._upper[target], lower, upper) / max(self._area[target], 1e-12)
        good = np.flatnonzero(
            (owner != target)
            & (-gap <= may_sink)
            & (ratio > rule["min_overlap_ratio"])
            & (self._area[target] < rule["max_area_ratio"] * self._area[owner])
            # What begins below the target's own bottom carries it; what hangs beside it does not.
            & (lower[:, 2] < bottom)
        )
        if not good.size:
            return None
        best = min(good, key=lambda i: (-lower[i, 2], abs(gap[i]), -ratio[i], owner[i]))
        numbers = {"gap": float(gap[best]), "overlapRatio": float(min(ratio[best], 1.0))}
        return self._relation("on", target, int(owner[best]), rule["rule"], numbers)

    def container(self, target: int) -> Relation | None:
        """Return what `target` is inside of: of all containers around it, the smallest."""
        if self._lists.is_in("not_contained", self._objects[target]) or not self._volume[target] > 0:
            return None
        # A container's top is above the target's bottom.
        around = self._by_top[np.searchsorted(self._tops, self._lower[target, 2], side="right") :]
        around = around[(around != target) & self._can_contain[around] & (self._volume[around] > self._volume[target])]
        height = np.minimum(self._upper[target, 2], self._upper[around, 2]) - np.maximum(
            self._lower[target, 2], self._lower[around, 2]
        )
        shared = _overlap(self._lower[target], self._upper[target], self._lower[around], self._upper[around])
        ratio = shared * np.clip(height, 0, None) / self._volume[target]
        good = np.flatnonzero(ratio >= self._inside["min_volume_ratio"])
        if not good.size:
            return None
        best = min(good, key=lambda i: (self._volume[around[i]], around[i]))
        numbers = {"insideRatio": float(min(ratio[best], 1.0))}
        return self._relation("inside", target, int(around[best]), self._inside["rule"], numbers)

    def _relation(self, kind: str, target: int, anchor: int, rule: str, numbers: Mapping[str, float]) -> Relation:
        return Relation(kind, self._objects[target].prim_path, self._objects[anchor].prim_path, rule, numbers)


_Array = NDArray[np.float64]


def _overlap(lower: _Array, upper: _Array, lowers: _Array, uppers: _Array) -> _Array:
    """Return the area that the footprint of one box shares with each of many, in square metres."""
    sides = np.minimum(upper[:2], uppers[:, :2]) - np.maximum(lower[:2], lowers[:, :2])
    clipped = np.clip(sides, 0, None)
    area: _Array = clipped[:, 0] * clipped[:, 1]
    return area


def _box(obj: SceneObject) -> Box:
    assert obj.own_box is not None, "objects without a box are left out before"
    return obj.own_box
