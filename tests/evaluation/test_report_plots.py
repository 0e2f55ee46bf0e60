"""Plots are valid SVG, PNG and PDF, deterministic, and robust against any name."""

import io
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from PIL import Image, ImageOps

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


@pytest.mark.usefixtures("svg_only")
def test_all_plots_are_valid_svg(tmp_path: Path):
    write_report([full(), tiny()], "A title", tmp_path)
    names = {path.name for path in (tmp_path / "plots").glob("*.svg")}
    kinds = ("accuracy", "ablation", "reliability", "risk_coverage", "confusion")
    assert names == {"cost.svg", *(f"scene1_{kind}.svg" for kind in kinds)} | {
        f"scene2_{kind}.svg" for kind in kinds if kind != "ablation"
    }
    for path in (tmp_path / "plots").glob("*.svg"):
        root = ET.parse(path).getroot()
        assert root.tag == f"{SVG}svg"
        assert not list(root.iter(f"{SVG}image")), "vector graphics only"
        assert not list(root.iter(f"{SVG}script"))


@pytest.mark.usefixtures("svg_only")
def test_plots_are_deterministic_without_a_date():
    first, second = (plots.plot_accuracy(full(), "a").svg for _ in range(2))
    assert first == second
    assert "metadata" not in first


def test_writes_and_returns_all_files_and_each_plot_also_as_png_and_pdf(tmp_path: Path):
    folder = tmp_path / "new" / "folder"
    paths = write_report([full()], "A title", folder)
    assert {path.name for path in paths} >= {"report.md", "report.html", "report.tex", "results.csv", "results.json"}
    assert {path for path in folder.rglob("*") if path.is_file()} == set(paths)
    names = {path.stem for path in (folder / "plots").glob("*.svg")}
    for ending, start in ((".png", b"\x89PNG\r\n"), (".pdf", b"%PDF-")):
        found = list((folder / "plots").glob(f"*{ending}"))
        assert {path.stem for path in found} == names
        assert all(path.read_bytes().startswith(start) for path in found)


def test_png_and_pdf_are_deterministic_without_a_date():
    first, second = (plots.plot_accuracy(full(), "a") for _ in range(2))
    assert (first.png, first.pdf) == (second.png, second.pdf)
    assert not any(key in first.pdf for key in (b"CreationDate", b"Producer", b"Creator"))
    assert b"Software" not in first.png


def test_fonts_of_a_pdf_are_truetype():
    pdf = plots.plot_accuracy(full(), "a").pdf
    assert b"/Subtype /Type3" not in pdf
    assert b"/FontFile2" in pdf


def test_long_legends_are_not_cut():
    methods = [f"llm-B:provider{number}:a-model-with-a-long-name" for number in range(5)]
    wide = plots.plot_accuracy(tiny({(method, "semantic"): FIRST for method in methods}), "a")
    image = Image.open(io.BytesIO(wide.png)).convert("L")
    assert image.width < 8.5 * 200, "the columns of the legend fit the width of 8 inches at 200 dpi"
    # A margin of background on all sides: nothing is cut.
    left, top, right, bottom = ImageOps.invert(image).getbbox() or (0, 0, 0, 0)
    assert left > 0 and top > 0 and right < image.width and bottom < image.height


@pytest.mark.usefixtures("svg_only")
def test_accuracy_plot_shows_the_values_of_the_table():
    shown = texts(plots.plot_accuracy(tiny(), "a").svg)
    assert {"50", "25", "semantic", "first", "second"} <= set(shown)


@pytest.mark.usefixtures("svg_only")
def test_conditions_that_were_not_run_have_no_bar():
    result = tiny({("first", "semantic"): FIRST, ("second", "geometry only"): FIRST, ("first", "name only"): SECOND})
    accuracy, ablation = plots.plot_accuracy(result, "a"), plots.plot_ablation(result, "a")
    assert ablation is not None
    assert "second" not in texts(accuracy.svg)
    assert texts(ablation.svg).count("first") == texts(ablation.svg).count("second") == 1
    assert texts(ablation.svg).count("0") == 2, "only as the first tick of each axis"


