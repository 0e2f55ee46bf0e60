"""The form of objects: volume, sizes, roundness and how much water they hold; and the hulls it is measured with."""

import math
from functools import cache
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.scene.usda import METRES, component, cube, header, ops, prim, xform
from usd2kg.scene import ReadOptions, read_scene
from usd2kg.scene import shapes as module
from usd2kg.scene.shapes import describe_shapes, describe_triangles
from usd2kg.scene.stage import open_stage
from usd2kg.shapes.hull import convex_hull, convex_polygon, largest_normals, smallest_box, smallest_rectangle

SIDES = 48
"""Of everything round here: its area is that of the polygon, not that of the circle."""


def polygon_area(radius):
    return SIDES / 2 * math.sin(2 * math.pi / SIDES) * radius**2


def box(x, y, z, at=(0, 0, 0)):
    """Return points and outward triangles of a box, its lowest corner at `at`."""
    points = np.array(list(product((0, x), (0, y), (0, z))), float) + at
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def turned(*profile):
    """Return what a profile of (radius, height), from the bottom outside to the inside, makes about z."""
    angles = 2 * math.pi / SIDES * np.arange(SIDES)
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    points = np.concatenate([np.column_stack([ring * r, np.full(SIDES, z)]) for r, z in profile])
    i = np.arange(SIDES)
    j = (i + 1) % SIDES
    faces = []
    for below in range(0, SIDES * (len(profile) - 1), SIDES):
        above = below + SIDES
        faces += [
            np.column_stack([below + i, below + j, above + j]),
            np.column_stack([below + i, above + j, above + i]),
        ]
    return points, np.concatenate(faces)


def together(*meshes):
    starts = np.cumsum([0, *(len(points) for points, _ in meshes)])
    return (
        np.concatenate([points for points, _ in meshes]),
        np.concatenate([triangles + start for (_, triangles), start in zip(meshes, starts, strict=False)]),
    )


