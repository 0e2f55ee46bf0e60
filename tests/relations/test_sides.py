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
def test_sides_from_four_viewpoints(position, expected):
    one, two = expected
    assert sides(ONE, RIGHT, viewpoint=Viewpoint(position)) == {("one", one, "two"), ("two", two, "one")}


def test_gaze_direction_overrides_the_position():
    for x in (-5.0, 0.0, 5.0):
        looking = Viewpoint((x, -3.0, 1.6), (0.0, 1.0, -0.5))
        assert sides(ONE, RIGHT, viewpoint=looking) == {("one", "left", "two"), ("two", "right", "one")}
        assert sides(ONE, FAR, viewpoint=looking) == {("one", "front", "two"), ("two", "behind", "one")}


def test_angle_and_confidence():
    # The offset is 0.3 m along one axis and 0.3 m · tan 20° along the other: 20 degrees off the direction.
    two = artifact("two", (0.3, 0.3 * 0.36397023, 0), (0.2, 0.2, 0.2))
    found = relate(ONE, two, kinds=("right",), viewpoint=Viewpoint((0, -3, 0), (0, 1, 0)))
    (relation,) = found
    assert (relation.target, relation.rule) == ("/two", RULES.side.rule)
    assert relation.numbers == pytest.approx({"angle": 20, "distance": 0.1})
    # Half of the tolerance of 40 degrees.
    assert relation.confidence == pytest.approx(0.5)


def test_diagonal_pairs_have_no_side():
    two = artifact("two", (0.25, 0.25, 0), (0.2, 0.2, 0.2))
    assert sides(ONE, two, viewpoint=Viewpoint((0, -3, 0), (0, 1, 0))) == set()


def test_sides_need_similar_heights_and_proximity():
    high = artifact("two", (0.25, 0, 0.18), (0.2, 0.2, 0.2))
    far = artifact("two", (2, 0, 0), (0.2, 0.2, 0.2))
    for other in (high, far):
        assert sides(ONE, other, viewpoint=Viewpoint((0, -3, 0), (0, 1, 0))) == set()


def test_viewer_directly_above_sees_no_sides():
    assert sides(ONE, RIGHT, viewpoint=Viewpoint((0.25, 0.1, 3))) == set()


def test_viewpoint_adds_sides_to_the_default_kinds():
    assert RelationOptions().chosen_kinds == frozenset(DEFAULT_KINDS)
    looking = RelationOptions(viewpoint=Viewpoint((0, -3, 1)))
    assert looking.chosen_kinds == frozenset((*DEFAULT_KINDS, *VIEWPOINT_KINDS))


class TestParsing:
    def test_viewpoint(self):
        assert parse_viewpoint("1,2.5,-3") == Viewpoint((1, 2.5, -3))
        assert parse_viewpoint(" 1, 2, 3, 0, 1, 0") == Viewpoint((1, 2, 3), (0, 1, 0))

    @pytest.mark.parametrize("text", ["", "1,2", "a,b,c", "1,2,3,4", "1,2,3,4,5,6,7", "nan,0,0", "0,0,0,inf,0,0"])
    def test_rejects_malformed_viewpoints(self, text: str):
        with pytest.raises(GraphError, match=r"viewpoint .*: expected"):
            parse_viewpoint(text)

    def test_rejects_a_vertical_gaze(self):
        with pytest.raises(GraphError, match="vertical; expected one that looks sideways"):
            parse_viewpoint("0,0,2,0,0,-1")

    def test_kinds_are_sorted_and_unique(self):
        assert parse_kinds("near, on,inside ,on") == ("on", "inside", "near")
        assert parse_kinds("default") == DEFAULT_KINDS
        assert set(parse_kinds("all")) == set(ALL_KINDS) - set(VIEWPOINT_KINDS)
        assert parse_kinds("all", Viewpoint((0, 0, 0))) == ALL_KINDS

    def test_rejects_unknown_kinds(self):
        with pytest.raises(
            GraphError, match="kind 'under' is unknown; expected a list of on, inside, attached-to, above"
        ):
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
