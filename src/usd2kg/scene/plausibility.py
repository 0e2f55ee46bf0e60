"""Whether a scene's measures can be true: its units, and objects that are not where a room can be."""

import math
from statistics import median

from usd2kg.scene.model import Diagnostic, Scene, SceneObject

__all__ = ["check_plausibility", "find_outliers"]

_FEWEST = 5
"""With fewer objects than this nothing is usual."""
_SMALLEST_ROOM, _LARGEST_PLACE = 1.0, 20_000.0
_FAR = 50.0
_FAR_AT_LEAST = 100.0


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
    """Return what is hard to believe about a scene's measures."""
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
