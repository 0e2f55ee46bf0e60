"""Answers that a model writes into a skeleton: classes out of a trie, free texts within limits, the rest fed to it."""

import codecs
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.llm.answers import is_degenerate
from usd2kg.grounding.llm.completion import Finish
from usd2kg.grounding.llm.local.json_tokens import JsonStringTokens
from usd2kg.grounding.llm.local.skeleton import CLOSING, OPENING, Choice, Fixed, FreeText, SkeletonRow
from usd2kg.grounding.llm.local.trie import FloatArray, TokenPath, Trie, build_trie, normalize, score_names

__all__ = ["DecodedAnswer", "DecodingPlan", "TextTokenizer", "TokenModel", "decode_answer"]

_MOST_TEXT = 256
"""TextTokenizer of a free text."""
_LOOP_CHECK = 16
"""TextTokenizer from one look for a loop to the next."""
_SEVERITY = (Finish.STOP, Finish.LENGTH, Finish.DEGENERATE)


class TextTokenizer(Protocol):
    """A vocabulary."""

    @property
    def pieces(self) -> Sequence[bytes]:
        """What each token writes."""
        ...

    def tokenize(self, text: str) -> list[int]:
        """Return the tokens of a text in the middle of others."""
        ...


class TokenModel(Protocol):
    """A model that has read a prompt."""

    def logits(self, said: Sequence[int]) -> npt.NDArray[np.float32]:
        """Return one number for every token that may follow the prompt and what was said: the larger, the likelier."""
        ...


@dataclass(frozen=True, slots=True)
class DecodedAnswer:
    """An answer; all of it is JSON by the schema, though rows may be missing."""

    text: str
    tokens: tuple[tuple[str, float], ...]
    """(text, natural logarithm of its probability) of each token; 0 where there was no choice."""
    finish: Finish


class DecodingPlan:
    """The rows of an answer in the tokens of a model."""

    def __init__(self, rows: Sequence[SkeletonRow], tokens: TextTokenizer) -> None:
        tokenize = tokens.tokenize
        choices = {step.names for row in rows for step in row if isinstance(step, Choice)}
        spelt = {names: {name: tokenize(name) for name in names} for names in choices}
        self.rows, self.tokens = rows, tokens
        self.tries = {names: build_trie(found) for names, found in spelt.items()}
        """The names of each choice."""
        self.texts = {step.text: tokenize(step.text) for row in rows for step in row if isinstance(step, Fixed)}
        self.texts |= {text: tokenize(text) for text in (OPENING, CLOSING)}
        """The tokens of what is certain."""
        self._longest = {names: max(map(len, found.values())) for names, found in spelt.items()}

    def least(self, row: SkeletonRow) -> int:
        """Return how many tokens a row needs, whatever is chosen, if its free texts stay empty."""
        certain = sum(len(self.texts[step.text]) for step in row if isinstance(step, Fixed))
        return certain + sum(self._longest[step.names] for step in row if isinstance(step, Choice))

    @property
    def min_answer_tokens(self) -> int:
        """TextTokenizer that an answer with one row needs at least."""
        return self.least(self.rows[0]) + len(self.texts[CLOSING])

    @property
    def max_answer_tokens(self) -> int:
        """TextTokenizer that an answer takes at most."""
        free = sum(isinstance(step, FreeText) for row in self.rows for step in row)
        return sum(map(self.least, self.rows)) + free * _MOST_TEXT + len(self.texts[CLOSING])


