"""Checks of single objects: orientation, support, containers, position, mass, confidence."""

import math
from collections.abc import Iterator
from statistics import median

from usd2kg.grounding.lexical.settings import SIZE
from usd2kg.validation.checked_scene import CheckedScene, Implausible, length_text, name_of, size_text, volume_of
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.plausibility_rules import Rule

__all__ = [
    "check_below_floor",
    "check_density",
    "check_far_away",
    "check_inside_smaller",
    "check_low_confidence",
    "check_orientation",
    "check_support_lighter",
    "check_support_odd",
    "check_support_smaller",
]


def check_orientation(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects whose orientation is not a unit quaternion."""
    for obj in scene.objects:
        length = math.hypot(*obj.orientation) if obj.orientation is not None and len(obj.orientation) == 4 else 1.0
        if abs(length - 1) > rule.number("tolerance"):
            yield Implausible(obj, f"the quaternion of its orientation has length {length:.4g}", "length 1")


def check_support_smaller(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects on a much smaller supporter, unless it is one of several legs."""
    max_volumes, max_lengths = rule.number("volume_ratio"), rule.number("length_ratio")
    for obj, support in scene.supports():
        if obj.size is None or support.size is None or _has_legs(scene, obj):
            continue
        volumes = volume_of(obj.size) / volume_of(support.size)
        lengths = max(obj.size) / max(*support.size, SIZE.min_extent)
        is_implausible = volumes > max_volumes and lengths > max_lengths
        if is_implausible and not scene.classes.is_a(support, rule, "any_load_words", "any_load"):
            found = (
                f"it is on {name_of(support)}; its box of {size_text(obj.size)} has {volumes:.0f} times the volume and "
                f"{lengths:.1f} times the length of that box of {size_text(support.size)}"
            )
            yield Implausible(
                obj, found, f"at most {max_volumes:g} times the volume or {max_lengths:g} times the length"
            )


def _has_legs(scene: CheckedScene, obj: GraphObject) -> bool:
    """Return whether an object rests on several smaller supporters, like a table top on slim legs."""
    supports = [scene.by_iri[iri] for iri in obj.supporters if iri in scene.by_iri]
    return len(supports) > 1 and all(
        support.size is not None and obj.size is not None and volume_of(support.size) < volume_of(obj.size)
        for support in supports
    )


def check_support_lighter(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects on a much lighter supporter."""
    ratio = rule.number("mass_ratio")
    for obj, support in scene.supports():
        if obj.mass_kg and support.mass_kg and support.mass_kg > 0 and obj.mass_kg > ratio * support.mass_kg:
            found = f"it has {obj.mass_kg:.3g} kg and is on {name_of(support)} with {support.mass_kg:.3g} kg"
            yield Implausible(obj, found, f"at most {ratio:g} times the mass of its supporter")


def check_support_odd(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects on a supporter whose kind does not support such objects."""
    for obj, support in scene.supports():
        if scene.classes.is_a(obj, rule, "load_words", "loads") and scene.classes.is_a(
            support, rule, "carrier_words", "carriers"
        ):
            found = f"it is a {scene.classes.names(obj)} on {name_of(support)}, a {scene.classes.names(support)}"
            yield Implausible(obj, found, "a floor, furniture or a counter as supporter")


def check_inside_smaller(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield objects too large for their container; a longer extent alone is acceptable: spoons stick out of pots.

    Plants may be wider than their pots, too.
    """
    slack, ratio = rule.number("slack"), rule.number("volume_ratio")
    for obj, container in scene.contents():
        if obj.size is None or container.size is None:
            continue
        middle = sorted(obj.own_size or obj.size)[1]
        is_wide = middle > slack * math.hypot(*container.size)
        is_large = is_wide or volume_of(obj.size) > ratio * volume_of(container.size)
        if is_large and not scene.classes.is_a(obj, rule, "growing_words"):
            found = f"its box of {size_text(obj.size)} is inside {name_of(container)}"
            yield Implausible(obj, found, f"a box that fits into {size_text(container.size)}")


def check_below_floor(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects whose whole box is below the lowest floor."""
    placed = [(obj, obj.center[2], obj.size[2]) for obj in scene.objects if obj.center and obj.size]
    tops = [z + height / 2 for obj, z, height in placed if scene.classes.is_a(obj, rule, "floor_words", "floors")]
    if not tops:
        return
    floor = min(tops)
    for obj, z, height in placed:
        top = z + height / 2
        if top < floor - rule.number("depth") and not scene.classes.is_a(obj, rule, "not_below_words", "not_below"):
            yield Implausible(
                obj, f"the top of its box is at z = {top:.3g} m", f"above the lowest floor, at z = {floor:.3g} m"
            )


def check_far_away(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects far from all others."""
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
                f"it is {length_text(distance)} from the middle of the scene; "
                f"{share:.0%} of objects are within {length_text(usual)}"
            )
            yield Implausible(obj, found, f"at most {length_text(limit)}")


def check_density(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects whose mass does not fit the volume of their box."""
    lowest, highest = rule.number("lowest"), rule.number("highest")
    for obj in scene.objects:
        size = obj.own_size
        if size is None or obj.mass_kg is None or obj.mass_kg <= 0:
            continue
        density = obj.mass_kg / volume_of(size)
        if not lowest <= density <= highest:
            found = f"{obj.mass_kg:.3g} kg in a box of {size_text(size)} is {density:.3g} kg/m³"
            yield Implausible(obj, found, f"{lowest:g} to {highest:g} kg/m³")


def check_low_confidence(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield one violation that counts the objects of an uncertain class with many objects on or in them."""
    dependants: dict[str, int] = {}
    for obj in scene.objects:
        for iri in {*obj.supporters, *obj.containers}:
            dependants[iri] = dependants.get(iri, 0) + 1
    below, least = rule.number("below"), rule.number("dependants")
    uncertain = [
        (dependants.get(obj.iri, 0), obj.confidence, obj)
        for obj in scene.objects
        if obj.confidence is not None and obj.confidence < below and dependants.get(obj.iri, 0) >= least
    ]
    if not uncertain:
        return
    uncertain.sort(key=lambda each: (-each[0], each[1], each[2].prim_path))
    examples = "; ".join(
        f"{name_of(obj)} with {count}, class {scene.classes.names(obj)}, confidence {confidence:.2f}"
        for count, confidence, obj in uncertain[: int(rule.number("most"))]
    )
    noun = "1 object has" if len(uncertain) == 1 else f"{len(uncertain)} objects have"
    found = f"{noun} a class of low confidence, and at least {least:g} objects on or in it: {examples}"
    yield Implausible(None, found, f"confidence of at least {below:g} for objects with many dependants")
