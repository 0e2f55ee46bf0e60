"""The properties of one object as rows of text, for `usd2kg inspect`."""

import math
from collections.abc import Iterator, Sequence
from decimal import Decimal
from typing import TYPE_CHECKING

from usd2kg.prim_paths import nearest_in

if TYPE_CHECKING:
    from usd2kg.scene import Box, Joint, Label, MaterialDetails, Scene, SceneObject, ShapeDescriptors

__all__ = [
    "box_size_text",
    "capacity_text",
    "joint_rows",
    "jointed_objects",
    "litres_text",
    "mass_text",
    "numbers_text",
    "object_rows",
    "shape_rows",
    "tight_size_text",
]

_MIN_OPENNESS = 0.005
"""Openness below which an object is not shown as a vessel: its capacity consists only of gaps between its parts."""
_UNROTATED = 1 - 1e-9
"""Real part of a unit quaternion from which an orientation counts as the identity."""

Rows = Iterator[tuple[str, str]]


def object_rows(obj: "SceneObject") -> Rows:
    """Yield (property, value) for all authored and computed properties of an object."""
    yield "name", obj.name
    yield from _rows("display name", [obj.display_name])
    yield "words", ", ".join(obj.words) or "none in the name"
    yield from _rows("documentation", [obj.documentation])
    yield "type", f"{obj.type_name or 'none'}{', kind ' + obj.kind if obj.kind else ''}"
    yield from _rows("inside", [obj.parent_path or ""])
    yield from _rows("instance", [f"of the same prototype as {obj.instance_of}" if obj.instance_of else ""])
    if obj.instances:
        yield "copies", f"{obj.instances.count} of {', '.join(obj.instances.prototypes)}"
    yield from _measure_rows(obj)
    yield from _rows("assets", obj.asset)
    yield from _rows("materials", [_material_text(m) for m in obj.material_details] or obj.materials)
    if obj.display_color:
        yield "display colour", _color_text(obj.display_color)
    yield from _rows("parts", [", ".join(obj.parts)])
    yield from _rows("variants", [f"{name} = {choice}" for name, choice in obj.variants])
    yield from _rows("texts", [f"{name}: {text}" for name, text in obj.texts])
    yield from _rows("labels", [_label_text(label, obj) for group in obj.labels for label in group])


def _rows(name: str, values: Sequence[str]) -> Rows:
    """Yield a row for each non-empty value; only the first has the name."""
    for i, value in enumerate(filter(None, values)):
        yield "" if i else name, value


def _measure_rows(obj: "SceneObject") -> Rows:
    yield "box", _box_text(obj.box) if obj.box else "no geometry"
    if obj.own_box and obj.own_box != obj.box:
        yield "own box", f"{_box_text(obj.own_box)}, without the objects inside"
    if obj.oriented_size:
        yield "along own axes", f"{box_size_text(obj.oriented_size)} m"
    if obj.position:
        yield "position", f"{numbers_text(obj.position)} m"
    if obj.orientation and abs(obj.orientation[3]) < _UNROTATED:
        yield "orientation", f"{numbers_text(obj.orientation)} (quaternion x y z w)"
    if obj.mass_kg is not None:
        yield "mass", f"{mass_text(obj.mass_kg)} kg"


def _box_text(box: "Box") -> str:
    return f"{box_size_text(box.size)} m (w×d×h), centre at {numbers_text(box.center)} m"


def box_size_text(sides: Sequence[float]) -> str:
    """Return the sides of a box, rounded to centimetres.

    >>> box_size_text((1.6, 0.8, 0.7))
    '1.60 × 0.80 × 0.70'
    """
    return " × ".join(f"{side:.2f}" for side in sides)


def numbers_text(values: Sequence[float]) -> str:
    """Return numbers rounded to two decimals.

    >>> numbers_text((0.5, -0.001))
    '0.50 0.00'
    """
    # -0.0 + 0.0 is 0.0.
    return " ".join(f"{round(value, 2) + 0.0:.2f}" for value in values)


def _color_text(rgb: Sequence[float]) -> str:
    return f"linear RGB {numbers_text(rgb)}"


def _material_text(material: "MaterialDetails") -> str:
    numbers = {name: getattr(material, name) for name in ("roughness", "metallic", "opacity")}
    known = [f"{name} {value:.2g}" for name, value in numbers.items() if value is not None]
    if material.base_color:
        known.insert(0, _color_text(material.base_color))
    return f"{material.name}: {', '.join(known) or 'no constant input'}"


