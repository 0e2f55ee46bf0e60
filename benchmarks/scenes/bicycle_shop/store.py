"""The storeroom: a rack, a cabinet of small parts, a pallet and cleaning things."""

from benchmarks.scenes.bicycle_shop.parts import (
    Mesh,
    Scatter,
    Vector,
    ball,
    block,
    capsule,
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
from benchmarks.scenes.bicycle_shop.things import BOTTLE, CARTON, HELMET

__all__ = ["build_store"]

LEVELS = (12.0, 58.0, 103.0, 148.0, 193.0)
"""Heights of the upper faces of the boards of the rack."""
BIN = Asset(
    "storage_bin",
    (
        merge(
            block(-10, 10, -15, 15, 0, 0.5), block(-10, -9.5, -15, 15, 0.5, 12), block(9.5, 10, -15, 15, 0.5, 12),
            block(-9.5, 9.5, 14.5, 15, 0.5, 12), block(-9.5, 9.5, -15, -14.5, 0.5, 6),
        ),
    ),
)  # fmt: skip
SMALL_DRAWER = Asset(
    "small_drawer",
    (merge(shift(open_box(13, 16, 7, 0.3), 0, 8, 0.2), block(-7, 7, -0.6, 0, 0, 8), block(-3, 3, -1.8, -0.6, 2, 3)),),
)
CHAIN_BOX = Asset("chain_box", (cube(16, 12, 5),))
SADDLE = Asset(
    "saddle",
    (
        capsule((0, -9, 5), (0, 9, 5), 2.6),
        cube(13, 9, 3, 0, 7, 3.6),
        *(cube(0.6, 15, 0.6, x, 0, 0) for x in (-2, 2)),
        *(cube(0.6, 0.6, 4, x, y, 0) for x in (-2, 2) for y in (-7, 7)),
    ),
)


def build_store(shop: Shop) -> None:
    """Add what is in the storeroom."""
    rack = shop.group("Store/Rack", (1000, 602, 0), -90)
    posts = [block(x, x + 3, y, y + 3, 0, 205) for x in (-88, 85) for y in (-52, -5)]
    boards = [block(-88, 88, -52, -2, z - 2.5, z) for z in LEVELS]
    rack.rest("Rack", merge(*posts, *boards), (0, 0, 0))
    _fill_low_boards(rack)
    _fill_high_boards(rack)
    _build_cabinet(shop.group("Store/Small_parts", (790, 700, 0)))
    _build_pallet(shop.group("Store/Goods", (868, 560, 0), 6))
    _build_cleaning(shop.group("Store/Cleaning", (700, 640, 0), 90))


def _fill_low_boards(rack: Group) -> None:
    z = LEVELS[0]
    rack.rest("Carton_1", CARTON, (-58, -28, z), (0, 0, 4))
    rack.rest("Carton_2", CARTON, (-12, -27, z), (0, 0, -3))
    rack.put("Carton_3", CARTON, (-14, -26, z + 26.1), (0, 0, 8), 0.6)
    rack.rest("Pump_case", cube(30, 22, 14), (42, -28, z), (0, 0, 12))
    z = LEVELS[1]
    for number, x in enumerate((-70, -48, -26.5, -5, 16), 1):
        rack.rest(f"Bin_{number}", BIN, (x, -31, z), (0, 0, (-1) ** number))
    bolts: list[Vector] = [(2.6 * i, 2.8 * j, 0.8 + 0.7 * ((i + j) % 3)) for i in range(-2, 3) for j in range(-4, 4)]
    rack.put("Bolts", Scatter(tube((-1.2, 0, 0), (1.2, 0.6, 0.2), 0.4), bolts), (-70, -31, z + 0.4))
    nuts: list[Vector] = [(2.2 * i, 2.1 * j, 0.9 * ((i * j) % 2)) for i in range(-3, 4) for j in range(-4, 3)]
    rack.put("Nuts", Scatter(cyl(0.9, 0.8), nuts), (-48, -31, z + 0.6))
    for number, (x, y, up) in enumerate(((-29, -36, 0), (-24, -30, 0), (-27, -33, 1.6)), 1):
        rack.rest(f"Brake_pad_{number}", cube(7, 2.4, 1.5), (x, y, z + 0.5 + up), (0, 0, 35 * number))
    rack.rest("Pedal_1", [cube(9, 9, 2.4), tube((4, 0, 1.2), (8, 0, 1.2), 0.7)], (-6, -38, z + 0.5), (0, 0, 75))
    rack.rest("Pedal_2", [cube(9, 9, 2.4), tube((4, 0, 1.2), (8, 0, 1.2), 0.7)], (-5, -26, z + 0.5), (0, 0, 60))
    rack.rest("Lubricant_1", [cyl(3, 16), cyl(1, 3, 0, 0, 16)], (48, -20, z))
    rack.rest("Lubricant_2", [cyl(3, 16), cyl(1, 3, 0, 0, 16)], (55, -22, z))
    rack.rest("Lubricant_3", [cyl(3, 16), cyl(1, 3, 0, 0, 16)], (52, -28.5, z))
    for number, (x, width) in enumerate(((-70, 14), (-26, 14), (50, 18)), 1):
        rack.put(f"Shelf_label_{number}", cube(width, 0.2, 2.2, x, -52.2, z - 2.4))


def _fill_high_boards(rack: Group) -> None:
    z = LEVELS[2]
    places = ((-72, -26, 0), (-54.6, -25, 0), (-72.4, -25.5, 1), (-55, -26, 1), (-63, -26, 2))
    for number, (x, y, level) in enumerate(places, 1):
        rack.rest(f"Chain_box_{number}", CHAIN_BOX, (x, y, z + 5 * level), (0, 0, 2 * number - 6))
    rack.rest("Helmet_box", cube(34, 28, 20), (-18, -28, z), (0, 0, -5))
    rack.rest("Spare_helmet", HELMET, (-17, -28, z + 20), (0, 0, 30))
    for number, x in enumerate((16, 34, 53), 1):
        rack.rest(f"Saddle_{number}", SADDLE, (x, -30, z), (0, 0, 7 * number - 12))
    z = LEVELS[3]
    crate = merge(
        open_box(30, 40, 12, 1), block(-0.4, 0.4, -19, 19, 1, 10), *(block(-14, 14, y, y + 0.8, 1, 10) for y in (-7, 6))
    )
    rack.rest("Bottle_crate", crate, (-60, -28, z), (0, 0, 3))
    for number, (x, y) in enumerate(((-7, -13), (7.2, -13), (-7, 0), (7, 13)), 1):
        rack.put(f"Bottle_{number}", BOTTLE, (-60 + x, -28 + y, z + 1.2 - 0.1 * number), (0, 0, 0))
    rack.rest("Rim_tape_tin", vessel(9, 9, 9, 0.3), (-20, -28, z))
    for number in (1, 2):
        rack.rest(
            f"Rim_tape_{number}",
            shift(ring(6, 1.2, "z"), 0, 0, 1.2),
            (-20 + 0.6 * number, -28, z + 0.4 + 2.5 * (number - 1)),
        )
    rack.rest("Manual_1", cube(3, 20, 28), (14, -26, z))
    rack.rest("Manual_2", cube(4, 21, 29), (17.8, -26, z))
    rack.put("Manual_3", cube(3, 20, 27), (26.6, -26, z + 0.4), (0, -12, 0))
    rack.rest("Hub_box", cube(14, 14, 14), (56, -30, z), (0, 0, 20))
    z = LEVELS[4]
    rack.rest("Banner", tube((-80, 0, 6), (96, 0, 6), 6), (4, -36, z), (0, 0, 2))
    rack.rest(
        "Child_seat",
        [cube(30, 20, 6), cube(30, 4, 40, 0, 8, 4), cube(3, 18, 14, -14, 0, 4), cube(3, 18, 14, 14, 0, 4)],
        (-50, -16, z),
        (0, 0, -4),
    )
    rack.put(
        "Rack_hook",
        [
            cube(0.5, 3, 6, 88.2, -50.5, 164),
            tube((88.2, -50.5, 166), (95, -50.5, 166), 0.4),
            tube((95, -50.5, 166), (95, -50.5, 168), 0.4),
        ],
    )
    rack.put("Strap_bundle", [shift(ring(7, 0.9, "x"), x, 0, 0) for x in (-1.2, 0.7)], (91.6, -50.5, 160.3), (0, 0, 4))


def _build_cabinet(parts: Group) -> None:
    columns, rows = (-45.0, -30.2, -15.4, -0.6), (0.8, 9.8, 18.8, 27.8)
    parts.put("Drawer_cabinet", _grid(), (0, -0.3, 112))
    number = 0
    for z in rows:
        for x in columns:
            number += 1
            out = {6: 7.0, 11: 0.5}.get(number, 0.0)
            parts.put(f"Drawer_{number}", SMALL_DRAWER, (x + 22.8, -18.6 - out, 112 + z))
    screws: list[Vector] = [(1.6 * i, 1.9 * j, 0.4 * ((i + 2 * j) % 3)) for i in range(-3, 4) for j in range(-3, 4)]
    copy = tube((-0.8, 0, 0), (0.8, 0, 0), 0.25)
    parts.put("Spoke_nipples", Scatter(copy, screws), (22.8 - 30.2, -17.6, 112 + 9.8 + 0.8))
    parts.put("Wood_screws", Scatter(copy, screws), (22.8 - 45, -10.6, 112 + 0.8 + 0.8))
    parts.put("Valve_cap_bag", capsule((-2.4, 0, 2), (2.4, 0, 2), 1.8), (22.8 - 15.4, -10.6, 112 + 18.8 + 0.3))
    table = merge(
        block(-55, 55, -60, -2, 82, 86),
        *(block(x, x + 5, y, y + 5, 0, 82) for x in (-53, 48) for y in (-58, -9)),
        block(-52, 52, -56, -6, 24, 26),
    )
    parts.rest("Packing_table", table, (0, 0, 0))
    parts.rest("Parcel_scale", [cube(30, 26, 5), cube(26, 24, 1, 0, 2, 5)], (-30, -34, 86), (0, 0, 3))
    parts.rest("Saddle_bag", [capsule((-5, 0, 5), (5, 0, 5), 5)], (-30, -32, 92), (0, 0, 25))
    parts.rest("Open_carton", open_box(36, 28, 22, 0.5), (24, -36, 86), (0, 0, -8))
    parts.rest("Brake_disc_1", cyl(8, 0.3), (20, -36, 86.6))
    parts.rest("Brake_disc_2", cyl(8, 0.3), (21, -35, 87.0))
    parts.put("Packing_paper", [ball(6, 30, -36, 92.6), ball(4.6, 23, -33, 92.2)])
    parts.rest("Tape_gun", [shift(ring(4, 1.6, "y"), 0, 0, 5.6), cube(4, 3, 11, 7, 0, 0)], (-4, -16, 86), (0, 0, 40))
    parts.rest("Knife", cube(15, 2, 1.6), (-6, -48, 86), (0, 0, -25))
    parts.rest("Bubble_roll", tube((-40, 0, 14), (6, 0, 14), 14), (-4, -32, 26))
    parts.rest("Tool_case", cube(34, 28, 12), (26, -30, 26), (0, 0, -6))
    ladder = merge(
        *(block(x, x + 4, -1.5, 1.5, 0, 230) for x in (-22, 18)),
        *(block(-18, 18, -1.2, 1.2, z, z + 3) for z in range(24, 220, 28)),
    )
    parts.put("Ladder", ladder, (95, -46, 0.3), (-11, 0, 0))


def _grid() -> Mesh:
    """A cabinet of four by four compartments, open to the front."""
    sides = [block(x, x + 0.8, -18, 0, 0, 36.8) for x in (-30, -15.2, -0.4, 14.4, 29.2)]
    floors = [block(-29.2, 29.2, -18, 0, z, z + 0.8) for z in (0.0, 9.0, 18.0, 27.0, 36.0)]
    return merge(*sides, *floors, block(-29.2, 29.2, -0.5, 0, 0.8, 36))


def _build_pallet(goods: Group) -> None:
    slats = [block(-40, 40, y, y + 10, 11.6, 13.6) for y in (-60, -43, -26, -9, 8, 25, 42)]
    runners = [block(x, x + 8, -60, 52, 0, 11.6) for x in (-40, -4, 32)]
    goods.rest("Pallet", merge(*slats, *runners), (0, 0, 0))
    goods.rest("Bike_carton", cube(70, 22, 66), (2, -38, 13.6), (0, 0, 3))
    goods.rest("Tyre_carton", cube(66, 50, 24), (0, 16, 13.6), (0, 0, -2))
    goods.rest("Small_carton", cube(40, 30, 20), (-8, 18, 37.6), (0, 0, 15))
    goods.rest("Delivery_note", cube(15, 21, 0.1), (-6, 18, 57.6), (0, 0, 30))
    goods.put("Address_label", cube(16, 0.1, 10, 10, -49.3, 52), (0, 0, 0), (0, 0, 3))
    goods.put("Leaning_board", cube(60, 2, 90), (4, -56.2, 13.7), (-5.5, 0, 0))


def _build_cleaning(cleaning: Group) -> None:
    cleaning.put(
        "Hook_rail",
        [
            cube(116, 2, 8, -2, -1.3, 168),
            *(tube((x, -2, 171), (x, -8, 171), 0.5) for x in (-54, -20, 10, 49)),
            *(tube((x, -8, 171), (x, -8.5, 174), 0.5) for x in (-54, -20, 10, 49)),
        ],
    )
    cleaning.put("Apron", [ring(2, 0.3, "y"), cube(46, 1.4, 78, 0, 0.6, -80)], (-54, -5, 169.9))
    cleaning.put(
        "Hanger",
        [
            ring(1.9, 0.25),
            tube((0, 0, -1.8), (0, 0, -6), 0.25),
            tube((0, 0, -6), (-20, 0, -13), 0.6),
            tube((0, 0, -6), (20, 0, -13), 0.6),
            tube((-20, 0, -13), (20, 0, -13), 0.5),
        ],
        (10, -6, 169.9),
        (0, 0, 12),
    )
    cleaning.put(
        "Work_coat",
        [
            cube(42, 7, 82, 0, 0, -96),
            capsule((-23, 0, -18), (-25, 0, -62), 4),
            capsule((23, 0, -18), (25, 0, -62), 4),
            tube((-19, 0, -12.8), (19, 0, -12.8), 1.6),
        ],
        (10, -7, 169.9),
        (0, 0, 12),
    )
    cleaning.put("Cable_coil", [shift(ring(9, 1.1), 0, y, 0) for y in (-1.6, 0.6)], (49, -5, 163.7))
    cleaning.rest(
        "Vacuum_cleaner",
        [
            capsule((-14, 0, 16), (14, 0, 16), 14),
            *(cyl(3, 3, x, y) for x in (-14, 14) for y in (-9, 9)),
            tube((28, 0, 18), (44, 10, 20), 2.2),
        ],
        (-20, -38, 0),
        (0, 0, 70),
    )
    cleaning.rest("Mop_bucket", [vessel(13, 17, 27, 0.5)], (-50, -95, 0))
    cleaning.put("Mop", [tube((0, 0, 8), (0, 0, 128), 1.2), cyl(9, 8)], (-50, -94, 1.4), (0, 9, 0))
    cleaning.rest("Cleaner", [cube(8, 6, 20), cyl(1.6, 5, 0, 0, 20)], (8, -14, 0))
