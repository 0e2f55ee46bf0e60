"""Dense heaps: the time grows with the number of objects, and the pairs are those of a plain search."""

import time
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.relations.run import make_scene
from tests.relations.room_builder import home
from usd2kg.relations import above_below, find_relations
from usd2kg.scene import Box
from usd2kg.shapes import overlapping_pairs

SECONDS = 10.0
"""Processor time allowed for 8,000 objects, five times what they take; a search of all pairs takes longer."""


def test_a_tower_is_not_quadratic():
    scene, grounding = make_scene(8_000, home(), "tower")
    start = time.process_time()
    assert find_relations(scene, home(), grounding)
    assert time.process_time() - start < SECONDS


@pytest.mark.parametrize("depth", [0.0, 60.0])
def test_a_heap_has_the_relations_that_all_pairs_have(depth: float, monkeypatch: pytest.MonkeyPatch):
    scene, grounding = make_scene(900, home(), "tower")
    # Far below it there is a floor, to which most of the heap has nothing in between but the heap.
    floor = Box((-1, -1, -depth - 0.1), (2, 2, -depth))
    first = replace(scene.objects[0], box=floor, own_box=floor)
    scene = replace(scene, objects=(first, *scene.objects[1:]))
    monkeypatch.setattr(above_below, "_MAX_PAIRS", 0)
    layer_by_layer = find_relations(scene, home(), grounding)
    monkeypatch.setattr(above_below, "_MAX_PAIRS", 10**9)
    assert layer_by_layer == find_relations(scene, home(), grounding)
    assert sum(relation.kind == "above" for relation in layer_by_layer) > 1000


@pytest.mark.parametrize("count", [50, 1500])
def test_pairs_in_space(count: int):
    rng = np.random.default_rng(5)
    lower = rng.uniform(0, 3, (count, 3))
    upper = lower + rng.choice([0.0, 0.1, 0.7], (count, 3))
    overlaps = ((lower[:, None] <= upper[None]) & (upper[:, None] >= lower[None])).all(axis=2)
    expected = set(zip(*(side.tolist() for side in np.nonzero(np.triu(overlaps, 1))), strict=True))
    found = [pair for i, j in overlapping_pairs(lower, upper) for pair in zip(i.tolist(), j.tolist(), strict=True)]
    assert len(found) == len(set(found))
    assert set(found) == expected
    halves = overlapping_pairs(lower[::2], upper[::2], (lower[1::2], upper[1::2]))
    between = {pair for i, j in halves for pair in zip(i.tolist(), j.tolist(), strict=True)}
    assert between == set(zip(*(side.tolist() for side in np.nonzero(overlaps[::2, 1::2])), strict=True))
