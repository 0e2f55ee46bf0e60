"""reword: apply rules for other words of a question, from the text files of this package."""

import re
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import NamedTuple

__all__ = ["Rule", "read_rules", "reword"]


class Rule(NamedTuple):
    """A regular expression, and what replaces its matches."""

    pattern: re.Pattern[str]
    replacement: str


@cache
def read_rules(name: str) -> Sequence[Rule]:
    """Return the rules of a text file of this package: pattern, arrow, replacement; `#` begins a comment."""
    lines = (files("usd2kg.assistant") / name).read_text("utf-8").splitlines()
    parts = (line.split(" -> ") for line in lines if line and not line.startswith("#"))
    return tuple(Rule(re.compile(pattern, re.IGNORECASE), replacement) for pattern, replacement in parts)


def reword(text: str, rules: Sequence[Rule]) -> str:
    """Return a question after all rules, in their order."""
    for pattern, replacement in rules:
        text = " ".join(pattern.sub(replacement, text).split())
    return text
