"""What is said of each kind of change, and of several at once."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.diff.records import CUP, item, mirrored, on, pairs, ways
from usd2kg.diff import Changes, Link, ObjectState, Tolerances, compare_objects
from usd2kg.errors import GraphError

QUARTER = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))
TABLE = item("/Room/Table", (0, 0, 0.35), (2, 1, 0.7))


def only(changes: Changes):
    (change,) = changes.changed
    return change


def test_the_same_things_do_not_differ() -> None:
    changes = compare_objects([TABLE, item("/Room/Cup_1")], [TABLE, item("/Room/Cup_1")])
    assert changes.is_empty
    assert ways(changes) == {}
    assert (changes.old_count, changes.new_count) == (2, 2)


def test_added_and_removed() -> None:
    changes = compare_objects([TABLE], [item("/Room/Cup_1", links=on("/Room/Table") | {Link("near", "/Room/Table")})])
    assert [t.prim_path for t in changes.added] == ["/Room/Cup_1"]
    assert changes.added[0].links == on("/Room/Table"), "nearness is not compared unless asked for"
    assert [t.prim_path for t in changes.removed] == ["/Room/Table"]
    assert not changes.is_empty


@pytest.mark.parametrize(("distance", "moved"), [(0.009, False), (0.011, True), (3.0, True)])
def test_moved_by_more_than_a_centimetre(distance: float, moved: bool) -> None:
    changes = compare_objects([item("/Cup_1", (0, 0, 0))], [item("/Cup_1", (0, distance, 0))])
    assert changes.is_empty is not moved
    if moved:
        assert only(changes).move == ((0, 0, 0), (0, distance, 0), pytest.approx(distance))


def test_geometry_that_moves_within_its_frame_has_moved() -> None:
    old = item("/Cup_1", (0, 0, 0), position=(0, 0, 0))
    new = item("/Cup_1", (0, 0.3, 0), position=(0, 0, 0))
    assert only(compare_objects([old], [new])).move.distance == pytest.approx(0.3)


def test_turned_by_more_than_a_degree() -> None:
    def turned(degrees: float) -> ObjectState:
        half = math.radians(degrees) / 2
        return item("/Cup_1", orientation=(0, 0, math.sin(half), math.cos(half)))

    assert compare_objects([turned(0)], [turned(0.9)]).is_empty
    assert only(compare_objects([turned(0)], [turned(45)])).turned_degrees == pytest.approx(45)
    assert only(compare_objects([turned(10)], [turned(350)])).turned_degrees == pytest.approx(20)


def test_turning_a_thing_does_not_resize_it() -> None:
    old = item("/Cup_1", size=(2, 1, 0.7))
    new = item("/Cup_1", size=(1, 2, 0.7), orientation=QUARTER)
    assert ways(compare_objects([old], [new])) == {"turned": 1}


@pytest.mark.parametrize(
    ("old", "new", "resized"),
    [
        ((0.1, 0.1, 0.1), (0.1, 0.1, 0.1009), False),
        ((0.1, 0.1, 0.1), (0.1, 0.1, 0.102), True),
        ((5.0, 4.0, 2.5), (5.0, 4.0, 2.509), False),
        ((5.0, 4.0, 2.5), (5.0, 4.011, 2.5), True),
        ((0.2, 0.3, 0.0), (0.2, 0.3, 0.00005), False),
        ((2.0, 1.0, 0.7), (1.0, 2.0, 0.7), True),
    ],
)
def test_resized_by_more_than_a_centimetre_or_a_percent(old: tuple, new: tuple, resized: bool) -> None:
    changes = compare_objects([item("/Cup_1", size=old)], [item("/Cup_1", size=new)])
    assert ways(changes) == ({"resized": 1} if resized else {})


def test_a_box_that_grows_around_a_nested_thing_says_so_and_has_not_moved() -> None:
    old = item("/Table", (0, 0, 0.35), (2, 1, 0.7))
    new = replace(old, size=(2, 1, 0.8), center=(0, 0, 0.4))
    changes = compare_objects([old], [new, item("/Table/Cup_1")])
    assert only(changes).holds_changes
    assert ways(changes) == {"added": 1, "resized": 1}


def test_reclassified() -> None:
    changes = compare_objects([item("/Cup_1")], [item("/Cup_1", classes=("https://e.org/Bowl",))])
    assert ways(changes) == {"reclassified": 1}
    assert ways(compare_objects([item("/Cup_1")], [TABLE, item("/Cup_1", classes=())])) == {
        "added": 1,
        "reclassified": 1,
    }
    assert compare_objects([item("/Cup_1")], [item("/Cup_1", classes=())]).is_empty, "nobody was asked for classes"


def test_mass_and_asset() -> None:
    changes = compare_objects(
        [item("/Cup_1", mass_kg=0.2)], [item("/Cup_1", mass_kg=0.3, assets=frozenset({"Mug", "Mug2"}))]
    )
    assert only(changes).mass == (0.2, 0.3)
    assert only(changes).assets == ({"Cup"}, {"Mug", "Mug2"})
    assert compare_objects([item("/Cup_1", mass_kg=0.2)], [item("/Cup_1", mass_kg=0.2001)]).is_empty
    assert only(compare_objects([item("/Cup_1")], [item("/Cup_1", mass_kg=0.2)])).mass == (None, 0.2)


def test_relations_gained_and_lost() -> None:
    shelf = item("/Room/Shelf", (3, 0, 0.5), (1, 0.4, 1))
    old = [TABLE, shelf, item("/Room/Cup_1", links=on("/Room/Table"))]
    new = [TABLE, shelf, item("/Room/Cup_1", links=on("/Room/Shelf"))]
    change = only(compare_objects(old, new))
    assert (change.gained, change.lost) == ((Link("on", "/Room/Shelf"),), (Link("on", "/Room/Table"),))


def test_relations_to_what_was_renamed_stay() -> None:
    old = [TABLE, item("/Room/Cup_1", links=on("/Room/Table"))]
    new = [replace(TABLE, prim_path="/Room/Desk"), item("/Room/Cup_1", links=on("/Room/Desk"))]
    assert ways(compare_objects(old, new)) == {"renamed": 1}


def test_relations_to_another_thing_under_the_same_path_are_new() -> None:
    stool = item("/Room/Table", (0, 0, 0.2), (0.4, 0.4, 0.4), assets=frozenset({"Stool"}), classes=("Stool",))
    cup = item("/Room/Cup_1", (0, 0, 0.8), links=on("/Room/Table"))
    changes = compare_objects([TABLE, cup], [stool, cup])
    assert ways(changes) == {"added": 1, "removed": 1, "relations gained": 1, "relations lost": 1}


def test_rooms_that_are_mere_groups_may_be_renamed() -> None:
    def things(room: str) -> list[ObjectState]:
        in_it = frozenset({Link("room", f"/House/{room}")})
        return [item(f"/House/{room}/Table", links=in_it), item(f"/House/{room}/Cup_1", (0, 0, 1), links=in_it)]

    assert ways(compare_objects(things("Room"), things("Kitchen"))) == {"renamed": 2}


def test_what_is_carried_along_names_its_carrier() -> None:
    cup, tray = item("/Room/Cup_1", (0.5, 0, 0.75), links=on("/Room/Tray")), item("/Room/Tray", (0.4, 0, 0.7))
    other = item("/Room/Cup_2", (1, 0, 0.75), links=on("/Room/Table"))
    old = [TABLE, tray, cup, other]
    # The tray turns by a quarter about its own place and goes 1 m along x; the other cup goes elsewhere.
    new = [
        TABLE,
        item("/Room/Tray", (1.4, 0, 0.7), orientation=QUARTER),
        item("/Room/Cup_1", (1.4, 0.1, 0.75), orientation=QUARTER, links=on("/Room/Tray")),
        replace(other, center=(2, 0, 0.75), position=(2, 0, 0.75)),
    ]
    by_name = {c.match.new.name: c for c in compare_objects(old, new).changed}
    assert by_name["Cup_1"].carrier == "/Room/Tray"
    assert by_name["Tray"].carrier is None
    assert by_name["Cup_2"].carrier is None


def test_tolerances_can_be_set_and_are_checked() -> None:
    wide = Tolerances(moved_m=0.5, resized_m=1, resized_percent=50)
    new = item("/Cup_1", (0.4, 0, 0), (0.1, 0.1, 0.13))
    assert compare_objects([item("/Cup_1")], [new], wide).is_empty
    with pytest.raises(GraphError, match="moved m -1: expected a number that is not negative"):
        Tolerances(moved_m=-1)


NUMBERS = st.sampled_from([0.0, 0.004, 0.3, 1.0, 5.0])
NAMES = st.sampled_from(["/A/Cup_1", "/A/Cup_2", "/B/Cup_1", "/A/Bowl", "/A/Bowl/Cup_1", "/B/Bowl", "/C"])
THINGS = st.builds(
    item,
    NAMES,
    st.none() | st.tuples(NUMBERS, NUMBERS, NUMBERS),
    st.none() | st.sampled_from([CUP, (0.1, 0.2, 0.1), (1.0, 1.0, 1.0)]),
    assets=st.sampled_from([frozenset(), frozenset("a"), frozenset("b"), frozenset("ab")]),
    classes=st.sampled_from([(), ("Cup",), ("Bowl",)]),
    orientation=st.sampled_from([None, (0.0, 0.0, 0.0, 1.0), QUARTER]),
    links=st.frozensets(st.builds(Link, st.sampled_from(["on", "room"]), NAMES | st.just("/A")), max_size=2),
)
SCENES = st.lists(THINGS, max_size=6, unique_by=lambda thing: thing.prim_path)


@settings(max_examples=50, deadline=None)
@given(things=SCENES)
def test_nothing_differs_from_itself(things: list[ObjectState]) -> None:
    assert compare_objects(things, things).is_empty


@settings(max_examples=150, deadline=None)
@given(old=SCENES, new=SCENES)
def test_the_other_way_round_is_the_mirror_image(old: list[ObjectState], new: list[ObjectState]) -> None:
    there, back = compare_objects(old, new), compare_objects(new, old)
    assert pairs(there) == {(b, a, by) for a, b, by in pairs(back)}
    names = {m.new.prim_path: m.old.prim_path for m in there.matches}
    carriers = [c.carrier and names[c.carrier] for c in there.changed]
    expected = mirrored(there)
    back_by_old = {c.match.new.prim_path: c for c in back.changed}
    assert [back_by_old[c.match.old.prim_path].carrier for c in there.changed] == carriers
    assert [replace(c, carrier=None) for c in back.changed] == [replace(c, carrier=None) for c in expected.changed]
    assert replace(back, changed=()) == replace(expected, changed=())
