"""The rows of a model's answer, read from its text with the places where their classes stand."""

import json
import re
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

__all__ = ["AnswerRow", "read_answer_rows"]

_MOST_STARTS = 200
"""Braces that are tried as the start of a JSON object, from the front."""


class AnswerRow(NamedTuple):
    """What an answer says of one object."""

    value: Any
    """The JSON value: an object with the class and maybe more, or the class alone."""
    class_span: tuple[int, int] | None
    """Where in the text the class's JSON value starts and ends, without its quotes; None where the row has none."""


def read_answer_rows(text: str, numbers: Sequence[str]) -> dict[str, AnswerRow]:
    """Return number → row for the objects of these numbers that the text has rows for.

    Read are a JSON object, alone, fenced or after prose, and the whole rows of one that breaks off. Of several JSON
    objects the last of those with most rows counts. An object with a class in it is the row of a single number.
    """
    best: dict[str, int] = {}
    for start, found in _json_objects(text):
        members = _members(text, start)
        starts = {number: members[number] for number in numbers if number in found}
        if not starts and len(numbers) == 1 and "class" in found:
            starts = {numbers[0]: start}
        if starts and len(starts) >= len(best):
            best = starts
    return {number: _read_row(text, start) for number, start in (best or _whole_rows(text, numbers)).items()}


def _json_objects(text: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """Yield the JSON objects in a text that stand in no other, in order, with their starts."""
    start = text.find("{")
    for _ in range(_MOST_STARTS):
        if start < 0:
            return
        found, end = _decode(text, start)
        if isinstance(found, dict):
            yield start, found
        start = text.find("{", max(end, start + 1))


def _whole_rows(text: str, numbers: Sequence[str]) -> dict[str, int]:
    """Return the starts of the rows that were written out before the text broke off."""
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
    """Return name → start of the value for the members of the JSON object that starts there.

    Of members of one name the last counts, as for the decoder.
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
    """Return the JSON value that starts there and where it ends; that is `start` if there is none."""
    try:
        return json.JSONDecoder(strict=False).raw_decode(text, start)
    except (ValueError, RecursionError):
        return None, start
