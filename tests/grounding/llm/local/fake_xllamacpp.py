"""A fake xllamacpp: its server keeps a cache that records in which batches its tokens were read."""

import json
import math
from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread
from types import ModuleType, SimpleNamespace
from typing import Any

from tests.grounding.llm.local.fakes import FakeTokens, Probabilities

TEMPLATE = "<sys>{system}</sys><ask>{user}</ask>"
MARKS = ("<sys>", "</sys><ask>", "</ask>")
WINDOW = 8192


class FakeXllamacpp(ModuleType):
    """The module. Its tokens are those of `FakeTokens`, and the marks of the template are control tokens."""

    __version__ = "0.0"
    ggml_backend_dev_type = SimpleNamespace(GGML_BACKEND_DEVICE_TYPE_CPU=0)
    llama_flash_attn_type = SimpleNamespace(LLAMA_FLASH_ATTN_TYPE_DISABLED="no flash attention")

    def __init__(
        self,
        predict: Callable[[str], Probabilities],
        *pieces: str,
        is_readable: bool = True,
        has_begin: bool = False,
        memory: int = WINDOW,
        devices: tuple[int, ...] = (0,),
    ) -> None:
        super().__init__("xllamacpp")
        self.predict, self.is_readable, self.has_begin, self.memory = predict, is_readable, has_begin, memory
        self.devices = devices
        self.tokens = FakeTokens(*pieces)
        self.controls = {mark: len(self.tokens.pieces) + index for index, mark in enumerate(MARKS)}
        self.size = len(self.tokens.pieces) + len(MARKS)
        self.servers: list[FakeServer] = []

    def get_device_info(self) -> list[dict[str, int]]:
        return [{"type": kind} for kind in self.devices]

    def CommonParams(self) -> SimpleNamespace:  # noqa: N802 - the library's name
        return SimpleNamespace(model=SimpleNamespace(), cpuparams=SimpleNamespace(), cpuparams_batch=SimpleNamespace())

    def Server(self, settings: SimpleNamespace) -> "FakeServer":  # noqa: N802 - the library's name
        if not self.is_readable or settings.n_ctx > self.memory:
            raise RuntimeError("Failed to init server, please check the input params.")
        self.servers.append(FakeServer(self, settings))
        return self.servers[-1]

    def encode(self, text: str, *, is_special: bool) -> list[int]:
        """Return the tokens of a text, its marks as control tokens if `is_special`."""
        for mark, token in self.controls.items():
            if is_special and mark in text:
                before, _, after = text.partition(mark)
                return [*self.encode(before, is_special=True), token, *self.encode(after, is_special=True)]
        return self.tokens.tokenize(text)

    def spell(self, token: int) -> bytes:
        """Return the bytes of a token."""
        return b"" if token in self.controls.values() else self.tokens.pieces[token]


class FakeServer:
    """The server, which also answers over HTTP."""

    def __init__(self, library: FakeXllamacpp, settings: SimpleNamespace) -> None:
        self._library, self.settings = library, settings
        self.cache: list[tuple[int, int]] = []
        """(token, number of tokens that were read with it), for each cached token."""
        self.completions: list[dict[str, Any]] = []
        self.paths: list[str] = []
        self._http = ThreadingHTTPServer(("127.0.0.1", 0), _handler(self))
        Thread(target=self._http.serve_forever, args=(0.01,), daemon=True).start()
        self.listening_address = f"http://127.0.0.1:{self._http.server_address[1]}"

    def __del__(self) -> None:
        self._http.shutdown()
        self._http.server_close()

    def handle_completions(self, request: dict[str, Any]) -> dict[str, Any]:
        self.completions.append(request)
        prompt = request["prompt"]
        if len(prompt) >= self.settings.n_ctx:
            return {"error": {"code": 400, "message": "exceeds the available context size"}}
        held = [token for token, _ in self.cache] if request["cache_prompt"] else []
        same = next(
            (i for i, (a, b) in enumerate(zip(held, prompt, strict=False)) if a != b), min(len(held), len(prompt))
        )
        start = min(same, len(prompt) - 1)
        self.cache = self.cache[:start] + [(token, len(prompt) - start) for token in prompt[start:]]
        written = b"".join(map(self._library.spell, prompt)).decode("utf-8", "replace")
        found = dict.fromkeys(range(self._library.size), 1e-9)
        for piece, share in self._library.predict(written).items():
            found[self._library.tokens.token(piece)] = share
        ranked = sorted(found.items(), key=lambda row: (-row[1], row[0]))[: request["logprobs"]]
        rows = [{"id": t, "bytes": list(self._library.spell(t)), "logprob": math.log(share)} for t, share in ranked]
        return {"choices": [{"logprobs": {"content": [{"top_logprobs": rows}]}}]}

    def answer(self, path: str, body: dict[str, Any]) -> tuple[int, dict[str, Any]]:
        """Return status and answer to an HTTP request."""
        self.paths.append(path)
        if path == "/v1/models":
            meta = {"n_ctx_train": WINDOW, "n_vocab": self._library.size}
            return 200, {"data": [{"meta": meta}]}
        if path == "/tokenize":
            begin = [self._library.controls["<sys>"]] if self._library.has_begin and body["add_special"] else []
            return 200, {
                "tokens": begin + self._library.encode(body["content"], is_special=body.get("parse_special", True))
            }
        if path == "/apply-template" and [one["role"] for one in body["messages"]] == ["system", "user"]:
            system, user = (one["content"] for one in body["messages"])
            return 200, {"prompt": TEMPLATE.format(system=system, user=user)}
        return 400, {"error": {"message": f"cannot do {path}"}}


def _handler(server: FakeServer) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            self.do_POST()

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers.get("Content-Length") or 0)) or "{}")
            is_known = self.headers["Authorization"] == f"Bearer {server.settings.api_keys[0]}"
            status, answer = server.answer(self.path, body) if is_known else (401, {"error": "no key"})
            self.send_response(status)
            self.end_headers()
            self.wfile.write(json.dumps(answer).encode())

        def log_message(self, *_: Any) -> None: ...

    return Handler
