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

    An object is on one other at most, the highest that carries it, and inside one other at most, the smallest.
    Boxes are each object's own, without the objects nested below it.
    """
    rules = _load_rules()
    lists = _ClassLists(rules["classes"], tbox, grounding)
    objects = [obj for obj in scene.objects if obj.own_box is not None]
    if not objects:
        return ()
    finder = _Finder(objects, lists, rules)
    found: list[Relation] = []
    for index, obj in enumerate(objects):
        if lists.is_in("not_placed", obj):
            continue
        on = finder.supporter(index)
        inside = finder.container(index)
        found.extend(relation for relation in (on, inside) if relation is not None)
    return tuple(found)


class _Finder:
    """Finds the anchors of one target at a time among all objects.

    Candidates come from arrays sorted by the height of the anchors' tops, so that only those at the right height
    are compared.
    """

    def __init__(self, objects: list[SceneObject], lists: _ClassLists, rules: Mapping[str, Any]) -> None:
        self._objects = objects
        self._lists = lists
        self._on = rules["on"]
        self._inside = rules["inside"]
        boxes = [_box(obj) for obj in objects]
        self._lower = np.array([box.lower for box in boxes])
        self._upper = np.array([box.upper for box in boxes])
        self._size = self._upper - self._lower
        self._area = self._size[:, 0] * self._size[:, 1]
        self._volume = self._area * self._size[:, 2]
        self._by_top = np.argsort(self._upper[:, 2], kind="stable")
        self._tops = self._upper[self._by_top, 2]
        self._can_support = np.array([not lists.is_in("not_supporting", obj) for obj in objects])
        self._can_contain = np.array([lists.can_contain(obj) for obj in objects])

    def supporter(self, target: int) -> Relation | None:
        """Return what `target` is on: of all that can carry it, the highest, then the one most under it."""
        rule = self._on
        bottom, height = self._lower[target, 2], self._size[target, 2]
        allowed = min(max(rule["gap_share"] * height, rule["min_gap"]), rule["max_gap"])
        first, last = np.searchsorted(self._tops, (bottom - allowed, bottom + allowed), side="left")
        nearby = self._by_top[first : last + 1]
        nearby = nearby[(nearby != target) & self._can_support[nearby]]
        gaps = bottom - self._upper[nearby, 2]
        overlap = self._footprint_overlap(target, nearby)
        area = self._area[target]
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = overlap / area
            iou = overlap / (area + self._area[nearby] - overlap)
            fits = area / self._area[nearby] < rule["max_area_ratio"]
        good = (
            (np.abs(gaps) <= allowed)
            & (ratio > rule["min_overlap_ratio"])
            & (iou >= rule["min_footprint_iou"])
            & fits
            # What begins below the target's own bottom carries it; what hangs beside it does not.
            & (self._lower[nearby, 2] < bottom)
        )
        if not good.any():
            return None
        best = max(np.flatnonzero(good), key=lambda i: (-gaps[i], ratio[i], -nearby[i]))
        numbers = {"gap": float(gaps[best]), "overlapRatio": float(ratio[best])}
        return self._relation("on", target, int(nearby[best]), rule["rule"], numbers)

    def container(self, target: int) -> Relation | None:
        """Return what `target` is inside of: of all containers around it, the smallest."""
        if self._lists.is_in("not_contained", self._objects[target]) or not self._volume[target] > 0:
            return None
        # A container's top is above the target's bottom.
        around = self._by_top[np.searchsorted(self._tops, self._lower[target, 2], side="right") :]
        around = around[(around != target) & self._can_contain[around] & (self._volume[around] > self._volume[target])]
        shared = self._footprint_overlap(target, around) * np.clip(
            np.minimum(self._upper[target, 2], self._upper[around, 2])
            - np.maximum(self._lower[target, 2], self._lower[around, 2]),
            0,
            None,
        )
        ratio = shared / self._volume[target]
        good = np.flatnonzero(ratio >= self._inside["min_volume_ratio"])
        if not good.size:
            return None
        best = min(good, key=lambda i: (self._volume[around[i]], around[i]))
        numbers = {"insideRatio": float(min(ratio[best], 1.0))}
        return self._relation("inside", target, int(around[best]), self._inside["rule"], numbers)

    def _footprint_overlap(self, target: int, others: np.ndarray) -> np.ndarray:
        shared = np.minimum(self._upper[target, :2], self._upper[others, :2]) - np.maximum(
            self._lower[target, :2], self._lower[others, :2]
        )
        sides = np.clip(shared, 0, None)
        overlap: np.ndarray = sides[:, 0] * sides[:, 1]
        return overlap

    def _relation(self, kind: str, target: int, anchor: int, rule: str, numbers: Mapping[str, float]) -> Relation:
        return Relation(kind, self._objects[target].prim_path, self._objects[anchor].prim_path, rule, numbers)


def _box(obj: SceneObject) -> Box:
    assert obj.own_box is not None, "objects without a box are left out before"
    return obj.own_box