@pytest.mark.usefixtures("svg_only")
def test_confusion_plot_sorts_classes_by_hierarchy():
    figure = plot_confusion(tiny(), "a")
    assert figure is not None
    classes = [text for text in texts(figure.svg) if text in {"Artifact", "Container", "Bowl", "Cup", "Table"}]
    assert classes == ["Container", "Bowl", "Cup", "Table"] * 2
    assert "no answer" not in texts(figure.svg)


@pytest.mark.usefixtures("svg_only")
def test_confusion_plot_omits_unconfused_classes_if_there_are_many():
    many = {f"Class{i}": "Artifact" for i in range(60)}
    gold = {f"/W/c{i}": f"Class{i}" for i in range(60)}
    answers = {path: (cls, 0.5) for path, cls in gold.items()} | {"/W/c0": ("Class1", 0.5)}
    result = tiny({("first", "semantic"): answers}, gold=gold, hierarchy={"Artifact": None} | many)
    figure = plot_confusion(result, "a")
    assert figure is not None
    assert "58 classes that are never confused are omitted" in figure.caption


@pytest.mark.usefixtures("svg_only")
def test_no_confusion_plot_for_many_classes_without_confusion():
    many = {f"Class{i}": "Artifact" for i in range(60)}
    gold = {f"/W/c{i}": f"Class{i}" for i in range(60)}
    answers = {path: (cls, 0.5) for path, cls in gold.items()}
    result = tiny({("first", "semantic"): answers}, gold=gold, hierarchy={"Artifact": None} | many)
    assert plot_confusion(result, "a") is None


@pytest.mark.usefixtures("svg_only")
def test_plots_without_any_answer():
    result = tiny({("first", "semantic"): {}})
    assert plots.plot_reliability(result, "a") is None
    assert plots.plot_risk_coverage(result, "a") is None
    confusion = plot_confusion(result, "a")
    assert confusion is not None
    assert "no answer" in texts(confusion.svg)


@pytest.mark.usefixtures("svg_only")
def test_no_plots_without_runs_under_authored_names():
    result = tiny({("first", "opaque"): SECOND})
    assert plot_confusion(result, "a") is None
    assert plots.plot_cost([result], "a") is None
    assert plots.plot_ablation(result, "a") is None


@pytest.mark.usefixtures("svg_only")
def test_cost_plot_has_decimal_tick_labels():
    figure = plots.plot_cost([tiny(seconds=0.0004)], "a")
    assert figure is not None
    shown = texts(figure.svg)
    assert {"0.0001", "0.001"} & set(shown)
    assert not any("math" in text for text in shown)


@pytest.mark.parametrize("name", ["$\\frac$", "_hidden", "台所\x00", "a" * 300, "</text><script>"])
@pytest.mark.usefixtures("svg_only")
def test_draws_any_name(name: str):
    result = tiny({(name, "semantic"): FIRST}, name=name)
    for figure in (plots.plot_accuracy(result, "a"), plots.plot_cost([result], "a")):
        assert figure is not None
        assert not list(ET.fromstring(figure.svg).iter(f"{SVG}script"))
        assert any(text.strip(" …") and text.strip(" …")[:2] in name for text in texts(figure.svg))


@pytest.mark.usefixtures("svg_only")
def test_ignores_the_users_matplotlib_settings():
    import matplotlib as mpl  # noqa: PLC0415

    plain = plots.plot_accuracy(tiny(), "a").svg
    with mpl.rc_context({"font.size": 30, "axes.facecolor": "red"}):
        assert plots.plot_accuracy(tiny(), "a").svg == plain
        assert mpl.rcParams["font.size"] == 30


@pytest.mark.usefixtures("svg_only")
def test_accuracy_and_ablation_show_the_published_results():
    figure, ablation = plots.plot_accuracy(tiny(), "a"), plots.plot_ablation(full(), "a")
    assert ablation is not None
    for drawn in (figure, ablation):
        assert "published, Kitchen Set" in texts(drawn.svg)
    assert "the best: 96 % Gemini 2.5 Flash A, semantic; 89 % Gemini 3 Flash B, abbreviated" in figure.caption
