"""Shape descriptors: volume, sizes, proportions and capacity."""

import math
import sys
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.shapes.meshes import (
    CUP,
    CUP_CAPACITY,
    TABLE,
    TETRAHEDRON,
    box,
    globe,
    join,
    moved,
    polygon_area,
    rotation,
    surface_of_revolution,
    tub,
)
from usd2kg.errors import SceneError
from usd2kg.shapes.descriptors import describe_mesh
from usd2kg.shapes.triangle_mesh import make_triangle_mesh


def describe_triangles(points, triangles):
    mesh = make_triangle_mesh(points.reshape(-1, 3), triangles.reshape(-1, 3))
    return None if mesh is None else describe_mesh(mesh)


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

    def test_verticality_is_high_for_standing_and_low_for_lying(self):
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
        shape = describe(surface_of_revolution((0, 0), (1, 0), (1, 4), (0, 4)))
        assert shape.volume_m3 == pytest.approx(4 * polygon_area(1))
        assert shape.hull_volume_m3 == pytest.approx(4 * polygon_area(1))
        assert sizes(shape) == pytest.approx((4, 2, 2), rel=0.003)
        assert shape.elongation == pytest.approx(0.5, abs=0.003)

    def test_tetrahedron(self):
        shape = describe(TETRAHEDRON)
        assert shape.volume_m3 == pytest.approx(1 / 6)
        assert shape.surface_m2 == pytest.approx(1.5 + math.sqrt(3) / 2)

    def test_size_of_a_rod_is_independent_of_its_direction(self):
        assert sizes(describe(moved(box(1, 0.02, 0.02), rotation(1, 40) @ rotation(2, 25)))) == pytest.approx(
            (1, 0.02, 0.02)
        )


class TestEnclosedVolume:
    def test_adds_the_volumes_of_separate_parts(self):
        shape = describe(join(box(1, 1, 1), box(1, 1, 1, (2, 0, 0))))
        assert (shape.volume_m3, shape.hull_volume_m3) == pytest.approx((2, 3))

    def test_volume_is_independent_of_winding(self):
        points, triangles = box(1, 1, 1, (2, 0, 0))
        assert describe((points, triangles[:, ::-1])).volume_m3 == pytest.approx(1)
        assert describe(join(box(1, 1, 1), (points, triangles[:, ::-1]))).volume_m3 == pytest.approx(2)

    def test_volume_of_a_mirrored_mesh_is_positive(self):
        points, triangles = moved(TETRAHEDRON, np.diag([-1.0, 1, 1]))
        assert describe((points, triangles)).volume_m3 == pytest.approx(1 / 6)

    def test_subtracts_cavities(self):
        points, triangles = box(1, 1, 1, (1, 1, 1))
        assert describe(join(box(3, 3, 3), (points, triangles[:, ::-1]))).volume_m3 == pytest.approx(26)
        assert describe(join(box(3, 3, 3), (points, triangles))).volume_m3 == pytest.approx(28)

    def test_welds_split_corners(self):
        points, triangles = box(1, 2, 3)
        assert describe((points[triangles].reshape(-1, 3), np.arange(36).reshape(-1, 3))).volume_m3 == pytest.approx(6)

    def test_open_box_has_no_volume(self):
        points, triangles = box(1, 1, 1)
        assert describe((points, triangles[1:])).volume_m3 is None

    def test_pinhole_counts_as_closed(self):
        points, triangles = globe(rings=96)
        shape = describe((points, np.delete(triangles, len(triangles) // 2, axis=0)))
        assert shape.volume_m3 == pytest.approx(describe((points, triangles)).volume_m3, rel=1e-3)

    def test_inconsistent_winding_has_no_volume(self):
        points, triangles = box(1, 1, 1)
        triangles = triangles.copy()
        triangles[:6] = triangles[:6, ::-1]
        assert describe((points, triangles)).volume_m3 is None

    def test_double_sided_sheet_has_no_volume(self):
        points, triangles = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2], [2, 1, 0]])
        shape = describe((points, triangles))
        assert shape.volume_m3 is None
        assert shape.surface_m2 == pytest.approx(1)

    def test_one_open_part_leaves_the_volume_unknown(self):
        points, triangles = box(1, 1, 1, (5, 0, 0))
        assert describe(join(box(1, 1, 1), (points, triangles[2:]))).volume_m3 is None


