"""What is kept of a request and of its completion, as JSON."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Any, NamedTuple

from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage

__all__ = [
    "REQUEST",
    "UNREADABLE",
    "Row",
    "checked",
    "make_row",
    "read_completion",
    "request_fields",
    "request_key",
    "to_json",
    "upgrade_completion",
]

_KEY_FORMAT = "usd2kg-request/1"
REQUEST = {
    "system": (str,),
    "user": (str,),
    "schema": (dict,),
    "most_tokens": (int,),
    "temperature": (float,),
    "is_thinking": (bool,),
    "sample": (int,),
}
"""The fields of a request, in the order in which they are kept."""
_COMPLETION = {
    "text": (str,),
    "finish": (str,),
    "usage": (dict,),
    "tokens": (list,),
    "thinking": (str,),
}
_USAGE = {
    "input_tokens": (int,),
    "cached_tokens": (int,),
    "output_tokens": (int,),
    "estimated_tokens": (int,),
    "written_tokens": (int,),
}
UNREADABLE = (ValueError, OverflowError, RecursionError)
"""What reading JSON raises that is not what was written."""


class Row(NamedTuple):
    """A request and its completion."""

    shared: tuple[tuple[str, str], ...]
    """Digest and text of what other requests may hold too."""
    values: tuple[str, str, str, str, str]
    """Key, digests of instructions and schema, the rest of the request, and the completion."""


def request_key(model: str, request: Request) -> str:
    """Return the address of a completion: `sha256:` and the hex digest of the model and every field of the request.

    The order of the schema's properties counts: models answer in it.
    """
    return _key(model, request_fields(request))


def _key(model: str, values: Mapping[str, Any]) -> str:
    parts = {"format": _KEY_FORMAT, "model": model, "request": values}
    return "sha256:" + _digest(json.dumps(parts, separators=(",", ":"), default=_as_dict, allow_nan=False))


def request_fields(request: Request) -> dict[str, Any]:
    """Return what is kept of a request."""
    values = {f.name: getattr(request, f.name) for f in fields(Request)}
    return {**values, "temperature": float(request.temperature)}


def make_row(model: str, values: Mapping[str, Any], completion: Completion) -> Row:
    """Return what is kept of a request, given as its fields, and of its completion."""
    rest = {"model": model, **values}
    system, schema = (to_json(rest.pop(name)) for name in ("system", "schema"))
    shared = ((_digest(system), system), (_digest(schema), schema))
    said = to_json(_completion_fields(completion))
    return Row(shared, (_key(model, values), shared[0][0], shared[1][0], to_json(rest), said))


def _completion_fields(completion: Completion) -> dict[str, Any]:
    values: dict[str, Any] = {f.name: getattr(completion, f.name) for f in fields(Completion)}
    tokens = [(piece, float(logprob)) for piece, logprob in completion.tokens]
    return {**values, "usage": asdict(completion.usage), "tokens": tokens}


def read_completion(data: Any) -> Completion:
    """Return a completion as it was kept.

    Raises:
        ValueError: it was not kept so.
    """
    values = dict(checked(data, _COMPLETION, "completion"))
    usage = Usage(**checked(values.pop("usage"), _USAGE, "usage"))
    tokens = tuple(map(_read_token, values.pop("tokens")))
    return Completion(finish=Finish(values.pop("finish")), usage=usage, tokens=tokens, **values)


def _read_token(data: Any) -> tuple[str, float]:
    match data:
        case [str(piece), float(logprob)]:
            return piece, logprob
    raise ValueError(f"a token is {str(data)[:40]!r}, expected its text and a number")


def upgrade_completion(data: Any) -> Any:
    """Return a completion that was kept in format 1 in today's.

    That format kept the mean of the tokens' log-probabilities alone. It is dropped, as no class's own can be told from
    it: the completion stays, without token probabilities. What is in no such format comes back as it is.
    """
    if not isinstance(data, dict) or not isinstance(data.get("usage"), dict):
        return data
    if "mean_logprob" not in data or "tokens" in data:
        return data
    kept = {name: value for name, value in data.items() if name != "mean_logprob"}
    return kept | {"tokens": [], "usage": data["usage"] | {"estimated_tokens": 0, "written_tokens": 0}}


def checked(data: Any, kinds: Mapping[str, tuple[type, ...]], what: str) -> dict[str, Any]:
    """Return the data if it is an object with just these fields of these types.

    Raises:
        ValueError: it is not; the message says what it is and what was expected.
    """
    if not isinstance(data, dict) or data.keys() != kinds.keys():
        raise ValueError(f"{what} should be an object with {', '.join(kinds)}")
    for name, expected in kinds.items():
        if type(data[name]) not in expected:
            raise ValueError(f"{name} of {what} is {str(data[name])[:40]!r}, expected {expected[0].__name__}")
    return data


def to_json(value: object) -> str:
    """Return the value as JSON on one line that can be written as UTF-8."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), default=_as_dict)
    # Lone surrogates stand in strings only, where what this makes of them is JSON's own escape.
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _as_dict(value: object) -> dict[str, Any]:
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"{type(value).__name__} is not JSON")
