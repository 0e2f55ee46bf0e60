"""The offered names as a trie of tokens, and how likely a model finds each of them."""

import heapq
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
import numpy.typing as npt

__all__ = ["FloatArray", "Scores", "TokenPath", "Trie", "add_logprobs", "build_trie", "normalize", "score_names"]

FloatArray = npt.NDArray[np.float64]
TokenPath = tuple[int, ...]
"""Tokens from the start of a name."""

_SLACK = 0.01
"""Share of the probability that may stay unread."""
_MOST_READ = 64
"""Places in the trie at which the model is asked at most, once a name is found."""


@dataclass(slots=True)
class Trie:
    """A place in the trie."""

    children: dict[int, "Trie"] = field(default_factory=dict)
    """By the next token."""
    name: str | None = None
    """The name that may end here."""


@dataclass(frozen=True, slots=True)
class Scores:
    """How likely the offered names are, as far as the trie was read."""

    found: tuple[tuple[str, TokenPath, float], ...]
    """(name, tokens, natural logarithm of its probability among all texts), the likeliest first."""
    unread: tuple[tuple[TokenPath, float], ...]
    """(start of names, logarithm of the most that the names below it can have)."""

    def explain(self, path: TokenPath) -> list[float]:
        """Return natural logarithms of the probabilities of a found name's tokens, given the ones before.

        They are normalised over the offered names, so that their sum is the logarithm of the probability of the name
        among them; the last one holds that the name ends there. What is unread counts with the most that it can have.
        """
        reached = [self._weigh(path[:length]) for length in range(len(path))]
        reached.append(next(logprob for _, other, logprob in self.found if other == path))
        return [min(0.0, after - before) for before, after in pairwise(reached)]

    def _weigh(self, start: TokenPath) -> float:
        below = [logprob for _, path, logprob in self.found if path[: len(start)] == start]
        return add_logprobs([*below, *(logprob for path, logprob in self.unread if path[: len(start)] == start)])


def build_trie(names: Mapping[str, Sequence[int]]) -> Trie:
    """Return the trie of names, each given with its tokens."""
    root = Trie()
    for name, tokens in names.items():
        place = root
        for token in tokens:
            place = place.children.setdefault(token, Trie())
        place.name = name
    return root


def score_names(trie: Trie, predict: Callable[[TokenPath], FloatArray], closers: npt.NDArray[np.intp]) -> Scores:
    """Return how likely a model finds the names, by best-first search.

    A start of names is as likely as all texts that begin with it, hence at least as likely as the names below it. The
    likeliest start is read first, until all that is unread has a hundredth of the probability of the names found, or
    64 starts are read. So the first name is the likeliest one (unless the limit was hit), which going from token to
    token need not find: a first token may be likely for the sake of words that are not offered.

    Args:
        trie: the names.
        predict: for the start of a name natural logarithms of the probabilities of all next tokens.
        closers: the tokens that end a name.
    """
    found: list[tuple[str, TokenPath, float]] = []
    unread: list[tuple[float, TokenPath, Trie]] = [(0.0, (), trie)]
    read = 0
    last: TokenPath = ()
    while unread and not (found and _is_enough(found, unread, read)):
        cost, last, place = _take(unread, last if read >= _MOST_READ else ())
        logprobs = predict(last)
        read += 1
        if place.name is not None:
            found.append((place.name, last, add_logprobs(logprobs[closers].tolist()) - cost))
        for token, child in place.children.items():
            heapq.heappush(unread, (cost - float(logprobs[token]), (*last, token), child))
    found.sort(key=lambda one: (-one[2], one[1]))
    return Scores(tuple(found), tuple((path, -cost) for cost, path, _ in unread))


def _take(unread: list[tuple[float, TokenPath, Trie]], start: TokenPath) -> tuple[float, TokenPath, Trie]:
    """Remove and return the likeliest entry below a start."""
    if not start:
        return heapq.heappop(unread)
    entry = min(entry for entry in unread if entry[1][: len(start)] == start)
    unread.remove(entry)
    heapq.heapify(unread)
    return entry


def _is_enough(
    found: list[tuple[str, TokenPath, float]], unread: list[tuple[float, TokenPath, Trie]], read: int
) -> bool:
    rest = add_logprobs([-cost for cost, _, _ in unread])
    return read >= _MOST_READ or rest <= add_logprobs([logprob for _, _, logprob in found]) + math.log(_SLACK)


def add_logprobs(logprobs: Sequence[float]) -> float:
    """Return the logarithm of the sum of probabilities that are given as logarithms."""
    most = max(logprobs, default=-math.inf)
    if most == -math.inf:
        return most
    return most + math.log(math.fsum(math.exp(logprob - most) for logprob in logprobs))


def normalize(logits: npt.NDArray[np.float32]) -> FloatArray:
    """Return natural logarithms of the probabilities that a model's output stands for."""
    shifted = logits.astype(np.float64) - float(logits.max())
    return np.asarray(shifted - math.log(float(np.exp(shifted).sum())))