def rotation(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    a, b = [i for i in range(3) if i != axis]
    matrix = np.eye(3)
    matrix[a, a], matrix[a, b], matrix[b, a], matrix[b, b] = c, -s, s, c
    return matrix


def moved(mesh, matrix=None, shift=(0, 0, 0)):
    points, triangles = mesh
    matrix = np.eye(3) if matrix is None else matrix
    return points @ matrix.T + shift, triangles if np.linalg.det(matrix) > 0 else triangles[:, ::-1]


def globe(radius=1.0, rings=24):
    steps = np.linspace(-math.pi / 2, math.pi / 2, rings + 1)
    return turned(
        *[(radius * max(math.cos(s), 0) if 0 < k < rings else 0, radius * math.sin(s)) for k, s in enumerate(steps)]
    )


def cup(radius=0.04, height=0.1, wall=0.003):
    """Return a cup with a flat bottom as thick as its wall; it holds the inner cylinder."""
    inner = radius - wall
    return turned((0, 0), (radius, 0), (radius, height), (inner, height), (inner, wall), (0, wall))


def tub(x, y, z, wall):
    """Return an open box as one closed surface of five slabs."""
    return together(
        box(x, y, wall),
        box(wall, y, z - wall, (0, 0, wall)),
        box(wall, y, z - wall, (x - wall, 0, wall)),
        box(x - 2 * wall, wall, z - wall, (wall, 0, wall)),
        box(x - 2 * wall, wall, z - wall, (wall, y - wall, wall)),
    )


CUP = cup()
CUP_HOLDS = polygon_area(0.037) * 0.097
TETRAHEDRON = (
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
)
TABLE = together(
    box(1.6, 0.8, 0.04, (0, 0, 0.7)), *(box(0.06, 0.06, 0.7, (x, y, 0)) for x in (0, 1.54) for y in (0, 0.74))
)


def describe(mesh):
    shape = describe_triangles(*mesh)
    assert shape is not None
    return shape


@cache
def shape_of_cup():
    return describe(CUP)


def sizes(shape):
    return shape.long_m, shape.middle_m, shape.short_m


class TestVolumeAndSizes:
    def test_unit_cube(self):
        shape = describe(box(1, 1, 1))
        assert (shape.volume_m3, shape.hull_volume_m3, shape.surface_m2) == pytest.approx((1, 1, 6))
        assert sizes(shape) == pytest.approx((1, 1, 1))
        assert (shape.elongation, shape.flatness) == pytest.approx((0, 0), abs=1e-9)
        assert shape.roundness == pytest.approx((math.pi / 6) ** (1 / 3))
        assert shape.verticality == pytest.approx(0.5)
        assert (shape.openness, shape.capacity_m3) == (0, 0)

    @pytest.mark.parametrize(
        "matrix", [np.eye(3), rotation(2, 30), rotation(0, 20) @ rotation(1, 50) @ rotation(2, 10)]
    )
    def test_box_in_any_orientation(self, matrix):
        shape = describe(moved(box(2, 1, 0.5), matrix, (3, -4, 5)))
        assert sizes(shape) == pytest.approx((2, 1, 0.5))
        assert (shape.volume_m3, shape.hull_volume_m3, shape.surface_m2) == pytest.approx((1, 1, 7))
        assert (shape.elongation, shape.flatness) == pytest.approx((0.5, 0.5))
        assert shape.roundness == pytest.approx((36 * math.pi) ** (1 / 3) / 7)

    def test_verticality_tells_standing_from_lying(self):
        assert describe(box(0.1, 0.1, 0.9)).verticality == pytest.approx(0.9)
        assert describe(box(0.9, 0.1, 0.1)).verticality == pytest.approx(0.1)

    def test_globe(self):
        shape = describe(globe())
        assert shape.volume_m3 == pytest.approx(4 / 3 * math.pi, rel=0.01)
        assert shape.hull_volume_m3 == pytest.approx(shape.volume_m3, rel=0.01)
        assert sizes(shape) == pytest.approx((2, 2, 2), rel=0.01)
        assert 0.99 < shape.roundness <= 1
        assert shape.openness == 0

    def test_cylinder(self):
        shape = describe(turned((0, 0), (1, 0), (1, 4), (0, 4)))
        assert shape.volume_m3 == pytest.approx(4 * polygon_area(1))
        assert shape.hull_volume_m3 == pytest.approx(4 * polygon_area(1))
        assert sizes(shape) == pytest.approx((4, 2, 2), rel=0.003)
        assert shape.elongation == pytest.approx(0.5, abs=0.003)

    def test_tetrahedron(self):
        shape = describe(TETRAHEDRON)
        assert shape.volume_m3 == pytest.approx(1 / 6)
        assert shape.surface_m2 == pytest.approx(1.5 + math.sqrt(3) / 2)

    def test_rod_along_a_diagonal_is_as_thin_as_it_is(self):
        assert sizes(describe(moved(box(1, 0.02, 0.02), rotation(1, 40) @ rotation(2, 25)))) == pytest.approx(
            (1, 0.02, 0.02)
        )


class TestClosed:
    def test_parts_are_added_and_hull_spans_them(self):
        shape = describe(together(box(1, 1, 1), box(1, 1, 1, (2, 0, 0))))
        assert (shape.volume_m3, shape.hull_volume_m3) == pytest.approx((2, 3))

    def test_winding_does_not_matter(self):
        points, triangles = box(1, 1, 1, (2, 0, 0))
        assert describe((points, triangles[:, ::-1])).volume_m3 == pytest.approx(1)
        assert describe(together(box(1, 1, 1), (points, triangles[:, ::-1]))).volume_m3 == pytest.approx(2)

    def test_mirrored(self):
        points, triangles = moved(TETRAHEDRON, np.diag([-1.0, 1, 1]))
        assert describe((points, triangles)).volume_m3 == pytest.approx(1 / 6)

    def test_cavity_is_taken_off(self):
        points, triangles = box(1, 1, 1, (1, 1, 1))
        assert describe(together(box(3, 3, 3), (points, triangles[:, ::-1]))).volume_m3 == pytest.approx(26)
        assert describe(together(box(3, 3, 3), (points, triangles))).volume_m3 == pytest.approx(28)

    def test_split_corners_are_welded(self):
        points, triangles = box(1, 2, 3)
        assert describe((points[triangles].reshape(-1, 3), np.arange(36).reshape(-1, 3))).volume_m3 == pytest.approx(6)

    def test_open_box_encloses_nothing(self):
        points, triangles = box(1, 1, 1)
        assert describe((points, triangles[1:])).volume_m3 is None

    def test_pinhole_counts_as_closed(self):
        points, triangles = globe(rings=96)
        shape = describe((points, np.delete(triangles, len(triangles) // 2, axis=0)))
        assert shape.volume_m3 == pytest.approx(describe((points, triangles)).volume_m3, rel=1e-3)

    def test_faces_turned_at_random_are_not_closed(self):
        points, triangles = box(1, 1, 1)
        triangles = triangles.copy()
        triangles[:6] = triangles[:6, ::-1]
        assert describe((points, triangles)).volume_m3 is None

    def test_sheet_drawn_from_both_sides_encloses_nothing(self):
        points, triangles = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2], [2, 1, 0]])
        shape = describe((points, triangles))
        assert shape.volume_m3 is None
        assert shape.surface_m2 == pytest.approx(1)

    def test_one_open_part_is_enough(self):
        points, triangles = box(1, 1, 1, (5, 0, 0))
        assert describe(together(box(1, 1, 1), (points, triangles[2:]))).volume_m3 is None


class TestVessels:
    def test_cup_holds_its_inside(self):
        shape = describe(CUP)
        assert shape.capacity_m3 == pytest.approx(CUP_HOLDS, rel=0.03)
        assert shape.openness == pytest.approx(CUP_HOLDS / (polygon_area(0.04) * 0.1), abs=0.03)
        assert shape.volume_m3 == pytest.approx(polygon_area(0.04) * 0.1 - CUP_HOLDS)
        assert shape.openness > 0.5

    def test_wall_without_thickness_is_tight(self):
        shape = describe(turned((0, 0), (0.1, 0), (0.1, 0.2)))
        assert shape.volume_m3 is None
        assert shape.capacity_m3 == pytest.approx(polygon_area(0.1) * 0.2, rel=0.03)

    def test_bowl(self):
        outside = [(math.sin(a), 1 - math.cos(a)) for a in np.linspace(0, math.pi / 2, 25)]
        inside = [(0.96 * r, 1 - 0.96 * (1 - z)) for r, z in reversed(outside)]
        shape = describe(turned(*outside, *inside))
        assert shape.capacity_m3 == pytest.approx(2 / 3 * math.pi * 0.96**3, rel=0.03)
        assert shape.openness > 0.5

    def test_tray_and_box_without_lid(self):
        assert describe(tub(0.4, 0.3, 0.03, 0.004)).capacity_m3 == pytest.approx(0.392 * 0.292 * 0.026, rel=0.03)
        assert describe(tub(0.4, 0.3, 0.3, 0.01)).openness > 0.8

    def test_lid_closes(self):
        lidded = together(tub(0.4, 0.3, 0.2, 0.01), box(0.4, 0.3, 0.01, (0, 0, 0.2)))
        assert (describe(lidded).openness, describe(lidded).capacity_m3) == (0, 0)

    @pytest.mark.parametrize("mesh", [TABLE, globe(), box(0.2, 0.15, 0.03), moved(CUP, rotation(0, 180)), TETRAHEDRON])
    def test_no_vessel(self, mesh):
        assert describe(mesh).openness < 0.01

    def test_ring_has_no_bottom(self):
        assert describe(turned((0.08, 0), (0.1, 0), (0.1, 0.05), (0.08, 0.05), (0.08, 0))).capacity_m3 == 0

    def test_water_runs_out_through_a_notch(self):
        sides = [box(0.01, 0.3, 0.2, (0, 0, 0)), box(0.01, 0.3, 0.2, (0.29, 0, 0)), box(0.3, 0.01, 0.2, (0, 0.29, 0))]
        whole = together(box(0.3, 0.3, 0.01), *sides, box(0.3, 0.01, 0.05, (0, 0, 0)))
        assert describe(whole).capacity_m3 == pytest.approx(0.28 * 0.28 * 0.04, rel=0.03)

    def test_rail_is_no_wall(self):
        rails = [
            box(0.3, 0.02, 0.02, (0, 0, 0.28)),
            box(0.3, 0.02, 0.02, (0, 0.28, 0.28)),
            box(0.02, 0.3, 0.02, (0, 0, 0.28)),
            box(0.02, 0.3, 0.02, (0.28, 0, 0.28)),
        ]
        posts = [box(0.02, 0.02, 0.27, (x, y, 0.01)) for x in (0, 0.28) for y in (0, 0.28)]
        assert describe(together(box(0.3, 0.3, 0.01), *rails, *posts)).openness < 0.02

    def test_bottle_counts_as_far_as_it_is_seen_from_above(self):
        bottle = turned(
            (0, 0), (0.04, 0), (0.04, 0.2), (0.01, 0.25), (0.009, 0.25), (0.038, 0.2), (0.038, 0.002), (0, 0.002)
        )
        assert describe(bottle).openness < 0.1

    def test_tipping_empties(self):
        openness = [describe(moved(CUP, rotation(0, degrees))).openness for degrees in (0, 20, 40, 90)]
        assert openness[0] > openness[1] > openness[2] > openness[3] == 0

    def test_turning_does_not(self):
        shape = describe(moved(tub(0.4, 0.3, 0.2, 0.01), rotation(2, 30), (7, 8, 9)))
        assert shape.capacity_m3 == pytest.approx(describe(tub(0.4, 0.3, 0.2, 0.01)).capacity_m3, rel=0.01)

    def test_fine_mesh_of_a_bowl(self):
        profile = [(math.sin(a), 1 - math.cos(a)) for a in np.linspace(0, math.pi / 2, 200)]
        assert describe(turned(*profile)).capacity_m3 == pytest.approx(2 / 3 * math.pi, rel=0.03)


class TestBrokenInput:
    @pytest.mark.parametrize(
        ("points", "triangles"),
        [
            ([], []),
            ([[0, 0, 0]], []),
            ([[math.nan, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]),
            ([[math.inf, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]),
            ([[1, 2, 3], [1, 2, 3], [1, 2, 3]], [[0, 1, 2]]),
        ],
    )
    def test_nothing_to_describe(self, points, triangles):
        assert describe_triangles(np.array(points, float), np.array(triangles, int)) is None

    def test_one_triangle(self):
        shape = describe((np.array([[0.0, 0, 0], [3, 0, 0], [0, 4, 0]]), np.array([[0, 1, 2]])))
        assert (shape.volume_m3, shape.hull_volume_m3, shape.roundness, shape.verticality) == (None, 0, 0, 0)
        assert shape.surface_m2 == pytest.approx(6)
        # The rectangles on the edges of a triangle are all twice as large as it is.
        assert sizes(shape) in [pytest.approx((4, 3, 0)), pytest.approx((5, 2.4, 0))]
        assert shape.flatness == 1

    def test_upright_sheet_has_no_footprint(self):
        shape = describe((np.array([[0.0, 0, 0], [2, 0, 0], [2, 0, 1], [0, 0, 1]]), np.array([[0, 1, 2], [0, 2, 3]])))
        assert sizes(shape) == pytest.approx((2, 1, 0))
        assert (shape.openness, shape.capacity_m3) == (0, 0)

    def test_line(self):
        shape = describe((np.array([[0.0, 0, 0], [1, 1, 1], [2, 2, 2]]), np.array([[0, 1, 2]])))
        assert sizes(shape) == pytest.approx((math.sqrt(12), 0, 0), abs=1e-9)
        assert (shape.volume_m3, shape.roundness) == (None, None)

    def test_triangles_with_nan_are_left_out(self):
        points, triangles = box(1, 1, 1)
        broken = np.concatenate([points, [[math.nan, 0, 0]]]), np.concatenate([triangles, [[0, 1, 8]]])
        assert describe(broken) == describe((points, triangles))

    def test_points_without_triangle_do_not_count(self):
        points, triangles = box(1, 1, 1)
        assert describe((np.concatenate([points, [[9, 9, 9]]]), triangles)).hull_volume_m3 == pytest.approx(1)

    def test_three_sheets_at_one_edge(self):
        ends = [[1, 0, 0], [-1, 0.5, 0], [0, -1, 0]]
        assert (
            describe((np.array([[0.0, 0, 0], [0, 0, 1], *ends]), np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]]))).volume_m3
            is None
        )

    @settings(max_examples=25, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.integers(0, 3))
    def test_any_soup_has_sane_figures(self, seed, count, digits):
        rng = np.random.default_rng(seed)
        shape = describe_triangles(np.round(rng.random((12, 3)), digits), rng.integers(0, 12, (count, 3)))
        if shape is None:
            return
        assert shape.long_m >= shape.middle_m >= shape.short_m >= 0
        assert 0 <= shape.openness < 1
        assert 0 <= shape.capacity_m3 <= shape.hull_volume_m3 * 1.05 + 1e-9
        for ratio in (shape.elongation, shape.flatness, shape.roundness, shape.verticality):
            assert ratio is None or -1e-9 <= ratio <= 1 + 1e-9


