"""The results that the study published, for comparison."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

from usd2kg.knowledge import read_rows

__all__ = ["AS_PUBLISHED", "PublishedResult", "published_ablation", "published_main"]

AS_PUBLISHED = "as published, another scene (Kitchen Set, n = 125)"
"""Caveat printed next to the published results, which are not directly comparable."""


@dataclass(frozen=True, slots=True)
class PublishedResult:
    """One cell of the study's tables."""

    ema: float | None
    """Exact match, percent; None if the run failed."""
    hf1: float | None
    """Hierarchical F1, 0 to 1; None if the run failed, and in the ablation, which has none."""
    note: str
    """`fail` if the model's output degenerated, else empty."""


def published_main() -> Mapping[str, Mapping[str, PublishedResult]]:
    """Return method → naming regime → result, in the study's order.

    >>> published_main()["S-BERT"]["abbreviated"]
    PublishedResult(ema=14.0, hf1=0.52, note='')
    """
    return _read("main")


def published_ablation() -> Mapping[str, Mapping[str, PublishedResult]]:
    """Return method → condition → result; all with strategy B under opaque names.

    >>> published_ablation()["Gemini 3 Flash B"]["hierarchy only"].ema
    54.0
    """
    return _read("ablation")


@lru_cache(maxsize=2)
def _read(table: str) -> Mapping[str, Mapping[str, PublishedResult]]:
    found: dict[str, dict[str, PublishedResult]] = {}
    for row in read_rows("study_results.csv"):
        if row["table"] == table:
            result = PublishedResult(_number(row["ema"]), _number(row["hf1"]), row["note"])
            found.setdefault(row["method"], {})[row["condition"]] = result
    return found


def _number(text: str) -> float | None:
    return float(text) if text else None
