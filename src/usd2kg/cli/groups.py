"""Groups of options that several commands take: a dataclass whose fields are the options."""

import functools
import inspect
from collections.abc import Callable
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any

__all__ = ["with_groups"]


def with_groups(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command in which each parameter that is a dataclass is replaced by the options in its fields.

    The fields are annotated as options are, and have defaults; the command gets the filled-in dataclass.
    """
    own = inspect.signature(command)
    groups: dict[str, Any] = {name: p.annotation for name, p in own.parameters.items() if is_dataclass(p.annotation)}
    parameters: list[inspect.Parameter] = []
    for name, parameter in own.parameters.items():
        members = fields(groups[name]) if name in groups else ()
        parameters.extend(_option(member) for member in members) if members else parameters.append(parameter)

    @functools.wraps(command)
    def grouped(**values: Any) -> None:
        made = {
            name: group(**{member.name: values.pop(member.name) for member in fields(group)})
            for name, group in groups.items()
        }
        command(**values, **made)

    signature = own.replace(parameters=[p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in parameters])
    grouped.__signature__ = signature  # type: ignore[attr-defined]
    grouped.__annotations__ = {p.name: p.annotation for p in parameters}
    return grouped


def _option(member: "Field[Any]") -> inspect.Parameter:
    assert member.default is not MISSING, f"option {member.name} has no default"
    return inspect.Parameter(
        member.name, inspect.Parameter.KEYWORD_ONLY, default=member.default, annotation=member.type
    )
