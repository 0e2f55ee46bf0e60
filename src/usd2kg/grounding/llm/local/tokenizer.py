"""Texts in the tokens of a model, and prompts in its chat template."""

import ctypes
from functools import cached_property
from types import ModuleType
from typing import Any, NamedTuple

from usd2kg.grounding.llm.local.chat_template import PLAIN, Frame, Message, read_template

__all__ = ["Prompt", "Tokenizer"]

_LONGEST_TOKEN = 1024
"""Bytes."""
_MOST_SPECIAL = 8
"""Tokens that a tokenizer may put around a text."""


class Prompt(NamedTuple):
    """A prompt in tokens."""

    shared: tuple[int, ...]
    """The instructions, up to where the question begins."""
    own: tuple[int, ...]

    @property
    def tokens(self) -> tuple[int, ...]:
        """All of them."""
        return self.shared + self.own


class Tokenizer:
    """The vocabulary of a model that llama.cpp holds."""

    def __init__(self, library: ModuleType, model: Any) -> None:
        self._library, self._model = library, model
        self._vocabulary = library.llama_model_get_vocab(model)

    @cached_property
    def pieces(self) -> list[bytes]:
        """What each token writes; nothing for those that only steer."""
        buffer = ctypes.create_string_buffer(_LONGEST_TOKEN)
        write = self._library.llama_token_to_piece
        count = self._library.llama_vocab_n_tokens(self._vocabulary)
        sizes = (write(self._vocabulary, token, buffer, _LONGEST_TOKEN, 0, False) for token in range(count))
        return [buffer.raw[: max(0, size)] for size in sizes]

    @cached_property
    def ends(self) -> frozenset[int]:
        """The tokens by which the model says that it is done."""
        is_end = self._library.llama_vocab_is_eog
        return frozenset(token for token in range(len(self.pieces)) if is_end(self._vocabulary, token))

    def tokenize(self, text: str) -> list[int]:
        """Return the tokens of a text in the middle of others; marks of the chat template in it are plain text."""
        lead = self._encode(self._lead, is_template=False)
        return self._encode(self._lead + text, is_template=False)[len(lead) :]

    def frame(self, system: str, user: str) -> Prompt:
        """Return instructions and question inside the model's chat template."""
        frame = self._frame
        before = self._encode(frame.before, is_template=True)
        first = self._library.llama_vocab_bos(self._vocabulary)
        if self._library.llama_vocab_get_add_bos(self._vocabulary) and before[:1] != [first]:
            before.insert(0, first)
        shared = [*before, *self.tokenize(system.strip()), *self._encode(frame.between, is_template=True)]
        own = [*self.tokenize(user.strip()), *self._encode(frame.after, is_template=True)]
        return Prompt(tuple(shared), tuple(own))

    @cached_property
    def _frame(self) -> Frame:
        source = self._library.llama_model_chat_template(self._model, None)
        if not source:
            return PLAIN
        ends = self._library.llama_vocab_eos(self._vocabulary), self._library.llama_vocab_bos(self._vocabulary)
        return _read_jinja(source.decode("utf-8", "replace"), *map(self._write_mark, ends))

    @cached_property
    def _lead(self) -> str:
        """What stands before a text for its tokens to be those in the middle of others.

        Some tokenizers begin every text with a space; it is cut off with the lead.
        """
        written = b"".join(self.pieces[token] for token in self._encode("a", is_template=False))
        return "" if written == b"a" else "\n"

    def _write_mark(self, token: int) -> str:
        if token < 0:
            return ""
        text: bytes = self._library.llama_vocab_get_text(self._vocabulary, token)
        return text.decode("utf-8", "replace")

    def _encode(self, text: str, *, is_template: bool) -> list[int]:
        data = text.encode("utf-8", "replace")
        room = len(data) + _MOST_SPECIAL
        tokens = (self._library.llama_token * room)()
        count = self._library.llama_tokenize(self._vocabulary, data, len(data), tokens, room, False, is_template)
        # No token stands for less than a byte.
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