def _label_text(label: "Label", obj: "SceneObject") -> str:
    place = "" if label.prim_path == obj.prim_path else f", {'from' if label.is_inherited else 'on'} {label.prim_path}"
    strength = ", as a report only" if label.strength == "report" else ""
    return f"{label.value} ({label.encoding}, {label.taxonomy}{strength}{place})"


def jointed_objects(joint: "Joint", scene: "Scene") -> set[str]:
    """Return the paths of the objects that a joint connects."""
    return {owner for body in (joint.body0, joint.body1) if (owner := nearest_in(body, scene.by_path)) is not None}


def joint_rows(joints: "Sequence[Joint]", path: str, scene: "Scene") -> Rows:
    """Yield a row for each joint, from the perspective of the object at `path`."""

    def name(body: str | None) -> str:
        if body is None or nearest_in(body, scene.by_path) != path:
            return body or "the world"
        return "it" if body == path else f"its {body.rpartition('/')[2]}"

    for i, joint in enumerate(joints):
        verb = "hangs on" if joint.type == "fixed" else "moves against"
        motion = ", ".join([f"{name(joint.body1)} {verb} {name(joint.body0)}", *_motion(joint)])
        yield "" if i else "joints", f"{joint.type}: {motion} (joint {joint.prim_path})"


def _motion(joint: "Joint") -> Iterator[str]:
    """Yield axis, limits (degrees or metres), value and state of a joint."""
    factor, unit = (math.degrees(1), "°") if joint.type == "revolute" else (1.0, " m")
    if joint.direction:
        article = "an" if joint.direction[0] in "aeiou" else "a"
        yield f"{'about' if joint.type == 'revolute' else 'along'} {article} {joint.direction} axis"
    if joint.lower is not None or joint.upper is not None:
        ends = ("no limit" if end is None else f"{end * factor:.3g}{unit}" for end in (joint.lower, joint.upper))
        yield "from " + " to ".join(ends)
    elif joint.type in {"revolute", "prismatic"}:
        yield "without limits"
    if joint.value is not None:
        yield f"now at {joint.value * factor:.3g}{unit}"
    if not joint.is_enabled:
        yield "disabled"


def shape_rows(shape: "ShapeDescriptors | None") -> Rows:
    """Yield the measures of an object's own geometry; none for None."""
    if shape is None:
        return
    yield "tight box", f"{tight_size_text(shape)} m, in the best-fitting orientation"
    enclosed = (
        "its surface is not closed" if shape.volume_m3 is None else f"{litres_text(shape.volume_m3)} litres enclosed"
    )
    yield "volume", f"{enclosed}, {litres_text(shape.hull_volume_m3)} litres in its convex hull"
    yield "surface", f"{shape.surface_m2:.3g} m²"
    capacity = capacity_text(shape)
    yield (
        "holds",
        f"{capacity} litres of water as it stands, openness {shape.openness:.2f}"
        if capacity
        else ("no water as it stands"),
    )
    ratios = {name: getattr(shape, name) for name in ("elongation", "flatness", "roundness", "verticality")}
    known = [f"{name} {value:.2f}" for name, value in ratios.items() if value is not None]
    yield from _rows("form", [", ".join(known)])


def capacity_text(shape: "ShapeDescriptors") -> str | None:
    """Return the capacity of an open vessel in its current orientation, in litres; None for other objects."""
    return litres_text(shape.capacity_m3) if shape.openness >= _MIN_OPENNESS else None


def litres_text(cubic_metres: float) -> str:
    """Return a volume in litres, to three significant digits below 100 litres.

    >>> litres_text(8), litres_text(0.0123456)
    ('8000', '12.3')
    """
    litres = cubic_metres * 1000
    return f"{litres:.0f}" if litres >= 100 else f"{litres:.3g}"


def mass_text(kilograms: float) -> str:
    """Return a mass in kilograms, to one decimal from 100 kg on and to four significant digits below.

    >>> mass_text(2847), mass_text(180.5), mass_text(0.12345), mass_text(0.00001)
    ('2847', '180.5', '0.1235', '0.00001')
    """
    if kilograms >= 100:
        return f"{kilograms:.1f}".removesuffix(".0")
    # Unlike a float, a decimal has no scientific notation.
    return f"{Decimal(f'{kilograms:.4g}'):f}"


def tight_size_text(shape: "ShapeDescriptors") -> str:
    """Return the sides of the smallest box around an object, rounded to millimetres."""
    return " × ".join(f"{side:.3f}" for side in (shape.long_m, shape.middle_m, shape.short_m))
