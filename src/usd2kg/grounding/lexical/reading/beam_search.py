"""The best ways to read a run of letters as words, found from left to right, ten at each letter.

Most of the time goes here, so that what cannot be among the ten is passed over, by bounds that hold for certain: the
answers are those of adding everything up.
"""

import math
from bisect import insort
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from itertools import chain, pairwise
from operator import itemgetter
from typing import NamedTuple

__all__ = ["ROOT", "Arc", "Beam", "Path", "Piece", "Starts", "log_sum"]

_NEXT_WORD = math.log(0.35)
_WIDTH = 10
_HOPELESS = 9.0
"""A reading this much less likely than the best, as a logarithm, is given up."""
_MOST_PIECES = 8
_SPREAD = 4.0
"""How much less likely the tenth is than the best, as a first guess; it is about the same from letter to letter."""
_MARGIN, _STEP = 0.7, 2.0
"""What is added to the guess, for the sake of words that several ways lead to, and where it was wrong."""
_UNHEARD = 3.0
"""What is so much less likely than what is needed is not looked at, where the last piece is no word."""
_TABLES = ((1, 10), (2, 5), (3, 4), (4, 3), (5, 2), (10, 1))
"""Rows and columns of tables with as many cells as are wanted."""
_NEAR = 2.5
"""In a table of a piece this much less likely than the best there is no use to look."""
_SLACK = 1e-9
"""More than rounding can do to a sum."""

_Key = tuple[int, str]
"""The words of a path: the number of all words but the last, and the last."""
Path = tuple[float, int, int]
"""One way to read the letters up to some place: its score, which is the logarithm of its probability up to what all
paths have in common, the number of its words, and the number of pieces that it takes the letters for: words, and
letters that are none."""
_Start = tuple[float, int, int, Mapping[str, float]]
"""A path that goes on: its score, the number of its words, its pieces with the next one, and the words that are
likelier behind its last, with the logarithm of how much."""
_Way = tuple[float, _Start | None, Sequence[float]]
"""Score of some words; if one way leads to them, its start and the reasons for the last word."""
_Found = dict[_Key, _Way]


ROOT: Path = (0.0, 0, 0)
"""The path before the first letter."""


class Piece(NamedTuple):
    """What a run of letters may be."""

    words: Sequence[tuple[float, str]]
    """(logarithm of how likely it is, for all reasons together; word), the best first."""
    reasons: Mapping[str, Sequence[float]]
    """Word → the same for each reason by itself."""
    most_reasons: int
    """The largest number of reasons for a word."""


class Starts(NamedTuple):
    """The paths that go on from a place."""

    ordered: list[_Start]
    """The best first."""
    by_node: dict[int, _Start]
    """The same by the number of their words."""


class Arc(NamedTuple):
    """A piece of the letters, behind some paths, that may be a word, or no word, or both."""

    starts: Starts
    """At least one."""
    unread: tuple[float, float]
    """What it costs that the piece is no word, in two terms; -inf where it has to be one."""
    piece: Piece


