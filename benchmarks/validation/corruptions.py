"""Seeded corruptions of stages and graphs, each with the findings that would name it.

Corruptions of a stage are edits of its session layer, so the graph is built with all steps. Corruptions of a graph are
added or replaced triples, as another program or an outdated update would leave them.
"""

from collections.abc import Callable, Sequence
from random import Random
from typing import NamedTuple

import pyoxigraph as ox
from pxr import Gf, Usd, UsdGeom

from usd2kg.graph.vocabulary import OWL, RDF, SOMA, U2K, USD
from usd2kg.scene import ReadOptions
from usd2kg.validation import GraphObject

__all__ = ["GRAPH", "OPTIONS", "STAGE", "GraphCorruption", "OptionCorruption", "StageCorruption", "copy_store"]

_LIFT = 0.4
"""Metres."""


class OptionCorruption(NamedTuple):
    """The stage is read with a wrong option."""

    name: str
    rules: tuple[str, ...]
    change: Callable[[float], ReadOptions]
    """Metres per unit of the stage → options."""


class StageCorruption(NamedTuple):
    """Objects are edited on the stage."""

    name: str
    rules: tuple[str, ...]
    may: Callable[[GraphObject], bool]
    """Which objects of the clean graph it makes sense for."""
    edit: Callable[[Usd.Stage, GraphObject, Sequence[GraphObject]], None]
    """Edits the stage, given the object and others."""


class GraphCorruption(NamedTuple):
    """One statement of the graph is wrong."""

    name: str
    rules: tuple[str, ...]
    edit: Callable[[ox.Store, Sequence[GraphObject], Random], set[str] | None]
    """Edits the store; returns the prim paths that a finding has to name, or None if the edit is impossible."""


def _wrong_unit(factor: float) -> Callable[[float], ReadOptions]:
    return lambda unit: ReadOptions(metres_per_unit=unit * factor)


OPTIONS = (
    *(
        OptionCorruption(f"units wrong by {factor:g}", ("scene-scale",), _wrong_unit(factor))
        for factor in (0.001, 0.01, 0.0254, 0.1, 10.0, 100.0)
    ),
)


def _has_box(obj: GraphObject) -> bool:
    return obj.size is not None and obj.center is not None and min(obj.size) > 0.001 and max(obj.size) > 0.05


def _stands(obj: GraphObject) -> bool:
    return _has_box(obj) and bool(obj.supporters) and not obj.containers and not obj.holders


def _has_concept(obj: GraphObject) -> bool:
    return _has_box(obj) and obj.concept is not None


def _transform(stage: Usd.Stage, prim_path: str, change: Callable[[Gf.Matrix4d], Gf.Matrix4d]) -> None:
    """Replace the world transform of a prim."""
    xform = UsdGeom.Xformable(stage.GetPrimAtPath(prim_path))
    time = Usd.TimeCode.EarliestTime()
    world, parent = xform.ComputeLocalToWorldTransform(time), xform.ComputeParentToWorldTransform(time)
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        xform.MakeMatrixXform().Set(change(world) * parent.GetInverse())


def _moved(stage: Usd.Stage, by: Sequence[float]) -> Callable[[Gf.Matrix4d], Gf.Matrix4d]:
    """Return the translation of world transforms by metres in the z-up frame of the graph."""
    x, y, z = (side / UsdGeom.GetStageMetersPerUnit(stage) for side in by)
    is_y_up = UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y
    offset = Gf.Vec3d(x, z, -y) if is_y_up else Gf.Vec3d(x, y, z)
    return lambda world: world * Gf.Matrix4d().SetTranslate(offset)


def _lift(stage: Usd.Stage, obj: GraphObject, _: Sequence[GraphObject]) -> None:
    _transform(stage, obj.prim_path, _moved(stage, (0, 0, _LIFT)))


