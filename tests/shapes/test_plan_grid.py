"""Plan grid: cells, connected areas and outlines."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from usd2kg.shapes.plan_grid import PlanGrid, connected_areas, cut_segments, holds_square, outline_loops

UNTURNED = np.eye(2)


def cells(*rows: str) -> np.ndarray:
    """Return a mask from rows of text, the first row at the largest y."""
    return np.array([[c == "#" for c in row] for row in reversed(rows)]).T


def test_a_spiral_is_one_area():
    mask = cells("#####", "....#", "###.#", "#...#", "#####")
    assert connected_areas(np.where(mask, 0, -1)).max() == 0


def test_areas_meet_across_sides_not_corners():
    assert connected_areas(np.where(cells("#.", ".#"), 0, -1)).max() == 1


def test_many_areas_are_those_of_a_flood_fill():
    rng = np.random.default_rng(3)
    kinds = rng.integers(-1, 2, (40, 60))
    found = connected_areas(kinds)
    expected = np.full(kinds.shape, -1)
    for start in np.argwhere(kinds >= 0).tolist():
        if expected[tuple(start)] >= 0:
            continue
        number, stack = expected.max() + 1, [tuple(start)]
        while stack:
            x, y = stack.pop()
            if not (0 <= x < 40 and 0 <= y < 60) or expected[x, y] >= 0 or kinds[x, y] != kinds[tuple(start)]:
                continue
            expected[x, y] = number
            stack += [(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)]
    assert found.max() == expected.max()
    assert len({*zip(found.ravel().tolist(), expected.ravel().tolist(), strict=True)}) == found.max() + 2


def test_only_wide_areas_hold_a_square():
    areas = connected_areas(np.where(cells("###...", "###.##", "###.##"), 0, -1))
    assert holds_square(areas, 2).tolist() == [0, 1]
    assert holds_square(areas, 3).tolist() == [0]
    assert holds_square(areas, 4).tolist() == []


def test_outline_has_corners_only_and_holes_run_clockwise():
    outer, hole = outline_loops(cells("####", "#..#", "####"))
    assert {tuple(corner) for corner in outer.tolist()} == {(0, 0), (4, 0), (4, 3), (0, 3)}
    assert {tuple(corner) for corner in hole.tolist()} == {(1, 1), (3, 1), (3, 2), (1, 2)}
    assert [signed_area(outer), signed_area(hole)] == [12, -2]


def test_cells_that_meet_at_a_corner_have_two_outlines():
    assert [signed_area(loop) for loop in outline_loops(cells("#.", ".#"))] == [1, 1]


def signed_area(loop: np.ndarray) -> float:
    x, y = loop.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def test_a_cut_through_an_upright_triangle():
    triangle = np.array([[[0, 0, 0], [4, 0, 0], [0, 0, 2]]], float)
    (segment,) = cut_segments(triangle, 1.0)
    assert sorted(segment.tolist()) == [[0, 0], [2, 0]]
    assert len(cut_segments(triangle, 3.0)) == 0


@pytest.mark.parametrize("degrees", [0, 30])
def test_oblique_segments_leave_no_gap(degrees: int):
    angle = np.radians(degrees)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    grid = PlanGrid(np.array([-5.0, -5.0]), 0.1, (100, 100), turn)
    mask = np.zeros(grid.shape, bool)
    corners = np.array([[-3, -2], [3, -1], [2, 3], [-1, 2]], float)
    grid.mark_segments(mask, np.stack([corners, np.roll(corners, -1, axis=0)], axis=1))
    assert connected_areas(np.where(mask, -1, 0)).max() == 1


def test_triangles_cover_a_turned_square():
    grid = PlanGrid(np.array([0.0, 0.0]), 0.05, (60, 60), UNTURNED)
    mask = np.zeros(grid.shape, bool)
    a, b, c, d = [1.5, 0.5], [2.5, 1.5], [1.5, 2.5], [0.5, 1.5]
    grid.mark_triangles(mask, np.array([[a, b, c], [c, d, a]]))
    # A square of sides 2 ** 0.5 m; the cells along its sides are half outside.
    assert mask.sum() * 0.05**2 == pytest.approx(2.0, abs=4 * 2**0.5 * 0.05)


@given(
    corners=st.lists(st.tuples(*[st.integers(-39, 39)] * 6), min_size=1, max_size=4),
    degrees=st.sampled_from([0, 17, 45, 90]),
)
def test_triangles_cover_the_cells_whose_middles_are_in_them(corners: list[tuple[int, ...]], degrees: int):
    angle = np.radians(degrees)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    grid = PlanGrid(np.array([-6.0, -6.0]), 0.25, (48, 48), turn)
    # Off the borders of cells, where rounding decides.
    triangles = np.array(corners, float).reshape(-1, 3, 2) / 10 + [0.003, 0.0047]
    mask, sides = np.zeros(grid.shape, bool), np.zeros(grid.shape, bool)
    grid.mark_triangles(mask, triangles)
    for side in range(3):
        grid.mark_segments(sides, triangles[:, [side, (side + 1) % 3]])
    middles = grid.world(np.argwhere(np.ones(grid.shape, bool)) + 0.5)
    expected = sides.copy()
    for a, b, c in triangles:
        turns = [
            (q - p)[0] * (middles - p)[:, 1] - (q - p)[1] * (middles - p)[:, 0] for p, q in ((a, b), (b, c), (c, a))
        ]
        is_in = np.all([turn > 1e-9 for turn in turns], axis=0) | np.all([turn < -1e-9 for turn in turns], axis=0)
        expected |= is_in.reshape(grid.shape)
    assert np.array_equal(mask, expected)

    window, cells = grid.window(triangles.reshape(-1, 2))
    part = np.zeros(window.shape, bool)
    window.mark_triangles(part, triangles)
    assert np.array_equal(mask[cells], part)
