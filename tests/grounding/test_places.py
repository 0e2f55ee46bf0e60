"""Places and stances of things: the table, and probabilities worked by hand."""

import math

import numpy as np
import pytest

from usd2kg.grounding.context import Appearance
from usd2kg.grounding.lexical.concepts.places import (
    PLACES,
    log_place_likelihoods_of_appearance,
    log_place_likelihoods_of_noun,
    log_stance_likelihoods,
    noun_priors,
    place_probabilities,
    places_named,
    stance_of,
)
from usd2kg.grounding.lexical.concepts.sizes import everyday_nouns, everyday_object_row, everyday_object_rows

NOWHERE = np.zeros(len(PLACES))
"""Log likelihoods of an object that is found anywhere."""


def row(noun: str) -> int:
    found = everyday_object_row(noun.replace(" ", ""))
    assert found is not None
    return found


def stance(noun: str, **known) -> float:
    look = Appearance(**({"size": (0.3, 0.2, 0.1), "height": None, "elevation": None, "is_nested": False} | known))
    return float(log_stance_likelihoods(stance_of(look))[row(noun)])


def test_each_row_has_places_stances_and_upright_extents():
    for found in everyday_object_rows():
        counts = dict(part.split("=") for part in found["places"].split())
        assert counts and set(counts) <= set(PLACES), found
        assert all(0 < float(count) <= 500 for count in counts.values()), found
        stands, up = found["stands"].split(), found["up"]
        assert 0 < len(stands) <= 3 and len(set(stands)) == len(stands), found
        assert set(stands) <= {"floor", "surface", "wall", "ceiling", "part"}, found
        assert up and len(set(up)) == len(up) and set(up) <= set("lms"), found


def test_shares_of_things_add_up_to_one_in_each_place():
    for at in range(len(PLACES)):
        assert noun_priors(np.eye(len(PLACES))[at]).sum() == pytest.approx(1)


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
def test_names_of_parents_name_places(names, places):
    assert list(places_named(tuple(names))) == places


def test_without_evidence_all_places_are_equally_likely():
    assert place_probabilities(NOWHERE) == pytest.approx(np.full(len(PLACES), 1 / len(PLACES)))


def test_a_named_place_is_ten_times_likelier():
    shares = dict(zip(PLACES, place_probabilities(NOWHERE, ["office"]), strict=True))
    assert shares["office"] / shares["kitchen"] == pytest.approx(10)


def test_place_of_a_thing_worked_by_hand():
    # P(toilet bowl | place) from the counts of the table, each with a pseudo-count of 0.003; a tenth of all things are
    # found anywhere.
    counts = np.full((len(everyday_nouns()), len(PLACES)), 0.003)
    for at, found in enumerate(everyday_object_rows()):
        for part in found["places"].split():
            place, count = part.split("=")
            counts[at, PLACES.index(place)] += float(count)
    share = counts[row("toilet bowl")] / counts.sum(axis=0)
    bathroom = PLACES.index("bathroom")
    logs = log_place_likelihoods_of_noun(row("toilet bowl"))
    assert logs[bathroom] == pytest.approx(math.log(0.9 * share[bathroom] / share.sum() * len(PLACES) + 0.1))
    assert int(logs.argmax()) == bathroom


def test_place_of_a_nameless_thing_is_that_of_things_with_its_look():
    logs = np.full(len(everyday_nouns()), -40.0)
    logs[row("toilet bowl")] = 0.0
    sure = log_place_likelihoods_of_appearance(logs)
    assert PLACES[int(sure.argmax())] == "bathroom"
    # An uninformative look leaves all places equally likely.
    assert log_place_likelihoods_of_appearance(np.zeros(len(everyday_nouns()))) == pytest.approx(NOWHERE, abs=1e-9)
    # A look rules no place out.
    assert sure.min() >= math.log(0.3) - 1e-9


def test_shares_of_things_are_a_mixture_over_places():
    kitchen, bath = np.zeros(len(PLACES)), np.zeros(len(PLACES))
    kitchen[PLACES.index("kitchen")] = bath[PLACES.index("bathroom")] = 1.0
    assert noun_priors(kitchen)[row("frying pan")] > 20 * noun_priors(bath)[row("frying pan")]
    assert noun_priors((kitchen + bath) / 2) == pytest.approx((noun_priors(kitchen) + noun_priors(bath)) / 2)


# --- stances -----------------------------------------------------------------------------------------


def test_elevation_worked_by_hand():
    # A rug has the stance `floor` alone: weight 0.67, and 0.02 for each of surface, wall, ceiling and part.
    assert everyday_object_rows()[row("rug")]["stands"] == "floor"
    # Shares of the lowest and of the highest range of elevation, in the same order of stances.
    lowest = 0.67 * 0.80 + 0.02 * (0.06 + 0.06 + 0.01 + 0.15)
    highest = 0.67 * 0.02 + 0.02 * (0.07 + 0.20 + 0.80 + 0.08)
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
def test_usual_elevations_are_likelier(noun, rather, than):
    assert stance(noun, elevation=rather) > stance(noun, elevation=than) + 1


def test_the_upright_extent_counts():
    # A door is 2 m high; a plate lies.
    assert stance("door", size=(2.0, 0.9, 0.04), height=2.0) > stance("door", size=(2.0, 0.9, 0.04), height=0.04) + 2
    assert stance("plate", size=(0.27, 0.27, 0.03), height=0.03) > stance("plate", size=(0.27, 0.27, 0.03), height=0.27)
    # A cube shows nothing of it.
    upright = [stance("door", size=(1.0, 1.0, 1.0), height=1.0), stance("door", size=(1.0, 1.0, 1.0))]
    assert upright[0] == pytest.approx(upright[1])


def test_equal_horizontal_extents_count_for_round_things():
    # 0.75 of the things that the table has with equal extents, such as plates, measure so; 0.07 of breadboards do.
    plate = stance("dinner plate", size=(0.27, 0.27, 0.03)) - stance("dinner plate", size=(0.35, 0.25, 0.02))
    assert plate == pytest.approx(math.log(0.75 / 0.25))
    board = stance("breadboard", size=(0.27, 0.27, 0.03)) - stance("breadboard", size=(0.35, 0.25, 0.02))
    assert board == pytest.approx(math.log(0.07 / 0.93))


def test_parts_are_likelier_below_other_objects():
    assert stance("drawer", is_nested=True) > stance("drawer", is_nested=False)
    assert stance("sofa", is_nested=True) < stance("sofa", is_nested=False)


def test_extreme_looks_have_finite_likelihoods():
    for look in (
        Appearance((0, 0, 0), 0, 0, False),
        Appearance((90, 80, 0), 0, 1e6, True),
        Appearance((1, 1, 1), 1, -0.0, False),
    ):
        assert np.isfinite(log_stance_likelihoods(stance_of(look))).all()
