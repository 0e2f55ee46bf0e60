"""Support levels within meshes, such as the boards of a shelf or a worktop below its upstand."""

import numpy as np
import pytest

from tests.scene.usda import component, cube, move, prim, xform
from usd2kg.scene import Box, Diagnostic
from usd2kg.scene.levels import find_levels, holds_others


def board(lower, upper) -> tuple[list[tuple[float, float, float]], list[tuple[int, int, int]]]:
    """Return points and outward triangles of an upright block."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    points = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [triangle for a, b, c, d in quads for triangle in ((a, b, c), (a, c, d))]


def joined(*blocks):
    points, triangles = [], []
    for own_points, own_triangles in blocks:
        triangles += [tuple(len(points) + corner for corner in triangle) for triangle in own_triangles]
        points += own_points
    return np.array(points, float), np.array(triangles)


SHELF = joined(*(board((0, 0, z - 0.02), (1, 0.3, z)) for z in (0.1, 0.6, 1.2)), board((0, 0.28, 0), (1, 0.3, 1.2)))
"""Three boards with tops at 0.1 m, 0.6 m and 1.2 m in front of a back panel of 1.2 m."""


def heights(points, triangles, footprint=0.3) -> list[float]:
    return [round(level.lower[2], 6) for level in find_levels(points, triangles, footprint)]


class TestFindLevels:
    def test_the_tops_of_three_boards(self):
        found = find_levels(*SHELF, footprint=0.3)
        assert [level.lower[2] for level in found] == pytest.approx([0.1, 0.6, 1.2])
        assert found[0] == Box((0, 0, pytest.approx(0.1)), (1, 0.3, pytest.approx(0.1)))

    def test_faces_that_all_look_inwards_are_read_the_other_way_round(self):
        points, triangles = SHELF
        assert heights(points, triangles[:, ::-1]) == [0.1, 0.6, 1.2]

    def test_a_rim_is_not_a_level_but_its_floor_is(self):
        # A tray 1 m × 1 m: four walls 0.02 m thick around a floor.
        walls = [
            board((0, 0, 0), (1, 0.02, 0.1)),
            board((0, 0.98, 0), (1, 1, 0.1)),
            board((0, 0, 0), (0.02, 1, 0.1)),
            board((0.98, 0, 0), (1, 1, 0.1)),
        ]
        assert heights(*joined(board((0, 0, 0), (1, 1, 0.01)), *walls), footprint=1.0) == [0.01]

    def test_small_steps_are_not_levels(self):
        assert heights(*joined(board((0, 0, 0), (1, 1, 0.5)), board((0.4, 0.4, 0.5), (0.6, 0.6, 0.7))), 1.0) == [0.5]

    def test_slopes_and_domes_are_not_levels(self):
        lifted = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0.3), (0, 1, 0.3)], float)
        assert heights(lifted, np.array([(0, 1, 2), (0, 2, 3)]), 1.0) == []
        # A cap of a ball, 0.03 m high: level enough everywhere, but never flat.
        angle, radius = np.meshgrid(np.linspace(0, 2 * np.pi, 40), np.linspace(0, 0.5, 40))
        cap = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.03 - 0.12 * radius**2], axis=-1).reshape(
            -1, 3
        )
        i, j = (grid.ravel() for grid in np.meshgrid(np.arange(39) * 40, np.arange(39), indexing="ij"))
        first, second = np.stack([i + j, i + j + 40, i + j + 41]), np.stack([i + j, i + j + 41, i + j + 1])
        triangles = np.concatenate([first, second], axis=1).T
        assert heights(cap, triangles, 1.0) == []

    def test_ignores_triangles_without_area(self):
        points, triangles = SHELF
        assert heights(points, np.concatenate([triangles, [[0, 0, 1], [2, 2, 2]]])) == [0.1, 0.6, 1.2]


class TestHoldsOthers:
    SHELF = Box((0, 0, 0), (1, 0.3, 2))

    def test_what_begins_within_it(self):
        book = Box((0.1, 0.1, 0.6), (0.2, 0.3, 0.9))
        assert holds_others([self.SHELF, book, None]) == [True, False, False]

    @pytest.mark.parametrize(
        "other",
        [
            Box((0.1, 0.1, 2.0), (0.2, 0.3, 2.3)),  # on top of it
            Box((0.1, 0.1, 0.01), (0.2, 0.3, 0.3)),  # at its bottom
            Box((0.95, 0, 0.5), (1.5, 0.3, 0.9)),  # beside it: 9 % of it are over
            Box((3, 3, 0.5), (4, 4, 0.9)),
        ],
    )
    def test_what_does_not(self, other: Box):
        assert holds_others([self.SHELF, other]) == [False, False]

    def test_nothing(self):
        assert holds_others([]) == []


def mesh(name: str, shape, *more: str) -> str:
    points, triangles = shape
    return prim(
        "Mesh",
        name,
        f"point3f[] points = [{', '.join(str(tuple(point)) for point in points.tolist())}]",
        f"int[] faceVertexCounts = [{', '.join(['3'] * len(triangles))}]",
        f"int[] faceVertexIndices = [{', '.join(str(corner) for row in triangles.tolist() for corner in row)}]",
        *more,
    )


class TestReading:
    def levels(self, scene, path="/World/Shelf"):
        return [round(level.lower[2], 4) for level in scene.by_path[path].support_levels]

    def test_levels_of_a_shelf_that_contains_an_object(self, read):
        scene = read(
            xform("World", component("Shelf", mesh("m", SHELF)), component("Box", cube("m", at=(0.5, 0.15, 0.8))))
        )
        assert self.levels(scene) == [0.1, 0.6, 1.2]
        assert scene.by_path["/World/Box"].support_levels == ()

    def test_an_empty_one_is_not_looked_at(self, read):
        scene = read(xform("World", component("Shelf", mesh("m", SHELF)), component("Box", cube("m", at=(5, 5, 0)))))
        assert self.levels(scene) == []

    def test_in_metres_and_z_up(self, read):
        layer = '(\n    metersPerUnit = 0.01\n    upAxis = "Y"\n)\n'
        points, triangles = SHELF
        # The same shelf in centimetres, y up: z becomes y, y becomes -z.
        stage_points = np.stack([points[:, 0], points[:, 2], -points[:, 1]], axis=1) * 100
        thing = prim("Cube", "m", "double size = 10", move(50, 80, -15))
        scene = read(
            xform("World", component("Shelf", mesh("m", (stage_points, triangles))), component("Box", thing)),
            layer=layer,
        )
        assert self.levels(scene) == [0.1, 0.6, 1.2]
        (low, *_) = scene.by_path["/World/Shelf"].support_levels
        assert low.lower == pytest.approx((0, 0, 0.1))
        assert low.upper == pytest.approx((1, 0.3, 0.1))

    def test_levels_of_a_moved_and_mirrored_shelf(self, read):
        mirrored = (
            "double3 xformOp:translate = (2, 3, 1)\nfloat3 xformOp:scale = (-1, 1, 1)\n"
            'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]'
        )
        shelf = component("Shelf", mirrored, mesh("m", SHELF))
        scene = read(xform("World", shelf, component("Box", cube("m", at=(1.5, 3.15, 1.8)))))
        assert self.levels(scene) == [1.1, 1.6, 2.2]
        assert scene.by_path["/World/Shelf"].support_levels[0].lower == pytest.approx((1, 3, 1.1))

    def test_nested_objects_are_left_out(self, read):
        tray = component("Tray", move(0, 0, 0.7), mesh("m", joined(board((0, 0, 0), (1, 0.3, 0.02)))))
        scene = read(xform("World", component("Shelf", mesh("m", SHELF), tray)))
        assert self.levels(scene) == [0.1, 0.6, 1.2]

    def test_of_instances(self, read):
        shelf = prim("Xform", "Proto", mesh("m", SHELF), specifier="class")
        meta = ["inherits = </Proto>", "instanceable = true", 'kind = "component"']
        placed = [prim("Xform", f"Shelf_{x}", move(3 * x, 0, 0), meta=meta) for x in range(2)]
        things = [component(f"Box_{x}", cube("m", at=(3 * x + 0.5, 0.15, 0.8))) for x in range(2)]
        scene = read(shelf, xform("World", *placed, *things))
        for x in range(2):
            assert self.levels(scene, f"/World/Shelf_{x}") == [0.1, 0.6, 1.2]
            assert scene.by_path[f"/World/Shelf_{x}"].support_levels[0].lower[0] == pytest.approx(3 * x)

    def test_a_broken_mesh_has_no_levels_and_no_diagnostic(self, read):
        points, triangles = SHELF
        broken = mesh("m", (points, triangles + 1000), "float3[] extent = [(0, 0, 0), (1, 0.3, 1.2)]")
        scene = read(xform("World", component("Shelf", broken), component("Box", cube("m", at=(0.5, 0.15, 0.8)))))
        assert self.levels(scene) == []
        assert not [note for note in scene.diagnostics if isinstance(note, Diagnostic) and "levels" in note.message]
