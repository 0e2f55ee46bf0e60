"""Food, drink and their containers; centimetres, standing on y = 0."""

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import Point2, arc, bend, box, circle, cylinder, ellipsoid, lathe, prism, sweep, tube


def _bottle(a: Asset, radius: float, height: float, glass: str, cap: str, label: str) -> None:
    shoulder, neck = height * 0.62, radius * 0.4
    body: list[Point2] = [(0.0, 0.4), (radius - 0.8, 0.0), (radius - 0.3, 0.1), (radius, 0.6), (radius, shoulder)]
    curve = [(x, y) for x, y, _ in bend((radius, shoulder, 0), (radius, height * 0.74, 0), (neck, height * 0.8, 0), 5)]
    a.add("glass_geo", lathe([*body, *curve[1:], (neck, height - 2.2), (0.0, height - 2.2)]), glass)
    a.add("cap", cylinder((0, height - 2.2, 0), neck + 0.15, 2.2, 0.2, 16), cap)
    band: list[Point2] = [(radius + 0.04, 0), (radius + 0.04, height * 0.3)]
    a.add("label_LOW", moved(lathe(band), by=(0, height * 0.16, 0)), label)


@asset()
def wine_bottle(a: Asset) -> None:
    _bottle(a, 3.75, 30.0, "glass_green", "jam_red", "cream")


@asset()
def oil_bottle(a: Asset) -> None:
    _bottle(a, 3.2, 25.0, "glass_green", "brass", "carton_yellow")


@asset()
def water_bottle(a: Asset) -> None:
    _bottle(a, 4.1, 31.0, "window_glass", "plastic_blue", "carton_blue")


@asset()
def milk_bottle(a: Asset) -> None:
    _bottle(a, 4.3, 23.0, "cream", "plastic_blue", "plastic_white")


@asset()
def ketchup_bottle(a: Asset) -> None:
    body: list[Point2] = [(0, 0), (2.8, 0), (2.7, 2.6), (3.2, 3.0), (3.3, 9), (2.8, 15), (2.0, 17.6), (0, 18)]
    a.add("body_geo", moved(lathe(body), scale=(1, 1, 0.75)), "enamel_red")
    a.add("label", box((-1.8, 6, -2.5), (1.8, 12, 2.53), 0.1), "paper_white")


@asset()
def spray_bottle(a: Asset) -> None:
    body: list[Point2] = [(0, 0), (4, 0), (4.3, 0.6), (4.3, 12), (3.4, 16), (1.6, 19), (1.6, 20.5), (0, 20.5)]
    a.add("body_geo", moved(lathe(body), scale=(1, 1, 0.7)), "plastic_blue")
    head = [box((-1.5, 20.5, -1.4), (1.5, 22, 1.4), 0.3), box((-3.2, 22, -1.2), (4.2, 25, 1.2), 0.5)]
    trigger = tube([(2.6, 22.4, 0), *bend((3.4, 21, 0), (4.2, 20, 0), (4.6, 18, 0), 3)], 0.45)
    a.add("trigger_head", merge(*head, trigger), "plastic_white")


def _jar(a: Asset, radius: float, height: float, content: str, lid: str) -> None:
    outer: list[Point2] = [(0.0, 0.0), (radius - 0.4, 0.0), (radius, 0.5), (radius, height * 0.72)]
    outer += [(radius * 0.86, height * 0.82), (radius * 0.86, height * 0.84), (0.0, height * 0.84)]
    a.add("jar_geo", lathe(outer), content)
    a.add("lid", cylinder((0, height * 0.84, 0), radius * 0.93, height * 0.16, 0.2, 24), lid)
    band: list[Point2] = [(radius + 0.04, 0), (radius + 0.04, height * 0.36)]
    a.add("label", moved(lathe(band), by=(0, height * 0.2, 0)), "paper_white")


@asset()
def jam_jar_orange(a: Asset) -> None:
    _jar(a, 3.9, 10.5, "jam_orange", "fabric_check")


