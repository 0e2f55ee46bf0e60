"""Run a matrix. Answers are stored, so that an interrupted run resumes."""

import hashlib
import json
import logging
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from usd2kg.evaluation.gold import GoldLabel, check_gold, read_gold
from usd2kg.evaluation.matrix import Cell, Matrix, SceneSpec
from usd2kg.evaluation.matrix_grounders import MatrixGrounders, open_grounders
from usd2kg.evaluation.metrics.selection_scores import SelectionScore
from usd2kg.evaluation.model_cost import ModelCost
from usd2kg.evaluation.recording import RECORDING, restore_recording, write_recording
from usd2kg.evaluation.run import Evaluation, evaluate, score_grounding, score_scene_selection
from usd2kg.files import write_whole
from usd2kg.grounding import Grounder, Status, format_mapping, read_grounding
from usd2kg.ontology import TBox, load_home_tbox, load_tbox
from usd2kg.scene import Scene, read_scene

if TYPE_CHECKING:
    from usd2kg.grounding.llm.batch_jobs.queue import Reporting
    from usd2kg.grounding.llm.factory import LLMSettings

__all__ = ["CellResult", "SceneResult", "run_matrix"]

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class CellResult:
    """The result of one run."""

    cell: Cell
    evaluation: Evaluation
    was_stored: bool
    """Whether the answers were read from a file instead of computed."""
    cost: ModelCost | None = None
    """Tokens and dollars of a language model; None if the run uses none."""

    @property
    def failures(self) -> tuple[str, ...]:
        """The reason for each object that the grounder failed on, such as a server that was down."""
        return tuple(score.explanation for score in self.evaluation.scores if score.status is Status.FAILED)


@dataclass(frozen=True)
class SceneResult:
    """The results of all runs on one scene."""

    spec: SceneSpec
    scene: Scene
    tbox: TBox
    gold: tuple[GoldLabel, ...]
    selection: SelectionScore
    cells: tuple[CellResult, ...]


def run_matrix(
    matrix: Matrix,
    folder: Path | str,
    *,
    settings: "LLMSettings | None" = None,
    refresh: bool = False,
    progress: Callable[[CellResult], None] | None = None,
    model_progress: Callable[[int, int], None] | None = None,
    reporting: "Reporting | None" = None,
) -> list[SceneResult]:
    """Return the results of all runs, scene by scene.

    The answers of each run are stored in `folder/runs` when the run ends, unless the grounder failed on an object: such
    a run is repeated the next time. Runs with stored answers are only scored. The completions of language models are
    recorded in `folder/recording.jsonl.gz`, and those of an earlier recording there are reused.

    Args:
        matrix: the runs. Optional scenes with missing files are skipped.
        folder: folder for the answers.
        settings: settings of the language models, except for model and strategy; None for the defaults. All runs share
            the budget.
        refresh: ignore stored answers.
        progress: called after each run.
        model_progress: called with the number of objects that a language model has completed and the total of a run.
        reporting: callbacks for the progress of batch jobs; None for log messages.

    Raises:
        Usd2kgError: a scene, its gold labels or a model cannot be opened.
    """
    folder = Path(folder)
    (folder / "runs").mkdir(parents=True, exist_ok=True)
    by_scene: dict[SceneSpec, list[Cell]] = {}
    for cell in matrix.cells():
        by_scene.setdefault(cell.scene, []).append(cell)
    if matrix.language_models:
        restore_recording(folder, settings)
    results, skipped = [], False
    with open_grounders(matrix, settings, model_progress, reporting) as grounders:
        runner = _Runner(grounders, folder, refresh, progress)
        if settings is not None and settings.is_batched:
            runner.complete_prompts(cell for cells in by_scene.values() for cell in cells)
        for spec, cells in by_scene.items():
            if spec.missing is not None:
                logger.warning("scene %s skipped: %s does not exist", spec.name, spec.missing)
                skipped = True
                continue
            results.append(runner.run_scene(spec, cells))
    keys = {key for result in results for done in result.cells if done.cost for key in done.cost.keys}
    # Keep a recording of more scenes, from a machine that has their files.
    if keys and not (skipped and (folder / RECORDING).exists()):
        write_recording(folder, settings, keys)
    return results


class _Inputs(NamedTuple):
    """Inputs shared by the runs on a scene."""

    scene: Scene
    gold: tuple[GoldLabel, ...]
    tbox: TBox
    selection: SelectionScore


