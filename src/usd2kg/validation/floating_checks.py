"""Checks for floating objects and for floors that support nothing, from boxes and relations."""

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from usd2kg.shapes import overlapping_pairs
from usd2kg.validation.checked_scene import SHOWN, CheckedScene, Implausible, length_text, name_of
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.plausibility_rules import Rule

__all__ = ["check_floors", "check_in_the_air"]

_LEVEL_STEP = 0.05
"""Bin width for the height of the ground, metres."""
_HANGING = frozenset({"wall", "ceiling", "part"})
"""Stances of objects that hang or are held by another object."""


class _Gaps(NamedTuple):
    """For each object without a supporter, the surface below it."""

    is_held: NDArray[np.bool_]
    """Whether a box below reaches it, or a much larger object or a wall touches it."""
    gap: NDArray[np.float64]
    """Metres to the next surface below; infinite if there is none."""
    surface: NDArray[np.int64]
    """Index of the box with that surface; -1 if there is none."""


def check_in_the_air(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects that nothing supports, contains or holds, with the gap to the next surface below.

    If they exceed a share of the scene, a single violation counts them.
    """
    boxes = scene.boxes
    free = [i for i, obj in enumerate(boxes.objects) if _is_free(scene, obj, rule)]
    gaps = _measure_gaps(scene, rule, np.array(free, np.int64))
    ground = _ground_level(scene, boxes.lower[free, 2][~gaps.is_held & np.isinf(gaps.gap)])
    found = []
    for row, index in enumerate(free):
        surface = int(gaps.surface[row])
        gap = float(gaps.gap[row]) if surface >= 0 else float(boxes.lower[index, 2]) - ground
        # Objects of an unknown kind high above everything else usually hang.
        is_known = bool(scene.classes.stances(boxes.objects[index]))
        most = rule.number("most_gap" if is_known else "most_unknown_gap")
        if gaps.is_held[row] or not rule.number("gap") < gap <= most:
            continue
        below = name_of(boxes.objects[surface]) if surface >= 0 else "the ground, the next surface below"
        found.append((boxes.objects[index], gap, f"{length_text(gap)} above {below}"))
    yield from _summarize(scene, rule, found)


def _summarize(scene: CheckedScene, rule: Rule, found: list[tuple[GraphObject, float, str]]) -> Iterator[Implausible]:
    expected = f"a supporter, or something that holds it, at most {length_text(rule.number('gap'))} away"
    if len(found) < rule.number("fewest") or len(found) < rule.number("share") * len(scene.objects):
        for obj, _, text in found:
            yield Implausible(obj, f"nothing supports or holds it; its bottom is {text}", expected)
        return
    found.sort(key=lambda each: (each[1], each[0].prim_path))
    middle = found[len(found) // 2][1]
    examples = "; ".join(f"{name_of(obj)} {text}" for obj, _, text in found[:SHOWN])
    yield Implausible(
        None,
        f"nothing supports or holds {len(found)} of {len(scene.objects)} objects, whose median gap to the next surface "
        f"below is {length_text(middle)}: {examples}",
        "objects on each other, on a floor or attached to a wall",
    )


def _is_free(scene: CheckedScene, obj: GraphObject, rule: Rule) -> bool:
    """Return whether an object has no supporter, container or holder in the graph and its kind does not hang."""
    if obj.supporters or obj.containers or obj.holders:
        return False
    return _HANGING.isdisjoint(scene.classes.stances(obj)) and not scene.classes.is_a(
        obj, rule, "hanging_words", "hanging"
    )


def _measure_gaps(scene: CheckedScene, rule: Rule, free: NDArray[np.int64]) -> _Gaps:
    boxes, volumes = scene.boxes, scene.boxes.volumes
    contact, reach, ratio = rule.number("contact"), rule.number("gap"), rule.number("volume_ratio")
    lower, upper = boxes.lower, boxes.upper
    is_structure = np.array([scene.classes.is_a(obj, rule, "structure_words", "structures") for obj in boxes.objects])
    thickness = (upper - lower).min(axis=1)
    # The box of walls in one mesh, or of a room, is mostly empty.
    is_hollow = is_structure & (thickness > rule.number("max_thickness"))
    held = np.zeros(len(free), np.bool_)
    gap, surface = np.full(len(free), np.inf), np.full(len(free), -1, np.int64)
    lower_z, bottom_z, hold_volume = lower[:, 2], lower[free, 2], ratio * volumes[free]
    may_hold = is_structure & ~is_hollow
    wider = lower[free, :2] - contact, upper[free, :2] + contact
    for row, other in overlapping_pairs(*wider, (lower[:, :2], upper[:, :2])):
        # In a pile, most pairs are boxes that do not support or hold each other.
        some = may_hold[other] | (lower_z[other] < bottom_z[row]) | (volumes[other] > hold_volume[row])
        row, other = row[some], other[some]  # noqa: PLW2901
        some = (free[row] != other) & ~is_hollow[other]
        row, other = row[some], other[some]  # noqa: PLW2901
        this = free[row]
        bottom, top = lower[this, 2], upper[other, 2]
        is_over = ((lower[this, :2] < upper[other, :2]) & (lower[other, :2] < upper[this, :2])).all(axis=1)
        touches = (lower[other, 2] <= upper[this, 2] + contact) & (top >= bottom - contact)
        is_fixture = is_structure[other] | (volumes[other] > ratio * volumes[this])
        is_borne = is_over & (lower[other, 2] < bottom) & (top >= bottom - reach)
        np.logical_or.at(held, row, is_borne | (touches & is_fixture))
        is_below = is_over & (top < bottom - reach)
        # Among equally high surfaces, the first object wins.
        nearest = np.lexsort((other[is_below], (bottom - top)[is_below]))[::-1]
        rows, distances, others = (values[is_below][nearest] for values in (row, bottom - top, other))
        is_nearer = distances < gap[rows]
        gap[rows[is_nearer]], surface[rows[is_nearer]] = distances[is_nearer], others[is_nearer]
    return _Gaps(held, gap, surface)


def _ground_level(scene: CheckedScene, bottoms: NDArray[np.float64]) -> float:
    """Return the ground height in metres: the lowest floor, otherwise the most common bottom of unsupported objects."""
    tops = [float(scene.boxes.upper[i, 2]) for i in _floors(scene)]
    if tops:
        return min(tops)
    levels = Counter(np.floor(bottoms / _LEVEL_STEP + 0.5).astype(np.int64).tolist())
    return min(levels, key=lambda level: (-levels[level], level)) * _LEVEL_STEP if levels else 0.0


def _floors(scene: CheckedScene) -> list[int]:
    rule = scene.rules["below-floor"]
    return [i for i, obj in enumerate(scene.boxes.objects) if scene.classes.is_a(obj, rule, "floor_words", "floors")]


def check_floors(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield one violation if a scene has floors and nothing is on any of them."""
    boxes, floors = scene.boxes, _floors(scene)
    floor_iris = {boxes.objects[i].iri for i in floors}
    others = [i for i, obj in enumerate(boxes.objects) if obj.iri not in floor_iris and _may_stand(scene, obj)]
    is_used = any(iri in floor_iris for obj in scene.objects for iri in obj.supporters)
    if not floors or is_used or len(others) < rule.number("fewest"):
        return
    top = max(float(boxes.upper[i, 2]) for i in floors)
    bottoms = [(abs(float(boxes.lower[i, 2]) - top), boxes.objects[i], float(boxes.lower[i, 2]) - top) for i in others]
    _, nearest, offset = min(bottoms, key=lambda each: (each[0], each[1].prim_path))
    side = "above" if offset >= 0 else "below"
    shown = name_of(boxes.objects[floors[0]])
    many = shown if len(floors) == 1 else f"{shown} and {len(floors) - 1} more floors"
    found = (
        f"none of {len(others)} objects is on {many}; the bottom of {name_of(nearest)} is the nearest in height, "
        f"{length_text(abs(offset))} {side} the top of a floor at z = {top:.3g} m"
    )
    yield Implausible(None, found, "objects on the floor")


def _may_stand(scene: CheckedScene, obj: GraphObject) -> bool:
    rule = scene.rules["in-the-air"]
    is_structure = scene.classes.is_a(obj, rule, "structure_words", "structures")
    return "floor" in scene.classes.stances(obj) and not is_structure
