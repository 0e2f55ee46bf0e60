"""Run the plausibility checks that a graph has the facts for. Thresholds: plausibility.toml."""

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from usd2kg.validation.checked_scene import Check, CheckedScene, Implausible
from usd2kg.validation.concept_checks import check_concept_classes
from usd2kg.validation.floating_checks import check_floors, check_in_the_air
from usd2kg.validation.object_checks import (
    check_below_floor,
    check_density,
    check_far_away,
    check_inside_smaller,
    check_low_confidence,
    check_orientation,
    check_support_lighter,
    check_support_odd,
    check_support_smaller,
)
from usd2kg.validation.overlap_checks import check_duplicates, check_interpenetration
from usd2kg.validation.plausibility_rules import Rule
from usd2kg.validation.relation_checks import (
    check_apart,
    check_circles,
    check_container_kinds,
    check_crowded_containers,
    check_exclusive_containers,
)
from usd2kg.validation.size_checks import check_room_size, check_scale, check_unusual_size, scale_of

__all__ = ["RuleViolation", "SkippedCheck", "find_implausible", "find_skipped"]


class RuleViolation(NamedTuple):
    """A violation with its rule."""

    rule: Rule
    violation: Implausible


class SkippedCheck(NamedTuple):
    """Rules that could not be checked."""

    rules: tuple[str, ...]
    reason: str
    """The missing facts, and how to add them."""


def find_implausible(scene: CheckedScene) -> Iterator[RuleViolation]:
    """Yield the violations of all enabled rules that the graph has the facts for.

    If the scale of the scene is wrong, that is one violation, and the other rules are checked after its correction.
    """
    scale_rule = scene.rules["scene-scale"]
    if scale_rule.is_enabled:
        yield from (RuleViolation(scale_rule, violation) for violation in check_scale(scene, scale_rule))
    scale = scale_of(scene) if scale_rule.is_enabled else None
    corrected = scene if scale is None else scene.divided_by(scale)
    has_facts = {name: need.is_met(scene) for name, need in _NEEDS.items()}
    for name, (check, needs) in _CHECKS.items():
        rule = scene.rules[name]
        if rule is scale_rule or not rule.is_enabled or not all(has_facts[need] for need in needs):
            continue
        for violation in check(corrected, rule):
            found = (
                violation.found if scale is None else f"after division of all lengths by {scale:.3g}: {violation.found}"
            )
            yield RuleViolation(rule, violation._replace(found=found))


def find_skipped(scene: CheckedScene) -> tuple[SkippedCheck, ...]:
    """Return the enabled rules that the graph lacks the facts for, by the first missing fact."""
    missing = [name for name, need in _NEEDS.items() if not need.is_met(scene)]
    enabled = [(name, needs) for name, (_, needs) in _CHECKS.items() if scene.rules[name].is_enabled]
    first = {name: next((need for need in missing if need in needs), None) for name, needs in enabled}
    skipped = []
    for need in missing:
        rules = tuple(name for name, lacking in first.items() if lacking == need)
        if rules:
            skipped.append(SkippedCheck(rules, _NEEDS[need].reason))
    return tuple(skipped)


class _Need(NamedTuple):
    """Facts that some checks need."""

    is_met: Callable[[CheckedScene], bool]
    reason: str


_RELATE = "if the graph was built without relations, use usd2kg build --relation-kinds default"
_NEEDS: Mapping[str, _Need] = {
    "boxes": _Need(
        lambda scene: bool(scene.boxes.objects), "no object has a box; check usd2kg inspect for missing geometry"
    ),
    "relations": _Need(
        lambda scene: any(obj.supporters or obj.containers for obj in scene.objects),
        f"no object is on or inside another; {_RELATE}",
    ),
    "support": _Need(lambda scene: any(obj.supporters for obj in scene.objects), f"no object is on another; {_RELATE}"),
    "contents": _Need(
        lambda scene: any(obj.containers for obj in scene.objects), f"no object is inside another; {_RELATE}"
    ),
    "orientations": _Need(
        lambda scene: any(obj.orientation is not None for obj in scene.objects), "no object has an orientation"
    ),
    "masses": _Need(
        lambda scene: any(obj.mass_kg is not None for obj in scene.objects), "no object has a mass (physics:mass)"
    ),
    "concepts": _Need(
        lambda scene: any(obj.concept is not None for obj in scene.objects),
        "no object has a concept; build it with a current version of usd2kg, from a stage with readable names",
    ),
    "probabilities": _Need(
        lambda scene: scene.has_probabilities, "the confidences of this grounder are not calibrated"
    ),
}
"""Facts by name, the most basic first."""
_CHECKS: Mapping[str, tuple[Check, frozenset[str]]] = {
    name: (check, frozenset(needs))
    for name, check, *needs in (
        ("scene-scale", check_scale, "boxes"),
        ("room-size", check_room_size, "boxes"),
        ("unusual-size", check_unusual_size, "boxes"),
        ("orientation-not-unit", check_orientation, "orientations"),
        ("in-the-air", check_in_the_air, "boxes"),
        ("floor-empty", check_floors, "boxes", "relations"),
        ("support-circle", check_circles, "relations"),
        ("support-smaller", check_support_smaller, "boxes", "support"),
        ("support-lighter", check_support_lighter, "masses", "support"),
        ("support-odd", check_support_odd, "support"),
        ("relation-apart", check_apart, "boxes", "relations"),
        ("inside-smaller", check_inside_smaller, "boxes", "contents"),
        ("container-solid", check_container_kinds, "contents"),
        ("container-crowded", check_crowded_containers, "contents"),
        ("containers-exclusive", check_exclusive_containers, "contents"),
        ("interpenetrating", check_interpenetration, "boxes"),
        ("duplicate", check_duplicates, "boxes"),
        ("below-floor", check_below_floor, "boxes"),
        ("far-away", check_far_away, "boxes"),
        ("density", check_density, "boxes", "masses"),
        ("concept-classes", check_concept_classes, "concepts"),
        ("low-confidence", check_low_confidence, "probabilities"),
    )
}
