"""Invariants of every Scene, whatever the file contains."""

import itertools
import math
from collections.abc import Iterable, Iterator

from usd2kg.scene import Box, Joint, MaterialDetails, Scene, SceneObject


def insane(scene: Scene) -> Iterator[str]:
    """Yield the violated invariants of a scene."""
    yield from insane_objects(scene)
    if scene.prim_count != len(scene.objects) + sum(scene.left_out.values()):
        yield "prims neither objects nor left out"
    if not (_is_positive(scene.frame.metres_per_unit) and _is_positive(scene.frame.kilograms_per_unit)):
        yield "frame without positive units"
    if scene.time is not None and not math.isfinite(scene.time):
        yield "time not finite"
    seen: set[str] = set()
    for obj in scene.objects:
        if obj.parent_path is not None and obj.parent_path not in seen:
            yield "parent that does not come before"
        if obj.parent_path is not None and not obj.prim_path.startswith(obj.parent_path + "/"):
            yield "parent that is not above"
        seen.add(obj.prim_path)
    for joint in scene.joints:
        yield from _insane_joint(joint)
    for note in scene.diagnostics:
        if not note.message or not is_line(note.message):
            yield f"{note.code} diagnostic of no line or several"
    yield from _unwritable(scene)


def insane_objects(scene: Scene) -> Iterator[str]:
    if len({obj.prim_path for obj in scene.objects}) < len(scene.objects):
        yield "prim path twice"
    for obj in scene.objects:
        yield from _insane_object(obj)


def _insane_object(obj: SceneObject) -> Iterator[str]:
    for name, box in (("box", obj.box), ("own box", obj.own_box), *(("part box", box) for box in obj.part_boxes)):
        if box is not None and not _is_sane_box(box):
            yield f"{name} not finite or inside out"
    if obj.position is not None and not _are_finite(obj.position):
        yield "position not finite"
    if obj.orientation is not None and not abs(math.hypot(*obj.orientation) - 1) < 1e-6:
        yield "orientation no unit quaternion"
    if obj.mass_kg is not None and not _is_positive(obj.mass_kg):
        yield "mass not finite or not positive"
    if obj.center_of_mass is not None and not _are_finite(obj.center_of_mass):
        yield "centre of mass not finite"
    if obj.display_color is not None and not _are_finite(obj.display_color):
        yield "display colour not finite"
    if obj.oriented_size is not None and not all(math.isfinite(size) and size >= 0 for size in obj.oriented_size):
        yield "oriented size not finite or negative"
    if obj.instances is not None and obj.instances.count < 0:
        yield "fewer than no copies"
    for details in obj.material_details:
        yield from _insane_material(details)


def _insane_material(details: MaterialDetails) -> Iterator[str]:
    numbers = (*(details.base_color or ()), details.roughness, details.metallic, details.opacity)
    if not _are_finite(number for number in numbers if number is not None):
        yield "material not finite"


def _insane_joint(joint: Joint) -> Iterator[str]:
    if joint.axis_vector is not None and not abs(math.hypot(*joint.axis_vector) - 1) < 1e-6:
        yield "joint axis no unit vector"
    if joint.origin is not None and not _are_finite(joint.origin):
        yield "joint origin not finite"
    if not _are_finite(number for number in (joint.lower, joint.upper, joint.value) if number is not None):
        yield "joint limit or value not finite"


def _unwritable(scene: Scene) -> Iterator[str]:
    try:
        repr((scene.objects, scene.joints, scene.diagnostics)).encode()
        "".join(text for obj in scene.objects for text in _texts_of(obj)).encode()
    except UnicodeEncodeError:
        yield "text that is not Unicode"


def _texts_of(obj: SceneObject) -> Iterator[str]:
    yield from (
        obj.name,
        obj.display_name,
        obj.documentation,
        obj.geometry_file,
        *obj.asset,
        *obj.materials,
        *obj.parts,
    )
    yield from itertools.chain(*obj.texts, *obj.variants)
    yield from (label.value for labels in obj.labels for label in labels)


def _is_sane_box(box: Box) -> bool:
    return _are_finite((*box.lower, *box.upper)) and all(a <= b for a, b in zip(box.lower, box.upper, strict=True))


def _are_finite(numbers: Iterable[float]) -> bool:
    return all(map(math.isfinite, numbers))


def _is_positive(number: float) -> bool:
    return 0 < number < math.inf


def is_line(text: str) -> bool:
    return len(text.splitlines()) == 1
