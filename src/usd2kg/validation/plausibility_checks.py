"""Checks for well-formed but implausible objects: sizes, support, positions, masses. Thresholds: plausibility.toml."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from statistics import median
from typing import NamedTuple

from usd2kg.grounding.lexical.settings import SIZE
from usd2kg.validation.class_extents import typical_class_extent
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.object_classes import ObjectClasses
from usd2kg.validation.plausibility_rules import Rule, Rules

__all__ = ["CheckedScene", "ImplausibleFact", "find_implausible"]


@dataclass(frozen=True)
class CheckedScene:
    """The objects of a graph with their classes."""

    objects: list[GraphObject]
    classes: ObjectClasses
    has_probabilities: bool
    """Whether confidences are calibrated probabilities; otherwise they are only scores."""

    @cached_property
    def by_iri(self) -> dict[str, GraphObject]:
        """IRI → object."""
        return {obj.iri: obj for obj in self.objects}


class ImplausibleFact(NamedTuple):
    """A violation of a rule by an object."""

    rule: Rule
    obj: GraphObject
    found: str
    expected: str


_Check = Callable[[CheckedScene, Rule], Iterator[tuple[GraphObject, str, str]]]
"""Yields objects with the texts for what was found and expected."""


def find_implausible(scene: CheckedScene, rules: Rules) -> Iterator[ImplausibleFact]:
    """Yield the violations of all enabled rules."""
    for name, check in _CHECKS.items():
        rule = rules[name]
        if rule.is_enabled:
            yield from (ImplausibleFact(rule, *found) for found in check(scene, rule))


def _named(obj: GraphObject) -> str:
    return f"“{obj.label}” ({obj.prim_path})"


def _size_text(size: tuple[float, float, float]) -> str:
    return f"{' × '.join(f'{side:.3g}' for side in size)} m"


def _volume(size: tuple[float, float, float]) -> float:
    return math.prod(max(side, SIZE.min_extent) for side in size)


def _unusual_size(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    factor = max(rule.number("factor"), 1.0)
    any_words, any_classes = rule.words("any_size_words"), rule.classes("any_size")
    for obj in scene.objects:
        if obj.own_size is None:
            continue
        longest = max(*obj.own_size, SIZE.min_extent)
        for cls in obj.classes:
            label = scene.classes.label(cls)
            if cls in any_classes or label.rpartition(" ")[2] in any_words:
                continue
            typical = typical_class_extent(cls, label)
            if typical is not None and not typical / factor <= longest <= typical * factor:
                found = f"its longest extent is {longest:.3g} m ({_size_text(obj.own_size)}), and it is a {label}"
                expected = f"about {typical:.3g} m, {typical / factor:.2g} to {typical * factor:.2g} m"
                yield obj, found, expected


def _orientation(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    for obj in scene.objects:
        length = math.hypot(*obj.orientation) if obj.orientation is not None and len(obj.orientation) == 4 else 1.0
        if abs(length - 1) > rule.number("tolerance"):
            yield obj, f"the quaternion of its orientation has length {length:.4g}", "length 1"


def _supports(scene: CheckedScene) -> Iterator[tuple[GraphObject, GraphObject]]:
    """Yield pairs of an object and a supporter."""
    for obj in scene.objects:
        yield from ((obj, scene.by_iri[iri]) for iri in obj.supporters if iri in scene.by_iri)


def _support_smaller(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    max_volumes, max_lengths = rule.number("volume_ratio"), rule.number("length_ratio")
    for obj, support in _supports(scene):
        if obj.size is None or support.size is None or _has_legs(scene, obj):
            continue
        volumes = _volume(obj.size) / _volume(support.size)
        lengths = max(obj.size) / max(*support.size, SIZE.min_extent)
        is_implausible = volumes > max_volumes and lengths > max_lengths
        if is_implausible and not scene.classes.is_a(support, rule, "any_load", "any_load_words"):
            found = (
                f"it is on {_named(support)}; its box of {_size_text(obj.size)} has {volumes:.0f} times the volume and "
                f"{lengths:.1f} times the length of that box of {_size_text(support.size)}"
            )
            yield obj, found, f"at most {max_volumes:g} times the volume or {max_lengths:g} times the length"


def _has_legs(scene: CheckedScene, obj: GraphObject) -> bool:
    """Return whether an object is on several supporters that are all smaller, as a table top on slim legs."""
    supports = [scene.by_iri[iri] for iri in obj.supporters if iri in scene.by_iri]
    return len(supports) > 1 and all(
        support.size is not None and obj.size is not None and _volume(support.size) < _volume(obj.size)
        for support in supports
    )


def _support_lighter(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    ratio = rule.number("mass_ratio")
    for obj, support in _supports(scene):
        if obj.mass_kg and support.mass_kg and support.mass_kg > 0 and obj.mass_kg > ratio * support.mass_kg:
            found = f"it has {obj.mass_kg:.3g} kg and is on {_named(support)} with {support.mass_kg:.3g} kg"
            yield obj, found, f"at most {ratio:g} times the mass of its supporter"


def _support_odd(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    for obj, support in _supports(scene):
        if scene.classes.is_a(obj, rule, "loads", "load_words") and scene.classes.is_a(
            support, rule, "carriers", "carrier_words"
        ):
            found = f"it is a {scene.classes.names(obj)} on {_named(support)}, a {scene.classes.names(support)}"
            yield obj, found, "a floor, furniture or a counter as supporter"


def _inside_smaller(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    """Yield objects too large for their container; the longest extent alone is no reason: spoons stick out of pots."""
    slack, ratio = rule.number("slack"), rule.number("volume_ratio")
    for obj in scene.objects:
        for container in (scene.by_iri[iri] for iri in obj.containers if iri in scene.by_iri):
            if obj.size is None or container.size is None:
                continue
            middle = sorted(obj.own_size or obj.size)[1]
            is_wide = middle > slack * math.hypot(*container.size)
            if is_wide or _volume(obj.size) > ratio * _volume(container.size):
                found = f"its box of {_size_text(obj.size)} is inside {_named(container)}"
                yield obj, found, f"a box that fits into {_size_text(container.size)}"


def _below_floor(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    placed = [(obj, obj.center[2], obj.size[2]) for obj in scene.objects if obj.center and obj.size]
    tops = [z + height / 2 for obj, z, height in placed if scene.classes.is_a(obj, rule, "floors", "floor_words")]
    if not tops:
        return
    floor = min(tops)
    for obj, z, height in placed:
        top = z + height / 2
        if top < floor - rule.number("depth") and not scene.classes.is_a(obj, rule, "not_below", "not_below_words"):
            yield obj, f"the top of its box is at z = {top:.3g} m", f"above the lowest floor, at z = {floor:.3g} m"


def _far_away(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    placed = [(obj, obj.center) for obj in scene.objects if obj.center is not None]
    if len(placed) < max(rule.number("fewest"), 1):
        return
    middle = tuple(median(center[axis] for _, center in placed) for axis in range(3))
    distances = [(math.dist(center, middle), obj) for obj, center in placed]
    share = min(rule.number("share"), 1.0)
    usual = sorted(distance for distance, _ in distances)[max(int(len(distances) * share) - 1, 0)]
    limit = max(rule.number("factor") * usual, rule.number("least"))
    for distance, obj in distances:
        if distance > limit:
            found = (
                f"it is {distance:.3g} m from the middle of the scene; {share:.0%} of objects are within {usual:.3g} m"
            )
            yield obj, found, f"at most {limit:.3g} m"


def _duplicate(scene: CheckedScene, rule: Rule) -> Iterator[tuple[GraphObject, str, str]]:
    step = max(rule.number("tolerance"), 1e-9)
    same: dict[tuple[int, ...], list[GraphObject]] = {}
    for obj in scene.objects:
        if obj.center is not None and obj.size is not None and max(obj.size) >= rule.number("least_extent"):
            key = tuple(round(value / step) for value in (*obj.center, *obj.size))
            same.setdefault(key, []).append(obj)
    for first, *others in same.values():
        for other in others:
            if not _is_nested(first, other):
                found = f"it has the position and size of {_named(first)}: {_size_text(other.size or (0, 0, 0))}"
                yield other, found, "one object per place"


def _is_nested(first: GraphObject, second: GraphObject) -> bool:
    """Return whether one prim is below the other: a group of one object has the box of that object."""
    paths = f"{first.prim_path}/", f"{second.prim_path}/"
    return paths[0].startswith(paths[1]) or paths[1].startswith(paths[0])


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
            names = scene.classes.names(obj)
            found = f"its class, {names}, has confidence {obj.confidence:.2f}; {count} objects are on or in it"
            yield obj, found, f"confidence of at least {rule.number('below'):g} for an object with many dependants"


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
