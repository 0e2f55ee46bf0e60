"""All that is known of one object, as rows of words: what `usd2kg inspect --why` prints."""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from usd2kg.scene import Box, Joint, Label, MaterialDetails, Scene, SceneObject, ShapeDescriptors

__all__ = [
    "HOLLOW",
    "joint_rows",
    "litres_text",
    "numbers_text",
    "objects_of",
    "rows_of",
    "shape_rows",
    "size_text",
    "tight_text",
]

HOLLOW = 0.005
"""What is less open than this holds drops between its parts."""

Rows = Iterator[tuple[str, str]]


def rows_of(obj: "SceneObject") -> Rows:
    """Yield (what, value) of all that the stage says of an object; what it does not say is left out."""
    yield "name", obj.name
    yield from _block("display name", [obj.display_name])
    yield "words", ", ".join(obj.words) or "none that tell what it is"
    yield from _block("documentation", [obj.documentation])
    yield "type", f"{obj.type_name or 'none'}{', kind ' + obj.kind if obj.kind else ''}"
    yield from _block("inside", [obj.parent_path or ""])
    yield from _block("instance", [f"of the same prototype as {obj.instance_of}" if obj.instance_of else ""])
    if obj.instances:
        yield "copies", f"{obj.instances.count} of {', '.join(obj.instances.prototypes)}"
    yield from _measure_rows(obj)
    yield from _block("assets", obj.asset)
    yield from _block("materials", [_material(m) for m in obj.material_details] or obj.materials)
    if obj.display_color:
        yield "display colour", _color(obj.display_color)
    yield from _block("parts", [", ".join(obj.parts)])
    yield from _block("variants", [f"{name} = {choice}" for name, choice in obj.variants])
    yield from _block("texts", [f"{name}: {text}" for name, text in obj.texts])
    yield from _block("labels", [_label(label, obj) for group in obj.labels for label in group])


def _block(what: str, values: Sequence[str]) -> Rows:
    """Yield a row for each value that is not empty, named once."""
    for i, value in enumerate(filter(None, values)):
        yield "" if i else what, value


def _measure_rows(obj: "SceneObject") -> Rows:
    yield "box", _box(obj.box) if obj.box else "no geometry"
    if obj.own_box and obj.own_box != obj.box:
        yield "own box", f"{_box(obj.own_box)}, without the objects inside"
    if obj.oriented_size:
        yield "along own axes", f"{size_text(obj.oriented_size)} m"
    if obj.position:
        yield "position", f"{numbers_text(obj.position)} m"
    if obj.orientation and abs(obj.orientation[3]) < 1 - 1e-9:
        yield "orientation", f"{numbers_text(obj.orientation)} (quaternion x y z w)"
    if obj.mass_kg is not None:
        yield "mass", f"{obj.mass_kg:.3g} kg"


def _box(box: "Box") -> str:
    return f"{size_text(box.size)} m (w×d×h), centre at {numbers_text(box.center)} m"


def size_text(sides: Sequence[float]) -> str:
    """Return lengths to the centimetre, as the sides of a box."""
    return " × ".join(f"{side:.2f}" for side in sides)


def numbers_text(values: Sequence[float]) -> str:
    """Return numbers to two places."""
    # Adding 0 makes a 0 of what is -0.
    return " ".join(f"{round(value, 2) + 0.0:.2f}" for value in values)


def _color(rgb: Sequence[float]) -> str:
    return f"linear RGB {numbers_text(rgb)}"


def _material(material: "MaterialDetails") -> str:
    numbers = {name: getattr(material, name) for name in ("roughness", "metallic", "opacity")}
    known = [f"{name} {value:.2g}" for name, value in numbers.items() if value is not None]
    if material.base_color:
        known.insert(0, _color(material.base_color))
    return f"{material.name}: {', '.join(known) or 'nothing constant'}"


def _label(label: "Label", obj: "SceneObject") -> str:
    place = "" if label.prim_path == obj.prim_path else f", {'from' if label.is_inherited else 'on'} {label.prim_path}"
    strength = ", as a report only" if label.strength == "report" else ""
    return f"{label.value} ({label.encoding}, {label.taxonomy}{strength}{place})"


def objects_of(joint: "Joint", scene: "Scene") -> set[str]:
    """Return the paths of the objects that the bodies of a joint are, or are parts of."""
    return {owner for body in (joint.body0, joint.body1) if (owner := _owner(body, scene)) is not None}


def _owner(path: str | None, scene: "Scene") -> str | None:
    while path and path not in scene.by_path:
        path = path.rpartition("/")[0]
    return path or None


def joint_rows(joints: "Sequence[Joint]", path: str, scene: "Scene") -> Rows:
    """Yield how each joint moves the object at `path`, or another against it."""

    def name(body: str | None) -> str:
        if body is None or _owner(body, scene) != path:
            return body or "the world"
        return "it" if body == path else f"its {body.rpartition('/')[2]}"

    for i, joint in enumerate(joints):
        moved, base = name(joint.body1), name(joint.body0)
        verb = "hangs on" if joint.type == "fixed" else "moves against"
        told = ", ".join([f"{moved} {verb} {base}", *_motion(joint)])
        yield "" if i else "joints", f"{joint.type}: {told} (joint {joint.prim_path})"


def _motion(joint: "Joint") -> Iterator[str]:
    """Yield which way and how far a joint moves, angles in degrees."""
    factor, unit = (math.degrees(1), "°") if joint.type == "revolute" else (1.0, " m")
    if joint.direction:
        yield f"{'about' if joint.type == 'revolute' else 'along'} {_article(joint.direction)} axis"
    if joint.lower is not None or joint.upper is not None:
        ends = ("no limit" if end is None else f"{end * factor:.3g}{unit}" for end in (joint.lower, joint.upper))
        yield "from " + " to ".join(ends)
    elif joint.type in {"revolute", "prismatic"}:
        yield "without limits"
    if joint.value is not None:
        yield f"now at {joint.value * factor:.3g}{unit}"
    if not joint.is_enabled:
        yield "switched off"


def _article(word: str) -> str:
    return f"an {word}" if word[0] in "aeiou" else f"a {word}"


def shape_rows(form: "ShapeDescriptors | None") -> Rows:
    """Yield the measures of an object's own geometry; nothing where it has none."""
    if form is None:
        return
    yield "tight box", f"{tight_text(form)} m, turned as it fits best"
    enclosed = (
        "its surface is not closed" if form.volume_m3 is None else f"{litres_text(form.volume_m3)} litres enclosed"
    )
    yield "volume", f"{enclosed}, {litres_text(form.hull_volume_m3)} litres in its convex hull"
    yield "surface", f"{form.surface_m2:.3g} m²"
    holds = f"{litres_text(form.capacity_m3)} litres of water as it stands, openness {form.openness:.2f}"
    yield "holds", holds if form.openness >= HOLLOW else "no water as it stands"
    ratios = {name: getattr(form, name) for name in ("elongation", "flatness", "roundness", "verticality")}
    known = [f"{name} {value:.2f}" for name, value in ratios.items() if value is not None]
    yield from _block("form", [", ".join(known)])


def litres_text(cubic_metres: float) -> str:
    """Return a volume in litres, to three figures."""
    litres = cubic_metres * 1000
    return f"{litres:.0f}" if litres >= 100 else f"{litres:.3g}"


def tight_text(form: "ShapeDescriptors") -> str:
    """Return the sides of the smallest box around an object, to the millimetre."""
    return " × ".join(f"{side:.3f}" for side in (form.long_m, form.middle_m, form.short_m))
