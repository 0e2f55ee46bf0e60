"""Replies of Amazon Bedrock's Converse API, whose streams are frames of `application/vnd.amazon.eventstream`."""

import json
import struct
import zlib
from collections.abc import Iterable, Iterator

from tests.grounding.llm.servers import Reply, pieces

USAGE = {"inputTokens": 40, "outputTokens": 7, "totalTokens": 107, "cacheReadInputTokens": 60}


def frame(kind: str, payload: dict, *, is_error: bool = False) -> bytes:
    """Return an event: lengths, their checksum, headers, payload, and the checksum of all."""
    names = ("exception", "exception-type") if is_error else ("event", "event-type")
    values = {":message-type": names[0], f":{names[1]}": kind, ":content-type": "application/json"}
    headers = b"".join(
        struct.pack("!B", len(name)) + name.encode() + struct.pack("!BH", 7, len(value)) + value.encode()
        for name, value in values.items()
    )
    body = json.dumps(payload).encode()
    prelude = struct.pack("!II", 16 + len(headers) + len(body), len(headers))
    message = prelude + struct.pack("!I", zlib.crc32(prelude)) + headers + body
    return message + struct.pack("!I", zlib.crc32(message))


def converse_reply(text: str, *, finish: str = "end_turn") -> Reply:
    """Return a response of Converse with 40 uncached and 60 cached input tokens, and 7 output tokens."""
    message = {"role": "assistant", "content": [{"text": text}]}
    return Reply(
        {"output": {"message": message}, "stopReason": finish, "usage": USAGE, "metrics": {"latencyMs": 1}},
        events=lambda: converse_events(pieces(text), finish=finish),
        stream_type="application/vnd.amazon.eventstream",
    )


def converse_events(texts: Iterable[str], *, finish: str | None = "end_turn") -> Iterator[bytes]:
    """Yield the frames of ConverseStream, with the usage in the last one."""
    yield frame("messageStart", {"role": "assistant"})
    for text in texts:
        yield frame("contentBlockDelta", {"contentBlockIndex": 0, "delta": {"text": text}})
    yield frame("contentBlockStop", {"contentBlockIndex": 0})
    if finish is not None:
        yield frame("messageStop", {"stopReason": finish})
        yield frame("metadata", {"usage": USAGE, "metrics": {"latencyMs": 1}})
