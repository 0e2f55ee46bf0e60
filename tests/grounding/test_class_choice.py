"""Choice of a class: copies of one asset agree, and split candidates give way to their superclass."""

import pytest

from tests.grounding.records import SOMA
from tests.kitchen import kitchen_scene
from usd2kg.grounding import NamingRegime, ObjectView, Prediction, ground
from usd2kg.grounding.lexical.class_choice import choose_superclass, reconcile_copies, superclass_confidence
from usd2kg.grounding.lexical.grounder import LexicalGrounder
from usd2kg.grounding.model import Candidate, Status
from usd2kg.ontology import TBox

CUP, BOWL, PLATE, CROCKERY, KNIFE, TABLE_KNIFE = (
    SOMA + name for name in ("Cup", "Bowl", "Plate", "Crockery", "Knife", "TableKnife")
)


def answer(path: str, iri: str, confidence: float) -> Prediction:
    candidates = (Candidate(iri, confidence),)
    return Prediction(path, iri, confidence, Status.GROUNDED, "lexical", f"it is {iri}", ("name",), candidates)


def view(name: str, asset: str = "cup_a", size: float = 0.1, *, is_masked: bool = False) -> ObjectView:
    return ObjectView(name=name, asset=(asset,) if asset else (), size=(size, size, size), is_masked=is_masked)


class TestCopiesOfOneAsset:
    def test_a_copy_with_low_confidence_follows_the_others(self, home_tbox: TBox) -> None:
        views = [view("cup_1"), view("cup_2"), view("obj_7")]
        answers = [answer("/a", CUP, 0.9), answer("/b", CUP, 0.8), answer("/c", BOWL, 0.3)]
        agreed = reconcile_copies(views, answers, home_tbox)
        assert agreed[:2] == answers[:2]
        assert (agreed[2].prim_path, agreed[2].class_iri, agreed[2].evidence) == ("/c", CUP, ("asset",))
        assert agreed[2].explanation.startswith("it is a copy of “cup_1”, of the same asset and size: ")

    def test_one_confident_outlier_does_not_overrule_many_copies(self, home_tbox: TBox) -> None:
        views = [view(f"cup_{number}") for number in range(4)]
        answers = [answer("/a", BOWL, 0.95), *(answer(f"/{number}", CUP, 0.6) for number in range(3))]
        agreed = reconcile_copies(views, answers, home_tbox)
        assert [prediction.class_iri for prediction in agreed] == [CUP] * 4

    def test_without_a_clear_majority_nothing_changes(self, home_tbox: TBox) -> None:
        answers = [answer("/a", BOWL, 0.8), answer("/b", CUP, 0.9)]
        assert reconcile_copies([view("x"), view("y")], answers, home_tbox) == answers

    def test_a_more_special_class_stays(self, home_tbox: TBox) -> None:
        views = [view("knife_1"), view("knife_2"), view("steak_knife")]
        answers = [answer("/a", KNIFE, 0.9), answer("/b", KNIFE, 0.9), answer("/c", TABLE_KNIFE, 0.9)]
        assert reconcile_copies(views, answers, home_tbox) == answers

    @pytest.mark.parametrize(
        "other", [view("obj_7", "bowl_b"), view("obj_7", ""), view("obj_7", size=0.2), view("obj_7", is_masked=True)]
    )
    def test_other_assets_sizes_and_masked_targets_do_not_count_as_copies(
        self, home_tbox: TBox, other: ObjectView
    ) -> None:
        answers = [answer("/a", CUP, 0.9), answer("/b", BOWL, 0.2)]
        assert reconcile_copies([view("cup_1"), other], answers, home_tbox) == answers


class TestAbstaining:
    def test_split_candidates_give_their_superclass(self, home_tbox: TBox) -> None:
        # Of two leaves, guessing one scores more than their superclass: it is exactly right in half of the cases.
        assert choose_superclass({CUP: 0.5, BOWL: 0.5}, home_tbox) in {CUP, BOWL}
        assert choose_superclass({CUP: 0.5, BOWL: 0.5, PLATE: 0.5}, home_tbox) == CROCKERY

    def test_a_clear_candidate_stays(self, home_tbox: TBox) -> None:
        assert choose_superclass({CUP: 0.9, BOWL: 0.1}, home_tbox) == CUP
        assert choose_superclass({CUP: 0.4}, home_tbox) == CUP

    def test_expected_f1_worked_by_hand(self, home_tbox: TBox) -> None:
        # P(Cup) = 0.64 / 0.80 = 0.8. With n classes in the closure of Crockery and one more in those of Cup and Bowl:
        # F1(Cup, Bowl) = n / (n + 1) and F1(Crockery, Cup) = 2 n / (2 n + 1).
        n = len(home_tbox.closure(CROCKERY))
        cup, crockery = 0.8 + 0.2 * n / (n + 1), 2 * n / (2 * n + 1)
        assert choose_superclass({CUP: 0.8, BOWL: 0.4}, home_tbox) == (CUP if cup > crockery else CROCKERY)

    def test_confidence_of_a_superclass_worked_by_hand(self, home_tbox: TBox) -> None:
        # P(Cup) = P(Bowl) = P(Knife) = 1/3. Cup has 0.4, so the others have 0.6 / 3 each, and Knife is not crockery.
        scores = {CUP: 0.5, BOWL: 0.5, KNIFE: 0.5}
        assert superclass_confidence(CROCKERY, CUP, 0.4, scores, home_tbox) == pytest.approx(0.6)
        assert superclass_confidence(KNIFE, CUP, 0.4, scores, home_tbox) == pytest.approx(0.2)
        assert superclass_confidence(CROCKERY, CUP, 0.9, {CUP: 0.9}, home_tbox) == pytest.approx(0.9)

    def test_no_superclass_in_the_demo_kitchen_is_less_probable_than_the_class_it_replaces(
        self, home_tbox: TBox
    ) -> None:
        # With their names masked, since clear names leave no doubt.
        scene, regime = kitchen_scene(), NamingRegime.OPAQUE
        leaves = ground(scene, home_tbox, LexicalGrounder(), regime=regime).by_path
        abstained = ground(scene, home_tbox, LexicalGrounder(abstains=True), regime=regime).predictions
        pairs = [(leaves[one.prim_path], one) for one in abstained]
        changed = [
            (leaf, one)
            for leaf, one in pairs
            if str(one.class_iri) in home_tbox.closure(str(leaf.class_iri)) - {leaf.class_iri}
        ]
        assert len(changed) > 1
        for leaf, one in changed:
            assert (one.confidence or 0.0) >= (leaf.confidence or 0.0), one.prim_path

    def test_the_decision_is_a_recorded_setting(self, home_tbox: TBox) -> None:
        grounder = LexicalGrounder(abstains=True)
        assert grounder.settings["decision"] == "hierarchical"
        (clear,) = grounder.ground_views([("/a", ObjectView(name="Cup_1"))], home_tbox)
        assert (clear.class_iri, clear.status) == (CUP, Status.GROUNDED)
