"""Pots, pans and cooking tools; centimetres, standing or lying on y = 0."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import Point2, arc, bend, box, circle, cylinder, ellipsoid, lathe, prism, sweep, tube


def _vessel(radius: float, height: float, wall: float = 0.35, flare: float = 0.0) -> Mesh:
    foot = radius - flare
    outer: list[Point2] = [(0.0, 0.0), (foot - 0.8, 0.0), (foot, 0.8), (radius, height), (radius + 0.4, height + 0.2)]
    inner: list[Point2] = [(radius - wall, height + 0.1), (foot - wall, 1.0), (foot - 1.0, 0.6), (0.0, 0.6)]
    return lathe([*outer, *inner])


def _loop_handle(radius: float, height: float, side: int) -> Mesh:
    x = side * (radius - 0.1)
    out = side * (radius + 3.2)
    line = [
        (x, height, -3.5),
        *bend((out - side, height + 0.4, -3.5), (out, height + 0.4, -3), (out, height + 0.4, 0), 3),
    ]
    line += [(out - side * 0.1, height + 0.4, 2.6), (out - side, height + 0.4, 3.5), (x, height, 3.5)]
    return tube(line, 0.55, 8)


@asset()
def stock_pot(a: Asset) -> None:
    a.add("body_geo", _vessel(12, 16), "brushed_steel")
    a.add("handles", merge(_loop_handle(12, 12.5, -1), _loop_handle(12, 12.5, 1)), "brushed_steel")
    a.surfaces["top"] = 16.2
    a.surfaces["inside"] = 0.6


@asset()
def pot_lid_24(a: Asset) -> None:
    dome: list[Point2] = [(0, 0.3), (11.0, 0.3), (11.1, 0), (12.4, 0), (12.4, 0.4), (10.5, 1.5), (6, 2.6), (0, 3.0)]
    a.add("lid_geo", lathe(dome), "brushed_steel")
    a.add("grip", lathe([(0, 2.9), (0.9, 2.9), (0.8, 4.0), (2.0, 4.6), (1.9, 5.4), (0, 5.7)]), "plastic_black")


@asset()
def sauce_pan(a: Asset) -> None:
    a.add("body_geo", _vessel(8, 9), "copper")
    grip = [(7.7, 6.6, 0.0), (12.0, 7.6, 0.0), (24.0, 10.0, 0.0), (25.5, 10.2, 0.0)]
    a.add("handle", sweep(grip, circle(1.0, 8, 0.7), widths=[0.7, 0.9, 1.1, 0.6]), "cast_iron")
    a.surfaces["inside"] = 0.6


@asset()
def frying_pan_28(a: Asset) -> None:
    a.add("body_geo", _vessel(14, 4.6, 0.4, 2.6), "cast_iron")
    grip = [(0.0, 3.4, 13.2), (0.0, 5.2, 17.0), (0.0, 7.2, 27.0), (0.0, 7.4, 33.0)]
    a.add("handle_LOW", sweep(grip, circle(1.1, 8, 0.6), widths=[0.8, 0.8, 1.15, 0.8]), "plastic_black")
    a.surfaces["inside"] = 0.6


@asset()
def casserole(a: Asset) -> None:
    a.add("body_geo", _vessel(11, 10, 0.6), "enamel_red")
    a.add("ears", merge(_loop_handle(11, 8.2, -1), _loop_handle(11, 8.2, 1)), "enamel_red")
    dome: list[Point2] = [(0, 10.25), (11.4, 10.25), (11.4, 10.8), (9.5, 12.4), (5, 13.4), (0, 13.7)]
    a.add("lid/lid_LOW", lathe(dome), "enamel_red")
    a.add("lid/knob", lathe([(0, 13.6), (0.8, 13.6), (0.8, 14.6), (1.8, 15.2), (1.6, 16), (0, 16.2)]), "brass")
    a.subcomponents.append("lid")


@asset()
def roasting_tin(a: Asset) -> None:
    walls = [box((-17, 0, -12), (17, 0.5, 12), 0.1)]
    walls += [box((-17, 0.5, z), (17, 6, z + 0.5), 0.1) for z in (-12.0, 11.5)]
    walls += [box((x, 0.5, -11.5), (x + 0.5, 6, 11.5), 0.1) for x in (-17.0, 16.5)]
    a.add("tin_geo", merge(*walls), "cast_iron")
    grips = [tube([(s * 17, 5.2, -4), (s * 19.4, 6.4, -4), (s * 19.4, 6.4, 4), (s * 17, 5.2, 4)], 0.4) for s in (-1, 1)]
    a.add("handles", merge(*grips), "chrome")
    a.surfaces["inside"] = 0.5


@asset()
def cutting_board(a: Asset) -> None:
    a.add("board_geo", box((-19, 0, -12), (19, 2.2, 12), 0.6), "beech")
    a.add("inlay", box((16.2, 2.2, -3.5), (17.4, 2.26, 3.5)), "oak_dark")
    a.surfaces["top"] = 2.2


@asset()
def knife_block(a: Asset) -> None:
    # Slots are real gaps: a knife stands in one without touching the wood.
    slabs = []
    for low, high in ((-5.5, -4.2), (-3.0, -1.2), (0.0, 1.8), (3.0, 5.5)):
        slabs.append(box((low, 1.0, -5), (high, 22, 5), 0.1))
    slabs += [box((-5.5, 1, z), (5.5, 22, z + 1), 0.1) for z in (-6.0, 5.0)]
    a.add("block_geo", merge(*slabs, box((-5.5, 0, -6), (5.5, 1.0, 6), 0.1)), "oak_dark")
    a.surfaces["inside"] = 1.0


def _blade(a: Asset, length: float, width: float) -> None:
    """Add a knife with its tip down on y = 0 and the handle up; the blade lies in the yz plane."""
    outline = [
        (-width / 2, 0.0),
        (-width / 2 + 0.4, 0.0),
        (width / 2, length * 0.4),
        (width / 2, length),
        (-width / 2, length),
    ]
    a.add("blade_geo", moved(prism(outline, -0.1, 0.1), turn=(0, 90, 0)), "chrome")
    grip = [(0.0, length - 0.3, 0.0), (0.0, length + 1.5, 0.0), (0.0, length + 7, 0.0), (0.0, length + 11, 0.0)]
    a.add("handle", sweep(grip, circle(1.0, 8, 1.3), widths=[0.45, 0.65, 0.7, 0.8]), "plastic_black")


@asset()
def chef_knife(a: Asset) -> None:
    _blade(a, 20, 4.2)


@asset()
def paring_knife(a: Asset) -> None:
    _blade(a, 20.5, 2.2)


@asset()
def bread_knife(a: Asset) -> None:
    a.add("blade_geo", merge(box((-1.5, 0.35, -21), (1.5, 0.55, 0), 0.08)), "chrome")
    teeth = [
        prism([(-1.6, -21 + 1.5 * k), (-1.5, -21 + 1.5 * k), (-1.5, -20 + 1.5 * k)], 0.38, 0.52) for k in range(13)
    ]
    a.add("teeth", merge(*(moved(t, by=(0, 0.9, 0), turn=(90, 0, 0)) for t in teeth)), "chrome")
    a.add(
        "handle",
        sweep([(0, 0.8, -0.4), (0, 0.8, 2), (0, 0.8, 11), (0, 0.8, 12)], circle(1.2, 8, 0.65), widths=[0.7, 1, 1, 0.7]),
        "oak_dark",
    )


@asset()
def utensil_crock(a: Asset) -> None:
    outer: list[Point2] = [(0, 0), (6.2, 0), (6.5, 0.4), (6.5, 14.4), (6.8, 15), (6.2, 15)]
    a.add("crock_geo", lathe([*outer, (6.0, 14.4), (6.0, 1.0), (0, 1.0)]), "ceramic_blue")
    a.surfaces["inside"] = 1.0


@asset()
def soup_ladle(a: Asset) -> None:
    cap = [*arc((0, 29.5), 4.2, -90, 0, 6), *arc((0, 29.5), 4.0, 0, -90, 6)]
    cap[0], cap[-1] = (0.0, 25.3), (0.0, 25.5)
    a.add("scoop_geo", moved(lathe(cap), by=(4.0, 0, 0)), "brushed_steel")
    a.add(
        "stem",
        sweep([(-0.9, 0, 0), (-0.9, 12, 0), (-0.4, 29.4, 0)], circle(0.55, 6), widths=[1.1, 1.0, 0.7]),
        "brushed_steel",
    )


@asset()
def turner_slotted(a: Asset) -> None:
    a.add("stem", sweep([(0, 0, 0), (0, 10, 0), (0, 24, 0)], circle(0.6, 6), widths=[1.2, 1.0, 0.6]), "plastic_black")
    slots = [box((x, 24.8, -0.15), (x + 0.9, 32, 0.15), 0.05) for x in (-3.6, -1.95, -0.45, 1.05, 2.7)]
    bars = [box((-3.6, y, -0.15), (3.6, y + 1.2, 0.15), 0.05) for y in (23.6, 32.0)]
    a.add("blade_geo", merge(*slots, *bars), "plastic_black")


@asset()
def balloon_whisk(a: Asset) -> None:
    a.add("handle", cylinder((0, 0, 0), 0.8, 12, 0.3, 12), "brushed_steel")
    wires = []
    for k in range(4):
        turn = 45.0 * k
        loop = [(0.5, 11.8, 0.0), (1.6, 16.0, 0.0), (2.9, 22.0, 0.0), (2.2, 26.0, 0.0), (0.0, 27.4, 0.0)]
        loop += [(-x, y, z) for x, y, z in loop[-2::-1]]
        wires.append(moved(tube(loop, 0.09, 5), turn=(0, turn, 0)))
    a.add("wires_geo", merge(*wires), "chrome")


@asset()
def wooden_spoon(a: Asset) -> None:
    a.add("stem", sweep([(0, 0, 0), (0, 14, 0), (0, 23, 0)], circle(0.6, 6), widths=[1.1, 1.0, 1.0]), "beech")
    a.add("bowl_geo", ellipsoid((0, 26, 0), (2.6, 3.8, 0.9), 14), "beech")


@asset()
def rolling_pin(a: Asset) -> None:
    roll: list[Point2] = [(0, -12.5), (2.8, -12.5), (3, -12), (3, 12), (2.8, 12.5), (0, 12.5)]
    a.add("roll_geo", moved(lathe(roll), by=(0, 3, 0), turn=(0, 0, 90)), "beech")
    for name, side in (("grip_L", -1), ("grip_R", 1)):
        line = [(side * 12.6, 3.0, 0.0), (side * 14.0, 3.0, 0.0), (side * 19.0, 3.0, 0.0), (side * 21.0, 3.0, 0.0)]
        a.add(name, sweep(line, circle(1.0, 8), widths=[0.7, 0.8, 1.3, 0.8]), "oak_dark")


@asset()
def box_grater(a: Asset) -> None:
    sides = []
    for turn in (0, 90, 180, 270):
        plate = moved(box((-5.2, 0, -0.1), (5.2, 20, 0.1)), by=(0, 0, 5.1), turn=(-5, 0, 0))
        sides.append(moved(plate, turn=(0, turn, 0)))
    a.add("body_geo", merge(*sides), "brushed_steel")
    bumps = [ellipsoid((x, y, 5.2 - 0.0875 * y), (0.7, 0.5, 0.4), 6) for y in (4, 8, 12, 16) for x in (-1.8, 1.8)]
    a.add("teeth", merge(*bumps), "chrome")
    a.add("handle", tube([(-3.4, 19.6, 0), (-3.4, 23, 0), (3.4, 23, 0), (3.4, 19.6, 0)], 0.7), "plastic_black")


@asset()
def scissors(a: Asset) -> None:
    for name, side in (("half_A", -1), ("half_B", 1)):
        ring = [
            (side * 2.0 + 1.7 * float(np.cos(t)), 0.5, 6 + 2.4 * float(np.sin(t)))
            for t in 2 * np.pi * np.arange(16) / 16
        ]
        blade = moved(
            prism([(-0.5, 0), (0.5, 0), (0.1, 11)], -0.1, 0.1), by=(0, 0.5 + 0.12 * side, 1), turn=(-90, 0, 0)
        )
        shank = box((-0.5 if side > 0 else -1.2, 0.25, 0.6), (1.2 if side > 0 else 0.5, 0.75, 4.2), 0.1)
        a.add(f"{name}/blade", moved(blade, turn=(0, side * 4, 0)), "chrome")
        a.add(f"{name}/grip", merge(tube(ring, 0.45, 6, closed=True), shank), "enamel_red")


@asset()
def baking_tray(a: Asset) -> None:
    a.add("sheet_geo", box((-19, 0, -13), (19, 0.3, 13), 0.1), "cast_iron")
    rim = [box((-19, 0.3, z), (19, 1.6, z + 0.4)) for z in (-13.0, 12.6)]
    rim += [box((x, 0.3, -12.6), (x + 0.4, 1.6, 12.6)) for x in (-19.0, 18.6)]
    a.add("rim", merge(*rim), "cast_iron")
    a.surfaces["inside"] = 0.3


@asset()
def thermos(a: Asset) -> None:
    a.documentation = "Thermos flask, 1 l, for the school trip."
    a.add("flask_geo", lathe([(0, 0), (4.6, 0), (4.8, 0.4), (4.8, 22), (3.4, 24.4), (0, 24.4)]), "enamel_teal")
    a.add("cap_LOW", lathe([(0, 24.5), (3.9, 24.5), (3.8, 29.5), (3.4, 30), (0, 30)]), "brushed_steel")
    a.add(
        "band", copies(lathe([(4.8, 0), (4.95, 0.1), (4.95, 0.9), (4.8, 1)]), [(0, 3, 0), (0, 19, 0)]), "brushed_steel"
    )


@asset()
def cutlery_insert(a: Asset) -> None:
    a.add("floor_geo", box((-24, 0, -21), (24, 0.4, 21)), "plastic_grey")
    walls = [box((x, 0.4, -21), (x + 0.6, 5, 21)) for x in (-24.0, -14.4, -4.8, 4.8, 23.4)]
    walls += [box((-23.4, 0.4, z), (23.4, 5, z + 0.6)) for z in (-21.0, 20.4)]
    a.add("dividers", merge(*walls), "plastic_grey")
    a.surfaces["inside"] = 0.4