def assert_same(here, there, factor=1.0):
    assert here.volume_m3 == pytest.approx(there.volume_m3 * factor**3, rel=1e-6)
    assert here.hull_volume_m3 == pytest.approx(there.hull_volume_m3 * factor**3, rel=1e-4)
    assert here.surface_m2 == pytest.approx(there.surface_m2 * factor**2, rel=1e-6)
    assert sizes(here) == pytest.approx([size * factor for size in sizes(there)], rel=0.01)
    assert here.roundness == pytest.approx(there.roundness, rel=1e-3)
    assert here.verticality == pytest.approx(there.verticality, rel=0.01)
    assert here.capacity_m3 == pytest.approx(there.capacity_m3 * factor**3, rel=0.03)
    assert here.openness == pytest.approx(there.openness, rel=0.03)


class TestInvariance:
    @settings(max_examples=6, deadline=None)
    @given(st.tuples(*[st.floats(-20, 20)] * 3), st.floats(-180, 180), st.sampled_from([CUP, tub(0.4, 0.3, 0.2, 0.01)]))
    def test_moved_and_turned(self, shift, degrees, mesh):
        assert_same(describe(moved(mesh, rotation(2, degrees), shift)), describe(mesh))

    @settings(max_examples=6, deadline=None)
    @given(st.floats(0.01, 100))
    def test_scaled(self, factor):
        assert_same(describe(moved(CUP, factor * np.eye(3))), shape_of_cup(), factor)


