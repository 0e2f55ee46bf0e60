"""Sanity checks of a scene: its units, outliers, unnamed and coincident objects."""

import math
from statistics import median

from usd2kg.scene.coincidence import find_surplus
from usd2kg.scene.instancers import COPY
from usd2kg.scene.model import Diagnostic, Scene, SceneObject
from usd2kg.scene.settings import LIMITS, SANITY
from usd2kg.scene.unnamed_pieces import is_unnamed

__all__ = ["check_sanity", "find_outliers"]


def find_outliers(scene: Scene) -> dict[str, str]:
    """Return path → problem for objects that are far from all others, or surround the scene like a sky dome.

    An object is far if the distance of its centre from the centre of the scene is more than 50 times the median
    distance and more than 100 m. A sky dome is more than twice as large as that limit.
    """
    placed = [obj for obj in scene.objects if obj.box is not None]
    if len(placed) < SANITY.min_objects:
        return {}
    centers = [obj.box.center for obj in placed if obj.box]
    middle = tuple(median(center[axis] for center in centers) for axis in range(3))
    typical = median(math.dist(center, middle) for center in centers)
    limit = max(SANITY.far_factor * typical, SANITY.min_far_distance)
    found = {}
    for obj, center in zip(placed, centers, strict=True):
        distance = math.dist(center, middle)
        if distance > limit:
            found[obj.prim_path] = (
                f"its distance from the centre of the scene is {distance:,.0f} m; the median is {typical:.1f} m"
            )
        elif _extent(obj) > 2 * limit:
            found[obj.prim_path] = f"its extent is {_extent(obj):,.0f} m and it surrounds the scene, like a sky dome"
    return found


def _extent(obj: SceneObject) -> float:
    return max(obj.box.size) if obj.box else 0.0


def check_sanity(scene: Scene) -> list[Diagnostic]:
    """Return diagnostics for outliers, an implausible extent, copies that are not objects, and odd names and places."""
    return [*_check_extent(scene), *_check_copies(scene), *_check_names(scene), *_check_places(scene)]


def _check_copies(scene: Scene) -> list[Diagnostic]:
    """Return a diagnostic if copies of point instancers are not objects: nothing counts them or relates them."""
    drawn = [(obj.prim_path, obj.instances) for obj in scene.objects if obj.instances and obj.instances.count > 1]
    if not drawn or any(obj.selected_by == COPY for obj in scene.objects):
        return []
    path, first = drawn[0]
    found = f"its point instancers draw {first.count} copies of {', '.join(first.prototypes)} that are one object"
    if drawn[1:]:
        total = sum(instances.count for _, instances in drawn)
        found += f", and {len(drawn)} such objects have {total} copies in all"
    return [Diagnostic("instancer", f"{found}; --expand-instancers makes every copy an object", path)]


def _check_places(scene: Scene) -> list[Diagnostic]:
    surplus = find_surplus(scene.objects)
    if not surplus:
        return []
    first = next(obj.prim_path for obj in scene.objects if obj.prim_path in surplus)
    message = (
        f"{len(surplus)} objects have the box of more than {LIMITS.max_coincident} others; they have no spatial "
        "relations; move the copies apart, or deactivate them"
    )
    return [Diagnostic("coincident", message, first)]


def _check_names(scene: Scene) -> list[Diagnostic]:
    # A copy of a point instancer has the name of its prototype.
    unnamed = [obj.name for obj in scene.objects if is_unnamed(obj.name) and not (obj.asset or obj.display_name)]
    if len(unnamed) < max(SANITY.min_unnamed, SANITY.min_unnamed_share * len(scene.objects)):
        return []
    message = (
        f"{len(unnamed)} of {len(scene.objects)} objects have no descriptive name ({', '.join(unnamed[:3])}, …); "
        "if they are pieces of larger objects, select the objects with --include or --objects"
    )
    return [Diagnostic("unnamed", message)]


def _check_extent(scene: Scene) -> list[Diagnostic]:
    outliers = find_outliers(scene)
    notes = [
        Diagnostic("outlier", f"{problem}; it is kept, but not counted in the scene's extent", path)
        for path, problem in outliers.items()
    ]
    extent = scene.extent_without(outliers)
    if extent is None or len(scene.objects) < SANITY.min_objects:
        return notes
    largest = max(extent.size)
    if largest < SANITY.min_extent or largest > SANITY.max_extent:
        unit = f"{scene.frame.metres_per_unit:g} m"
        origin = "as authored" if scene.frame.is_authored else "OpenUSD's fallback, since none is authored"
        message = f"the extent of the scene is {largest:.3g} m with a stage unit of {unit} ({origin}); "
        notes.append(Diagnostic("units", message + "if that is wrong, set --metres-per-unit"))
    return notes
