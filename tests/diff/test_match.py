"""A thing that was renamed or moved is known again by its asset, box, name and place."""

import random
import time
from collections.abc import Sequence
from dataclasses import replace

import pytest

from tests.diff.records import item, pairs, ways
from usd2kg.diff import ObjectState, Tolerances, compare_objects

CHAIR = (0.5, 0.5, 0.9)


def rename(thing: ObjectState, path: str) -> ObjectState:
    return replace(thing, prim_path=path)


def put(thing: ObjectState, x: float, y: float = 0.0, z: float = 0.0) -> ObjectState:
    return replace(thing, center=(x, y, z), position=(x, y, z))


def new_paths(old: Sequence[ObjectState], new: Sequence[ObjectState]) -> dict[str, str]:
    return {before: after for before, after, _ in pairs(compare_objects(old, new))}


def test_a_new_name_in_the_same_place() -> None:
    changes = compare_objects([item("/Room/Cup_1")], [rename(item("/Room/Cup_1"), "/Room/xyz")])
    assert pairs(changes) == {("/Room/Cup_1", "/Room/xyz", "place")}
    assert ways(changes) == {"renamed": 1}


def test_a_new_name_close_by_needs_the_same_asset_or_class() -> None:
    cup = item("/Room/Cup_1")
    for distance, expected in ((1.9, {"renamed": 1, "moved": 1}), (2.1, {"added": 1, "removed": 1})):
        assert ways(compare_objects([cup], [put(rename(cup, "/Room/Mug"), distance)])) == expected
    plain = replace(cup, assets=frozenset())
    for distance, expected in ((0.9, {"renamed": 1, "moved": 1}), (1.1, {"added": 1, "removed": 1})):
        assert ways(compare_objects([plain], [put(rename(plain, "/Room/Mug"), distance)])) == expected
    unknown = replace(plain, classes=())
    assert ways(compare_objects([unknown], [put(rename(unknown, "/Room/Mug"), 0.5)])) == {"added": 1, "removed": 1}


def test_another_asset_or_size_is_another_thing() -> None:
    cup = item("/Room/Cup_1")
    for other in (
        replace(cup, assets=frozenset({"Bowl"})),
        replace(cup, size=(0.1, 0.1, 0.2)),
        replace(cup, size=None),
    ):
        assert ways(compare_objects([cup], [rename(other, "/Room/Mug")])) == {"added": 1, "removed": 1}


def test_the_same_name_elsewhere_however_far() -> None:
    cup = item("/Room/Cup_1")
    changes = compare_objects([cup], [put(rename(cup, "/Room2/Shelf/Cup_1"), 30)])
    assert ways(changes) == {"renamed": 1, "moved": 1}


def test_a_path_keeps_its_thing_even_where_it_changed_a_lot() -> None:
    cup = item("/Room/Cup_1")
    changed = put(replace(cup, assets=frozenset({"Mug"}), size=(0.2, 0.2, 0.2)), 9)
    assert ways(compare_objects([cup], [changed])) == {"moved": 1, "resized": 1, "other asset": 1}


def test_a_path_that_another_thing_took_over_is_told_apart() -> None:
    cup, table = item("/Room/Cup"), item("/Room/Table", (2, 0, 0), (2, 1, 0.7))
    assert new_paths([cup], [rename(table, "/Room/Cup"), rename(cup, "/Room/Mug")]) == {"/Room/Cup": "/Room/Mug"}


def test_two_equal_cups_that_change_places_have_moved() -> None:
    one, other = item("/Room/Cup_1", (0, 0, 0)), item("/Room/Cup_2", (1, 0, 0))
    changes = compare_objects([one, other], [put(one, 1), put(other, 0)])
    assert ways(changes) == {"moved": 2}


def test_a_renamed_group_takes_all_with_it() -> None:
    def room(name: str, shift: float) -> list[ObjectState]:
        rows = [item(f"/House/{name}/Rack_{i}/Cup", (i, shift, 0)) for i in range(9)]
        return [*rows, item(f"/House/{name}/Lamp", (0, shift, 2)), item(f"/House/{name}/Sofa", (3, shift, 0))]

    changes = compare_objects(room("Room", 0), room("Kitchen", 0.5))
    assert {by for _, _, by in pairs(changes)} == {"group"}
    assert ways(changes) == {"renamed": 11, "moved": 11}
    # Racks stand 1 m apart: by place alone the cups would be taken for their neighbours.
    moved = [*room("Room", 0)[-2:], *(put(cup, cup.center[0] + 1) for cup in room("Room", 0)[:-2])]
    renamed = [rename(thing, thing.prim_path.replace("Room", "Kitchen")) for thing in moved]
    found = new_paths(room("Room", 0), renamed)
    assert all(after == before.replace("Room", "Kitchen") for before, after in found.items())


