"""above and below, without pairs implied by an intermediate object."""

import pytest

from tests.graph.records import related, thing
from tests.relations.room_builder import FLOOR, HAIR, RULES, TABLE, Placed, artifact, cup, relate

ABOVE = RULES.above
BOTH = ("above", "below")
LAMP: Placed = (thing("/lamp", (0.4, 0.4, 1.5), (0.2, 0.2, 0.3)), "Appliance")


def test_a_lamp_above_a_table_and_the_table_below_it():
    found = relate(FLOOR, TABLE, LAMP, kinds=BOTH)
    assert related(found) == {("lamp", "above", "table"), ("table", "below", "lamp")}
    # From the table's top at 0.7 m to the lamp at 1.5 m; all of the lamp's footprint is over the table.
    for relation in found:
        assert relation.rule == ABOVE.rule
        assert relation.numbers == pytest.approx({"gap": 0.8, "overlapRatio": 1})
        assert relation.confidence == 1


def test_overlap_is_relative_to_the_smaller_footprint():
    # The sign is 2 m × 0.1 m over a box of 0.2 m × 0.2 m: half of the box is under it, a tenth of the sign over it.
    sign = artifact("sign", (-1, 0.3, 2), (2, 0.1, 0.3))
    box = artifact("box", (0, 0.2, 0), (0.2, 0.2, 0.2))
    (relation,) = relate(sign, box, kinds=("above",))
    assert relation.numbers == pytest.approx({"gap": 1.8, "overlapRatio": 0.5})


@pytest.mark.parametrize(("more", "count"), [(HAIR, 1), (-HAIR, 0)])
def test_overlap_threshold_of_above(more: float, count: int):
    over = ABOVE.min_overlap_ratio * 0.2 + more
    lamp = (thing("/lamp", (1 - over, 0.4, 1.5), (0.2, 0.2, 0.3)), "Appliance")
    assert len(relate(TABLE, lamp, kinds=("above",))) == count


def test_on_suppresses_above():
    assert relate(FLOOR, TABLE, cup((0.4, 0.4, 0.7)), kinds=("above",)) == ()


def test_lamp_above_a_stack_is_above_its_top_object():
    tray = artifact("tray", (0.2, 0.2, 0.7), (0.6, 0.6, 0.02))
    book = artifact("book", (0.35, 0.35, 0.72), (0.3, 0.3, 0.04))
    assert related(relate(FLOOR, TABLE, tray, book, LAMP, kinds=("above",))) == {("lamp", "above", "book")}


def test_objects_beside_the_gap_suppress_nothing():
    tray = artifact("tray", (0, 0, 0.7), (0.3, 0.3, 0.02))
    assert related(relate(TABLE, tray, LAMP, kinds=("above",))) == {("lamp", "above", "table")}


def test_stacked_objects_with_gaps_are_a_chain():
    signs = [artifact(f"sign{i}", (0, 0, 1.0 * i), (1, 1, 0.1)) for i in range(5)]
    assert related(relate(*signs, kinds=("above",))) == {(f"sign{i + 1}", "above", f"sign{i}") for i in range(4)}


def test_shelf_is_above_objects_instead_of_its_books():
    shelf = (thing("/shelf", (0, 0, 1.4), (1, 0.3, 0.05)), "DesignedFurniture")
    book = artifact("book", (0.1, 0.05, 1.45), (0.2, 0.2, 0.25))
    assert related(relate(TABLE, shelf, book, kinds=("above",))) == {("shelf", "above", "table")}


def test_wall_cupboard_is_above_objects_instead_of_its_plates():
    cupboard = (thing("/cupboard", (0, 0, 1.4), (1, 0.4, 0.7)), "Cupboard")
    low = (thing("/low", (0.2, 0.1, 1.42), (0.25, 0.25, 0.02)), "DinnerPlate")
    high = (thing("/high", (0.2, 0.1, 1.8), (0.25, 0.25, 0.02)), "DinnerPlate")
    found = related(relate(TABLE, cupboard, low, high, kinds=("above",)))
    assert found == {("cupboard", "above", "table"), ("high", "above", "low")}


def test_drawers_are_above_each_other_within_their_cabinet():
    cabinet = (thing("/cab", (0, 0, 0.2), (0.6, 0.6, 0.8)), "KitchenCabinet")
    drawers = [
        (thing(f"/cab/drawer{i}", (0.02, 0, 0.2 + 0.25 * i), (0.56, 0.5, 0.24), parent_path="/cab"), "Drawer")
        for i in range(3)
    ]
    ball = artifact("ball", (0.2, 0.2, 0), (0.15, 0.15, 0.15))
    found = related(relate(cabinet, *drawers, ball, kinds=("above",)))
    assert found == {("drawer1", "above", "drawer0"), ("drawer2", "above", "drawer1"), ("cab", "above", "ball")}


def test_above_keeps_the_nearest_anchors():
    beam = artifact("beam", (0, 0, 3), (20, 0.5, 0.2))
    boxes = [artifact(f"box{i}", (1.0 * i, 0, 0), (0.5, 0.5, 0.1 * (i + 1))) for i in range(10)]
    found = [r for r in relate(beam, *boxes, kinds=("above",)) if r.target == "/beam"]
    # The highest are nearest.
    assert related(found) == {("beam", "above", f"box{i}") for i in range(10 - ABOVE.most, 10)}


def test_flat_objects_at_one_height_are_not_above_each_other():
    assert relate(artifact("a", (0, 0, 1), (1, 1, 0)), artifact("b", (0, 0, 1), (1, 1, 0)), kinds=("above",)) == ()


def test_floors_are_excluded_from_above():
    room = (thing("/room", (-5, -5, 0), (10, 10, 3)), "Room")
    ceiling = (thing("/ceiling", (-5, -5, 3), (10, 10, 0.1)), "Ceiling")
    assert relate(room, FLOOR, ceiling, LAMP, kinds=("above",)) == ()
