"""LlamaTokenizer: the tokenizer of a model that llama-cpp-python has loaded."""

import ctypes
from functools import cached_property
from types import ModuleType
from typing import Any

from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.chat_template import PLAIN_FRAME, Frame, Message, read_template
from usd2kg.grounding.llm.local.tokenizer import Tokenizer

__all__ = ["LlamaTokenizer"]


class LlamaTokenizer(Tokenizer):
    """The tokenizer of a model loaded by llama.cpp."""

    def __init__(self, library: ModuleType, model: Any) -> None:
        self._library, self._model = library, model
        self._vocabulary = library.llama_model_get_vocab(model)

    @cached_property
    def pieces(self) -> list[bytes]:
        """The bytes of each token; empty for control tokens."""
        buffer = ctypes.create_string_buffer(LIMITS.max_token_bytes)
        write = self._library.llama_token_to_piece
        count = self._library.llama_vocab_n_tokens(self._vocabulary)
        sizes = (write(self._vocabulary, token, buffer, LIMITS.max_token_bytes, 0, False) for token in range(count))
        return [buffer.raw[: max(0, size)] for size in sizes]

    @cached_property
    def ends(self) -> frozenset[int]:
        """The end-of-generation tokens."""
        is_end = self._library.llama_vocab_is_eog
        return frozenset(token for token in range(len(self.pieces)) if is_end(self._vocabulary, token))

    @cached_property
    def _frame(self) -> Frame:
        source = self._library.llama_model_chat_template(self._model, None)
        if not source:
            return PLAIN_FRAME
        ends = self._library.llama_vocab_eos(self._vocabulary), self._library.llama_vocab_bos(self._vocabulary)
        return _read_jinja(source.decode("utf-8", "replace"), *map(self._special_token_text, ends))

    @property
    def _begin(self) -> list[int]:
        is_added = self._library.llama_vocab_get_add_bos(self._vocabulary)
        return [self._library.llama_vocab_bos(self._vocabulary)] if is_added else []

    def _special_token_text(self, token: int) -> str:
        if token < 0:
            return ""
        text: bytes = self._library.llama_vocab_get_text(self._vocabulary, token)
        return text.decode("utf-8", "replace")

    def _encode(self, text: str, *, is_template: bool) -> list[int]:
        data = text.encode("utf-8", "replace")
        room = len(data) + LIMITS.max_added_tokens
        tokens = (self._library.llama_token * room)()
        count = self._library.llama_tokenize(self._vocabulary, data, len(data), tokens, room, False, is_template)
        # Negative if the buffer is too small, but each token is at least one byte.
        assert count >= 0
        return list(tokens[:count])


def _read_jinja(source: str, eos: str, bos: str) -> Frame:
    from jinja2 import TemplateError  # noqa: PLC0415 - comes with llama-cpp-python
    from llama_cpp.llama_chat_format import Jinja2ChatFormatter  # noqa: PLC0415

    def render(messages: list[Message]) -> str:
        try:
            template = Jinja2ChatFormatter(source, eos_token=eos, bos_token=bos)
            return str(template(messages=messages, enable_thinking=False).prompt)
        except (TemplateError, TypeError) as error:
            raise ValueError(str(error)) from error

    return read_template(render)
