"""Beam search for the best readings of letters as words, from left to right, ten paths at each letter.

Most of the time for reading abbreviations is spent here. Admissible bounds skip paths that cannot be among the ten, so
the result equals that of scoring every path.
"""

import math
from bisect import insort
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from itertools import chain, pairwise
from operator import itemgetter
from typing import NamedTuple

from usd2kg.grounding.lexical.reading.shortening_settings import CHANNEL

__all__ = ["ROOT", "Arc", "Beam", "Path", "Piece", "Starts", "log_sum"]

_LOG_NEXT_WORD = math.log(CHANNEL.next_word)
_WIDTH = CHANNEL.beam_width
_MAX_LOSS = CHANNEL.max_log_loss
# The following constants change the time of the search and not its result.
_FIRST_SPREAD = 4.0
"""First estimate of the log ratio between the best path and the tenth, which varies little from letter to letter."""
_MARGIN, _STEP = 0.7, 2.0
"""Added to the estimate for words that several paths lead to, and after a wrong estimate."""
_IGNORED_LOSS = 3.0
"""Log ratio to the needed score from which paths by pieces that are not a word are bounded instead of scored."""
_TABLES = ((1, 10), (2, 5), (3, 4), (4, 3), (5, 2), (10, 1))
"""Rows and columns of tables with at least as many cells as the beam is wide."""
_TABLE_LOSS = 2.5
"""Log ratio to the best piece from which a piece's table cannot improve the bound."""
_SLACK = 1e-9
"""Larger than the rounding error of a sum."""

_Key = tuple[int, str]
"""The words of a path: the node of all words but the last, and the last."""
Path = tuple[float, int, int]
"""A reading of the letters up to some index: its score, a log probability up to a constant; the node of its words; and
its number of pieces, which are words or letters that are not a word."""
_Start = tuple[float, int, int, Mapping[str, float]]
"""A path to be extended: its score, the node of its words, its number of pieces with the next one, and the bonuses of
words after its last."""
_Way = tuple[float, _Start | None, Sequence[float]]
"""Score of some words; if only one path leads to them, its start and the reasons for the last word."""
_Found = dict[_Key, _Way]


ROOT: Path = (0.0, 0, 0)
"""The path before the first letter."""


class Piece(NamedTuple):
    """The words that a run of letters may abbreviate."""

    words: Sequence[tuple[float, str]]
    """(log probability by all reasons, word), best first."""
    reasons: Mapping[str, Sequence[float]]
    """Word → log probability by each reason."""
    most_reasons: int
    """The largest number of reasons for one word."""


class Starts(NamedTuple):
    """The paths to be extended from an index."""

    ordered: list[_Start]
    """Best first."""
    by_node: dict[int, _Start]
    """The same by the node of their words."""


class Arc(NamedTuple):
    """A piece of the letters after some paths; it may be a word, or no word."""

    starts: Starts
    """At least one element."""
    unread: tuple[float, float]
    """Log probability that the piece is not a word, in two terms; -inf where it must be one."""
    piece: Piece


