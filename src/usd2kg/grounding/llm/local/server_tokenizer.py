"""ServerTokenizer: the tokenizer of a model that `LlamaServer` has loaded."""

import mmap
from functools import cached_property, lru_cache
from pathlib import Path

from usd2kg.errors import GroundingError
from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.chat_template import PLAIN_FRAME, Frame, Message, read_template
from usd2kg.grounding.llm.local.server import LlamaServer
from usd2kg.grounding.llm.local.tokenizer import Tokenizer

__all__ = ["ServerTokenizer", "has_chat_template"]

_TEMPLATE_KEY = b"tokenizer.chat_template"
"""Key of the metadata, https://github.com/ggml-org/ggml/blob/master/docs/gguf.md."""


class ServerTokenizer(Tokenizer):
    """The tokenizer of a model loaded by llama.cpp's server."""

    def __init__(self, server: LlamaServer, path: Path) -> None:
        self._server, self._path = server, path
        # Each prompt has the names of the classes, and each text takes a request.
        self._known = lru_cache(LIMITS.max_known_texts)(self._tokens_of)

    @cached_property
    def pieces(self) -> list[bytes]:
        """The bytes of each token; empty for control tokens."""
        found = self._server.predict([0], self._server.vocabulary_size)
        return [piece for _, piece, _ in sorted(found)]

    @cached_property
    def ends(self) -> frozenset[int]:
        """The control tokens: the server does not say which of them end a generation, and a text has none."""
        return frozenset(token for token, piece in enumerate(self.pieces) if not piece)

    @cached_property
    def _frame(self) -> Frame:
        # For models without a template, the server has one of its own, whose special tokens they do not know.
        return read_template(self._render) if has_chat_template(self._path) else PLAIN_FRAME

    @cached_property
    def _begin(self) -> list[int]:
        added = self._server.post("/tokenize", {"content": "", "add_special": True})
        return list(added["tokens"])

    def _render(self, messages: list[Message]) -> str:
        request = {"messages": messages, "chat_template_kwargs": {"enable_thinking": False}}
        try:
            return str(self._server.post("/apply-template", request)["prompt"])
        except GroundingError as error:
            raise ValueError(str(error)) from error

    def _encode(self, text: str, *, is_template: bool) -> list[int]:
        return list(self._known(text, is_template))

    def _tokens_of(self, text: str, is_template: bool) -> tuple[int, ...]:
        content = text.encode("utf-8", "replace").decode()
        request = {"content": content, "add_special": False, "parse_special": is_template}
        return tuple(self._server.post("/tokenize", request)["tokens"])


def has_chat_template(path: Path) -> bool:
    """Return whether a GGUF file has a chat template."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        return data.find(_TEMPLATE_KEY) >= 0
