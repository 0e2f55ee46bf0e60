"""A model made by hand: a vocabulary of a few pieces, and the probabilities of what follows a text."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.llm.local.tokenizer import Prompt

END = 0
"""The token by which the model says that it is done."""
_LEAST = 1e-12
_CHARACTERS = [bytes([code]) for code in range(1, 256)]

Probabilities = Mapping[str | bytes, float]


class FakeTokens:
    """Every byte but zero is a token, and so are some longer pieces; the longest one that fits is taken."""

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

    def frame(self, system: str, user: str) -> Prompt:
        return Prompt(tuple(self.tokenize(f"[{system}]")), tuple(self.tokenize(f"[{user}]")))


class FakeModel:
    """Knows for each text which pieces follow with which probability; all others hardly do."""

    def __init__(self, predict: Callable[[str], Probabilities], *pieces: str | bytes, window: int = 10_000) -> None:
        self.tokenizer = FakeTokens(*pieces)
        self.window = window
        self.asked: list[str] = []
        """The texts behind which it was asked what follows."""
        self.prompts: list[tuple[Prompt, int]] = []
        self.is_closed = False
        self._predict = predict

    def read_prompt(self, prompt: Prompt, max_tokens: int) -> int:
        self.prompts.append((prompt, max_tokens))
        return len(prompt.shared) if len(self.prompts) > 1 else 0

    def logits(self, said: Sequence[int]) -> npt.NDArray[np.float32]:
        assert said, "the output behind the bare prompt cannot be had"
        text = b"".join(self.tokenizer.pieces[token] for token in said).decode("utf-8", "replace")
        self.asked.append(text)
        found = np.full(len(self.tokenizer.pieces), math.log(_LEAST), np.float32)
        for piece, probability in self._predict(text).items():
            found[END if piece == "" else self.tokenizer.token(piece)] = math.log(probability)
        return found

    def close(self) -> None:
        self.is_closed = True
