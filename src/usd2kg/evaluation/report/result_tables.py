"""Report tables: scenes, accuracy, ablation, object selection and run time."""

from collections.abc import Iterable, Sequence
from pathlib import PurePath

from usd2kg.evaluation.matrix import OWN_ABLATION, STUDY_ABLATION
from usd2kg.evaluation.metrics.intervals import mean_and_deviation
from usd2kg.evaluation.report.analysis import REGIMES, group_repeats, list_methods
from usd2kg.evaluation.report.blocks import Table
from usd2kg.evaluation.report.cell_text import (
    ABSENT,
    interval_text,
    number_text,
    published_text,
    significant_digits,
    spread_text,
)
from usd2kg.evaluation.report.published import AS_PUBLISHED, published_ablation, published_main
from usd2kg.evaluation.run import Evaluation
from usd2kg.evaluation.run_matrix import CellResult, SceneResult
from usd2kg.evaluation.score import distinct_name
from usd2kg.evaluation.settings import REPORT

__all__ = [
    "ablation_table",
    "detail_table",
    "main_table",
    "missed_table",
    "own_ablation_table",
    "published_table",
    "scenes_table",
    "selection_table",
    "size_title",
    "timing_table",
]


def scenes_table(results: Sequence[SceneResult]) -> Table:
    """Return one row per scene: file, counts, ontology and note."""
    columns = ("scene", "file", "objects", "distinct names", "classes", "superclass targets", "ontology", "note")
    return Table("Scenes", columns, tuple(_scene_row(result) for result in results))


def _scene_row(result: SceneResult) -> tuple[str, ...]:
    targets = [label.target for label in result.gold]
    names = {distinct_name(label.prim_path.rpartition("/")[2]) for label in result.gold}
    general = sum(bool(result.tbox.children[target]) for target in targets)
    return (
        result.spec.name,
        result.spec.path.name,
        str(len(targets)),
        str(len(names)),
        f"{len(set(targets))} of {len(result.tbox.classes)}",
        str(general),
        # Omit the folder, so that reports do not depend on the machine.
        PurePath(result.tbox.source).name,
        result.spec.note,
    )


def main_table(result: SceneResult) -> Table:
    """Return method × regime in the study's format, `EMA % / HF1`, with the end-to-end EMA in brackets."""
    runs = group_repeats(result)
    rows = tuple(
        (method, *(_ema_f1(runs.get((method, regime), ())) for regime in REGIMES)) for method in list_methods(result)
    )
    title = f"{size_title(result)}: EMA % / HF1 (EMA % end to end) by naming regime"
    return Table(title, ("method", *REGIMES), rows, _repeats_note(result))


def published_table() -> Table:
    """Return the study's main results, with a caveat in the title."""
    rows = tuple(
        (method, *(published_text(results.get(regime)) for regime in REGIMES))
        for method, results in published_main().items()
    )
    note = "For orientation only: the Kitchen Set, labelled by other annotators."
    return Table(f"EMA % / HF1 {AS_PUBLISHED}", ("method", *REGIMES), rows, note)


def detail_table(result: SceneResult) -> Table:
    """Return further metrics of each method and regime, with 95 % intervals."""
    columns = (
        "method",
        "regime",
        "EMA %",
        "95 % by object",
        "95 % by distinct name",
        "EMA % end to end",
        "95 % end to end, by distinct name",
        "EMA % by distinct name",
        "EMA % accept-also",
        "HF1 95 %",
        "calibration error",
        "calibration error if the confidences were true",
        "EMA % at 80 % coverage",
        "EMA % accept-also at 80 % coverage",
    )
    runs = group_repeats(result)
    keys = [(method, regime) for method in list_methods(result) for regime in REGIMES if (method, regime) in runs]
    rows = tuple((*key, *_details([done.evaluation for done in runs[key]])) for key in keys)
    return Table(f"{size_title(result)}: intervals and further metrics", columns, rows, _repeats_note(result))


def _details(evaluations: Sequence[Evaluation]) -> tuple[str, ...]:
    summaries = [evaluation.summary for evaluation in evaluations]
    first, end_to_end = summaries[0], [evaluation.end_to_end for evaluation in evaluations]
    return (
        spread_text([s.ema for s in summaries], 1),
        interval_text(first.ema_interval, 1),
        interval_text(first.ema_name_interval, 1),
        spread_text([s.ema for s in end_to_end], 1),
        interval_text(end_to_end[0].ema_name_interval, 1),
        spread_text([s.ema_by_name for s in summaries], 1),
        spread_text([s.ema_also for s in summaries], 1),
        interval_text(first.hf1_interval, 3),
        number_text(first.calibration_error, 3),
        number_text(first.chance_calibration_error, 3),
        number_text(first.accuracy_at_80, 1),
        number_text(first.accepted_at_80, 1),
    )


