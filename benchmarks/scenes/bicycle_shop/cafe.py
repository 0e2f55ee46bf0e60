"""Where the guests of the café sit, and the display case between café and workshop."""

from benchmarks.scenes.bicycle_shop.bar import build_bar
from benchmarks.scenes.bicycle_shop.parts import (
    ball,
    block,
    capsule,
    cone,
    cube,
    cyl,
    merge,
    open_box,
    ring,
    shift,
    tube,
    vessel,
)
from benchmarks.scenes.bicycle_shop.stage import Asset, Group, Shop
from benchmarks.scenes.bicycle_shop.things import (
    CHAIR,
    CUP,
    GLASS,
    HELMET,
    LEAVES,
    PICTURE,
    PLATE,
    POT,
    SAUCER,
    SCREW,
    SPOON,
    coat,
)

__all__ = ["build_cafe"]

MAGAZINE = Asset("magazine", (cube(21, 29, 0.6),))
UMBRELLA = Asset(
    "umbrella",
    (
        tube((0, 0, 0), (0, 0, 12), 0.4),
        cone(3.2, 58, 0, 0, 12),
        tube((0, 0, 66), (0, 0, 84), 0.6),
        shift(ring(3, 0.6, "y"), 3, 0, 84),
    ),
)
CUSHION = Asset("cushion", (cube(42, 40, 5), cube(36, 34, 7, 0, 0, -1)))


def build_cafe(shop: Shop) -> None:
    """Add the café in the south-east corner."""
    build_bar(shop)
    corner = shop.group("Cafe/Corner")
    _build_bench(corner)
    corner.rest("Rug", cyl(85, 0.8, 855, 135), (0, 0, 0))
    _build_round_table(shop.group("Cafe/Table_1", (858, 118, 0.8), 31))
    _build_chairs(corner)
    _build_square_table(shop.group("Cafe/Table_2", (712, 240, 0), -18))
    _build_entrance(shop.group("Cafe/Entrance"))
    _build_display(shop.group("Cafe/Display", (600, 330, 0), 84))


def _build_bench(corner: Group) -> None:
    seat = [block(790, 998, 2, 47, 8, 45), block(953, 998, 47, 165, 8, 45)]
    plinth = [block(794, 998, 2, 43, 0, 8), block(957, 998, 43, 161, 0, 8)]
    corner.rest("Corner_bench", merge(*seat, *plinth), (0, 0, 0))
    corner.put("Back_board", cube(206, 2.4, 36, 894, 1.5, 47))
    corner.rest("Cushion_1", CUSHION, (816, 25, 46), (0, 0, 3))
    corner.rest("Cushion_2", CUSHION, (864, 25, 46), (0, 0, -4))
    corner.rest("Cushion_3", CUSHION, (975, 90, 46), (0, 0, 88))
    corner.put("Throw_pillow", [cube(40, 10, 40), cube(32, 14, 32, 0, 0, 4)], (866, 20.5, 51.6), (17, 0, -3))
    corner.rest("Paperback", cube(12, 18, 2), (820, 27, 51), (0, 0, 24))
    bag = [cube(30, 16, 40), capsule((-12, -10, 12), (12, -10, 12), 3.5), shift(ring(4, 0.7, "x"), 0, 2, 41)]
    corner.put("Backpack", bag, (974, 134, 45.2), (0, 0, -86))
    corner.rest("Cycling_cap", [cyl(9, 6), cube(12, 8, 0.6, 0, -11, 0)], (976, 88, 51.2), (0, 0, 60))
    for number, (x, y, z, turn) in enumerate(((836, 0.4, 172, 180), (906, 0.2, 176, 180), (999.7, 100, 174, -90)), 1):
        corner.put(f"Picture_{number}", PICTURE, (x, y, z), (0, 0, turn))
    for number, z in enumerate((200, 148), 1):
        corner.put(f"Picture_screw_{number}", SCREW, (997.7, 100, z), (0, 0, -90))
    corner.put(
        "Wall_lamp",
        [cube(10, 3, 16, 0, -1.4, -8), tube((0, -2, 0), (0, -14, 6), 0.8), cone(9, 13, 0, -15, -1)],
        (1000, 40, 168),
        (0, 0, -90),
    )


