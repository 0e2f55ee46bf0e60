"""Plausibility rules: `plausibility.toml` with a user's overrides."""

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
    """One table of `plausibility.toml`."""

    id: str
    severity: Severity
    advice: str
    is_enabled: bool
    settings: Mapping[str, Any]
    """All keys of the table."""

    def number(self, key: str) -> float:
        """Return a threshold."""
        return float(self.settings[key])

    def classes(self, key: str) -> frozenset[str]:
        """Return the IRIs of a list of classes."""
        return frozenset(map(expand_curie, self.settings[key]))

    def words(self, key: str) -> frozenset[str]:
        """Return a list of words in lower case."""
        return frozenset(word.lower() for word in self.settings[key])


Rules = Mapping[str, Rule]
"""Id → rule."""


def read_rules(path: Path | str | None = None) -> Rules:
    """Return the plausibility rules, with single values overridden by the TOML file at `path`.

    Raises:
        GraphError: the file cannot be read, or contains an unknown table or key, or a value of the wrong type.
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
        overrides = tomllib.loads(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError, RecursionError, tomllib.TOMLDecodeError) as error:
        raise GraphError(f"{path}: cannot be read ({error}); expected a TOML file with tables") from error
    for name, table in overrides.items():
        if name not in tables or not isinstance(table, dict):
            raise GraphError(f"{path}: {name!r} is not a rule; expected tables named {', '.join(tables)}")
        for key, value in table.items():
            if key not in tables[name]:
                raise GraphError(f"{path}: [{name}] has no key {key!r}; expected {', '.join(tables[name])}")
            tables[name][key] = _checked(f"{path}: [{name}] {key}", key, value, tables[name][key])


def _checked(where: str, key: str, value: Any, default: Any) -> Any:
    """Return a user's value if it has the type of the default.

    Raises:
        GraphError: it has another type.
    """
    if key == "severity" and value not in list(Severity):
        raise GraphError(f"{where} is {value!r}; expected one of {', '.join(Severity)}")
    is_number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value) and value >= 0
    is_list = isinstance(value, list) and all(isinstance(item, str) for item in value)
    kinds: tuple[tuple[type | tuple[type, ...], bool, str], ...] = (
        (bool, isinstance(value, bool), "true or false"),
        ((int, float), is_number, "a number of at least 0"),
        (str, isinstance(value, str), "a string"),
        (list, is_list, "a list of strings"),
    )
    is_valid, expected = next((valid, expected) for kind, valid, expected in kinds if isinstance(default, kind))
    if not is_valid:
        raise GraphError(f"{where} is {value!r}; expected {expected}")
    return value
