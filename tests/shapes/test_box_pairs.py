"""Pairs of boxes that overlap seen from above: the same as comparing each with each."""

import time

import numpy as np
import pytest

from usd2kg.shapes import box_pairs, overlapping_pairs


@pytest.fixture
def sorted_into_cells(monkeypatch: pytest.MonkeyPatch):
    """Leave out the shorter way for few boxes."""
    monkeypatch.setattr(box_pairs, "_FEW", 0)


def found(lower, upper, others=None) -> list[tuple[int, int]]:
    pairs = overlapping_pairs(np.array(lower, float), np.array(upper, float), others)
    return [pair for i, j in pairs for pair in zip(i.tolist(), j.tolist(), strict=True)]


def compared(lower, upper, others_lower, others_upper) -> set[tuple[int, int]]:
    meets = ((lower[:, None] <= others_upper[None]) & (upper[:, None] >= others_lower[None])).all(axis=2)
    return {(int(i), int(j)) for i, j in zip(*np.nonzero(meets), strict=True)}


def boxes(random: np.random.Generator, count: int, step: float):
    """Return boxes from a millimetre to ten metres and some without extent, on round numbers, so that some touch."""
    lower = (random.uniform(-3, 3, (count, 2)) / step).round() * step
    size = 10 ** random.uniform(-3, 1, (count, 2)) * (random.random((count, 1)) > 0.2)
    return lower, lower + (size / step).round() * step


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("step", [0.1, 0.25])
@pytest.mark.usefixtures("sorted_into_cells")
def test_each_pair_is_found_once(seed: int, step: float):
    random = np.random.default_rng(seed)
    here, there = boxes(random, int(random.integers(0, 60)), step), boxes(random, int(random.integers(0, 60)), step)
    among = found(*here)
    assert len(among) == len(set(among))
    assert set(among) == {(i, j) for i, j in compared(*here, *here) if i < j}
    across = found(*here, others=there)
    assert len(across) == len(set(across))
    assert set(across) == compared(*here, *there)


def test_few_boxes_give_the_same():
    random = np.random.default_rng(3)
    here, there = boxes(random, 30, 0.1), boxes(random, 20, 0.1)
    assert set(found(*here)) == {(i, j) for i, j in compared(*here, *here) if i < j}
    assert set(found(*here, others=there)) == compared(*here, *there)


@pytest.mark.usefixtures("sorted_into_cells")
def test_touching_counts_and_a_hair_apart_does_not():
    assert found([[0, 0], [1, 0]], [[1, 1], [2, 1]]) == [(0, 1)]
    assert found([[0, 0], [1.001, 0]], [[1, 1], [2, 1]]) == []


@pytest.mark.parametrize("few", [0, 1_000_000])
def test_without_boxes_there_are_no_pairs(monkeypatch: pytest.MonkeyPatch, few: int):
    monkeypatch.setattr(box_pairs, "_FEW", few)
    nothing = np.zeros((0, 2))
    assert found(nothing, nothing) == []
    assert found(nothing, nothing, others=(np.zeros((3, 2)), np.ones((3, 2)))) == []
    assert found(np.zeros((3, 2)), np.ones((3, 2)), others=(nothing, nothing)) == []


@pytest.mark.usefixtures("sorted_into_cells")
def test_many_pairs_come_in_portions(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(box_pairs, "_CHUNK", 64)
    random = np.random.default_rng(5)
    here = boxes(random, 80, 0.1)
    assert set(found(*here)) == {(i, j) for i, j in compared(*here, *here) if i < j}


def test_a_hundred_thousand_boxes_under_one_roof_take_seconds():
    # A grid of things 0.1 m wide, 0.3 m apart, and one box over all of them: each meets the roof and nothing else.
    x, y = (axis.ravel() * 0.3 for axis in np.meshgrid(np.arange(320.0), np.arange(320.0)))
    lower = np.concatenate([[[0.0, 0.0]], np.stack([x, y], axis=1)])
    upper = np.concatenate([[[100.0, 100.0]], np.stack([x, y], axis=1) + 0.1])
    start = time.process_time()
    count = sum(len(i) for i, _ in overlapping_pairs(lower, upper))
    assert time.process_time() - start < 10
    assert count == 320 * 320