class Beam:
    """The paths of one name; paths with the same words are merged."""

    def __init__(self, find_bonuses: Callable[[str], Mapping[str, float]], max_bonus: float) -> None:
        """Start at the first letter.

        Args:
            find_bonuses: returns next word → bonus after a word, a log factor.
            max_bonus: the largest bonus.
        """
        self._find_bonuses = find_bonuses
        self._nodes: dict[_Key, int] = {(-1, ""): 0}
        self._keys: list[_Key] = [(-1, "")]
        self._max_bonus = max_bonus
        self._bonuses: list[Mapping[str, float]] = [{}]
        self._spread = _FIRST_SPREAD

    def words(self, path: Path) -> tuple[str, ...]:
        """Return the words of a path."""
        return self._text(self._keys[path[1]])

    def starts(self, paths: Sequence[Path]) -> Starts:
        """Return the paths to be extended."""
        ordered = [
            (score + _LOG_NEXT_WORD if pieces else score, node, pieces + 1, self._bonuses[node])
            for score, node, pieces in paths
            if pieces < CHANNEL.max_pieces
        ]
        return Starts(ordered, {start[1]: start for start in ordered})

    def best(self, arcs: Sequence[Arc]) -> list[Path]:
        """Return the best paths that end with one of some pieces, best first."""
        if not arcs:
            return []
        counts = Counter(chain.from_iterable([arc.starts.by_node for arc in arcs]))
        likely, certain, hopeless = _bounds(arcs)
        rest = math.log(1 + len(arcs) * math.exp(-_IGNORED_LOSS))
        paths: list[tuple[float, int, _Key]] = []
        guess = likely - self._spread
        # The second score is always low enough; the first usually is, and costs less.
        for needed in (guess, certain - rest) if guess > certain - rest > hopeless else (certain - rest, guess - _STEP):
            if needed > hopeless and not paths:
                paths = self._add_up(self._reach(arcs, counts, needed), arcs, counts, needed + rest)
        if not paths:
            # Paths below are hopeless.
            paths = self._add_up(self._reach(arcs, counts, hopeless), arcs, counts, -math.inf)
        paths.sort(key=itemgetter(0), reverse=True)
        equal = {one[0] for one, next_one in pairwise(paths) if one[0] == next_one[0]}
        if equal:
            # Ties are broken by the words.
            paths.sort(key=lambda path: (-path[0], self._text(path[2]) if path[0] in equal else ()))
        self._spread = likely - paths[:_WIDTH][-1][0] + _MARGIN
        return [(score, self._node(key), pieces) for score, pieces, key in paths[:_WIDTH]]

    def _reach(self, arcs: Sequence[Arc], counts: Mapping[int, int], needed: float) -> _Found:
        """Return words → score by the paths that may reach the needed score.

        Words that are not returned score less even by all their paths together. The needed score is divided among the
        arcs after the same words; paths by pieces that are not a word may add a little.
        """
        found: _Found = {}
        lowest = needed - math.log(max(counts.values()))
        for arc in arcs:
            self._pass_over(arc, needed - _IGNORED_LOSS, found)
            if arc.piece.words:
                self._reach_words(arc, counts, needed, lowest, found)
        return found

    def _pass_over(self, arc: Arc, least: float, found: _Found) -> None:
        """Add the words of the paths on which a piece is not a word."""
        unread, letters = arc.unread
        for start in arc.starts.ordered:
            score = start[0] + unread + letters
            if score <= least:
                break
            key = self._keys[start[1]]
            found[key] = (log_sum(found[key][0], score) if key in found else score), None, ()

    def _reach_words(self, arc: Arc, counts: Mapping[int, int], needed: float, lowest: float, found: _Found) -> None:
        """Add the words of the paths on which a piece is a word; `lowest` is the smallest score that any needs."""
        (ordered, _), _, (words, reasons, _) = arc
        most, nodes = words[0][0], self._nodes
        for start in ordered:
            begun, node, _, bonuses = start
            if begun + most + self._max_bonus <= lowest:
                break
            is_alone = counts[node] == 1
            least = needed if is_alone else needed - math.log(counts[node])
            has_bonus = not bonuses.keys().isdisjoint(reasons)
            for likely, word in words:
                score = begun + likely
                if has_bonus and word in bonuses:
                    score += bonuses[word]
                if score > least:
                    key = (node, word)
                    if key in found:
                        found[key] = log_sum(found[key][0], score), None, ()
                    else:
                        is_only = is_alone and key not in nodes
                        found[key] = (score, start, reasons[word]) if is_only else (score, None, ())
                elif not has_bonus:
                    break

    def _add_up(
        self, found: _Found, arcs: Sequence[Arc], counts: Mapping[int, int], unseen: float
    ) -> list[tuple[float, int, _Key]]:
        """Return (score, pieces, words) of the best words, unordered; none if other words may be among them.

        Args:
            found: words → score by the paths that were followed.
            arcs: all arcs.
            counts: node → number of arcs after its words.
            unseen: the largest score of other words, and of other paths to these.
        """
        ordered = sorted(found.items(), key=_by_score, reverse=True)
        if unseen > -math.inf and (len(ordered) < _WIDTH or ordered[_WIDTH - 1][1][0] < unseen):
            return []
        exact, best = [], -math.inf
        # The best single path is among the paths to the words with the largest sums.
        for key, way in ordered:
            if way[0] + _SLACK <= best:
                break
            exact.append((self._ways_to(key, way, arcs), key))
            best = max(best, exact[-1][0][0][0])
        least = best - _MAX_LOSS
        paths = [(*_joined(ways, least), key) for ways, key in exact if ways[0][0] > least]
        scores = sorted([path[0] for path in paths])
        tenth = lifted = -math.inf
        for key, way in ordered[len(exact) :]:
            if len(scores) >= _WIDTH and scores[-_WIDTH] > tenth:
                tenth = scores[-_WIDTH]
                lifted = _less(tenth, 1.0, unseen)
            if way[0] < lifted:
                break
            score, start, reasons = way
            if start is not None and len(reasons) == 1:
                if score > least and score + _SLACK > tenth:
                    paths.append((score, start[2], key))
                    insort(scores, score)
            elif start is None or score + _SLACK > tenth:
                # Words with a single path have exactly its score.
                ways = self._ways_to(key, way, arcs)
                if ways[0][0] > least:
                    paths.append((*_joined(ways, least), key))
                    insort(scores, paths[-1][0])
        is_sure = unseen == -math.inf or (len(scores) >= _WIDTH and scores[-_WIDTH] >= unseen)
        return paths if is_sure else []

    def _ways_to(self, key: _Key, way: _Way, arcs: Sequence[Arc]) -> list[tuple[float, int]]:
        """Return (score, pieces) of each path to some words, best first."""
        before, word = key
        _, start, reasons = way
        if start is not None:
            bonus = start[3].get(word, 0.0)
            found = [(start[0] + reason + bonus, start[2]) for reason in reasons]
        else:
            found = []
            own = self._nodes.get(key)
            for (_, by_node), (unread, letters), piece in arcs:
                if before in by_node and word in piece.reasons:
                    score, _, pieces, bonuses = by_node[before]
                    bonus = bonuses.get(word, 0.0)
                    found += [(score + reason + bonus, pieces) for reason in piece.reasons[word]]
                if own in by_node:
                    score, _, pieces, _ = by_node[own]
                    found.append((score + unread + letters, pieces))
        if len(found) > 1:
            found.sort(key=itemgetter(0), reverse=True)
        return found

    def _text(self, key: _Key) -> tuple[str, ...]:
        words = []
        while key[0] >= 0:
            words.append(key[1])
            key = self._keys[key[0]]
        return tuple(reversed(words))

    def _node(self, key: _Key) -> int:
        node = self._nodes.get(key)
        if node is None:
            node = self._nodes[key] = len(self._keys)
            self._keys.append(key)
            self._bonuses.append(self._find_bonuses(key[1]))
        return node