class TestVessels:
    def test_capacity_of_a_cup_is_its_inner_cylinder(self):
        shape = describe(CUP)
        assert shape.capacity_m3 == pytest.approx(CUP_CAPACITY, rel=0.03)
        assert shape.openness == pytest.approx(CUP_CAPACITY / (polygon_area(0.04) * 0.1), abs=0.03)
        assert shape.volume_m3 == pytest.approx(polygon_area(0.04) * 0.1 - CUP_CAPACITY)
        assert shape.openness > 0.5

    def test_wall_without_thickness_is_tight(self):
        shape = describe(surface_of_revolution((0, 0), (0.1, 0), (0.1, 0.2)))
        assert shape.volume_m3 is None
        assert shape.capacity_m3 == pytest.approx(polygon_area(0.1) * 0.2, rel=0.03)

    def test_bowl(self):
        outside = [(math.sin(a), 1 - math.cos(a)) for a in np.linspace(0, math.pi / 2, 25)]
        inside = [(0.96 * r, 1 - 0.96 * (1 - z)) for r, z in reversed(outside)]
        shape = describe(surface_of_revolution(*outside, *inside))
        assert shape.capacity_m3 == pytest.approx(2 / 3 * math.pi * 0.96**3, rel=0.03)
        assert shape.openness > 0.5

    def test_tray_and_box_without_lid(self):
        assert describe(tub(0.4, 0.3, 0.03, 0.004)).capacity_m3 == pytest.approx(0.392 * 0.292 * 0.026, rel=0.03)
        assert describe(tub(0.4, 0.3, 0.3, 0.01)).openness > 0.8

    def test_lidded_tub_holds_nothing(self):
        lidded = join(tub(0.4, 0.3, 0.2, 0.01), box(0.4, 0.3, 0.01, (0, 0, 0.2)))
        assert (describe(lidded).openness, describe(lidded).capacity_m3) == (0, 0)

    @pytest.mark.parametrize("mesh", [TABLE, globe(), box(0.2, 0.15, 0.03), moved(CUP, rotation(0, 180)), TETRAHEDRON])
    def test_solid_objects_hold_nothing(self, mesh):
        assert describe(mesh).openness < 0.01

    def test_ring_without_bottom_holds_nothing(self):
        ring = surface_of_revolution((0.08, 0), (0.1, 0), (0.1, 0.05), (0.08, 0.05), (0.08, 0))
        assert describe(ring).capacity_m3 == 0

    def test_notch_lowers_the_capacity(self):
        sides = [box(0.01, 0.3, 0.2, (0, 0, 0)), box(0.01, 0.3, 0.2, (0.29, 0, 0)), box(0.3, 0.01, 0.2, (0, 0.29, 0))]
        whole = join(box(0.3, 0.3, 0.01), *sides, box(0.3, 0.01, 0.05, (0, 0, 0)))
        assert describe(whole).capacity_m3 == pytest.approx(0.28 * 0.28 * 0.04, rel=0.03)

    def test_railing_holds_nothing(self):
        rails = [
            box(0.3, 0.02, 0.02, (0, 0, 0.28)),
            box(0.3, 0.02, 0.02, (0, 0.28, 0.28)),
            box(0.02, 0.3, 0.02, (0, 0, 0.28)),
            box(0.02, 0.3, 0.02, (0.28, 0, 0.28)),
        ]
        posts = [box(0.02, 0.02, 0.27, (x, y, 0.01)) for x in (0, 0.28) for y in (0, 0.28)]
        assert describe(join(box(0.3, 0.3, 0.01), *rails, *posts)).openness < 0.02

    def test_inside_of_a_bottle_does_not_count(self):
        bottle = surface_of_revolution(
            (0, 0), (0.04, 0), (0.04, 0.2), (0.01, 0.25), (0.009, 0.25), (0.038, 0.2), (0.038, 0.002), (0, 0.002)
        )
        assert describe(bottle).openness < 0.1

    def test_tilting_lowers_the_openness(self):
        openness = [describe(moved(CUP, rotation(0, degrees))).openness for degrees in (0, 20, 40, 90)]
        assert openness[0] > openness[1] > openness[2] > openness[3] == 0

    def test_rotation_about_z_keeps_the_capacity(self):
        shape = describe(moved(tub(0.4, 0.3, 0.2, 0.01), rotation(2, 30), (7, 8, 9)))
        assert shape.capacity_m3 == pytest.approx(describe(tub(0.4, 0.3, 0.2, 0.01)).capacity_m3, rel=0.01)

    def test_fine_mesh_of_a_bowl(self):
        profile = [(math.sin(a), 1 - math.cos(a)) for a in np.linspace(0, math.pi / 2, 200)]
        assert describe(surface_of_revolution(*profile)).capacity_m3 == pytest.approx(2 / 3 * math.pi, rel=0.03)


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
    def test_returns_none_without_usable_triangles(self, points, triangles):
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

    def test_ignores_triangles_with_nan(self):
        points, triangles = box(1, 1, 1)
        broken = np.concatenate([points, [[math.nan, 0, 0]]]), np.concatenate([triangles, [[0, 1, 8]]])
        assert describe(broken) == describe((points, triangles))

    def test_ignores_points_without_triangle(self):
        points, triangles = box(1, 1, 1)
        assert describe((np.concatenate([points, [[9, 9, 9]]]), triangles)).hull_volume_m3 == pytest.approx(1)

    def test_three_sheets_on_one_edge_have_no_volume(self):
        ends = [[1, 0, 0], [-1, 0.5, 0], [0, -1, 0]]
        assert (
            describe((np.array([[0.0, 0, 0], [0, 0, 1], *ends]), np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]]))).volume_m3
            is None
        )

    @settings(max_examples=25, deadline=None)
    @given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.integers(0, 3))
    def test_any_triangle_soup_has_plausible_values(self, seed, count, digits):
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


def test_missing_scipy_names_the_install_command(monkeypatch):
    monkeypatch.setitem(sys.modules, "scipy.spatial", None)
    with pytest.raises(SceneError, match=r"need scipy.*pip install 'usd2kg\[shapes\]'"):
        describe_triangles(*box(1, 1, 1))
