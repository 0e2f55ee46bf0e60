"""Read the result files of single runs."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.errors import EvaluationError
from usd2kg.evaluation.score import Score
from usd2kg.grounding import Status

__all__ = ["StoredRun", "read_run"]


@dataclass(frozen=True)
class StoredRun:
    """A run that `usd2kg eval run --output` wrote."""

    source: str
    ontology_hash: str
    description: str
    """Grounder, its language model and strategy if any, naming regime and evidence in one line."""
    scores: tuple[Score, ...]
    missed: frozenset[str]
    """Prim paths of the labelled objects that the object selection misses."""


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
            ontology_hash=data["ontology_hash"],
            description=f"{_grounder(data)}, {settings['regime']} names, evidence {settings['evidence']}",
            scores=tuple(_score(item) for item in data["scores"]),
            missed=frozenset(data.get("selection", {"missed": ()})["missed"]),
        )
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise EvaluationError(
            f"{path}: cannot be read as a run ({type(error).__name__}: {error}); "
            "expected JSON written by usd2kg eval run --output"
        ) from error


def _grounder(data: dict[str, Any]) -> str:
    settings = data["settings"]
    asked = f", {settings['model']}, strategy {settings['strategy']}" if "model" in settings else ""
    return f"{data['grounder']}{asked}"


def _score(item: dict[str, Any]) -> Score:
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
