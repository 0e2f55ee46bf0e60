"""Property-based tests of relations in random rooms."""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.graph.records import Corner, thing
from tests.relations.room_builder import RULES, Placed, relate
from usd2kg.relations import ALL_KINDS, SYMMETRIC_KINDS, VIEWPOINT_KINDS, Relation, Viewpoint
from usd2kg.scene import Box, SceneObject

GRID = 1 / 64
"""Sums of multiples of a power of two are exact, so that translations change no measurement."""
VIEW = Viewpoint((-3.0, -5.0, 1.5), (1.0, 2.0, 0.0))
CLASSES = ["Table", "Bowl", "Cup", "Box", "DesignedArtifact", "Cupboard", "Wall", "Drawer", "DesignedChair", "Door"]


@st.composite
def rooms(draw: st.DrawFn) -> list[Placed]:
    """Return a table on a floor and random objects close together."""
    corners = st.tuples(*[st.integers(0, 64)] * 3)
    sizes = st.tuples(*[st.integers(1, 64)] * 3)
    room: list[Placed] = [
        (thing("/floor", (-8, -8, -1), (16, 16, 1)), "Floor"),
        (thing("/table", (0, 0, 0), (1, 1, 0.75)), "Table"),
        (thing("/hall", (-2, -2, 0), (3, 3, 3)), "Room"),
    ]
    for i in range(draw(st.integers(1, 7))):
        lower, size = ([GRID * step for step in draw(steps)] for steps in (corners, sizes))
        # Every second object starts near the height of the table.
        lower[2] = 0.75 + GRID * draw(st.integers(-2, 2)) if i % 2 else lower[2]
        room.append(
            (
                thing(f"/thing{i}", (lower[0], lower[1], lower[2]), (size[0], size[1], size[2])),
                draw(st.sampled_from(CLASSES)),
            )
        )
    return room


def everything(room: list[Placed], view: Viewpoint = VIEW) -> tuple[Relation, ...]:
    return relate(*room, kinds=ALL_KINDS, viewpoint=view)


def by_statement(relations: tuple[Relation, ...]) -> dict[tuple[str, ...], Relation]:
    """Return relations by statement; ends of symmetric ones are sorted."""
    found = {}
    for r in relations:
        ends = sorted((r.target, r.anchor)) if r.kind in SYMMETRIC_KINDS else [r.target, r.anchor, r.other_anchor or ""]
        found[(r.kind, *ends)] = r
    return found


def with_box(obj: SceneObject, change: Callable[[Box], Box]) -> SceneObject:
    assert obj.own_box is not None
    box = change(obj.own_box)
    return replace(obj, box=box, own_box=box)


def moved(room: list[Placed], by: Corner) -> list[Placed]:
    def shift(box: Box) -> Box:
        lower, upper = (tuple(a + b for a, b in zip(corner, by, strict=True)) for corner in (box.lower, box.upper))
        return Box(lower, upper)

    return [(with_box(obj, shift), cls) for obj, cls in room]


def turned(room: list[Placed], quarters: int) -> list[Placed]:
    """Return a room rotated about z by right angles."""

    def turn(box: Box) -> Box:
        (x0, y0, z0), (x1, y1, z1) = box.lower, box.upper
        for _ in range(quarters):
            x0, y0, x1, y1 = -y1, x0, -y0, x1
        return Box((x0, y0, z0), (x1, y1, z1))

    return [(with_box(obj, turn), cls) for obj, cls in room]


@settings(deadline=None, max_examples=20)
@given(rooms(), st.tuples(*[st.integers(-4096, 4096)] * 3))
def test_translating_a_room_preserves_relations(room: list[Placed], steps: tuple[int, int, int]):
    x, y, z = (GRID * step for step in steps)
    assert everything(moved(room, (x, y, z))) == everything(room)


@settings(deadline=None, max_examples=20)
@given(rooms(), st.integers(1, 3))
def test_rotating_room_and_viewer_by_right_angles_preserves_relations(room: list[Placed], quarters: int):
    (x, y, _), dx, dy = VIEW.position, 1.0, 2.0
    for _ in range(quarters):
        x, y, dx, dy = -y, x, -dy, dx
    view = Viewpoint((x, y, 1.5), (dx, dy, 0.0))
    before, after = by_statement(everything(room)), by_statement(everything(turned(room, quarters), view))
    assert before.keys() == after.keys()
    for key, relation in before.items():
        assert after[key].numbers == pytest.approx(relation.numbers)
        assert after[key].confidence == pytest.approx(relation.confidence) if relation.confidence is not None else True


