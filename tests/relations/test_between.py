"""between."""

import pytest

from tests.graph.records import thing
from tests.relations.room_builder import FLOOR, RULES, TABLE, artifact, cup, relate


def between(*placed):
    found = relate(*placed, kinds=("between",))
    return {(r.target[1:], frozenset({r.anchor[1:], (r.other_anchor or "")[1:]})) for r in found}


def test_cup_is_between_two_plates():
    left = (thing("/left", (0, 0, 0), (0.3, 0.3, 0.1)), "Bowl")
    right = (thing("/right", (0.6, 0, 0), (0.3, 0.3, 0.1)), "Bowl")
    (relation,) = relate(left, right, cup((0.4, 0.1, 0)), kinds=("between",))
    assert (relation.target, relation.anchor, relation.other_anchor) == ("/cup", "/left", "/right")
    assert relation.rule == RULES.between.rule
    assert relation.numbers == {"betweenRatio": 1}
    assert relation.confidence == 1


def test_ratio_is_the_share_in_the_convex_hull():
    # The hull of the two boxes is 0.2 m deep and contains 0.06 m of the cup's 0.1 m.
    left, right = artifact("left", (0, 0, 0), (0.2, 0.2, 0.2)), artifact("right", (0.6, 0, 0), (0.2, 0.2, 0.2))
    (relation,) = relate(left, right, cup((0.35, 0.14, 0)), kinds=("between",))
    assert relation.numbers == pytest.approx({"betweenRatio": 0.6})
    assert relation.confidence == pytest.approx(((0.6 - 0.51) / 0.49) ** 2 * (3 - 2 * (0.6 - 0.51) / 0.49))
    assert relate(left, right, cup((0.35, 0.151, 0)), kinds=("between",)) == ()


def test_ratio_in_a_slanted_hull():
    # The sides of the hull slant; in the middle it is as deep as the boxes.
    left, right = artifact("left", (0, 0, 0), (0.2, 0.2, 0.2)), artifact("right", (0.6, 0.4, 0), (0.2, 0.2, 0.2))
    assert between(left, right, cup((0.35, 0.25, 0))) == {("cup", frozenset({"left", "right"}))}
    assert between(left, right, cup((0.35, 0.42, 0))) == set()


def test_different_heights_are_not_between():
    left, right = artifact("left", (0, 0, 0), (0.2, 0.2, 0.2)), artifact("right", (0.6, 0, 0), (0.2, 0.2, 0.2))
    assert between(left, right, cup((0.35, 0.05, 0.19))) == set()


def test_supporters_are_not_anchors():
    other = artifact("other", (0.6, 0.1, 0.7), (0.2, 0.2, 0.2))
    assert between(FLOOR, TABLE, other, cup((0.4, 0.15, 0.7))) == set()


def test_finds_the_closest_pair_of_anchors():
    row = [artifact(f"box{i}", (0.4 * i, 0, 0), (0.2, 0.2, 0.2)) for i in range(5)]
    assert between(*row) == {(f"box{i}", frozenset({f"box{i - 1}", f"box{i + 1}"})) for i in (1, 2, 3)}


def test_distant_anchors_are_ignored():
    left, right = artifact("left", (0, 0, 0), (0.2, 0.2, 0.2)), artifact("right", (1.5, 0, 0), (0.2, 0.2, 0.2))
    assert between(left, right, cup((0.8, 0.05, 0))) == set()
