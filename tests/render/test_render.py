"""Pictures: silhouettes of known area, occlusion, colour, determinism, errors."""

import io
import math
import struct
import time
import zlib

import numpy as np
import pytest
import typer
from pxr import Usd
from typer.testing import CliRunner

from tests.scene.usda import METRES, component, cube, header, move, ops, prim, xform
from usd2kg.cli.render import render_command
from usd2kg.demo import demo_scene
from usd2kg.errors import OutputError, SceneError
from usd2kg.render import ColoredBox, Renderer, draw_boxes, render_object, render_objects, render_scene
from usd2kg.render.camera import aim
from usd2kg.render.cutaway import open_room, without_ground, without_strays
from usd2kg.render.png import encode_png
from usd2kg.render.raster import rasterise
from usd2kg.render.settings import LIGHTING
from usd2kg.render.shade import draw, to_srgb
from usd2kg.render.triangle_soup import corner_normals, gather
from usd2kg.scene.meshes import ObjectMesh

CORNERS = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)], np.float32)
QUADS = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]], np.int32)
TRIANGLES = np.concatenate([QUADS[:, :3], QUADS[:, [0, 2, 3]]])
RED = "color3f[] primvars:displayColor = [(0.8, 0.02, 0.02)]"
FACING = 0.0
"""Azimuth of a viewer who looks along the x axis, from its far end."""


def box(at=(0, 0, 0), size=(1, 1, 1), color=(0.5, 0.5, 0.5), opacity=1.0, path="/Box"):
    points = (CORNERS * np.array(size) + np.array(at)).astype(np.float32)
    return ObjectMesh(path, points, TRIANGLES, color, opacity)


def decoded(png):
    """Return the pixels of a PNG that `encode_png` wrote."""
    width, height = struct.unpack(">II", png[16:24])
    start = png.index(b"IDAT") + 4
    (length,) = struct.unpack(">I", png[start - 8 : start - 4])
    rows = np.frombuffer(zlib.decompress(png[start : start + length]), np.uint8).reshape(height, 1 + 3 * width)
    return np.cumsum(rows[:, 1:].reshape(height, width, 3), axis=0, dtype=np.uint8)


def is_reddish(pixels):
    red, green, blue = (pixels[..., i].astype(int) for i in range(3))
    return (red > green + 40) & (red > blue + 40)


def corner_color(pixels):
    return tuple(pixels[0, 0].tolist())


# PNG


def test_png_is_read_by_pillow():
    image = pytest.importorskip("PIL.Image")
    pixels = np.random.default_rng(0).integers(0, 256, (7, 5, 3), dtype=np.uint8)
    with image.open(io.BytesIO(encode_png(pixels))) as opened:
        assert (opened.format, opened.mode, opened.size) == ("PNG", "RGB", (5, 7))
        assert np.array_equal(np.asarray(opened), pixels)
    assert np.array_equal(decoded(encode_png(pixels)), pixels)


def test_linear_light_becomes_srgb():
    assert to_srgb(np.array([0.0, 0.2140, 9.0, -1.0])).tolist() == [0, 127, 254, 0]


# camera


def test_a_camera_frames_its_points():
    points = box(size=(3, 1, 2)).points
    for azimuth, elevation in ((0, 0), (55, 24), (200, -18), (10, 90)):
        camera = aim(points, azimuth, elevation, (200, 100), margin=0.1)
        seen = camera.to_pixels(camera.to_view(points))[:, :2]
        low, high = seen.min(axis=0), seen.max(axis=0)
        assert (low >= [9.9, 9.9]).all() and (high <= [190.1, 90.1]).all()
        # The points fill one axis, and opposite borders are equal.
        assert low[1] == pytest.approx(10, abs=0.5) or low[0] == pytest.approx(10, abs=0.5)
        assert (low + high).tolist() == pytest.approx([200, 100], abs=1)


def test_the_camera_is_upright_and_at_the_azimuth():
    camera = aim(CORNERS, FACING, 0, (100, 100))
    assert camera.eye == pytest.approx([camera.eye[0], 0, 0], abs=1e-9)
    assert camera.eye[0] > 1
    # Seen from +x, +y is to the right.
    (x, y, _), (x0, y0, _) = camera.to_pixels(camera.to_view(np.array([[0, 0.3, 0.2], [0, 0, 0.0]])))
    assert (x > x0, y < y0) == (True, True)


# rasteriser


