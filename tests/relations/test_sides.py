"""left, right, front and behind, from a viewpoint."""

import pytest

from tests.relations.room_builder import RULES, artifact, relate
from usd2kg.errors import GraphError
from usd2kg.relations import (
    ALL_KINDS,
    DEFAULT_KINDS,
    VIEWPOINT_KINDS,
    RelationOptions,
    Viewpoint,
    parse_kinds,
    parse_viewpoint,
)

ONE = artifact("one", (0, 0, 0), (0.2, 0.2, 0.2))
RIGHT = artifact("two", (0.3, 0, 0), (0.2, 0.2, 0.2))
"""Farther along x."""
FAR = artifact("two", (0, 0.3, 0), (0.2, 0.2, 0.2))
"""Farther along y."""


def sides(*placed, viewpoint):
    found = relate(*placed, kinds=VIEWPOINT_KINDS, viewpoint=viewpoint)
    return {(r.target[1:], r.kind, r.anchor[1:]) for r in found}


@pytest.mark.parametrize(
    ("position", "expected"),
    [
        ((0.2, -3, 1.6), ("left", "right")),
        ((0.2, 3, 1.6), ("right", "left")),
        ((-3, 0.1, 1.6), ("front", "behind")),
        ((3, 0.1, 1.6), ("behind", "front")),
    ],
)
def test_two_boxes_along_x_from_four_sides(position, expected):
    one, two = expected
    assert sides(ONE, RIGHT, viewpoint=Viewpoint(position)) == {("one", one, "two"), ("two", two, "one")}


def test_with_a_direction_the_place_does_not_count():
    for x in (-5.0, 0.0, 5.0):
        looking = Viewpoint((x, -3.0, 1.6), (0.0, 1.0, -0.5))
        assert sides(ONE, RIGHT, viewpoint=looking) == {("one", "left", "two"), ("two", "right", "one")}
        assert sides(ONE, FAR, viewpoint=looking) == {("one", "front", "two"), ("two", "behind", "one")}


def test_the_angle_that_it_is_off():
    # From one to the other by 0.3 m along x and 0.3 m · tan 20° along y; seen along y, 20 degrees off to the right.
    two = artifact("two", (0.3, 0.3 * 0.36397023, 0), (0.2, 0.2, 0.2))
    found = relate(ONE, two, kinds=("right",), viewpoint=Viewpoint((0, -3, 0), (0, 1, 0)))
    (relation,) = found
    assert (relation.target, relation.rule) == ("/two", RULES.side.rule)
    assert relation.numbers == pytest.approx({"angle": 20, "distance": 0.1})
    # Half of the 40 degrees that are allowed.
    assert relation.confidence == pytest.approx(0.5)


def test_in_between_two_directions_nothing_is_said():
    two = artifact("two", (0.25, 0.25, 0), (0.2, 0.2, 0.2))
    assert sides(ONE, two, viewpoint=Viewpoint((0, -3, 0), (0, 1, 0))) == set()


def test_sides_need_similar_heights_and_proximity():
    high = artifact("two", (0.25, 0, 0.18), (0.2, 0.2, 0.2))
    far = artifact("two", (2, 0, 0), (0.2, 0.2, 0.2))
    for other in (high, far):
        assert sides(ONE, other, viewpoint=Viewpoint((0, -3, 0), (0, 1, 0))) == set()


def test_from_right_above_there_is_no_direction():
    assert sides(ONE, RIGHT, viewpoint=Viewpoint((0.25, 0.1, 3))) == set()


def test_a_viewpoint_brings_them_in_by_default():
    assert RelationOptions().chosen_kinds == frozenset(DEFAULT_KINDS)
    looking = RelationOptions(viewpoint=Viewpoint((0, -3, 1)))
    assert looking.chosen_kinds == frozenset((*DEFAULT_KINDS, *VIEWPOINT_KINDS))


class TestWords:
    def test_viewpoint(self):
        assert parse_viewpoint("1,2.5,-3") == Viewpoint((1, 2.5, -3))
        assert parse_viewpoint(" 1, 2, 3, 0, 1, 0") == Viewpoint((1, 2, 3), (0, 1, 0))

    @pytest.mark.parametrize("text", ["", "1,2", "a,b,c", "1,2,3,4", "1,2,3,4,5,6,7", "nan,0,0", "0,0,0,inf,0,0"])
    def test_a_viewpoint_is_three_or_six_numbers(self, text: str):
        with pytest.raises(GraphError, match=r"viewpoint .*: expected"):
            parse_viewpoint(text)

    def test_nobody_looks_straight_down(self):
        with pytest.raises(GraphError, match="vertical; expected one that looks sideways"):
            parse_viewpoint("0,0,2,0,0,-1")

    def test_kinds_come_in_their_order_and_once(self):
        assert parse_kinds("near, on,inside ,on") == ("on", "inside", "near")
        assert parse_kinds("default") == DEFAULT_KINDS
        assert set(parse_kinds("all")) == set(ALL_KINDS) - set(VIEWPOINT_KINDS)
        assert parse_kinds("all", Viewpoint((0, 0, 0))) == ALL_KINDS

    def test_an_unknown_kind_is_refused_with_the_known_ones(self):
        with pytest.raises(GraphError, match="kind 'under' is unknown; expected a list of on, inside, above"):
            parse_kinds("on,under")
        with pytest.raises(GraphError, match="no kind is named"):
            parse_kinds(" , ")
        with pytest.raises(GraphError, match="kind 'beside' is unknown"):
            RelationOptions(kinds=("beside",))

    def test_sides_need_a_viewpoint(self):
        with pytest.raises(GraphError, match="left depends on the viewer; give a viewpoint"):
            parse_kinds("left,on")
        with pytest.raises(GraphError, match="behind depends on the viewer"):
            RelationOptions(kinds=("behind",))
