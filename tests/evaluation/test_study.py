"""The study's matrix, and its tables against values computed by hand."""

import xml.etree.ElementTree as ET
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import pytest

from tests.evaluation.report_records import FIRST, GOLD, run, tiny
from usd2kg.evaluation import CellResult, SceneResult
from usd2kg.evaluation.matrix import STUDY_ABLATION, SceneSpec
from usd2kg.evaluation.model_cost import ModelCost
from usd2kg.evaluation.report import study_tables
from usd2kg.evaluation.report.cascade_plot import plot_cascades
from usd2kg.evaluation.report.published import find_counterpart
from usd2kg.evaluation.study import find_unavailable_baselines, plan_study
from usd2kg.grounding import Status
from usd2kg.grounding.llm.answers import Defect
from usd2kg.grounding.llm.completion import Usage
from usd2kg.grounding.llm.metered_client import RunReport

SPEC = SceneSpec("Tiny", Path("/somewhere/tiny.usda"), Path("/somewhere/gold.csv"), None, "made up", False)
COST = ModelCost(4, 4, 5, 1, 1, 1, 1, 0, 1000, 50, 0, Decimal("0.25"), Decimal("0.2"), ("sha256:1", "sha256:2"))


class TestPlan:
    def test_strategies_and_baselines_run_under_all_regimes(self):
        cells = [*plan_study(SPEC, "openai:m").cells()]
        by_method = {}
        for cell in cells:
            by_method.setdefault(cell.grounder, []).append(cell.condition)
        regimes = ["semantic", "abbreviated", "opaque", "opaque-anonymous"]
        ablated = [*regimes, *STUDY_ABLATION]
        assert by_method == {
            "dictionary": regimes,
            "volume": regimes,
            "embedding": regimes,
            "lexical": ablated,
            "llm-A:openai:m": regimes,
            "llm-B:openai:m": ablated,
            "llm-C:openai:m": regimes,
        }

    def test_without_a_model_the_offline_methods_run(self):
        plan = plan_study(SPEC, None, without=frozenset({"embedding"}))
        assert plan.grounders == ("dictionary", "volume", "lexical")
        assert plan.language_models == ()

    def test_all_baselines_are_available_here(self):
        assert find_unavailable_baselines() == {}


class TestCounterpart:
    @pytest.mark.parametrize(
        ("grounder", "is_thinking", "name"),
        [
            ("dictionary", False, "Multiverse"),
            ("volume", False, "LV-NN"),
            ("embedding", False, "S-BERT"),
            ("llm-A:google:gemini-2.5-flash", False, "Gemini 2.5 Flash A"),
            ("llm-C:openai:google/gemini-3-flash-preview@https://router.example/v1", False, "Gemini 3 Flash C"),
            ("llm-B:openai:Qwen3.5-27B@http://localhost:8000/v1", False, "Qwen 3.5-27B instruct B"),
            ("llm-B:openai:Qwen/Qwen3.5-27B@http://localhost:8000/v1", True, "Qwen 3.5-27B thinking B"),
            ("llm:google:gemini-2.5-flash", False, "Gemini 2.5 Flash B"),
        ],
    )
    def test_methods_of_the_study(self, grounder: str, is_thinking: bool, name: str):
        assert find_counterpart(grounder, is_thinking=is_thinking) == ((name,), True)

    @pytest.mark.parametrize("grounder", ["llm-B:google:gemini-2.5-flash-lite", "llm-B:openai:another"])
    def test_other_models_are_compared_with_all_of_the_strategy(self, grounder: str):
        found = find_counterpart(grounder, is_thinking=False)
        assert found is not None
        assert (len(found.methods), found.is_same) == (4, False)

    @pytest.mark.parametrize("grounder", ["lexical", "llm-auto:openai:m", "llm-concept:openai:m"])
    def test_none_for_methods_that_the_study_lacks(self, grounder: str):
        assert find_counterpart(grounder, is_thinking=False) is None


def results(*cells: CellResult) -> SceneResult:
    return replace(tiny(), cells=cells)


def cell(method: str, condition: str, *, failed: bool = False, **more: object) -> CellResult:
    whole = tiny()
    done = run(SPEC, method, condition, FIRST, whole.gold, whole.tbox, **more)  # type: ignore[arg-type]
    if not failed:
        return done
    scores = tuple(replace(score, answer=None, status=Status.FAILED) for score in done.evaluation.scores)
    return replace(done, evaluation=replace(done.evaluation, scores=scores))


class TestComparison:
    def test_measured_and_published_are_side_by_side(self):
        table = study_tables.comparison_table(
            results(
                cell("lexical", "semantic"),
                cell("llm-B:google:gemini-3-flash", "opaque", missed=("/W/Desk_1",)),
                cell("llm-B:google:gemini-3-flash", "hierarchy only"),
                cell("llm-A:openai:m", "opaque"),
                cell("llm-A:openai:m", "opaque-anonymous"),
            )
        )
        assert table is not None
        measured = [row[:5] for row in table.rows]
        assert measured == [
            ("lexical", "semantic", "50 / .87", "–", "–"),
            ("llm-B:google:gemini-3-flash", "opaque", "50 / .87", "48 / .79", "Gemini 3 Flash B"),
            ("llm-B:google:gemini-3-flash", "hierarchy only", "50 / .87", "54", "Gemini 3 Flash B"),
            # 6, 6 and 6; the fourth model failed.
            ("llm-A:openai:m", "opaque", "50 / .87", "6 / .42 to .50", "4 models, 1 failed"),
            ("llm-A:openai:m", "opaque-anonymous", "50 / .87", "–", "–"),
        ]
        assert [row[6] for row in table.rows] == ["50", "25", "50", "50", "50"]
        assert "as published, Kitchen Set with other labels (n = 125)" in table.note

    def test_a_result_that_lacks_answers_has_no_figures(self):
        table = study_tables.comparison_table(results(cell("llm-A:openai:m", "semantic", failed=True)))
        assert table is not None
        assert table.rows[0][2:] == ("incomplete: 4 of 4 failed", "94 to 96 / .98 to .99", "4 models", "–", "–")

    def test_no_table_without_a_method_of_the_study(self):
        assert study_tables.comparison_table(results(cell("lexical", "semantic"))) is None
        assert study_tables.error_classes_table(results(cell("lexical", "semantic"))) is None
        assert study_tables.cost_table([results(cell("lexical", "semantic"))]) is None
        assert study_tables.cascade_table(results(cell("lexical", "semantic"))) is None