class TestHull:
    @settings(max_examples=40, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.integers(4, 60), st.integers(1, 6))
    def test_is_closed_convex_and_around_all_points(self, seed, count, digits):
        points = np.round(np.random.default_rng(seed).random((count, 3)), digits)
        hull = convex_hull(points)
        if hull is None:
            assert np.linalg.matrix_rank(points - points[0], tol=1e-3) < 3
            return
        edges = {(t[i], t[(i + 1) % 3]) for t in hull.triangles.tolist() for i in range(3)}
        assert len(edges) == 3 * len(hull.triangles)
        assert all((end, start) in edges for start, end in edges)
        areas = hull.areas[np.linalg.norm(hull.areas, axis=1) > 1e-6]
        firsts = hull.vertices[hull.triangles[np.linalg.norm(hull.areas, axis=1) > 1e-6, 0]]
        above = points @ areas.T - np.einsum("ij,ij->i", areas, firsts)
        assert (above / np.linalg.norm(areas, axis=1)).max() < 1e-4

    def test_grid_with_duplicates(self):
        grid = np.array(list(product(range(5), repeat=3)) * 2, float)
        hull = convex_hull(grid @ rotation(0, 33).T @ rotation(2, 12).T)
        assert hull is not None
        assert (hull.volume, hull.surface) == pytest.approx((64, 96))

    @pytest.mark.parametrize(
        "points",
        [
            np.zeros((9, 3)),
            np.eye(3),
            np.outer(np.arange(9.0), [1, 2, 3]),
            np.array(list(product(range(4), range(3), [7.0])), float),
        ],
    )
    def test_flat_has_none(self, points):
        assert convex_hull(points) is None

    def test_is_cut_short_with_little_loss(self):
        points = np.random.default_rng(0).normal(size=(4000, 3))
        hull = convex_hull(points / np.linalg.norm(points, axis=1, keepdims=True))
        assert hull is not None
        assert len(hull.vertices) == 600
        assert hull.volume == pytest.approx(4 / 3 * math.pi, rel=0.015)

    def test_polygon(self):
        points = np.array([[0, 0], [2, 0], [1, 1], [2, 2], [0, 2], [1, 0], [0, 0]], float)
        assert points[convex_polygon(points)].tolist() == [[0, 0], [2, 0], [2, 2], [0, 2]]
        assert len(convex_polygon(np.ones((4, 2)))) == 1
        assert len(convex_polygon(np.array([[0.0, 0], [1, 1], [2, 2]]))) == 2

    def test_rectangle_of_a_turned_one(self):
        points = np.array([[0, 0], [3, 0], [3, 1], [0, 1]]) @ rotation(2, 20)[:2, :2].T
        axes, extents = smallest_rectangle(points)
        assert extents == pytest.approx((3, 1))
        assert abs(axes[0] @ [math.cos(math.radians(20)), math.sin(math.radians(20))]) == pytest.approx(1)
        assert np.linalg.det(axes) == pytest.approx(1)

    def test_box_lies_on_the_largest_faces(self):
        hull = convex_hull(box(3, 2, 1)[0] @ rotation(0, 25).T)
        assert hull is not None
        normals = largest_normals(hull)
        assert len(normals) == 6
        assert smallest_box(hull.vertices, normals).size == pytest.approx((3, 2, 1))