def test_area_of_a_square():
    camera = aim(CORNERS, FACING, 0, (200, 200))
    hits = rasterise(camera, CORNERS, TRIANGLES)
    near = CORNERS[CORNERS[:, 0] > 0]
    seen = camera.to_pixels(camera.to_view(near))
    side = np.ptp(seen[:, 0])
    assert (hits.triangle >= 0).sum() == pytest.approx(side**2, rel=0.01)
    assert hits.nearness.max() == pytest.approx(1 / (camera.eye[0] - 0.5), rel=1e-6)


def test_area_of_a_cube_seen_along_its_diagonal():
    # Along its diagonal, a cube projects to a regular hexagon of area sqrt(3) · side².
    camera = aim(CORNERS * 1e-3, 45, math.degrees(math.asin(1 / math.sqrt(3))), (256, 256))
    # From far away, perspective is negligible.
    far = aim(CORNERS * 60, 45, math.degrees(math.asin(1 / math.sqrt(3))), (1024, 1024))
    hits = rasterise(far, CORNERS, TRIANGLES)
    distance = np.linalg.norm(far.eye)
    scale = far.focal / distance
    assert (hits.triangle >= 0).sum() == pytest.approx(math.sqrt(3) * scale**2, rel=0.05)
    assert (rasterise(camera, CORNERS * 1e-3, TRIANGLES).triangle >= 0).any()


def test_pixels_on_a_shared_edge_belong_to_one_triangle():
    # A triangle fan covers each pixel once, without gaps.
    ring = np.stack([np.zeros(16), np.cos(np.arange(16) * math.pi / 8), np.sin(np.arange(16) * math.pi / 8)], axis=1)
    points = np.concatenate([[[0, 0, 0]], ring]).astype(np.float32)
    fan = np.array([[0, 1 + i, 1 + (i + 1) % 16] for i in range(16)])
    camera = aim(points, FACING, 0, (101, 101))
    whole = rasterise(camera, points, fan).triangle >= 0
    parts = sum((rasterise(camera, points, fan[i : i + 1]).triangle >= 0).astype(int) for i in range(16))
    assert parts.max() == 1
    assert np.array_equal(parts == 1, whole)


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_the_nearer_box_is_visible(order):
    boxes = [box(at=(2, 0, 0), path="/Near"), box(at=(-2, 1, 0), path="/Far")]
    soup = gather([boxes[i] for i in order])
    camera = aim(soup.points, FACING, 0, (120, 120))
    mesh = draw(camera, soup).mesh
    column, row, _ = camera.to_pixels(camera.to_view(np.array([[2.5, 0.2, 0.0]])))[0].astype(int)
    assert order[mesh[row, column]] == 0
    column, row, _ = camera.to_pixels(camera.to_view(np.array([[-1.5, 1.4, 0.0]])))[0].astype(int)
    assert order[mesh[row, column]] == 1


def test_geometry_behind_the_camera_is_clipped():
    # A floor that extends far in front of and behind the camera.
    points = np.array([[-50, -50, -1], [50, -50, -1], [50, 50, -1], [-50, 50, -1]], np.float32)
    camera = aim(CORNERS, FACING, 10, (100, 100))
    hits = rasterise(camera, points, np.array([[0, 1, 2], [0, 2, 3]]))
    assert (hits.triangle[-1] >= 0).all()
    assert hits.nearness[-1, 50] > hits.nearness[60, 50] > 0
    below = (
        1 / hits.nearness[-1, 50] * (math.cos(math.radians(10)) * (49.5 / camera.focal) + math.sin(math.radians(10)))
    )
    assert below == pytest.approx(camera.eye[2] + 1, rel=1e-3)


def test_an_empty_mesh():
    camera = aim(CORNERS, FACING, 0, (10, 10))
    hits = rasterise(camera, CORNERS, np.zeros((0, 3), np.int64))
    assert (hits.triangle == -1).all() and (hits.nearness == 0).all()


# shading


def test_round_surfaces_have_smooth_normals_and_boxes_do_not():
    flat = corner_normals(CORNERS, TRIANGLES.astype(np.int64), np.arange(12))
    assert np.abs(flat).max(axis=2) == pytest.approx(1)
    angles = np.arange(24) * (math.pi / 12)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([np.column_stack([ring, np.full(24, z)]) for z in (0, 1)]).astype(np.float32)
    tube = np.array([[i, (i + 1) % 24, 24 + (i + 1) % 24] for i in range(24)], np.int64)
    normals = corner_normals(points, np.concatenate([tube, [[0, 25 % 24, 24]]]), np.arange(24))
    assert np.einsum("ijk,ijk->ij", normals[..., :2], points[tube][..., :2]) == pytest.approx(1, abs=0.02)