@asset()
def jam_jar_raspberry(a: Asset) -> None:
    _jar(a, 3.9, 10.5, "jam_red", "fabric_check")


@asset()
def honey_jar(a: Asset) -> None:
    _jar(a, 3.6, 11.5, "honey", "brass")


@asset()
def spread_jar(a: Asset) -> None:
    _jar(a, 4.2, 12.0, "cocoa", "plastic_white")


@asset()
def spice_jar(a: Asset) -> None:
    _jar(a, 2.3, 9.5, "ceramic_ochre", "plastic_black")


@asset()
def storage_jar(a: Asset) -> None:
    outer: list[Point2] = [(0, 0), (5.6, 0), (6, 0.6), (6, 17), (5.5, 18), (5.5, 18.6)]
    a.add("glass_geo", lathe([*outer, (5.2, 18.6), (5.2, 17.8), (5.7, 16.8), (5.7, 0.9), (0, 0.8)]), "glass_clear")
    a.add("pasta", lathe([(0, 0.9), (5.5, 0.9), (5.5, 13), (0, 13.6)]), "crust")
    a.add("stopper", lathe([(0, 18.62), (5.8, 18.62), (5.8, 20.6), (5.2, 21), (0, 21)]), "cork")


def _carton(a: Asset, size: tuple[float, float, float], face: str, band: str) -> None:
    x, y, z = size[0] / 2, size[1], size[2] / 2
    a.add("box_geo", box((-x, 0, -z), (x, y, z), 0.1), face)
    a.add("print_front", box((-x * 0.82, y * 0.45, z), (x * 0.82, y * 0.85, z + 0.04)), band)
    a.add("print_back", box((-x * 0.82, y * 0.45, -z - 0.04), (x * 0.82, y * 0.85, -z)), band)


@asset()
def cereal_flakes(a: Asset) -> None:
    _carton(a, (19, 30, 7), "carton_yellow", "carton_red")


@asset()
def cereal_muesli(a: Asset) -> None:
    _carton(a, (16, 26, 8), "carton_blue", "cream")


@asset()
def rice_carton(a: Asset) -> None:
    _carton(a, (12, 18, 6), "paper_white", "carton_red")


@asset()
def tea_box(a: Asset) -> None:
    _carton(a, (14, 8, 7), "plastic_green", "cream")


@asset()
def tab_box(a: Asset) -> None:
    _carton(a, (14, 16, 8), "carton_blue", "carton_yellow")


def _gable(a: Asset, colour: str, band: str) -> None:
    a.add("carton_geo", box((-3.5, 0, -3.5), (3.5, 19, 3.5), 0.15), colour)
    roof = prism([(-3.5, 19), (3.5, 19), (0.2, 22.4), (-0.2, 22.4)], -3.5, 3.5)
    a.add("gable", merge(moved(roof, turn=(0, 90, 0)), box((-3.5, 22.4, -0.2), (3.5, 24.0, 0.2))), colour)
    a.add("cap", moved(cylinder((0, 0, 0), 1.3, 1.2, 0.2, 14), by=(0, 20.5, 1.7), turn=(46, 0, 0)), band)
    a.add("print", merge(box((-2.8, 4, 3.5), (2.8, 14, 3.54)), box((-2.8, 4, -3.54), (2.8, 14, -3.5))), band)


@asset()
def milk_carton(a: Asset) -> None:
    _gable(a, "plastic_white", "carton_blue")


@asset()
def juice_carton(a: Asset) -> None:
    _gable(a, "orange_peel", "plastic_green")


@asset()
def flour_bag(a: Asset) -> None:
    a.add("bag_geo", box((-5, 0, -3.4), (5, 15, 3.4), 0.8), "paper_white")
    a.add("fold", box((-4.6, 14.9, -1.4), (4.6, 16.6, 1.4), 0.4), "paper_white")
    a.add("print", box((-3.6, 4, 3.4), (3.6, 10, 3.44)), "carton_blue")


