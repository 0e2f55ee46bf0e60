"""Matching of renamed and moved objects by asset, size, name and place."""

import random
import time
from collections.abc import Sequence
from dataclasses import replace

import pytest

from tests.diff.records import item, nonzero_counts, pairs, rename
from usd2kg.diff import DEFAULT_TOLERANCES, ObjectState, Tolerances, compare_objects

CHAIR = (0.5, 0.5, 0.9)
MATCHED = {"renamed": 1, "moved": 1}
NOT_MATCHED = {"added": 1, "removed": 1}


def put(state: ObjectState, x: float, y: float = 0.0, z: float = 0.0) -> ObjectState:
    return replace(state, center=(x, y, z), position=(x, y, z))


def counts(
    old: Sequence[ObjectState], new: Sequence[ObjectState], tolerances: Tolerances = DEFAULT_TOLERANCES
) -> dict[str, int]:
    return nonzero_counts(compare_objects(old, new, tolerances))


def new_paths(old: Sequence[ObjectState], new: Sequence[ObjectState]) -> dict[str, str]:
    return {before: after for before, after, _ in pairs(compare_objects(old, new))}


def chairs(count: int, columns: int) -> list[ObjectState]:
    return [item(f"/Hall/Chair_{i}", (i % columns, i // columns, 0), CHAIR) for i in range(count)]


def test_matches_a_renamed_object_in_the_same_place() -> None:
    changes = compare_objects([item("/Room/Cup_1")], [rename(item("/Room/Cup_1"), "/Room/xyz")])
    assert pairs(changes) == {("/Room/Cup_1", "/Room/xyz", "place")}
    assert nonzero_counts(changes) == {"renamed": 1}


@pytest.mark.parametrize(
    ("known", "distance", "expected"),
    [
        ({}, 1.9, MATCHED),
        ({}, 2.1, NOT_MATCHED),
        ({"assets": frozenset()}, 0.9, MATCHED),
        ({"assets": frozenset()}, 1.1, NOT_MATCHED),
        ({"assets": frozenset(), "classes": ()}, 0.5, NOT_MATCHED),
    ],
)
def test_matches_a_renamed_object_nearby_by_asset_or_class(known: dict, distance: float, expected: dict) -> None:
    cup = item("/Room/Cup_1", **known)
    assert counts([cup], [put(rename(cup, "/Room/Mug"), distance)]) == expected


def test_reach_is_an_option() -> None:
    cup = item("/Room/Cup_1")
    mug = rename(cup, "/Room/Mug")
    assert counts([cup], [put(mug, 3)], replace(DEFAULT_TOLERANCES, match_within_m=4)) == MATCHED
    assert counts([cup], [mug], replace(DEFAULT_TOLERANCES, moved_m=0, match_within_m=0)) == {"renamed": 1}


@pytest.mark.parametrize("other", [{"assets": frozenset({"Bowl"})}, {"size": (0.1, 0.1, 0.2)}, {"size": None}])
def test_does_not_match_a_renamed_object_of_another_asset_or_size(other: dict) -> None:
    cup = item("/Room/Cup_1")
    assert counts([cup], [rename(replace(cup, **other), "/Room/Mug")]) == NOT_MATCHED


def test_matches_the_same_name_at_any_distance() -> None:
    cup = item("/Room/Cup_1")
    assert counts([cup], [put(rename(cup, "/Room2/Shelf/Cup_1"), 30)]) == MATCHED


def test_matches_the_same_path_even_if_asset_and_size_differ() -> None:
    cup = item("/Room/Cup_1")
    changed = put(replace(cup, assets=frozenset({"Mug"}), size=(0.2, 0.2, 0.2)), 9)
    assert counts([cup], [changed]) == {"moved": 1, "resized": 1, "other asset": 1}


def test_does_not_match_the_same_path_if_asset_size_and_class_differ() -> None:
    cup, table = item("/Room/Cup"), item("/Room/Table", (2, 0, 0), (2, 1, 0.7))
    assert new_paths([cup], [rename(table, "/Room/Cup"), rename(cup, "/Room/Mug")]) == {"/Room/Cup": "/Room/Mug"}


def test_equal_objects_that_exchange_places_have_moved() -> None:
    one, other = item("/Room/Cup_1", (0, 0, 0)), item("/Room/Cup_2", (1, 0, 0))
    assert counts([one, other], [put(one, 1), put(other, 0)]) == {"moved": 2}


def test_matches_all_objects_below_a_renamed_group() -> None:
    def room(name: str, shift: float) -> list[ObjectState]:
        racks = [item(f"/House/{name}/Rack_{i}/Cup", (i, shift, 0)) for i in range(9)]
        return [*racks, item(f"/House/{name}/Lamp", (0, shift, 2)), item(f"/House/{name}/Sofa", (3, shift, 0))]

    changes = compare_objects(room("Room", 0), room("Kitchen", 0.5))
    assert {by for _, _, by in pairs(changes)} == {"group"}
    assert nonzero_counts(changes) == {"renamed": 11, "moved": 11}
    # The racks are 1 m apart: by place alone, each cup would match its neighbour.
    shifted = [put(cup, cup.center[0] + 1) if cup.name == "Cup" else cup for cup in room("Kitchen", 0)]
    found = new_paths(room("Room", 0), shifted)
    assert all(after == before.replace("Room", "Kitchen") for before, after in found.items())


def test_path_decides_among_equal_objects() -> None:
    old = chairs(20, 5)
    places = [chair.center for chair in old]
    random.Random(3).shuffle(places)
    shuffled = [put(chair, *place) for chair, place in zip(old, places, strict=True)]
    changes = compare_objects(old, shuffled[:-1])
    moved = sum(a.center != b.center for a, b in zip(old[:-1], shuffled[:-1], strict=True))
    assert nonzero_counts(changes) == {"removed": 1, "moved": moved}
    assert changes.removed[0].prim_path == "/Hall/Chair_19"


def test_place_decides_among_equal_renamed_objects() -> None:
    old = chairs(20, 5)
    names = list(range(19))
    random.Random(4).shuffle(names)
    renamed = [rename(chair, f"/Hall/Seat_{name}") for chair, name in zip(old[:19], names, strict=True)]
    changes = compare_objects(old, renamed)
    assert nonzero_counts(changes) == {"removed": 1, "renamed": 19}
    assert changes.removed[0].prim_path == "/Hall/Chair_19"


def test_nearest_candidate_wins() -> None:
    old = chairs(2, 2)
    new = [rename(put(old[0], 1.2), "/Hall/a"), rename(put(old[1], 0.1), "/Hall/b")]
    assert new_paths(old, new) == {"/Hall/Chair_0": "/Hall/b", "/Hall/Chair_1": "/Hall/a"}


def test_class_decides_in_the_same_place() -> None:
    old = [item("/a", classes=("Cup",), assets=frozenset()), item("/b", classes=("Lid",), assets=frozenset())]
    new = [rename(old[1], "/c"), rename(old[0], "/d")]
    assert new_paths(old, new) == {"/a": "/d", "/b": "/c"}


def test_matches_objects_without_geometry_only_by_asset() -> None:
    cup = item("/Room/Cup_1", size=None)
    assert new_paths([cup], [rename(cup, "/Room2/Cup_1")]) == {"/Room/Cup_1": "/Room2/Cup_1"}
    unknown = item("/Room/Cup_1", None, None, assets=frozenset())
    assert new_paths([unknown], [rename(unknown, "/Room2/Cup_1")]) == {}


@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_matches_10000_equal_renamed_objects_in_seconds(shift: float) -> None:
    old = chairs(10_000, 100)
    renamed = [rename(put(c, c.center[0] + shift, c.center[1]), f"/Hall/Seat_{i}") for i, c in enumerate(old)]
    start = time.process_time()
    found = new_paths(old, renamed)
    assert time.process_time() - start < 30
    assert found == {f"/Hall/Chair_{i}": f"/Hall/Seat_{i}" for i in range(10_000)}


def test_matches_1500_equal_objects_in_one_place_in_seconds() -> None:
    crowd = [item(f"/Bin/Screw_{i}", (0, 0, 0)) for i in range(1500)]
    start = time.process_time()
    found = new_paths(crowd, [rename(screw, f"/Box/{i}") for i, screw in enumerate(crowd)])
    assert time.process_time() - start < 20
    assert len(found) == 1500
