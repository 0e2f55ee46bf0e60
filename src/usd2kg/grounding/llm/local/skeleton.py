"""read_schema: answer schema → skeleton, the fixed text of an answer and the gaps that a model fills."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from usd2kg.errors import GroundingError

__all__ = ["CLOSING", "OPENING", "Choice", "Fixed", "FreeText", "SkeletonRow", "read_schema"]

OPENING = "{"
"""Beginning of an answer, which is part of the first row."""
CLOSING = "}"
"""End of an answer, after the last row."""


@dataclass(frozen=True, slots=True)
class Fixed:
    """Text that the schema determines."""

    text: str


@dataclass(frozen=True, slots=True)
class Choice:
    """One of several strings; its quotes are in the fixed text around it."""

    names: tuple[str, ...]
    """The strings, escaped for JSON."""


@dataclass(frozen=True, slots=True)
class FreeText:
    """Any string; its quotes are in the fixed text around it."""


SkeletonRow = tuple[Fixed | Choice | FreeText, ...]
"""One property of the answer, with the preceding brace or comma."""


def read_schema(schema: Mapping[str, Any]) -> list[SkeletonRow]:
    """Return the rows of an answer from a schema of objects and strings, in the order of its properties.

    Raises:
        GroundingError: the schema contains another type.
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
    """Return the steps with adjacent fixed texts merged."""
    joined: list[Fixed | Choice | FreeText] = []
    for step in steps:
        last = joined[-1] if joined else None
        if isinstance(step, Fixed) and isinstance(last, Fixed):
            joined[-1] = Fixed(last.text + step.text)
        else:
            joined.append(step)
    return tuple(joined)
