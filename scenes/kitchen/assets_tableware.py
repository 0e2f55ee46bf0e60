"""Tableware; centimetres, standing on y = 0."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, merge, moved
from scenes.writer.shapes import Point2, arc, bend, box, circle, ellipsoid, lathe, leaf, sweep


def _plate(radius: float, well: float, rise: float, segments: int = 32) -> Mesh:
    outer: list[Point2] = [(0.0, 0.0), (well * 0.92, 0.0)]
    outer += [(well, 0.5), (radius - 0.2, rise - 0.4), (radius, rise)]
    inner: list[Point2] = [(radius - 0.3, rise + 0.05), (well + 0.2, 1.1), (well - 0.6, 0.75), (0.0, 0.7)]
    return lathe([*outer, *inner], segments)


@asset()
def dinner_plate(a: Asset) -> None:
    a.add("plate_geo", _plate(13.5, 9.2, 2.2), "ceramic_white")
    a.surfaces["top"] = 0.7


@asset()
def side_plate(a: Asset) -> None:
    a.add("plate_geo", _plate(9.5, 6.4, 1.8), "ceramic_sage")
    a.surfaces["top"] = 0.7
    a.surfaces["stack"] = 0.8


@asset()
def saucer(a: Asset) -> None:
    a.add("saucer_geo", _plate(6.2, 3.4, 1.4, 24), "ceramic_white")
    a.surfaces["top"] = 0.75


def _bowl(radius: float, height: float, foot: float, wall: float, segments: int = 32) -> Mesh:
    deep = height - 0.8
    outer: list[Point2] = [(0.0, 0.0), (foot, 0.0), (foot, 0.7)]
    inner: list[Point2] = []
    for k in range(6):
        sin, drop = float(np.sin(np.pi / 10 * k)), 1 - float(np.cos(np.pi / 10 * k))
        if k:
            outer.append((foot + (radius - foot) * sin, 0.7 + (height - 0.7) * drop))
        inner.append((foot + (radius - foot - wall) * sin, 0.8 + deep * drop))
    return lathe([*outer, *inner[::-1], (0.0, 0.8)], segments)


@asset()
def cereal_bowl(a: Asset) -> None:
    a.add("bowl_geo", _bowl(7.8, 6.8, 3.8, 0.45, 28), "ceramic_ochre")
    a.surfaces["inside"] = 0.8


@asset()
def pasta_bowl(a: Asset) -> None:
    a.add("bowl_geo", _bowl(11.5, 5.0, 6.0, 0.5), "ceramic_blue")
    a.surfaces["inside"] = 0.8


@asset()
def salad_bowl(a: Asset) -> None:
    a.add("bowl_geo", _bowl(14.5, 10.5, 5.5, 0.8), "oak_light")
    leaves = []
    for k in range(18):
        angle, reach = 2.4 * k, 1.95 * np.sqrt(k)
        spot = (reach * float(np.cos(angle)), 8.2 - 0.05 * k, reach * float(np.sin(angle)))
        leaves.append(moved(leaf(4.2, 2.8), by=spot, turn=(25 * float(np.sin(3 * k)), 40.0 * k, 18)))
    a.add("leaves_geo", merge(*leaves), "leaf_green")
    a.surfaces["inside"] = 0.8


@asset()
def fruit_bowl(a: Asset) -> None:
    a.add("bowl_geo", _bowl(16.5, 8.5, 10.6, 0.6), "ceramic_blue")
    a.surfaces["inside"] = 0.8


def _mug(a: Asset, radius: float, height: float, colour: str) -> None:
    outer: list[Point2] = [(0.0, 0.0), (radius - 0.4, 0), (radius, 0.5)]
    rim: list[Point2] = [(radius, height - 0.15), (radius - 0.15, height), (radius - 0.3, height - 0.15)]
    inner: list[Point2] = [(radius - 0.35, 1.0), (radius - 0.8, 0.6), (0.0, 0.6)]
    a.add("body_geo", lathe([*outer, *rim, *inner]), colour)
    top, low, reach = height * 0.8, height * 0.2, radius + height * 0.34
    loop = bend((radius - 0.15, top, 0), (reach, top + 0.5, 0), (reach, height * 0.5, 0), 5)
    loop += bend((reach, height * 0.5, 0), (reach, low - 0.5, 0), (radius - 0.15, low, 0), 5)[1:]
    a.add("handle", sweep(loop, circle(0.55, 6, 0.7), up=(0, 0, 1)), colour)
    a.surfaces["inside"] = 0.6


@asset()
def mug_large(a: Asset) -> None:
    _mug(a, 4.1, 9.0, "ceramic_sage")


@asset()
def mug_enamel(a: Asset) -> None:
    _mug(a, 4.0, 8.0, "enamel_cream")


@asset()
def espresso_cup(a: Asset) -> None:
    _mug(a, 2.9, 5.4, "ceramic_white")


@asset()
def tumbler(a: Asset) -> None:
    outer: list[Point2] = [(0.0, 0.0), (2.9, 0.0), (3.1, 0.3), (3.7, 11.9), (3.6, 12.0)]
    a.add("glass_geo", lathe([*outer, (3.45, 11.9), (2.85, 1.2), (0.0, 1.0)]), "glass_clear")


@asset()
def wine_glass(a: Asset) -> None:
    foot: list[Point2] = [(0.0, 0.0), (3.5, 0.0), (3.5, 0.25), (1.0, 0.7), (0.42, 1.6), (0.4, 8.6), (0.9, 9.4)]
    cup: list[Point2] = [(2.9, 10.8), (3.9, 13.0), (4.0, 15.0), (3.6, 18.0), (3.15, 20.5)]
    inner: list[Point2] = [(3.0, 20.5), (3.45, 18.0), (3.85, 15.0), (3.75, 13.1), (2.75, 11.0), (0.0, 9.8)]
    a.add("glass_geo", lathe([*foot, *cup, *inner]), "glass_clear")


@asset()
def water_carafe(a: Asset) -> None:
    outer: list[Point2] = [
        (0.0, 0.0),
        (5.2, 0.0),
        (5.8, 0.8),
        (5.9, 6.0),
        (4.6, 13.0),
        (2.6, 19.0),
        (2.5, 22.0),
        (3.4, 26.0),
    ]
    inner: list[Point2] = [(3.2, 26.0), (2.2, 22.0), (2.3, 19.0), (4.3, 13.0), (5.6, 6.0), (5.4, 1.0), (0.0, 0.8)]
    a.add("glass_geo", lathe([*outer, *inner]), "glass_clear")
    a.add("water", lathe([(0, 0.9), (5.3, 0.9), (5.5, 6.0), (4.25, 12.6), (0, 12.6)]), "window_glass")


def _handle(length: float, end: float, rise: float) -> Mesh:
    """Return a flat cutlery handle along z, from z = 0 to `length`, widest at the far end."""
    line = [
        (0.0, rise, 0.0),
        (0.0, rise + 0.15, length * 0.3),
        (0.0, 0.35, length * 0.7),
        (0.0, 0.2, length - 0.6),
        (0.0, 0.2, length),
    ]
    return sweep(line, circle(1.0, 8, 0.22), widths=[0.32 * end, 0.35 * end, 0.7 * end, end, end * 0.7])


def _fork(length: float) -> Mesh:
    scale = length / 20
    tines = []
    for k in range(4):
        x = (k - 1.5) * 0.62 * scale
        line = [(x, 0.9, -0.5), (x, 0.25, -2.5 * scale), (x, 0.6, -5.0 * scale)]
        tines.append(sweep(line, circle(0.17 * scale, 6), widths=[1.2, 1.1, 0.6]))
    neck = sweep([(0, 0.8, 0.6), (0, 0.8, -1.0 * scale)], circle(1.15 * scale, 8, 0.2), widths=[0.45, 1.0])
    return merge(*tines, neck, _handle(length - 5 * scale, 0.95 * scale, 0.8))


def _spoon(length: float) -> Mesh:
    scale = length / 20
    cap = [*arc((0, 1.0), 1.0, -90, 0, 5), *arc((0, 1.0), 0.9, 0, -90, 5)]
    cap[0], cap[-1] = (0.0, 0.0), (0.0, 0.1)
    scoop = moved(lathe(cap), by=(0, 0, -3.0 * scale), scale=(2.1 * scale, 0.95 * scale, 3.3 * scale))
    return merge(scoop, _handle(length - 6.3 * scale, 0.95 * scale, 0.8 * scale))


@asset()
def table_fork(a: Asset) -> None:
    a.add("fork_geo", _fork(20.0), "brushed_steel")


@asset()
def table_spoon(a: Asset) -> None:
    a.add("spoon_geo", _spoon(20.0), "brushed_steel")


@asset()
def tea_spoon(a: Asset) -> None:
    a.add("spoon_geo", _spoon(13.5), "brushed_steel")


@asset()
def dessert_fork(a: Asset) -> None:
    a.add("fork_geo", _fork(15.0), "brushed_steel")


@asset()
def table_knife(a: Asset) -> None:
    a.add("handle", _handle(11.0, 0.95, 0.4), "brushed_steel")
    blade = [(0.0, 0.4, 0.4), (0.0, 0.4, -8.0), (0.0, 0.35, -11.0)]
    a.add("blade_geo", sweep(blade, circle(1.0, 6, 0.1), widths=[0.8, 1.0, 0.35]), "chrome")


def _shaker(a: Asset, body: str) -> None:
    profile: list[Point2] = [(0, 0), (2.1, 0), (2.2, 0.4), (1.7, 3.4), (1.8, 5.6), (0, 5.6)]
    a.add("body_geo", lathe(profile), body)
    a.add(
        "cap", lathe([(0, 5.6), (1.85, 5.6), (1.8, 6.6), *arc((0.6, 6.6), 1.1, 10, 80, 4), (0, 7.8)]), "brushed_steel"
    )


@asset()
def salt_shaker(a: Asset) -> None:
    _shaker(a, "ceramic_white")


@asset()
def pepper_shaker(a: Asset) -> None:
    _shaker(a, "oak_dark")


@asset()
def napkin_folded(a: Asset) -> None:
    a.add(
        "cloth_geo",
        merge(box((-5, 0, -10.5), (5, 0.25, 10.5), 0.1), box((-4.9, 0.25, -10.4), (4.9, 0.45, 10.4), 0.1)),
        "fabric_linen",
    )


@asset()
def serving_tray(a: Asset) -> None:
    a.add("tray_geo", box((-20, 0, -14), (20, 0.8, 14), 0.2), "oak_light")
    rim = [box((-20, 0.8, z), (20, 3.2, z + 1), 0.3) for z in (-14.0, 13.0)]
    rim += [box((x, 0.8, -13), (x + 1, 3.2, 13), 0.3) for x in (-20.0, 19.0)]
    a.add("rim", merge(*rim), "oak_light")
    a.surfaces["inside"] = 0.8


@asset()
def cake_stand(a: Asset) -> None:
    foot: list[Point2] = [(0, 0), (6, 0), (6, 0.6), (1.6, 1.8), (1.3, 8), (3, 9.4)]
    a.add("stand_geo", lathe([*foot, (15, 9.8), (15.2, 10.8), (14.6, 10.8), (14.4, 10.3), (0, 10.3)]), "ceramic_white")
    a.surfaces["top"] = 10.3


@asset()
def bread_basket(a: Asset) -> None:
    profile: list[Point2] = [
        (0, 0),
        (8, 0),
        (8.6, 0.6),
        (11, 7.4),
        (11.4, 8),
        (10.8, 8),
        (10.3, 7.2),
        (7.9, 1.0),
        (0, 1.0),
    ]
    a.add("weave_geo", moved(lathe(profile), scale=(1.25, 1, 0.85)), "wicker")
    a.surfaces["inside"] = 1.0


@asset()
def butter_dish(a: Asset) -> None:
    a.add("plate_geo", box((-9, 0, -5.5), (9, 1.0, 5.5), 0.4), "ceramic_white")
    a.add("cover/lid_LOW", box((-7.5, 1.02, -4), (7.5, 6.2, 4), 1.0), "ceramic_white")
    a.add("cover/knob", ellipsoid((0, 6.7, 0), (0.9, 0.8, 0.9), 12), "ceramic_blue")
    a.subcomponents.append("cover")