def test_a_top_is_brighter_than_a_side():
    soup = gather([box()])
    camera = aim(soup.points, -60, 30, (100, 100))
    light = draw(camera, soup).light[..., 0]
    places = camera.to_pixels(camera.to_view(np.array([[0, 0, 0.5], [0, -0.5, 0]]))).astype(int)
    (top_x, top_y, _), (side_x, side_y, _) = places
    assert light[top_y, top_x] > 1.1 * light[side_y, side_x]


def test_transparent_meshes_are_blended_over_solid_ones():
    pane = box(at=(2, 0, 0), size=(0.01, 2, 2), opacity=0.2, color=(0, 0, 1))
    light = {}
    for name, meshes in {"bare": [box(color=(1, 0, 0))], "glazed": [box(color=(1, 0, 0)), pane]}.items():
        soup = gather(meshes)
        drawn = draw(aim(gather([box(), pane]).points, FACING, 0, (60, 60)), soup)
        light[name] = drawn.light[30, 30]
    assert light["glazed"][0] == pytest.approx((1 - LIGHTING.transparent_alpha) * light["bare"][0], abs=0.03)
    assert light["glazed"][2] > light["bare"][2]


# cutaway


def table(at=(0, 0), size=(1.2, 0.8, 0.75)):
    (x, y), (width, depth, height) = at, size
    legs = [(x + sx * width * 0.45, y + sy * depth * 0.45, height / 2) for sx in (-1, 1) for sy in (-1, 1)]
    return [box((x, y, height - 0.02), (width, depth, 0.04)), *(box(leg, (0.05, 0.05, height - 0.04)) for leg in legs)]


LAMP = [box((1.4, 1.2, 0.9), (0.04, 0.04, 1.8)), box((1.4, 1.2, 1.85), (0.4, 0.4, 0.3))]
SHELF = [
    *(box((x, 1.3, 1), (0.03, 0.3, 2)) for x in (-1.2, -0.4)),
    *(box((-0.8, 1.3, z), (0.8, 0.3, 0.03)) for z in (0.1, 0.6, 1.1, 1.6, 1.985)),
]
SOFA = [box((0, -0.8, 0.25), (1.8, 0.8, 0.4)), box((0, -1.15, 0.6), (1.8, 0.15, 0.5))]


@pytest.mark.parametrize(
    "meshes",
    [table(), SHELF, [*LAMP, *SHELF, *SOFA, *table()], [box((0, 0, 0), (3.4, 3.2, 0.01)), *LAMP, *SHELF, *SOFA]],
    ids=["a table", "a shelf", "furniture", "furniture on a rug"],
)
@pytest.mark.parametrize("azimuth", [-125, -35, 55, 145])
def test_without_walls_nothing_is_cut(meshes, azimuth):
    soup = gather(meshes)
    assert len(open_room(soup, azimuth).triangles) == len(soup.triangles)


def test_furniture_in_a_room_is_seen_over_the_near_walls():
    walls = [box((x, 0, 1.25), (0.1, 3.2, 2.5)) for x in (-1.75, 1.75)]
    walls += [box((0, y, 1.25), (3.4, 0.1, 2.5)) for y in (-1.55, 1.55)]
    soup = gather([*walls, *LAMP, *SOFA, *table(), box((0, 0, 2.55), (3.4, 3.2, 0.1))])
    kept = set(open_room(soup, -35).mesh.tolist())
    # The walls at +x and -y and the ceiling are gone.
    assert set(range(soup.mesh[-1] + 1)) - kept == {1, 2, int(soup.mesh[-1])}


