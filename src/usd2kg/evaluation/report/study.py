"""The figures that the study published, to stand beside ours."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from usd2kg.knowledge import read_rows

__all__ = ["AS_PUBLISHED", "StudyFigure", "study_ablation", "study_main"]

AS_PUBLISHED = "as published, another scene (Kitchen Set, n = 125)"
"""What heads the study's figures wherever they stand: they are not comparable one to one."""


@dataclass(frozen=True, slots=True)
class StudyFigure:
    """One cell of the study's tables."""

    ema: float | None
    """Exact match, percent; None where the run failed."""
    hf1: float | None
    """Hierarchical F1, 0 to 1; None where the run failed, and in the ablation, which has none."""
    note: str
    """`fail` where the model's output degenerated; else empty."""


def study_main() -> Mapping[str, Mapping[str, StudyFigure]]:
    """Return method → naming regime → figure, in the study's order.

    >>> study_main()["S-BERT"]["abbreviated"]
    StudyFigure(ema=14.0, hf1=0.52, note='')
    """
    return _read("main")


def study_ablation() -> Mapping[str, Mapping[str, StudyFigure]]:
    """Return method → condition → figure; all with strategy B under opaque names.

    >>> study_ablation()["Gemini 3 Flash B"]["hierarchy only"].ema
    54.0
    """
    return _read("ablation")


@lru_cache(maxsize=2)
def _read(table: str) -> Mapping[str, Mapping[str, StudyFigure]]:
    found: dict[str, dict[str, StudyFigure]] = {}
    for row in read_rows("study_results.csv"):
        if row["table"] == table:
            figure = StudyFigure(_number(row["ema"]), _number(row["hf1"]), row["note"])
            found.setdefault(row["method"], {})[row["condition"]] = figure
    return found


def _number(text: str) -> float | None:
    return float(text) if text else None
