"""Desks, chairs, storage and the devices on desks; centimetres, standing on y = 0, front towards +z."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import box, cylinder, ellipsoid, lathe, sheet, tube


@asset("Desk_160x80")
def desk(a: Asset) -> None:
    a.add("top", box((-80, 71.5, -40), (80, 74, 40), 0.4), "laminate_white")
    legs = [box((x, 0, -36), (x + 5, 3, 36), 0.4) for x in (-74.0, 69.0)]
    legs += [box((x, 3, z), (x + 5, 71.5, z + 5), 0.4) for x in (-74.0, 69.0) for z in (-30.0, 25.0)]
    a.add("frame", merge(*legs), "steel_light")
    a.add("modesty_panel", box((-69, 34, -33), (69, 68, -31.5)), "laminate_white")
    a.add("cable_tray", box((-50, 62, -28), (50, 63, -16)), "steel_dark")


@asset("TBL_SS140")
def standing_desk(a: Asset) -> None:
    """Height-adjustable desk, raised: 140 wide, 104 high, 70 deep."""
    a.add("top", box((-70, 101.5, -35), (70, 104, 35), 0.4), "laminate_maple")
    columns = [box((x, 3, -4), (x + 9, 55, 4), 0.3) for x in (-54.0, 45.0)]
    columns += [box((x + 1.5, 55, -2.8), (x + 7.5, 101.5, 2.8), 0.3) for x in (-54.0, 45.0)]
    feet = [box((x, 0, -32), (x + 9, 3, 32), 0.6) for x in (-54.0, 45.0)]
    a.add("legs", merge(*columns, *feet), "steel_dark")
    a.add("controller", box((40, 99.5, 30), (52, 101.5, 36), 0.3), "plastic_black")


def _star_base(radius: float) -> Mesh:
    parts = []
    for k in range(5):
        angle = 2 * np.pi * k / 5
        x, z = radius * float(np.cos(angle)), radius * float(np.sin(angle))
        parts.append(tube([(0, 9, 0), (x, 6.5, z)], 1.8))
        parts.append(ellipsoid((x, 3, z), (3, 3, 3), 8))
    return merge(*parts, cylinder((0, 7, 0), 3.2, 34, segments=10))


@asset("ErgoChair_Pro")
def task_chair(a: Asset) -> None:
    """Swivel chair: 66 wide, 108 high, 66 deep."""
    a.looks = "mtl"
    a.add("base/star_castors", _star_base(30), "plastic_black")
    a.add("seat", box((-25, 42, -24), (25, 50, 25), 3.0), "mesh_fabric")
    u, v = np.meshgrid(np.linspace(-1, 1, 6), np.linspace(0, 1, 5), indexing="ij")
    back = np.stack([23 * u * (1 - 0.1 * v), 56 + 52 * v, -25 + 5 * u**2 - 5 * v**2], axis=2)
    a.add("backrest", sheet(back, 2.5), "mesh_fabric")
    a.add("spine", tube([(0, 44, -20), (0, 50, -29), (0, 84, -30)], 2.2), "plastic_black")
    arms = [box((x, 64, -12), (x + 7, 67, 12), 1.0) for x in (-33.0, 26.0)]
    arms += [box((x, 46, -2), (x + 3, 64, 3)) for x in (-31.0, 28.0)]
    a.add("armrests", merge(*arms), "plastic_black")


@asset("mx27")
def monitor(a: Asset) -> None:
    """Flat screen on a stand: 61 wide, 52 high, 20 deep."""
    a.add("foot", box((-12, 0, -9), (12, 1.2, 11), 0.4), "plastic_black")
    a.add("neck", box((-3, 1.2, -5), (3, 34, -2.5), 0.3), "plastic_black")
    a.add("housing", box((-30.5, 16, -2.5), (30.5, 52, 2.0), 0.4), "plastic_black")
    a.add("panel", box((-29.5, 17.5, 2.0), (29.5, 51, 2.2)), "screen_blue")


@asset("KB_216", looks="")
def keyboard(a: Asset) -> None:
    a.add("case", box((-22, 0, -7), (22, 1.5, 7), 0.4), "plastic_black")
    rows = [box((-21 + 2.05 * k, 1.5, z), (-19.2 + 2.05 * k, 2.4, z + 1.8)) for k in range(16) for z in (-6.0, -1.6)]
    rows += [box((-21 + 4.6 * k, 1.5, z), (-16.7 + 4.6 * k, 2.4, z + 1.8)) for k in range(8) for z in (-3.8, 0.6)]
    rows += [box((-21, 1.5, 3.4), (-12, 2.4, 5.4)), box((-11, 1.5, 3.4), (2, 2.4, 5.4))]
    a.add("keys", merge(*rows), "plastic_grey")


@asset("M185", looks="")
def mouse(a: Asset) -> None:
    """Computer mouse: 6.4 wide, 4 high, 11 deep."""
    shell = ellipsoid((0, 1.2, 0), (3.2, 2.6, 5.6), 12)
    points = shell.points.copy()
    points[:, 1] = np.maximum(points[:, 1], 0.0)
    a.add("shell", shell._replace(points=points), "plastic_black")
    a.add("wheel", moved(cylinder((0, -0.4, 0), 0.9, 0.8), by=(0, 2.9, -2.6), turn=(0, 0, 90)), "plastic_grey")


@asset("NB_14G6")
def laptop(a: Asset) -> None:
    a.add("base", box((-16, 0, -11), (16, 1.6, 11), 0.4), "brushed_steel")
    a.add("keys", box((-14, 1.6, -7), (14, 1.8, 3)), "plastic_black")
    a.add("touchpad", box((-5, 1.6, 4), (5, 1.75, 10)), "steel_dark")
    lid = merge(box((-16, 0, -0.7), (16, 21, 0), 0.2), box((-15.2, 1, 0), (15.2, 20.2, 0.1)))
    a.add("lid", moved(lid, by=(0, 1.6, -11), turn=(-18, 0, 0)), "screen_dark")


@asset("DK3100")
def dock(a: Asset) -> None:
    """Docking station: 20 wide, 3 high, 8 deep."""
    a.add("body", box((-10, 0, -4), (10, 3, 4), 0.5), "steel_dark")
    ports = [box((x, 0.9, 4), (x + 1.4, 1.6, 4.1)) for x in (-8.0, -5.5, -3.0, 2.0, 5.0)]
    a.add("ports", merge(*ports), "plastic_black")
    a.add("cable", tube([(9, 1.4, -4), (12, 0.6, -8), (20, 0.6, -9)], 0.35), "plastic_black")


@asset("DeskLamp_Arc")
def desk_lamp(a: Asset) -> None:
    """Desk lamp with a jointed arm: 18 wide, 47 high, 44 deep."""
    a.add("foot", cylinder((0, 0, 0), 8.5, 2, 0.4), "steel_dark")
    a.add("arm", tube([(0, 2, 0), (0, 30, -10), (0, 46, 14)], 0.8), "steel_light")
    shade = lathe([(0, 6), (2.5, 6), (7.5, 0), (7.1, 0), (2.3, 5.4), (0, 5.4)])
    a.add("shade", moved(shade, by=(0, 40, 16), turn=(-15, 0, 0)), "steel_dark")
    a.add("bulb", ellipsoid((0, 42, 17), (2.2, 2.8, 2.2), 8), "lamp_glow")


@asset("pedestal_3dr")
def pedestal(a: Asset) -> None:
    """Rolling drawer unit: 42 wide, 56 high, 56 deep."""
    a.add("carcass", box((-21, 5, -28), (21, 56, 26.5), 0.3), "laminate_white")
    fronts = [box((-20.6, y, 26.5), (20.6, y + h, 28), 0.2) for y, h in ((5.5, 22.0), (28.0, 13.5), (42.0, 13.5))]
    a.add("fronts", merge(*fronts), "laminate_white")
    a.add("pulls", merge(*(box((-7, y, 28), (7, y + 1, 30), 0.3) for y in (23.0, 37.0, 51.0))), "steel_dark")
    a.add("castors", merge(*(cylinder((x, 0, z), 2.2, 5) for x in (-16, 16) for z in (-22, 22))), "plastic_black")


@asset("CAB_0044", has_kind=False)
def filing_cabinet(a: Asset) -> None:
    """Steel cabinet with four drawers: 46 wide, 132 high, 62 deep."""
    a.add("body", box((-23, 0, -31), (23, 132, 29.5), 0.4), "steel_light")
    a.add(
        "drawer_fronts",
        copies(box((-22, 3, 29.5), (22, 33, 31), 0.4), [(0, 32 * k, 0) for k in range(4)]),
        "steel_light",
    )
    a.add("label_holders", copies(box((-4, 24, 31), (4, 28, 31.4)), [(0, 32 * k, 0) for k in range(4)]), "paper_white")
    a.add("grips", copies(box((-6, 17, 31), (6, 19, 34), 0.4), [(0, 32 * k, 0) for k in range(4)]), "chrome")


@asset("LAT80_c")
def lateral_carcass(a: Asset) -> None:
    """Open carcass for two wide drawers: 80 wide, 72 high, 45 deep, its back at z = 0."""
    sides = [box((x, 0, 0), (x + 2, 72, 43)) for x in (-40.0, 38.0)]
    boards = [box((-38, y, 0.5), (38, y + 2, 43)) for y in (4.0, 37.0, 70.0)]
    a.add("panels", merge(*sides, *boards), "steel_dark")
    a.add("back", box((-38, 4, 0), (38, 72, 0.5)), "steel_dark")


@asset("LAT80_d")
def file_drawer(a: Asset) -> None:
    """Wide file drawer: 76 wide, 30 high, 42 deep; its front plate at z = 0 to 2."""
    a.add("front", box((-37.6, 0, 0), (37.6, 30, 2), 0.3), "steel_light")
    tray = [box((-35, 2, -40), (35, 3, 0)), box((-35, 3, -40), (35, 22, -39))]
    tray += [box((x, 3, -39), (x + 1, 22, 0)) for x in (-35.0, 34.0)]
    a.add("tray", merge(*tray), "steel_dark")
    a.add("pull", tube([(-8, 24, 2), (-8, 24, 5), (8, 24, 5), (8, 24, 2)], 0.6), "chrome")


@asset("Bookcase_5OH")
def bookcase(a: Asset) -> None:
    """Open bookcase, five levels: 80 wide, 190 high, 36 deep, its back at z = 0."""
    sides = [box((x, 0, 0), (x + 2, 190, 36)) for x in (-40.0, 38.0)]
    boards = [box((-38, y, 1), (38, y + 2, 35)) for y in (5.0, 42.0, 79.0, 116.0, 153.0, 188.0)]
    a.add("frame", merge(*sides, *boards), "laminate_maple")
    a.add("back", box((-38, 5, 0), (38, 190, 1)), "laminate_white")
    a.surfaces |= {"level1": 7.0, "level2": 44.0, "level3": 81.0, "level4": 118.0, "level5": 155.0}


@asset("AS_160", looks="")
def divider(a: Asset) -> None:
    """Upholstered screen between desks: 158 wide, 40 high, 3 deep."""
    a.add("panel", box((-79, 0, -1.5), (79, 40, 1.5), 0.8), "fabric_petrol")


@asset("CP_7841")
def desk_phone(a: Asset) -> None:
    """Desk telephone: 18 wide, 9 high, 20 deep."""
    a.add("base", moved(box((-9, 0, -9), (9, 3.5, 9), 0.6), by=(0, 1.9, 0), turn=(12, 0, 0)), "plastic_black")
    rest = merge(*(ellipsoid((-6, 6.3, z), (2.6, 1.9, 3.0), 8) for z in (-6.0, 6.5)))
    a.add("handset", merge(rest, box((-7.6, 6.4, -6), (-4.4, 8.2, 6.5), 0.8)), "plastic_black")
    keys = [box((x, 4.2, z), (x + 1.6, 5.6, z + 1.2)) for x in (0.5, 3.0, 5.5) for z in (0.0, 2.4, 4.8)]
    a.add("keypad", merge(*keys), "plastic_grey")
    a.add("display", moved(box((0.5, 0, -2), (7.5, 0.5, 2)), by=(0, 6.4, -5), turn=(12, 0, 0)), "screen_blue")


@asset("HS_220", is_y_up=True)
def headset(a: Asset) -> None:
    """Headset lying on its side: 19 wide, 8 high, 20 deep."""
    band = [(9 * float(np.cos(t)), 4.0, -10 * float(np.sin(t))) for t in np.linspace(0, np.pi, 12)]
    a.add("headband", tube([(9, 4, 4), *band, (-9, 4, 4)], 0.7), "plastic_black")
    cup = moved(lathe([(0, 0), (3.6, 0), (3.9, 1.5), (3.4, 3), (0, 3)]), turn=(0, 0, 90))
    a.add("ear_cushions", merge(moved(cup, by=(10, 4, 5)), moved(cup, by=(-7, 4, 5))), "mesh_fabric")
    a.add("mic_boom", tube([(-8.5, 4, 5), (-8, 3, 11), (-2, 2, 13)], 0.35), "plastic_black")


@asset("smartphone_6in", looks="")
def mobile(a: Asset) -> None:
    """Mobile phone lying flat: 7.4 wide, 0.8 high, 15.4 deep."""
    a.add("body", box((-3.7, 0, -7.7), (3.7, 0.75, 7.7), 0.3), "plastic_black")
    a.add("screen", box((-3.4, 0.75, -7.3), (3.4, 0.8, 7.3)), "screen_dark")