def test_twenty_equal_chairs_shuffled_and_one_removed() -> None:
    chairs = [item(f"/Hall/Chair_{i}", (float(i % 5), float(i // 5), 0), CHAIR) for i in range(20)]
    places = [chair.center for chair in chairs]
    random.Random(3).shuffle(places)
    shuffled = [put(chair, *place) for chair, place in zip(chairs, places, strict=True)]
    changes = compare_objects(chairs, shuffled[:-1])
    moved = sum(a.center != b.center for a, b in zip(chairs[:-1], shuffled[:-1], strict=True))
    assert ways(changes) == {"removed": 1, "moved": moved}
    assert changes.removed[0].prim_path == "/Hall/Chair_19"


def test_twenty_equal_chairs_with_new_names_and_one_removed() -> None:
    chairs = [item(f"/Hall/Chair_{i}", (float(i % 5), float(i // 5), 0), CHAIR) for i in range(20)]
    names = list(range(19))
    random.Random(4).shuffle(names)
    renamed = [rename(chair, f"/Hall/Seat_{name}") for chair, name in zip(chairs[:19], names, strict=True)]
    changes = compare_objects(chairs, renamed)
    assert ways(changes) == {"removed": 1, "renamed": 19}
    assert changes.removed[0].prim_path == "/Hall/Chair_19"


def test_the_nearest_of_several_is_taken() -> None:
    old = [item("/Hall/Chair_1", (0, 0, 0), CHAIR), item("/Hall/Chair_2", (1, 0, 0), CHAIR)]
    new = [rename(put(old[0], 1.2), "/Hall/a"), rename(put(old[1], 0.1), "/Hall/b")]
    assert new_paths(old, new) == {"/Hall/Chair_1": "/Hall/b", "/Hall/Chair_2": "/Hall/a"}


def test_in_one_place_the_class_decides() -> None:
    old = [item("/a", classes=("Cup",), assets=frozenset()), item("/b", classes=("Lid",), assets=frozenset())]
    new = [rename(old[1], "/c"), rename(old[0], "/d")]
    assert new_paths(old, new) == {"/a": "/d", "/b": "/c"}


def test_things_without_geometry_are_known_by_name_and_asset() -> None:
    ghost = item("/Room/Cup_1", size=None)
    assert new_paths([ghost], [rename(ghost, "/Room2/Cup_1")]) == {"/Room/Cup_1": "/Room2/Cup_1"}
    nothing = item("/Room/Cup_1", None, None, assets=frozenset())
    assert new_paths([nothing], [rename(nothing, "/Room2/Cup_1")]) == {}


def test_how_far_to_look_can_be_set() -> None:
    cup = item("/Room/Cup_1")
    new = [put(rename(cup, "/Room/Mug"), 3)]
    assert ways(compare_objects([cup], new, Tolerances(match_within_m=4))) == {"renamed": 1, "moved": 1}
    assert ways(compare_objects([cup], [rename(cup, "/Room/Mug")], Tolerances(moved_m=0, match_within_m=0))) == {
        "renamed": 1
    }


@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_many_equal_things_with_new_names_take_seconds(shift: float) -> None:
    side = 100
    chairs = [item(f"/Hall/Chair_{i}", (i % side, i // side, 0), CHAIR) for i in range(side * side)]
    renamed = [rename(put(c, c.center[0] + shift, c.center[1]), f"/Hall/Seat_{i}") for i, c in enumerate(chairs)]
    start = time.perf_counter()
    found = new_paths(chairs, renamed)
    assert time.perf_counter() - start < 30
    assert found == {f"/Hall/Chair_{i}": f"/Hall/Seat_{i}" for i in range(side * side)}


def test_a_crowd_in_one_place_takes_seconds() -> None:
    crowd = [item(f"/Bin/Screw_{i}", (0, 0, 0)) for i in range(1500)]
    start = time.perf_counter()
    found = new_paths(crowd, [rename(screw, f"/Box/{i}") for i, screw in enumerate(crowd)])
    assert time.perf_counter() - start < 20
    assert len(found) == 1500
