"""Check that objects of one concept have one class."""

from collections.abc import Iterator
from itertools import combinations

from usd2kg.validation.checked_scene import CheckedScene, Implausible, names_of
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.object_classes import ObjectClasses
from usd2kg.validation.plausibility_rules import Rule

__all__ = ["check_concept_classes"]


def check_concept_classes(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield one violation for each concept whose objects have unrelated classes."""
    by_concept: dict[str, list[GraphObject]] = {}
    for obj in scene.objects:
        if obj.concept is not None and obj.classes:
            by_concept.setdefault(obj.concept, []).append(obj)
    for concept, objects in sorted(by_concept.items()):
        groups: dict[tuple[str, ...], list[GraphObject]] = {}
        for obj in objects:
            groups.setdefault(obj.classes, []).append(obj)
        if any(not _are_related(scene.classes, a, b) for a, b in combinations(groups, 2)):
            yield _split(scene, concept, list(groups.values()), rule)


def _split(scene: CheckedScene, concept: str, groups: list[list[GraphObject]], rule: Rule) -> Implausible:
    groups.sort(key=lambda group: (-len(group), group[0].classes))
    parts = [f"{len(group)} of class {scene.classes.names(group[0])} ({names_of(group)})" for group in groups]
    most = int(rule.number("most"))
    shown = "; ".join(parts[:most]) + (f"; and {len(parts) - most} more classes" if len(parts) > most else "")
    total = sum(map(len, groups))
    noun = scene.classes.concepts.label(concept)
    return Implausible(
        None,
        f"{total} objects have the concept “{noun}” and {len(groups)} classes: {shown}",
        "one class for one concept, or classes of which one includes the other",
    )


def _are_related(classes: ObjectClasses, first: tuple[str, ...], second: tuple[str, ...]) -> bool:
    """Return whether a class of one object is a subclass of a class of the other."""
    above = [{up for cls in group for up in classes.closure(cls)} for group in (first, second)]
    return not above[0].isdisjoint(second) or not above[1].isdisjoint(first)
