"""Writing a report: what it holds, in which order, and into which files."""

import logging
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from usd2kg.errors import EvaluationError, OutputError
from usd2kg.evaluation.report import error_tables, plots, tables
from usd2kg.evaluation.report.data import format_csv, format_json
from usd2kg.evaluation.report.document import Figure, Section, Table
from usd2kg.evaluation.report.html import format_html
from usd2kg.evaluation.report.latex import format_latex
from usd2kg.evaluation.report.markdown import format_markdown
from usd2kg.evaluation.reproduce import SceneResult
from usd2kg.files import write_whole

__all__ = ["write_report"]

logger = logging.getLogger(__name__)

_Block = str | Table | Figure | None
_HOW_TO_READ = (
    "EMA is the share of objects whose class is exactly the gold one, in percent; HF1, from 0 to 1, also counts "
    "classes near it in the hierarchy. Objects without an answer count as wrong. Naming regimes mask the name of the "
    "object that is asked about: semantic leaves it, abbreviated drops vowels and cuts words short, opaque replaces it "
    "by a number, opaque-anonymous also those of its siblings and parents. Intervals are 95 % bootstrap intervals; "
    "where a scene repeats its objects, the one by distinct name is the honest one."
)
_NAME_QUALITY = (
    "The study's lesson is that the strategy should follow the quality of the names. A name is called good here if it "
    "contains the head word of its class: the last word of the class's local name."
)
_SIZE = (
    "Which objects have a telling box? Those that a method limited to geometry has right under opaque names, and would "
    "not have right without any evidence."
)
_SVG_HEAD = '<?xml version="1.0" encoding="utf-8"?>\n'


def write_report(results: list[SceneResult], title: str, folder: Path) -> list[Path]:
    """Return the files of the report on `results`, written into `folder`, which is made if need be.

    They are report.md, report.html, report.tex (the tables), results.csv, results.json and plots/*.svg. Without
    matplotlib the plots are left out, and the report says so. The same results give the same bytes, the seconds that
    the runs took apart.

    Raises:
        EvaluationError: there are no results.
        OutputError: a file cannot be written.
    """
    if not results:
        raise EvaluationError(f"{title}: there are no results to report; expected at least one scene")
    figures, remark = _draw(results)
    sections = [*_sections(results, figures, remark)]
    texts = {
        "report.md": format_markdown(title, sections),
        "report.html": format_html(title, sections),
        "report.tex": format_latex(title, sections),
        "results.csv": format_csv(results),
        "results.json": format_json(title, results),
        **{f"plots/{figure.file}": _SVG_HEAD + figure.svg + "\n" for figure in figures.values()},
    }
    return [_write(folder / name, text) for name, text in texts.items()]


def _write(path: Path, text: str) -> Path:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path.parent}: cannot be made ({error.strerror}); choose another folder") from error
    write_whole(path, text.encode("utf-8"))
    return path


# Plots

_SCENE_PLOTS: dict[str, Callable[[SceneResult, str], Figure | None]] = {
    "accuracy": plots.plot_accuracy,
    "ablation": plots.plot_ablation,
    "reliability": plots.plot_reliability,
    "risk_coverage": plots.plot_risk_coverage,
    "confusion": plots.plot_confusion,
}

_Figures = dict[tuple[str, int], Figure]
"""(kind, index of the scene) → plot."""


def _draw(results: Sequence[SceneResult]) -> tuple[_Figures, str]:
    """Return the plots, or none and why."""
    try:
        plots.check_matplotlib()
    except EvaluationError as error:
        logger.warning("the report has no plots: %s", error)
        return {}, f"Plots are left out: {error}."
    found: dict[tuple[str, int], Figure | None] = {("cost", 0): plots.plot_cost(results, "cost.svg")}
    for index, result in enumerate(results):
        for kind, plot in _SCENE_PLOTS.items():
            # Numbered, because a scene's name may hold anything.
            found[kind, index] = plot(result, f"scene{index + 1}_{kind}.svg")
    return {key: figure for key, figure in found.items() if figure is not None}, ""


# Contents


def _sections(results: Sequence[SceneResult], figures: _Figures, remark: str) -> Iterator[Section]:
    yield _section("What was measured", [_HOW_TO_READ, remark, tables.scenes_table(results)])
    yield _section("Accuracy by naming regime", _accuracy(results, figures))
    yield _section("Ablation", _ablation(results, figures))
    yield _section("Selection of objects", [tables.selection_table(results), *map(tables.missed_table, results)])
    yield _section("Errors", _errors(results, figures))
    yield _section("Quality of names", _name_quality(results))
    yield _section("Confidence", _confidence(results, figures))
    yield _section("Cost", [tables.timing_table(results), figures.get(("cost", 0))])


def _section(title: str, blocks: Iterable[_Block]) -> Section:
    return Section(title, tuple(block for block in blocks if block))


def _accuracy(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    for index, result in enumerate(results):
        yield tables.main_table(result)
        yield figures.get(("accuracy", index))
    yield tables.published_table()
    yield from map(tables.detail_table, results)
    yield from map(error_tables.mcnemar_table, results)


def _ablation(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    for index, result in enumerate(results):
        yield tables.ablation_table(result) or f"{result.spec.name}: no ablation was run."
        yield tables.own_ablation_table(result)
        yield figures.get(("ablation", index))


def _errors(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    for index, result in enumerate(results):
        yield error_tables.misses_table(result)
        yield error_tables.confusions_table(result)
        yield figures.get(("confusion", index))
        yield error_tables.classes_table(result)
        yield error_tables.agreed_table(result)
    yield _SIZE
    for result in results:
        yield error_tables.size_text(result) or f"{result.spec.name}: no method was limited to geometry."
        yield error_tables.size_table(result)


def _name_quality(results: Sequence[SceneResult]) -> Iterator[_Block]:
    yield _NAME_QUALITY
    for result in results:
        yield error_tables.name_quality_text(result)
        yield error_tables.name_quality_table(result)


def _confidence(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    found = [figures.get((kind, index)) for index, _ in enumerate(results) for kind in ("reliability", "risk_coverage")]
    yield "Calibration error and accuracy at 80 % coverage stand in the tables of further measures."
    yield from found
