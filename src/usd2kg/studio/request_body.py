"""Bodies of requests: read within limits, with checked fields."""

import json
from typing import Any, TypeVar

from starlette.requests import ClientDisconnect, Request

from usd2kg.studio.settings import SERVER

__all__ = ["BadRequestError", "field", "object_indices", "read_body"]

_T = TypeVar("_T")


class BadRequestError(Exception):
    """A request that is refused, with its HTTP status and a message."""

    def __init__(self, text: str, status: int = 400) -> None:
        super().__init__(text)
        self.status = status


async def read_body(request: Request) -> dict[str, Any]:
    """Return the JSON object in the body of a request.

    Raises:
        BadRequestError: it is none, or too large.
    """
    if request.headers.get("content-type", "").partition(";")[0].strip().lower() != "application/json":
        raise BadRequestError("expected a body of type application/json", 415)
    data = b""
    try:
        async for piece in request.stream():
            data += piece
            if len(data) > SERVER.max_body_bytes:
                raise BadRequestError(f"the request is larger than {SERVER.max_body_bytes} bytes", 413)
        body = json.loads(data)
        # An escape may be half of a character, which cannot be stored or sent.
        json.dumps(body, ensure_ascii=False).encode()
    except ClientDisconnect as error:
        raise BadRequestError("the request is incomplete") from error
    except (ValueError, RecursionError) as error:
        raise BadRequestError(f"the body is not JSON ({error})") from error
    if not isinstance(body, dict):
        raise BadRequestError("the body is not a JSON object")
    return body


def field(body: dict[str, Any], name: str, kind: type[_T], default: _T | None = None) -> _T:
    """Return a field of a body.

    Raises:
        BadRequestError: it is missing without a default, of another type, or a text that is too long.
    """
    value = body.get(name, default)
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise BadRequestError(f"field {name}: found {type(value).__name__}, expected {kind.__name__}")
    if isinstance(value, str) and len(value) > SERVER.max_text and name != "query":
        raise BadRequestError(f"field {name}: has {len(value)} characters, expected at most {SERVER.max_text}")
    return value


def object_indices(body: dict[str, Any], count: int) -> list[int]:
    """Return the field `objects`: indices of objects.

    Raises:
        BadRequestError: an entry is not an index of an object, or there are none or too many.
    """
    indices = field(body, "objects", list)
    if not 1 <= len(indices) <= SERVER.max_objects_per_decision:
        raise BadRequestError(f"field objects: has {len(indices)} entries, expected at least one")
    for index in indices:
        if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < count:
            raise BadRequestError(f"field objects: {str(index)[:20]!r} is not an object; expected 0 to {count - 1}")
    return indices
