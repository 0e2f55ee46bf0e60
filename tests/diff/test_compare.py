"""Each kind of change, and the symmetry of the comparison."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.diff.records import CUP, item, mirrored, nonzero_counts, on, pairs, rename
from usd2kg.diff import DEFAULT_TOLERANCES, Change, Changes, Link, ObjectState, compare_objects
from usd2kg.errors import GraphError

QUARTER_TURN = (0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5))
TABLE = item("/Room/Table", (0, 0, 0.35), (2, 1, 0.7))


def only_change(old: list[ObjectState], new: list[ObjectState]) -> Change:
    (change,) = compare_objects(old, new).changed
    return change


def counts(old: list[ObjectState], new: list[ObjectState]) -> dict[str, int]:
    return nonzero_counts(compare_objects(old, new))


def test_reports_added_and_removed_objects_with_compared_relations() -> None:
    cup = item("/Room/Cup_1", links=on("/Room/Table") | {Link("near", "/Room/Table")})
    changes = compare_objects([TABLE], [cup])
    assert [state.prim_path for state in changes.added] == ["/Room/Cup_1"]
    assert changes.added[0].links == on("/Room/Table"), "near is not compared by default"
    assert [state.prim_path for state in changes.removed] == ["/Room/Table"]
    assert (changes.old_count, changes.new_count, changes.is_empty) == (1, 1, False)


@pytest.mark.parametrize(("distance", "is_moved"), [(0.009, False), (0.011, True), (3.0, True)])
def test_an_object_moves_by_more_than_a_centimetre(distance: float, is_moved: bool) -> None:
    changes = compare_objects([item("/Cup_1", (0, 0, 0))], [item("/Cup_1", (0, distance, 0))])
    assert changes.is_empty is not is_moved
    if is_moved:
        assert changes.changed[0].move == ((0, 0, 0), (0, distance, 0), pytest.approx(distance))


def test_geometry_can_move_within_its_frame() -> None:
    old = item("/Cup_1", (0, 0, 0), position=(0, 0, 0))
    new = item("/Cup_1", (0, 0.3, 0), position=(0, 0, 0))
    assert only_change([old], [new]).move.distance == pytest.approx(0.3)


@pytest.mark.parametrize(("start", "end", "angle"), [(0, 0.9, 0), (0, 45, 45), (10, 350, 20)])
def test_an_object_turns_by_more_than_a_degree(start: float, end: float, angle: float) -> None:
    def turned(degrees: float) -> ObjectState:
        half = math.radians(degrees) / 2
        return item("/Cup_1", orientation=(0, 0, math.sin(half), math.cos(half)))

    changes = compare_objects([turned(start)], [turned(end)])
    assert [change.turned_degrees for change in changes.changed] == ([pytest.approx(angle)] if angle else [])


def test_a_turn_does_not_resize() -> None:
    old = item("/Cup_1", size=(2, 1, 0.7))
    new = item("/Cup_1", size=(1, 2, 0.7), orientation=QUARTER_TURN)
    assert counts([old], [new]) == {"turned": 1}


@pytest.mark.parametrize(
    ("old", "new", "is_resized"),
    [
        ((0.1, 0.1, 0.1), (0.1, 0.1, 0.1009), False),
        ((0.1, 0.1, 0.1), (0.1, 0.1, 0.102), True),
        ((5.0, 4.0, 2.5), (5.0, 4.0, 2.509), False),
        ((5.0, 4.0, 2.5), (5.0, 4.011, 2.5), True),
        ((0.2, 0.3, 0.0), (0.2, 0.3, 0.00005), False),
        ((2.0, 1.0, 0.7), (1.0, 2.0, 0.7), True),
    ],
)
def test_a_side_changes_by_more_than_a_centimetre_or_a_percent(old: tuple, new: tuple, is_resized: bool) -> None:
    assert counts([item("/Cup_1", size=old)], [item("/Cup_1", size=new)]) == ({"resized": 1} if is_resized else {})


def test_a_box_that_grows_around_a_nested_object_has_not_moved() -> None:
    old = item("/Table", (0, 0, 0.35), (2, 1, 0.7))
    new = replace(old, size=(2, 1, 0.8), center=(0, 0, 0.4))
    changes = compare_objects([old], [new, item("/Table/Cup_1")])
    assert changes.changed[0].holds_changes
    assert nonzero_counts(changes) == {"added": 1, "resized": 1}


def test_classes_are_compared_if_both_sides_have_any() -> None:
    ungrounded = item("/Cup_1", classes=())
    assert counts([item("/Cup_1")], [item("/Cup_1", classes=("https://e.org/Bowl",))]) == {"reclassified": 1}
    assert counts([item("/Cup_1")], [TABLE, ungrounded]) == {"added": 1, "reclassified": 1}
    assert counts([item("/Cup_1")], [ungrounded]) == {}
    grounded = compare_objects([item("/Cup_1")], [ungrounded], is_grounded=True)
    assert nonzero_counts(grounded) == {"reclassified": 1}


def test_reports_other_mass_and_asset() -> None:
    cup = item("/Cup_1", mass_kg=0.2)
    change = only_change([cup], [item("/Cup_1", mass_kg=0.3, assets=frozenset({"Mug", "Mug2"}))])
    assert change.mass == (0.2, 0.3)
    assert change.assets == ({"Cup"}, {"Mug", "Mug2"})
    assert counts([cup], [replace(cup, mass_kg=0.2001)]) == {}
    assert only_change([item("/Cup_1")], [cup]).mass == (None, 0.2)


def test_reports_gained_and_lost_relations() -> None:
    shelf = item("/Room/Shelf", (3, 0, 0.5), (1, 0.4, 1))
    old, new = (item("/Room/Cup_1", links=on(anchor)) for anchor in ("/Room/Table", "/Room/Shelf"))
    change = only_change([TABLE, shelf, old], [TABLE, shelf, new])
    assert (change.gained, change.lost) == ((Link("on", "/Room/Shelf"),), (Link("on", "/Room/Table"),))


def test_relation_to_a_renamed_anchor_is_the_same() -> None:
    old = [TABLE, item("/Room/Cup_1", links=on("/Room/Table"))]
    new = [rename(TABLE, "/Room/Desk"), item("/Room/Cup_1", links=on("/Room/Desk"))]
    assert counts(old, new) == {"renamed": 1}


def test_relation_to_another_object_at_the_same_path_is_new() -> None:
    stool = item("/Room/Table", (0, 0, 0.2), (0.4, 0.4, 0.4), assets=frozenset({"Stool"}), classes=("Stool",))
    cup = item("/Room/Cup_1", (0, 0, 0.8), links=on("/Room/Table"))
    assert counts([TABLE, cup], [stool, cup]) == {
        "added": 1,
        "removed": 1,
        "relations gained": 1,
        "relations lost": 1,
    }


def test_relations_to_an_object_and_to_a_group_at_its_new_path_differ() -> None:
    old = [TABLE, item("/Room/Cup_1", links=on("/Room/Table", "/Room/Desk"))]
    new = [rename(TABLE, "/Room/Desk"), item("/Room/Cup_1")]
    assert counts(old, new) == {"renamed": 1, "relations lost": 2}


def test_relation_to_a_renamed_room_group_is_the_same() -> None:
    def objects_in(room: str) -> list[ObjectState]:
        links = frozenset({Link("room", f"/House/{room}")})
        return [item(f"/House/{room}/Table", links=links), item(f"/House/{room}/Cup_1", (0, 0, 1), links=links)]

    assert counts(objects_in("Room"), objects_in("Kitchen")) == {"renamed": 2}


def test_names_the_carrier_of_an_object_that_moves_along() -> None:
    tray, cup = item("/Room/Tray", (0.4, 0, 0.7)), item("/Room/Cup_1", (0.5, 0, 0.75), links=on("/Room/Tray"))
    other = item("/Room/Cup_2", (1, 0, 0.75), links=on("/Room/Table"))
    # The tray turns by 90° about its own origin and moves 1 m along x; the other cup moves by itself.
    new = [
        TABLE,
        item("/Room/Tray", (1.4, 0, 0.7), orientation=QUARTER_TURN),
        item("/Room/Cup_1", (1.4, 0.1, 0.75), orientation=QUARTER_TURN, links=on("/Room/Tray")),
        replace(other, center=(2, 0, 0.75), position=(2, 0, 0.75)),
    ]
    changes = compare_objects([TABLE, tray, cup, other], new)
    carriers = {change.match.new.name: change.carrier for change in changes.changed}
    assert carriers == {"Tray": None, "Cup_1": "/Room/Tray", "Cup_2": None}


def test_tolerances_are_options_and_not_negative() -> None:
    wide = replace(DEFAULT_TOLERANCES, moved_m=0.5, resized_m=1, resized_percent=50)
    new = item("/Cup_1", (0.4, 0, 0), (0.1, 0.1, 0.13))
    assert compare_objects([item("/Cup_1")], [new], wide).is_empty
    with pytest.raises(GraphError, match="moved m -1: expected a number that is not negative"):
        replace(DEFAULT_TOLERANCES, moved_m=-1)


NUMBERS = st.sampled_from([0.0, 0.004, 0.3, 1.0, 5.0])
NAMES = st.sampled_from(["/A/Cup_1", "/A/Cup_2", "/B/Cup_1", "/A/Bowl", "/A/Bowl/Cup_1", "/B/Bowl", "/C"])
STATES = st.builds(
    item,
    NAMES,
    st.none() | st.tuples(NUMBERS, NUMBERS, NUMBERS),
    st.none() | st.sampled_from([CUP, (0.1, 0.2, 0.1), (1.0, 1.0, 1.0)]),
    assets=st.sampled_from([frozenset(), frozenset("a"), frozenset("b"), frozenset("ab")]),
    classes=st.sampled_from([(), ("Cup",), ("Bowl",)]),
    orientation=st.sampled_from([None, (0.0, 0.0, 0.0, 1.0), QUARTER_TURN]),
    links=st.frozensets(st.builds(Link, st.sampled_from(["on", "room"]), NAMES | st.just("/A")), max_size=2),
)
SCENES = st.lists(STATES, max_size=6, unique_by=lambda state: state.prim_path)


@settings(max_examples=50, deadline=None)
@given(states=SCENES)
def test_a_scene_does_not_differ_from_itself(states: list[ObjectState]) -> None:
    changes = compare_objects(states, states)
    assert changes.is_empty
    assert nonzero_counts(changes) == {}


@settings(max_examples=150, deadline=None)
@given(old=SCENES, new=SCENES)
def test_comparison_in_reverse_is_the_mirror_image(old: list[ObjectState], new: list[ObjectState]) -> None:
    forward, backward = compare_objects(old, new), compare_objects(new, old)
    assert pairs(forward) == {(after, before, by) for before, after, by in pairs(backward)}
    assert _carriers(forward) == {after: before for before, after in _reversed_carriers(backward)}
    assert _without_carriers(backward) == _without_carriers(mirrored(forward))


def _carriers(changes: Changes) -> dict[str, str | None]:
    """Return new path of each changed object → new path of its carrier."""
    return {change.match.new.prim_path: change.carrier for change in changes.changed}


def _reversed_carriers(changes: Changes) -> list[tuple[str | None, str]]:
    old_paths = {match.new.prim_path: match.old.prim_path for match in changes.matches}
    return [(change.carrier and old_paths[change.carrier], change.match.old.prim_path) for change in changes.changed]


def _without_carriers(changes: Changes) -> Changes:
    return replace(changes, changed=tuple(replace(change, carrier=None) for change in changes.changed))
