"""Running a matrix: resumable, and no answer is asked for twice."""

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
from usd2kg.evaluation.metrics.selection import SelectionScore
from usd2kg.evaluation.run import Evaluation, evaluate, score_grounding, selection_of
from usd2kg.files import write_whole
from usd2kg.grounding import Grounder, format_mapping, make_grounder, read_grounding
from usd2kg.ontology import TBox, load_home_tbox, load_tbox
from usd2kg.scene import Scene, read_scene

__all__ = ["CellResult", "SceneResult", "run_matrix"]

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class CellResult:
    """One run that was done, or done before."""

    cell: Cell
    evaluation: Evaluation
    was_stored: bool
    """Whether the answers came from an earlier, maybe interrupted, run."""


@dataclass(frozen=True)
class SceneResult:
    """All runs on one scene."""

    spec: SceneSpec
    scene: Scene
    tbox: TBox
    gold: tuple[GoldLabel, ...]
    selection: SelectionScore
    cells: tuple[CellResult, ...]


def run_matrix(
    matrix: Matrix, folder: Path, *, refresh: bool = False, progress: Callable[[CellResult], None] | None = None
) -> list[SceneResult]:
    """Return the results of all cells, scene by scene; answers are stored in `folder/runs` as they come.

    Args:
        matrix: what to run. Optional scenes whose files are absent are left out.
        folder: where answers are stored; cells whose answers are there already are only scored again.
        refresh: ask again, whatever is stored.
        progress: called after each cell.
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
            logger.warning("%s is left out: %s does not exist", spec.name, spec.missing)
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
    return SceneResult(spec, scene, tbox, gold, selection_of(scene, gold), tuple(done))


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
    write_whole(timing, repr(evaluation.seconds).encode())
    write_whole(store, format_mapping(evaluation.grounding, tbox, "json").encode())
    return CellResult(cell, evaluation, was_stored=False)


def _key(cell: Cell, scene: Scene, gold: tuple[GoldLabel, ...], tbox: TBox, grounder: Grounder) -> str:
    """Return what the answers depend on, as a name for a file."""
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
    """Return a digest of the code and data that answers come from: other code, other answers."""
    digest = hashlib.sha256()
    root = Path(str(files("usd2kg")))
    for path in _sources(root):
        digest.update(str(path.relative_to(root)).encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _sources(root: Path) -> Iterator[Path]:
    for package in ("data", "grounding", "ontology", "scene"):
        yield from sorted(path for path in (root / package).rglob("*") if path.is_file() and path.suffix != ".pyc")
    yield from (root / name for name in ("knowledge.py", "languages.py", "words.py"))
