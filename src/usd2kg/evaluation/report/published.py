"""The results that the study published, for comparison."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from usd2kg.grounding import is_llm_name
from usd2kg.knowledge import read_rows

__all__ = [
    "AS_PUBLISHED",
    "Counterpart",
    "PublishedResult",
    "find_counterpart",
    "published_ablation",
    "published_condition",
    "published_main",
]

AS_PUBLISHED = "as published, Kitchen Set with other labels (n = 125)"
"""Caveat printed next to the published results, which are not directly comparable."""


_BASELINES = {"dictionary": "Multiverse", "volume": "LV-NN", "embedding": "S-BERT"}
"""Grounder → name of the method in the study."""
_MODELS = {
    r"gemini-2\.5-flash(?!-lite|-image)": "Gemini 2.5 Flash",
    r"gemini-3-flash(?!-lite|-image)": "Gemini 3 Flash",
    r"qwen-?3\.5-27b": "Qwen 3.5-27B",
}
"""Pattern of a model string → name of the model in the study."""
_MODES = {"Qwen 3.5-27B": {True: "Qwen 3.5-27B thinking", False: "Qwen 3.5-27B instruct"}}


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


class Counterpart(NamedTuple):
    """The published methods to compare a grounder with."""

    methods: tuple[str, ...]
    is_same: bool
    """Whether the study has the same model and strategy; otherwise, `methods` are all methods of the same strategy."""


def find_counterpart(grounder: str, *, is_thinking: bool) -> Counterpart | None:
    """Return the published methods to compare a grounder with; None if the study has none.

    >>> find_counterpart("llm-B:google:gemini-3-flash-preview", is_thinking=False)
    Counterpart(methods=('Gemini 3 Flash B',), is_same=True)
    >>> len(find_counterpart("llm-B:openai:another-model", is_thinking=False).methods)
    4
    """
    if grounder in _BASELINES:
        return Counterpart((_BASELINES[grounder],), is_same=True)
    if not is_llm_name(grounder):
        return None
    kind, _, model = grounder.partition(":")
    strategy = kind.removeprefix("llm").removeprefix("-").upper() or "B"
    known = next((name for pattern, name in _MODELS.items() if re.search(pattern, model, re.IGNORECASE)), None)
    name = _MODES.get(known or "", {}).get(is_thinking, known)
    if f"{name} {strategy}" in published_main():
        return Counterpart((f"{name} {strategy}",), is_same=True)
    others = tuple(method for method in published_main() if method.endswith(f" {strategy}"))
    return Counterpart(others, is_same=False) if others else None


def published_condition(method: str, condition: str) -> PublishedResult | None:
    """Return the published result of a method under a naming regime or a condition of the ablation; None if none."""
    return published_main().get(method, {}).get(condition) or published_ablation().get(method, {}).get(condition)


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
