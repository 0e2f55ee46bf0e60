"""read_answer_rows: the JSON rows of a completion, with the position of each class in the text."""

import json
import re
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from usd2kg.grounding.llm.limits import LIMITS

__all__ = ["AnswerRow", "read_answer_rows"]


class AnswerRow(NamedTuple):
    """The JSON value about one object."""

    value: Any
    """An object with the key `class`, or the class alone."""
    class_span: tuple[int, int] | None
    """Start and end of the class value in the text, without its quotes; None if the row has no class."""


def read_answer_rows(text: str, numbers: Sequence[str]) -> dict[str, AnswerRow]:
    """Return number → row for the objects that have a row in the text.

    The rows are the members of a JSON object, which may be fenced, surrounded by prose, or truncated after complete
    rows. If there are several JSON objects, the last one with the most rows counts. If a single number is requested,
    an object with the key `class` is its row.
    """
    best: dict[str, int] = {}
    for start, found in _json_objects(text):
        members = _members(text, start)
        starts = {number: members[number] for number in numbers if number in found}
        if not starts and len(numbers) == 1 and "class" in found:
            starts = {numbers[0]: start}
        if starts and len(starts) >= len(best):
            best = starts
    return {number: _read_row(text, start) for number, start in (best or _complete_rows(text, numbers)).items()}


def _json_objects(text: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the outermost JSON objects of a text with their start positions."""
    start = text.find("{")
    for _ in range(LIMITS.max_json_starts):
        if start < 0:
            return
        found, end = _decode(text, start)
        if isinstance(found, dict):
            yield start, found
        start = text.find("{", max(end, start + 1))


def _complete_rows(text: str, numbers: Sequence[str]) -> dict[str, int]:
    """Return the start positions of the complete rows in a truncated text."""
    return {
        match[1]: match.end()
        for match in re.finditer(r'(?<!\\)"([0-9]{1,9})"\s*:\s*(?=[{"])', text)
        if match[1] in numbers and _decode(text, match.end())[1] > match.end()
    }


def _read_row(text: str, start: int) -> AnswerRow:
    value, end = _decode(text, start)
    if not isinstance(value, dict):
        return AnswerRow(value, _without_quotes(text, start, end))
    if "class" not in value:
        return AnswerRow(value, None)
    start = _members(text, start)["class"]
    return AnswerRow(value, _without_quotes(text, start, _decode(text, start)[1]))


def _without_quotes(text: str, start: int, end: int) -> tuple[int, int]:
    return (start + 1, end - 1) if text[start] == '"' else (start, end)


def _members(text: str, start: int) -> dict[str, int]:
    """Return name → start of the value for the members of the JSON object at `start`.

    As in the decoder, the last of several members with the same name counts.
    """
    found = {}
    at = _skip_space(text, start + 1)
    while text[at] == '"':
        name, at = _decode(text, at)
        found[name] = _skip_space(text, _skip_space(text, at) + len(":"))
        at = _skip_space(text, _decode(text, found[name])[1])
        if text[at] == ",":
            at = _skip_space(text, at + 1)
    return found


def _skip_space(text: str, start: int) -> int:
    while text[start] in " \t\n\r":
        start += 1
    return start


def _decode(text: str, start: int) -> tuple[Any, int]:
    """Return the JSON value at `start` and its end; the end is `start` if there is none."""
    try:
        return json.JSONDecoder(strict=False).raw_decode(text, start)
    except (ValueError, RecursionError):
        return None, start
