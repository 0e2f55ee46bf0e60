"""Free-standing furniture and textiles; centimetres, standing on y = 0, front towards +z."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, Vec3, copies, merge, moved
from scenes.writer.shapes import box, cylinder, ellipsoid, lathe, sheet, sweep, tube


def _leg(foot: Vec3, head: Vec3, thin: float, thick: float) -> Mesh:
    """Return a square leg, `thin` at the foot and `thick` at the head (half widths)."""
    square = [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
    return sweep([foot, head], square, widths=[thin, thick], up=(0, 0, 1))


@asset()
def dining_table(a: Asset) -> None:
    a.looks = "mtl"
    a.add("top_geo", box((-90, 71.5, -45), (90, 75, 45), 0.6), "oak_light")
    apron = [box((-80, 62, z), (80, 71.5, z + 2)) for z in (-38.0, 36.0)]
    apron += [box((x, 62, -36), (x + 2, 71.5, 36)) for x in (-82.0, 80.0)]
    a.add("apron", merge(*apron), "oak_light")
    legs = [_leg((x * 1.02, 0, z * 1.02), (x, 71.5, z), 2.2, 3.4) for x in (-83, 83) for z in (-38, 38)]
    a.add("legs_geo", merge(*legs), "oak_light")
    a.add_proxy("top_COL", box((-90, 71.5, -45), (90, 75, 45)))
    a.surfaces["top"] = 75.0


@asset()
def dining_chair(a: Asset) -> None:
    a.add("seat_geo", box((-21, 43, -20), (21, 46, 21), 0.8), "oak_dark")
    front = [_leg((x, 0, 19), (x * 0.95, 43, 18), 1.5, 2.0) for x in (-19.0, 19.0)]
    a.add("legs/front_legs", merge(*front), "oak_dark")
    posts = []
    for x in (-19.0, 19.0):
        square = [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
        line = [(x, 0.0, -21.0), (x, 44.0, -18.0), (x, 66.0, -20.0), (x, 89.0, -25.0)]
        posts.append(sweep(line, square, widths=[1.5, 2.0, 1.8, 1.4], up=(0, 0, 1)))
    a.add("legs/back_posts", merge(*posts), "oak_dark")
    u, v = np.meshgrid(np.linspace(-1, 1, 7), np.linspace(0, 1, 2), indexing="ij")
    curve = np.stack([18 * u, 78 + 9.5 * v, -23.4 - 2 * v - 1.6 * (1 - u**2)], axis=2)
    low = np.stack([18 * u, 60 + 6 * v, -19.8 - 1.2 * v - 1.6 * (1 - u**2)], axis=2)
    a.add("back/rest_geo", merge(sheet(curve, 1.6), sheet(low, 1.6)), "oak_dark")
    rails = [box((-19, 36, 16.5), (19, 41, 18.5)), box((-19, 36, -19), (19, 41, -17))]
    rails += [box((x - 1, 22, -18.5), (x + 1, 24.5, 17.5), 0.3) for x in (-18.6, 18.6)]
    a.add("rails_LOW", merge(*rails), "oak_dark")
    a.surfaces["seat"] = 46.0


@asset()
def seat_cushion(a: Asset) -> None:
    a.add("cushion_geo", box((-19, 0, -15.5), (19, 4.5, 15.5), 2.0), "fabric_rust")
    a.add("button", ellipsoid((0, 4.5, 0), (1.3, 0.4, 1.3), 10), "fabric_navy")


@asset()
def bar_table(a: Asset) -> None:
    a.add("top_geo", box((-60, 100, -25), (60, 104, 25), 0.6), "beech")
    for name, x in (("frame_L", -52.0), ("frame_R", 52.0)):
        corners = [(x, 1.5, -20.0), (x, 1.5, 20.0), (x, 98.2, 20.0), (x, 98.2, -20.0)]
        square = [(1.5, -1.5), (1.5, 1.5), (-1.5, 1.5), (-1.5, -1.5)]
        sides = [sweep([corners[k], corners[(k + 1) % 4]], square, up=(1, 0, 0)) for k in range(4)]
        a.add(name, merge(*sides), "cast_iron")
    a.add("footrail", tube([(-52, 24, 14), (52, 24, 14)], 1.4, 8), "cast_iron")
    a.surfaces["top"] = 104.0


@asset()
def bar_stool(a: Asset) -> None:
    seat = [(0.0, 71.0), (15.0, 71.0), (17.0, 72.0), (17.0, 74.0), (15.5, 75.0), (0.0, 74.2)]
    a.add("seat_geo", lathe(seat), "beech")
    legs = []
    ring: list[Vec3] = []
    for k in range(4):
        angle = np.pi / 4 + k * np.pi / 2
        cos, sin = float(np.cos(angle)), float(np.sin(angle))
        legs.append(tube([(20 * cos, 0.6, 20 * sin), (11 * cos, 71.2, 11 * sin)], 1.2, 8))
    for k in range(18):
        angle = 2 * np.pi * k / 18
        ring.append((17.2 * float(np.cos(angle)), 24.0, 17.2 * float(np.sin(angle))))
    a.add("legs_geo", merge(*legs), "cast_iron")
    a.add("foot_ring", tube(ring, 0.8, 8, closed=True), "cast_iron")


@asset()
def area_rug(a: Asset) -> None:
    a.add("border_geo", box((-135, 0, -100), (135, 1.0, 100), 0.3), "wool_border")
    a.add("field_geo", box((-121, 1.0, -86), (121, 1.1, 86)), "wool_rug")
    bands = [box((-113, 1.1, z), (113, 1.15, z + 3)) for z in (-76.0, 73.0)]
    a.add("stripe_LOW", merge(*bands), "fabric_rust")
    a.surfaces["top"] = 1.15


@asset()
def lounge_chair(a: Asset) -> None:
    a.looks = "mtl"
    a.add("base_geo", box((-36, 14, -34), (36, 30, 36), 2.0), "fabric_navy")
    a.add("seat_cushion_geo", box((-24, 30.1, -22), (24, 44, 37), 3.0), "fabric_navy")
    a.add("back_geo", moved(box((-36, 0, -10), (36, 58, 6), 4.0), by=(0, 29, -28), turn=(-10, 0, 0)), "fabric_navy")
    arms = [box((-38, 30, -34), (-24.4, 58, 34), 3.5), box((24.4, 30, -34), (38, 58, 34), 3.5)]
    a.add("arms_geo", merge(*arms), "fabric_navy")
    feet = [(x, 0, z) for x in (-30, 30) for z in (-28, 30)]
    a.add("feet", copies(lathe([(0, 0), (1.4, 0), (2.2, 14.2), (0, 14.2)], 10), feet), "oak_dark")
    a.surfaces["seat"] = 44.0


@asset()
def throw_pillow(a: Asset) -> None:
    pad = box((-19, -19, -6), (19, 19, 6), 5.5)
    piping = [(-18.0, -18.0, 0.0), (18.0, -18.0, 0.0), (18.0, 18.0, 0.0), (-18.0, 18.0, 0.0)]
    a.add("pillow_geo", merge(pad, tube(piping, 1.2, closed=True)), "fabric_rust")


@asset()
def step_ladder(a: Asset) -> None:
    rails = [tube([(x, 0.8, 18), (x * 0.8, 84, -2)], 1.2) for x in (-22.0, 22.0)]
    rails += [tube([(x, 0.8, -22), (x * 0.85, 80, -5)], 1.0) for x in (-22.0, 22.0)]
    a.add("rails_geo", merge(*rails), "brushed_steel")
    steps = [box((-20, y, 13.0 - 0.2 * (y - 24)), (20, y + 2.4, 23 - 0.24 * (y - 24)), 0.4) for y in (24.0, 50.0)]
    a.add("treads", merge(*steps), "plastic_grey")
    a.add("platform", box((-18, 80, -13), (18, 82.5, 8), 0.4), "plastic_grey")
    a.add("handrail", tube([(-17.6, 83, -3), (-17.6, 110, -8), (17.6, 110, -8), (17.6, 83, -3)], 1.1), "brushed_steel")


@asset()
def pedal_bin(a: Asset) -> None:
    outer = [(0.0, 0.0), (13.5, 0.0), (14.2, 0.8), (14.2, 2.6), (13.8, 2.8), (13.8, 38.0)]
    inner = [(13.4, 38.0), (13.4, 1.2), (0.0, 1.2)]
    a.add("body_geo", lathe([*outer, *inner]), "brushed_steel")
    a.add(
        "lid/dome_geo",
        lathe([(0, 38.1), (14.2, 38.1), (14.0, 40), (10.5, 43.6), (5, 45.4), (0, 45.8)]),
        "plastic_black",
    )
    a.add("pedal", merge(box((-3, 1, 12), (3, 2.2, 18.5), 0.3)), "plastic_black")
    a.subcomponents.append("lid")


@asset()
def candle_stick(a: Asset) -> None:
    stem = [(0.0, 0.0), (4.6, 0.0), (4.6, 0.6), (1.4, 1.6), (1.0, 6), (1.6, 8), (1.0, 9.6), (2.2, 11), (0, 11)]
    a.add("stick_geo", lathe(stem), "brass")
    a.add("candle", cylinder((0, 11, 0), 1.1, 16, 0.2, 14), "cream")
    a.add("wick", cylinder((0, 27, 0), 0.15, 0.9, 0, 6), "plastic_black")
