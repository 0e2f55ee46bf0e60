"""What is well formed and hard to believe: sizes, supports, places, masses. The thresholds: data/plausibility.toml."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from statistics import median
from typing import NamedTuple

from usd2kg.validation.class_extents import typical_class_extent
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.object_classes import ObjectClasses
from usd2kg.validation.plausibility_rules import Rule, Rules

__all__ = ["CheckedScene", "ImplausibleFact", "find_implausible"]

_SMALLEST = 0.001
"""Metres. A thinner extent counts as this, so that a sheet has a volume to compare."""


@dataclass(frozen=True)
class CheckedScene:
    """The objects of a graph, and what they are."""

    objects: list[GraphObject]
    kinds: ObjectClasses
    has_probabilities: bool
    """Whether confidences are probabilities; otherwise they only rank."""

    @cached_property
    def by_iri(self) -> dict[str, GraphObject]:
        """IRI → object."""
        return {obj.iri: obj for obj in self.objects}


class ImplausibleFact(NamedTuple):
    """What is odd about an object."""

    rule: Rule
    obj: GraphObject
    found: str
    expected: str


_Check = Callable[[CheckedScene, Rule], Iterator[tuple[GraphObject, str, str]]]


def find_implausible(scene: CheckedScene, rules: Rules) -> Iterator[ImplausibleFact]:
    """Yield what the rules find implausible."""
    for name, check in _CHECKS.items():
        rule = rules[name]
        if rule.is_enabled:
            yield from (ImplausibleFact(rule, *found) for found in check(scene, rule))


def _named(obj: GraphObject) -> str:
    return f"“{obj.label}” ({obj.prim_path})"


def _size_text(size: tuple[float, float, float]) -> str:
    return f"{' × '.join(f'{side:.3g}' for side in size)} m"


def _volume(size: tuple[float, float, float]) -> float:
    return math.prod(max(side, _SMALLEST) for side in size)


def _unusual_size(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    factor = max(rule.number("factor"), 1.0)
    any_words, any_classes = rule.words("any_size_words"), rule.classes("any_size")
    for obj in scene.objects:
        if obj.own_size is None:
            continue
        longest = max(*obj.own_size, _SMALLEST)
        for cls in obj.classes:
            label = scene.kinds.label(cls)
            if cls in any_classes or label.rpartition(" ")[2] in any_words:
                continue
            usual = typical_class_extent(cls, label)
            if usual is not None and not usual / factor <= longest <= usual * factor:
                found = f"its longest extent is {longest:.3g} m ({_size_text(obj.own_size)}), and it is a {label}"
                expected = f"about {usual:.3g} m, {usual / factor:.2g} to {usual * factor:.2g} m"
                yield obj, found, expected


def _orientation(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    for obj in scene.objects:
        length = math.hypot(*obj.orientation) if obj.orientation is not None and len(obj.orientation) == 4 else 1.0
        if abs(length - 1) > rule.number("tolerance"):
            yield obj, f"the quaternion of its orientation has the length {length:.4g}", "length 1"


def _supports(scene: CheckedScene) -> Iterator[tuple[GraphObject, GraphObject]]:
    for obj in scene.objects:
        yield from ((obj, scene.by_iri[iri]) for iri in obj.supporters if iri in scene.by_iri)


def _support_smaller(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    for obj, carrier in _supports(scene):
        if obj.size is None or carrier.size is None or _has_legs(scene, obj):
            continue
        volumes = _volume(obj.size) / _volume(carrier.size)
        lengths = max(obj.size) / max(*carrier.size, _SMALLEST)
        is_odd = volumes > rule.number("volume_ratio") and lengths > rule.number("length_ratio")
        if is_odd and not scene.kinds.is_a(carrier, rule, "any_load", "any_load_words"):
            found = (
                f"it stands on {_named(carrier)}; its box of {_size_text(obj.size)} is {volumes:.0f} times as large "
                f"and {lengths:.1f} times as long as that one's {_size_text(carrier.size)}"
            )
            expected = (
                f"at most {rule.number('volume_ratio'):g} times as large or {rule.number('length_ratio'):g} as long"
            )
            yield obj, found, expected


def _has_legs(scene: CheckedScene, obj: GraphObject) -> bool:
    """Return whether a thing stands on several that are all smaller than it: a top may have slim legs."""
    carriers = [scene.by_iri[iri] for iri in obj.supporters if iri in scene.by_iri]
    return len(carriers) > 1 and all(
        carrier.size is not None and obj.size is not None and _volume(carrier.size) < _volume(obj.size)
        for carrier in carriers
    )


def _support_lighter(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    most = rule.number("mass_ratio")
    for obj, carrier in _supports(scene):
        if obj.mass_kg and carrier.mass_kg and carrier.mass_kg > 0 and obj.mass_kg > most * carrier.mass_kg:
            found = f"it has {obj.mass_kg:.3g} kg and stands on {_named(carrier)} of {carrier.mass_kg:.3g} kg"
            yield obj, found, f"at most {most:g} times the mass of what carries it"


def _support_odd(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    for obj, carrier in _supports(scene):
        if scene.kinds.is_a(obj, rule, "loads", "load_words") and scene.kinds.is_a(
            carrier, rule, "carriers", "carrier_words"
        ):
            found = f"it is a {scene.kinds.names(obj)} and stands on {_named(carrier)}, a {scene.kinds.names(carrier)}"
            yield obj, found, "what carries such a thing: a floor, furniture, a counter"


def _inside_smaller(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    """Yield what cannot be in its container. Spoons stand out of a pot: the longest extent says nothing."""
    slack = rule.number("slack")
    for obj in scene.objects:
        for container in (scene.by_iri[iri] for iri in obj.containers if iri in scene.by_iri):
            if obj.size is None or container.size is None:
                continue
            middle = sorted(obj.own_size or obj.size)[1]
            is_wide = middle > slack * math.hypot(*container.size)
            if is_wide or _volume(obj.size) > rule.number("volume_ratio") * _volume(container.size):
                found = f"its box of {_size_text(obj.size)} is said to be inside {_named(container)}"
                yield obj, found, f"to fit into that one's {_size_text(container.size)}"


def _below_floor(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    placed = [(obj, obj.center[2], obj.size[2]) for obj in scene.objects if obj.center and obj.size]
    tops = [z + height / 2 for obj, z, height in placed if scene.kinds.is_a(obj, rule, "floors", "floor_words")]
    if not tops:
        return
    floor = min(tops)
    for obj, z, height in placed:
        top = z + height / 2
        if top < floor - rule.number("depth") and not scene.kinds.is_a(obj, rule, "not_below", "not_below_words"):
            yield obj, f"its box ends at z = {top:.3g} m", f"above the lowest floor, whose top is at z = {floor:.3g} m"


def _far_away(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    placed = [(obj, obj.center) for obj in scene.objects if obj.center is not None]
    if len(placed) < max(rule.number("fewest"), 1):
        return
    middle = tuple(median(center[axis] for _, center in placed) for axis in range(3))
    distances = [(math.dist(center, middle), obj) for obj, center in placed]
    usual = sorted(distance for distance, _ in distances)[(len(distances) * 9) // 10 - 1]
    most = max(rule.number("factor") * usual, rule.number("least"))
    for distance, obj in distances:
        if distance > most:
            found = f"it is {distance:.3g} m from the middle of the scene; nine tenths of all are within {usual:.3g} m"
            yield obj, found, f"at most {most:.3g} m"


def _duplicate(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    step = max(rule.number("tolerance"), 1e-9)
    same: dict[tuple[int, ...], list[GraphObject]] = {}
    for obj in scene.objects:
        if obj.center is not None and obj.size is not None and max(obj.size) >= rule.number("least_extent"):
            key = tuple(round(value / step) for value in (*obj.center, *obj.size))
            same.setdefault(key, []).append(obj)
    for group in same.values():
        # What is nested in the other has its box for good reason: a group of one thing.
        first, *others = group
        for other in others:
            if not _is_nested(first, other):
                found = f"it has the place and the size of {_named(first)}: {_size_text(other.size or (0, 0, 0))}"
                yield other, found, "one object in one place"


def _is_nested(first: GraphObject, second: GraphObject) -> bool:
    return f"{second.prim_path}/".startswith(f"{first.prim_path}/") or f"{first.prim_path}/".startswith(
        f"{second.prim_path}/"
    )


def _density(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    lowest, highest = rule.number("lowest"), rule.number("highest")
    for obj in scene.objects:
        size = obj.own_size
        if size is None or obj.mass_kg is None or obj.mass_kg <= 0:
            continue
        density = obj.mass_kg / _volume(size)
        if not lowest <= density <= highest:
            found = f"{obj.mass_kg:.3g} kg in a box of {_size_text(size)} is {density:.3g} kg/m³"
            yield obj, found, f"{lowest:g} to {highest:g} kg/m³"


def _low_confidence(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    if not scene.has_probabilities:
        return
    dependants: dict[str, int] = {}
    for obj in scene.objects:
        for iri in {*obj.supporters, *obj.containers}:
            dependants[iri] = dependants.get(iri, 0) + 1
    for obj in scene.objects:
        count = dependants.get(obj.iri, 0)
        if obj.confidence is not None and obj.confidence < rule.number("below") and count >= rule.number("dependants"):
            names = scene.kinds.names(obj)
            found = f"its class, {names}, has confidence {obj.confidence:.2f}; {count} objects are on or in it"
            yield obj, found, f"confidence of {rule.number('below'):g} and more for what much hangs on"


_CHECKS: dict[str, _Check] = {
    "unusual-size": _unusual_size,
    "orientation-not-unit": _orientation,
    "support-smaller": _support_smaller,
    "support-lighter": _support_lighter,
    "support-odd": _support_odd,
    "inside-smaller": _inside_smaller,
    "below-floor": _below_floor,
    "far-away": _far_away,
    "duplicate": _duplicate,
    "density": _density,
    "low-confidence": _low_confidence,
}
