"""Report tables against values computed by hand."""

import pytest

from tests.evaluation.report_records import FIRST, GOLD, SECOND, tiny
from usd2kg.evaluation.matrix import STUDY_ABLATION
from usd2kg.evaluation.report import error_tables, result_tables
from usd2kg.evaluation.report.published import AS_PUBLISHED, published_ablation, published_main


class TestMainTable:
    def test_uses_the_studys_format(self):
        # HF1 of the first: (1 + .8 + 2/3 + 1) / 4 = .867; of the second: 1 / 4.
        table = result_tables.main_table(tiny())
        assert table.title == "Tiny (n = 4 objects, 3 distinct names): EMA % / HF1 (EMA % end to end) by naming regime"
        assert table.columns == ("method", "semantic", "abbreviated", "opaque", "opaque-anonymous")
        assert table.rows == (
            ("first", "50 / .87 (50)", "–", "–", "–"),
            ("second", "25 / .25 (25)", "–", "–", "–"),
        )

    def test_objects_that_the_selection_misses_are_wrong_end_to_end(self):
        # The first has Cup_1 and Desk_1 right; without Desk_1, one of four.
        assert result_tables.main_table(tiny(missed=("/W/Desk_1",))).rows[0][1] == "50 / .87 (25)"

    def test_formats_a_perfect_run(self):
        right = {path: (cls, 1.0) for path, cls in GOLD.items()}
        assert result_tables.main_table(tiny({("first", "opaque"): right})).rows[0][3] == "100 / 1.00 (100)"

    def test_formats_repeats_as_mean_and_deviation(self):
        # EMA 50 and 25: mean 37.5, deviation 17.7; HF1 .867 and .25: mean .558, deviation .436.
        table = result_tables.main_table(tiny(repeats=(SECOND,)))
        assert table.rows[0][1] == "38 ± 18 / .56 ± .44 (38 ± 18)"
        assert table.note == (
            "Mean ± standard deviation of 2 repeats of each language model; intervals are those of the first repeat."
        )


def test_detail_table():
    table = result_tables.detail_table(tiny(missed=("/W/Desk_1",)))
    first, second = (dict(zip(table.columns, row, strict=True)) for row in table.rows)
    assert (first["method"], first["regime"], first["EMA %"]) == ("first", "semantic", "50.0")
    assert first["EMA % end to end"] == "25.0"
    assert first["EMA % by distinct name"] == "50.0"  # cup ½, bowl 0, desk 1
    assert first["EMA % accept-also"] == "75.0"
    # Bins .9 (right), .8 (right), .6 (two wrong): (.1 + .2 + 2 × .6) / 4.
    assert first["calibration error"] == "0.375"
    # The two answers with confidence .6 enter together, so 80 % coverage takes all four.
    assert first["EMA % at 80 % coverage"] == "50.0"
    assert second["calibration error"] == "0.000"
    assert second["EMA % at 80 % coverage"] == "–"


def test_intervals_contain_the_mean():
    row = result_tables.detail_table(tiny()).rows[0]
    for cell in (row[3], row[4]):
        lower, upper = map(float, cell.split(" to "))
        assert 0 <= lower <= 50 <= upper <= 100


def test_scenes_table_omits_folders():
    assert result_tables.scenes_table([tiny()]).rows == (
        ("Tiny", "tiny.usda", "4", "3", "3 of 6", "0", "home.owl", "made up"),
    )


def test_timing_table_without_exponents():
    assert result_tables.timing_table([tiny()]).rows[0] == ("Tiny", "first", "4", "0.1", "–", "–", "–")
    assert result_tables.timing_table([tiny(seconds=0.00004)]).rows[0][3] == "0.00001"


class TestPublished:
    def test_title_names_the_source(self):
        table = result_tables.published_table()
        rows = {row[0]: row[1:] for row in table.rows}
        assert "as published, Kitchen Set with other labels (n = 125)" in table.title
        assert len(rows) == 15
        assert rows["Gemini 3 Flash B"] == ("92 / .98", "89 / .96", "48 / .79", "–")
        assert rows["Qwen 3.5-27B thinking A"] == ("94 / .98", "75 / .90", "fail", "–")
        assert rows["Multiverse"] == ("9 / .09", "0 / .00", "0 / .00", "–")

    def test_ablation_has_all_conditions_of_four_models(self):
        assert len(published_ablation()) == 4
        for figures in published_ablation().values():
            assert list(figures) == list(STUDY_ABLATION)

    def test_failed_runs_have_no_numbers(self):
        failed = published_main()["Qwen 3.5-27B thinking A"]["opaque"]
        assert (failed.ema, failed.hf1, failed.note) == (None, None, "fail")