def test_classes_of_errors_add_up_to_the_objects():
    answers = {"/W/Cup_1": ("Cup", 1.0), "/W/Cup_2": ("Container", 1.0), "/W/Bowl_1": ("Cup", 1.0)}
    whole = tiny()
    # Desk_1 has no answer, since the model named a class that does not exist.
    done = run(SPEC, "llm-A:openai:m", "semantic", answers, whole.gold, whole.tbox, cost=COST)
    table = study_tables.error_classes_table(results(done))
    assert table is not None
    row = dict(zip(table.columns, table.rows[0], strict=True))
    assert {key: value for key, value in row.items() if value != "0"} == {
        "method": "llm-A:openai:m",
        "condition": "semantic",
        "objects": "4",
        "right": "1",
        "superclass collapse": "1",
        "sibling confusion": "1",
        "hallucinated class": "1",
    }
    assert sum(map(int, table.rows[0][3:])) == len(GOLD)


def test_costs_are_summed():
    unpriced = replace(COST, dollars=None, paid=None)
    priced = results(*(cell("llm-A:openai:m", name, cost=COST) for name in ("semantic", "opaque")))
    table = study_tables.cost_table([priced])
    assert table is not None
    assert table.rows[-1] == ("all", "", "", "8", "10", "2", "2", "2", "2,000", "100", "$0.5000", "$0.4000", "0.8")
    table = study_tables.cost_table([priced, results(cell("llm-A:openai:m", "semantic", cost=unpriced))])
    assert table is not None
    assert table.rows[-1][-3:-1] == ("unknown", "unknown")


def test_cost_of_a_report_counts_cached_completions():
    report = RunReport(objects=5, prompts=4, completions=3, cached=2, repairs=1, degenerate=1, price=Decimal("0.2"))
    report.usage, report.cached_usage = Usage(600, 0, 30, 10), Usage(400, 0, 20)
    report.cached_price = Decimal("0.05")
    report.defects[Defect.HALLUCINATED] = 1
    report.keys |= {"sha256:2", "sha256:1"}
    cost = ModelCost.from_report(report)
    assert cost == ModelCost(5, 4, 5, 2, 1, 1, 1, 0, 1000, 50, 10, Decimal("0.25"), Decimal("0.2"), COST.keys)
    assert ModelCost.from_json(cost.as_json()) == cost


def cascades(price: str | None = "0.25") -> SceneResult:
    costs = [replace(COST, objects=n, dollars=None if price is None else n * Decimal(price)) for n in (0, 1, 2, 4)]
    thresholds = (0.2, 0.5, 0.9, 1.0)
    done = [
        cell("llm-B:openai:m", "semantic", cascade=threshold, cost=cost)
        for threshold, cost in zip(thresholds, costs, strict=True)
    ]
    return results(cell("lexical", "semantic"), *reversed(done), cell("llm-B:openai:m", "semantic", cost=costs[-1]))


def test_cascades_are_in_ascending_order_of_their_thresholds():
    table = study_tables.cascade_table(cascades())
    assert table is not None
    assert [(row[2], row[3], row[-3], row[-1]) for row in table.rows] == [
        ("0.2", "50 / .87", "0", "$0"),
        ("0.5", "50 / .87", "1", "$0.2500"),
        ("0.9", "50 / .87", "2", "$0.5000"),
        ("1", "50 / .87", "4", "$1.00"),
    ]


def test_cascades_are_drawn_from_the_lexical_grounder_to_the_model():
    pytest.importorskip("matplotlib")
    figure = plot_cascades(cascades(), "cascade")
    assert figure is not None
    shown = [element.text for element in ET.fromstring(figure.svg).iter("{http://www.w3.org/2000/svg}text")]
    # 0.2 costs nothing, as the lexical grounder alone, and 1 as much as the model for all objects.
    texts = ["none to 0.2", "0.5", "0.9", "1 to all"]
    assert [text for text in shown if text in texts] == texts
    assert "US dollars for 1,000 objects" in shown
    # One object of four for 25 cents is $62.50 for a thousand, all four are $250.
    assert "200" in shown
    assert "300" not in shown
    assert plot_cascades(cascades(price=None), "cascade") is None, "no price is known"
    assert plot_cascades(tiny(), "cascade") is None, "no cascade was run"


def test_cascades_are_left_out_of_the_tables_by_method():
    table = study_tables.comparison_table(cascades())
    assert table is not None
    assert [row[0] for row in table.rows] == ["lexical", "llm-B:openai:m"]
