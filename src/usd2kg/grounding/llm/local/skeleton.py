"""An answer's schema as a skeleton: the text that is certain, and the places that a model fills in."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from usd2kg.errors import GroundingError

__all__ = ["CLOSING", "OPENING", "Choice", "Fixed", "FreeText", "SkeletonRow", "read_schema"]

OPENING = "{"
"""What an answer without rows begins with; the first row has it inside."""
CLOSING = "}"
"""What follows the last row, however many there are."""


@dataclass(frozen=True, slots=True)
class Fixed:
    """Text that the schema leaves no choice about."""

    text: str


@dataclass(frozen=True, slots=True)
class Choice:
    """One of a few strings, inside quotes that stand in the text around it."""

    names: tuple[str, ...]
    """As they are written in JSON."""


@dataclass(frozen=True, slots=True)
class FreeText:
    """Any string, inside quotes that stand in the text around it."""


SkeletonRow = tuple[Fixed | Choice | FreeText, ...]
"""One property of the answer, with the brace or comma before it."""


def read_schema(schema: Mapping[str, Any]) -> list[SkeletonRow]:
    """Return the rows of an answer by a schema of objects and strings, in the order of its properties.

    Raises:
        GroundingError: the schema holds something else.
    """
    rows = []
    opening = OPENING
    for key, value in _properties(schema).items():
        rows.append(_join([Fixed(f"{opening}{json.dumps(key)}: "), *_read_value(value)]))
        opening = ", "
    return rows


def _read_value(schema: Mapping[str, Any]) -> list[Fixed | Choice | FreeText]:
    if schema.get("type") == "string":
        names = schema.get("enum")
        inside = FreeText() if names is None else Choice(tuple(json.dumps(n, ensure_ascii=False)[1:-1] for n in names))
        return [Fixed('"'), inside, Fixed('"')]
    steps: list[Fixed | Choice | FreeText] = []
    opening = "{"
    for key, value in _properties(schema).items():
        steps += [Fixed(f"{opening}{json.dumps(key)}: "), *_read_value(value)]
        opening = ", "
    return [*steps, Fixed("}")]


def _properties(schema: Mapping[str, Any]) -> Mapping[str, Mapping[str, Any]]:
    properties = schema.get("properties")
    if schema.get("type") != "object" or not properties:
        found = json.dumps(dict(schema), default=dict)[:80]
        raise GroundingError(f"schema of the answer: found {found}; expected an object with properties, or a string")
    return dict(properties)


def _join(steps: list[Fixed | Choice | FreeText]) -> SkeletonRow:
    """Return the steps with texts that follow each other made one."""
    joined: list[Fixed | Choice | FreeText] = []
    for step in steps:
        last = joined[-1] if joined else None
        if isinstance(step, Fixed) and isinstance(last, Fixed):
            joined[-1] = Fixed(last.text + step.text)
        else:
            joined.append(step)
    return tuple(joined)
