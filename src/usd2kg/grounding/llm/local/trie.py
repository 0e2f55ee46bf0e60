"""score_names: the probability of each offered name, by best-first search over a trie of tokens."""

import heapq
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from usd2kg.grounding.llm.settings import DECODING

__all__ = [
    "FloatArray",
    "NameScores",
    "ScoredName",
    "TokenPath",
    "TrieNode",
    "add_logprobs",
    "build_trie",
    "normalize",
    "score_names",
]

FloatArray = npt.NDArray[np.float64]
TokenPath = tuple[int, ...]
"""The first tokens of a name."""


@dataclass(slots=True)
class TrieNode:
    """A node of a trie of names."""

    children: dict[int, "TrieNode"] = field(default_factory=dict)
    """Next token → child."""
    name: str | None = None
    """The name that ends here, if any."""


class ScoredName(NamedTuple):
    """A name with its probability."""

    name: str
    path: TokenPath
    logprob: float
    """Natural log-probability among all texts."""


class _Unread(NamedTuple):
    """An unread node of the search, ordered by probability, the most probable first."""

    cost: float
    """Negative log-probability of the texts that begin with `path`."""
    path: TokenPath
    node: TrieNode


@dataclass(frozen=True, slots=True)
class NameScores:
    """The probabilities of the names, as far as the trie has been searched."""

    found: tuple[ScoredName, ...]
    """The names found, the most probable first."""
    unread: tuple[tuple[TokenPath, float], ...]
    """(path, upper bound of the log-probability of the names below it) for the unread nodes."""

    def token_logprobs(self, path: TokenPath) -> list[float]:
        """Return the natural log-probability of each token of a name that was found, given the preceding ones.

        They are normalised over the offered names, so that their sum is the log-probability of the name among these.
        The last one includes the end of the name. Unread names count with their upper bound.
        """
        reached = [self._total(path[:length]) for length in range(len(path))]
        reached.append(next(name.logprob for name in self.found if name.path == path))
        return [min(0.0, after - before) for before, after in pairwise(reached)]

    def _total(self, start: TokenPath) -> float:
        """Return the log-probability of all names that begin with `start`."""
        below = [name.logprob for name in self.found if name.path[: len(start)] == start]
        return add_logprobs([*below, *(logprob for path, logprob in self.unread if path[: len(start)] == start)])


def build_trie(names: Mapping[str, Sequence[int]]) -> TrieNode:
    """Return the trie of names, each given with its tokens."""
    root = TrieNode()
    for name, tokens in names.items():
        node = root
        for token in tokens:
            node = node.children.setdefault(token, TrieNode())
        node.name = name
    return root


def score_names(
    trie: TrieNode, predict: Callable[[TokenPath], FloatArray], closers: npt.NDArray[np.intp]
) -> NameScores:
    """Return the probabilities of the names, by best-first search.

    The probability of a path is an upper bound for the names below it. The most probable path is read first, until the
    unread ones are negligible (`DECODING.max_unread_probability`) or the search has made `DECODING.max_predictions`.
    So the first name is the most probable one, unless that limit is reached. Greedy decoding does not guarantee this:
    a first token may be probable because of words that are not offered.

    Args:
        trie: the names.
        predict: returns the natural log-probabilities of all tokens after a path.
        closers: the tokens that end a name.
    """
    found: list[ScoredName] = []
    unread = [_Unread(0.0, (), trie)]
    predictions = 0
    path: TokenPath = ()
    while unread and not (found and _is_complete(found, unread, predictions)):
        # Beyond the limit, descend to one name.
        cost, path, node = _pop(unread, path if predictions >= DECODING.max_predictions else ())
        logprobs = predict(path)
        predictions += 1
        if node.name is not None:
            found.append(ScoredName(node.name, path, add_logprobs(logprobs[closers].tolist()) - cost))
        for token, child in node.children.items():
            heapq.heappush(unread, _Unread(cost - float(logprobs[token]), (*path, token), child))
    found.sort(key=lambda scored: (-scored.logprob, scored.path))
    return NameScores(tuple(found), tuple((path, -cost) for cost, path, _ in unread))


def _pop(unread: list[_Unread], start: TokenPath) -> _Unread:
    """Remove and return the most probable entry whose path begins with `start`."""
    if not start:
        return heapq.heappop(unread)
    entry = min(entry for entry in unread if entry.path[: len(start)] == start)
    unread.remove(entry)
    heapq.heapify(unread)
    return entry


def _is_complete(found: list[ScoredName], unread: list[_Unread], predictions: int) -> bool:
    rest = add_logprobs([-entry.cost for entry in unread])
    bound = add_logprobs([scored.logprob for scored in found]) + math.log(DECODING.max_unread_probability)
    return predictions >= DECODING.max_predictions or rest <= bound


def add_logprobs(logprobs: Sequence[float]) -> float:
    """Return the logarithm of the sum of probabilities that are given as logarithms."""
    largest = max(logprobs, default=-math.inf)
    if largest == -math.inf:
        return largest
    return largest + math.log(math.fsum(math.exp(logprob - largest) for logprob in logprobs))


def normalize(logits: npt.NDArray[np.float32]) -> FloatArray:
    """Return the log-softmax of logits."""
    shifted = logits.astype(np.float64) - float(logits.max())
    return np.asarray(shifted - math.log(float(np.exp(shifted).sum())))