def _sink(stage: Usd.Stage, obj: GraphObject, _: Sequence[GraphObject]) -> None:
    assert obj.center is not None and obj.size is not None, "only objects with a box are sunk"
    _transform(stage, obj.prim_path, _moved(stage, (0, 0, -(obj.center[2] + obj.size[2] / 2 + 1.0))))


def _lose(stage: Usd.Stage, obj: GraphObject, _: Sequence[GraphObject]) -> None:
    _transform(stage, obj.prim_path, _moved(stage, (5000, 0, 0)))


def _scaled(factor: float) -> Callable[[Usd.Stage, GraphObject, Sequence[GraphObject]], None]:
    def scale(stage: Usd.Stage, obj: GraphObject, _: Sequence[GraphObject]) -> None:
        _transform(stage, obj.prim_path, lambda world: Gf.Matrix4d().SetScale(factor) * world)

    return scale


def _duplicate(stage: Usd.Stage, obj: GraphObject, _: Sequence[GraphObject]) -> None:
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        copy = stage.DefinePrim(f"{obj.prim_path}_copied")
        copy.GetReferences().AddInternalReference(obj.prim_path)


def _push_into(stage: Usd.Stage, obj: GraphObject, others: Sequence[GraphObject]) -> None:
    """Move an object to where the object most like it in size is, but for a fifth of its extents."""
    assert obj.center is not None and obj.size is not None, "only objects with a box are moved"
    sizes = [
        (max(max(a / b, b / a) for a, b in zip(obj.size, other.size, strict=True)), other)
        for other in others
        if other is not obj and _has_box(other) and other.size is not None and not _is_relative(obj, other)
    ]
    _, target = min(sizes, key=lambda each: (each[0], each[1].prim_path))
    assert target.center is not None, "it has a box"
    shift = [to - at + side * 0.1 for to, at, side in zip(target.center, obj.center, obj.size, strict=True)]
    _transform(stage, obj.prim_path, _moved(stage, shift))


def _is_relative(obj: GraphObject, other: GraphObject) -> bool:
    paths = f"{obj.prim_path}/", f"{other.prim_path}/"
    return paths[0].startswith(paths[1]) or paths[1].startswith(paths[0])


STAGE = (
    StageCorruption("object lifted by 40 cm", ("in-the-air",), _stands, _lift),
    StageCorruption("object below the floor", ("below-floor",), _stands, _sink),
    StageCorruption("object 5 km away", ("far-away",), _has_box, _lose),
    StageCorruption("object 10 times too large", ("unusual-size", "support-smaller"), _has_concept, _scaled(10.0)),
    StageCorruption("object 10 times too small", ("unusual-size",), _has_concept, _scaled(0.1)),
    StageCorruption("object duplicated in place", ("duplicate",), _has_box, _duplicate),
    StageCorruption("object pushed into another", ("interpenetrating", "duplicate"), _stands, _push_into),
)


def copy_store(store: ox.Store) -> ox.Store:
    """Return a copy of a graph that may be edited."""
    copied = ox.Store()
    copied.bulk_extend(store.quads_for_pattern(None, None, None, None))
    return copied


def _add(store: ox.Store, subject: GraphObject, word: str, anchor: GraphObject) -> None:
    is_soma = next(iter(store.quads_for_pattern(None, RDF.type, USD.Prim)), None) is not None
    names = {"on": SOMA.isOntopOf if is_soma else U2K.on, "inside": SOMA.isInsideOf if is_soma else U2K.inside}
    store.add(ox.Quad(ox.NamedNode(subject.iri), names[word], ox.NamedNode(anchor.iri)))


def _circle(length: int) -> Callable[[ox.Store, Sequence[GraphObject], Random], set[str] | None]:
    """Return an edit that puts the lowest of a pile on the highest, or inserts a loop of objects."""

    def edit(store: ox.Store, objects: Sequence[GraphObject], random: Random) -> set[str] | None:
        placed = [obj for obj in objects if _has_box(obj)]
        if len(placed) < length:
            return None
        chosen = random.sample(placed, length)
        for obj, following in zip(chosen, [*chosen[1:], chosen[0]], strict=True):
            _add(store, obj, "on", following)
        return {obj.prim_path for obj in chosen}

    return edit


