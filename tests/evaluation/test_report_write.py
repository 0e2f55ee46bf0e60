"""Report files are complete, escaped, self-contained and deterministic."""

import csv
import io
import json
import logging
import re
import sys
from html.parser import HTMLParser
from pathlib import Path

import pytest

from tests.evaluation.conftest import omit_png_and_pdf
from tests.evaluation.report_records import FIRST, NS, SECOND, tiny
from usd2kg.errors import EvaluationError
from usd2kg.evaluation import SceneResult
from usd2kg.evaluation.report import write_report
from usd2kg.evaluation.report.blocks import Section, Table, printable
from usd2kg.evaluation.report.canvas import check_matplotlib
from usd2kg.evaluation.report.html import format_html
from usd2kg.evaluation.report.latex import escape_latex, format_latex
from usd2kg.evaluation.report.markdown import escape_markdown, format_markdown

EVIL = "<script>alert(1)</script>|\n"
ABLATION = {("first", "semantic"): FIRST, ("first", "geometry only"): SECOND, ("first", "name only"): SECOND}
EVIL_CLASS = "a|`b`$x$<b>&amp;\\_%[c](d)\x1b"


def evil() -> SceneResult:
    gold = {f"/W/{EVIL}": EVIL_CLASS, "/W/Cup_1": "Cup"}
    answers = {"/W/Cup_1": (EVIL_CLASS, 0.7)}
    runs = {("=first|" + EVIL, "semantic"): answers, ("first", "geometry only"): {f"/W/{EVIL}": (EVIL_CLASS, 0.5)}}
    hierarchy = {"Artifact": None, "Cup": "Artifact", EVIL_CLASS: "Artifact"}
    return tiny(runs, name='=HYPERLINK("x")' + EVIL, gold=gold, hierarchy=hierarchy, missed=(f"/W/{EVIL}",))


def markdown_tables(text: str) -> list[list[list[str]]]:
    """Return the tables as lists of rows, split at unescaped pipes."""
    found: list[list[list[str]]] = [[]]
    for line in text.split("\n"):
        if line.startswith("|"):
            cells = re.split(r"(?<!\\)(?:\\\\)*\|", line)[1:-1]
            found[-1].append([re.sub(r"\\(.)", r"\1", cell.strip()) for cell in cells])
        elif found[-1]:
            found.append([])
    return [table for table in found if table]


class Page(HTMLParser):
    """Collects tags, attributes, ids and text."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.ids: list[str] = []
        self.text = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs
        self.ids += [value for key, value in attrs if key == "id" and value]

    def handle_data(self, data: str) -> None:
        self.text += data


def read_page(text: str) -> Page:
    page = Page()
    page.feed(text)
    page.close()
    return page


@pytest.fixture(scope="module")
def plain_report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a report on the tiny scene, without PNG and PDF."""
    return write_once([tiny()], "A title", tmp_path_factory)


