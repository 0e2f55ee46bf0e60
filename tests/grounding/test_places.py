"""Where things are found and how they stand: the table, and probabilities worked by hand."""

import math

import numpy as np
import pytest

from usd2kg.grounding.context import Look
from usd2kg.grounding.lexical.concepts import places as whereabouts
from usd2kg.grounding.lexical.concepts.places import (
    PLACES,
    log_stances,
    place_of_look,
    place_of_thing,
    place_shares,
    places_named,
    stance_of,
    thing_shares,
)
from usd2kg.grounding.lexical.concepts.sizes import thing_nouns, thing_row, thing_rows

NOWHERE = np.zeros(len(PLACES))


def row(noun: str) -> int:
    found = thing_row(noun.replace(" ", ""))
    assert found is not None
    return found


def stance(noun: str, **known) -> float:
    look = Look(**({"size": (0.3, 0.2, 0.1), "height": None, "elevation": None, "is_nested": False} | known))
    return float(log_stances(stance_of(look))[row(noun)])


# --- the table ---------------------------------------------------------------------------------------


def test_each_thing_has_places_a_stance_and_what_points_up():
    for found in thing_rows():
        counts = dict(part.split("=") for part in found["places"].split())
        assert counts and set(counts) <= set(PLACES), found
        assert all(0 < float(count) <= 500 for count in counts.values()), found
        stands, up = found["stands"].split(), found["up"]
        assert 0 < len(stands) <= 3 and len(set(stands)) == len(stands), found
        assert set(stands) <= {"floor", "surface", "wall", "ceiling", "part"}, found
        assert up and len(set(up)) == len(up) and set(up) <= set("lms"), found


def test_shares_of_how_things_stand_add_up_to_one():
    table = whereabouts._load_table()
    assert table.at_height.sum(axis=0) == pytest.approx(np.ones(len(thing_nouns())))
    assert table.turned.sum(axis=0) == pytest.approx(np.ones(len(thing_nouns())))
    assert whereabouts._shares_of_things().sum(axis=0) == pytest.approx(np.ones(len(PLACES)))


# --- places ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("names", "places"),
    [
        (["KitchenDining", "shelf_02"], ["kitchen", "dining"]),
        (["Main", "bath_room"], ["bathroom"]),
        (["Warehouse", "PackingStation"], ["warehouse", "warehouse"]),
        (["obj_017", "Group"], []),
    ],
)
def test_names_above_speak_of_places(names, places):
    assert list(places_named(tuple(names))) == places


def test_nothing_known_makes_all_places_alike():
    assert place_shares(NOWHERE) == pytest.approx(np.full(len(PLACES), 1 / len(PLACES)))


def test_a_named_place_is_ten_times_as_likely():
    shares = dict(zip(PLACES, place_shares(NOWHERE, ["office"]), strict=True))
    assert shares["office"] / shares["kitchen"] == pytest.approx(10)


def test_what_a_thing_says_of_the_place_worked_by_hand():
    # How often one comes upon a toilet bowl in each kind of place: its count in the table, or 0.003 where the table has
    # none, by those of all things there. A tenth of all things are anywhere.
    counts = np.full((len(thing_nouns()), len(PLACES)), 0.003)
    for at, found in enumerate(thing_rows()):
        for part in found["places"].split():
            place, count = part.split("=")
            counts[at, PLACES.index(place)] += float(count)
    share = counts[row("toilet bowl")] / counts.sum(axis=0)
    bathroom = PLACES.index("bathroom")
    logs = place_of_thing(row("toilet bowl"))
    assert logs[bathroom] == pytest.approx(math.log(0.9 * share[bathroom] / share.sum() * len(PLACES) + 0.1))
    assert int(logs.argmax()) == bathroom


