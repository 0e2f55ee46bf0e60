"""What an object is by its size, stance and place alone."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.grounding.ontologies import parse_outline
from tests.grounding.records import ground_view, local, make_object, make_scene
from usd2kg.grounding import NamingRegime, ObjectView, view_objects
from usd2kg.grounding.context import Appearance
from usd2kg.grounding.lexical.class_posterior import (
    ClassPosterior,
    PosteriorModel,
    log_likelihoods_of_appearance,
    match_everyday_nouns,
    neighbour_weights,
)
from usd2kg.grounding.lexical.concepts.places import PLACES, log_stance_likelihoods, place_probabilities, stance_of
from usd2kg.grounding.lexical.concepts.sizes import size_log_likelihoods
from usd2kg.grounding.lexical.matching.head_matching import Match
from usd2kg.ontology import TBox
from usd2kg.scene import Box

ANYWHERE = np.full(len(PLACES), 1 / len(PLACES))
CLASSES = {"mug": "small", "glass": "small", "refrigerator": "large", "wardrobe": "large", "plate": "flat"}


def classify(noun: str, parents: tuple[str, ...]) -> list[Match]:
    return [Match(CLASSES[noun], 1, str)] if noun in CLASSES else []


MODEL = PosteriorModel(match_everyday_nouns(classify))


def ask(look: Appearance, places: np.ndarray) -> ClassPosterior:
    return MODEL.posterior(log_likelihoods_of_appearance(look), places)


def place(name: str) -> np.ndarray:
    return np.array([float(found == name) for found in PLACES])


def nameless(place: str, size: tuple[float, float, float], elevation: float) -> ObjectView:
    """Return the view of an object with a masked name at a height above the floor."""
    x, y, z = size
    floor = make_object("/World/pCube1", box=Box((-3, -3, -0.1), (3, 3, 0)))
    target = make_object(f"/World/{place}/x", box=Box((0, 0, elevation), (x, y, elevation + z)))
    _, (_, view) = view_objects(make_scene(floor, target), NamingRegime.OPAQUE)
    return view


@pytest.mark.parametrize(
    ("where", "size", "elevation", "expected"),
    [
        ("Kitchen", (0.6, 0.65, 1.8), 0.0, "Refrigerator"),
        ("Kitchen", (0.6, 0.6, 0.85), 0.0, "Dishwasher"),
        ("DiningRoom", (0.27, 0.27, 0.025), 0.76, "DinnerPlate"),
        ("Hall", (0.9, 0.04, 2.05), 0.0, "Door"),
        ("LivingRoom", (2.2, 0.9, 0.85), 0.0, "Sofa"),
        ("LivingRoom", (0.3, 0.3, 0.09), 0.75, "Bowl"),
    ],
)
def test_typical_objects_are_among_the_three_likeliest_classes(
    home_tbox: TBox, where: str, size: tuple[float, float, float], elevation: float, expected: str
):
    prediction = ground_view(nameless(where, size, elevation), home_tbox)
    assert prediction.evidence == ("geometry",)
    assert expected in [home_tbox.by_iri[found.class_iri].local_name for found in prediction.candidates[:3]]


@settings(deadline=None)
@given(
    size=st.tuples(*[st.floats(0, 60)] * 3),
    height=st.none() | st.floats(0, 60),
    elevation=st.none() | st.floats(0, 40),
    is_nested=st.booleans(),
    kind=st.sampled_from(PLACES),
)
def test_probabilities_of_any_look_are_ranked_and_add_up_to_one(size, height, elevation, is_nested, kind):
    found = ask(Appearance(size, height, elevation, is_nested), place(kind)).ranked()
    assert set(found) == {"small", "large", "flat"}
    assert sum(found.values()) == pytest.approx(1)
    assert list(found.values()) == sorted(found.values(), reverse=True)


def test_size_decides_between_classes():
    cup, cold = (Appearance(size, size[2], 0.0, False) for size in ((0.09, 0.09, 0.1), (0.6, 0.65, 1.8)))
    assert ask(cup, place("kitchen")).ranked()["small"] > 0.9
    assert ask(cold, place("kitchen")).ranked()["large"] > 0.99


def test_without_a_height_the_order_of_the_extents_makes_no_difference():
    one, other = (Appearance(size, None, None, False) for size in ((0.6, 1.8, 0.65), (1.8, 0.65, 0.6)))
    assert ask(one, ANYWHERE).ranked() == ask(other, ANYWHERE).ranked()


def test_the_place_is_given_where_it_is_clear():
    look = Appearance((0.1, 0.1, 0.1), None, None, False)
    assert ask(look, place("gym")).place == "gym"
    assert ask(look, ANYWHERE).place is None
    assert ask(look, place_probabilities(np.zeros(len(PLACES)), ["kitchen", "dining"])).place is None


def test_an_ontology_without_known_objects_gives_the_general_class():
    abstract = parse_outline("Qualia\n  Zorg")
    empty = PosteriorModel(match_everyday_nouns(lambda noun, parents: []))
    look = Appearance((1, 1, 1), 1, 0, False)
    assert empty.posterior(log_likelihoods_of_appearance(look), ANYWHERE).ranked() == {}
    assert local(ground_view(nameless("Kitchen", (0.6, 0.65, 1.8), 0.0), abstract)) == "Qualia"


def test_likelihoods_of_size_and_stance_are_independent():
    look = Appearance((0.3, 0.2, 0.1), 0.1, 0.8, False)
    assert log_likelihoods_of_appearance(look) == pytest.approx(
        size_log_likelihoods(look.size) + log_stance_likelihoods(stance_of(look))
    )


def test_weights_of_neighbours_decay_exponentially_with_distance():
    assert neighbour_weights([0.0, 4.0, 8.0]) == pytest.approx([0.4, 0.4 / np.e, 0.4 / np.e**2])