def decode_answer(
    plan: DecodingPlan, model: TokenModel, vocabulary: JsonStringTokens, *, room: int, temperature: float, seed: int
) -> DecodedAnswer:
    """Return an answer of at most `room` tokens.

    Rows that find no room are left out, and free texts are cut so that as many rows as possible do.

    Args:
        plan: what to write.
        model: what decides where there is a choice.
        vocabulary: what the model's tokens can do.
        room: tokens that the answer may have.
        temperature: 0 takes the likeliest each time, else names and tokens are drawn.
        seed: of what is drawn.
    """
    writer = _Writer(plan, model, vocabulary, temperature, seed)
    least = [plan.least(row) for row in plan.rows]
    closing = len(plan.texts[CLOSING])
    for place, row in enumerate(plan.rows):
        spare = room - len(writer.ids) - closing
        if spare < least[place]:
            writer.finish = Finish.LENGTH
            break
        free = sum(isinstance(step, FreeText) for other in plan.rows[place:] for step in other)
        writer.write_row(row, min(_MOST_TEXT, max(0, spare - sum(least[place:])) // max(1, free)))
    if not writer.ids:
        writer.feed(OPENING)
    writer.feed(CLOSING)
    return DecodedAnswer("".join(text for text, _ in writer.said), tuple(writer.said), writer.finish)


class _Writer:
    """An answer while it is written."""

    def __init__(
        self, plan: DecodingPlan, model: TokenModel, vocabulary: JsonStringTokens, temperature: float, seed: int
    ) -> None:
        self._plan, self._model, self._vocabulary, self._temperature = plan, model, vocabulary, temperature
        self._random = np.random.default_rng(seed)
        self.ids: list[int] = []
        self.said: list[tuple[str, float]] = []
        self.finish = Finish.STOP

    def write_row(self, row: SkeletonRow, most_text: int) -> None:
        """Write a row, with so many tokens for each free text at most."""
        for step in row:
            if isinstance(step, Fixed):
                self.feed(step.text)
            elif isinstance(step, Choice):
                self._choose(self._plan.tries[step.names])
            else:
                self._write_text(most_text)

    def feed(self, text: str) -> None:
        """Write what is certain."""
        ids = self._plan.texts[text]
        self._say(ids, text, [0.0] * len(ids))

    def _say(self, ids: Sequence[int], text: str, logprobs: Sequence[float]) -> None:
        self.ids += ids
        self.said += zip(_spell([self._plan.tokens.pieces[token] for token in ids], text), logprobs, strict=True)

    def _choose(self, trie: Trie) -> None:
        def predict(path: TokenPath) -> FloatArray:
            return normalize(self._model.logits([*self.ids, *path]))

        scores = score_names(trie, predict, self._vocabulary.closers)
        name, path, _ = scores.found[self._draw(np.array([logprob for _, _, logprob in scores.found]))]
        self._say(path, name, scores.explain(path))

    def _write_text(self, most: int) -> None:
        """Write until the closing quote, the limit or a loop."""
        start, decoder = len(self.said), _open_decoder()
        head, finish = "", Finish.LENGTH
        for count in range(1, most + 1):
            logprobs = normalize(self._model.logits(self.ids)[self._vocabulary.texts])
            choice = self._draw(logprobs)
            token, logprob = int(self._vocabulary.texts[choice]), float(logprobs[choice])
            if token in self._vocabulary.heads:
                head, finish = self._vocabulary.heads[token].decode("utf-8", "ignore"), Finish.STOP
                break
            self.ids.append(token)
            self.said.append((decoder.decode(self._plan.tokens.pieces[token]), logprob))
            if count % _LOOP_CHECK == 0 and is_degenerate("".join(text for text, _ in self.said[start:])):
                finish = Finish.DEGENERATE
                break
        if rest := decoder.decode(b"", final=True):
            self.said[-1] = (self.said[-1][0] + rest, self.said[-1][1])
        ids = self._plan.tokens.tokenize(head)
        if 0 < len(ids) <= most + start - len(self.said):
            self._say(ids, head, [logprob] + [0.0] * (len(ids) - 1))
        self.finish = max(self.finish, finish, key=_SEVERITY.index)

    def _draw(self, logprobs: FloatArray) -> int:
        """Return a place by its probability at the temperature, the likeliest and first one at 0."""
        if self._temperature <= 0:
            return int(logprobs.argmax())
        weights = np.exp((logprobs - logprobs.max()) / self._temperature)
        return int(self._random.choice(len(weights), p=weights / weights.sum()))


def _spell(pieces: Sequence[bytes], text: str) -> list[str]:
    """Return what each token adds to a text; all of it stands at the first where tokens and text differ."""
    decoder = _open_decoder()
    spelt = [decoder.decode(piece) for piece in pieces]
    return spelt if "".join(spelt) == text else [text, *[""] * (len(pieces) - 1)]


def _open_decoder() -> codecs.IncrementalDecoder:
    return codecs.getincrementaldecoder("utf-8")("replace")
