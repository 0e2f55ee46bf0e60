"""decode_answer: constrained decoding of an answer.

Class names come from a trie, free texts are limited in length, and the fixed text of the skeleton is fed to the model.
"""

import codecs
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.llm.completion import Finish
from usd2kg.grounding.llm.degeneration import is_degenerate
from usd2kg.grounding.llm.local.json_tokens import JsonStringTokens
from usd2kg.grounding.llm.local.skeleton import CLOSING, OPENING, Choice, Fixed, FreeText, SkeletonRow
from usd2kg.grounding.llm.local.trie import FloatArray, TokenPath, TrieNode, build_trie, normalize, score_names
from usd2kg.grounding.llm.settings import DECODING, DEGENERATION

__all__ = ["DecodedAnswer", "DecodingPlan", "TextTokenizer", "TokenModel", "decode_answer"]

_SEVERITY = (Finish.STOP, Finish.LENGTH, Finish.DEGENERATE)
"""In ascending order; an answer has the most severe finish of its free texts."""


class TextTokenizer(Protocol):
    """A tokenizer."""

    @property
    def pieces(self) -> Sequence[bytes]:
        """The bytes of each token."""
        ...

    def tokenize(self, text: str) -> list[int]:
        """Return the tokens of a text within a longer one."""
        ...


class TokenModel(Protocol):
    """A model that has read a prompt."""

    def logits(self, generated: Sequence[int]) -> npt.NDArray[np.float32]:
        """Return the logits of the next token after the prompt and the generated tokens: (vocabulary,)."""
        ...


@dataclass(frozen=True, slots=True)
class DecodedAnswer:
    """An answer that conforms to the schema, except that rows may be missing."""

    text: str
    tokens: tuple[tuple[str, float], ...]
    """(text, natural log-probability) of each token; 0 for fixed text."""
    finish: Finish


class DecodingPlan:
    """The skeleton of an answer as tokens of a model."""

    def __init__(self, rows: Sequence[SkeletonRow], tokens: TextTokenizer) -> None:
        tokenize = tokens.tokenize
        choices = {step.names for row in rows for step in row if isinstance(step, Choice)}
        name_tokens = {names: {name: tokenize(name) for name in names} for names in choices}
        self.rows, self.tokens = rows, tokens
        self.tries = {names: build_trie(tokens) for names, tokens in name_tokens.items()}
        """Names of a choice → their trie."""
        self.texts = {step.text: tokenize(step.text) for row in rows for step in row if isinstance(step, Fixed)}
        self.texts |= {text: tokenize(text) for text in (OPENING, CLOSING)}
        """Fixed text → its tokens."""
        self._longest = {names: max(map(len, tokens.values())) for names, tokens in name_tokens.items()}

    def min_row_tokens(self, row: SkeletonRow) -> int:
        """Return the number of tokens that a row needs for any choice, with empty free texts."""
        fixed = sum(len(self.texts[step.text]) for step in row if isinstance(step, Fixed))
        return fixed + sum(self._longest[step.names] for step in row if isinstance(step, Choice))

    @property
    def min_answer_tokens(self) -> int:
        """Number of tokens that an answer with one row needs."""
        return self.min_row_tokens(self.rows[0]) + len(self.texts[CLOSING])

    @property
    def max_answer_tokens(self) -> int:
        """Largest number of tokens of an answer."""
        free = sum(isinstance(step, FreeText) for row in self.rows for step in row)
        return sum(map(self.min_row_tokens, self.rows)) + free * DECODING.max_text_tokens + len(self.texts[CLOSING])


def decode_answer(
    plan: DecodingPlan,
    model: TokenModel,
    string_tokens: JsonStringTokens,
    *,
    max_tokens: int,
    temperature: float,
    seed: int,
) -> DecodedAnswer:
    """Return an answer of at most `max_tokens` tokens.

    Rows that do not fit are omitted. Free texts are truncated so that as many rows as possible fit.

    Args:
        plan: the skeleton of the answer.
        model: the model, which has read the prompt.
        string_tokens: the model's tokens by their role in a string.
        max_tokens: limit of the answer.
        temperature: 0 chooses the most probable name or token; otherwise they are sampled.
        seed: seed of the sampling.
    """
    decoder = _Decoder(plan, model, string_tokens, temperature, seed)
    required = [plan.min_row_tokens(row) for row in plan.rows]
    closing = len(plan.texts[CLOSING])
    for index, row in enumerate(plan.rows):
        available = max_tokens - len(decoder.ids) - closing
        if available < required[index]:
            decoder.finish = Finish.LENGTH
            break
        free_texts = sum(isinstance(step, FreeText) for other in plan.rows[index:] for step in other)
        share = max(0, available - sum(required[index:])) // max(1, free_texts)
        decoder.decode_row(row, min(DECODING.max_text_tokens, share))
    if not decoder.ids:
        decoder.feed(OPENING)
    decoder.feed(CLOSING)
    return DecodedAnswer("".join(text for text, _ in decoder.tokens), tuple(decoder.tokens), decoder.finish)


