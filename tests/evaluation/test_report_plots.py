"""The plots: valid, deterministic, and robust against what a name may hold."""

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from tests.evaluation.test_report_records import FIRST, SECOND, tiny
from usd2kg.evaluation import SceneResult
from usd2kg.evaluation.report import plots, write_report

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
        assert not list(root.iter(f"{SVG}image")), "drawn, not an image"
        assert not list(root.iter(f"{SVG}script"))


def test_a_plot_has_no_date_and_is_always_the_same():
    first, second = (plots.plot_accuracy(full(), "a.svg").svg for _ in range(2))
    assert first == second
    assert "metadata" not in first


def test_accuracy_shows_the_table_s_figures():
    shown = texts(plots.plot_accuracy(tiny(), "a.svg").svg)
    assert {"50", "25", "semantic", "first", "second"} <= set(shown)


def test_what_was_not_run_is_absent_and_not_nought():
    result = tiny({("first", "semantic"): FIRST, ("second", "geometry only"): FIRST, ("first", "name only"): SECOND})
    accuracy, ablation = plots.plot_accuracy(result, "a.svg"), plots.plot_ablation(result, "a.svg")
    assert ablation is not None
    assert "second" not in texts(accuracy.svg)
    assert texts(ablation.svg).count("first") == texts(ablation.svg).count("second") == 1
    assert texts(ablation.svg).count("0") == 2, "at the left end of each axis, and on no bar"


def test_confusion_shows_the_classes_that_occur_in_the_order_of_the_hierarchy():
    figure = plots.plot_confusion(tiny(), "a.svg")
    assert figure is not None
    classes = [text for text in texts(figure.svg) if text in {"Artifact", "Container", "Bowl", "Cup", "Table"}]
    assert classes == ["Container", "Bowl", "Cup", "Table"] * 2
    assert "no answer" not in texts(figure.svg)


def test_confusion_leaves_out_classes_without_confusion_only_where_there_are_many():
    many = {f"Class{i}": "Artifact" for i in range(60)}
    gold = {f"/W/c{i}": f"Class{i}" for i in range(60)}
    answers = {path: (cls, 0.5) for path, cls in gold.items()} | {"/W/c0": ("Class1", 0.5)}
    result = tiny({("first", "semantic"): answers}, gold=gold, hierarchy={"Artifact": None} | many)
    figure = plots.plot_confusion(result, "a.svg")
    assert figure is not None
    assert "58 classes that are never confused are left out" in figure.caption


def test_many_classes_and_no_confusion():
    many = {f"Class{i}": "Artifact" for i in range(60)}
    gold = {f"/W/c{i}": f"Class{i}" for i in range(60)}
    answers = {path: (cls, 0.5) for path, cls in gold.items()}
    result = tiny({("first", "semantic"): answers}, gold=gold, hierarchy={"Artifact": None} | many)
    assert plots.plot_confusion(result, "a.svg") is None


def test_no_answer_at_all():
    result = tiny({("first", "semantic"): {}})
    assert plots.plot_reliability(result, "a.svg") is None
    assert plots.plot_risk_coverage(result, "a.svg") is None
    confusion = plots.plot_confusion(result, "a.svg")
    assert confusion is not None
    assert "no answer" in texts(confusion.svg)


def test_nothing_was_run_under_authored_names():
    result = tiny({("first", "opaque"): SECOND})
    assert plots.plot_confusion(result, "a.svg") is None
    assert plots.plot_cost([result], "a.svg") is None
    assert plots.plot_ablation(result, "a.svg") is None


def test_cost_has_whole_decades_without_formulas():
    figure = plots.plot_cost([tiny(seconds=0.0004)], "a.svg")
    assert figure is not None
    shown = texts(figure.svg)
    assert {"0.0001", "0.001"} & set(shown)
    assert not any("math" in text for text in shown)


@pytest.mark.parametrize("name", ["$\\frac$", "_hidden", "台所\x00", "a" * 300, "</text><script>"])
def test_any_name_can_be_drawn(name: str):
    result = tiny({(name, "semantic"): FIRST}, name=name)
    for figure in (plots.plot_accuracy(result, "a.svg"), plots.plot_cost([result], "a.svg")):
        assert figure is not None
        assert not list(ET.fromstring(figure.svg).iter(f"{SVG}script"))
        assert any(text.strip(" …") and text.strip(" …")[:2] in name for text in texts(figure.svg))


def test_the_users_own_settings_do_not_show():
    import matplotlib as mpl  # noqa: PLC0415

    plain = plots.plot_accuracy(tiny(), "a.svg").svg
    with mpl.rc_context({"font.size": 30, "axes.facecolor": "red"}):
        assert plots.plot_accuracy(tiny(), "a.svg").svg == plain
        assert mpl.rcParams["font.size"] == 30
