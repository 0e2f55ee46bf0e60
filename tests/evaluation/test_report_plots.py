"""Plots are valid SVG, deterministic, and robust against any name."""

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from tests.evaluation.report_records import FIRST, SECOND, tiny
from usd2kg.evaluation import SceneResult
from usd2kg.evaluation.report import plots, write_report
from usd2kg.evaluation.report.confusion_plot import plot_confusion

pytest.importorskip("matplotlib")

SVG = "{http://www.w3.org/2000/svg}"


def full() -> SceneResult:
    conditions = ("semantic", "opaque", "geometry only", "name only")
    return tiny({(method, condition): FIRST for method in ("first", "second") for condition in conditions})


def texts(svg: str) -> list[str]:
    return [element.text or "" for element in ET.fromstring(svg).iter(f"{SVG}text")]


def test_all_plots_are_valid_svg(tmp_path: Path):
    write_report([full(), tiny()], "A title", tmp_path)
    names = {path.name for path in (tmp_path / "plots").iterdir()}
    kinds = ("accuracy", "ablation", "reliability", "risk_coverage", "confusion")
    assert names == {"cost.svg", *(f"scene1_{kind}.svg" for kind in kinds)} | {
        f"scene2_{kind}.svg" for kind in kinds if kind != "ablation"
    }
    for path in (tmp_path / "plots").iterdir():
        root = ET.parse(path).getroot()
        assert root.tag == f"{SVG}svg"
        assert not list(root.iter(f"{SVG}image")), "vector graphics only"
        assert not list(root.iter(f"{SVG}script"))


def test_plots_are_deterministic_without_a_date():
    first, second = (plots.plot_accuracy(full(), "a.svg").svg for _ in range(2))
    assert first == second
    assert "metadata" not in first


def test_accuracy_plot_shows_the_values_of_the_table():
    shown = texts(plots.plot_accuracy(tiny(), "a.svg").svg)
    assert {"50", "25", "semantic", "first", "second"} <= set(shown)


def test_conditions_that_were_not_run_have_no_bar():
    result = tiny({("first", "semantic"): FIRST, ("second", "geometry only"): FIRST, ("first", "name only"): SECOND})
    accuracy, ablation = plots.plot_accuracy(result, "a.svg"), plots.plot_ablation(result, "a.svg")
    assert ablation is not None
    assert "second" not in texts(accuracy.svg)
    assert texts(ablation.svg).count("first") == texts(ablation.svg).count("second") == 1
    assert texts(ablation.svg).count("0") == 2, "only as the first tick of each axis"


def test_confusion_plot_sorts_classes_by_hierarchy():
    figure = plot_confusion(tiny(), "a.svg")
    assert figure is not None
    classes = [text for text in texts(figure.svg) if text in {"Artifact", "Container", "Bowl", "Cup", "Table"}]
    assert classes == ["Container", "Bowl", "Cup", "Table"] * 2
    assert "no answer" not in texts(figure.svg)


def test_confusion_plot_omits_unconfused_classes_if_there_are_many():
    many = {f"Class{i}": "Artifact" for i in range(60)}
    gold = {f"/W/c{i}": f"Class{i}" for i in range(60)}
    answers = {path: (cls, 0.5) for path, cls in gold.items()} | {"/W/c0": ("Class1", 0.5)}
    result = tiny({("first", "semantic"): answers}, gold=gold, hierarchy={"Artifact": None} | many)
    figure = plot_confusion(result, "a.svg")
    assert figure is not None
    assert "58 classes that are never confused are omitted" in figure.caption


def test_no_confusion_plot_for_many_classes_without_confusion():
    many = {f"Class{i}": "Artifact" for i in range(60)}
    gold = {f"/W/c{i}": f"Class{i}" for i in range(60)}
    answers = {path: (cls, 0.5) for path, cls in gold.items()}
    result = tiny({("first", "semantic"): answers}, gold=gold, hierarchy={"Artifact": None} | many)
    assert plot_confusion(result, "a.svg") is None


def test_plots_without_any_answer():
    result = tiny({("first", "semantic"): {}})
    assert plots.plot_reliability(result, "a.svg") is None
    assert plots.plot_risk_coverage(result, "a.svg") is None
    confusion = plot_confusion(result, "a.svg")
    assert confusion is not None
    assert "no answer" in texts(confusion.svg)


def test_no_plots_without_runs_under_authored_names():
    result = tiny({("first", "opaque"): SECOND})
    assert plot_confusion(result, "a.svg") is None
    assert plots.plot_cost([result], "a.svg") is None
    assert plots.plot_ablation(result, "a.svg") is None


def test_cost_plot_has_decimal_tick_labels():
    figure = plots.plot_cost([tiny(seconds=0.0004)], "a.svg")
    assert figure is not None
    shown = texts(figure.svg)
    assert {"0.0001", "0.001"} & set(shown)
    assert not any("math" in text for text in shown)


@pytest.mark.parametrize("name", ["$\\frac$", "_hidden", "台所\x00", "a" * 300, "</text><script>"])
def test_draws_any_name(name: str):
    result = tiny({(name, "semantic"): FIRST}, name=name)
    for figure in (plots.plot_accuracy(result, "a.svg"), plots.plot_cost([result], "a.svg")):
        assert figure is not None
        assert not list(ET.fromstring(figure.svg).iter(f"{SVG}script"))
        assert any(text.strip(" …") and text.strip(" …")[:2] in name for text in texts(figure.svg))


def test_ignores_the_users_matplotlib_settings():
    import matplotlib as mpl  # noqa: PLC0415

    plain = plots.plot_accuracy(tiny(), "a.svg").svg
    with mpl.rc_context({"font.size": 30, "axes.facecolor": "red"}):
        assert plots.plot_accuracy(tiny(), "a.svg").svg == plain
        assert mpl.rcParams["font.size"] == 30