def test_near_walls_and_ceiling_are_removed():
    room = [
        box(at=(0, 0, -0.05), size=(4, 4, 0.1)),
        box(at=(0, 0, 2.55), size=(4, 4, 0.1)),
        box(at=(2, 0, 1.25), size=(0.1, 4, 2.5)),
        box(at=(-2, 0, 1.25), size=(0.1, 4, 2.5)),
        box(at=(0, 2, 1.25), size=(4, 0.1, 2.5)),
        box(at=(0, -2, 1.25), size=(4, 0.1, 2.5)),
        box(at=(0, 0, 0.4), size=(1, 1, 0.8)),
        box(at=(1.9, 0, 1.5), size=(0.05, 0.5, 0.5)),
    ]
    # From (+x, -y): floor, the walls at -x and +y, and the table remain; the picture hangs on the near wall.
    assert np.unique(open_room(gather(room), -45).mesh).tolist() == [0, 3, 4, 6]
    assert np.unique(open_room(gather(room), -45, kept_meshes=2).mesh).tolist() == [0, 1, 3, 4, 6]


def test_a_single_object_is_not_cut_open():
    soup = gather([box()])
    assert len(open_room(soup, -45).triangles) > 0


def test_outliers_sky_domes_and_ground_planes_are_removed():
    near = [box(at=(i, 0, 0)) for i in range(8)]
    soup = gather([*near, box(at=(343_000, 0, 0)), box(size=(5000, 5000, 5000))])
    assert np.unique(without_strays(soup).mesh).tolist() == list(range(8))
    ground = box(size=(40, 40, 0.01))
    assert np.unique(without_ground(gather([*near, ground])).mesh).tolist() == list(range(8))
    assert len(without_ground(gather([ground])).triangles) == 12


# whole pictures


@pytest.fixture
def kitchenette(write_stage):
    scene = component(
        "Table", cube("Top", ops(("double3", "translate", (0, 0, 0.7)), ("double3", "scale", (1, 1, 0.05))))
    )
    mug = component("Mug", cube("Body", RED, size=0.1, at=(0.1, 0.1, 0.78)))
    return write_stage(METRES + scene + mug + xform("Nothing", xform("Inside")) + xform("Frame"))


def test_an_object_is_centred_in_its_own_colour(kitchenette):
    pixels = decoded(render_object(kitchenette, "/Mug", size=(64, 64)))
    assert pixels.shape == (64, 64, 3)
    red = is_reddish(pixels)
    assert red[32, 32]
    assert not red[0].any() and not red[:, 0].any() and not red[-1].any() and not red[:, -1].any()
    assert 0.25 < red.mean() < 0.8


def test_picture_size(kitchenette):
    assert decoded(render_object(kitchenette, "/Mug", size=(31, 17))).shape == (17, 31, 3)
    assert decoded(render_object(kitchenette, "/Mug", size=(1, 1))).shape == (1, 1, 3)
    with pytest.raises(SceneError, match="0x10 pixels"):
        render_object(kitchenette, "/Mug", size=(0, 10))


def test_an_object_in_context_is_highlighted(kitchenette):
    alone = decoded(render_object(kitchenette, "/Mug", size=(64, 64)))
    pixels = decoded(render_object(kitchenette, "/Mug", size=(64, 64), in_context=True))
    warm = is_reddish(pixels)
    assert 0.02 < warm.mean() < is_reddish(alone).mean()
    rows, columns = np.nonzero(warm)
    assert rows.mean() == pytest.approx(32, abs=6) and columns.mean() == pytest.approx(32, abs=6)
    # The table next to it is grey and differs from the background.
    spread = np.ptp(pixels[~warm].astype(int), axis=1)
    assert np.median(spread) < 30
    assert (pixels[-1] != pixels[0, 0]).any()


def test_a_hidden_object_is_blended_in(write_stage):
    walls = cube("Safe", size=1)
    path = write_stage(METRES + walls + cube("Gold", RED, size=0.7))
    pixels = decoded(render_object(path, "/Gold", size=(64, 64), in_context=True))
    assert is_reddish(pixels).mean() > 0.05


def test_y_up_centimetres_and_z_up_metres_give_the_same_picture(write_stage):
    def scene(layer, scale, at, name):
        parts = [
            cube("Body", RED, ops(("double3", "translate", at((0, 0, 0.5))), ("double3", "scale", (scale,) * 3))),
            cube(
                "Knob",
                ops(("double3", "translate", at((0.2, -1.05, 0.9))), ("double3", "scale", (0.1 * scale,) * 3)),
            ),
        ]
        return write_stage(layer + component("Thing", *parts), name)

    z_up = scene(METRES, 1, lambda p: p, "z.usda")
    centimetres = header(metersPerUnit=0.01, upAxis="Y")
    y_up = scene(centimetres, 100, lambda p: (100 * p[0], 100 * p[2], -100 * p[1]), "y.usda")
    for in_context in (False, True):
        one, other = (decoded(render_object(s, "/Thing", in_context=in_context)).astype(int) for s in (z_up, y_up))
        assert (np.abs(one - other).max(axis=2) > 8).mean() < 0.002


