"""What things are believed to be by their look and place alone."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.grounding.records import make_class, make_tbox
from usd2kg.grounding.context import Look
from usd2kg.grounding.lexical.alignment.naming import Match
from usd2kg.grounding.lexical.concepts.object_likelihoods import (
    Beliefs,
    ThingBeliefs,
    log_likelihoods_of_look,
    neighbour_weights,
)
from usd2kg.grounding.lexical.concepts.places import PLACES, log_stances, place_shares, stance_of
from usd2kg.grounding.lexical.concepts.sizes import Size, likelihoods_of
from usd2kg.grounding.lexical.grounder import _run_for
from usd2kg.ontology import TBox

ANYWHERE = np.full(len(PLACES), 1 / len(PLACES))


def asked(beliefs: ThingBeliefs, look: Look, places: np.ndarray) -> Beliefs:
    return beliefs.ask(log_likelihoods_of_look(look), places)


def place(name: str) -> np.ndarray:
    return np.array([float(found == name) for found in PLACES])


@pytest.fixture(scope="module")
def beliefs(home_tbox: TBox) -> ThingBeliefs:
    return _run_for(home_tbox, True)._beliefs


def ranked(beliefs: ThingBeliefs, look: Look, places: np.ndarray = ANYWHERE) -> list[str]:
    return [iri.rpartition("#")[2] for iri in asked(beliefs, look, places).ranked()]


@pytest.mark.parametrize(
    ("look", "where", "best"),
    [
        (Look((0.6, 0.65, 1.8), 1.8, 0.0, False), "kitchen", "Refrigerator"),
        (Look((0.6, 0.6, 0.85), 0.85, 0.0, False), "kitchen", "Dishwasher"),
        (Look((0.27, 0.27, 0.025), 0.025, 0.76, False), "dining", "DinnerPlate"),
        (Look((0.9, 0.04, 2.05), 2.05, 0.0, False), "hall", "Door"),
        (Look((2.2, 0.9, 0.85), 0.85, 0.0, False), "living", "Sofa"),
    ],
    ids=["refrigerator", "dishwasher", "plate", "door", "sofa"],
)
def test_a_look_and_a_place_speak_for_what_is_usually_so(beliefs: ThingBeliefs, look: Look, where: str, best: str):
    assert best in ranked(beliefs, look, place(where))[:2]


def test_the_same_box_is_something_else_elsewhere(beliefs: ThingBeliefs):
    flat = (0.3, 0.3, 0.09)
    on_table, on_ceiling = (ranked(beliefs, Look(flat, 0.09, up, False), place("living"))[0] for up in (0.75, 2.6))
    assert on_table in {"Bowl", "SaladBowl"}
    assert on_ceiling == "Appliance"


@given(
    size=st.tuples(*[st.floats(0, 60)] * 3),
    height=st.none() | st.floats(0, 60),
    elevation=st.none() | st.floats(0, 40),
    is_nested=st.booleans(),
    kind=st.sampled_from(PLACES),
)
def test_beliefs_are_shares_in_order(beliefs, size, height, elevation, is_nested, kind):
    found = asked(beliefs, Look(size, height, elevation, is_nested), place(kind)).ranked()
    assert set(found) == set(beliefs.classes)
    assert sum(found.values()) == pytest.approx(1)
    assert list(found.values()) == sorted(found.values(), reverse=True)


def test_the_way_a_thing_lies_makes_no_difference_where_nobody_knows_it(beliefs: ThingBeliefs):
    one, other = (Look(size, None, None, False) for size in ((0.6, 1.8, 0.65), (1.8, 0.65, 0.6)))
    assert asked(beliefs, one, ANYWHERE).ranked() == asked(beliefs, other, ANYWHERE).ranked()


def test_a_place_is_told_where_it_is_clear(beliefs: ThingBeliefs):
    look = Look((0.1, 0.1, 0.1), None, None, False)
    assert asked(beliefs, look, place("gym")).place == "gym"
    assert asked(beliefs, look, ANYWHERE).place is None
    assert asked(beliefs, look, place_shares(np.zeros(len(PLACES)), ["kitchen", "dining"])).place is None


def test_the_classes_are_those_of_the_tbox(beliefs: ThingBeliefs, home_tbox: TBox):
    assert set(beliefs.classes) <= set(home_tbox.by_iri)
    assert len(beliefs.classes) > 50
    assert list(beliefs.classes) == sorted(set(beliefs.classes))


def test_a_tbox_of_other_things_has_no_beliefs():
    # Nothing whose size is known is one of its classes.
    abstract = _run_for(make_tbox(make_class("Qualia"), make_class("Zorg", "Qualia")), False)._beliefs
    assert abstract.classes == {}
    assert asked(abstract, Look((1, 1, 1), 1, 0, False), ANYWHERE).ranked() == {}


def test_beliefs_follow_the_names_that_the_nouns_match():
    # A TBox with two classes: everything is a Small thing by its name, or a Large one.
    def classify(noun: str, parents: tuple[str, ...], size: Size | None) -> list[Match]:
        return {"mug": [Match("small", 1, str)], "refrigerator": [Match("large", 1, str)]}.get(noun, [])

    beliefs = ThingBeliefs(classify)
    assert list(beliefs.classes) == ["large", "small"]
    cup, cold = (Look(size, size[2], 0.0, False) for size in ((0.09, 0.09, 0.1), (0.6, 0.65, 1.8)))
    assert asked(beliefs, cup, place("kitchen")).ranked()["small"] > 0.9
    assert asked(beliefs, cold, place("kitchen")).ranked()["large"] > 0.99


def test_evidence_of_a_look_adds_up():
    look = Look((0.3, 0.2, 0.1), 0.1, 0.8, False)
    assert log_likelihoods_of_look(look) == pytest.approx(likelihoods_of(look.size) + log_stances(stance_of(look)))


def test_neighbours_count_less_the_farther_they_are():
    assert neighbour_weights([0.0, 4.0, 8.0]) == pytest.approx([0.4, 0.4 / np.e, 0.4 / np.e**2])