@pytest.fixture(scope="module")
def report_of_two(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a report on two scenes, without PNG and PDF."""
    return write_once([tiny(ABLATION), tiny()], "A title", tmp_path_factory)


@pytest.fixture(scope="module")
def hostile_report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a report on the scene with hostile names, without PNG and PDF."""
    return write_once([evil()], EVIL, tmp_path_factory)


def write_once(results: list[SceneResult], title: str, folders: pytest.TempPathFactory) -> Path:
    folder = folders.mktemp("report")
    with pytest.MonkeyPatch.context() as patch:
        omit_png_and_pdf(patch)
        write_report(results, title, folder)
    return folder


class TestFiles:
    @pytest.mark.usefixtures("svg_only")  # test_report_plots compares the others
    def test_output_is_deterministic(self, report_of_two: Path, tmp_path: Path):
        again = write_report([tiny(ABLATION), tiny()], "A title", tmp_path)
        assert [(report_of_two / path.relative_to(tmp_path)).read_bytes() for path in again] == [
            path.read_bytes() for path in again
        ]

    @pytest.mark.usefixtures("svg_only")
    def test_run_times_only_affect_the_timing_table(self, plain_report: Path, tmp_path: Path):
        second = write_report([tiny(seconds=44.0)], "A title", tmp_path)
        first = [plain_report / path.relative_to(tmp_path) for path in second]
        differing = {a.name for a, b in zip(first, second, strict=True) if a.read_bytes() != b.read_bytes()}
        assert differing <= {
            "report.md",
            "report.html",
            "report.tex",
            "results.csv",
            "results.json",
            *(f"cost.{end}" for end in ("svg", "png", "pdf")),
        }
        ours, theirs = (folder.read_text("utf-8").split("\n") for folder in (first[0], second[0]))
        assert [line for line, other in zip(ours, theirs, strict=True) if line != other] == [
            "| Tiny | first | 4 | 0.1 | – | – | – |",
            "| Tiny | second | 4 | 0.1 | – | – | – |",
        ]

    def test_rejects_empty_results(self, tmp_path: Path):
        with pytest.raises(EvaluationError, match="no results to report"):
            write_report([], "A title", tmp_path)

    def test_writes_everything_but_plots_without_matplotlib(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
    ):
        monkeypatch.setitem(sys.modules, "matplotlib", None)
        monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
        with pytest.raises(EvaluationError, match=r"pip install 'usd2kg\[plots\]'"):
            check_matplotlib()
        with caplog.at_level(logging.WARNING):
            paths = write_report([tiny()], "A title", tmp_path)
        assert {path.name for path in paths} == {
            "report.md",
            "report.html",
            "report.tex",
            "results.csv",
            "results.json",
        }
        assert "report without plots" in caplog.text
        for name in ("report.md", "report.html"):
            text = (tmp_path / name).read_text("utf-8")
            assert "Plots are omitted" in text
            assert "usd2kg" in text
            assert ".svg" not in text


@pytest.mark.usefixtures("svg_only")
class TestMarkdown:
    def test_tables_read_back(self, plain_report: Path):
        main = markdown_tables((plain_report / "report.md").read_text("utf-8"))[1]
        assert main[0] == ["method", "semantic", "abbreviated", "opaque", "opaque-anonymous"]
        assert main[2] == ["first", "50 / .87 (50)", "–", "–", "–"]

    def test_escapes_hostile_names(self, hostile_report: Path):
        text = (hostile_report / "report.md").read_text("utf-8")
        assert "<script" not in text
        assert "\x1b" not in text
        for table in markdown_tables(text):
            assert {len(row) for row in table} == {len(table[0])}

    def test_cells_read_back_unchanged(self):
        text = format_markdown("t", [Section("s", (Table("t", ("a|b", "c"), (("`x` | \\", "*y*_z_"),)),))])
        assert markdown_tables(text)[0][2] == ["`x` | \\", "*y*_z_"]

    def test_escapes_a_backslash_before_a_pipe(self):
        assert escape_markdown("\\|") == "\\\\\\|"


@pytest.mark.usefixtures("svg_only")
class TestLatex:
    def test_tables_read_back(self, plain_report: Path):
        text = (plain_report / "report.tex").read_text("utf-8")
        assert "\nfirst & 50 / .87 (50) & -- & -- & -- \\\\\n" in text
        assert text.count(r"\begin{tabular}") == text.count(r"\end{tabular}")

    def test_escapes_hostile_names(self, hostile_report: Path):
        text = (hostile_report / "report.tex").read_text("utf-8")
        for columns, body in re.findall(r"\\begin\{tabular\}\{([^\n]*)\}\n(.*?)\\end\{tabular\}", text, re.DOTALL):
            wanted = columns.replace(r"p{0.5\linewidth}", "l")
            rows = [line for line in body.split("\n") if line not in {"", r"\hline"}]
            assert {len(re.findall(r"(?<!\\)&", row)) for row in rows} == {len(wanted) - 1}
            assert all(row.removesuffix(r" \hline").endswith(r" \\") for row in rows)
        assert not re.search(r"(?<!\\)%(?! )", text), "an unescaped percent sign starts a comment"

    @pytest.mark.parametrize(
        ("text", "escaped"),
        [
            ("\\input{x}", r"\textbackslash{}input\{x\}"),
            ("a_b^c~d", r"a\_b\textasciicircum{}c\textasciitilde{}d"),
            ("$5 & #1 %", r"\$5 \& \#1 \%"),
            ("[2em]*", "{[}2em]{*}"),
            ("a\nb", "a b"),
        ],
    )
    def test_escapes_special_characters(self, text: str, escaped: str):
        assert escape_latex(text) == escaped

    def test_tables_and_plots_have_captions_and_labels(self, plain_report: Path):
        pytest.importorskip("matplotlib")
        text = (plain_report / "report.tex").read_text("utf-8")
        floats = re.findall(r"\\begin\{(table|figure)\}\[htbp\]\n(.*?)\\end\{\1\}", text, re.DOTALL)
        assert {kind for kind, _ in floats} == {"table", "figure"}
        for kind, body in floats:
            assert re.search(r"^\\caption\{.+\.\}$", body, re.MULTILINE)
            assert f"\\label{{{kind[:3]}:usd2kg-" in body
        labels = re.findall(r"\\label\{(.*?)\}", text)
        assert len(labels) == len(set(labels)) == len(floats)
        pictures = re.findall(r"\\includegraphics\[width=\\linewidth\]\{(.*?)\}", text)
        assert pictures and all((plain_report / picture).is_file() for picture in pictures)
        assert "\\caption{Tiny: exact match by naming regime; lines are 95 \\% intervals" in text

    def test_the_note_of_a_table_is_in_its_caption(self):
        table = Table("A title", ("n",), (("1",),), note="A caveat")
        assert "\\caption{A title. A caveat.}\n\\begin{tabular}" in format_latex("t", [Section("s", (table,))])

    def test_breaks_the_page_after_many_floats(self):
        tables = tuple(Table("t", ("n",), (("1",),)) for _ in range(40))
        assert format_latex("t", [Section("s", tables)]).count("\\clearpage") == 2

    def test_splits_long_tables(self):
        rows = tuple((str(i),) for i in range(90))
        text = format_latex("t", [Section("s", (Table("t", ("n",), rows),))])
        assert text.count(r"\begin{tabular}") == 3
        assert re.findall(r"\(\d of 3\)", text) == ["(1 of 3)", "(2 of 3)", "(3 of 3)"]
        assert re.findall(r"^(\d+) ", text, re.MULTILINE) == [str(i) for i in range(90)]


@pytest.mark.usefixtures("svg_only")
class TestHtml:
    @pytest.mark.parametrize("report", ["plain_report", "hostile_report"])
    def test_page_is_self_contained(self, report: str, request: pytest.FixtureRequest):
        text = (request.getfixturevalue(report) / "report.html").read_text("utf-8")
        page = read_page(text)
        assert not {"script", "link", "img", "image", "iframe", "object", "embed", "base"} & set(page.tags)
        for key, value in page.attributes:
            assert key not in {"src", "srcset", "data", "action"}
            assert not key.startswith("on")
            if key.endswith("href"):
                assert (value or "").startswith("#")
        assert "@import" not in text
        assert not re.search(r"url\((?!#)", text)

    def test_shows_hostile_names_as_text(self, hostile_report: Path):
        page = read_page((hostile_report / "report.html").read_text("utf-8"))
        assert printable(f"/W/{EVIL}") in page.text
        assert "b" not in page.tags

    def test_plots_have_unique_ids(self, report_of_two: Path):
        pytest.importorskip("matplotlib")
        page = read_page((report_of_two / "report.html").read_text("utf-8"))
        assert len(page.ids) == len(set(page.ids))
        targets = {value[1:] for key, value in page.attributes if key.endswith("href") and value}
        assert targets <= set(page.ids)

    def test_aligns_numeric_columns_right(self):
        table = Table("t", ("method", "EMA"), (("first", "50 / .87"), ("second", "fail")))
        text = format_html("t", [Section("s", (table,))])
        assert '<td>first</td><td class="number">50 / .87</td>' in text

    def test_folds_long_tables(self):
        text = format_html("t", [Section("s", (Table("long", ("a",), (("1",),), is_long=True),))])
        assert "<summary>long, 1 rows</summary>" in text


@pytest.mark.usefixtures("svg_only")
class TestData:
    def test_csv_has_one_row_per_run(self, tmp_path: Path):
        write_report([tiny({("first", "semantic"): FIRST, ("first", "hierarchy only"): SECOND})], "t", tmp_path)
        rows = list(csv.DictReader(io.StringIO((tmp_path / "results.csv").read_text("utf-8"))))
        assert [(row["method"], row["condition"], row["regime"], row["evidence"]) for row in rows] == [
            ("first", "semantic", "semantic", "all"),
            ("first", "hierarchy only", "opaque", "hierarchy"),
        ]
        assert float(rows[0]["ema"]) == 50.0
        assert float(rows[0]["hf1"]) == pytest.approx((1 + 0.8 + 2 / 3 + 1) / 4, abs=1e-15)
        assert rows[0]["misses: superclass collapse"] == "1"
        assert float(rows[0]["seconds_per_object"]) == 0.1
        assert rows[1]["accuracy_at_80"] == ""

    def test_csv_contains_no_formula(self, hostile_report: Path):
        text = (hostile_report / "results.csv").read_text("utf-8")
        rows = list(csv.DictReader(io.StringIO(text, newline="")))
        assert rows[0]["scene"] == '\'=HYPERLINK("x")' + EVIL
        assert not any(cell.startswith(("=", "+", "-", "@")) for row in rows for cell in row.values())

    def test_json_omits_folders(self, plain_report: Path):
        text = (plain_report / "results.json").read_text("utf-8")
        [scene] = json.loads(text)["scenes"]
        assert "somewhere" not in text
        assert scene["selection"]["unlabelled"] == ["/W/Lamp"]
        assert scene["analysis"]["distinct_names_agreed_on"]["semantic"]["all_wrong"] == {"bowl": 1, "cup": 1}
        assert [run["ema"] for run in scene["runs"]] == [50.0, 25.0]
        assert scene["runs"][0]["scores"][2]["answer"] == NS + "Cup"