def test_an_instance_looks_like_its_prototype(write_stage):
    asset = prim("Xform", "Asset", cube("Body", RED), cube("Foot", size=0.5, at=(0, 0, -1.25)), specifier="class")
    copy = xform("Copy", move(3, 0, 0), meta=["instanceable = true", "references = </Asset>"])
    plain = xform("Plain", cube("Body", RED), cube("Foot", size=0.5, at=(0, 0, -1.25)))
    path = write_stage(METRES + asset + copy + plain)
    one, other = (decoded(render_object(path, p, size=(96, 96))).astype(int) for p in ("/Copy", "/Plain"))
    assert (np.abs(one - other).max(axis=2) > 8).mean() < 0.002
    # A prim inside an instance can be drawn too.
    assert is_reddish(decoded(render_object(path, "/Copy/Body", size=(32, 32)))).any()


def test_pictures_are_deterministic(kitchenette):
    for options in ({"prim_path": "/Mug"}, {"prim_path": "/Mug", "in_context": True}):
        assert render_object(kitchenette, **options) == render_object(kitchenette, **options)
    assert render_scene(kitchenette, size=(80, 60)) == render_scene(kitchenette, size=(80, 60))
    # An open renderer draws the same as a fresh one.
    renderer = Renderer(kitchenette)
    renderer.render_scene(size=(20, 20))
    assert renderer.render_object("/Mug") == render_object(kitchenette, "/Mug")


