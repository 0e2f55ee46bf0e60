"""Tokenizer: text and prompts as tokens of a model."""

import ctypes
from functools import cached_property
from types import ModuleType
from typing import Any, NamedTuple

from usd2kg.grounding.llm.limits import LIMITS
from usd2kg.grounding.llm.local.chat_template import PLAIN_FRAME, Frame, Message, read_template

__all__ = ["Prompt", "Tokenizer"]


class Prompt(NamedTuple):
    """A prompt as tokens."""

    shared: tuple[int, ...]
    """Everything before the user prompt, which the requests of a run share."""
    own: tuple[int, ...]
    """The user prompt and the end of the template."""

    @property
    def tokens(self) -> tuple[int, ...]:
        """All tokens."""
        return self.shared + self.own


class Tokenizer:
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

    def tokenize(self, text: str) -> list[int]:
        """Return the tokens of a text within a longer one; special tokens in it are plain text."""
        prefix = self._encode(self._prefix, is_template=False)
        return self._encode(self._prefix + text, is_template=False)[len(prefix) :]

    def encode_prompt(self, system: str, user: str) -> Prompt:
        """Return system and user prompt in the model's chat template."""
        frame = self._frame
        before = self._encode(frame.before, is_template=True)
        bos = self._library.llama_vocab_bos(self._vocabulary)
        if self._library.llama_vocab_get_add_bos(self._vocabulary) and before[:1] != [bos]:
            before.insert(0, bos)
        shared = [*before, *self.tokenize(system.strip()), *self._encode(frame.between, is_template=True)]
        own = [*self.tokenize(user.strip()), *self._encode(frame.after, is_template=True)]
        return Prompt(tuple(shared), tuple(own))

    @cached_property
    def _frame(self) -> Frame:
        source = self._library.llama_model_chat_template(self._model, None)
        if not source:
            return PLAIN_FRAME
        ends = self._library.llama_vocab_eos(self._vocabulary), self._library.llama_vocab_bos(self._vocabulary)
        return _read_jinja(source.decode("utf-8", "replace"), *map(self._special_token_text, ends))

    @cached_property
    def _prefix(self) -> str:
        """A prefix that makes `tokenize` return the tokens of a text within a longer one.

        Some tokenizers prepend a space to every text; it is removed together with the prefix.
        """
        written = b"".join(self.pieces[token] for token in self._encode("a", is_template=False))
        return "" if written == b"a" else "\n"

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
