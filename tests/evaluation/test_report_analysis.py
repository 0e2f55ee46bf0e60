"""What right and wrong answers have in common."""

import pytest

from tests.evaluation.test_report_records import FIRST, NS, SECOND, tbox, tiny
from usd2kg.evaluation.metrics.intervals import McNemar
from usd2kg.evaluation.report.analysis import (
    agreed_objects,
    compare_methods,
    ema_by_name_quality,
    head_word,
    hierarchy_order,
    methods_of,
    name_counts,
    names_its_class,
    runs_of,
    scores_under,
    size_distinctive,
)

DESK, CUP = {"/W/Desk_1": ("Table", 0.5)}, {"/W/Cup_1": ("Cup", 0.5)}


def test_runs_are_grouped_by_method_and_condition_with_their_repeats():
    result = tiny(repeats=(SECOND,))
    runs = runs_of(result)
    assert [(key, len(cells)) for key, cells in runs.items()] == [
        (("first", "semantic"), 2),
        (("second", "semantic"), 1),
    ]
    assert methods_of(result) == ("first", "second")


def test_the_first_repeat_is_analysed():
    assert sum(score.is_exact for score in scores_under(tiny(repeats=(SECOND,)), "semantic")["first"]) == 2
    assert scores_under(tiny(), "opaque") == {}


class TestAgreedObjects:
    def test_right_and_wrong_by_all(self):
        agreed = agreed_objects(scores_under(tiny(), "semantic"))
        assert [score.id for score in agreed.right] == ["/W/Cup_1"]
        assert [score.id for score in agreed.wrong] == ["/W/Cup_2", "/W/Bowl_1"]

    def test_no_method_agrees_on_nothing(self):
        assert agreed_objects({}) == ((), ())

    def test_copies_are_counted_under_one_name(self):
        scores = scores_under(tiny(), "semantic")["first"]
        assert name_counts(scores) == (("cup", 2), ("bowl", 1), ("desk", 1))


class TestSizeDistinctive:
    def test_right_by_geometry_alone(self):
        found = size_distinctive(tiny({("first", "geometry only"): DESK}))
        assert [score.id for score in found.found] == ["/W/Desk_1"]
        assert found.by_default == 0

    def test_what_is_right_without_evidence_owes_nothing_to_its_size(self):
        runs = {("first", "geometry only"): DESK | CUP, ("first", "hierarchy only, anonymised"): CUP}
        found = size_distinctive(tiny(runs))
        assert [score.id for score in found.found] == ["/W/Desk_1"]
        assert found.by_default == 1

    def test_another_methods_standing_answer_does_not_count(self):
        runs = {("first", "geometry only"): CUP, ("second", "hierarchy only, anonymised"): CUP}
        assert size_distinctive(tiny(runs)).by_default == 0

    def test_the_volume_method_under_opaque_names_counts(self):
        assert [s.id for s in size_distinctive(tiny({("volume", "opaque"): DESK})).found] == ["/W/Desk_1"]

    def test_other_methods_under_opaque_names_do_not(self):
        assert size_distinctive(tiny({("first", "opaque"): DESK})).found == ()


class TestQualityOfNames:
    @pytest.mark.parametrize(
        ("iri", "word"),
        [("#Cup", "cup"), ("#DesignedContainer", "container"), ("http://x/TVSet", "set"), ("#A_1", "a_1")],
    )
    def test_the_head_word_is_the_last(self, iri: str, word: str):
        assert head_word(iri) == word

    @pytest.mark.parametrize(
        ("name", "iri", "does"),
        [
            ("SM_CupCBlue_01", "#Cup", True),
            ("storage_container", "#DesignedContainer", True),
            ("FlowerPot", "#DesignedContainer", False),
            ("Cupboard", "#Cup", False),  # a near miss: words, not letters
            ("obj_042", "#Cup", False),
        ],
    )
    def test_a_name_names_its_class_by_its_head_word(self, name: str, iri: str, does: bool):
        assert names_its_class(name, iri) is does

    def test_exact_match_apart_for_good_and_bad_names(self):
        quality = ema_by_name_quality(scores_under(tiny(), "semantic")["first"])
        assert quality == (3, pytest.approx(100 / 3), 1, 100.0)

    def test_no_bad_name_has_no_exact_match(self):
        scores = [s for s in scores_under(tiny(), "semantic")["first"] if "Cup" in s.id]
        assert ema_by_name_quality(scores) == (2, 50.0, 0, None)


def test_methods_are_compared_pairwise():
    by_method = scores_under(
        tiny({("a", "semantic"): FIRST, ("b", "semantic"): SECOND, ("c", "semantic"): {}}), "semantic"
    )
    # a has two right, b one of these, c none.
    assert compare_methods(by_method) == (
        ("a", "b", McNemar(1, 0, 1.0)),
        ("a", "c", McNemar(2, 0, 0.5)),
        ("b", "c", McNemar(1, 0, 1.0)),
    )
    assert compare_methods({"a": by_method["a"]}) == ()


def test_classes_stand_below_their_superclass():
    names = [
        iri.removeprefix(NS) for iri in hierarchy_order((NS + n for n in ("Table", "Cup", "Bowl", "Artifact")), tbox())
    ]
    assert names == ["Artifact", "Bowl", "Cup", "Table"]


def test_a_class_with_two_parents_stands_once():
    two = {"Artifact": None, "Container": "Artifact", "Cup": "Container"}
    order = hierarchy_order([NS + name for name in two], tbox(two))
    assert len(order) == 3
