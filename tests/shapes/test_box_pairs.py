"""Pairs of boxes that overlap seen from above: compared with brute force."""

import time

import numpy as np
import pytest

from usd2kg.shapes import box_pairs, overlapping_pairs


@pytest.fixture
def no_brute_force(monkeypatch: pytest.MonkeyPatch):
    """Use the grid for few boxes, too."""
    monkeypatch.setattr(box_pairs, "_BRUTE_FORCE_PAIRS", 0)


def found(lower, upper, others=None) -> list[tuple[int, int]]:
    pairs = overlapping_pairs(np.array(lower, float), np.array(upper, float), others)
    return [pair for i, j in pairs for pair in zip(i.tolist(), j.tolist(), strict=True)]


def compared(lower, upper, others_lower, others_upper) -> set[tuple[int, int]]:
    meets = ((lower[:, None] <= others_upper[None]) & (upper[:, None] >= others_lower[None])).all(axis=2)
    return {(int(i), int(j)) for i, j in zip(*np.nonzero(meets), strict=True)}


def boxes(random: np.random.Generator, count: int, step: float):
    """Return boxes of 0 m and of 1 mm to 10 m; rounding to `step` makes some of them touch."""
    lower = (random.uniform(-3, 3, (count, 2)) / step).round() * step
    size = 10 ** random.uniform(-3, 1, (count, 2)) * (random.random((count, 1)) > 0.2)
    return lower, lower + (size / step).round() * step


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("step", [0.1, 0.25])
@pytest.mark.usefixtures("no_brute_force")
def test_finds_each_pair_once(seed: int, step: float):
    random = np.random.default_rng(seed)
    here, there = boxes(random, int(random.integers(0, 60)), step), boxes(random, int(random.integers(0, 60)), step)
    among = found(*here)
    assert len(among) == len(set(among))
    assert set(among) == {(i, j) for i, j in compared(*here, *here) if i < j}
    across = found(*here, others=there)
    assert len(across) == len(set(across))
    assert set(across) == compared(*here, *there)


def test_brute_force_for_few_boxes_finds_the_same_pairs():
    random = np.random.default_rng(3)
    here, there = boxes(random, 30, 0.1), boxes(random, 20, 0.1)
    assert set(found(*here)) == {(i, j) for i, j in compared(*here, *here) if i < j}
    assert set(found(*here, others=there)) == compared(*here, *there)


@pytest.mark.usefixtures("no_brute_force")
def test_touching_boxes_overlap():
    assert found([[0, 0], [1, 0]], [[1, 1], [2, 1]]) == [(0, 1)]
    assert found([[0, 0], [1.001, 0]], [[1, 1], [2, 1]]) == []


@pytest.mark.parametrize("max_pairs", [0, 1_000_000])
def test_without_boxes_there_are_no_pairs(monkeypatch: pytest.MonkeyPatch, max_pairs: int):
    monkeypatch.setattr(box_pairs, "_BRUTE_FORCE_PAIRS", max_pairs)
    nothing = np.zeros((0, 2))
    assert found(nothing, nothing) == []
    assert found(nothing, nothing, others=(np.zeros((3, 2)), np.ones((3, 2)))) == []
    assert found(np.zeros((3, 2)), np.ones((3, 2)), others=(nothing, nothing)) == []


@pytest.mark.usefixtures("no_brute_force")
def test_many_pairs_come_in_chunks(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(box_pairs, "_CHUNK", 64)
    random = np.random.default_rng(5)
    here = boxes(random, 80, 0.1)
    assert set(found(*here)) == {(i, j) for i, j in compared(*here, *here) if i < j}


def test_a_hundred_thousand_boxes_below_a_roof_take_seconds():
    # Boxes of 0.1 m on a grid of 0.3 m below one large box: each overlaps only the large one.
    x, y = (axis.ravel() * 0.3 for axis in np.meshgrid(np.arange(320.0), np.arange(320.0)))
    lower = np.concatenate([[[0.0, 0.0]], np.stack([x, y], axis=1)])
    upper = np.concatenate([[[100.0, 100.0]], np.stack([x, y], axis=1) + 0.1])
    start = time.process_time()
    count = sum(len(i) for i, _ in overlapping_pairs(lower, upper))
    assert time.process_time() - start < 10
    assert count == 320 * 320
