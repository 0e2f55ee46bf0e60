"""The shop: a counter with a glass top, shelves, a table, plinths and the window."""

import math

from benchmarks.scenes.pottery.shapes import (
    bag,
    box,
    carcass,
    lathe,
    merge,
    moved,
    ribbon,
    ring,
    rod,
    tray,
    tube,
    turned,
    vessel,
)
from benchmarks.scenes.pottery.stage import Group, Pottery, shape
from benchmarks.scenes.pottery.things import (
    BLACK,
    BLUE,
    BRASS,
    BRICK,
    BROWN,
    CELADON,
    CREAM,
    GLASS,
    GREY,
    RED,
    STEEL,
    WHITE,
    WOOD,
    bowl,
    cardboard,
    jar,
    leaning,
    mug,
    plant,
    plate,
    polyline,
    slab,
    table,
    teapot,
    teapot_lid,
    vase,
)

__all__ = ["build_shop"]


def build_shop(pottery: Pottery) -> None:
    """Add the shop."""
    shop = pottery.group(pottery.root, "Shop")
    _build_counter(pottery, pottery.group(shop, "Counter", (120, -100, 0), 3))
    _build_shelves(pottery, pottery.group(shop, "Shelves", (0, -235, 0), 90))
    _build_table(pottery, pottery.group(shop, "Show_table", (250, -210, 0.9), -16))
    _build_window(pottery, pottery.group(shop, "Window_display", (285, -362, 0), 180))
    _build_walls(pottery, pottery.group(shop, "East_side", (400, -190, 0), -90))


def _build_counter(pottery: Pottery, group: Group) -> None:
    base = turned(carcass(140, 46, 60, (32,), plinth=6), 0, 0, 180)
    posts = [box(3, 3, 34, a * 68.5, b * 21.5 + 23, 60) for a in (-1, 1) for b in (-1, 1)]
    pottery.put(group, "Counter", shape(merge(moved(base), *posts), WOOD), (0, -23, 0))
    sides = [box(134, 0.5, 33.6, 0, 22.8 * b, 0) for b in (-1,)] + [box(0.5, 40, 33.6, a * 69.6, 0) for a in (-1, 1)]
    pottery.fix(group, "Showcase_glass", shape(merge(*sides), GLASS, opacity=0.3), (0, 0, 60.2))
    pottery.put(group, "Glass_top", slab(144, 50, 1, GLASS, opacity=0.35), (0, 0, 94.1))
    pottery.put(group, "Ring_dish", bowl(7, 3.5, CELADON), (-48, -4, 60))
    for number, (x, y) in enumerate(((-49.5, -4), (-46, -3)), 1):
        pottery.put(group, f"Clay_ring_{number}", shape(ring(0.9, 1.3, 0.5, 14), BRICK), (x, y, 60.95))
    for number, (x, color) in enumerate(((-28, BLUE), (-2, CREAM)), 1):
        pottery.put(group, f"Tea_bowl_{number}", bowl(6, 6.5, color), (x, -2 + number, 60))
    pottery.put(group, "Velvet_pad", slab(34, 26, 1.2, RED), (44, -2, 60), 4)
    for number, (x, y) in enumerate(((36, -6), (50, 2)), 1):
        pottery.put(
            group,
            f"Brooch_{number}",
            shape(lathe([(0, 0), (2, 0), (1.6, 0.7), (0, 1)], 12), (CELADON, BLUE, BRICK)[number - 1]),
            (x, y, 61.2),
        )
    till = merge(
        box(34, 34, 2, 0, 0, 0),
        box(34, 34, 1.2, 0, 0, 10.5),
        *(box(1.2, 34, 8.5, a * 16.4, 0, 2) for a in (-1, 1)),
        box(31.6, 1.2, 8.5, 0, -16.4, 2),
        turned(moved(box(30, 12, 3), 0, 0, 12), -14),
        box(2, 2, 16, 0, -12, 11),
        box(20, 1.5, 10, 0, -14, 24),
    )
    pottery.put(group, "Till", shape(till, GREY), (34, 0, 95.1), 2)
    drawer = merge(tray(31, 30, 6, 0.6), box(34, 1.2, 9, 0, 15.6, -0.2), *(box(0.4, 28, 4, x, 0, 0.6) for x in (-5, 5)))
    pottery.fix(group, "Till_drawer", shape(drawer, BLACK), (33.4, 17, 97.5), 2)
    coins = merge(
        *(
            moved(
                rod(1.1, 0.25, n=10),
                2 * math.cos(2.4 * i) * (0.3 + 0.07 * i),
                2 * math.sin(2.4 * i) * (0.3 + 0.07 * i),
                0.25 * (i % 4),
            )
            for i in range(14)
        )
    )
    pottery.put(group, "Coins", shape(coins, BRASS), (43, 22, 98.15))
    pottery.put(group, "Banknotes", slab(7, 13, 1, CELADON), (33, 18, 98.1), 4)
    pottery.put(
        group, "Card_reader", shape(merge(box(8, 15, 2.5), box(6.5, 5, 0.2, 0, 3, 2.5)), BLACK), (0, -8, 95.1), -18
    )
    pottery.fix(
        group,
        "Reader_cable",
        polyline([(2.6, -0.7, 96.4), (5, 4, 95.6), (10, 8, 95.45), (14, 6, 95.5), (17, 5, 96.2)], 0.3, BLACK),
        (0, 0, 0),
    )
    pottery.put(group, "Tip_jar", jar(4.5, 11, GLASS, 0.4), (-22, -10, 95.1))
    pottery.put(group, "Tip_coins", shape(merge(coins, moved(coins, 0.4, 0.2, 1)), BRASS), (-22, -10, 95.7))
    pottery.put(group, "Bud_vase", vase(4, 16, BLUE, 0.45), (-55, 6, 95.1))
    pottery.fix(
        group,
        "Dried_flowers",
        shape(
            merge(
                *(
                    tube(
                        [
                            (0.4 * math.cos(a), 0.4 * math.sin(a), 2),
                            (1.1 * math.cos(a), 1.1 * math.sin(a), 15),
                            (5 * math.cos(a), 5 * math.sin(a), 28),
                        ],
                        0.2,
                        5,
                    )
                    for a in (0, 1.6, 3.1, 4.7)
                ),
                *(moved(bag(2.4, 2.4, 3), 5 * math.cos(a), 5 * math.sin(a), 27) for a in (0, 1.6, 3.1, 4.7)),
            ),
            RED,
        ),
        (-55, 6, 94.4),
    )
    pottery.put(group, "Wrapping_roll", shape(turned(rod(5, 60, n=20), 0, 90), CREAM), (6, 1, 37.1))


