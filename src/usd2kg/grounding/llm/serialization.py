"""Requests and completions as JSON, for the cache and recordings."""

import hashlib
import json
import re
from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Any, NamedTuple

from usd2kg.grounding.llm.completion import Completion, Finish, Request, Usage

__all__ = [
    "UNREADABLE",
    "CacheEntry",
    "checked",
    "make_entry",
    "order_request_fields",
    "read_completion",
    "read_request",
    "read_request_fields",
    "request_fields",
    "request_key",
    "to_json",
    "upgrade_completion",
]

_Kinds = dict[str, tuple[type, ...]]
"""Name → allowed types of the value."""

_KEY_FORMAT = "usd2kg-request/1"
_REQUEST: _Kinds = {
    "system": (str,),
    "user": (str,),
    "schema": (dict,),
    "most_tokens": (int,),
    "temperature": (float,),
    "is_thinking": (bool,),
    "sample": (int,),
}
"""The fields of a request in their stored order, followed by `images` if it has any."""
_IMAGES: _Kinds = {"images": (list,)}
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
_DIGEST = re.compile("[0-9a-f]{64}")
UNREADABLE = (ValueError, OverflowError, RecursionError)
"""Exceptions of reading damaged JSON."""


class CacheEntry(NamedTuple):
    """The columns of a request and its completion in the cache."""

    shared: tuple[tuple[str, str], ...]
    """Digest and text of the system prompt and of the schema, which requests share."""
    values: tuple[str, str, str, str, str]
    """Key, digests of system prompt and schema, the rest of the request, and the completion."""


def request_key(model: str, request: Request) -> str:
    """Return the cache key of a request: `sha256:` and the hex digest of the model and all fields.

    The order of the schema's properties counts, since models answer in this order.
    """
    return _key(model, request_fields(request))


def _key(model: str, values: Mapping[str, Any]) -> str:
    parts = {"format": _KEY_FORMAT, "model": model, "request": values}
    return "sha256:" + _digest(json.dumps(parts, separators=(",", ":"), default=_as_dict, allow_nan=False))


def request_fields(request: Request) -> dict[str, Any]:
    """Return the stored fields of a request: all fields, with images replaced by their digests."""
    values = {
        "system": request.system,
        "user": request.user,
        "schema": request.schema,
        "most_tokens": request.max_tokens,
        "temperature": float(request.temperature),
        "is_thinking": request.is_thinking,
        "sample": request.sample,
    }
    images = [hashlib.sha256(image).hexdigest() for image in request.images]
    return values | ({"images": images} if images else {})


def read_request_fields(data: Any) -> dict[str, Any]:
    """Return the stored fields of a request after checking them.

    Raises:
        ValueError: a field is missing, unknown, or has the wrong type.
    """
    has_images = isinstance(data, dict) and "images" in data
    values = checked(data, {**_REQUEST, **(_IMAGES if has_images else {})}, "request")
    images = values.get("images", ())
    if has_images and not (images and all(isinstance(image, str) and _DIGEST.fullmatch(image) for image in images)):
        raise ValueError(f"images of request is {str(images)[:40]!r}, expected SHA-256 digests")
    return order_request_fields(values)


def read_request(fields: Mapping[str, Any]) -> Request:
    """Return the request with these stored fields; images are missing, since only their digests are stored."""
    return Request(
        system=fields["system"],
        user=fields["user"],
        schema=fields["schema"],
        max_tokens=fields["most_tokens"],
        temperature=fields["temperature"],
        is_thinking=fields["is_thinking"],
        sample=fields["sample"],
    )


def order_request_fields(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a request among `values`, in their stored order."""
    return {name: values[name] for name in (*_REQUEST, *_IMAGES) if name in values}


def make_entry(model: str, values: Mapping[str, Any], completion: Completion) -> CacheEntry:
    """Return the cache entry of a request, given as its stored fields, and its completion."""
    rest = {"model": model, **values}
    system, schema = (to_json(rest.pop(name)) for name in ("system", "schema"))
    shared = ((_digest(system), system), (_digest(schema), schema))
    completed = to_json(_completion_fields(completion))
    return CacheEntry(shared, (_key(model, values), shared[0][0], shared[1][0], to_json(rest), completed))


def _completion_fields(completion: Completion) -> dict[str, Any]:
    values: dict[str, Any] = {f.name: getattr(completion, f.name) for f in fields(Completion)}
    tokens = [(piece, float(logprob)) for piece, logprob in completion.tokens]
    return {**values, "usage": asdict(completion.usage), "tokens": tokens}


def read_completion(data: Any) -> Completion:
    """Return a completion from its stored fields.

    Raises:
        ValueError: a field is missing, unknown, or has the wrong type.
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
    """Return the stored fields of a completion, converted if they are in format 1.

    Format 1 stored only the mean log-probability of the tokens. It is dropped, since the log-probability of a class
    cannot be derived from it; the completion then has no tokens. Data in another format are returned unchanged.
    """
    if not isinstance(data, dict) or not isinstance(data.get("usage"), dict):
        return data
    if "mean_logprob" not in data or "tokens" in data:
        return data
    kept = {name: value for name, value in data.items() if name != "mean_logprob"}
    return kept | {"tokens": [], "usage": data["usage"] | {"estimated_tokens": 0, "written_tokens": 0}}


def checked(data: Any, kinds: Mapping[str, tuple[type, ...]], what: str) -> dict[str, Any]:
    """Return the data if it is an object with exactly these fields of these types.

    Raises:
        ValueError: the data has another form; the message states what was found and expected.
    """
    if not isinstance(data, dict) or data.keys() != kinds.keys():
        raise ValueError(f"{what} should be an object with {', '.join(kinds)}")
    for name, expected in kinds.items():
        if type(data[name]) not in expected:
            raise ValueError(f"{name} of {what} is {str(data[name])[:40]!r}, expected {expected[0].__name__}")
    return data


def to_json(value: object) -> str:
    """Return the value as JSON on one line that can be encoded as UTF-8."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), default=_as_dict)
    # Lone surrogates occur only in strings, where the backslash replacement is a JSON escape.
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _as_dict(value: object) -> dict[str, Any]:
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"{type(value).__name__} is not JSON")