@asset()
def coffee_pack(a: Asset) -> None:
    a.add("pack_geo", box((-4.2, 0, -3), (4.2, 16, 3), 0.6), "cocoa")
    a.add("seal", box((-4.0, 15.8, -0.3), (4.0, 19, 0.3), 0.1), "brass")
    a.add("print", box((-3, 4, 3), (3, 11, 3.04)), "cream")


@asset()
def food_can(a: Asset) -> None:
    wall: list[Point2] = [(0, 0.3), (3.4, 0.3), (3.5, 0), (3.75, 0.2), (3.7, 0.7), (3.7, 10.3), (3.75, 10.8), (3.5, 11)]
    a.add("tin_geo", lathe([*wall, (3.4, 10.6), (0, 10.6)]), "brushed_steel")
    a.add("wrap", lathe([(3.7, 1), (3.76, 1), (3.76, 10), (3.7, 10)]), "carton_red")


@asset()
def sugar_tin(a: Asset) -> None:
    a.add("tin_geo", lathe([(0, 0), (5.6, 0), (5.8, 0.3), (5.8, 12), (0, 12)]), "enamel_cream")
    a.add("lid/lid_geo", lathe([(0, 12.02), (6, 12.02), (6, 13.8), (5.6, 14.2), (0, 14.4)]), "enamel_cream")
    a.add("lid/knob", ellipsoid((0, 15.2, 0), (1.1, 1.0, 1.1), 12), "oak_dark")
    a.add("stripe", lathe([(5.8, 3), (5.84, 3), (5.84, 8), (5.8, 8)]), "ceramic_blue")
    a.subcomponents.append("lid")


@asset()
def egg_carton(a: Asset) -> None:
    a.looks = "mtl"
    low = [(-14.0, 0.0), (14.0, 0.0), (15.0, 3.5), (-15.0, 3.5)]
    high = [(-15.0, 3.6), (15.0, 3.6), (14.0, 7.0), (-14.0, 7.0)]
    a.add("tray_geo", prism(low, -5, 5), "carton_grey")
    a.add("lid_geo", prism(high, -5, 5), "carton_grey")
    a.add("print", box((-10, 7, -3.5), (10, 7.04, 3.5)), "carton_yellow")


@asset()
def yoghurt_pot(a: Asset) -> None:
    cup: list[Point2] = [(0, 0.2), (2.6, 0.2), (2.8, 0), (3.0, 0.3), (3.6, 7.6), (4.0, 7.7), (4.0, 8), (0, 8)]
    a.add("pot_geo", lathe(cup), "plastic_white")
    a.add("foil_lid", lathe([(0, 8.0), (4.0, 8.0), (4.0, 8.1), (0, 8.1)]), "brushed_steel")
    a.add("wrap", lathe([(3.04, 1), (3.1, 1), (3.56, 6.4), (3.5, 6.4)]), "carton_red")


@asset()
def lunch_box(a: Asset) -> None:
    a.add("tub_geo", box((-8.5, 0, -6), (8.5, 5.2, 6), 0.8), "window_glass")
    a.add("lid_geo", box((-9, 5.22, -6.5), (9, 6.6, 6.5), 0.5), "plastic_green")


@asset()
def bread_loaf(a: Asset) -> None:
    outline = [
        (6.0, 0.6),
        (6.6, 4.2),
        *arc((0, 4.8), 6.6, 8, 172, 8),
        (-6.6, 4.2),
        (-6.0, 0.6),
        (-5.2, 0.0),
        (5.2, 0.0),
    ]
    smooth = [(x, y - 4.5) for x, y in outline]
    line = [(z, 4.5, 0.0) for z in (-13.0, -12.2, -10.5, 0.0, 10.5, 12.2, 13.0)]
    a.add("loaf_geo", sweep(line, smooth, widths=[0.5, 0.8, 0.97, 1.0, 0.97, 0.8, 0.5]), "crust")
    cuts = [
        moved(ellipsoid((0, 0, 0), (0.6, 0.35, 3.6), 10), by=(x, 11.1, 0), turn=(0, 25, 0)) for x in (-6.0, 0.0, 6.0)
    ]
    a.add("cuts", merge(*cuts), "cream")