def _build_shelves(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Bookcase", shape(carcass(170, 32, 196, (44, 82, 120, 158), plinth=6), WOOD), (0, -0.3, 0))
    for number, x in enumerate((-52, 10), 1):
        stand = merge(
            box(9, 12, 0.8, 0, -1),
            box(1, 0.8, 13, 0, 4, 0.8),
            *(box(1, 0.8, 2, a * 3.5, -6, 0.8) for a in (-1, 1)),
            box(8, 1, 0.8, 0, 4, 4),
        )
        pottery.put(group, f"Plate_stand_{number}", shape(stand, BLACK, asset="plate_stand"), (x, -16, 120))
        show = turned(moved(plate(11, CELADON).parts[0].mesh, 0, 0, -0.2), 72)
        pottery.fix(group, f"Show_plate_{number}", shape(show, (CELADON, BLUE, CREAM)[number - 1]), (x, -13.65, 130.75))
    for number, x in enumerate((-60, -22), 1):
        pottery.put(group, f"Teapot_{number}", teapot((BLUE, BROWN)[number - 1]), (x, -16, 82), 170 * number)
        pottery.put(group, f"Teapot_lid_{number}", teapot_lid((BLUE, BROWN)[number - 1]), (x, -16, 93))
    for number, x in enumerate((12, 28, 44), 1):
        pottery.put(group, f"Shop_mug_{number}", mug(CELADON), (x, -15 - number, 82), 60 * number)
        if number == 2:
            pottery.put(group, "Price_tag", slab(4, 0.3, 3, WHITE), (x, -27.5, 82), 3)
    pottery.put(group, "Shop_mug_on_top", mug(CELADON), (28, -16.8, 91.5), -30)
    for number in range(2):
        pottery.put(group, f"Salad_bowl_{number + 1}", bowl(9, 7.5, BRICK), (-58, -16, 44 + 1.35 * number))
        pottery.put(group, f"Dinner_plate_{number + 1}", plate(12, CREAM), (-28, -16, 44 + 0.75 * number))


def _build_table(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Show_table", table(100, 70, 74, WOOD), (0, 0, 0))
    fold = [
        (-37.4, -22),
        (-36.8, -8),
        (-36.2, -0.6),
        (-35.2, 0.25),
        (0, 0.3),
        (35.2, 0.25),
        (36.2, -0.6),
        (36.8, -8),
        (37.4, -20),
    ]
    cloth = turned(turned(ribbon(fold, 0.3, 70), 90), 0, 0, 90)
    pottery.fix(group, "Tablecloth", shape(moved(cloth, -35), CREAM), (0, 0, 74.1))
    tree = merge(
        rod(8, 1.5, n=24),
        rod(1, 34, z=1.5),
        *(
            tube([(0.8 * math.cos(a), 0.8 * math.sin(a), z), (7 * math.cos(a), 7 * math.sin(a), z + 3)], 0.5)
            for a, z in _PEGS
        ),
    )
    pottery.put(group, "Mug_tree", shape(tree, WOOD), (-20, 8, 74.6))
    for number, (angle, height) in enumerate(_PEGS[:3], 1):
        x, y = -20 + 5.6 * math.cos(angle), 8 + 5.6 * math.sin(angle)
        cup = turned(
            merge(
                vessel([(3.6, 0), (4.2, 1.5), (4.2, 9.5)], 0.4),
                tube([(3.9 + 2.6 * math.sin(math.pi * t), 0, 2 + 5.5 * t) for t in [i / 8 for i in range(9)]], 0.5),
            ),
            0,
            -90,
        )
        pottery.fix(
            group,
            f"Tree_mug_{number}",
            shape(moved(turned(moved(cup, 4.75, 0, -6), 0, 0, 90), 0, 0, 0), (BLUE, CELADON, BRICK)[number - 1]),
            (x, y, 74.6 + height + 2.9),
            math.degrees(angle),
        )
    pottery.put(group, "Gift_box", cardboard(18, 18, 12), (14, -16, 74.5), 22)
    pottery.put(
        group,
        "Tissue_paper",
        shape(moved(lathe([(0, 0), (6, 0), (7.5, 4), (7.7, 8), (7, 4.4), (5, 1.4), (0, 1.2)], 9), 0, 0, 0), WHITE),
        (14, -16, 75),
        10,
    )
    pottery.put(group, "Gift_cup", shape(vessel([(3, 0), (3.8, 8)], 0.4, 0.6), CELADON), (14, -16, 76.2))
    pottery.put(
        group,
        "Cake_stand",
        shape(
            merge(
                rod(6, 1, n=24),
                rod(1.5, 8, z=1),
                lathe([(0, 9), (14, 9), (14.4, 10.4), (13.8, 10.4), (13.6, 9.8), (0, 9.8)], 28),
            ),
            CREAM,
        ),
        (22, 16, 74.6),
    )
    pottery.put(group, "Carpet", slab(180, 130, 0.9, BRICK), (0, -6, -0.9))


_PEGS = [(0.4, 26.0), (3.54, 26.0), (1.97, 15.0), (5.1, 15.0)]
"""Azimuth and height of the pegs of the mug tree."""


def _build_window(pottery: Pottery, group: Group) -> None:
    chain = merge(tube([(0, 0, -0.1), (0, 0.1, -20), (0, 0, -40)], 0.2, 6))
    for number, x in ((1, -36), (2, 36)):
        pottery.fix(group, f"Sign_chain_{number}", shape(chain, BRASS, asset="sign_chain"), (x, -30, 280))
    pottery.fix(group, "Shop_sign", shape(box(84, 2, 22, 0, 0, -22), WOOD), (0, -30, 240.1))
    pottery.put(group, "Umbrella_stand", shape(vessel([(11, 0), (12, 48)], 0.6, 1), BROWN), (106, -24, 0))
    at, rot = leaning((106, -24, 0), 11.2, 1, 48, 200, 2.4)
    umbrella = merge(
        lathe([(0, 0), (0.5, 0), (0.7, 8), (2.4, 20), (2.6, 58), (1.2, 64), (0, 64)]),
        rod(0.7, 22, z=62),
        tube([(0, 0, 83), (0, 0, 86), (2, 0, 89), (4, 0, 87)], 0.9),
    )
    pottery.fix(group, "Umbrella", shape(umbrella, BLUE), at, rot=rot)


def _build_walls(pottery: Pottery, group: Group) -> None:
    for number, (x, z) in enumerate(((-60, 170), (-20, 178)), 1):
        show = turned(plate(12, CREAM).parts[0].mesh, 90)
        pottery.wall(group, f"Wall_plate_{number}", shape(show, (CELADON, BLUE, CREAM)[number - 1]), (x, -0.2, z))
    pottery.put(group, "Plinth", shape(box(34, 34, 96), WHITE), (-40, -40, 0), 8)
    pottery.put(group, "Sculpture", vase(10, 26, BROWN, 0.25), (-40, -40, 96), 30)
    dome = lathe(
        [(15, 0), (15, 24), (13, 31), (8, 36), (0, 38), (0, 37.6), (7.8, 35.6), (12.6, 30.8), (14.6, 24), (14.6, 0)]
    )
    pottery.put(group, "Glass_dome", shape(dome, GLASS, opacity=0.25), (-40, -40, 96))
    ceiling = pottery.group(group, "Hanging_planter", (110, -60, 280))
    pottery.fix(
        ceiling,
        "Ceiling_hook",
        shape(
            tube([(0, 0, 0.4), (0, 0, -2), (0, 1.4, -3.2), (0, 1.4, -4.8), (0, 0, -5.8), (0, -1.4, -5)], 0.35), STEEL
        ),
        (0, 0, 0),
    )
    cords = [
        tube(
            [
                (0, 0, 0.25),
                (6 * math.cos(a), 6 * math.sin(a), -30),
                (9.4 * math.cos(a), 9.4 * math.sin(a), -52),
                (8.6 * math.cos(a), 8.6 * math.sin(a), -64.6),
                (0, 0, -66),
            ],
            0.25,
            6,
        )
        for a in (0.3, 2.4, 4.5)
    ]
    pottery.fix(ceiling, "Macrame", shape(merge(*cords), CREAM), (0, 0, -5.45))
    pottery.put(
        ceiling,
        "Hanging_pot",
        shape(lathe([(0, 0), (7.5, 0), (9, 12), (8.6, 12), (8.4, 10), (0, 10)]), CELADON),
        (0, 0, -70.3),
    )
    pottery.fix(ceiling, "Fern", plant(22, 14, 12), (0, 0, -60.2))
