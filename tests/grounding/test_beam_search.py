"""Beam search for the words behind letters, against a dynamic program without pruning."""

import math
import random
from collections.abc import Iterator, Mapping
from functools import reduce

import pytest

from usd2kg.grounding.lexical.reading.beam_search import ROOT, Arc, Beam, Piece, log_sum
from usd2kg.grounding.lexical.reading.shortening_settings import CHANNEL

SECONDS = {"tea": {"pot": math.log(15), "cup": math.log(3)}, "door": {"bell": math.log(40)}}
MOST = math.log(40)
NEXT_WORD = math.log(CHANNEL.next_word)
NEVER = (-math.inf, 0.0)

Ways = Mapping[tuple[int, int], tuple[tuple[float, float], Mapping[str, list[float]]]]
"""(start, end) → the log probability that these letters are not a word, and word → log probabilities of its sources."""
Found = list[tuple[tuple[str, ...], float]]


def seconds(word: str) -> Mapping[str, float]:
    return SECONDS.get(word, {})


def piece(reasons: Mapping[str, list[float]]) -> Piece:
    words = sorted(((reduce(log_sum, scores), word) for word, scores in reasons.items()), reverse=True)
    return Piece(words, reasons, max(map(len, reasons.values()), default=0))


def by_beam(ways: Ways, length: int) -> Found:
    read = Beam(seconds, MOST)
    paths = [ROOT]
    arcs: list[list[Arc]] = [[] for _ in range(length + 1)]
    for at in range(length):
        starts = read.starts(paths)
        for (start, end), (unread, reasons) in ways.items():
            is_any = bool(reasons) or unread != NEVER
            if start == at and starts.ordered and is_any:
                arcs[end].append(Arc(starts, unread, piece(reasons)))
        paths = read.best(arcs[at + 1])
    return [(read.words(path), path[0]) for path in paths]


def by_adding_up(ways: Ways, length: int) -> Found:
    """Return the same from all paths to each letter, cut to the width of the beam only when all are known."""
    paths: list[dict[tuple[str, ...], tuple[float, int]]] = [{(): (0.0, 0)}, *({} for _ in range(length))]
    for end in range(1, length + 1):
        every = [way for (start, at), known in ways.items() if at == end for way in extended(paths[start], *known)]
        best = max((score for score, _, _ in every), default=0.0)
        for score, words, pieces in sorted(every, key=lambda way: -way[0]):
            if score > best - CHANNEL.max_log_loss:
                known_score, known_pieces = paths[end].get(words, (None, pieces))
                paths[end][words] = (score if known_score is None else log_sum(known_score, score), known_pieces)
        ranked = sorted(paths[end].items(), key=lambda path: (-path[1][0], path[0]))
        paths[end] = dict(ranked[: CHANNEL.beam_width])
    return [(words, score) for words, (score, _) in paths[length].items()]


def extended(
    paths: Mapping[tuple[str, ...], tuple[float, int]], unread: tuple[float, float], reasons: Mapping[str, list[float]]
) -> Iterator[tuple[float, tuple[str, ...], int]]:
    for words, (score, pieces) in paths.items():
        if pieces < CHANNEL.max_pieces:
            begun = score + (NEXT_WORD if pieces else 0.0)
            if unread != NEVER:
                yield begun + sum(unread), words, pieces + 1
            for word, scores in reasons.items():
                bonus = seconds(words[-1]).get(word, 0.0) if words else 0.0
                yield from ((begun + reason + bonus, (*words, word), pieces + 1) for reason in scores)


def assert_same(found: Found, expected: Found) -> None:
    assert [words for words, _ in found] == [words for words, _ in expected]
    assert [score for _, score in found] == pytest.approx([score for _, score in expected], abs=1e-9)


def test_readings_of_two_pieces_worked_by_hand():
    ways = {(0, 1): (NEVER, {"tea": [-1.0]}), (1, 2): ((-2.0, 0.0), {"pot": [-3.0], "bell": [-3.0]})}
    bonus, step = math.log(15), NEXT_WORD
    # Tea pot is a known pair, tea bell is not; the last letter may not be a word.
    expected = [(("tea", "pot"), -4 + bonus + step), (("tea",), -3 + step), (("tea", "bell"), -4 + step)]
    assert_same(by_beam(ways, 2), expected)


def test_paths_to_the_same_words_add_up():
    ways = {(0, 1): ((-5.0, 0.0), {}), (1, 2): (NEVER, {"cup": [-1.0]}), (0, 2): (NEVER, {"cup": [-3.0, -3.0]})}
    one = -5 - 1 + NEXT_WORD
    ((words, score),) = by_beam(ways, 2)
    assert words == ("cup",)
    assert score == pytest.approx(math.log(math.exp(one) + 2 * math.exp(-3)))


def test_equal_readings_are_sorted_by_their_words():
    words = [f"w{at:02d}" for at in range(30)]
    ways = {(0, 1): (NEVER, {word: [-2.0] for word in reversed(words)})}
    assert [found for found, _ in by_beam(ways, 1)] == [(word,) for word in words[:10]]


def test_without_arcs_there_is_no_reading():
    assert by_beam({(0, 1): ((-1.0, 0.0), {})}, 2) == []


def test_at_most_eight_pieces_are_read():
    ways = {(at, at + 1): ((-1.0, 0.0), {"tea": [-1.0]}) for at in range(9)}
    assert len(by_beam(ways, 8)) > 0
    assert by_beam(ways, 9) == by_adding_up(ways, 9) == []


@pytest.mark.parametrize("seed", range(60))
def test_pruning_does_not_change_the_best_readings(seed: int):
    rng = random.Random(seed)
    length, spread = rng.randint(1, 7), rng.choice([0.5, 3.0, 12.0])
    vocabulary = ["tea", "pot", "cup", "door", "bell", *(f"w{at}" for at in range(rng.choice([2, 12])))]

    def score() -> float:
        # Some scores are equal, as for rare words.
        return rng.choice([-rng.random() * spread - 3, -5.0])

    ways = {}
    for start in range(length):
        for end in range(start + 1, length + 1):
            if rng.random() < 0.7:
                said = rng.sample(vocabulary, rng.randint(0, len(vocabulary)))
                reasons = {word: [score() for _ in range(rng.choice([1, 1, 2]))] for word in said}
                ways[start, end] = (rng.choice([NEVER, (score(), score())]), reasons)
    assert_same(by_beam(ways, length), by_adding_up(ways, length))