@asset()
def croissant(a: Asset) -> None:
    line = [
        (-6.0, 1.4, 3.4),
        (-4.6, 1.7, 1.0),
        (-2.4, 2.1, -0.6),
        (0.0, 2.3, -1.0),
        (2.4, 2.1, -0.6),
        (4.6, 1.7, 1.0),
        (6.0, 1.4, 3.4),
    ]
    widths = [0.35, 0.62, 0.86, 1.0, 0.86, 0.62, 0.35]
    a.add("pastry_geo", sweep(line, circle(2.3, 8), widths=widths), "crust")


@asset()
def bread_roll(a: Asset) -> None:
    a.add("roll_geo", lathe([(0, 0), (3.2, 0), *arc((1.6, 2.4), 2.4, -45, 60, 5), (1.2, 5.0), (0, 5.2)]), "crust")


@asset()
def layer_cake(a: Asset) -> None:
    a.add("sponge_geo", cylinder((0, 0, 0), 11, 7, 0.0, 32), "crust")
    a.add("icing", lathe([(0, 7.0), (11.1, 6.6), (11.3, 7.2), (10.8, 7.8), (0, 8.0)]), "cream")
    cherries = copies(
        ellipsoid((0, 0, 0), (1.1, 1.1, 1.1), 8),
        [(8.6, 8.7, 0), (-8.6, 8.7, 0), (0, 8.7, 8.6), (0, 8.7, -8.6), (0, 8.8, 0)],
    )
    a.add("cherries", cherries, "apple_red")


def _apple(a: Asset, colour: str) -> None:
    skin: list[Point2] = [
        (0, 0.5),
        (0.8, 0.1),
        (1.7, 0.1),
        (2.8, 1.1),
        (3.7, 3.2),
        (3.8, 4.8),
        (3.0, 6.5),
        (1.6, 7.0),
        (0.6, 6.6),
        (0, 6.0),
    ]
    a.add("fruit_geo", lathe(skin), colour)
    a.add("stalk", tube([(0, 5.9, 0), (0.2, 7.0, 0), (0.5, 7.8, 0)], 0.15, 5), "oak_dark")


@asset()
def apple_red(a: Asset) -> None:
    _apple(a, "apple_red")


@asset()
def apple_green(a: Asset) -> None:
    _apple(a, "apple_green")


@asset()
def orange(a: Asset) -> None:
    a.add("fruit_geo", ellipsoid((0, 3.7, 0), (3.8, 3.7, 3.8), 18), "orange_peel")


@asset()
def lemon(a: Asset) -> None:
    skin: list[Point2] = [
        (0, -4.2),
        (0.5, -4.1),
        (0.8, -3.5),
        (2.2, -2.2),
        (2.7, 0),
        (2.2, 2.2),
        (0.8, 3.5),
        (0.5, 4.1),
        (0, 4.2),
    ]
    a.add("fruit_geo", moved(lathe(skin), by=(0, 2.7, 0), turn=(0, 0, 90)), "lemon_peel")


@asset()
def bananas(a: Asset) -> None:
    fruit: list[Mesh] = []
    for k in range(3):
        line = bend((-8.5, 3.4, 0), (0, -0.6, 0), (8.5, 3.4, 0), 8)
        one = sweep(line, circle(1.7, 6), widths=[0.3, 0.75, 0.95, 1, 1, 1, 0.95, 0.7, 0.35])
        fruit.append(moved(one, by=(0, 0.35 * (k % 2), 3.45 * (k - 1)), turn=(0, 0, 0)))
    a.add("fruit_geo", merge(*fruit), "banana_peel")
    a.add("stem", box((7.4, 2.6, -4.4), (9.6, 4.2, 4.4), 0.5), "oak_dark")
