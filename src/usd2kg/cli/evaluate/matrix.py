"""usd2kg eval reproduce, eval kitchen-set: whole studies, with reports."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from usd2kg.cli.options import OntologyFile
from usd2kg.cli.output import emit, talk
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation import CellResult

__all__ = ["kitchen_set_command", "reproduce_command"]


def reproduce_command(
    matrix: Annotated[Path, typer.Argument(metavar="MATRIX", help="A TOML file; see docs/evaluation.md.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder for answers and reports.")] = Path("results"),
    refresh: Annotated[bool, typer.Option("--refresh", help="Ask again, whatever is stored.")] = False,
) -> None:
    """Run scenes × grounders × regimes × ablations and write tables, plots and a report.

    It resumes after an interruption and asks for no answer twice.
    """
    from usd2kg import evaluation  # noqa: PLC0415
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415

    plan = evaluation.read_matrix(matrix)
    total = sum(1 for cell in plan.cells() if cell.scene.missing is None)
    for scene in plan.scenes:
        if scene.missing is not None:
            talk(f"{scene.name} is left out: {scene.missing} does not exist")
    done = 0

    def tell(result: "CellResult") -> None:
        nonlocal done
        done += 1
        cell, summary = result.cell, result.evaluation.summary
        stored = " (stored)" if result.was_stored else ""
        figures = f"EMA {summary.ema:.1f} HF1 {summary.hf1:.2f}"
        talk(f"[{done}/{total}] {cell.scene.name}, {cell.grounder}, {cell.condition}: {figures}{stored}")

    results = evaluation.run_matrix(plan, output, refresh=refresh, progress=tell)
    if not results:
        raise EvaluationError(f"{matrix}: no scene of it is here; mend the paths")
    for path in write_report(results, plan.title, output):
        emit(f"{path}\n", None)


def kitchen_set_command(
    folder: Annotated[Path, typer.Argument(metavar="PATH", help="Where your download of the Kitchen Set is unpacked.")],
    gold: Annotated[
        Path | None, typer.Option("--gold", help="Your gold labels; without them, only check and list the objects.")
    ] = None,
    ontology: OntologyFile = None,
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder for answers and reports.")] = Path(
        "kitchen_set_results"
    ),
) -> None:
    """Check your download of Pixar's Kitchen Set, and run the study's matrix on it with your gold labels."""
    from usd2kg.evaluation import run_matrix  # noqa: PLC0415
    from usd2kg.evaluation.kitchen_set import check_kitchen_set, kitchen_matrix  # noqa: PLC0415
    from usd2kg.evaluation.report import write_report  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    found = check_kitchen_set(folder)
    scene = read_scene(found.root)
    talk(f"{found.root}: {found.layer_count} layers, {len(scene.objects)} objects (the study has 125)")
    if gold is None:
        emit("".join(f"{obj.prim_path}\n" for obj in scene.objects), None)
        talk("label them with usd2kg eval annotate, then come back with --gold")
        return
    plan = kitchen_matrix(found, gold, ontology)
    for path in write_report(run_matrix(plan, output), plan.title, output):
        emit(f"{path}\n", None)