@dataclass(frozen=True)
class _Runner:
    """Runs cells, or reads their stored answers."""

    grounders: MatrixGrounders
    folder: Path
    refresh: bool
    progress: Callable[[CellResult], None] | None
    read: dict[SceneSpec, _Inputs] = field(default_factory=dict)
    """The inputs of the scenes that have been read."""

    def complete_prompts(self, cells: Iterable[Cell]) -> None:
        """Complete the prompts of all runs in common batch jobs, so that there is a single wait.

        A second round completes the repair prompts, which depend on answers.
        """
        planned = [cell for cell in cells if self.grounders.model(cell) is not None and cell.scene.missing is None]
        while True:
            for cell in planned:
                self._plan_cell(cell)
            submitting = [model for model in self.grounders.models.values() if model.submit_deferred()]
            if not submitting:
                return
            for model in submitting:
                model.collect_deferred()

    def _plan_cell(self, cell: Cell) -> None:
        """Defer the uncached prompts of a run."""
        model, inputs = self.grounders.model(cell), self._read(cell.scene)
        grounder = self.grounders.grounder(cell)
        if model is None or (not self.refresh and self._store(cell, inputs, grounder).exists()):
            return
        with model.planning():
            evaluate(inputs.scene, inputs.gold, inputs.tbox, grounder, regime=cell.regime, evidence=cell.evidence)

    def _read(self, spec: SceneSpec) -> _Inputs:
        if spec not in self.read:
            tbox = load_tbox(spec.ontology) if spec.ontology else load_home_tbox()
            gold = read_gold(spec.gold, tbox)
            scene = read_scene(spec.path, paths=[label.prim_path for label in gold])
            check_gold(spec.gold, gold, scene)
            self.read[spec] = _Inputs(scene, gold, tbox, score_scene_selection(scene, gold))
        return self.read[spec]

    def _store(self, cell: Cell, inputs: _Inputs, grounder: Grounder) -> Path:
        return self.folder / "runs" / f"{_key(cell, inputs, grounder, self.grounders.price)}.json"

    def run_scene(self, spec: SceneSpec, cells: list[Cell]) -> SceneResult:
        inputs = self._read(spec)
        done = []
        for cell in cells:
            result = self._run_cell(cell, inputs)
            done.append(result)
            if self.progress is not None:
                self.progress(result)
        return SceneResult(spec, inputs.scene, inputs.tbox, inputs.gold, inputs.selection, tuple(done))

    def _run_cell(self, cell: Cell, inputs: _Inputs) -> CellResult:
        grounder, model = self.grounders.grounder(cell), self.grounders.model(cell)
        store = self._store(cell, inputs, grounder)
        if not self.refresh and (stored := _read_stored(cell, inputs, store)) is not None:
            return stored
        if model is not None:
            model.restart_report()
        evaluation = evaluate(
            inputs.scene, inputs.gold, inputs.tbox, grounder, regime=cell.regime, evidence=cell.evidence
        )
        if model is not None and model.report.is_interrupted:
            # The grounder ends an interrupted run with failures; later runs must not start.
            raise KeyboardInterrupt
        cost = ModelCost.from_report(model.report) if model is not None else None
        result = CellResult(cell, evaluation, was_stored=False, cost=cost)
        if not result.failures:
            _store(result, inputs.tbox, store)
        return result


def _cost_file(store: Path) -> Path:
    return store.with_suffix(".cost.json")


def _read_stored(cell: Cell, inputs: _Inputs, store: Path) -> CellResult | None:
    """Return the result whose answers are in a file; None if there is none."""
    if not store.exists() or not _cost_file(store).exists():
        return None
    try:
        data = json.loads(_cost_file(store).read_text("utf-8"))
        seconds = float(data["seconds"])
        cost = ModelCost.from_json(data["model"]) if data["model"] is not None else None
    except (ValueError, TypeError, KeyError):
        # The file is truncated or was written by another version.
        return None
    grounding = read_grounding(store)
    evaluation = score_grounding(grounding, inputs.gold, inputs.tbox, seconds, missed=inputs.selection.missed)
    return CellResult(cell, evaluation, was_stored=True, cost=cost)


def _store(result: CellResult, tbox: TBox, store: Path) -> None:
    cost = {"seconds": result.evaluation.seconds, "model": result.cost.as_json() if result.cost else None}
    write_whole(_cost_file(store), json.dumps(cost, indent=1).encode())
    write_whole(store, format_mapping(result.evaluation.grounding, tbox, "json").encode())


def _key(cell: Cell, inputs: _Inputs, grounder: Grounder, price: str) -> str:
    """Return a file name: a hash of everything that the answers and their cost depend on."""
    evidence = ",".join(sorted(cell.evidence)) if cell.evidence is not None else "all"
    parts = [
        inputs.scene.content_hash,
        inputs.tbox.content_hash,
        json.dumps([label.prim_path for label in inputs.gold]),
        grounder.name,
        json.dumps(dict(grounder.settings), sort_keys=True),
        cell.regime.value,
        evidence,
        price,
        _code_digest(),
    ]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:32]


@lru_cache(maxsize=1)
def _code_digest() -> str:
    """Return a hash of the code and data that determine the answers."""
    digest = hashlib.sha256()
    root = Path(str(files("usd2kg")))
    for path in _sources(root):
        digest.update(str(path.relative_to(root)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _sources(root: Path) -> Iterator[Path]:
    for package in ("data", "grounding", "languages", "ontology", "render", "scene", "shapes"):
        yield from sorted(path for path in (root / package).rglob("*") if path.is_file() and path.suffix != ".pyc")
    yield from (root / name for name in ("knowledge.py", "words.py"))
