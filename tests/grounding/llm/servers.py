"""Fake HTTP servers with the APIs of the providers, which answer from a queue of replies."""

import json
import socket
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from itertools import islice


@dataclass(frozen=True)
class Reply:
    body: object = None
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    is_broken: bool = False
    """Close the connection in the middle of the body."""
    hangs: bool = False
    """Never answer."""
    is_raw: bool = False
    """The body is text that is not JSON."""
    events: Callable[[], Iterable[str | bytes]] | None = None
    """Server-sent events, or frames, if the client requests a stream; None to answer without streaming."""
    stream_type: str = "text/event-stream"
    """Content type of the events."""
    pause_s: float = 0.0
    """Pause between two events."""
    together: threading.Barrier | None = None
    """Wait until this many requests have arrived."""

    def encode(self) -> bytes:
        return str(self.body).encode() if self.is_raw else json.dumps(self.body).encode()


@dataclass(frozen=True)
class Received:
    path: str
    headers: dict[str, str]
    """Header names are in lower case."""
    body: dict
    port: int
    """Port of the client, which identifies the connection."""

    @property
    def asks_for_stream(self) -> bool:
        return (
            bool(self.body.get("stream"))
            or ":streamGenerateContent" in self.path
            or self.path.endswith("/converse-stream")
        )