def _build_round_table(table: Group) -> None:
    table.rest("Bistro_table", [cyl(38, 3, 0, 0, 71), cyl(3, 69, 0, 0, 2.6), cyl(24, 3)], (0, 0, 0))
    z = 74.0
    table.rest("Saucer", SAUCER, (-18, -14, z))
    table.rest("Cup", CUP, (-18, -14, z + 0.5), (0, 0, 250))
    table.rest("Spoon", SPOON, (-22, -9.4, z + 1.6), (0, 0, 40))
    table.rest("Plate", PLATE, (10, -22, z))
    croissant = [capsule((-5, 0, 2), (0, 2, 2.4), 2), capsule((0, 2, 2.4), (5, 0, 2), 2)]
    table.rest("Croissant", croissant, (10, -22, z + 0.4), (0, 0, 15))
    table.rest("Fork", cube(17, 1.4, 0.3), (17, -18.5, z + 1.9), (0, 0, 70))
    table.rest("Newspaper", cube(30, 21, 1), (-10, 16, z), (0, 0, 28))
    table.rest(
        "Sunglasses",
        [cube(14, 0.6, 4), *(tube((x, 0, 3), (x, 10, 1), 0.3) for x in (-6.6, 6.6))],
        (-9, 13, z + 1),
        (0, 0, 10),
    )
    table.rest("Vase", vessel(2.6, 3.4, 14, 0.3), (6, 2, z))
    table.put("Daisy", [tube((0, 0, 0.6), (2.2, 0.6, 22), 0.25), cyl(3, 0.6, 2.4, 0.7, 22)], (6, 2, z))
    table.rest("Phone", cube(7.4, 15, 0.9), (24, 12, z), (0, 0, -32))
    table.rest("Candle_glass", vessel(3.4, 3.8, 6, 0.3), (14, -6, z))
    table.put("Tea_light", cyl(2, 1.6, 14, -6, z + 0.4))


def _build_chairs(corner: Group) -> None:
    at, turn = (806.0, 150.0, 1.0), (0.0, 0.0, 56.0)
    corner.put("Chair_1", CHAIR, at, turn)
    jacket = [cube(43, 1.4, 46, 0, 21, 41), cube(43, 6.4, 1.2, 0, 18.4, 86.2), cube(41, 1.2, 22, 0, 15.8, 65)]
    corner.put("Rain_jacket", jacket, at, turn)
    corner.rest("Chair_2", CHAIR, (866, 212, 0.6), (0, 0, 4))
    straps = [tube((x, 16.4, 87), (x, 23, 66), 0.5) for x in (-8, 8)] + [tube((-8, 18, 86.9), (8, 18, 86.9), 0.5)]
    corner.put("Tote_bag", [*straps, cube(32, 8, 34, 0, 24.2, 33)], (866, 212, 0.6), (0, 0, 4))
    corner.rest("Shoulder_bag", [cube(30, 12, 24), capsule((-10, 0, 25), (10, 0, 25), 1)], (895, 96, 0.8), (0, 0, 40))
    corner.rest("Ball", ball(6, 0, 0, 6), (800, 92, 0.8))


def _build_square_table(table: Group) -> None:
    legs = [block(x, x + 4, y, y + 4, 0, 72) for x in (-28, 24) for y in (-28, 24)]
    table.rest("Cafe_table", merge(block(-30, 30, -30, 30, 72, 75), *legs), (0, 0, 0))
    cloth = [
        cube(66, 66, 0.4),
        *(cube(66, 0.3, 16, 0, y, -16) for y in (-32.8, 32.8)),
        *(cube(0.3, 66, 16, x, 0, -16) for x in (-32.8, 32.8)),
    ]
    table.put("Tablecloth", cloth, (0, 0, 75.2))
    z = 75.6
    table.rest("Laptop", [cube(33, 23, 1.6), cube(33, 1, 22, 0, 12, 1.2)], (-4, 10, z), (0, 0, 8))
    table.rest("Latte_glass", GLASS, (-20, -14, z))
    table.put("Long_spoon", [tube((0, 0, 0), (0, 0, 19), 0.25), ball(1, 0, 0, 0.6)], (-20.6, -14, z + 0.5), (5, 7, 0))
    for number, (x, y) in enumerate(((18, -17), (18.6, -16), (17, -18)), 1):
        table.rest(f"Magazine_{number}", MAGAZINE, (x, y, z + 0.6 * (number - 1)), (0, 0, 9 * number - 16))
    table.rest("Sugar_shaker", [cyl(3.4, 11), cone(3.4, 4, 0, 0, 11)], (22, 11, z))
    table.rest("Shopping_bag", open_box(34, 18, 36, 0.3), (-6, -4, 0), (0, 0, 22))
    table.put("Baguette", capsule((0, 0, 4), (0, 0, 56), 3.2), (-4, -2, 1.0), (5, 9, 0))
    table.put("Apple", ball(4, -10, -7, 4.4))
    table.rest("Chair_3", CHAIR, (2, 52, 0), (0, 0, 5))
    table.rest("Chair_4", CHAIR, (-4, -54, 0), (0, 0, 191))
    table.put(
        "Scarf",
        [cube(14, 1, 40, -4, 20.8, 47), cube(14, 5.4, 1, -4, 18.2, 86.2), cube(14, 1, 30, -4, 16, 57)],
        (2, 52, 0),
        (0, 0, 5),
    )
    table.rest("Seat_pad", cube(38, 37, 3), (-4, -54, 46), (0, 0, 188))


