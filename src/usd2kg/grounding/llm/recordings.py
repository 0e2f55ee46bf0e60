"""Recordings: completions with their requests, one line of JSON each, to be shared and replayed without keys."""

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
    """Return the line of a completion that is kept as these texts."""
    values = {"system": json.loads(system), "schema": json.loads(schema), **json.loads(rest)}
    request = order_request_fields(values)
    line = {"key": key, "model": values["model"], "request": request, "completion": json.loads(completion)}
    return f"{to_json(line)}\n".encode()


def read_line(path: Path, number: int, line: bytes) -> CacheEntry:
    """Return what one line of a recording tells to keep; recordings of format 1 are read too.

    Raises:
        GroundingError: it is no such line, or its key is not that of its request.
    """
    try:
        data = checked(json.loads(line.decode("utf-8")), _LINE, "the line")
        request, said = read_request_fields(data["request"]), read_completion(upgrade_completion(data["completion"]))
        row = make_entry(data["model"], request, said)
        if data["key"] != row.values[0]:
            raise ValueError("the key is not that of its model and request")
    except UNREADABLE as error:
        raise GroundingError(
            f"{path}: line {number} is no recorded completion ({error}); nothing was imported;"
            " expected the file as the cache exported it: export it again or remove the line"
        ) from error
    return row
