"""Tokenizer: text and prompts as tokens of a model, for each library that runs llama.cpp."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

from usd2kg.grounding.llm.local.chat_template import Frame

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


class Tokenizer(ABC):
    """The tokenizer of a loaded model."""

    @property
    @abstractmethod
    def pieces(self) -> Sequence[bytes]:
        """The bytes of each token; empty for control tokens."""

    @property
    @abstractmethod
    def ends(self) -> frozenset[int]:
        """The end-of-generation tokens."""

    def tokenize(self, text: str) -> list[int]:
        """Return the tokens of a text within a longer one; special tokens in it are plain text."""
        prefix = self._encode(self._prefix, is_template=False)
        return self._encode(self._prefix + text, is_template=False)[len(prefix) :]

    def encode_prompt(self, system: str, user: str) -> Prompt:
        """Return system and user prompt in the model's chat template."""
        frame = self._frame
        before = self._encode(frame.before, is_template=True)
        begin = self._begin
        if before[: len(begin)] != begin:
            before = begin + before
        shared = [*before, *self.tokenize(system.strip()), *self._encode(frame.between, is_template=True)]
        own = [*self.tokenize(user.strip()), *self._encode(frame.after, is_template=True)]
        return Prompt(tuple(shared), tuple(own))

    @property
    @abstractmethod
    def _frame(self) -> Frame:
        """The text that the chat template puts around the prompts."""

    @property
    @abstractmethod
    def _begin(self) -> list[int]:
        """The token that begins every text of this model, if any."""

    @abstractmethod
    def _encode(self, text: str, *, is_template: bool) -> list[int]:
        """Return the tokens of a text alone; special tokens in it are tokens only if it is of the template."""

    @cached_property
    def _prefix(self) -> str:
        """A prefix that makes `tokenize` return the tokens of a text within a longer one.

        Some tokenizers prepend a space to every text; it is removed together with the prefix.
        """
        written = b"".join(self.pieces[token] for token in self._encode("a", is_template=False))
        return "" if written == b"a" else "\n"
