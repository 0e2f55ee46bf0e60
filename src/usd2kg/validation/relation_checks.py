"""Checks of relations: cycles, contradictory containers, and relations between objects that are far apart."""

import math
from collections.abc import Iterable, Iterator
from collections.abc import Set as AbstractSet

from usd2kg.ontology.components import find_components
from usd2kg.validation.checked_scene import (
    CheckedScene,
    Implausible,
    is_nested,
    length_text,
    name_of,
    names_of,
)
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.plausibility_rules import Rule

__all__ = [
    "check_apart",
    "check_circles",
    "check_container_kinds",
    "check_crowded_containers",
    "check_exclusive_containers",
]

_MAX_STEPS = 6
"""Maximum number of steps of a cycle in a finding."""


def check_circles(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield one violation for each group of objects that are on or inside each other in a cycle."""
    edges = {
        obj.iri: {iri for iri in (*obj.supporters, *obj.containers) if iri in scene.by_iri} for obj in scene.objects
    }
    for group in find_components(edges).members:
        members = sorted((scene.by_iri[iri] for iri in group), key=lambda obj: (obj.prim_path, obj.iri))
        first = members[0]
        if len(members) > 1 or first.iri in edges[first.iri]:
            circle = _shortest_circle(first.iri, edges, set(group))
            found = _circle_text([scene.by_iri[iri] for iri in circle])
            if len(members) > len(circle):
                found += f"; {len(members)} objects are in this and overlapping cycles"
            yield Implausible(first, found, "an order from the lowest supporter up")


def _shortest_circle(start: str, edges: dict[str, set[str]], group: AbstractSet[str]) -> list[str]:
    """Return the shortest path from an object of a strongly connected group back to itself, without its end."""
    came_from: dict[str, str] = {}
    pending = [start]
    for each in pending:
        for following in sorted(edges[each] & group):
            if following == start:
                path = [each]
                while path[-1] != start:
                    path.append(came_from[path[-1]])
                return path[::-1]
            if following not in came_from:
                came_from[following] = each
                pending.append(following)
    raise ValueError(f"{start} is in no circle of its group")


def _circle_text(circle: list[GraphObject]) -> str:
    steps = []
    for obj, following in zip(circle, [*circle[1:], circle[0]], strict=True):
        word = "on" if following.iri in obj.supporters else "inside"
        target = "itself" if following is obj else name_of(following)
        steps.append(f"{word} {target}")
    if len(steps) > _MAX_STEPS:
        steps[_MAX_STEPS - 1 : -1] = [f"… ({len(circle) - _MAX_STEPS} more)"]
    return "it is " + ", which is ".join(steps)


def check_exclusive_containers(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects inside two containers that are apart, or of which neither is in or part of the other."""
    for obj in scene.objects:
        containers = [scene.by_iri[iri] for iri in obj.containers if iri in scene.by_iri]
        pairs = ((a, b) for i, a in enumerate(containers) for b in containers[i + 1 :])
        for first, second in pairs:
            gap = _gap(first, second)
            if gap is None:
                is_exclusive = not _is_within(scene, first, second) and not _is_within(scene, second, first)
                measured = "neither of which is in the other"
            else:
                is_exclusive, measured = gap > rule.number("gap"), f"whose boxes are {length_text(gap)} apart"
            if is_exclusive:
                found = f"it is inside {name_of(first)} and inside {name_of(second)}, {measured}"
                yield Implausible(obj, found, "one container, or containers inside each other")
                break


def _is_within(scene: CheckedScene, obj: GraphObject, other: GraphObject) -> bool:
    """Return whether an object is in, on or part of another, over any number of steps, or its prim is below it."""
    seen, pending = {obj.iri}, [obj]
    for each in pending:
        if each.iri == other.iri:
            return True
        above = {*each.containers, *each.supporters, *each.holders} & scene.by_iri.keys() - seen
        seen |= above
        pending.extend(scene.by_iri[iri] for iri in above)
    return is_nested(obj, other)


def _gap(first: GraphObject, second: GraphObject) -> float | None:
    """Return the distance between two boxes in metres, 0 if they overlap; None if one is missing."""
    if first.center is None or first.size is None or second.center is None or second.size is None:
        return None
    sides = zip(first.center, first.size, second.center, second.size, strict=True)
    return math.hypot(*(max(abs(a - b) - (s + t) / 2, 0.0) for a, s, b, t in sides))


def check_apart(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects that are on or inside something that their boxes do not reach."""
    least = rule.number("gap")
    pairs = [*((pair, "on") for pair in scene.supports()), *((pair, "inside") for pair in scene.contents())]
    for (obj, anchor), word in pairs:
        gap = _gap(obj, anchor)
        if gap is not None and gap > least:
            found = f"it is {word} {name_of(anchor)}, but their boxes are {length_text(gap)} apart"
            yield Implausible(obj, found, f"boxes at most {length_text(least)} apart")


def check_container_kinds(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects that contain others although nothing can be inside such objects."""
    for container, contents in _by_container(scene.contents()):
        if scene.classes.is_a(container, rule, "solid_words", "solids"):
            kind = scene.classes.kind(container)
            found = f"it is a {kind}, and {_count(contents)} inside it: {names_of(contents)}"
            yield Implausible(container, found, f"nothing inside a {kind}")


def check_crowded_containers(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the container that directly contains most objects of the scene, unless it is a space."""
    least = max(rule.number("share") * len(scene.objects), rule.number("fewest"))
    for container, contents in _by_container(scene.contents()):
        if len(contents) >= least and not scene.classes.is_a(container, rule, "space_words", "spaces"):
            share = len(contents) / len(scene.objects)
            found = (
                f"{_count(contents)} directly inside it, {share:.0%} of the scene: {names_of(contents)}; "
                f"it is a {scene.classes.kind(container)}"
            )
            yield Implausible(container, found, f"less than {rule.number('share'):.0%} in one container, except a room")


def _by_container(pairs: Iterable[tuple[GraphObject, GraphObject]]) -> list[tuple[GraphObject, list[GraphObject]]]:
    found: dict[str, tuple[GraphObject, list[GraphObject]]] = {}
    for obj, container in pairs:
        found.setdefault(container.iri, (container, []))[1].append(obj)
    return list(found.values())


def _count(objects: list[GraphObject]) -> str:
    return "1 object is" if len(objects) == 1 else f"{len(objects)} objects are"