def test_the_view_shows_the_side_with_more_detail(write_stage):
    # Twelve knobs on the back (+y) of a plain cabinet: the camera is on that side.
    knobs = [cube(f"K{i}", RED, size=0.12, at=(-0.4 + 0.25 * (i % 4), 0.5, -0.3 + 0.25 * (i // 4))) for i in range(12)]
    path = write_stage(METRES + component("Cabinet", cube("Box", size=1), *knobs))
    assert is_reddish(decoded(render_object(path, "/Cabinet", size=(64, 64)))).sum() > 60


def test_objects_of_one_stage(kitchenette):
    found = dict(render_objects(kitchenette, ["/Mug", "/Nothing", "/Table"], size=(32, 32)))
    assert list(found) == ["/Mug", "/Nothing", "/Table"]
    assert found["/Nothing"] is None
    assert found["/Mug"] == render_object(kitchenette, "/Mug", size=(32, 32))


def test_degenerate_meshes(write_stage):
    sheet = "int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [0, 1, 2, 3]\npoint3f[] points = "
    path = write_stage(
        METRES
        + prim("Mesh", "Sheet", sheet + "[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]")
        + prim("Mesh", "Edge", sheet + "[(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)]")
        + prim("Mesh", "Dot", sheet + "[(1, 1, 1), (1, 1, 1), (1, 1, 1), (1, 1, 1)]")
    )
    pixels = decoded(render_object(path, "/Sheet", size=(64, 64)))
    assert (np.abs(pixels.astype(int) - pixels[0, 0]).max(axis=2) > 20).mean() > 0.1
    for name in ("/Edge", "/Dot"):
        for in_context in (False, True):
            assert decoded(render_object(path, name, size=(16, 16), in_context=in_context)).shape == (16, 16, 3)


# errors


def test_an_object_without_geometry(kitchenette):
    with pytest.raises(SceneError, match=r"/Nothing has no visible geometry"):
        render_object(kitchenette, "/Nothing")


def test_an_empty_scene(write_stage):
    with pytest.raises(SceneError, match="the stage has no visible geometry"):
        render_scene(write_stage(METRES + xform("Nothing")))


@pytest.mark.parametrize("path", ["/mug", "Mug", "/Kitchen/Mug", "mugg"])
def test_an_unknown_path_gets_a_suggestion(kitchenette, path):
    with pytest.raises(SceneError, match=r"there is no prim .*did you mean /Mug\b"):
        render_object(kitchenette, path)


def test_broken_meshes_are_reported(write_stage):
    bad = prim("Mesh", "Bad", "point3f[] points = [(0, 0, 0)]", "int[] faceVertexCounts = [3]")
    renderer = Renderer(write_stage(METRES + xform("Thing", bad, cube("Good"))))
    assert renderer.render_object("/Thing")
    assert [note.prim_path for note in renderer.diagnostics] == ["/Thing/Bad"]


def test_a_live_stage():
    stage = Usd.Stage.CreateInMemory()
    stage.DefinePrim("/Box", "Cube")
    assert render_object(stage, "/Box", size=(16, 16)).startswith(b"\x89PNG")


# the command


def invoke(*arguments):

    app = typer.Typer()
    app.command()(render_command)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_the_command_writes_pictures(kitchenette, tmp_path):
    target = tmp_path / "mug.png"
    result = invoke(kitchenette, "/Mug", "-o", target, "--size", "40x30")
    assert (result.exit_code, result.stdout) == (0, "")
    assert f"written to {target}" in result.stderr
    assert target.read_bytes() == render_object(kitchenette, "/Mug", size=(40, 30))
    assert invoke(kitchenette, "/Mug", "-o", target, "--context", "--size", "40x30").exit_code == 0
    assert target.read_bytes() == render_object(kitchenette, "/Mug", size=(40, 30), in_context=True)
    assert invoke(kitchenette, "-o", target, "--size", "40x30").exit_code == 0
    assert target.read_bytes() == render_scene(kitchenette, size=(40, 30))


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (["/Mug", "-o", "x.png", "--size", "big"], OutputError, "WIDTHxHEIGHT"),
        (["/Mug", "-o", "x.jpg"], OutputError, "ending in .png"),
        (["-o", "x.png", "--context"], OutputError, "PATH of an object"),
        (["/Mug", "-o", "nowhere/x.png"], OutputError, "does not exist"),
        (["/Nothing", "-o", "x.png"], SceneError, "no visible geometry"),
        (["/Cup", "-o", "x.png"], SceneError, "no prim /Cup"),
        (["/Mug", "-o", "x.png", "--size", "9000x9000"], SceneError, "cannot draw"),
    ],
)
def test_the_command_reports_errors(kitchenette, tmp_path, monkeypatch, arguments, error, message):
    monkeypatch.chdir(tmp_path)
    result = invoke(kitchenette, *arguments)
    assert isinstance(result.exception, error)
    assert message in str(result.exception)
    assert "\n" not in str(result.exception)
    assert not (tmp_path / "x.png").exists()


# the demo


def test_pictures_of_the_demo_kitchen():
    renderer = Renderer(demo_scene())
    start = time.perf_counter()
    overview = decoded(renderer.render_scene(size=(400, 300)))
    assert time.perf_counter() - start < 30
    # The room fills the picture; the corners are background.
    assert corner_color(overview) == (212, 216, 221)
    assert (np.abs(overview.astype(int) - overview[0, 0]).max(axis=2) > 10).mean() > 0.4
    toaster = decoded(renderer.render_object("/KitchenDining/counterRun/worktopRight/toaster"))
    assert is_reddish(toaster).mean() > 0.15
    fork = renderer.render_object("/KitchenDining/counterRun/cakeFork_1", in_context=True)
    assert is_reddish(decoded(fork)).sum() > 50


# boxes


def colored(at, size=(1, 1, 1), color=(0.6, 0.02, 0.02)):
    return ColoredBox(np.array(at) - np.array(size) / 2, np.array(at) + np.array(size) / 2, color)


def test_boxes_are_drawn_in_their_colours():
    picture = decoded(draw_boxes([colored((0, 0, 0)), colored((3, 0, 0), color=(0.02, 0.02, 0.6))], (60, 40)))
    assert picture.shape == (40, 60, 3)
    bluish = picture[..., 2].astype(int) > picture[..., 0] + 40
    assert is_reddish(picture).sum() > 50
    assert bluish.sum() > 50


def test_a_box_around_most_others_is_left_out():
    inside = [colored((x, 0, 0)) for x in (-2, 0, 2)]
    room = colored((0, 0, 0), (8, 4, 3), (0.02, 0.02, 0.6))
    assert draw_boxes([*inside, room], (60, 40)) == draw_boxes(inside, (60, 40))
    # A bowl with one of three objects in it is drawn.
    bowl = colored((2, 0, 0), (1.2, 1.2, 1.2))
    assert draw_boxes([*inside, bowl], (60, 40)) != draw_boxes(inside, (60, 40))


def test_no_boxes_have_no_picture():
    assert draw_boxes([], (60, 40)) is None
