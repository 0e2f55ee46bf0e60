"""Whether a scene can be as it reads: its units, objects that are not where a room can be, names that say nothing."""

import math
from statistics import median

from usd2kg.scene.model import Diagnostic, Scene, SceneObject
from usd2kg.scene.pieces import is_silent

__all__ = ["check_plausibility", "find_outliers"]

_FEWEST = 5
"""With fewer objects than this nothing is usual."""
_SMALLEST_ROOM, _LARGEST_PLACE = 1.0, 20_000.0
_FAR = 50.0
_FAR_AT_LEAST = 100.0
_MANY_UNNAMED, _MOSTLY = 20, 0.5


def find_outliers(scene: Scene) -> dict[str, str]:
    """Return path → what is wrong, for objects far from all others or around everything.

    An object is far if its middle is more than 50 times the usual distance (the median over objects) from the middle of
    the scene, and more than 100 m. It is a sky dome if it is larger than that and holds the rest.
    """
    placed = [obj for obj in scene.objects if obj.box is not None]
    if len(placed) < _FEWEST:
        return {}
    centers = [obj.box.center for obj in placed if obj.box]
    middle = tuple(median(center[axis] for center in centers) for axis in range(3))
    usual = median(math.dist(center, middle) for center in centers)
    limit = max(_FAR * usual, _FAR_AT_LEAST)
    found = {}
    for obj, center in zip(placed, centers, strict=True):
        distance = math.dist(center, middle)
        if distance > limit:
            found[obj.prim_path] = (
                f"it lies {distance:,.0f} m from the middle of the scene, where {usual:.1f} m is usual"
            )
        elif _size(obj) > 2 * limit:
            found[obj.prim_path] = f"it is {_size(obj):,.0f} m large and surrounds the scene, like a sky dome"
    return found


def _size(obj: SceneObject) -> float:
    return max(obj.box.size) if obj.box else 0.0


def check_plausibility(scene: Scene) -> list[Diagnostic]:
    """Return what is hard to believe about a scene, and what makes it hard to understand."""
    return [*_measures(scene), *_names(scene)]


def _names(scene: Scene) -> list[Diagnostic]:
    # A copy of a point instancer has its prototype's name.
    unnamed = [obj.name for obj in scene.objects if is_silent(obj.name) and not (obj.asset or obj.display_name)]
    if len(unnamed) < _MANY_UNNAMED or len(unnamed) < _MOSTLY * len(scene.objects):
        return []
    message = (
        f"{len(unnamed)} of {len(scene.objects)} objects have names that say nothing ({', '.join(unnamed[:3])}, …); "
        "if they are pieces of larger things, say which prims are objects with --include or --objects"
    )
    return [Diagnostic("unnamed", message)]


def _measures(scene: Scene) -> list[Diagnostic]:
    outliers = find_outliers(scene)
    notes = [
        Diagnostic("outlier", f"{what}; it is kept, but not counted in the scene's extent", path)
        for path, what in outliers.items()
    ]
    extent = scene.extent_without(outliers)
    if extent is None or len(scene.objects) < _FEWEST:
        return notes
    largest = max(extent.size)
    if largest < _SMALLEST_ROOM or largest > _LARGEST_PLACE:
        unit = f"{scene.frame.metres_per_unit:g} m"
        origin = "as authored" if scene.frame.is_authored else "OpenUSD's fallback, since none is authored"
        notes.append(
            Diagnostic(
                "units",
                f"the whole scene is {largest:.3g} m large with a stage unit of {unit} ({origin}); "
                "if that is wrong, say --metres-per-unit",
            )
        )
    return notes
