"""Recordings: completions with their requests as JSON Lines, for sharing and for replay without API keys."""

import json
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.serialization import (
    UNREADABLE,
    CacheEntry,
    checked,
    make_entry,
    order_request_fields,
    read_completion,
    read_request_fields,
    to_json,
    upgrade_completion,
)

__all__ = ["format_line", "read_line"]

_LINE = {"key": (str,), "model": (str,), "request": (dict,), "completion": (dict,)}


def format_line(key: str, system: str, schema: str, rest: str, completion: str) -> bytes:
    """Return the line for a cache entry, given as its columns."""
    values = {"system": json.loads(system), "schema": json.loads(schema), **json.loads(rest)}
    request = order_request_fields(values)
    line = {"key": key, "model": values["model"], "request": request, "completion": json.loads(completion)}
    return f"{to_json(line)}\n".encode()


def read_line(path: Path, number: int, line: bytes) -> CacheEntry:
    """Return the cache entry in line `number` of a recording of format 1 or 2.

    Raises:
        GroundingError: the line is invalid, or its key is not that of its request.
    """
    try:
        data = checked(json.loads(line.decode("utf-8")), _LINE, "the line")
        request = read_request_fields(data["request"])
        completion = read_completion(upgrade_completion(data["completion"]))
        entry = make_entry(data["model"], request, completion)
        if data["key"] != entry.values[0]:
            raise ValueError("the key is not that of its model and request")
    except UNREADABLE as error:
        raise GroundingError(
            f"{path}: line {number} is not a recorded completion ({error}); nothing was imported;"
            " expected the file as the cache exported it: export it again or remove the line"
        ) from error
    return entry
