"""Cache of tables that follow from an ontology alone, so that only the first command with it computes them."""

import hashlib
import json
import logging
import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import lru_cache
from itertools import chain
from pathlib import Path
from typing import Any, TypeVar

from usd2kg.cache_folder import chosen_cache_folder
from usd2kg.errors import OutputError
from usd2kg.files import write_whole

__all__ = ["NO_CACHE", "TABLE_CACHE_VARIABLE", "TableCache", "open_table_cache"]

logger = logging.getLogger(__name__)

_Table = TypeVar("_Table")

TABLE_CACHE_VARIABLE = "USD2KG_TABLE_CACHE"
"""Environment variable: a folder for the cache, or `off`."""
_MAX_BYTES = 200 << 20
"""Beyond this size the least recently used tables are removed; the tables of an ontology take 1 to 5 MB."""
_SOURCES = ("data", "grounding", "languages", "ontology")
"""Parts of the package that the tables depend on."""
_DAMAGES = (OSError, KeyError, TypeError, ValueError, IndexError)
"""What reading a damaged or missing file raises."""


class TableCache:
    """The kept tables of one set of inputs; without a folder, all tables are computed."""

    def __init__(self, folder: Path | None = None, key: str = "") -> None:
        self._folder = folder
        self._key = key

    def get(
        self, name: str, decode: Callable[[Any], _Table], compute: Callable[[], _Table], encode: Callable[[_Table], Any]
    ) -> _Table:
        """Return a table: the kept one, else one that is computed and kept.

        Args:
            name: the name of the table.
            decode: returns the table of JSON values; may raise what damaged values raise.
            compute: returns the table.
            encode: returns the JSON values of a table.
        """
        if self._folder is None:
            return compute()
        file = self._folder / f"{self._key}-{name}.json"
        with suppress(*_DAMAGES):
            table = decode(json.loads(file.read_bytes()))
            os.utime(file)
            return table
        table = compute()
        try:
            self._folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            write_whole(file, json.dumps(encode(table), separators=(",", ":")).encode())
            _remove_old(self._folder)
        except (OSError, OutputError) as error:
            logger.info("%s: not kept (%s)", file, error)
        return table


NO_CACHE = TableCache()
"""Keeps nothing."""


def open_table_cache(inputs: Iterable[str]) -> TableCache:
    """Return the cache of the tables that follow from some inputs.

    The key stands for the inputs, and for the program and its data as they are now, as in a build tool.

    Args:
        inputs: everything else that the tables depend on, as text.
    """
    folder = chosen_cache_folder(TABLE_CACHE_VARIABLE, "tables")
    if folder is None:
        return NO_CACHE
    digest = hashlib.blake2b(digest_size=16)
    for part in (*_program_state(), *inputs):
        digest.update(part.encode() + b"\0")
    return TableCache(folder, digest.hexdigest())


@lru_cache(maxsize=1)
def _program_state() -> tuple[str, ...]:
    package = Path(__file__).parent
    return tuple(sorted(chain.from_iterable(_file_states(os.fspath(package / source)) for source in _SOURCES)))


def _file_states(folder: str) -> Iterator[str]:
    # With os.scandir, since pathlib takes four times as long for the few hundred files.
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.is_dir():
                yield from _file_states(entry.path)
            elif not entry.name.endswith(".pyc"):
                state = entry.stat()
                yield f"{entry.path} {state.st_size} {state.st_mtime_ns}"


def _remove_old(folder: Path) -> None:
    states = [(file, file.stat()) for file in folder.glob("*.json")]
    total = 0
    for file, state in sorted(states, key=lambda entry: -entry[1].st_mtime):
        total += state.st_size
        if total > _MAX_BYTES:
            file.unlink(missing_ok=True)
