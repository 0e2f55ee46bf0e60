"""usd2kg eval reproduce and eval kitchen-set: evaluation matrices with reports."""

from collections.abc import Callable, Sequence
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from usd2kg.cli.options.common import OntologyFile, ReportFolder
from usd2kg.cli.output import count_noun, emit, notify
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation import CellResult

__all__ = ["kitchen_set_command", "reproduce_command"]

_OBJECTS_IN_STUDY = 125
"""Objects of the Kitchen Set in the study."""


def reproduce_command(
    matrix: Annotated[Path, Argument(metavar="MATRIX", help="TOML file; see docs/evaluation.md.")],
    output: ReportFolder = Path("results"),
    refresh: Annotated[
        bool, Option("--refresh", help="Compute every result again; default: use stored results.")
    ] = False,
) -> None:
    """Evaluate scenes × grounders × regimes × ablations and write tables, plots and a report.

    Results are stored, so an interrupted run resumes. Results without all answers of a model are computed again.
    """
    from usd2kg import evaluation  # noqa: PLC0415
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415

    plan = evaluation.read_matrix(matrix)
    for scene in plan.scenes:
        if scene.missing is not None:
            notify(f"{scene.name} is left out: {scene.missing} does not exist")
    total = sum(1 for cell in plan.cells() if cell.scene.missing is None)
    results = evaluation.run_matrix(plan, output, refresh=refresh, progress=_progress(total))
    if not results:
        raise EvaluationError(f"{matrix}: none of its scenes exists; correct the paths")
    for path in write_report(results, plan.title, output):
        emit(f"{path}\n")
    _check_complete([cell for result in results for cell in result.cells])


def _check_complete(cells: "Sequence[CellResult]") -> None:
    """Check that no grounder failed on an object.

    Raises:
        EvaluationError: one did; the message says why.
    """
    incomplete = [cell.failures for cell in cells if cell.failures]
    if incomplete:
        reason, answers = incomplete[0][0], sum(map(len, incomplete))
        raise EvaluationError(
            f"{len(incomplete)} of {len(cells)} results lack {answers} answers ({reason}); in the report, these "
            "objects count as wrong; run the same command again to complete them"
        )


def _progress(total: int) -> "Callable[[CellResult], None]":
    """Return a function that prints a result with its number of `total`."""
    numbers = count(1)

    def report(result: "CellResult") -> None:
        cell, summary = result.cell, result.evaluation.summary
        stored = " (stored)" if result.was_stored else ""
        figures = f"EMA {summary.ema:.1f} HF1 {summary.hf1:.2f}"
        failed = f" ({count_noun(len(result.failures), 'object')} failed)" if result.failures else ""
        notify(
            f"[{next(numbers)}/{total}] {cell.scene.name}, {cell.grounder}, {cell.condition}: {figures}{stored}{failed}"
        )

    return report


def kitchen_set_command(
    folder: Annotated[Path, Argument(metavar="PATH", help="Folder of the unpacked Kitchen Set.")],
    gold: Annotated[
        Path | None, Option("--gold", help="Gold labels; default: none, only check the scene and list objects.")
    ] = None,
    ontology: OntologyFile = None,
    output: ReportFolder = Path("kitchen_set_results"),
) -> None:
    """Check a download of Pixar's Kitchen Set, and evaluate the study's matrix on it with your gold labels."""
    from usd2kg.evaluation import run_matrix  # noqa: PLC0415
    from usd2kg.evaluation.kitchen_set import check_kitchen_set, kitchen_matrix  # noqa: PLC0415
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    found = check_kitchen_set(folder)
    scene = read_scene(found.root)
    counts = (
        f"{found.layer_count} layers, {count_noun(len(scene.objects), 'object')} (the study has {_OBJECTS_IN_STUDY})"
    )
    notify(f"{found.root}: {counts}")
    if gold is None:
        emit("".join(f"{obj.prim_path}\n" for obj in scene.objects))
        notify("label these objects with usd2kg eval annotate, then run this command with --gold")
        return
    plan = kitchen_matrix(found, gold, ontology)
    for path in write_report(run_matrix(plan, output), plan.title, output):
        emit(f"{path}\n")
