"""TokenLogprobs: log-probability of a part of a text, from the log-probabilities of its tokens."""

from bisect import bisect_left
from collections.abc import Sequence
from itertools import accumulate

__all__ = ["TokenLogprobs"]


class TokenLogprobs:
    """The tokens of a text with their positions."""

    def __init__(self, text: str, tokens: Sequence[tuple[str, float]]) -> None:
        """Align the tokens with the text.

        Args:
            text: a part of the text spelled by the tokens; reasoning may precede it, and an end token may follow.
            tokens: text and natural log-probability of each token, in order.
        """
        spelled = "".join(piece for piece, _ in tokens)
        self._offset = spelled.rfind(text) if text else -1
        """Position of the text in the text spelled by the tokens; -1 if it does not occur there."""
        self._ends = list(accumulate(len(piece) for piece, _ in tokens))
        self._starts = [0, *self._ends[:-1]]
        self._logprobs = [logprob for _, logprob in tokens]

    def sum_over(self, span: tuple[int, int]) -> float | None:
        """Return the sum of the log-probabilities of the tokens that overlap text[start:end].

        None if there are no tokens, they do not spell the text, or the span is empty.
        """
        start, end = (self._offset + position for position in span)
        if self._offset < 0 or start >= end:
            return None
        # A token that ends inside a character has no text and is positioned at the start of that character.
        first, stop = bisect_left(self._ends, start), bisect_left(self._starts, end)
        return sum(
            self._logprobs[index]
            for index in range(first, stop)
            if self._ends[index] > start or self._starts[index] == self._ends[index]
        )