class TestAblation:
    def test_studys_conditions_include_published_results(self):
        table = result_tables.ablation_table(tiny({("first", "hierarchy only"): FIRST}))
        assert table is not None
        assert table.columns[:3] == ("condition", "first", "Gemini 2.5 Flash B (published)")
        assert table.rows[0] == ("geometry only", "–", "17", "17", "11", "4")
        assert table.rows[1] == ("hierarchy only", "50", "28", "54", "21", "22")
        assert AS_PUBLISHED in table.note

    def test_our_conditions_have_a_separate_table(self):
        table = result_tables.own_ablation_table(tiny({("first", "name only"): SECOND}))
        assert table is not None
        assert table.rows[0] == ("name only", "25")
        assert "Gemini" not in " ".join(table.columns)

    def test_no_tables_without_an_ablation(self):
        assert result_tables.ablation_table(tiny()) is None
        assert result_tables.own_ablation_table(tiny()) is None


class TestSelection:
    def test_recall_and_precision(self):
        assert result_tables.selection_table([tiny(missed=("/W/Desk_1",))]).rows == (
            ("Tiny", "4", "0.750", "0.500", "1", "1"),
        )

    def test_no_table_if_nothing_was_missed(self):
        assert result_tables.missed_table(tiny()) is None

    @pytest.mark.parametrize(("count", "last"), [(10, "/W/9"), (11, "and 1 more"), (15, "and 5 more")])
    def test_truncates_the_list_of_missed_prims(self, count: int, last: str):
        table = result_tables.missed_table(tiny(missed=tuple(f"/W/{i}" for i in range(count))))
        assert table is not None
        assert len(table.rows) == min(count, 11)
        assert table.rows[-1] == (last,)


class TestErrors:
    def test_unanimous_objects(self):
        assert error_tables.unanimous_table(tiny()).rows == (
            ("semantic", "all right", "1", "cup"),
            ("semantic", "all wrong", "2", "bowl, cup"),
        )

    def test_truncates_long_lists_of_names(self):
        gold = {f"/W/thing{chr(97 + i // 26)}{chr(97 + i % 26)}x": "Cup" for i in range(33)}
        row = error_tables.unanimous_table(tiny({("first", "semantic"): {}}, gold=gold)).rows[1]
        assert row[2] == "33"
        assert row[3].endswith(", and 3 more")

    def test_kinds_of_misses(self):
        table = error_tables.misses_table(tiny())
        first, second = (dict(zip(table.columns, row, strict=True)) for row in table.rows)
        assert (first["right"], first["superclass collapse"], first["sibling"], first["far off"]) == (
            "2",
            "1",
            "1",
            "0",
        )
        assert (second["right"], second["unanswered"]) == ("1", "3")

    def test_classes_are_in_hierarchy_order(self):
        table = error_tables.classes_table(tiny())
        assert table.columns[2:] == ("first precision", "first recall", "second precision", "second recall")
        assert table.rows == (
            ("Container", "0", "0.00", "–", "–", "–"),
            ("Bowl", "1", "–", "0.00", "–", "0.00"),
            ("Cup", "2", "0.50", "0.50", "1.00", "0.50"),
            ("Table", "1", "1.00", "1.00", "–", "0.00"),
        )

    def test_confusions(self):
        rows = error_tables.confusions_table(tiny()).rows
        assert rows[:2] == (("first", "Bowl", "Cup", "1"), ("first", "Cup", "Container", "1"))
        assert ("second", "Table", "no answer", "1") in rows

    def test_size_distinctive_objects(self):
        result = tiny({("first", "geometry only"): {"/W/Desk_1": ("Table", 0.5)}})
        table = error_tables.size_table(result)
        assert table is not None
        assert table.rows == (("desk", "Table", "1.60 × 0.80 × 0.70"),)
        assert error_tables.size_text(result) == "Tiny: 1 of 4 objects are recognised by size alone."

    def test_no_method_limited_to_geometry(self):
        assert error_tables.size_table(tiny()) is None
        assert error_tables.size_text(tiny()) is None

    def test_name_quality(self):
        assert error_tables.name_quality_text(tiny()) == (
            "Tiny: 3 of 4 names (75 %) contain the head noun of their class; 2 of 3 distinct names."
        )
        table = error_tables.name_quality_table(tiny())
        assert table.columns[2:] == (
            "EMA % with head noun in name (n = 3)",
            "EMA % without (n = 1)",
        )
        assert table.rows == (("first", "semantic", "33.3", "100.0"), ("second", "semantic", "33.3", "0.0"))

    def test_mcnemar(self):
        table = error_tables.mcnemar_table(tiny())
        assert table is not None
        assert table.rows == (("first", "second", "1", "0", "1.0000"),)
        assert error_tables.mcnemar_table(tiny({("first", "semantic"): FIRST})) is None
