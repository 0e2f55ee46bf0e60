"""Read the result files of single runs, and check that two of them can be compared."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.score import Score
from usd2kg.grounding import Status
from usd2kg.ontology import local_name

__all__ = ["StoredRun", "check_comparable", "describe_runs", "read_run"]

_DESCRIBED = frozenset({"model", "strategy", "regime", "evidence"})
"""The settings in `StoredRun.description`."""


@dataclass(frozen=True)
class StoredRun:
    """A run that `usd2kg eval run --output` wrote."""

    source: str
    """The file of the run."""
    scene: str
    scene_hash: str
    ontology_hash: str
    grounder: str
    regime: str
    evidence: str
    settings: Mapping[str, str]
    """Naming regime, evidence and the settings of the grounder."""
    is_calibrated: bool
    scores: tuple[Score, ...]
    missed: frozenset[str]
    """Prim paths of the labelled objects that the object selection misses."""

    @property
    def asks_model(self) -> bool:
        """Whether a language model was asked, alone or in a cascade."""
        return "strategy" in self.settings

    @property
    def description(self) -> str:
        """Grounder, its language model and strategy if any, naming regime and evidence in one line."""
        asked = f", {self.settings['model']}, strategy {self.settings['strategy']}" if self.asks_model else ""
        return f"{self.grounder}{asked}, {self.regime} names, evidence {self.evidence}"


def read_run(path: Path) -> StoredRun:
    """Return the run in a JSON file.

    Raises:
        EvaluationError: the file is unreadable or malformed.
    """
    try:
        data = json.loads(path.read_text("utf-8"))
        settings = data["settings"]
        return StoredRun(
            source=str(path),
            scene=data["scene"],
            scene_hash=data["scene_hash"],
            ontology_hash=data["ontology_hash"],
            grounder=data["grounder"],
            regime=settings["regime"],
            evidence=settings["evidence"],
            settings=settings,
            is_calibrated=data["is_calibrated"],
            scores=tuple(_score(item) for item in data["scores"]),
            missed=frozenset(data.get("selection", {"missed": ()})["missed"]),
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise EvaluationError(
            f"{path}: cannot be read as a run ({type(error).__name__}: {error}); "
            "expected JSON written by usd2kg eval run --output"
        ) from error


def describe_runs(runs: Sequence[StoredRun]) -> list[str]:
    """Return the description of each run with all further settings in which the runs differ."""
    keys = sorted({key for run in runs for key in run.settings} - _DESCRIBED)
    differing = [key for key in keys if len({run.settings.get(key) for run in runs}) > 1]
    # A setting that a run of the same grounder lacks has its default there.
    known = {(run.grounder, key) for run in runs for key in run.settings}
    shown = [
        [f"{key} {run.settings.get(key, 'default')}" for key in differing if (run.grounder, key) in known]
        for run in runs
    ]
    return [", ".join((run.description, *settings)) for run, settings in zip(runs, shown, strict=True)]


def check_comparable(first: StoredRun, second: StoredRun) -> None:
    """Check that two runs are answers to the same question: same ontology, scene and gold labels.

    Raises:
        EvaluationError: they differ, or have no object in common.
    """
    both = f"{first.source} and {second.source}"
    if first.ontology_hash != second.ontology_hash:
        raise EvaluationError(f"{both} used different ontologies; compare runs on the same one")
    if first.scene_hash != second.scene_hash:
        raise EvaluationError(
            f"{both} used different scenes, or versions of a scene: {first.scene} and {second.scene}; compare runs on "
            "the same one"
        )
    others = {score.id: score for score in second.scores}
    pairs = [(score, others[score.id]) for score in first.scores if score.id in others]
    if not pairs:
        raise EvaluationError(f"{both} have no object in common; compare runs with the same gold labels")
    # Second labels may differ: the comparison is of exact matches.
    relabelled = [(one, other) for one, other in pairs if one.target != other.target]
    if relabelled:
        one, other = relabelled[0]
        raise EvaluationError(
            f"{both} have different gold labels for {len(relabelled)} of {len(pairs)} objects, {one.id} for one: "
            f"{local_name(one.target)} and {local_name(other.target)}; evaluate both with the same gold file"
        )


def _score(item: Mapping[str, Any]) -> Score:
    return Score(
        id=item["path"],
        name=item["path"].rpartition("/")[2],
        target=item["target"],
        also=frozenset(item["also"]),
        answer=item["answer"],
        confidence=item["confidence"],
        status=Status(item["status"]),
        explanation=item["explanation"],
    )