def _build_entrance(entrance: Group) -> None:
    arms = [tube((0, 0, 168), (18 * x, 18 * y, 176), 1) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    feet = [tube((0, 0, 6), (24 * x, 24 * y, 1.4), 1.4) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    entrance.rest(
        "Coat_stand", [tube((0, 0, 3), (0, 0, 182), 2), ball(3.4, 0, 0, 183), *arms, *feet], (700, 62, 0), (0, 0, 20)
    )
    # The arms point to 20, 110, 200 and 290 degrees; a loop hangs behind the end of an arm.
    entrance.put("Winter_coat", coat(96), (713.1, 66.8, 173.9), (0, 0, 110))
    entrance.put("Fleece", coat(70), (686.9, 57.2, 173.9), (0, 0, -70))
    entrance.put("Hat", [cyl(14, 1, 0, 0, 0), cyl(8.5, 10, 0, 0, 0.8)], (700, 62, 182.6), (6, 0, 0))
    entrance.rest("Umbrella_stand", vessel(11, 12, 52, 0.6), (664, 62, 0))
    entrance.put("Umbrella_1", UMBRELLA, (661, 60, 0.9), (3, -6, 0))
    entrance.put("Umbrella_2", UMBRELLA, (667, 64, 0.7), (-2, 6, 0))
    rack = merge(
        block(-24, 24, 0, 1, 0, 34),
        block(-24, 24, 8, 9, 0, 16),
        block(-24, -23, 1, 8, 0, 20),
        block(23, 24, 1, 8, 0, 20),
        block(-23, 23, 1, 8, 0, 1),
    )
    entrance.put("Leaflet_rack", rack, (752, 0.3, 96))
    for number, (x, y) in enumerate(((-11, 2.6), (10, 4.2), (10.6, 5.2)), 1):
        entrance.put(f"Leaflet_{number}", cube(14.8, 0.5, 21), (752 + x, y + 0.3, 97.1), (-4, 0, 0))
    entrance.rest("Dog_bed", vessel(26, 31, 15, 7), (742, 102, 0))
    entrance.rest("Dog_blanket", [cyl(19, 3), cube(18, 16, 3, 5, 2, 2)], (742, 102, 7))
    entrance.rest(
        "Dog_bone",
        [capsule((-5, 0, 1.6), (5, 0, 1.6), 1.2), *(ball(1.9, x, y, 1.9) for x in (-6, 6) for y in (-1.2, 1.2))],
        (735, 92, 10),
        (0, 0, 50),
    )
    entrance.rest("Water_bowl", vessel(10, 8.6, 6, 0.5), (779, 66, 0))
    entrance.rest("Plant_saucer", vessel(17, 19, 3, 0.6), (668, 452, 0))
    entrance.rest("Floor_pot", POT, (668, 452, 0.7), (0, 0, 40), 2.1)
    entrance.put("Rubber_plant", LEAVES, (668, 452, 23.6), (0, 0, 40), 2.6)


def _build_display(display: Group) -> None:
    glass = [
        block(-55, 55, -25, 25, 92, 93.2),
        block(-55, -54.2, -25, 25, 48, 92),
        block(54.2, 55, -25, 25, 48, 92),
        block(-54.2, 54.2, -25, -24.2, 48, 92),
        block(-54.2, 54.2, 24.2, 25, 48, 92),
    ]
    display.rest(
        "Display_case", merge(block(-55, 55, -25, 25, 4, 48), block(-52, 52, -22, 22, 0, 4), *glass), (0, 0, 0)
    )
    z = 48.0
    for number, x in enumerate((-42, -32, -21), 1):
        display.rest(
            f"Front_light_{number}",
            [capsule((-3, 0, 2.4), (3, 0, 2.4), 2.2), cyl(1.4, 2, 0, 0, 0)],
            (x, -6, z),
            (0, 0, 80),
        )
    display.rest("Riser", cube(50, 20, 8), (22, 8, z), (0, 0, 1))
    display.rest(
        "Chain_lock", [shift(ring(7, 1.2, "z"), 0, 0, 1.2), cube(7, 4, 3, 7, 0, 0)], (10, 8, z + 8), (0, 0, 25)
    )
    display.rest("Cycle_computer", cube(6, 8, 2), (32, 8, z + 8), (0, 0, -10))
    display.rest(
        "Saddle_on_show",
        [capsule((-9, 0, 5), (9, 0, 5), 2.8), cube(10, 13, 3, -7, 0, 3.4), cube(14, 5, 4)],
        (-30, 12, z),
        (0, 0, 10),
    )
    display.rest("Price_card", [cube(9, 4, 0.4), cube(9, 0.4, 6, 0, 1, 0)], (18, -12, z), (0, 0, 5))
    z = 93.2
    display.rest("Loan_form", cube(21, 30, 0.4), (-30, -2, z), (0, 0, 12))
    display.put("Pencil", capsule((-7, 0, 0.4), (7, 0, 0.4), 0.35), (-28, -1, z + 0.5), (0, 0, 55))
    display.rest("Helmet_display", [cyl(10, 1.6), cyl(1.4, 18, 0, 0, 1.6), ball(8, 0, 0, 20)], (34, 2, z))
    display.put("New_helmet", HELMET, (34, 2, z + 14.3), (0, 0, 15))
    display.rest("Sticker_bowl", vessel(5, 9, 5, 0.4), (4, -8, z))
    display.put(
        "Stickers", [cube(7, 5, 0.6, 0, 0, 0.6), cube(6, 6, 0.6, 0.5, 1, 1.3), cube(7, 4, 0.5, -1, 0, 2)], (4, -8, z)
    )
