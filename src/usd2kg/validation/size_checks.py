"""Checks of sizes: objects against the usual size of their kind, and the scale of the whole scene."""

from collections.abc import Iterator
from statistics import median
from typing import NamedTuple

import numpy as np

from usd2kg.grounding.lexical.settings import SIZE
from usd2kg.validation.checked_scene import SHOWN, CheckedScene, Implausible, length_text, size_text
from usd2kg.validation.graph_objects import GraphObject
from usd2kg.validation.object_concepts import everyday_extent
from usd2kg.validation.plausibility_rules import Rule

__all__ = ["check_room_size", "check_scale", "check_unusual_size", "scale_of"]

_UNITS = (1.0, 0.01, 0.001, 0.0254, 0.3048, 0.1, 10.0, 100.0, 1000.0)
"""Candidate values of metersPerUnit to propose, common ones first."""


class _UsualSize(NamedTuple):
    noun: str
    extent: float
    """Typical longest extent, metres."""


class _Measured(NamedTuple):
    """An object with the usual size of its kind."""

    obj: GraphObject
    longest: float
    usual: _UsualSize

    @property
    def ratio(self) -> float:
        return self.longest / self.usual.extent


def _longest(obj: GraphObject) -> float | None:
    return max(*obj.own_size, SIZE.min_extent) if obj.own_size is not None else None


def _usual_of_concept(scene: CheckedScene, obj: GraphObject) -> _UsualSize | None:
    if obj.concept is None:
        return None
    return _usual(scene, scene.classes.concepts.label(obj.concept))


def _usual_of_classes(scene: CheckedScene, obj: GraphObject) -> list[_UsualSize]:
    any_size = scene.rules["unusual-size"].classes("any_size")
    labels = [scene.classes.label(cls) for cls in obj.classes if cls not in any_size]
    return [usual for label in labels if (usual := _usual(scene, label)) is not None]


def _usual(scene: CheckedScene, noun: str) -> _UsualSize | None:
    is_any = noun.rpartition(" ")[2] in scene.rules["unusual-size"].words("any_size_words")
    extent = None if is_any else everyday_extent(noun)
    return _UsualSize(noun, extent) if extent is not None else None


def _measured(scene: CheckedScene) -> list[_Measured]:
    """Return the objects of a known usual size: by their concept, else by their only class."""
    found = []
    for obj in scene.objects:
        longest = _longest(obj)
        usual = _usual_of_concept(scene, obj)
        if usual is None and obj.concept is None:
            usual = next(iter(_usual_of_classes(scene, obj)), None)
        if longest is not None and usual is not None:
            found.append(_Measured(obj, longest, usual))
    return found


def scale_of(scene: CheckedScene) -> float | None:
    """Return the median ratio of measured to usual sizes; None if it is plausible, or too few sizes are known."""
    rule = scene.rules["scene-scale"]
    measured = _measured(scene)
    if len(measured) < rule.number("fewest"):
        return None
    scale = median(each.ratio for each in measured)
    factor = rule.number("factor")
    return None if 1 / factor <= scale <= factor else scale


def check_scale(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield one violation if most objects are too large or too small by the same factor, or the scene is."""
    scale = scale_of(scene)
    if scale is None:
        yield from _check_extent(scene, rule)
        return
    measured = _measured(scene)
    typical = sorted(measured, key=lambda each: (abs(np.log(each.ratio / scale)), each.obj.prim_path))
    kinds = {each.usual.noun: each for each in reversed(typical)}
    examples = ", ".join(
        f"{noun} {length_text(each.longest)} (usual: {length_text(each.usual.extent)})"
        for noun, each in list(reversed(kinds.items()))[:SHOWN]
    )
    found = f"objects are {scale:.3g} times as long as usual, by the median of {len(measured)}: {examples}"
    yield Implausible(None, found, _expected_unit(scene, scale))


def _expected_unit(scene: CheckedScene, scale: float) -> str:
    if scene.metres_per_unit is None:
        return "objects of about their usual size"
    unit = min(_UNITS, key=lambda each: abs(np.log(each / (scene.metres_per_unit or 1) * scale)))
    after = scale * unit / scene.metres_per_unit
    return (
        f"objects of about their usual size; with metersPerUnit = {unit:g} instead of {scene.metres_per_unit:g} "
        f"they would be {after:.2g} times as long as usual"
    )


def _check_extent(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield a violation if the scene is tiny or huge, ignoring outliers."""
    boxes = scene.boxes
    if len(boxes.objects) < rule.number("fewest"):
        return
    lower, upper = np.quantile(boxes.lower, 0.1, axis=0), np.quantile(boxes.upper, 0.9, axis=0)
    extent = float((upper - lower).max())
    least, most = rule.number("least_extent"), rule.number("most_extent")
    if not least <= extent <= most:
        found = f"{len(boxes.objects)} objects are within {length_text(extent)}, without the outermost tenth"
        yield Implausible(None, found, f"{length_text(least)} to {length_text(most)}")


def check_room_size(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the rooms and buildings that are too small to stand in, or too large."""
    least, most = rule.number("least_extent"), rule.number("most_extent")
    for obj in scene.objects:
        longest = _longest(obj)
        if longest is None or least <= longest <= most:
            continue
        kind = scene.classes.match(obj, rule, "room_words", "rooms")
        if kind is None:
            continue
        found = f"it has {size_text(obj.own_size or (0, 0, 0))}, and its class, {scene.classes.names(obj)}, is a {kind}"
        yield Implausible(obj, found, f"longest extent from {length_text(least)} to {length_text(most)}")


def check_unusual_size(scene: CheckedScene, rule: Rule) -> Iterator[Implausible]:
    """Yield the objects whose longest extent is far from the usual one of their kind."""
    for obj in scene.objects:
        longest = _longest(obj)
        if longest is not None:
            yield from _check_size(scene, rule, obj, longest)


def _check_size(scene: CheckedScene, rule: Rule, obj: GraphObject, longest: float) -> Iterator[Implausible]:
    own = _usual_of_concept(scene, obj)
    factor = rule.number("factor")
    if own is not None and not _fits(longest, own, factor):
        yield _unusual(obj, longest, own, factor)
        return
    # A class that generalises the concept has no typical size: a water dispenser is larger than a soap dispenser.
    above = scene.classes.concepts.above(obj.concept) if obj.concept is not None else ()
    slack = factor if obj.concept is None or own is not None else rule.number("general_factor")
    for usual in _usual_of_classes(scene, obj):
        if usual.noun in above or _fits(longest, usual, slack):
            continue
        violation = _unusual(obj, longest, usual, slack)
        if own is not None:
            found = f"{violation.found}; its name means {own.noun}, usually {length_text(own.extent)}"
            violation = violation._replace(found=found)
        yield violation


def _fits(longest: float, usual: _UsualSize, factor: float) -> bool:
    return usual.extent / factor <= longest <= usual.extent * factor


def _unusual(obj: GraphObject, longest: float, usual: _UsualSize, factor: float) -> Implausible:
    found = f"its longest extent is {longest:.3g} m ({size_text(obj.own_size or (0, 0, 0))}), and it is a {usual.noun}"
    low, high = usual.extent / factor, usual.extent * factor
    return Implausible(obj, found, f"about {usual.extent:.3g} m, {low:.2g} to {high:.2g} m")