def test_a_nameless_thing_speaks_for_the_place_of_what_looks_so():
    logs = np.full(len(thing_nouns()), -40.0)
    logs[row("toilet bowl")] = 0.0
    sure = place_of_look(logs)
    assert PLACES[int(sure.argmax())] == "bathroom"
    # What might be anything says nothing.
    assert place_of_look(np.zeros(len(thing_nouns()))) == pytest.approx(NOWHERE, abs=1e-9)
    # A look is never believed so far that one thing rules a place out.
    assert sure.min() >= math.log(0.3) - 1e-9


def test_shares_of_things_mix_those_of_the_places():
    kitchen, bath = np.zeros(len(PLACES)), np.zeros(len(PLACES))
    kitchen[PLACES.index("kitchen")] = bath[PLACES.index("bathroom")] = 1.0
    assert thing_shares(kitchen)[row("frying pan")] > 20 * thing_shares(bath)[row("frying pan")]
    assert thing_shares((kitchen + bath) / 2) == pytest.approx((thing_shares(kitchen) + thing_shares(bath)) / 2)


# --- stances -----------------------------------------------------------------------------------------


def test_elevation_worked_by_hand():
    # A rug has `floor` alone: shares 0.65 and 0.02 for each of the other four ways, of 0.75 in all.
    assert thing_rows()[row("rug")]["stands"] == "floor"
    ways = {"floor": 0.67, "surface": 0.02, "wall": 0.02, "ceiling": 0.02, "part": 0.02}
    lowest = sum(share * whereabouts._AT_HEIGHT[way][0] for way, share in ways.items()) / 0.75
    highest = sum(share * whereabouts._AT_HEIGHT[way][5] for way, share in ways.items()) / 0.75
    difference = stance("rug", elevation=0.0) - stance("rug", elevation=2.4)
    assert difference == pytest.approx(math.log(lowest / highest))


@pytest.mark.parametrize(
    ("noun", "rather", "than"),
    [
        ("ceiling light", 2.4, 0.0),
        ("painting", 1.5, 0.0),
        ("plate", 0.75, 0.0),
        ("sofa", 0.0, 1.0),
        ("chandelier", 2.1, 0.8),
    ],
)
def test_things_stand_where_they_usually_do(noun, rather, than):
    assert stance(noun, elevation=rather) > stance(noun, elevation=than) + 1


def test_the_extent_that_points_up():
    # A door is 2 m high; a plate lies.
    assert stance("door", size=(2.0, 0.9, 0.04), height=2.0) > stance("door", size=(2.0, 0.9, 0.04), height=0.04) + 2
    assert stance("plate", size=(0.27, 0.27, 0.03), height=0.03) > stance("plate", size=(0.27, 0.27, 0.03), height=0.27)
    # Of a cube any may be the one.
    upright = [stance("door", size=(1.0, 1.0, 1.0), height=1.0), stance("door", size=(1.0, 1.0, 1.0))]
    assert upright[0] == pytest.approx(upright[1])


def test_a_round_thing_stays_round():
    # The table has a plate as wide as long: 0.75 of the plates are, 0.07 of the breadboards.
    plate = stance("dinner plate", size=(0.27, 0.27, 0.03)) - stance("dinner plate", size=(0.35, 0.25, 0.02))
    assert plate == pytest.approx(math.log(0.75 / 0.25))
    board = stance("breadboard", size=(0.27, 0.27, 0.03)) - stance("breadboard", size=(0.35, 0.25, 0.02))
    assert board == pytest.approx(math.log(0.07 / 0.93))


def test_parts_are_below_other_objects():
    assert stance("drawer", is_nested=True) > stance("drawer", is_nested=False)
    assert stance("sofa", is_nested=True) < stance("sofa", is_nested=False)


def test_flat_things_and_the_highest_are_finite():
    for look in (Look((0, 0, 0), 0, 0, False), Look((90, 80, 0), 0, 1e6, True), Look((1, 1, 1), 1, -0.0, False)):
        assert np.isfinite(log_stances(stance_of(look))).all()
