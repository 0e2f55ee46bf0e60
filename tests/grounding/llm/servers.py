"""Local servers that answer as OpenAI's, Google's and Anthropic's do, from a queue of replies."""

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


@dataclass(frozen=True)
class Reply:
    body: object = None
    status: int = 200
    headers: dict[str, str] = field(default_factory=dict)
    is_broken: bool = False
    """The connection ends in the middle of the body."""
    hangs: bool = False
    """No answer comes while the server lives."""
    is_raw: bool = False
    """The body is text that is not JSON."""

    def encode(self) -> bytes:
        return str(self.body).encode() if self.is_raw else json.dumps(self.body).encode()


@dataclass(frozen=True)
class Received:
    path: str
    headers: dict[str, str]
    """Names in lower case."""
    body: dict
    port: int
    """The client's, one a connection."""


class FakeServer:
    """Answers with the replies in their order, and with the last one from then on."""

    def __init__(self, *replies: Reply) -> None:
        self._replies = list(replies)
        self._lock = threading.Lock()
        self._is_closing = threading.Event()
        self.received: list[Received] = []
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
        self._http.server_close()
        self._thread.join()

    def _take(self, received: Received) -> Reply:
        with self._lock:
            self.received.append(received)
            return self._replies.pop(0) if len(self._replies) > 1 else self._replies[0]

    def _make_handler(self) -> type[BaseHTTPRequestHandler]:
        server = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"
            wbufsize = -1

            def do_POST(self) -> None:
                size = int(self.headers["Content-Length"])
                headers = {name.lower(): value for name, value in self.headers.items()}
                reply = server._take(
                    Received(self.path, headers, json.loads(self.rfile.read(size)), self.client_address[1])
                )
                if reply.hangs:
                    server._is_closing.wait()
                    self.close_connection = True
                    return
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


def openai_reply(text: str, *, finish: str = "stop", logprobs: list[float] | None = None, thinking: str = "") -> Reply:
    """Chat completions: 100 input tokens of which 60 were cached, 7 output tokens."""
    message = {"role": "assistant", "content": text} | ({"reasoning_content": thinking} if thinking else {})
    choice: dict = {"index": 0, "message": message, "finish_reason": finish}
    if logprobs is not None:
        tokens = [{"token": "t", "logprob": value, "bytes": None, "top_logprobs": []} for value in logprobs]
        choice["logprobs"] = {"content": tokens, "refusal": None}
    usage = {
        "prompt_tokens": 100,
        "completion_tokens": 7,
        "total_tokens": 107,
        "prompt_tokens_details": {"cached_tokens": 60},
    }
    return Reply(
        {
            "id": "c1",
            "object": "chat.completion",
            "created": 1,
            "model": "m",
            "choices": [choice],
            "usage": usage,
        }
    )


def gemini_reply(text: str, *, finish: str = "STOP", thinking: str = "") -> Reply:
    """generateContent: 100 input tokens of which 60 were cached, 7 tokens of answer and 5 of thought."""
    thoughts = [{"text": thinking, "thought": True}] if thinking else []
    return Reply(
        {
            "candidates": [
                {"content": {"role": "model", "parts": [*thoughts, {"text": text}]}, "finishReason": finish, "index": 0}
            ],
            "usageMetadata": {
                "promptTokenCount": 100,
                "cachedContentTokenCount": 60,
                "candidatesTokenCount": 7,
                "thoughtsTokenCount": 5,
                "totalTokenCount": 112,
            },
            "modelVersion": "gemini-2.5-flash",
            "responseId": "r1",
        }
    )


def anthropic_reply(text: str, *, finish: str = "end_turn", thinking: str = "") -> Reply:
    """Messages: 40 input tokens read anew, 60 from the cache, 7 output tokens."""
    thoughts = [{"type": "thinking", "thinking": thinking, "signature": "s"}] if thinking else []
    return Reply(
        {
            "id": "msg_1",
            "type": "message",
            "role": "assistant",
            "model": "claude-sonnet-4-5",
            "content": [*thoughts, {"type": "text", "text": text}],
            "stop_reason": finish,
            "stop_sequence": None,
            "usage": {
                "input_tokens": 40,
                "cache_read_input_tokens": 60,
                "cache_creation_input_tokens": 0,
                "output_tokens": 7,
            },
        }
    )


def refuse(status: int, message: str, **headers: str) -> Reply:
    """An error in the shape that OpenAI, Google and Anthropic share."""
    return Reply(
        {"type": "error", "error": {"type": "some_error", "code": status, "message": message}},
        status,
        {name.replace("_", "-"): value for name, value in headers.items()},
    )