def _by_score(item: tuple[_Key, _Way]) -> float:
    return item[1][0]


def _bounds(arcs: Sequence[Arc]) -> tuple[float, float, float]:
    """Return the approximate best score, a score that ten words reach, and a pruning threshold.

    The paths before an arc and the words of its piece are in descending order, so that every cell of a table of their
    sums has at least the score of the last one.
    """
    unread = max([starts.ordered[0][0] + cost[0] + cost[1] for starts, cost, _ in arcs])
    read = [
        (piece.words[0][0] + starts.ordered[0][0], starts.ordered, piece.words)
        for starts, _, piece in arcs
        if piece.words
    ]
    best = max([unread, *(score for score, _, _ in read)])
    tables = [
        ordered[rows - 1][0] + words[columns - 1][0]
        for score, ordered, words in read
        if score > best - _TABLE_LOSS
        for rows, columns in _TABLES
        if rows <= len(ordered) and columns <= len(words)
    ]
    most_ways = sum([1 + arc.piece.most_reasons for arc in arcs])
    return best, max(tables, default=-math.inf), best - math.log(most_ways) - _MAX_LOSS - _SLACK


def _less(score: float, count: float, other: float) -> float:
    """Return a lower bound of log(e^score - count · e^other); -inf where the difference is not positive."""
    rest = 1 - count * math.exp(other - score) - _SLACK if score > -math.inf else 0.0
    return score + math.log(rest) if rest > 0 else -math.inf


def _joined(ways: Sequence[tuple[float, int]], least: float) -> tuple[float, int]:
    """Return the score of some words by all paths that are not hopeless, and the number of pieces of the best."""
    score, pieces = ways[0]
    for other, _ in ways[1:]:
        if other > least:
            score = log_sum(score, other)
    return score, pieces


def log_sum(one: float, other: float) -> float:
    """Return log(e^one + e^other)."""
    high, low = max(one, other), min(one, other)
    return high + math.log1p(math.exp(low - high))
