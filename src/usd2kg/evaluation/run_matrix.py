"""Run a matrix. Answers are stored, so that an interrupted run resumes."""

import hashlib
import json
import logging
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from pathlib import Path

from usd2kg.evaluation.gold import GoldLabel, read_gold
from usd2kg.evaluation.matrix import Cell, Matrix, SceneSpec
from usd2kg.evaluation.metrics.selection_scores import SelectionScore
from usd2kg.evaluation.run import Evaluation, evaluate, score_grounding, score_scene_selection
from usd2kg.files import write_whole
from usd2kg.grounding import Grounder, Status, format_mapping, make_grounder, read_grounding
from usd2kg.ontology import TBox, load_home_tbox, load_tbox
from usd2kg.scene import Scene, read_scene

__all__ = ["CellResult", "SceneResult", "run_matrix"]

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class CellResult:
    """The result of one run."""

    cell: Cell
    evaluation: Evaluation
    was_stored: bool
    """Whether the answers were read from a file, not computed."""

    @property
    def failures(self) -> tuple[str, ...]:
        """For each object that the grounder failed on, why: for instance, a server was down."""
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
    matrix: Matrix, folder: Path, *, refresh: bool = False, progress: Callable[[CellResult], None] | None = None
) -> list[SceneResult]:
    """Return the results of all runs, scene by scene.

    The answers of each run are stored in `folder/runs` when the run ends, unless the grounder failed on an object: such
    a run is repeated the next time. Runs with stored answers are only scored.

    Args:
        matrix: the runs. Optional scenes with missing files are skipped.
        folder: where answers are stored.
        refresh: ignore stored answers.
        progress: called after each run.
    """
    (folder / "runs").mkdir(parents=True, exist_ok=True)
    grounders = {name: make_grounder(name) for name in matrix.grounders}
    by_scene: dict[str, list[Cell]] = {}
    for cell in matrix.cells():
        by_scene.setdefault(cell.scene.name, []).append(cell)
    results = []
    for cells in by_scene.values():
        spec = cells[0].scene
        if spec.missing is not None:
            logger.warning("scene %s skipped: %s does not exist", spec.name, spec.missing)
            continue
        results.append(_run_scene(spec, cells, grounders, folder, refresh, progress))
    return results


def _run_scene(
    spec: SceneSpec,
    cells: list[Cell],
    grounders: dict[str, Grounder],
    folder: Path,
    refresh: bool,
    progress: Callable[[CellResult], None] | None,
) -> SceneResult:
    tbox = load_tbox(spec.ontology) if spec.ontology else load_home_tbox()
    gold = read_gold(spec.gold, tbox)
    scene = read_scene(spec.path, paths=[label.prim_path for label in gold])
    done = []
    for cell in cells:
        result = _run_cell(cell, scene, gold, tbox, grounders[cell.grounder], folder, refresh)
        done.append(result)
        if progress is not None:
            progress(result)
    return SceneResult(spec, scene, tbox, gold, score_scene_selection(scene, gold), tuple(done))


def _run_cell(
    cell: Cell,
    scene: Scene,
    gold: tuple[GoldLabel, ...],
    tbox: TBox,
    grounder: Grounder,
    folder: Path,
    refresh: bool,
) -> CellResult:
    store = folder / "runs" / f"{_key(cell, scene, gold, tbox, grounder)}.json"
    timing = store.with_suffix(".seconds")
    if store.exists() and timing.exists() and not refresh:
        evaluation = score_grounding(read_grounding(store), gold, tbox, float(timing.read_text("utf-8")))
        return CellResult(cell, evaluation, was_stored=True)
    evaluation = evaluate(scene, gold, tbox, grounder, regime=cell.regime, evidence=cell.evidence)
    result = CellResult(cell, evaluation, was_stored=False)
    if result.failures:
        return result
    write_whole(timing, repr(evaluation.seconds).encode())
    write_whole(store, format_mapping(evaluation.grounding, tbox, "json").encode())
    return result


def _key(cell: Cell, scene: Scene, gold: tuple[GoldLabel, ...], tbox: TBox, grounder: Grounder) -> str:
    """Return a file name: a hash of everything that the answers depend on."""
    evidence = ",".join(sorted(cell.evidence)) if cell.evidence is not None else "all"
    parts = [
        scene.content_hash,
        tbox.content_hash,
        json.dumps([label.prim_path for label in gold]),
        grounder.name,
        json.dumps(dict(grounder.settings), sort_keys=True),
        cell.regime.value,
        evidence,
        str(cell.repeat),
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
