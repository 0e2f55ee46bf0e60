"""Analysis of right and wrong answers across methods."""

import pytest

from tests.evaluation.report_records import FIRST, NS, SECOND, tbox, tiny
from usd2kg.evaluation.metrics.intervals import McNemar
from usd2kg.evaluation.report.analysis import (
    compare_methods,
    contains_head_noun,
    ema_by_name_quality,
    find_size_distinctive,
    find_unanimous,
    group_repeats,
    head_noun,
    list_methods,
    name_counts,
    scores_by_method,
    sort_by_hierarchy,
)

DESK, CUP = {"/W/Desk_1": ("Table", 0.5)}, {"/W/Cup_1": ("Cup", 0.5)}


def test_groups_repeats_by_method_and_condition():
    result = tiny(repeats=(SECOND,))
    runs = group_repeats(result)
    assert [(key, len(cells)) for key, cells in runs.items()] == [
        (("first", "semantic"), 2),
        (("second", "semantic"), 1),
    ]
    assert list_methods(result) == ("first", "second")


def test_analyses_the_first_repeat():
    assert sum(score.is_exact for score in scores_by_method(tiny(repeats=(SECOND,)), "semantic")["first"]) == 2
    assert scores_by_method(tiny(), "opaque") == {}


class TestUnanimousObjects:
    def test_finds_objects_right_or_wrong_for_all_methods(self):
        found = find_unanimous(scores_by_method(tiny(), "semantic"))
        assert [score.id for score in found.right] == ["/W/Cup_1"]
        assert [score.id for score in found.wrong] == ["/W/Cup_2", "/W/Bowl_1"]

    def test_no_methods_have_no_unanimous_objects(self):
        assert find_unanimous({}) == ((), ())

    def test_counts_copies_under_one_name(self):
        scores = scores_by_method(tiny(), "semantic")["first"]
        assert name_counts(scores) == (("cup", 2), ("bowl", 1), ("desk", 1))


class TestSizeDistinctive:
    def test_finds_objects_right_by_geometry_alone(self):
        found = find_size_distinctive(tiny({("first", "geometry only"): DESK}))
        assert [score.id for score in found.found] == ["/W/Desk_1"]
        assert found.by_default == 0

    def test_excludes_objects_right_without_evidence(self):
        runs = {("first", "geometry only"): DESK | CUP, ("first", "hierarchy only, anonymised"): CUP}
        found = find_size_distinctive(tiny(runs))
        assert [score.id for score in found.found] == ["/W/Desk_1"]
        assert found.by_default == 1

    def test_compares_with_the_same_method_without_evidence(self):
        runs = {("first", "geometry only"): CUP, ("second", "hierarchy only, anonymised"): CUP}
        assert find_size_distinctive(tiny(runs)).by_default == 0

    def test_includes_the_volume_method_under_opaque_names(self):
        assert [s.id for s in find_size_distinctive(tiny({("volume", "opaque"): DESK})).found] == ["/W/Desk_1"]

    def test_excludes_other_methods_under_opaque_names(self):
        assert find_size_distinctive(tiny({("first", "opaque"): DESK})).found == ()


class TestNameQuality:
    @pytest.mark.parametrize(
        ("iri", "word"),
        [("#Cup", "cup"), ("#DesignedContainer", "container"), ("http://x/TVSet", "set"), ("#A_1", "a_1")],
    )
    def test_head_noun_is_the_last_word(self, iri: str, word: str):
        assert head_noun(iri) == word

    @pytest.mark.parametrize(
        ("name", "iri", "does"),
        [
            ("SM_CupCBlue_01", "#Cup", True),
            ("storage_container", "#DesignedContainer", True),
            ("FlowerPot", "#DesignedContainer", False),
            ("Cupboard", "#Cup", False),  # words are compared, not substrings
            ("obj_042", "#Cup", False),
        ],
    )
    def test_name_contains_the_head_noun(self, name: str, iri: str, does: bool):
        assert contains_head_noun(name, iri) is does

    def test_exact_match_by_name_quality(self):
        quality = ema_by_name_quality(scores_by_method(tiny(), "semantic")["first"])
        assert quality == (3, pytest.approx(100 / 3), 1, 100.0)

    def test_exact_match_of_no_names_is_none(self):
        scores = [s for s in scores_by_method(tiny(), "semantic")["first"] if "Cup" in s.id]
        assert ema_by_name_quality(scores) == (2, 50.0, 0, None)


def test_compares_methods_pairwise():
    by_method = scores_by_method(
        tiny({("a", "semantic"): FIRST, ("b", "semantic"): SECOND, ("c", "semantic"): {}}), "semantic"
    )
    # a gets two right, b one of them, c none.
    assert compare_methods(by_method) == (
        ("a", "b", McNemar(1, 0, 1.0)),
        ("a", "c", McNemar(2, 0, 0.5)),
        ("b", "c", McNemar(1, 0, 1.0)),
    )
    assert compare_methods({"a": by_method["a"]}) == ()


def test_sorts_classes_below_their_superclasses():
    names = [
        iri.removeprefix(NS)
        for iri in sort_by_hierarchy((NS + n for n in ("Table", "Cup", "Bowl", "Artifact")), tbox())
    ]
    assert names == ["Artifact", "Bowl", "Cup", "Table"]


def test_sorting_keeps_each_class_once():
    two = {"Artifact": None, "Container": "Artifact", "Cup": "Container"}
    order = sort_by_hierarchy([NS + name for name in two], tbox(two))
    assert len(order) == 3
