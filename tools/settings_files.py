"""Convert the settings in `knowledge/settings` to the JSON that `usd2kg.knowledge.read_settings` reads."""

import json
import re
import tomllib
from pathlib import Path

from tools.data_files import SourceError

ORIGINS = ("chosen", "fitted", "measured", "source")
"""First word of an origin: by hand, by a command, on data, or from a publication or specification."""
_VALUE = re.compile(r"^(\w+) = ")
_ORIGIN = re.compile(r"# [^\[\s].*\[(\w+)[^\[\]]*\]$")


def convert_settings(path: Path) -> bytes:
    """Return the JSON of one TOML file: section → key → value.

    Raises:
        SourceError: a value has no comment with its meaning and, in brackets, its origin; or a key is in no section.
    """
    text = path.read_text("utf-8")
    try:
        sections = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise SourceError(path, str(error)) from error
    for name, section in sections.items():
        if not isinstance(section, dict):
            raise SourceError(path, f"{name} is in no section")
    for number, line in enumerate(text.splitlines(), 1):
        value, origin = _VALUE.match(line), _ORIGIN.search(line)
        if value and (origin is None or origin[1] not in ORIGINS):
            expected = f"a comment with its meaning and origin, like “# metres [{ORIGINS[0]}: why]”"
            raise SourceError(path, f"{value[1]} has no origin; expected {expected}", number)
    return (json.dumps(sections, ensure_ascii=False, indent=1) + "\n").encode()