@settings(deadline=None, max_examples=20)
@given(rooms(), st.randoms(use_true_random=False))
def test_the_order_of_objects_does_not_matter(room: list[Placed], random):
    shuffled = random.sample(room, len(room))
    before, after = by_statement(everything(room)), by_statement(everything(shuffled))
    assert before.keys() == after.keys()
    for key, relation in before.items():
        assert after[key].numbers == pytest.approx(relation.numbers)


@settings(deadline=None, max_examples=20)
@given(rooms())
def test_relations_are_sorted_by_target_without_duplicates(room: list[Placed]):
    relations = everything(room)
    place = {obj.prim_path: index for index, (obj, _) in enumerate(room)}
    targets = [place[r.target] for r in relations]
    assert targets == sorted(targets)
    assert len(by_statement(relations)) == len(relations)
    for r in relations:
        if r.kind in SYMMETRIC_KINDS:
            assert place[r.target] < place[r.anchor]


@settings(deadline=None, max_examples=20)
@given(rooms())
def test_directed_relations_are_asymmetric(room: list[Placed]):
    relations = everything(room)
    found = {(r.kind, r.target, r.anchor) for r in relations}
    for kind, target, anchor in found:
        assert target != anchor
        if kind in {"on", "inside", "above", "below", "room", "part-of", *VIEWPOINT_KINDS}:
            assert (kind, anchor, target) not in found
    opposite = {
        "above": "below",
        "below": "above",
        "left": "right",
        "right": "left",
        "front": "behind",
        "behind": "front",
    }
    for kind, target, anchor in found:
        if kind in opposite:
            assert (opposite[kind], anchor, target) in found


@settings(deadline=None, max_examples=20)
@given(rooms())
def test_each_object_has_one_supporter_and_container_without_cycles(room: list[Placed]):
    up: dict[str, dict[str, list[str]]] = {"on": {}, "inside": {}, "room": {}}
    for r in everything(room):
        if r.kind in up and r.rule != RULES.on_several.rule:
            up[r.kind].setdefault(r.target, []).append(r.anchor)
    assert all(len(anchors) == 1 for kind in up.values() for anchors in kind.values())
    for kind in ("on", "inside"):
        for start in up[kind]:
            here, steps = start, 0
            while here in up[kind]:
                here, steps = up[kind][here][0], steps + 1
                assert steps <= len(room)


@settings(deadline=None, max_examples=20)
@given(rooms())
def test_measurements_match_the_boxes(room: list[Placed]):
    boxes = {obj.prim_path: obj.own_box for obj, _ in room}
    for r in everything(room):
        assert r.confidence is None or 0 <= r.confidence <= 1
        assert all(math.isfinite(value) for value in r.numbers.values())
        target, anchor = boxes[r.target], boxes[r.anchor]
        assert target is not None
        assert anchor is not None
        apart = [max(target.lower[i], anchor.lower[i]) - min(target.upper[i], anchor.upper[i]) for i in range(3)]
        if r.kind == "on":
            assert r.numbers["gap"] == pytest.approx(target.lower[2] - anchor.upper[2])
            assert 0 < r.numbers["overlapRatio"] <= 1
        if r.kind == "above":
            assert r.numbers["gap"] == pytest.approx(target.lower[2] - anchor.upper[2])
            assert RULES.above.min_overlap_ratio < r.numbers["overlapRatio"] <= 1
        if r.kind in {"near", "next-to"}:
            assert r.numbers["distance"] == pytest.approx(math.hypot(*(max(gap, 0) for gap in apart)), abs=1e-9)
        if r.kind == "touching":
            assert -RULES.touching.max_sink <= r.numbers["gap"] <= RULES.touching.max_gap
        if r.kind == "inside":
            assert 0 < r.numbers["insideRatio"] <= 1
        if r.kind == "room":
            assert 0 <= r.numbers["margin"] <= 1.5


