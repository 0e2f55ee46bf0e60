"""The options of eval reproduce --study, and usd2kg eval kitchen-set."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from usd2kg.cli.options.bundles import OptionBundle
from usd2kg.cli.options.common import OntologyFile
from usd2kg.cli.options.model import ModelName
from usd2kg.cli.output import count_noun, emit, notify
from usd2kg.cli.text_table import format_table
from usd2kg.errors import EvaluationError

if TYPE_CHECKING:
    from usd2kg.evaluation import Matrix, SceneResult
    from usd2kg.evaluation.matrix import SceneSpec

__all__ = ["StudyOptions", "kitchen_set_command", "plan_study_matrix", "study_text"]


@dataclass(frozen=True)
class StudyOptions(OptionBundle):
    """The matrix of the study: its model and its scene."""

    study: Annotated[
        bool,
        Option(
            "--study",
            help="Run the matrix of the study instead of a file: its baselines and, with --model, its strategies A, B "
            "and C under all naming regimes, and its ablation.",
        ),
    ] = False
    model: ModelName = None
    scene: Annotated[
        Path | None, Option("--scene", help="Scene for --study, with --gold; default: the demo kitchen.")
    ] = None
    gold: Annotated[
        Path | None, Option("--gold", help="Gold labels of --scene or --kitchen-set: CSV path,class,also.")
    ] = None
    kitchen_set: Annotated[
        Path | None,
        Option("--kitchen-set", help="Folder of the unpacked Kitchen Set of Pixar for --study, with --gold."),
    ] = None
    ontology: OntologyFile = None

    def check_unused(self) -> None:
        """Check that no option is given that only affects the study's matrix.

        Raises:
            EvaluationError: such an option is given.
        """
        given = {
            "--model": self.model,
            "--scene": self.scene,
            "--gold": self.gold,
            "--kitchen-set": self.kitchen_set,
            "--ontology": self.ontology,
        }
        for option, value in given.items():
            if value is not None:
                raise EvaluationError(f"{option} {value}: requires --study; a matrix file contains this setting")


def plan_study_matrix(options: StudyOptions) -> "Matrix":
    """Return the study's matrix; baselines that are not installed are reported on stderr.

    Raises:
        EvaluationError: the options do not name one scene with gold labels, or a file is missing.
    """
    from usd2kg.evaluation.study import find_unavailable_baselines, plan_study  # noqa: PLC0415

    scene = _scene(options)
    if scene.missing is not None:
        raise EvaluationError(f"{scene.missing}: no such file; correct the path")
    unavailable = find_unavailable_baselines()
    for name, reason in unavailable.items():
        notify(f"the baseline {name} is skipped: {reason}")
    return plan_study(scene, options.model, without=frozenset(unavailable))


def _scene(options: StudyOptions) -> "SceneSpec":
    from usd2kg.demo import demo_gold, demo_scene  # noqa: PLC0415
    from usd2kg.evaluation.kitchen_set import check_kitchen_set, kitchen_scene  # noqa: PLC0415
    from usd2kg.evaluation.matrix import SceneSpec  # noqa: PLC0415

    path = options.scene or options.kitchen_set
    if options.scene is not None and options.kitchen_set is not None:
        raise EvaluationError("--scene and --kitchen-set exclude each other; leave out one of them")
    if path is None and options.gold is not None:
        raise EvaluationError(f"{options.gold}: --gold needs a scene; give it with --scene or --kitchen-set")
    if path is None:
        return SceneSpec("Demo kitchen", demo_scene(), demo_gold(), options.ontology, "made for this project", False)
    if options.gold is None:
        raise EvaluationError(
            f"{path}: has no gold labels; label it with usd2kg eval annotate, and pass them with --gold"
        )
    if options.kitchen_set is not None:
        return kitchen_scene(check_kitchen_set(options.kitchen_set), options.gold, options.ontology)
    return SceneSpec(path.stem, path, options.gold, options.ontology, "labelled by the user", False)


def study_text(results: "list[SceneResult]") -> str:
    """Return the study's tables as text: published and measured figures, classes of errors, cost."""
    from usd2kg.evaluation.report.study_tables import (  # noqa: PLC0415
        comparison_table,
        cost_table,
        error_classes_table,
    )

    tables = [*map(comparison_table, results), *map(error_classes_table, results), cost_table(results)]
    return "".join(
        f"{table.title}\n{format_table(table.columns, table.rows)}{table.note}\n\n" for table in tables if table
    )


def kitchen_set_command(
    folder: Annotated[Path, Argument(metavar="PATH", help="Folder of the unpacked Kitchen Set.")],
) -> None:
    """Check a download of Pixar's Kitchen Set, and list the objects that best approximate those of the study.

    These are the selected objects that have geometry and are not inside another object.
    """
    from usd2kg.evaluation.kitchen_set import check_kitchen_set, study_objects  # noqa: PLC0415
    from usd2kg.evaluation.study import STUDY_OBJECTS  # noqa: PLC0415
    from usd2kg.scene import read_scene  # noqa: PLC0415

    found = check_kitchen_set(folder)
    scene = read_scene(found.root)
    listed = study_objects(scene)
    notify(
        f"{found.root}: {found.layer_count} layers, {count_noun(len(scene.objects), 'object')}, "
        f"{len(listed)} of them with geometry and not inside another object (the study has {STUDY_OBJECTS})"
    )
    emit("".join(f"{obj.prim_path}\n" for obj in listed))
    notify("label these objects with usd2kg eval annotate; then run usd2kg eval reproduce --study --kitchen-set --gold")
