"""Property-based tests of furniture with boards and drawers, and of stages in any unit."""

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pxr import Usd

from tests.graph.records import ground_as, related, thing
from tests.relations.room_builder import Placed, home, relate
from tests.relations.test_part_of import joint
from tests.relations.test_properties import GRID, by_statement, everything, moved, rooms, turned
from usd2kg.relations import find_relations
from usd2kg.scene import Box, SceneObject, read_scene

KINDS = ("on", "inside", "above", "below", "touching", "next-to", "near", "part-of")


@st.composite
def furnished(draw: st.DrawFn) -> list[Placed]:
    """Return a room with boards at random heights in some objects."""
    return [(with_board(obj, draw(st.integers(-1, 8))), cls) for obj, cls in draw(rooms())]


def with_board(obj: SceneObject, eighth: int) -> SceneObject:
    box = obj.own_box
    if box is None or eighth < 0:
        return obj
    height = box.lower[2] + eighth * box.size[2] / 8
    lower, upper = (*box.lower[:2], height), (*box.upper[:2], height)
    return replace(obj, support_levels=(Box(lower, upper),))


def with_boards_along(room: list[Placed], change: Any) -> list[Placed]:
    """Return a room with its objects and their boards moved or rotated."""
    bare = change([(replace(obj, support_levels=()), cls) for obj, cls in room])
    levels = {obj.prim_path: obj.support_levels[0] for obj, _ in room if obj.support_levels}
    boards = change([(replace(obj, box=level, own_box=level), "") for obj, level in _known(room, levels)])
    box_of = {obj.prim_path: obj.own_box for obj, _ in boards}
    return [
        (replace(obj, support_levels=(box_of[obj.prim_path],)) if obj.prim_path in box_of else obj, cls)
        for obj, cls in bare
    ]


def _known(room: list[Placed], levels: dict[str, Box]) -> list[tuple[SceneObject, Box]]:
    return [(obj, levels[obj.prim_path]) for obj, _ in room if obj.prim_path in levels]


@settings(deadline=None, max_examples=20)
@given(furnished(), st.tuples(*[st.integers(-512, 512)] * 3))
def test_translating_a_furnished_room_preserves_relations(room: list[Placed], steps: tuple[int, int, int]):
    x, y, z = (GRID * step for step in steps)
    assert everything(with_boards_along(room, lambda placed: moved(placed, (x, y, z)))) == everything(room)


@settings(deadline=None, max_examples=20)
@given(furnished(), st.integers(1, 3))
def test_rotating_a_furnished_room_preserves_relations(room: list[Placed], quarters: int):
    there = relate(*with_boards_along(room, lambda placed: turned(placed, quarters)), kinds=KINDS)
    here = by_statement(relate(*room, kinds=KINDS))
    assert by_statement(there).keys() == here.keys()


@settings(deadline=None, max_examples=20)
@given(furnished())
def test_on_and_inside_are_asymmetric(room: list[Placed]):
    found = {(r.kind, r.target, r.anchor) for r in everything(room)}
    for kind, target, anchor in found:
        if kind in {"on", "inside"}:
            assert not {("on", anchor, target), ("inside", anchor, target)} & found


@settings(deadline=None, max_examples=20)
@given(st.lists(st.tuples(*[st.integers(-8, 64)] * 3, *[st.integers(1, 64)] * 3), min_size=2, max_size=5))
def test_no_whole_is_inside_its_part_and_no_drawer_inside_another(boxes: list[tuple[int, ...]]):
    cabinet: Placed = (thing("/cab", (0, 0, 0), (1, 1, 1)), "KitchenCabinet")
    drawers = [
        (thing(f"/drawer{i}", (GRID * x, GRID * y, GRID * z), (GRID * a, GRID * b, GRID * c)), "Drawer")
        for i, (x, y, z, a, b, c) in enumerate(boxes)
    ]
    runs = [joint("/cab", obj.prim_path, "prismatic") for obj, _ in drawers]
    found = relate(cabinet, *drawers, kinds=("on", "inside", "part-of"), joints=runs)
    assert {(r.target, r.anchor) for r in found if r.kind == "part-of"} == {(o.prim_path, "/cab") for o, _ in drawers}
    assert {r.anchor for r in found if r.kind == "inside"} <= {"/cab"}
    assert not [r for r in found if r.kind == "on"]


CLASSES = {
    "/World/floor": "Floor",
    "/World/table": "Table",
    "/World/bowl": "Bowl",
    "/World/cup": "Cup",
    "/World/egg": "",
}
ROOM = {
    "floor": ((-5, -5, -0.1), (10, 10, 0.1)),
    "table": ((0, 0, 0), (1, 1, 0.7)),
    "bowl": ((0.4, 0.4, 0.7), (0.3, 0.3, 0.12)),
    "cup": ((0.1, 0.1, 0.702), (0.1, 0.1, 0.1)),
    "egg": ((0.45, 0.45, 0.72), (0.05, 0.05, 0.05)),
}


def stage_text(unit: float, up_axis: str) -> str:
    """Return the room as a layer with the given metres per unit."""
    prims = []
    for name, (lower, size) in ROOM.items():
        middle = [(low + side / 2) / unit for low, side in zip(lower, size, strict=True)]
        scale = [side / unit for side in size]
        if up_axis == "Y":
            middle, scale = [middle[0], middle[2], -middle[1]], [scale[0], scale[2], scale[1]]
        prims.append(
            f'def Cube "{name}" (kind = "component") {{\ndouble size = 1\n'
            f"double3 xformOp:translate = ({', '.join(map(repr, middle))})\n"
            f"double3 xformOp:scale = ({', '.join(map(repr, scale))})\n"
            'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]\n}'
        )
    head = f'#usda 1.0\n( metersPerUnit = {unit!r}\n upAxis = "{up_axis}" )\n'
    return head + 'def Xform "World" (kind = "assembly") {\n' + "\n".join(prims) + "\n}\n"


@settings(deadline=None, max_examples=12)
@given(st.sampled_from([1.0, 0.01, 0.001, 0.0254, 0.3048, 1000.0]), st.sampled_from("YZ"))
def test_relations_are_invariant_under_stage_units_and_axis(unit: float, up_axis: str):
    stage: Any = Usd.Stage.CreateInMemory()
    assert stage.GetRootLayer().ImportFromString(stage_text(unit, up_axis))
    scene = read_scene(stage)
    classes = {f"/World/{name}": cls for name, cls in CLASSES.items()}
    found = find_relations(scene, home(), ground_as(home(), scene, classes))
    on_and_in = related([r for r in found if r.kind in {"on", "inside"}])
    assert on_and_in == {
        ("table", "on", "floor"),
        ("bowl", "on", "table"),
        ("cup", "on", "table"),
        ("egg", "inside", "bowl"),
    }
    (gap,) = (r.numbers["gap"] for r in found if (r.target, r.kind) == ("/World/cup", "on"))
    assert gap == pytest.approx(0.002, abs=1e-6)
