"""How probable a part of a text is by the tokens that it came in."""

from bisect import bisect_left
from collections.abc import Sequence
from itertools import accumulate

__all__ = ["TokenLogprobs"]


class TokenLogprobs:
    """The tokens of a text, by the places where they stand in it."""

    def __init__(self, text: str, tokens: Sequence[tuple[str, float]]) -> None:
        """Place the tokens.

        Args:
            text: the text, which may be a part of what the tokens spell: before it may be reasoning, behind it a mark.
            tokens: text and natural logarithm of the probability of each, in order.
        """
        spelled = "".join(piece for piece, _ in tokens)
        self._offset = spelled.rfind(text) if text else -1
        """Where the text starts in what the tokens spell; -1 where they spell another one."""
        self._ends = list(accumulate(len(piece) for piece, _ in tokens))
        self._starts = [0, *self._ends[:-1]]
        self._logprobs = [logprob for _, logprob in tokens]

    def logprob(self, span: tuple[int, int]) -> float | None:
        """Return the sum of the log-probabilities of the tokens that spell text[start:end], whole or in part.

        None where that cannot be told: nobody told the tokens, they do not join up to the text, or the span is empty.
        """
        start, end = (self._offset + place for place in span)
        if self._offset < 0 or start >= end:
            return None
        # A token that ends within a character is empty, and stands where that character starts.
        first, behind = bisect_left(self._ends, start), bisect_left(self._starts, end)
        return sum(
            self._logprobs[index]
            for index in range(first, behind)
            if self._ends[index] > start or self._starts[index] == self._ends[index]
        )
