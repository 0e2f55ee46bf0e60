"""The salon: meshes by formula and models of a library, placed by script."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom

import usd2kg
from benchmarks.relations.judged import KINDS, SCENES, read_judged
from benchmarks.scenes.salon import build as salon
from benchmarks.scenes.salon.contact import lift_onto, solid
from benchmarks.scenes.salon.shapes import (
    Shape,
    bent,
    box,
    cuboid,
    hollow_box,
    lathe,
    merge,
    move,
    ribbon,
    turn,
    vessel,
)
from benchmarks.scenes.salon.stage import Asset, Salon, write
from benchmarks.scenes.sweet_home import ModelError
from tests.judged_scenes import judged_stage

SHAPES = {
    "box": box(0, 1, 0, 2, 0, 3),
    "hollow box": hollow_box(0.4, 0.3, 0.2, 0.01),
    "vessel": vessel(0.1, 0.15, 0.2),
    "cone": lathe([(0.1, 0), (0, 0.2)]),
    "pipe": bent([(0, 0, 0), (0, 0, 1), (0, 1, 1)], 0.1),
    "cloth": ribbon([(0, 0), (0, 1), (1, 1)], 2, 0.1),
}


def edges(shape: Shape) -> dict[frozenset[int], int]:
    """Return how many faces each edge has."""
    counts: dict[frozenset[int], int] = {}
    for face in shape.faces:
        for start, end in zip(face, [*face[1:], face[0]], strict=True):
            counts[frozenset((start, end))] = counts.get(frozenset((start, end)), 0) + 1
    return counts


@pytest.mark.parametrize("name", SHAPES)
def test_shapes_are_closed(name: str):
    assert set(edges(SHAPES[name]).values()) == {2}


def test_a_hollow_box_is_open_at_the_top():
    points = hollow_box(0.4, 0.3, 0.2, 0.01).points
    assert np.ptp(points, axis=0) == pytest.approx([0.4, 0.3, 0.2])
    # Below the rim, only the floor of the inside is less high.
    assert sorted(set(points[:, 2].round(3))) == [0, 0.01, 0.2]
    thing = cuboid(0.1, 0.1, 0.05)
    outer = hollow_box(0.4, 0.3, 0.2, 0.01)
    assert lift_onto(solid(*thing), [solid(*outer)]) == pytest.approx(0.01)


def test_a_turn_is_counter_clockwise():
    assert turn(Shape(np.eye(3), []), "z", 90).points == pytest.approx(np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]))


def test_a_thing_falls_onto_the_highest_of_its_supporters():
    supporters = [solid(*cuboid(1, 1, 0.5)), solid(*move(cuboid(0.2, 0.2, 0.1), 0.3, 0, 0.5))]
    thing = solid(*cuboid(0.3, 0.3, 0.2))
    assert lift_onto(thing, supporters[:1]) == pytest.approx(0.5)
    assert lift_onto(thing._replace(points=thing.points + np.array([0.3, 0, 0])), supporters) == pytest.approx(0.6)
    # Two bars that cross have no corner over the other.
    bars = [solid(*box(-1, 1, -0.1, 0.1, 0, 0.1)), solid(*box(-0.1, 0.1, -1, 1, 0, 0.1))]
    assert lift_onto(bars[0], bars[1:]) == pytest.approx(0.1)
    with pytest.raises(ValueError, match="nothing is below it"):
        lift_onto(thing._replace(points=thing.points + np.array([5, 0, 0])), supporters)


def test_a_board_in_a_shelf_is_chosen_by_height():
    shelf = solid(*merge(cuboid(1, 1, 0.1), cuboid(1, 1, 0.1, 1.0)))
    thing = solid(*cuboid(0.1, 0.1, 0.1))
    assert lift_onto(thing, [shelf]) == pytest.approx(1.1)
    assert lift_onto(thing, [shelf], below=0.5) == pytest.approx(0.1)


def test_assets_keep_their_size_in_any_units(tmp_path):
    room = Salon(tmp_path)
    shape = cuboid(0.2, 0.3, 0.4)
    room.put("Direct", Asset("direct", shape), (1, 2, 3), yaw=90)
    for number in (1, 2):
        room.put(f"Group/Copy_{number}", Asset("copy", shape, 1.0, "Z"), (number, 2, 3), yaw=90)
    room.put("File", Asset("part", shape, 0.0254, "Z", "part.usda"), (1, 2, 3), tilt=("x", 90))
    write(room, tmp_path / "room.usda")
    stage = Usd.Stage.Open(str(tmp_path / "room.usda"))
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert stage.GetPrimAtPath("/Salon/Group/Copy_1").IsInstance()
    boxes = {obj.prim_path: obj.box for obj in usd2kg.read_scene(tmp_path / "room.usda").objects}
    assert sorted(boxes) == ["/Salon/Direct", "/Salon/File", "/Salon/Group/Copy_1", "/Salon/Group/Copy_2"]
    assert boxes["/Salon/Direct"].lower == pytest.approx((0.85, 1.9, 3))
    assert boxes["/Salon/Group/Copy_2"].upper == pytest.approx((2.15, 2.1, 3.4))
    assert boxes["/Salon/File"].lower == pytest.approx((0.9, 1.6, 2.85))


def test_a_place_is_taken_once(tmp_path):
    room = Salon(tmp_path)
    asset = Asset("box", cuboid(1, 1, 1))
    room.put("Box", asset, (0, 0, 0))
    with pytest.raises(ValueError, match="Box is placed twice"):
        room.put("Box", asset, (1, 0, 0))
    with pytest.raises(ValueError, match="Crate: another asset is named 'box'"):
        room.put("Crate", Asset("box", cuboid(2, 1, 1)), (1, 0, 0))
    with pytest.raises(ValueError, match="Lid: nothing is below it"):
        room.rest("Lid", asset, (5, 5), "Box")


def test_the_command_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setattr("sys.argv", ["build.py", "-o", str(tmp_path / "a.usdc"), "--models", str(tmp_path)])
    with pytest.raises(SystemExit, match=r"\.sh3f: no such library; install the Debian package sweeth"):
        salon.main()
    with pytest.raises(ModelError):
        salon.furnish(tmp_path)
    assert not (tmp_path / "a.usdc").exists()


def test_the_built_salon_has_the_judged_objects():
    objects = {obj.prim_path for obj in usd2kg.read_scene(judged_stage("salon")).objects}
    facts = [fact for path in SCENES["salon"].judged for fact in read_judged(path)]
    assert {fact.subject for fact in facts} == objects
    assert {path for fact in facts for path in fact.objects} - {"*", ""} <= objects
    assert {kind for fact in facts for kind in fact.kinds} <= {*KINDS, "nothing"}
