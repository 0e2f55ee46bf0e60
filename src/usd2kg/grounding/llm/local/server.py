"""LlamaServer: the server of llama.cpp that xllamacpp runs in this process.

xllamacpp has prebuilt wheels, but no functions for single tokens. Its server has them: a completion of one token states
the probabilities of the next one. It listens on the loopback interface with a random key, for the requests that the
module has no function for.
"""

import http.client
import json
import secrets
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple
from urllib.parse import urlsplit

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.context_size import context_size

__all__ = ["LlamaServer", "NextToken"]


class NextToken(NamedTuple):
    """A possible next token."""

    token: int
    piece: bytes
    """Its bytes; empty for control tokens."""
    logprob: float
    """Natural log-probability among all tokens."""


class LlamaServer:
    """A server with one slot, whose KV cache keeps the tokens of the last request."""

    def __init__(self, library: ModuleType, path: Path, threads: int) -> None:
        """Load the weights with the smallest context.

        Raises:
            GroundingError: llama.cpp cannot load them.
        """
        self._library, self._path, self._threads = library, path, threads
        self._key = secrets.token_hex()
        self._server: Any = None
        self._size = 0
        self.reserve(LIMITS.min_context_tokens, LIMITS.min_context_tokens)
        (model,) = self._ask("GET", "/v1/models", None)["data"]
        self.window: int = model["meta"]["n_ctx_train"]
        """Size of the context window in tokens, as trained."""
        self.vocabulary_size: int = model["meta"]["n_vocab"]

    def close(self) -> None:
        """Free the memory."""
        self._server, self._size = None, 0

    def reserve(self, size: int, window: int) -> bool:
        """Ensure a context of at least `size` tokens; return whether it is new, with an empty cache.

        Raises:
            GroundingError: llama.cpp cannot load the weights, or has no memory for the context.
        """
        if size <= self._size:
            return False
        self.close()
        size = context_size(size, window)
        try:
            self._server = self._library.Server(self._settings(size))
        except RuntimeError as error:
            raise GroundingError(
                f"{self._path}: llama.cpp (xllamacpp {self._library.__version__}) cannot load it with a context of "
                f"{size} tokens: {error} Expected a complete GGUF file of a supported model, and memory for both"
            ) from error
        self._size = size
        return True

    def predict(self, tokens: Sequence[int], count: int, *, is_cached: bool = True) -> list[NextToken]:
        """Return the `count` most probable tokens after some tokens, the most probable first.

        Args:
            tokens: everything before; its last token is read in any case.
            count: number of tokens to return.
            is_cached: keep the tokens that the cache has of the last request.

        Raises:
            GroundingError: llama.cpp failed.
        """
        request = {"prompt": list(tokens), "max_tokens": 1, "temperature": 0, "cache_prompt": is_cached}
        answer = self._server.handle_completions(request | {"logprobs": count})
        if "error" in answer:
            raise GroundingError(f"{self._path}: llama.cpp failed after {len(tokens)} tokens: {answer['error']}")
        (place,) = answer["choices"][0]["logprobs"]["content"]
        return [NextToken(row["id"], bytes(row["bytes"]), row["logprob"]) for row in place["top_logprobs"]]

    def post(self, path: str, body: Mapping[str, Any]) -> Mapping[str, Any]:
        """Return the server's answer to a request.

        Raises:
            GroundingError: the server rejects it.
        """
        return self._ask("POST", path, json.dumps(body))

    def _ask(self, method: str, path: str, body: str | None) -> Mapping[str, Any]:
        host = urlsplit(self._server.listening_address).netloc
        connection = http.client.HTTPConnection(host, timeout=LIMITS.request_timeout_s)
        headers = {"Authorization": f"Bearer {self._key}", "Content-Type": "application/json"}
        try:
            connection.request(method, path, body, headers)
            response = connection.getresponse()
            answer: Mapping[str, Any] = json.loads(response.read())
        except (OSError, http.client.HTTPException, ValueError) as error:
            raise GroundingError(f"{self._path}: llama.cpp's server failed at {path}: {error!r}") from error
        finally:
            connection.close()
        if response.status != http.client.OK:
            raise GroundingError(f"{self._path}: llama.cpp's server answers {response.status} at {path}: {answer}")
        return answer

    def _settings(self, size: int) -> Any:
        settings = self._library.CommonParams()
        settings.model.path = str(self._path)
        settings.n_ctx, settings.n_parallel = size, 1
        settings.n_batch = settings.n_ubatch = LIMITS.decode_batch_tokens
        settings.cpuparams.n_threads = settings.cpuparams_batch.n_threads = self._threads
        settings.api_keys, settings.hostnames, settings.port = [self._key], ["127.0.0.1"], 0
        settings.ui = settings.endpoint_slots = settings.warmup = False
        # The cache keeps exactly the last request: no copies of earlier ones, and all of a sliding window.
        settings.cache_ram_mib, settings.n_ctx_checkpoints, settings.swa_full = 0, 0, True
        settings.fit_params = False
        # On processors, flash attention takes twice the time for a short text after a long cached one.
        processor = self._library.ggml_backend_dev_type.GGML_BACKEND_DEVICE_TYPE_CPU
        if all(device["type"] == processor for device in self._library.get_device_info()):
            settings.flash_attn_type = self._library.llama_flash_attn_type.LLAMA_FLASH_ATTN_TYPE_DISABLED
        # No messages of llama.cpp.
        settings.verbosity = -1
        return settings
