"""The table of plausibility: our own thresholds, classes and texts, and a user's in their place."""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from usd2kg.errors import GraphError
from usd2kg.knowledge import read_text
from usd2kg.ontology import expand_curie
from usd2kg.validation.finding import Severity

__all__ = ["Rule", "Rules", "read_rules"]


@dataclass(frozen=True)
class Rule:
    """One table: what it goes by, how serious it is and what to do."""

    id: str
    severity: Severity
    advice: str
    is_enabled: bool
    settings: Mapping[str, Any]
    """Its other keys as they stand in the table."""

    def number(self, key: str) -> float:
        """Return a threshold."""
        return float(self.settings[key])

    def classes(self, key: str) -> frozenset[str]:
        """Return the IRIs of a list of classes."""
        return frozenset(map(expand_curie, self.settings[key]))

    def words(self, key: str) -> frozenset[str]:
        """Return a list of words in small letters."""
        return frozenset(word.lower() for word in self.settings[key])


Rules = Mapping[str, Rule]
"""Id → rule."""


def read_rules(path: Path | str | None = None) -> Rules:
    """Return the rules of plausibility, with what the TOML file at `path` says in place of our own.

    Raises:
        GraphError: the file cannot be read, or has a table, a key or a value that no rule knows.
    """
    tables = tomllib.loads(read_text("plausibility.toml"))
    if path is not None:
        _replace(tables, Path(path))
    return {
        name: Rule(name, Severity(table["severity"]), table["advice"], table["enabled"], table)
        for name, table in tables.items()
    }


def _replace(tables: dict[str, dict[str, Any]], path: Path) -> None:
    try:
        own = tomllib.loads(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, RecursionError, tomllib.TOMLDecodeError) as error:
        raise GraphError(f"{path}: cannot be read as rules ({error}); expected a TOML file of tables") from error
    for name, table in own.items():
        if name not in tables or not isinstance(table, dict):
            raise GraphError(f"{path}: {name!r} is no rule; expected tables named {', '.join(tables)}")
        for key, value in table.items():
            if key not in tables[name]:
                raise GraphError(f"{path}: [{name}] has no key {key!r}; expected {', '.join(tables[name])}")
            tables[name][key] = _checked(f"{path}: [{name}] {key}", key, value, tables[name][key])


def _checked(where: str, key: str, value: Any, usual: Any) -> Any:
    """Return a user's value if it is of the kind of our own.

    Raises:
        GraphError: it is not.
    """
    if key == "severity" and value not in list(Severity):
        raise GraphError(f"{where} is {value!r}; expected one of {', '.join(Severity)}")
    is_number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value) and value >= 0
    is_list = isinstance(value, list) and all(isinstance(item, str) for item in value)
    kinds: tuple[tuple[type | tuple[type, ...], bool, str], ...] = (
        (bool, isinstance(value, bool), "true or false"),
        ((int, float), is_number, "a number from 0"),
        (str, isinstance(value, str), "a text"),
        (list, is_list, "a list of texts"),
    )
    is_good, wanted = next((good, wanted) for kind, good, wanted in kinds if isinstance(usual, kind))
    if not is_good:
        raise GraphError(f"{where} is {value!r}; expected {wanted}")
    return value
