"""VoteCount of neighbours: classes of the objects beside a target and of its size."""

import math

import pytest

from tests.grounding.records import SOMA, ground_view, local, make_object, make_scene
from usd2kg.grounding import NamingRegime, ObjectView, view_objects
from usd2kg.grounding.context import Nearness, Neighbour
from usd2kg.grounding.lexical.neighbour_vote import Vote, VoteCount, count_votes, siblings_as_neighbours
from usd2kg.ontology import TBox
from usd2kg.scene import Box

NEXT, SIBLING, TWIN, ALIKE = Nearness.NEXT, Nearness.SIBLING, Nearness.SAME_SIZE, Nearness.SIMILAR_SIZE
ABSTENTION = 0.5
"""Weight of the case that neighbours say nothing, where one right beside the target weighs 1."""


def near(name: str, nearness: Nearness = NEXT, distance: float | None = 0.1) -> Neighbour:
    """Return a companion whose name is its class and, after a hyphen, the score of its vote: `cup-0.8`."""
    return Neighbour(name, ("Room",), nearness, distance)


def vote(*companions: Neighbour) -> VoteCount[Neighbour]:
    def voter(companion: Neighbour) -> tuple[Vote, Nearness, float | None, Neighbour]:
        iri, _, score = companion.name.partition("-")
        return Vote(iri, float(score or 1)), companion.nearness, companion.distance, companion

    return count_votes(map(voter, companions))


def ratio(one: Neighbour, other: Neighbour) -> float:
    """Return the weight of one companion's vote divided by another's."""
    shares = vote(one, other).shares
    return shares[one.name.partition("-")[0]] / shares[other.name.partition("-")[0]]


def test_without_companions_there_are_no_votes():
    assert vote() == VoteCount({}, {})


def test_shares_worked_by_hand():
    # A companion of unknown size weighs half: 0.5 · 0.8 = 0.4 for the cup, twice 0.5 for the lamp.
    found = vote(near("cup-0.8", NEXT, None), near("lamp", NEXT, None), near("lamp", NEXT, None)).shares
    assert found == pytest.approx({"cup": 0.4 / (1.4 + ABSTENTION), "lamp": 1 / (1.4 + ABSTENTION)})


def test_shares_add_up_to_less_than_one():
    few, many = vote(near("cup")).shares["cup"], vote(*[near("cup")] * 60).shares["cup"]
    assert 0 < few < many < 1
    assert sum(vote(near("cup"), near("lamp", SIBLING), near("plate", ALIKE)).shares.values()) < 1


def test_the_weight_decreases_with_distance_in_the_tree():
    shares = vote(near("a", NEXT), near("b", TWIN), near("c", SIBLING), near("d", ALIKE)).shares
    assert sorted(shares, key=lambda name: -shares[name]) == ["a", "b", "c", "d"]


def test_the_weight_is_a_gaussian_of_the_difference_in_size():
    # Standard deviation 0.2: one weighs exp(-1/2), two combine_evidence exp(-2).
    one = ratio(near("cup", NEXT, 0.4), near("lamp", NEXT, 0.2))
    assert one == pytest.approx(math.exp(-2) / math.exp(-0.5))
    assert ratio(near("cup", NEXT, 3.0), near("lamp", NEXT, 0.1)) < 1e-6


def test_an_unknown_size_counts_for_something():
    assert 0.1 < ratio(near("cup", NEXT, None), near("lamp", NEXT, 0.02)) < 1


def test_a_copy_elsewhere_outvotes_two_siblings_of_another_size():
    assert ratio(near("cup", NEXT, 0.0), near("lamp", NEXT, 0.011)) == pytest.approx(6, rel=0.01)
    found = vote(near("cup", TWIN, 0.0), near("lamp", SIBLING, 0.3), near("lamp", SIBLING, 0.3)).shares
    assert found["cup"] > found["lamp"]


def test_the_weight_is_proportional_to_the_score_of_the_name():
    assert ratio(near("cup-0.9"), near("lamp-0.6")) == pytest.approx(1.5)


def test_the_heaviest_vote_of_each_class_is_kept_for_the_explanation():
    far, beside, other = near("cup", ALIKE), near("cup-0.9", NEXT), near("lamp", SIBLING)
    heaviest = vote(far, beside, other).heaviest
    assert {iri: found[-1] for iri, found in heaviest.items()} == {"cup": beside, "lamp": other}
    assert vote(beside, far).heaviest == {"cup": (Vote("cup", 0.9), NEXT, 0.1, beside)}


def test_shares_do_not_depend_on_the_order():
    some = [near("cup"), near("lamp", SIBLING, 0.4), near("cup", ALIKE, None), near("plate", TWIN, 0.005)]
    assert vote(*some).shares == pytest.approx(vote(*reversed(some)).shares)


def test_siblings_with_names_only_vote_with_equal_weight():
    found = vote(*siblings_as_neighbours(["cup-0.8", "cup-0.8", "bowl-0.8"], ("Room",)))
    assert found.shares["cup"] == pytest.approx(2 * found.shares["bowl"])
    assert len(siblings_as_neighbours(map(str, range(1000)), ())) == 48


def test_a_nameless_object_among_chairs_of_its_size_is_a_chair(home_tbox: TBox):
    chairs = (make_object(f"/Hall/chair_{i}", box=Box((0, 0, 0), (0.5, 0.5, 0.9))) for i in range(3))
    table = make_object("/Hall/table", box=Box((0, 0, 0), (1.8, 0.9, 0.75)))
    target = make_object("/Hall/x", box=Box((0, 0, 0), (0.5, 0.5, 0.9)))
    *_, (_, view) = view_objects(make_scene(*chairs, table, target), NamingRegime.OPAQUE)
    prediction = ground_view(view, home_tbox)
    assert prediction.class_iri == SOMA + "DesignedChair"
    assert prediction.evidence == ("neighbours",)


def test_siblings_decide_where_only_the_hierarchy_is_shown(home_tbox: TBox):
    view = ObjectView(name="obj_001", parents=("Room",), siblings=["Cup_1", "Cup_2", "Plate_1"], is_masked=True)
    prediction = ground_view(view, home_tbox)
    assert local(prediction) == "Cup"
    assert prediction.evidence == ("hierarchy",)
