"""Convert the word lists in `knowledge/words` to the JSON that `usd2kg.knowledge.word_set` reads."""

import json
import tomllib
from itertools import pairwise
from pathlib import Path
from typing import Any

from tools.data_files import SourceError

KEYS = ("description", "origin", "words")


def convert_word_lists(path: Path) -> bytes:
    """Return the JSON of one TOML file: list name → sorted words, or word → word for a map.

    Raises:
        SourceError: a list lacks a key or has an unknown one, is empty, unsorted, or repeats a word.
    """
    try:
        tables = tomllib.loads(path.read_text("utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise SourceError(path, str(error)) from error
    for name, table in tables.items():
        _check_table(path, name, table)
    lists = {name: table["words"] for name, table in tables.items()}
    return (json.dumps(lists, ensure_ascii=False, indent=1) + "\n").encode()


def _check_table(path: Path, name: str, table: Any) -> None:
    where = f"[{name}]"
    if not isinstance(table, dict) or sorted(table) != sorted(KEYS):
        raise SourceError(path, f"{where}: expected a table with the keys {', '.join(KEYS)}")
    for key in ("description", "origin"):
        if not isinstance(table[key], str) or not table[key].strip():
            raise SourceError(path, f"{where}: {key} is {table[key]!r}; expected a text")
    words = table["words"]
    if not isinstance(words, list | dict) or not words:
        raise SourceError(path, f"{where}: words is {words!r}; expected a list of words or a map from word to word")
    for word in (*words, *(words.values() if isinstance(words, dict) else ())):
        if not isinstance(word, str) or not word.strip() or word != word.strip():
            raise SourceError(path, f"{where}: {word!r}; expected a word without surrounding spaces")
    keys = list(words)
    for before, after in pairwise(keys):
        if before >= after:
            raise SourceError(path, f"{where}: {after!r} follows {before!r}; sort the words and name each once")