class FakeServer:
    """Answers with the replies in order, then repeats the last one."""

    def __init__(self, *replies: Reply) -> None:
        self._replies = list(replies)
        self._lock = threading.Lock()
        self._is_closing = threading.Event()
        self._connections: set[socket.socket] = set()
        self.received: list[Received] = []
        self._at_once = 0
        self.most_at_once = 0
        """Largest number of requests in progress at the same time."""
        self.events_sent = 0
        self.streams_cut_off = 0
        """Streams that the client closed before their end."""
        self._http = ThreadingHTTPServer(("127.0.0.1", 0), self._make_handler())
        self._http.daemon_threads = False
        self._thread = threading.Thread(target=self._http.serve_forever, kwargs={"poll_interval": 0.01})
        self._thread.start()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self._http.server_port}"

    def close(self) -> None:
        self._is_closing.set()
        self._http.shutdown()
        with self._lock:
            connections = list(self._connections)
        for connection in connections:
            # Bedrock's client leaves connections open until the garbage collector runs.
            with suppress(OSError):
                connection.shutdown(socket.SHUT_RDWR)
        self._http.server_close()
        self._thread.join()

    def _take(self, received: Received) -> Reply:
        with self._lock:
            self.received.append(received)
            return self._replies.pop(0) if len(self._replies) > 1 else self._replies[0]

    @contextmanager
    def _answering(self) -> Iterator[None]:
        with self._lock:
            self._at_once += 1
            self.most_at_once = max(self.most_at_once, self._at_once)
        try:
            yield
        finally:
            with self._lock:
                self._at_once -= 1

    def _make_handler(self) -> type[BaseHTTPRequestHandler]:
        server = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"
            wbufsize = -1
            disable_nagle_algorithm = True

            def setup(self) -> None:
                super().setup()
                with server._lock:
                    server._connections.add(self.connection)

            def finish(self) -> None:
                with server._lock:
                    server._connections.discard(self.connection)
                super().finish()

            def do_POST(self) -> None:
                size = int(self.headers["Content-Length"])
                headers = {name.lower(): value for name, value in self.headers.items()}
                received = Received(self.path, headers, json.loads(self.rfile.read(size)), self.client_address[1])
                with server._answering():
                    self._reply(server._take(received), received)

            def _reply(self, reply: Reply, received: Received) -> None:
                if reply.together is not None:
                    reply.together.wait(timeout=60)
                if reply.hangs:
                    server._is_closing.wait()
                    self.close_connection = True
                elif reply.events is not None and received.asks_for_stream:
                    self._stream(reply, reply.events())
                else:
                    self._answer(reply)

            def _answer(self, reply: Reply) -> None:
                body = reply.encode()
                self.send_response(reply.status)
                self.send_header("Content-Type", "text/plain" if reply.is_raw else "application/json")
                self.send_header("Content-Length", str(len(body)))
                for name, value in reply.headers.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(body[: len(body) // 2] if reply.is_broken else body)
                self.close_connection |= reply.is_broken

            def _stream(self, reply: Reply, events: Iterable[str | bytes]) -> None:
                self.send_response(reply.status)
                self.send_header("Content-Type", reply.stream_type)
                self.send_header("Transfer-Encoding", "chunked")
                self.end_headers()
                try:
                    self._send_events(reply, events)
                except ConnectionError:
                    with server._lock:
                        server.streams_cut_off += 1
                    self.close_connection = True

            def _send_events(self, reply: Reply, events: Iterable[str | bytes]) -> None:
                for event in events:
                    data = event.encode() if isinstance(event, str) else event
                    self.wfile.write(b"%x\r\n%b\r\n" % (len(data), data))
                    self.wfile.flush()
                    with server._lock:
                        server.events_sent += 1
                    if server._is_closing.wait(reply.pause_s):
                        break
                if not reply.is_broken:
                    self.wfile.write(b"0\r\n\r\n")
                self.close_connection |= reply.is_broken

            def log_message(self, format: str, *args: object) -> None:
                pass

        return Handler


@contextmanager
def serve(*replies: Reply) -> Iterator[FakeServer]:
    server = FakeServer(*replies)
    try:
        yield server
    finally:
        server.close()


def pieces(text: str, size: int = 4) -> list[str]:
    """Return a text in pieces of about the length of a token."""
    return [text[start : start + size] for start in range(0, len(text), size)]


def sse(data: object, name: str | None = None) -> str:
    """Return a server-sent event."""
    return (f"event: {name}\n" if name else "") + f"data: {json.dumps(data)}\n\n"


def broken_off(reply: Reply, after: int) -> Reply:
    """Return a reply whose connection breaks after `after` events."""
    whole = reply.events
    assert whole is not None
    return replace(reply, events=lambda: islice(whole(), after), is_broken=True)


OPENAI_USAGE = {
    "prompt_tokens": 100,
    "completion_tokens": 7,
    "total_tokens": 107,
    "prompt_tokens_details": {"cached_tokens": 60},
}
GEMINI_USAGE = {
    "promptTokenCount": 100,
    "cachedContentTokenCount": 60,
    "candidatesTokenCount": 7,
    "thoughtsTokenCount": 5,
    "totalTokenCount": 112,
}
ANTHROPIC_USAGE = {
    "input_tokens": 40,
    "cache_read_input_tokens": 60,
    "cache_creation_input_tokens": 0,
    "output_tokens": 7,
}


Token = tuple[str | bytes, float]
"""Text and log-probability of a token; bytes if it ends inside a character."""


def openai_reply(text: str, *, finish: str = "stop", tokens: Sequence[Token] = (), thinking: str = "") -> Reply:
    """Return a chat completion with 100 input tokens, 60 of them cached, and 7 output tokens."""
    message = {"role": "assistant", "content": text} | ({"reasoning_content": thinking} if thinking else {})
    choice: dict = {"index": 0, "message": message, "finish_reason": finish}
    if tokens:
        choice["logprobs"] = _openai_logprobs(tokens)
    head = {"id": "c1", "created": 1, "model": "m"}
    return Reply(
        {**head, "object": "chat.completion", "choices": [choice], "usage": OPENAI_USAGE},
        events=lambda: openai_events(pieces(text), finish=finish, tokens=tokens, thinking=thinking),
    )


def openai_events(
    texts: Iterable[str],
    *,
    finish: str | None = "stop",
    tokens: Sequence[Token] = (),
    thinking: str = "",
    usage: dict | None = OPENAI_USAGE,
) -> Iterator[str]:
    """Yield the chunks of a chat completion, with the usage in a separate chunk at the end."""
    head = {"id": "c1", "object": "chat.completion.chunk", "created": 1, "model": "m"}

    def chunk(delta: dict, **more: object) -> str:
        return sse({**head, "choices": [{"index": 0, "delta": delta, "finish_reason": None, **more}], "usage": None})

    yield chunk({"role": "assistant", "content": ""})
    for piece in pieces(thinking):
        yield chunk({"reasoning_content": piece})
    for piece in texts:
        yield chunk({"content": piece})
    for token in tokens:
        yield chunk({}, logprobs=_openai_logprobs([token]))
    if finish is not None:
        yield chunk({}, finish_reason=finish)
    if usage is not None:
        yield sse({**head, "choices": [], "usage": usage})
    yield "data: [DONE]\n\n"


def _openai_logprobs(tokens: Sequence[Token]) -> dict:
    def describe(text: str | bytes, logprob: float) -> dict:
        raw = text if isinstance(text, bytes) else text.encode()
        # OpenAI names a token that is not valid UTF-8 by its bytes.
        name = text if isinstance(text, str) else "bytes:" + "".join(f"\\x{byte:02x}" for byte in text)
        return {"token": name, "logprob": logprob, "bytes": list(raw), "top_logprobs": []}

    return {"content": [describe(*token) for token in tokens], "refusal": None}


def openai_call(arguments: str, *, finish: str = "tool_calls") -> Reply:
    """Return a streamed chat completion that calls a tool, as vLLM and Ollama send it."""
    head = {"id": "c1", "object": "chat.completion.chunk", "created": 1, "model": "m"}

    def chunk(delta: dict, reason: str | None = None) -> str:
        return sse({**head, "choices": [{"index": 0, "delta": delta, "finish_reason": reason}]})

    def events() -> Iterator[str]:
        function = {"name": "answer", "arguments": ""}
        yield chunk(
            {"role": "assistant", "tool_calls": [{"index": 0, "id": "t", "type": "function"} | {"function": function}]}
        )
        for piece in pieces(arguments):
            yield chunk({"tool_calls": [{"index": 0, "function": {"arguments": piece}}]})
        yield chunk({}, finish)
        yield sse({**head, "choices": [], "usage": OPENAI_USAGE})
        yield "data: [DONE]\n\n"

    return Reply(events=events)


def gemini_reply(text: str, *, finish: str = "STOP", thinking: str = "") -> Reply:
    """Return a response of generateContent with 100 input tokens, 60 of them cached, 7 answer and 5 thought tokens."""
    thoughts = [{"text": thinking, "thought": True}] if thinking else []
    candidate = {
        "content": {"role": "model", "parts": [*thoughts, {"text": text}]},
        "finishReason": finish,
        "index": 0,
    }
    return Reply(
        {"candidates": [candidate], "usageMetadata": GEMINI_USAGE, **_GEMINI_HEAD},
        events=lambda: gemini_events(pieces(text), finish=finish, thinking=thinking),
    )


_GEMINI_HEAD = {"modelVersion": "gemini-2.5-flash", "responseId": "r1"}


def gemini_events(texts: Iterable[str], *, finish: str | None = "STOP", thinking: str = "") -> Iterator[str]:
    """Yield the responses of streamGenerateContent, each with the usage so far, one token per piece."""

    def response(parts: list[dict], usage: dict, **more: object) -> str:
        content = {"role": "model", "parts": parts}
        return sse({"candidates": [{"content": content, "index": 0, **more}], "usageMetadata": usage, **_GEMINI_HEAD})

    counted = {"promptTokenCount": 100, "cachedContentTokenCount": 60, "thoughtsTokenCount": 5 if thinking else 0}
    for piece in pieces(thinking):
        yield response([{"text": piece, "thought": True}], counted)
    for number, piece in enumerate(texts, start=1):
        yield response([{"text": piece}], counted | {"candidatesTokenCount": number})
    if finish is not None:
        yield response([{"text": ""}], GEMINI_USAGE, finishReason=finish)


def anthropic_reply(text: str, *, finish: str = "end_turn", thinking: str = "") -> Reply:
    """Return a message with 40 uncached and 60 cached input tokens, and 7 output tokens."""
    thoughts = [{"type": "thinking", "thinking": thinking, "signature": "s"}] if thinking else []
    return Reply(
        {
            **_ANTHROPIC_HEAD,
            "content": [*thoughts, {"type": "text", "text": text}],
            "stop_reason": finish,
            "stop_sequence": None,
            "usage": ANTHROPIC_USAGE,
        },
        events=lambda: anthropic_events(pieces(text), finish=finish, thinking=thinking),
    )


_ANTHROPIC_HEAD = {"id": "msg_1", "type": "message", "role": "assistant", "model": "claude-sonnet-4-5"}


def anthropic_events(texts: Iterable[str], *, finish: str | None = "end_turn", thinking: str = "") -> Iterator[str]:
    """Yield the events of a message, which report input tokens at the start and output tokens at the end."""

    def event(kind: str, **data: object) -> str:
        return sse({"type": kind, **data}, kind)

    def block(index: int, kind: str, deltas: Iterable[dict]) -> Iterator[str]:
        empty = {"type": kind, kind: ""} | ({"signature": ""} if kind == "thinking" else {})
        yield event("content_block_start", index=index, content_block=empty)
        for delta in deltas:
            yield event("content_block_delta", index=index, delta=delta)
        yield event("content_block_stop", index=index)

    head = {**_ANTHROPIC_HEAD, "content": [], "stop_reason": None, "stop_sequence": None}
    yield event("message_start", message=head | {"usage": ANTHROPIC_USAGE | {"output_tokens": 1}})
    yield event("ping")
    if thinking:
        thoughts = [{"type": "thinking_delta", "thinking": piece} for piece in pieces(thinking)]
        yield from block(0, "thinking", [*thoughts, {"type": "signature_delta", "signature": "s"}])
    yield from block(1 if thinking else 0, "text", ({"type": "text_delta", "text": piece} for piece in texts))
    if finish is not None:
        end = {"stop_reason": finish, "stop_sequence": None}
        yield event("message_delta", delta=end, usage={"output_tokens": ANTHROPIC_USAGE["output_tokens"]})
        yield event("message_stop")


def refuse(status: int, message: str, **headers: str) -> Reply:
    """Return an error response that the clients of all providers understand."""
    return Reply(
        {"type": "error", "message": message, "error": {"type": "some_error", "code": status, "message": message}},
        status,
        {name.replace("_", "-"): value for name, value in headers.items()},
    )
