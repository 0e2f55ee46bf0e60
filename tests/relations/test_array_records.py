"""Chains of rows: cycles, and what is reached along a chain."""

import numpy as np
import pytest

from usd2kg.relations.array_records import are_reached, is_on_cycle


def walk(start: int, after: list[int]) -> list[int]:
    """Return the items after a start, each once."""
    found: list[int] = []
    here = after[start]
    while here >= 0 and here not in found:
        found.append(here)
        here = after[here]
    return found


@pytest.mark.parametrize("seed", range(30))
def test_reaches_what_a_walk_reaches(seed: int):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 14))
    # Few ends, so that chains are long and some end in cycles.
    after = rng.integers(-1, count, count)
    starts, goals = (side.ravel() for side in np.meshgrid(np.arange(count), np.arange(count)))
    walks = [walk(start, after.tolist()) for start in range(count)]
    expected = [goal in walks[start] for start, goal in zip(starts.tolist(), goals.tolist(), strict=True)]
    assert are_reached(goals, starts, after).tolist() == expected
    cyclic = [index in walks[index] for index in range(count)]
    assert is_on_cycle(after, np.arange(count)).tolist() == cyclic


def test_reaches_nothing_without_pairs_or_items():
    none = np.zeros(0, np.int64)
    assert are_reached(none, none, none).tolist() == []
    assert are_reached(none, none, np.array([-1])).tolist() == []


def test_follows_a_long_chain():
    after = np.append(np.arange(1, 100_000), -1)
    assert are_reached(np.array([99_999, 5, 0]), np.array([0, 4, 5]), after).tolist() == [True, True, False]
