"""What is kept of a request and of its completion, as JSON."""

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
    "read_request_fields",
    "request_fields",
    "request_key",
    "to_json",
    "upgrade_completion",
]

_Kinds = dict[str, tuple[type, ...]]
"""Name → types, one of which its value has."""

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
"""The fields of a request, in the order in which they are kept. One with images has `images` behind them."""
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
"""What reading JSON raises that is not what was written."""


class CacheEntry(NamedTuple):
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
    """Return what is kept of a request: all of it, but of images the digests alone, and nothing where it has none."""
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
    """Return what was kept of a request.

    Raises:
        ValueError: it was not kept so.
    """
    has_images = isinstance(data, dict) and "images" in data
    values = checked(data, {**_REQUEST, **(_IMAGES if has_images else {})}, "request")
    images = values.get("images", ())
    if has_images and not (images and all(isinstance(image, str) and _DIGEST.fullmatch(image) for image in images)):
        raise ValueError(f"images of request is {str(images)[:40]!r}, expected SHA-256 digests")
    return order_request_fields(values)


def order_request_fields(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a request, out of more, in the order in which they are kept."""
    return {name: values[name] for name in (*_REQUEST, *_IMAGES) if name in values}


def make_entry(model: str, values: Mapping[str, Any], completion: Completion) -> CacheEntry:
    """Return what is kept of a request, given as its fields, and of its completion."""
    rest = {"model": model, **values}
    system, schema = (to_json(rest.pop(name)) for name in ("system", "schema"))
    shared = ((_digest(system), system), (_digest(schema), schema))
    said = to_json(_completion_fields(completion))
    return CacheEntry(shared, (_key(model, values), shared[0][0], shared[1][0], to_json(rest), said))


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
