import numpy as np
import pytest

from tests.shapes.solids import boxes, open_box, surface_of, table, turned
from usd2kg.shapes.surface import Surface, SurfaceCache, SurfacePiece, is_box

UNIT = ((0, 0, 0), (1, 1, 1))


def test_a_box_is_a_box():
    assert is_box(boxes(UNIT))


@pytest.mark.parametrize(
    "surface",
    [
        # Five of six faces have the corners of a box, but no lid.
        surface_of(boxes(UNIT).pieces[0].points, boxes(UNIT).pieces[0].triangles[[0, 6, 1, 7, 2, 8, 3, 9, 4, 10]]),
        open_box(*UNIT),
        table(*UNIT),
        turned((0, 0), (1, 0), (1, 1), (0, 1)),
        surface_of([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2)]),
    ],
    ids=["open", "walls", "table", "cylinder", "triangle"],
)
def test_others_are_not(surface: Surface):
    assert not is_box(surface)


def test_a_matrix_moves_and_scales():
    piece = boxes(UNIT).pieces[0]
    matrix = np.diag([2.0, 1.0, 1.0, 1.0])
    matrix[3, :3] = (5, 0, 0)
    moved = Surface((SurfacePiece(piece.points, piece.triangles, matrix),))
    assert moved.lower.min(axis=0).tolist() == [5, 0, 0]
    assert moved.upper.max(axis=0).tolist() == [7, 1, 1]


@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_mirroring_keeps_triangles_facing_outward(mirror: float):
    piece = boxes(UNIT).pieces[0]
    surface = Surface((SurfacePiece(piece.points, piece.triangles, np.diag([mirror, 1.0, 1.0, 1.0])),))
    assert surface.orientation == 1


def test_orientation_of_inverted_and_flat_surfaces():
    piece = boxes(UNIT).pieces[0]
    assert surface_of(piece.points, piece.triangles[:, ::-1]).orientation == -1
    assert surface_of([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]).orientation == 0


def test_a_cache_keeps_what_was_used_last():
    # Each box has 12 triangles.
    cache = SurfaceCache(max_triangles=24)
    one, other, third = (Surface(boxes(((x, 0, 0), (x + 1, 1, 1))).pieces, cache) for x in range(3))
    kept = one.corners
    assert other.corners is other.corners
    assert one.corners is kept
    third.corners  # noqa: B018
    assert one.corners is kept
    assert other.lower.min(axis=0).tolist() == [1, 0, 0]
