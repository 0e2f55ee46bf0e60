"""Write a report: its sections, their order, and its files."""

import logging
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from usd2kg.errors import EvaluationError, OutputError
from usd2kg.evaluation.report import error_tables, plots, result_tables, study_tables
from usd2kg.evaluation.report.blocks import Figure, Section, Table
from usd2kg.evaluation.report.canvas import check_matplotlib
from usd2kg.evaluation.report.cascade_plot import plot_cascades
from usd2kg.evaluation.report.confusion_plot import plot_confusion
from usd2kg.evaluation.report.csv_json import format_csv, format_json
from usd2kg.evaluation.report.html import format_html
from usd2kg.evaluation.report.latex import format_latex
from usd2kg.evaluation.report.markdown import format_markdown
from usd2kg.evaluation.run_matrix import SceneResult
from usd2kg.files import write_whole

__all__ = ["write_report"]

logger = logging.getLogger(__name__)

_Block = str | Table | Figure | None
_HOW_TO_READ = (
    "EMA is the share of objects with exactly the gold class, in percent; HF1, from 0 to 1, gives partial credit to "
    "classes near it in the hierarchy. Objects without an answer count as wrong. In end-to-end figures, objects that "
    "the object selection misses also count as wrong; others are for all objects of the gold labels. Naming regimes "
    "mask the name of the object to ground: semantic keeps it, abbreviated drops vowels and truncates words, opaque "
    "replaces it with a number, opaque-anonymous also replaces the names of siblings and parents. Intervals are 95 % "
    "bootstrap intervals, at 0 and 100 % Wilson's; if a scene contains copies, use the one by distinct name. Coverage "
    "is the share of all objects; there is no figure at 80 % coverage if fewer have an answer with a confidence."
)
_NAME_QUALITY = (
    "The study concludes that the strategy should depend on the quality of the names. Here a name is good if it "
    "contains the head noun of its class: the last word of the local name of the class."
)
_SIZE = (
    "Objects recognised by size alone: a method limited to geometry gets them right under opaque names, and "
    "without any evidence it does not."
)
_SVG_HEAD = '<?xml version="1.0" encoding="utf-8"?>\n'


def write_report(results: list[SceneResult], title: str, folder: Path) -> list[Path]:
    """Write the report on `results` into `folder`, which is created if missing, and return the paths of its files.

    The files are report.md, report.html, report.tex (tables and figures), results.csv, results.json, and each plot as
    SVG, PNG and PDF in the folder plots. Without matplotlib, a remark replaces the plots. Except for run times, output
    is deterministic.

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
    }
    files = {name: text.encode("utf-8") for name, text in texts.items()}
    for figure in figures.values():
        files[f"plots/{figure.name}.svg"] = f"{_SVG_HEAD}{figure.svg}\n".encode()
        files[f"plots/{figure.name}.png"] = figure.png
        files[f"plots/{figure.name}.pdf"] = figure.pdf
    return [_write(folder / name, content) for name, content in files.items()]


def _write(path: Path, content: bytes) -> Path:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{path.parent}: cannot be created ({error.strerror}); choose another folder") from error
    write_whole(path, content)
    return path


_SCENE_PLOTS: dict[str, Callable[[SceneResult, str], Figure | None]] = {
    "accuracy": plots.plot_accuracy,
    "ablation": plots.plot_ablation,
    "reliability": plots.plot_reliability,
    "risk_coverage": plots.plot_risk_coverage,
    "confusion": plot_confusion,
    "cascade": plot_cascades,
}

_Figures = dict[tuple[str, int], Figure]
"""(kind, index of the scene) → plot."""


def _draw(results: Sequence[SceneResult]) -> tuple[_Figures, str]:
    """Return the plots, and a remark if there are none."""
    try:
        check_matplotlib()
    except EvaluationError as error:
        logger.warning("report without plots: %s", error)
        return {}, f"Plots are omitted: {error}."
    found: dict[tuple[str, int], Figure | None] = {("cost", 0): plots.plot_cost(results, "cost")}
    for index, result in enumerate(results):
        for kind, plot in _SCENE_PLOTS.items():
            # Numbered, since a scene name may not be a valid file name.
            found[kind, index] = plot(result, f"scene{index + 1}_{kind}")
    return {key: figure for key, figure in found.items() if figure is not None}, ""


def _sections(results: Sequence[SceneResult], figures: _Figures, remark: str) -> Iterator[Section]:
    yield _section("Scenes and metrics", [_HOW_TO_READ, remark, result_tables.scenes_table(results)])
    yield _section("Accuracy by naming regime", _accuracy(results, figures))
    yield _section("Ablation", _ablation(results, figures))
    yield _section(
        "Object selection", [result_tables.selection_table(results), *map(result_tables.missed_table, results)]
    )
    yield _section("Errors", _errors(results, figures))
    yield _section("Name quality", _name_quality(results))
    yield _section("Confidence", _confidence(results, figures))
    yield _section("Cost", _cost(results, figures))


def _section(title: str, blocks: Iterable[_Block]) -> Section:
    return Section(title, tuple(block for block in blocks if block))


def _accuracy(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    for index, result in enumerate(results):
        yield result_tables.main_table(result)
        yield figures.get(("accuracy", index))
    yield from map(study_tables.comparison_table, results)
    yield result_tables.published_table()
    yield from map(result_tables.detail_table, results)
    yield from map(error_tables.mcnemar_table, results)


def _ablation(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    for index, result in enumerate(results):
        yield result_tables.ablation_table(result) or f"{result.spec.name}: no ablation was run."
        yield result_tables.own_ablation_table(result)
        yield figures.get(("ablation", index))


def _errors(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    for index, result in enumerate(results):
        yield study_tables.error_classes_table(result)
        yield error_tables.misses_table(result)
        yield error_tables.confusions_table(result)
        yield figures.get(("confusion", index))
        yield error_tables.classes_table(result)
        yield error_tables.unanimous_table(result)
    yield _SIZE
    for result in results:
        yield error_tables.size_text(result) or f"{result.spec.name}: no method was limited to geometry."
        yield error_tables.size_table(result)


def _name_quality(results: Sequence[SceneResult]) -> Iterator[_Block]:
    yield _NAME_QUALITY
    for result in results:
        yield error_tables.name_quality_text(result)
        yield error_tables.name_quality_table(result)


def _cost(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    yield result_tables.timing_table(results)
    yield figures.get(("cost", 0))
    yield study_tables.cost_table(results)
    for index, result in enumerate(results):
        yield study_tables.cascade_table(result)
        yield figures.get(("cascade", index))


def _confidence(results: Sequence[SceneResult], figures: _Figures) -> Iterator[_Block]:
    found = [figures.get((kind, index)) for index, _ in enumerate(results) for kind in ("reliability", "risk_coverage")]
    yield "Calibration error and accuracy at 80 % coverage are in the tables of further metrics."
    yield from found