def mesh_prim(name, mesh, *lines):
    points, triangles = mesh
    return prim(
        "Mesh",
        name,
        f"point3f[] points = [{', '.join(str(tuple(point)) for point in points.tolist())}]",
        f"int[] faceVertexCounts = [{', '.join(['3'] * len(triangles))}]",
        f"int[] faceVertexIndices = [{', '.join(map(str, triangles.reshape(-1).tolist()))}]",
        *lines,
    )


class TestScenes:
    @pytest.fixture
    def shapes(self, write_stage):
        def run(*prims, layer=METRES, options=None, **arguments):
            path = write_stage(layer + "\n".join(prims))
            return describe_shapes(path, read_scene(path, options=options), **arguments)

        return run

    def test_metres_and_up_axis(self, shapes):
        turned_up = moved(CUP, rotation(0, -90) * 100)
        found = shapes(component("Cup", mesh_prim("M", turned_up)), layer=header(metersPerUnit=0.01, upAxis="Y"))
        assert found["/Cup"].capacity_m3 == pytest.approx(CUP_HOLDS, rel=0.03)

    def test_nested_objects_are_left_out(self, shapes):
        inner = component("Box", cube("C", size=1, at=(0, 0, 5)))
        found = shapes(xform("Group", component("Shelf", cube("A", size=2), inner)))
        assert {path: shape.volume_m3 for path, shape in found.items()} == pytest.approx(
            {"/Group/Shelf": 8, "/Group/Shelf/Box": 1}
        )

    def test_paths(self, shapes):
        prims = component("A", cube("C")), component("B", cube("C"))
        assert list(shapes(*prims, paths=["/B", "/Nowhere"])) == ["/B"]
        assert list(shapes(*prims)) == ["/A", "/B"]

    def test_object_without_geometry_is_left_out(self, shapes):
        broken = prim(
            "Mesh",
            "M",
            "point3f[] points = [(0, 0, 0)]",
            "int[] faceVertexCounts = [3]",
            "int[] faceVertexIndices = [0, 1, 2]",
        )
        notes = []
        assert list(shapes(component("A", cube("C")), component("B", broken), diagnostics=notes)) == ["/A"]
        assert [note.prim_path for note in notes if note.code == "mesh"] == ["/B/M"]

    def test_mirrored_prim(self, shapes):
        mirror = ops(("double3", "translate", (3, 0, 0)), ("float3", "scale", (-1, 1, 1)))
        assert shapes(component("T", mesh_prim("M", TETRAHEDRON), mirror))["/T"].volume_m3 == pytest.approx(
            1 / 6, rel=1e-5
        )

    def test_opened_stage(self, write_stage):
        path = write_stage(METRES + component("A", cube("C")))
        opened = open_stage(path, ReadOptions())
        assert describe_shapes(opened, read_scene(path)) == describe_shapes(path, read_scene(path))

    def test_copies_of_a_point_instancer(self, shapes):
        instancer = prim(
            "PointInstancer",
            "I",
            "int[] protoIndices = [0, 0]",
            "point3f[] positions = [(0, 0, 0), (5, 0, 0)]",
            "float3[] scales = [(1, 1, 1), (2, 2, 2)]",
            "rel prototypes = </Shelf/I/P>",
            xform("P", cube("C")),
        )
        shelf = component("Shelf", cube("Board", size=3), instancer)
        assert shapes(shelf)["/Shelf"].volume_m3 == pytest.approx(27)
        found = shapes(shelf, options=ReadOptions(expand_instancers=True))
        assert {path: shape.volume_m3 for path, shape in found.items()} == pytest.approx(
            {"/Shelf": 27, "/Shelf/I[0]": 1, "/Shelf/I[1]": 8}
        )