@settings(deadline=None, max_examples=20)
@given(rooms())
def test_stronger_relations_suppress_weaker_ones(room: list[Placed]):
    relations = everything(room)
    strong = {frozenset((r.target, r.anchor)) for r in relations if r.kind in {"on", "inside", "part-of"}}
    weak = {frozenset((r.target, r.anchor)) for r in relations if r.kind in {"above", "touching", "next-to", "near"}}
    assert not strong & weak
    near = {frozenset((r.target, r.anchor)) for r in relations if r.kind == "near"}
    assert not near & {frozenset((r.target, r.anchor)) for r in relations if r.kind in {"touching", "next-to"}}


@settings(deadline=None, max_examples=8)
@given(rooms())
def test_kinds_are_independent(room: list[Placed]):
    whole = everything(room)
    for kind in ALL_KINDS:
        if kind not in {"near", *VIEWPOINT_KINDS}:
            assert relate(*room, kinds=(kind,)) == tuple(r for r in whole if r.kind == kind)


@settings(deadline=None, max_examples=20)
@given(st.tuples(*[st.floats(-1000, 1000)] * 3))
def test_translation_by_any_length_preserves_relations(by: Corner):
    room: list[Placed] = [
        (thing("/floor", (-5, -5, -0.1), (10, 10, 0.1)), "Floor"),
        (thing("/table", (0, 0, 0), (1, 1, 0.7)), "Table"),
        (thing("/bowl", (0.4, 0.4, 0.7), (0.3, 0.3, 0.12)), "Bowl"),
        (thing("/cup", (0.1, 0.1, 0.702), (0.1, 0.1, 0.1)), "Cup"),
        (thing("/egg", (0.45, 0.45, 0.72), (0.05,) * 3), "DesignedArtifact"),
        (thing("/lamp", (0.3, 0.3, 1.5), (0.4, 0.4, 0.3)), "Appliance"),
        (thing("/chair", (1.1, 0.2, 0), (0.5, 0.5, 0.9)), "DesignedChair"),
    ]
    assert by_statement(everything(moved(room, by))).keys() == by_statement(everything(room)).keys()
    # At 1,000 m, float64 has 13 decimals.
    gap = next(r.numbers["gap"] for r in everything(moved(room, by)) if (r.target, r.kind) == ("/cup", "on"))
    assert gap == pytest.approx(0.002, abs=1e-9)


def spun(objects: list[tuple[Corner, float, Corner]], angle: float) -> list[Placed]:
    """Return upright blocks (centre, yaw in radians, size) with the whole scene rotated about z."""
    placed = []
    for i, ((x, y, z), turn, (width, depth, height)) in enumerate(objects):
        cos, sin = math.cos(angle), math.sin(angle)
        middle = (cos * x - sin * y, sin * x + cos * y, z)
        whole = turn + angle
        half_x = (abs(math.cos(whole)) * width + abs(math.sin(whole)) * depth) / 2
        half_y = (abs(math.sin(whole)) * width + abs(math.cos(whole)) * depth) / 2
        lower = (middle[0] - half_x, middle[1] - half_y, z)
        pose = {
            "oriented_size": (width, depth, height),
            "orientation": (0.0, 0.0, math.sin(whole / 2), math.cos(whole / 2)),
        }
        placed.append((thing(f"/block{i}", lower, (2 * half_x, 2 * half_y, height), **pose), "DesignedArtifact"))
    return placed


@settings(deadline=None, max_examples=20)
@given(
    st.lists(
        st.tuples(st.integers(0, 12), st.integers(0, 12), st.integers(0, 11), st.integers(1, 6), st.integers(1, 6)),
        min_size=2,
        max_size=6,
        unique_by=lambda item: item[:2],
    ),
    st.floats(0, 2 * math.pi),
)
def test_distances_are_invariant_under_rotation(blocks, angle):
    objects = [
        ((0.21 * x, 0.23 * y, 0.0), 0.26 * turn, (0.07 * width, 0.11 * depth, 0.5))
        for x, y, turn, width, depth in blocks
    ]

    def nearest(room):
        return {(r.target, r.anchor): r.numbers["distance"] for r in relate(*room, kinds=("near",))}

    here, there = nearest(spun(objects, 0)), nearest(spun(objects, angle))
    # Blocking depends on the axis-aligned boxes; distances do not.
    assert here.keys() & there.keys() or not here
    for pair in here.keys() & there.keys():
        assert there[pair] == pytest.approx(here[pair], abs=1e-9)


def test_a_scene_without_boxes_has_no_relations():
    assert relate(kinds=ALL_KINDS, viewpoint=VIEW) == ()
    assert np.array(relate(kinds=None)).size == 0