def _wall_with_all(store: ox.Store, objects: Sequence[GraphObject], random: Random) -> set[str] | None:
    walls = [obj for obj in objects if "wall" in obj.label.lower() and "cab" not in obj.label.lower()]
    if not walls:
        return None
    wall = random.choice(walls)
    for obj in objects:
        if obj is not wall:
            _add(store, obj, "inside", wall)
    return {wall.prim_path}


def _two_containers(store: ox.Store, objects: Sequence[GraphObject], random: Random) -> set[str] | None:
    by_iri = {obj.iri: obj for obj in objects}
    used = {iri for obj in objects for iri in obj.containers if iri in by_iri}
    pairs = [
        (obj, by_iri[iri])
        for obj in objects
        for iri in sorted(used)
        if obj.containers
        and iri not in obj.containers
        and iri != obj.iri
        # A drawer and its cabinet do not exclude each other.
        and not any(_is_relative(by_iri[own], by_iri[iri]) for own in obj.containers if own in by_iri)
        and not any(_share_space(by_iri[own], by_iri[iri]) for own in obj.containers if own in by_iri)
    ]
    if not pairs:
        return None
    obj, other = random.choice(pairs)
    _add(store, obj, "inside", other)
    return {obj.prim_path}


def _share_space(first: GraphObject, second: GraphObject) -> bool:
    if first.center is None or first.size is None or second.center is None or second.size is None:
        return True
    sides = zip(first.center, first.size, second.center, second.size, strict=True)
    return all(abs(a - b) <= (s + t) / 2 for a, s, b, t in sides)


def _stale_relation(store: ox.Store, objects: Sequence[GraphObject], random: Random) -> set[str] | None:
    """Move the box of an object by 40 cm to 2 m, as an update of poses alone does, and keep its relations."""
    held = [obj for obj in objects if (obj.supporters or obj.containers) and obj.center is not None]
    if not held:
        return None
    obj = random.choice(held)
    center = " ".join(f"{value + random.uniform(0.4, 2.0):.7g}" for value in obj.center or ())
    old = next(
        quad
        for quad in store.quads_for_pattern(None, U2K.boxCenter, None)
        if quad.subject.value in {obj.iri, f"{obj.iri}-box"}
    )
    store.remove(old)
    store.add(ox.Quad(old.subject, old.predicate, ox.Literal(center)))
    return {obj.prim_path}


def _swapped_classes(store: ox.Store, objects: Sequence[GraphObject], random: Random) -> set[str] | None:
    """Exchange the classes of two objects of different concepts."""
    known = [obj for obj in objects if obj.concept is not None and len(obj.classes) == 1 and _has_box(obj)]
    pairs = [(a, b) for a in known for b in known if a.classes < b.classes and a.concept != b.concept]
    if not pairs:
        return None
    chosen = random.choice(pairs)
    for obj, other in (chosen, chosen[::-1]):
        node = ox.NamedNode(obj.iri)
        for quad in list(store.quads_for_pattern(node, RDF.type, None)):
            if quad.object.value in obj.classes and quad.object != OWL.NamedIndividual:
                store.remove(quad)
        store.add(ox.Quad(node, RDF.type, ox.NamedNode(other.classes[0])))
    return {obj.prim_path for obj in chosen}


GRAPH = (
    GraphCorruption("two objects on each other", ("support-circle",), _circle(2)),
    GraphCorruption("five objects in a circle", ("support-circle",), _circle(5)),
    GraphCorruption("a wall that contains all", ("container-solid", "container-crowded"), _wall_with_all),
    GraphCorruption("a second container elsewhere", ("containers-exclusive",), _two_containers),
    GraphCorruption("box moved, relations kept", ("relation-apart",), _stale_relation),
    GraphCorruption("classes of two objects swapped", ("unusual-size", "concept-classes"), _swapped_classes),
)