class _Decoder:
    """The state of an answer that is being decoded."""

    def __init__(
        self, plan: DecodingPlan, model: TokenModel, string_tokens: JsonStringTokens, temperature: float, seed: int
    ) -> None:
        self._plan, self._model, self._string_tokens, self._temperature = plan, model, string_tokens, temperature
        self._random = np.random.default_rng(seed)
        self.ids: list[int] = []
        self.tokens: list[tuple[str, float]] = []
        self.finish = Finish.STOP

    def decode_row(self, row: SkeletonRow, max_text_tokens: int) -> None:
        """Decode a row with at most `max_text_tokens` for each free text."""
        for step in row:
            if isinstance(step, Fixed):
                self.feed(step.text)
            elif isinstance(step, Choice):
                self._choose(self._plan.tries[step.names])
            else:
                self._decode_text(max_text_tokens)

    def feed(self, text: str) -> None:
        """Append fixed text."""
        ids = self._plan.texts[text]
        self._append(ids, text, [0.0] * len(ids))

    def _append(self, ids: Sequence[int], text: str, logprobs: Sequence[float]) -> None:
        self.ids += ids
        self.tokens += zip(_spell([self._plan.tokens.pieces[token] for token in ids], text), logprobs, strict=True)

    def _choose(self, trie: TrieNode) -> None:
        def predict(path: TokenPath) -> FloatArray:
            return normalize(self._model.logits([*self.ids, *path]))

        scores = score_names(trie, predict, self._string_tokens.closers)
        name, path, _ = scores.found[self._draw(np.array([scored.logprob for scored in scores.found]))]
        self._append(path, name, scores.token_logprobs(path))

    def _decode_text(self, max_tokens: int) -> None:
        """Decode a free text until the closing quote, the limit, or a loop."""
        start, utf8 = len(self.tokens), _open_utf8_decoder()
        head, finish = "", Finish.LENGTH
        for count in range(1, max_tokens + 1):
            logprobs = normalize(self._model.logits(self.ids)[self._string_tokens.texts])
            choice = self._draw(logprobs)
            token, logprob = int(self._string_tokens.texts[choice]), float(logprobs[choice])
            if token in self._string_tokens.heads:
                head, finish = self._string_tokens.heads[token].decode("utf-8", "ignore"), Finish.STOP
                break
            self.ids.append(token)
            self.tokens.append((utf8.decode(self._plan.tokens.pieces[token]), logprob))
            is_checked = count % DEGENERATION.check_interval_tokens == 0
            if is_checked and is_degenerate("".join(text for text, _ in self.tokens[start:])):
                finish = Finish.DEGENERATE
                break
        if rest := utf8.decode(b"", final=True):
            self.tokens[-1] = (self.tokens[-1][0] + rest, self.tokens[-1][1])
        ids = self._plan.tokens.tokenize(head)
        if 0 < len(ids) <= max_tokens + start - len(self.tokens):
            self._append(ids, head, [logprob] + [0.0] * (len(ids) - 1))
        self.finish = max(self.finish, finish, key=_SEVERITY.index)

    def _draw(self, logprobs: FloatArray) -> int:
        """Return an index sampled at the temperature; at 0, the first of the most probable ones."""
        if self._temperature <= 0:
            return int(logprobs.argmax())
        weights = np.exp((logprobs - logprobs.max()) / self._temperature)
        return int(self._random.choice(len(weights), p=weights / weights.sum()))


def _spell(pieces: Sequence[bytes], text: str) -> list[str]:
    """Return the part of a text that each token adds; the first has all of it if the tokens spell another text."""
    utf8 = _open_utf8_decoder()
    spelled = [utf8.decode(piece) for piece in pieces]
    return spelled if "".join(spelled) == text else [text, *[""] * (len(pieces) - 1)]


def _open_utf8_decoder() -> codecs.IncrementalDecoder:
    return codecs.getincrementaldecoder("utf-8")("replace")