def timing_table(results: Sequence[SceneResult]) -> Table:
    """Return seconds per object of each method and regime; the only table that differs between identical runs."""
    rows = []
    for result in results:
        runs = group_repeats(result)
        for method in list_methods(result):
            cells = [runs.get((method, regime), ()) for regime in REGIMES]
            rows.append((result.spec.name, method, str(len(result.gold)), *(_seconds(done) for done in cells)))
    columns = ("scene", "method", "n", *REGIMES)
    return Table("Seconds per object", columns, tuple(rows), "Excludes reading the scene and the ontology.")


def _seconds(repeats: Sequence[CellResult]) -> str:
    if not repeats:
        return ABSENT
    each = [done.evaluation.seconds / done.evaluation.summary.n for done in repeats]
    return significant_digits(mean_and_deviation(each)[0])


def ablation_table(result: SceneResult) -> Table | None:
    """Return the study's conditions × methods, next to its published results; None if none was run."""
    if not _has_any(result, STUDY_ABLATION):
        return None
    published = published_ablation()
    columns = ("condition", *list_methods(result), *(f"{method} (published)" for method in published))
    rows = tuple(
        (*_ablation_row(result, condition), *(published_text(results[condition]) for results in published.values()))
        for condition in STUDY_ABLATION
    )
    return Table(
        f"{size_title(result)}: EMA % under the study's conditions", columns, rows, f"(published): {AS_PUBLISHED}."
    )


def own_ablation_table(result: SceneResult) -> Table | None:
    """Return the conditions of `OWN_ABLATION` × methods, under authored names; None if none was run."""
    if not _has_any(result, OWN_ABLATION):
        return None
    rows = tuple(_ablation_row(result, condition) for condition in OWN_ABLATION)
    return Table(f"{size_title(result)}: EMA % under our conditions", ("condition", *list_methods(result)), rows)


def _has_any(result: SceneResult, conditions: Iterable[str]) -> bool:
    return not {condition for _, condition in group_repeats(result)}.isdisjoint(conditions)


def _ablation_row(result: SceneResult, condition: str) -> tuple[str, ...]:
    runs = group_repeats(result)
    found = [runs.get((method, condition), ()) for method in list_methods(result)]
    return (condition, *(spread_text([d.evaluation.summary.ema for d in repeats], 0) for repeats in found))


def selection_table(results: Sequence[SceneResult]) -> Table:
    """Return recall and precision of object selection, one row per scene."""
    rows = tuple(
        (
            result.spec.name,
            str(len(result.gold)),
            number_text(result.selection.recall, 3),
            number_text(result.selection.precision, 3),
            str(len(result.selection.missed)),
            str(len(result.selection.unlabelled)),
        )
        for result in results
    )
    columns = ("scene", "labelled", "recall", "precision", "missed", "selected without label")
    note = "If the gold labels do not cover the whole scene, precision is a lower bound."
    return Table("Selected and labelled prims", columns, rows, note)


def missed_table(result: SceneResult) -> Table | None:
    """Return the labelled prims that were not selected, truncated with a count; None if there are none."""
    missed = result.selection.missed
    if not missed:
        return None
    rows = [(path,) for path in missed[: REPORT.max_missed]]
    if len(missed) > REPORT.max_missed:
        rows.append((f"and {len(missed) - REPORT.max_missed} more",))
    return Table(f"{result.spec.name}: labelled prims that were not selected", ("prim path",), tuple(rows))


def size_title(result: SceneResult) -> str:
    """Return the name of the scene with the numbers of objects and distinct names."""
    names = {distinct_name(label.prim_path.rpartition("/")[2]) for label in result.gold}
    return f"{result.spec.name} (n = {len(result.gold)} objects, {len(names)} distinct names)"


def _repeats_note(result: SceneResult) -> str:
    repeats = max((done.cell.repeat for done in result.cells), default=1)
    return (
        ""
        if repeats == 1
        else f"Mean ± standard deviation of {repeats} repeats of each language model; intervals are those of the first "
        "repeat."
    )


def _ema_f1(repeats: Sequence[CellResult]) -> str:
    if not repeats:
        return ABSENT
    summaries = [done.evaluation.summary for done in repeats]
    end_to_end = spread_text([done.evaluation.end_to_end.ema for done in repeats], 0)
    ema, hf1 = spread_text([s.ema for s in summaries], 0), spread_text([s.hf1 for s in summaries], 2, "0")
    return f"{ema} / {hf1} ({end_to_end})"
