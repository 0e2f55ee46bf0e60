"""A fake model: a small vocabulary and the probabilities of the next token."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.llm.local.tokenizer import Prompt

END = 0
"""The end-of-generation token."""
_LEAST = 1e-12
_CHARACTERS = [bytes([code]) for code in range(1, 256)]

Probabilities = Mapping[str | bytes, float]


class FakeTokens:
    """A tokenizer whose tokens are all non-zero bytes and some longer pieces; the longest match is chosen."""

    def __init__(self, *pieces: str | bytes) -> None:
        longer = [piece.encode() if isinstance(piece, str) else piece for piece in pieces]
        self.pieces = [b"", *_CHARACTERS, *longer]
        self.ends = frozenset({END})
        self._longest_first = sorted(set(self.pieces) - {b""}, key=len, reverse=True)

    def token(self, piece: str | bytes) -> int:
        return self.pieces.index(piece.encode() if isinstance(piece, str) else piece)

    def tokenize(self, text: str) -> list[int]:
        rest, tokens = text.encode(), []
        while rest:
            piece = next(piece for piece in self._longest_first if rest.startswith(piece))
            tokens.append(self.token(piece))
            rest = rest[len(piece) :]
        return tokens

    def encode_prompt(self, system: str, user: str) -> Prompt:
        return Prompt(tuple(self.tokenize(f"[{system}]")), tuple(self.tokenize(f"[{user}]")))


class FakeModel:
    """A model with given probabilities of the next piece; other pieces are almost impossible."""

    def __init__(self, predict: Callable[[str], Probabilities], *pieces: str | bytes, window: int = 10_000) -> None:
        self.tokenizer = FakeTokens(*pieces)
        self.window = window
        self.contexts: list[str] = []
        """The texts for which logits were requested."""
        self.prompts: list[tuple[Prompt, int]] = []
        self.is_closed = False
        self._predict = predict

    def read_prompt(self, prompt: Prompt, max_tokens: int) -> int:
        self.prompts.append((prompt, max_tokens))
        return len(prompt.shared) if len(self.prompts) > 1 else 0

    def logits(self, generated: Sequence[int]) -> npt.NDArray[np.float32]:
        assert generated, "logits need at least one generated token"
        text = b"".join(self.tokenizer.pieces[token] for token in generated).decode("utf-8", "replace")
        self.contexts.append(text)
        found = np.full(len(self.tokenizer.pieces), math.log(_LEAST), np.float32)
        for piece, probability in self._predict(text).items():
            found[END if piece == "" else self.tokenizer.token(piece)] = math.log(probability)
        return found

    def close(self) -> None:
        self.is_closed = True