class TestMeasuredOnce:
    @pytest.fixture
    def measured(self, monkeypatch, write_stage):
        """A function that writes cups placed by transform steps and returns their shapes and one item a measurement."""
        count = []
        describe_body = module._describe
        monkeypatch.setattr(module, "_describe", lambda body: count.append(1) or describe_body(body))

        def run(*placements):
            source = prim("Xform", "Source", mesh_prim("M", CUP), specifier="class")
            cups = [
                component(f"Cup{i}", ops(*steps), meta=["inherits = </Source>", "instanceable = true"])
                for i, steps in enumerate(placements)
            ]
            path = write_stage(METRES + source + "".join(cups))
            count.clear()
            return describe_shapes(path, read_scene(path)), count

        return run

    def test_where_they_stand_does_not_matter(self, measured):
        found, count = measured(
            [("double3", "translate", (0, 0, 0))],
            [("double3", "translate", (3.7, -2.1, 0.83)), ("float", "rotateZ", 71)],
            [("double3", "translate", (-9.3, 12.1, 1.9)), ("float", "rotateZ", -20)],
        )
        assert (len(found), len(count)) == (3, 1)

    def test_tilt_and_scale_do(self, measured):
        found, count = measured(
            [("double3", "translate", (0, 0, 0))],
            [("float", "rotateX", 40)],
            [("float3", "scale", (2, 2, 2))],
            [("float3", "scale", (-1, 1, 1))],
        )
        assert len(count) == 4
        assert found["/Cup1"].openness < found["/Cup0"].openness
        assert found["/Cup2"].volume_m3 == pytest.approx(8 * found["/Cup0"].volume_m3, rel=1e-5)
        assert found["/Cup3"].volume_m3 == pytest.approx(found["/Cup0"].volume_m3, rel=1e-5)