class Beam:
    """The paths of one run of letters; paths that read the same words are one."""

    def __init__(self, seconds: Callable[[str], Mapping[str, float]], most: float) -> None:
        """Begin.

        Args:
            seconds: gives the words that are likelier behind a word, with the logarithm of how much.
            most: the greatest that there is.
        """
        self._find_seconds = seconds
        self._nodes: dict[_Key, int] = {(-1, ""): 0}
        self._keys: list[_Key] = [(-1, "")]
        self._most = most
        self._seconds: list[Mapping[str, float]] = [{}]
        self._spread = _SPREAD

    def words(self, path: Path) -> tuple[str, ...]:
        """Return the words that a path reads."""
        return self._text(self._keys[path[1]])

    def starts(self, paths: Sequence[Path]) -> Starts:
        """Return the paths that may go on."""
        ordered = [
            (score + _NEXT_WORD if pieces else score, node, pieces + 1, self._seconds[node])
            for score, node, pieces in paths
            if pieces < _MOST_PIECES
        ]
        return Starts(ordered, {start[1]: start for start in ordered})

    def best(self, arcs: Sequence[Arc]) -> list[Path]:
        """Return the best paths that end with one of these pieces, best first."""
        if not arcs:
            return []
        counts = Counter(chain.from_iterable([arc.starts.by_node for arc in arcs]))
        likely, certain, given_up = _guesses(arcs)
        rest = math.log(1 + len(arcs) * math.exp(-_UNHEARD))
        paths: list[tuple[float, int, _Key]] = []
        guess = likely - self._spread
        # The second is enough wherever there is one; the first may be, and is less work.
        for needed in (guess, certain - rest) if guess > certain - rest > given_up else (certain - rest, guess - _STEP):
            if needed > given_up and not paths:
                paths = self._add_up(self._reach(arcs, counts, needed), arcs, counts, needed + rest)
        if not paths:
            # What is not reached now is given up.
            paths = self._add_up(self._reach(arcs, counts, given_up), arcs, counts, -math.inf)
        paths.sort(key=itemgetter(0), reverse=True)
        equal = {one[0] for one, next_one in pairwise(paths) if one[0] == next_one[0]}
        if equal:
            # Of equal paths the first by its words stays.
            paths.sort(key=lambda path: (-path[0], self._text(path[2]) if path[0] in equal else ()))
        self._spread = likely - paths[:_WIDTH][-1][0] + _MARGIN
        return [(score, self._node(key), pieces) for score, pieces, key in paths[:_WIDTH]]

    def _reach(self, arcs: Sequence[Arc], counts: Mapping[int, int], needed: float) -> _Found:
        """Return words → their score by the ways that may bring them to what is needed.

        Words that are not reached have less, all ways to them together: those by a word share what is needed with the
        other arcs behind the same words, those by no word may have a little more.
        """
        found: _Found = {}
        lowest = needed - math.log(max(counts.values()))
        for arc in arcs:
            self._pass_over(arc, needed - _UNHEARD, found)
            if arc.piece.words:
                self._reach_words(arc, counts, needed, lowest, found)
        return found

    def _pass_over(self, arc: Arc, least: float, found: _Found) -> None:
        """Add the words to which a piece leads that is no word."""
        unread, letters = arc.unread
        for start in arc.starts.ordered:
            score = start[0] + unread + letters
            if score <= least:
                break
            key = self._keys[start[1]]
            found[key] = (log_sum(found[key][0], score) if key in found else score), None, ()

    def _reach_words(self, arc: Arc, counts: Mapping[int, int], needed: float, lowest: float, found: _Found) -> None:
        """Add the words to which a piece leads that is a word; `lowest` is the least that is needed of any."""
        (ordered, _), _, (words, reasons, _) = arc
        most, nodes = words[0][0], self._nodes
        for start in ordered:
            begun, node, _, seconds = start
            if begun + most + self._most <= lowest:
                break
            is_alone = counts[node] == 1
            least = needed if is_alone else needed - math.log(counts[node])
            bonus = not seconds.keys().isdisjoint(reasons)
            for likely, word in words:
                score = begun + likely
                if bonus and word in seconds:
                    score += seconds[word]
                if score > least:
                    key = (node, word)
                    if key in found:
                        found[key] = log_sum(found[key][0], score), None, ()
                    else:
                        is_only = is_alone and key not in nodes
                        found[key] = (score, start, reasons[word]) if is_only else (score, None, ())
                elif not bonus:
                    break

    def _add_up(
        self, found: _Found, arcs: Sequence[Arc], counts: Mapping[int, int], unseen: float
    ) -> list[tuple[float, int, _Key]]:
        """Return (score, pieces, words) of the best words, in no order; none if others may be among them.

        Args:
            found: words → their score by the ways that were looked at.
            arcs: all ways.
            counts: number of the words before → how many arcs are behind them.
            unseen: what other words have at most, and what other ways add to these.
        """
        ordered = sorted(found.items(), key=_by_score, reverse=True)
        if unseen > -math.inf and (len(ordered) < _WIDTH or ordered[_WIDTH - 1][1][0] < unseen):
            return []
        told, best = [], -math.inf
        # The best single way is one to the words that have most in sum.
        for key, way in ordered:
            if way[0] + _SLACK <= best:
                break
            told.append((self._ways_to(key, way, arcs), key))
            best = max(best, told[-1][0][0][0])
        least = best - _HOPELESS
        paths = [(*_joined(ways, least), key) for ways, key in told if ways[0][0] > least]
        scores = sorted([path[0] for path in paths])
        tenth = lifted = -math.inf
        for key, way in ordered[len(told) :]:
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
                # Words with a single way have no more than that.
                ways = self._ways_to(key, way, arcs)
                if ways[0][0] > least:
                    paths.append((*_joined(ways, least), key))
                    insort(scores, paths[-1][0])
        is_sure = unseen == -math.inf or (len(scores) >= _WIDTH and scores[-_WIDTH] >= unseen)
        return paths if is_sure else []

    def _ways_to(self, key: _Key, way: _Way, arcs: Sequence[Arc]) -> list[tuple[float, int]]:
        """Return (score, pieces) of each way to come to some words, the best first."""
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
                    score, _, pieces, seconds = by_node[before]
                    bonus = seconds.get(word, 0.0)
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
            self._seconds.append(self._find_seconds(key[1]))
        return node


def _by_score(item: tuple[_Key, _Way]) -> float:
    return item[1][0]


def _guesses(arcs: Sequence[Arc]) -> tuple[float, float, float]:
    """Return about the score of the best words, what ten have by one arc, and what is given up for certain.

    The paths behind an arc and the words of its piece fall in score: the cells of a table of their sums have at least
    what its last one has.
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
        if score > best - _NEAR
        for rows, columns in _TABLES
        if rows <= len(ordered) and columns <= len(words)
    ]
    most_ways = sum([1 + arc.piece.most_reasons for arc in arcs])
    return best, max(tables, default=-math.inf), best - math.log(most_ways) - _HOPELESS - _SLACK


def _less(score: float, count: float, other: float) -> float:
    """Return at most log(e^score - count · e^other); -inf where nothing is left."""
    rest = 1 - count * math.exp(other - score) - _SLACK if score > -math.inf else 0.0
    return score + math.log(rest) if rest > 0 else -math.inf


def _joined(ways: Sequence[tuple[float, int]], least: float) -> tuple[float, int]:
    """Return the score of some words by all ways to them but the hopeless, and the pieces of the best."""
    score, pieces = ways[0]
    for other, _ in ways[1:]:
        if other > least:
            score = log_sum(score, other)
    return score, pieces


def log_sum(one: float, other: float) -> float:
    """Return log(e^one + e^other)."""
    high, low = max(one, other), min(one, other)
    return high + math.log1p(math.exp(low - high))
