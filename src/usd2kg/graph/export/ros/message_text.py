"""JSON and YAML of messages, readable by parsers of YAML 1.1 such as PyYAML."""

import json
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from usd2kg.errors import OutputError
from usd2kg.files import write_whole

__all__ = ["json_text", "write_files", "yaml_text"]

_DIGITS = 9
"""Decimal places: nanometres."""
_INDENT = "  "


def json_text(value: Any) -> str:
    """Return indented JSON; flat objects and lists are on one line.

    >>> print(json_text({"frame": "map", "at": {"x": 1.0, "y": 0.00001}, "all": [{"a": [1, 2]}]}), end="")
    {
      "frame": "map",
      "at": {"x": 1.0, "y": 0.00001},
      "all": [
        {
          "a": [1, 2]
        }
      ]
    }
    """
    return "".join(_json(value, "\n")) + "\n"


def yaml_text(value: Any) -> str:
    """Return YAML in block style; texts are quoted as in JSON.

    >>> print(yaml_text({"frame": "map", "at": {"x": 1.0}, "all": [{"a": [1, 2], "b": []}]}), end="")
    frame: "map"
    at: {"x": 1.0}
    all:
      - a: [1, 2]
        b: []
    """
    return "\n".join(_yaml(value)) + "\n"


def write_files(folder: Path, texts: Mapping[str, str]) -> None:
    """Write texts into a folder, created if missing.

    Raises:
        OutputError: the folder cannot be created, or a file cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot be created ({error.strerror}); choose another folder") from error
    for name, text in texts.items():
        write_whole(folder / name, text.encode())


def _json(value: Any, line: str) -> Iterator[str]:
    """Yield JSON; `line` is a line break with the indentation of the value."""
    if _is_flat(value):
        yield _flow(value)
        return
    inner = line + _INDENT
    is_object = isinstance(value, dict)
    yield "{" if is_object else "["
    items = [(f"{json.dumps(key)}: ", item) for key, item in value.items()] if is_object else [("", i) for i in value]
    for number, (key, item) in enumerate(items):
        yield ("," if number else "") + inner + key
        yield from _json(item, inner)
    yield line + ("}" if is_object else "]")


def _yaml(value: Any) -> Iterator[str]:
    """Yield lines of a mapping or a sequence."""
    if isinstance(value, dict):
        for key, item in value.items():
            if _is_flat(item):
                yield f"{key}: {_flow(item)}"
            else:
                yield f"{key}:"
                yield from (_INDENT + line for line in _yaml(item))
    else:
        for item in value:
            marks = iter(("- ",))
            lines = (_flow(item),) if _is_flat(item) else _yaml(item)
            yield from (next(marks, _INDENT) + line for line in lines)


def _is_flat(value: Any) -> bool:
    """Return whether a value is a scalar, or an object or list of scalars."""
    items = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return not any(isinstance(item, dict | list) for item in items)


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)}: {_flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_flow, value)) + "]"
    return _number(value) if isinstance(value, float) else json.dumps(value)


def _number(value: float) -> str:
    """Return a decimal number: YAML 1.1 reads `1e-05` as text."""
    if not math.isfinite(value):
        return "null"
    text = f"{value:.{_DIGITS}f}".rstrip("0")
    text = f"{text}0" if text.endswith(".") else text
    return "0.0" if text == "-0.0" else text
