"""What the company says: votes of the companions."""

import math

import pytest

from tests.grounding.records import SOMA, make_object, make_scene
from usd2kg.grounding import NamingRegime, ObjectView, view_objects
from usd2kg.grounding.context import Companion, Nearness
from usd2kg.grounding.lexical import neighbour_vote as context
from usd2kg.grounding.lexical.alignment.naming import Match
from usd2kg.grounding.lexical.concepts.object_likelihoods import Classify
from usd2kg.grounding.lexical.concepts.sizes import Size
from usd2kg.grounding.lexical.grounder import LexicalGrounder, _run_for
from usd2kg.grounding.lexical.neighbour_vote import Votes, ask_company, siblings_as_company, vote_of
from usd2kg.ontology import TBox
from usd2kg.scene import Box

NEXT, SIBLING, TWIN, ALIKE = Nearness.NEXT, Nearness.SIBLING, Nearness.TWIN, Nearness.ALIKE
REST = 0.5
"""What the company is held to say nothing with, in weights of a companion right beside."""


def near(name: str, nearness: Nearness = NEXT, distance: float | None = 0.1) -> Companion:
    return Companion(name, ("Room",), nearness, distance)


def by_first_word(name: str, parents: tuple[str, ...], size: Size | None) -> list[Match]:
    """Take `cup-0.8` for a cup with score 0.8, and give a second class that is not to be counted."""
    word, _, score = name.partition("-")
    first = Match(word, float(score or 1), str)
    return [first, Match("other", first.score / 2, str)] if word != "nothing" else []


def votes(*companions: Companion, classify: Classify = by_first_word) -> Votes[Companion]:
    told = [(vote_of(classify(found.name, found.parents, found.size)), found) for found in companions]
    return ask_company((vote, found.nearness, found.distance, found) for vote, found in told if vote is not None)


def ratio(one: Companion, other: Companion) -> float:
    """Return how much heavier the vote of one companion is than that of another."""
    shares = votes(one, other).shares
    return shares[one.name.partition("-")[0]] / shares[other.name.partition("-")[0]]


# --- votes -------------------------------------------------------------------------------------------


def test_without_companions_there_are_no_votes():
    assert votes() == Votes({}, {})


def test_shares_worked_by_hand():
    # Of unknown size a companion right beside weighs half: 0.5 · 0.8 = 0.4 for the cup, twice 0.5 for the lamp.
    found = votes(near("cup-0.8", NEXT, None), near("lamp", NEXT, None), near("lamp", NEXT, None)).shares
    assert found == pytest.approx({"cup": 0.4 / (1.4 + REST), "lamp": 1 / (1.4 + REST)})


def test_shares_leave_something_for_knowing_nothing():
    few, many = votes(near("cup")).shares["cup"], votes(*[near("cup")] * 60).shares["cup"]
    assert 0 < few < many < 1
    mixed = votes(near("cup"), near("lamp", SIBLING), near("plate", ALIKE)).shares
    assert sum(mixed.values()) < 1


def test_the_nearer_the_heavier():
    order = [NEXT, TWIN, SIBLING, ALIKE]
    shares = votes(*(near(f"{nearness.value}", nearness, 0.1) for nearness in order)).shares
    assert list(shares) == sorted(shares, key=lambda name: -shares[name]) == [nearness.value for nearness in order]
    expected = context._WEIGHTS[NEXT] / context._WEIGHTS[SIBLING]
    assert ratio(near("cup", NEXT), near("lamp", SIBLING)) == pytest.approx(expected)


def test_the_more_alike_in_size_the_heavier():
    # A Gaussian kernel: one spread off weighs e^-½ = 0.607, two weigh e^-2 = 0.135.
    spread = context._SIZE_SPREAD
    one = ratio(near("cup", NEXT, 2 * spread), near("lamp", NEXT, spread))
    assert one == pytest.approx(math.exp(-2) / math.exp(-0.5))
    assert ratio(near("cup", NEXT, 3.0), near("lamp", NEXT, 0.1)) < 1e-6
    # Of unknown size it is neither alike nor different.
    assert 0.1 < ratio(near("cup", NEXT, None), near("lamp", NEXT, 0.02)) < 1


def test_a_companion_of_exactly_the_same_size_counts_several_times():
    bonus = ratio(near("cup", NEXT, 0.0), near("lamp", NEXT, 0.011))
    assert bonus == pytest.approx(context._TWIN_BONUS, rel=0.01)
    assert bonus > 2
    # So two strangers in the family do not outvote the copy that stands elsewhere.
    found = votes(near("cup", TWIN, 0.0), near("lamp", SIBLING, 0.3), near("lamp", SIBLING, 0.3)).shares
    assert found["cup"] > found["lamp"]


def test_companions_of_unclear_names_have_no_vote():
    found = votes(near("cup-0.49"), near("nothing"), near("lamp-0.5", SIBLING))
    assert set(found.shares) == set(found.heaviest) == {"lamp"}
    assert votes(near("cup-0.49"), near("nothing")) == Votes({}, {})


def test_a_clearer_name_has_more_of_a_vote():
    assert ratio(near("cup-0.9"), near("lamp-0.6")) == pytest.approx(1.5)


def test_the_heaviest_vote_is_remembered_for_each_class():
    far, beside, other = near("cup", ALIKE), near("cup-0.9", NEXT), near("lamp", SIBLING)
    assert {iri: found[-1] for iri, found in votes(far, beside, other).heaviest.items()} == {
        "cup": beside,
        "lamp": other,
    }
    assert votes(beside, far).heaviest == {"cup": (("cup", 0.9), NEXT, 0.1, beside)}


def test_the_order_of_the_companions_makes_no_difference_to_the_shares():
    some = [near("cup"), near("lamp", SIBLING, 0.4), near("cup", ALIKE, None), near("plate", TWIN, 0.005)]
    assert votes(*some).shares == pytest.approx(votes(*reversed(some)).shares)


def test_a_chair_among_chairs_of_its_size_in_a_real_company(home_tbox: TBox):
    chairs = (make_object(f"/Hall/chair_{i}", box=Box((0, 0, 0), (0.5, 0.5, 0.9))) for i in range(3))
    table = make_object("/Hall/table", box=Box((0, 0, 0), (1.8, 0.9, 0.75)))
    target = make_object("/Hall/x", box=Box((0, 0, 0), (0.5, 0.5, 0.9)))
    *_, (_, view) = view_objects(make_scene(*chairs, table, target), NamingRegime.OPAQUE)
    assert view.company is not None
    found = votes(*view.company.companions(), classify=_run_for(home_tbox, True)._match).shares
    assert found[SOMA + "DesignedChair"] > 0.7
    assert found[SOMA + "Table"] < 0.1


def test_siblings_of_which_only_the_names_are_known_vote_alike():
    found = votes(*siblings_as_company(["cup-0.8", "cup-0.8", "bowl-0.8"], ("Room",)))
    assert found.shares["cup"] == pytest.approx(2 * found.shares["bowl"])
    assert len(siblings_as_company(map(str, range(1000)), ())) == 48


def test_hierarchy_alone_lets_the_siblings_speak(home_tbox: TBox):
    view = ObjectView(name="obj_001", parents=("Room",), siblings=["Cup_1", "Cup_2", "Plate_1"], is_masked=True)
    (answer,) = LexicalGrounder().ground_views([("/Room/x", view)], home_tbox)
    assert home_tbox.by_iri[answer.class_iri].local_name == "Cup"
    assert answer.evidence == ("hierarchy",)
