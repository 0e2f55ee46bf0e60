"""usd2kg eval reproduce: evaluation matrices, including that of the study, with reports."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from usd2kg.cli.evaluate.study import StudyOptions, plan_study_matrix, study_text
from usd2kg.cli.options.bundles import expand_bundles
from usd2kg.cli.options.common import ReportFolder
from usd2kg.cli.options.model import ObjectsPerPrompt, RequestLimits, Temperature, Thinking
from usd2kg.cli.output import Progress, count_noun, emit, notify
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation import CellResult, Matrix
    from usd2kg.grounding.llm.factory import LLMSettings

__all__ = ["MatrixModelOptions", "reproduce_command"]


@dataclass(frozen=True)
class MatrixModelOptions(RequestLimits):
    """Requests, prompts and sampling of all language models of a matrix."""

    objects_per_prompt: ObjectsPerPrompt = None
    thinking: Thinking = False
    temperature: Temperature = None

    def settings(self, model: str) -> "LLMSettings":
        """Return the settings of a model string."""
        return replace(
            super().settings(model),
            objects_per_prompt=self.objects_per_prompt,
            is_thinking=self.thinking,
            temperature=self.temperature,
        )


@expand_bundles
def reproduce_command(
    study: StudyOptions,
    asked: MatrixModelOptions,
    matrix: Annotated[
        Path | None, Argument(metavar="MATRIX", help="TOML file, see docs/evaluation.md; none with --study.")
    ] = None,
    output: ReportFolder = Path("results"),
    refresh: Annotated[
        bool, Option("--refresh", help="Compute every result again; default: use stored results.")
    ] = False,
) -> None:
    """Evaluate scenes × grounders × regimes × ablations and write tables, plots and a report.

    Results and completions are stored, so an interrupted run resumes. Results without all answers of a model are
    computed again. --study runs the matrix of the study on the demo kitchen or another scene, and prints published and
    measured figures side by side.
    """
    from usd2kg import evaluation  # noqa: PLC0415 - loads OpenUSD, too slow for --help
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415
    from usd2kg.grounding.llm.batch_jobs.queue import Reporting  # noqa: PLC0415

    plan = _plan(matrix, study)
    if not plan.language_models:
        asked.check_without_model(f"name one with {'--model MODEL' if study.study else 'a grounder llm-B:MODEL'}")
    for scene in plan.scenes:
        if scene.missing is not None:
            notify(f"{scene.name} is skipped: {scene.missing} does not exist")
    once = [name for name in plan.grounders if name not in plan.language_models]
    if plan.repeats > 1 and once:
        notify(f"{', '.join(once)}: run once instead of {plan.repeats} times, since the answers are always the same")
    total = sum(1 for cell in plan.cells() if cell.scene.missing is None)
    with Progress() as progress:
        results = evaluation.run_matrix(
            plan,
            output,
            settings=_settings(asked, study) if plan.language_models else None,
            refresh=refresh,
            progress=_report(total, progress),
            model_progress=progress.update,
            reporting=Reporting(progress.say, progress.show),
        )
    if not results:
        raise EvaluationError(f"{matrix}: none of its scenes exists; correct the paths")
    if study.study:
        emit(study_text(results))
    for path in write_report(results, plan.title, output):
        emit(f"{path}\n")
    _check_complete([cell for result in results for cell in result.cells])


def _plan(matrix: Path | None, study: StudyOptions) -> "Matrix":
    """Return the matrix of a file, or that of the study.

    Raises:
        EvaluationError: both or neither are given, or the matrix is invalid.
    """
    from usd2kg.evaluation import read_matrix  # noqa: PLC0415

    if study.study:
        if matrix is not None:
            raise EvaluationError(f"{matrix}: --study has its own matrix; leave out one of the two")
        return plan_study_matrix(study)
    study.check_unused()
    if matrix is None:
        raise EvaluationError("no matrix is given; expected MATRIX, a TOML file, or --study")
    return read_matrix(matrix)


def _settings(asked: MatrixModelOptions, study: StudyOptions) -> "LLMSettings":
    """Return the settings of all language models of a matrix; the study asks about each prim."""
    return replace(asked.settings(""), is_each_object=study.study)


def _check_complete(cells: "Sequence[CellResult]") -> None:
    """Check that no grounder failed on an object.

    Raises:
        EvaluationError: a grounder failed; the message contains the reason.
    """
    incomplete = [cell.failures for cell in cells if cell.failures]
    if incomplete:
        reason, answers = incomplete[0][0], sum(map(len, incomplete))
        raise EvaluationError(
            f"{len(incomplete)} of {len(cells)} results lack {answers} answers ({reason}); in the report, these "
            "objects count as wrong; run the same command again to complete them"
        )


def _report(total: int, progress: Progress) -> "Callable[[CellResult], None]":
    """Return a function that prints a result with its number of `total`."""
    numbers = count(1)

    def report(result: "CellResult") -> None:
        cell, summary = result.cell, result.evaluation.summary
        stored = " (stored)" if result.was_stored else ""
        figures = f"EMA {summary.ema:.1f} HF1 {summary.hf1:.2f}"
        failed = f" ({count_noun(len(result.failures), 'object')} failed)" if result.failures else ""
        progress.say(
            f"[{next(numbers)}/{total}] {cell.scene.name}, {cell.method}, {cell.condition}: {figures}{stored}{failed}"
        )

    return report
