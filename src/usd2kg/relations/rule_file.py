"""Read the packaged relation rules and a user's overrides."""

import math
import tomllib
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from usd2kg.errors import GraphError
from usd2kg.knowledge import read_text
from usd2kg.relations.thresholds import RelationRules

__all__ = ["load_rules"]

_EXTEND = "extend"


def load_rules(overrides: Path | str | None = None) -> RelationRules:
    """Return the packaged rules with the values of a TOML file applied.

    Args:
        overrides: sections and keys of `knowledge/spatial.toml` to replace; `[classes.extend]` adds to class lists.

    Raises:
        GraphError: the file cannot be read, or holds an unknown key or an invalid value.
    """
    rules = _shipped_rules()
    if overrides is None:
        return rules
    return _with_overrides(rules, _parse(Path(overrides)), str(overrides))


@lru_cache(maxsize=1)
def _shipped_rules() -> RelationRules:
    table = tomllib.loads(read_text("spatial.toml"))
    sections = RelationRules.__annotations__
    return RelationRules(**{name: section(**_lists_to_tuples(table[name])) for name, section in sections.items()})


def _lists_to_tuples(section: Mapping[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in section.items()}


def _parse(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text("utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise GraphError(f"{path}: cannot be read as relation rules ({error}); expected a TOML file") from error
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise GraphError(f"{path}: not valid TOML ({error}); see docs/relations.md for an example") from error


def _with_overrides(rules: RelationRules, table: dict[str, Any], source: str) -> RelationRules:
    sections = {}
    for name, values in table.items():
        if name not in RelationRules._fields:
            known = ", ".join(RelationRules._fields)
            raise GraphError(f"{source}: section [{name}] is unknown; expected one of {known}")
        if not isinstance(values, dict):
            raise GraphError(f"{source}: {name} is {values!r}; expected a section [{name}] with keys and values")
        section = getattr(rules, name)
        extended = values.pop(_EXTEND, {}) if name == "classes" else {}
        section = _with_values(section, values, f"{source}: [{name}]")
        sections[name] = _with_extensions(section, extended, f"{source}: [{name}.{_EXTEND}]")
    return rules._replace(**sections)


_Section = TypeVar("_Section", bound=NamedTuple)


def _with_values(section: _Section, values: Mapping[str, Any], where: str) -> _Section:
    for key, value in values.items():
        if key not in section._fields:
            raise GraphError(f"{where}: key {key!r} is unknown; expected one of {', '.join(section._fields)}")
        _check(getattr(section, key), value, f"{where} {key}")
    return section._replace(**_lists_to_tuples(values))


def _with_extensions(section: _Section, values: Any, where: str) -> _Section:
    if not isinstance(values, dict):
        raise GraphError(f'{where} is {values!r}; expected lists of classes, like containers = ["soma:Table"]')
    lists = {key: old for key, old in section._asdict().items() if isinstance(old, tuple)}
    for key, value in values.items():
        if key not in lists:
            raise GraphError(f"{where}: key {key!r} is unknown; expected one of {', '.join(lists)}")
        _check(lists[key], value, f"{where} {key}")
    return section._replace(**{key: (*lists[key], *value) for key, value in values.items()})


def _check(shipped: Any, value: Any, where: str) -> None:
    """Raise GraphError unless a value has the type of the packaged one."""
    if isinstance(shipped, tuple):
        is_good, expected = isinstance(value, list) and all(isinstance(item, str) for item in value), "a list of texts"
    elif isinstance(shipped, str):
        is_good, expected = isinstance(value, str), "a text"
    elif isinstance(shipped, int):
        is_good, expected = type(value) is int and value >= 0, "a whole number, not negative"
    else:
        is_good, expected = type(value) in {int, float} and math.isfinite(value), "a finite number"
    if not is_good:
        raise GraphError(f"{where} is {value!r}; expected {expected}, like {shipped!r}")
