"""Cleaning equipment, plants, books and toys; centimetres, standing on y = 0."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import Point2, bend, box, circle, cylinder, ellipsoid, lathe, leaf, sweep, tube


@asset()
def broom(a: Asset) -> None:
    a.add("stick", cylinder((0, 13, 0), 1.2, 125, 0.4, 12), "beech")
    a.add("head_geo", box((-16, 8, -3), (16, 13.2, 3), 0.8), "enamel_red")
    tufts = copies(box((-1.6, 0, -2), (1.6, 8, 2), 0.2), [(-13.6 + 3.4 * k, 0, 0) for k in range(9)])
    a.add("bristles", tufts, "wicker")


@asset()
def bucket(a: Asset) -> None:
    outer: list[Point2] = [(0, 0), (10.6, 0), (11, 0.5), (14, 26), (14.8, 26.2), (14.8, 27)]
    a.add("pail_geo", lathe([*outer, (13.6, 27), (10.6, 1.0), (0, 0.8)]), "plastic_blue")
    bow = [
        (14.2 * float(np.cos(t)), 25 - 13.5 * float(np.sin(t)), 15.4 * float(np.sin(t)))
        for t in np.linspace(0, np.pi, 15)
    ]
    a.add(
        "bail", tube([(x, y if 0 < k < 14 else 25.0, z) for k, (x, y, z) in enumerate(bow)], 0.35, 6), "brushed_steel"
    )
    a.surfaces["inside"] = 0.8


@asset()
def dust_pan(a: Asset) -> None:
    a.add(
        "pan_geo",
        merge(box((-11, 0.2, -10), (11, 0.7, 10), 0.1), box((-11, 0.7, -10), (11, 6, -9.4), 0.1)),
        "enamel_red",
    )
    a.add("sides", merge(*(box((x, 0.7, -9.4), (x + 0.6, 4.5, 8), 0.1) for x in (-11.0, 10.4))), "enamel_red")
    a.add(
        "handle",
        sweep(
            [(0, 4, -9.8), (0, 5, -14), (0, 5.4, -22), (0, 5.2, -24)], circle(1.4, 8, 0.7), widths=[0.9, 0.8, 1, 0.7]
        ),
        "enamel_red",
    )


@asset()
def trash_bag(a: Asset) -> None:
    sack: list[Point2] = [
        (0, 0),
        (13, 0),
        (17.5, 3),
        (19, 11),
        (18, 20),
        (13, 29),
        (5, 34),
        (2.4, 36),
        (2.8, 38),
        (5.4, 43),
        (0, 41),
    ]
    body = lathe(sack)
    angle = np.arctan2(body.points[:, 2], body.points[:, 0])
    ripple = 1 + 0.05 * np.sin(5 * angle) + 0.03 * np.sin(9 * angle + 0.2 * body.points[:, 1])
    a.add(
        "sack_geo",
        body._replace(points=body.points * np.stack([ripple, np.ones_like(ripple), ripple], axis=1)),
        "plastic_bag",
    )


@asset()
def tool_box(a: Asset) -> None:
    a.add("body_geo", box((-20, 0, -10), (20, 14, 10), 0.8), "enamel_red")
    a.add("lid/top_geo", box((-20.4, 14.05, -10.4), (20.4, 19, 10.4), 1.2), "enamel_red")
    a.add("lid/handle", tube([(-8, 19, 0), (-7, 23, 0), (7, 23, 0), (8, 19, 0)], 0.8), "plastic_black")
    a.add("latches", merge(*(box((x - 1.5, 10, 10), (x + 1.5, 16, 10.9), 0.2) for x in (-11.0, 11.0))), "chrome")
    a.subcomponents.append("lid")


@asset()
def shopping_basket(a: Asset) -> None:
    outline = [(-20.0, 0.6, -13.0), (20.0, 0.6, -13.0), (20.0, 0.6, 13.0), (-20.0, 0.6, 13.0)]
    bars: list[Mesh] = [box((-19, 0, -12), (19, 0.6, 12), 0.2)]
    for k in range(5):
        grow, y = 1 + 0.03 * k, 1.0 + 5.2 * k
        bars.append(tube([(x * grow, y, z * grow) for x, _, z in outline], 0.7, 5, closed=True))
    for x in np.linspace(-18, 18, 7):
        bars += [sweep([(x, 0.4, s * 12.6), (x * 1.1, 22, s * 14.4)], circle(0.8, 5, 0.5)) for s in (-1, 1)]
    for z in np.linspace(-10, 10, 4):
        bars += [sweep([(s * 19.6, 0.4, z), (s * 22, 22, z * 1.1)], circle(0.8, 5, 0.5)) for s in (-1, 1)]
    a.add("weave_geo", merge(*bars), "wicker")
    a.add("handle", tube([(-22, 21, 0), *bend((-21, 30, 0), (0, 50, 0), (21, 30, 0), 8), (22, 21, 0)], 1.0), "wicker")
    a.surfaces["inside"] = 0.6


@asset()
def watering_can(a: Asset) -> None:
    outer: list[Point2] = [(0, 0), (8, 0), (8.3, 0.5), (7.4, 15), (4.5, 16.5), (4.5, 17)]
    a.add("body_geo", lathe([*outer, (4.1, 17), (4.1, 16.3), (6.9, 14.8), (7.8, 0.8), (0, 0.7)]), "enamel_teal")
    a.add("spout", sweep([(7, 4, 0), (14, 11, 0), (20, 21, 0)], circle(1.5, 8), widths=[1.1, 0.8, 0.6]), "enamel_teal")
    rose = moved(lathe([(0, 0), (0.9, 0), (2.6, 2.4), (0, 2.8)]), by=(19.6, 20.4, 0), turn=(0, 0, -30))
    a.add("rose", rose, "brass")
    a.add(
        "handle", tube([(-4.2, 16.3, 0), *bend((-6, 21, 0), (-16, 22, 0), (-14, 12, 0), 6), (-7.6, 5, 0)], 0.7), "brass"
    )


@asset()
def bird_cage(a: Asset) -> None:
    a.add("tray_geo", lathe([(0, 0), (15.5, 0), (16, 0.5), (16, 4), (15.4, 4), (15.2, 1), (0, 1)]), "enamel_cream")
    bars = []
    for k in range(14):
        cos, sin = float(np.cos(np.pi * k / 7)), float(np.sin(np.pi * k / 7))
        arch = [(15.2, 2.0), (15.2, 26.0), (12.4, 35.0), (1.2, 41.0)]
        bars.append(tube([(r * cos, y, r * sin) for r, y in arch], 0.2, 5))
    rings = [
        [(15.2 * float(np.cos(t)), y, 15.2 * float(np.sin(t))) for t in np.arange(20) * np.pi / 10]
        for y in (14.0, 26.0)
    ]
    a.add("bars_geo", merge(*bars, *(tube(ring, 0.25, 5, closed=True) for ring in rings)), "brass")
    a.add("perch", tube([(-14.8, 18, 0), (14.8, 18, 0)], 0.5, 6), "beech")
    hook = [(1.6 * float(np.sin(t)), 43 - 1.6 * float(np.cos(t)), 0.0) for t in np.arange(14) * np.pi / 7]
    a.add("crown", merge(cylinder((0, 40.4, 0), 1.6, 1.4, 0.2, 12), tube(hook, 0.25, 5, closed=True)), "brass")


@asset()
def flower_vase(a: Asset) -> None:
    outer: list[Point2] = [(0, 0), (3.8, 0), (4.2, 0.4), (6.2, 6), (5.6, 12), (3.4, 17), (3.2, 19.5), (4.2, 22)]
    a.add(
        "vase_geo",
        lathe([*outer, (3.9, 22), (2.8, 19.5), (3.0, 17), (5.1, 12), (5.7, 6), (3.8, 0.8), (0, 0.8)]),
        "ceramic_white",
    )
    a.surfaces["inside"] = 0.8


@asset()
def tulips(a: Asset) -> None:
    stems, heads, leaves = [], [], []
    for k in range(5):
        cos, sin = float(np.cos(2.5 * k)), float(np.sin(2.5 * k))
        lean, top = 3.0 + 1.3 * k, 33.0 - 1.8 * k
        line = [
            (0.9 * cos, 0.0, 0.9 * sin),
            (1.1 * cos, 20.0, 1.1 * sin),
            (0.6 * lean * cos, 27.0, 0.6 * lean * sin),
            (lean * cos, top, lean * sin),
        ]
        stems.append(tube(line, 0.25, 6))
        bud = lathe([(0, 0), (1.4, 0.6), (2.0, 2.2), (1.8, 4.2), (1.1, 5.6), (0, 5.0)])
        heads.append(moved(bud, by=(lean * cos, top - 0.3, lean * sin), turn=(12 * sin, 0, -12 * cos)))
        blade = sweep(
            [
                (0.6 * sin, 16, -0.6 * cos),
                (1.6 * sin, 22, -1.6 * cos),
                (4.5 * sin, 28, -4.5 * cos),
                (7 * sin, 30, -7 * cos),
            ],
            circle(1.3, 6, 0.12),
            widths=[0.4, 0.8, 0.9, 0.15],
        )
        leaves.append(blade)
    a.add("stems_geo", merge(*stems, *leaves), "leaf_green")
    a.add("blossoms", merge(*heads), "petal_red")


def _pot(a: Asset, radius: float, height: float, colour: str) -> None:
    outer: list[Point2] = [
        (0, 0),
        (radius * 0.7, 0),
        (radius * 0.95, height * 0.8),
        (radius, height * 0.8),
        (radius, height),
    ]
    a.add("pot_geo", lathe([*outer, (radius * 0.88, height), (radius * 0.85, height * 0.8), (0, height * 0.8)]), colour)
    a.add(
        "soil",
        lathe([(0, height * 0.8), (radius * 0.85, height * 0.81), (radius * 0.86, height * 0.9), (0, height * 0.93)]),
        "soil",
    )


@asset()
def basil_pot(a: Asset) -> None:
    _pot(a, 6.5, 10, "terracotta")
    leaves = []
    for k in range(34):
        ring, turn = np.sqrt(k / 34), 2.4 * k
        spot = (7 * ring * float(np.cos(turn)), 20 - 7 * ring**2 + (k % 3), 7 * ring * float(np.sin(turn)))
        leaves.append(moved(leaf(3.0, 2.0), by=spot, turn=(20, 57.0 * turn, 25)))
    stems = [
        tube([(0, 9, 0), (3.5 * float(np.cos(t)), 17, 3.5 * float(np.sin(t)))], 0.25, 5) for t in (0.2, 1.6, 3.1, 4.6)
    ]
    a.add("leaves_geo", merge(*leaves, *stems), "leaf_green")


@asset()
def floor_plant(a: Asset) -> None:
    _pot(a, 16, 28, "ceramic_white")
    blades = []
    for k in range(10):
        turn, high = 2.4 * k, 70.0 + 34 * ((k * 7) % 5) / 5
        cos, sin, reach = float(np.cos(turn)), float(np.sin(turn)), 16.0 + 2.1 * (k % 9)
        line = bend(
            (3 * cos, 25, 3 * sin),
            (0.25 * reach * cos, high, 0.25 * reach * sin),
            (reach * cos, high * 0.95, reach * sin),
            5,
        )
        blades.append(sweep(line, circle(3.2, 5, 0.1), widths=[0.4, 0.8, 1, 0.95, 0.6, 0.12]))
    a.add("leaves_geo", merge(*blades), "leaf_green")


def _book(a: Asset, size: tuple[float, float, float], cover: str) -> None:
    """Add a book lying flat, spine towards -x."""
    x, y, z = size[0] / 2, size[1], size[2] / 2
    covers = [box((-x, 0, -z), (x, 0.25, z)), box((-x, y - 0.25, -z), (x, y, z))]
    covers.append(box((-x, 0.25, -z), (-x + 0.25, y - 0.25, z)))
    a.add("cover_geo", merge(*covers), cover)
    a.add("pages", box((-x + 0.25, 0.25, -z + 0.4), (x - 0.4, y - 0.25, z - 0.4)), "paper_white")


@asset()
def cook_book(a: Asset) -> None:
    _book(a, (20, 3.0, 27), "fabric_rust")


@asset()
def novel(a: Asset) -> None:
    _book(a, (13, 2.4, 20), "carton_blue")


@asset()
def atlas(a: Asset) -> None:
    _book(a, (24, 2.0, 31), "plastic_green")


@asset()
def toy_car(a: Asset) -> None:
    a.add(
        "body_geo",
        merge(box((-8, 1.6, -3.4), (8, 4.6, 3.4), 0.8), box((-4, 4.6, -2.8), (4.5, 7.6, 2.8), 1.2)),
        "enamel_red",
    )
    a.add("windows", box((-3.0, 5.2, -2.9), (3.5, 6.9, 2.9)), "screen_dark")
    wheel = moved(cylinder((0, 0, 0), 1.8, 1.4, 0.2, 16), turn=(90, 0, 0))
    a.add("wheels", copies(wheel, [(x, 1.8, z) for x in (-5, 5) for z in (-3.7, 2.3)]), "plastic_black")


@asset()
def teddy(a: Asset) -> None:
    limbs = [ellipsoid((0, 9, 0), (6, 8.5, 5.2), 14), ellipsoid((0, 20.5, 0.6), (5.2, 4.8, 4.8), 12)]
    for s in (-1, 1):
        limbs.append(ellipsoid((s * 4.2, 24.4, 0), (1.8, 1.8, 1.0), 8))
        limbs.append(moved(ellipsoid((0, 0, 0), (2.2, 5, 2.2), 8), by=(s * 6.6, 11.5, 1.6), turn=(-30, 0, s * 24)))
        limbs.append(moved(ellipsoid((0, 0, 0), (2.7, 2.6, 5.6), 8), by=(s * 4, 2.65, 5.4), turn=(0, s * 16, 0)))
    a.add("plush_geo", merge(*limbs), "wicker")
    a.add("snout", ellipsoid((0, 19.4, 4.8), (2.2, 1.8, 1.6), 10), "cream")
    dots = [(0.0, 20.0, 6.4), (-1.9, 22, 4.6), (1.9, 22, 4.6)]
    a.add("eyes", copies(ellipsoid((0, 0, 0), (0.6, 0.5, 0.5), 8), dots), "plastic_black")


@asset()
def soap_pump(a: Asset) -> None:
    a.add(
        "bottle_geo",
        lathe([(0, 0), (3.3, 0), (3.5, 0.4), (3.5, 11), (2.4, 13), (1.3, 13.4), (1.3, 14.4), (0, 14.4)]),
        "soap_green",
    )
    nozzle = [cylinder((0, 14.4, 0), 1.5, 1.2, 0.1, 14), cylinder((0, 15.6, 0), 0.4, 2.6, 0, 8)]
    spout = tube([(0, 18, -0.6), (0, 18.4, 1.6), (0, 17.8, 3.8)], 0.5)
    a.add("pump_geo", merge(*nozzle, spout), "chrome")


@asset()
def sponge(a: Asset) -> None:
    a.add("foam_geo", box((-5, 0, -3.4), (5, 2.4, 3.4), 0.4), "sponge_yellow")
    a.add("scour_LOW", box((-5, 2.4, -3.4), (5, 3.2, 3.4), 0.1), "plastic_green")


@asset()
def paper_towel(a: Asset) -> None:
    a.add("foot_geo", cylinder((0, 0, 0), 7.5, 1.4, 0.3, 24), "beech")
    a.add("peg", lathe([(0, 1.4), (1, 1.4), (1, 28), (1.6, 29), (1.4, 30.4), (0, 30.8)]), "beech")
    a.add("roll_geo", lathe([(2.0, 1.5), (5.8, 1.5), (5.8, 26), (2.0, 26), (2.0, 1.5)]), "paper_white")


@asset()
def towel_folded(a: Asset) -> None:
    layers = [box((-9, 1.1 * k, -6.5), (9, 1.1 * k + 1.08, 6.5), 0.4) for k in range(3)]
    a.add("cloth_geo", merge(*layers), "fabric_check")


@asset()
def fire_extinguisher(a: Asset) -> None:
    tank: list[Point2] = [(0, 0), (7, 0), (7.5, 0.6), (7.5, 36), (5.6, 40), (2, 42), (2, 43.4), (0, 43.4)]
    a.add("tank_geo", lathe(tank), "enamel_red")
    head = [
        box((-2, 43.4, -2), (2, 46, 2), 0.4),
        box((-1.2, 46, -1), (1.2, 46.8, 9), 0.3),
        box((-1.2, 48.2, -1), (1.2, 49, 10), 0.3),
    ]
    a.add("valve", merge(*head, box((-1, 46, -1.6), (1, 48.9, -0.8))), "plastic_black")
    hose = [(2, 44.6, 0), *bend((5, 45, 0), (10.5, 44, 0), (9.4, 34, 0), 5), (8.8, 18, 0), (8.8, 12, 0)]
    a.add("hose", tube(hose, 0.8, 8), "plastic_black")
    a.add("bracket", box((-4, 22, -8.45), (4, 30, -7.2)), "brushed_steel")
    a.add("label", moved(lathe([(7.5, 0), (7.54, 0), (7.54, 12), (7.5, 12)]), by=(0, 16, 0)), "paper_white")
