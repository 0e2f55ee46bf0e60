"""Bikes on stands, at walls, in the rack and under the ceiling; wheels, tyres and the compressor."""

from benchmarks.scenes.bicycle_shop.parts import (
    Mesh,
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
    BIKE,
    FRAME,
    HELMET,
    LEAVES,
    POT,
    SCREW,
    TYRE,
    WHEEL,
    work_stand,
)

__all__ = ["build_workshop"]

TAG = Asset("price_tag", (tube((0, 0, 0), (0, 0, -8), 0.1), cube(6, 0.3, 9, 0, 0, -16.5), ring(1.6, 0.15, "y")))
BOLT = Asset("bolt", (cyl(0.9, 0.7), tube((0, 0, 0.5), (0, 0, 3.4), 0.4)))
FLAT_TYRE = Asset("flat_tyre", (ring(32.0, 2.2, "z"),))
FLAT_WHEEL = Asset(
    "flat_wheel",
    (
        ring(32.0, 2.2, "z"),
        ring(29.6, 0.8, "z"),
        *(cube(*a, 0.4) for a in ((60, 0.3), (0.3, 60))),
        cyl(1.8, 10, 0, 0, -5),
    ),
)


def build_workshop(shop: Shop) -> None:
    """Add the floor of the workshop."""
    _build_first_stand(shop)
    _build_second_stand(shop)
    _build_wheels(shop.group("Workshop/Wheels", (300, 700, 0)))
    _build_compressor(shop.group("Workshop/Air", (560, 700, 0)))
    _build_wall_bikes(shop.group("Workshop/Wall_bikes", (0, 150, 0), 90))
    _build_window(shop.group("Workshop/Window", (270, 0, 0), 180))
    _build_parking(shop)
    _build_hoist(shop.group("Workshop/Hoist", (440, 560, 0), 8))


def _build_first_stand(shop: Shop) -> None:
    stand = shop.group("Workshop/Stand_1", (280, 500, 0), 25)
    stand.rest("Rubber_mat", cube(150, 120, 1.2, 0, 10), (0, 0, 0))
    stand.rest("Work_stand", work_stand(), (5, 0, 1.2))
    bike = stand.shop.group("Workshop/Stand_1/Road_bike", (0, 0, 61), 0)
    bike.put("Frame", FRAME)
    bike.put("Front_wheel", WHEEL, (52, 0, 34), (0, 12, 0))
    bike.put("Rear_wheel", WHEEL, (-52, 0.2, 34), (0, 31, 0))
    bike.put("Bottle_cage", [_bottle_rings(), cube(1, 5, 14, 3.6, 0, -6)], (9.9, 0, 52.5), (0, 47.7, 0))
    bike.put("Drink_bottle", [cyl(3.4, 15), cyl(2, 3, 0, 0, 15)], (6.2, 0, 49.1), (0, 47.7, 0))
    bike.put("Bell", [cyl(2.2, 2), shift(ring(1.5, 0.4, "y"), 0, 0, -2)], (37, -14, 100))
    bike.put("Service_tag", TAG, (37, 20, 97.7), (0, 0, 12))
    tray = [open_box(34, 26, 3, 0.4), cube(6, 8, 6, 0, 15, 0)]
    stand.put("Tool_tray", tray, (5, 20.5, 100), (0, 0, 3))
    for number, (x, y) in enumerate(((0, 14), (4, 16), (12, 24)), 1):
        stand.rest(f"Bolt_{number}", BOLT, (x, y, 100.4), (0, 0, 40 * number))
    stand.rest("Multi_tool", cube(9, 3, 1.8), (-4, 23, 100.4), (0, 0, 62))
    stand.rest("Chain_cleaner", [cube(12, 5, 7), tube((-6, 0, 4), (-13, 0, 4), 1)], (48, 38, 1.2), (0, 0, 50))
    stand.rest(
        "Work_stool",
        [
            cyl(18, 5, 0, 0, 40),
            cyl(2.4, 38, 0, 0, 4),
            *(tube((0, 0, 5), (x, y, 2), 1.6) for x, y in ((24, 0), (-12, 21), (-12, -21))),
        ],
        (-30, -78, 0.2),
    )


def _bottle_rings() -> Mesh:
    return merge(shift(ring(3.8, 0.3, "z"), 0, 0, 6), shift(ring(3.8, 0.3, "z"), 0, 0, 1))


def _build_second_stand(shop: Shop) -> None:
    stand = shop.group("Workshop/Stand_2", (250, 290, 0), -35)
    stand.rest("Work_stand", work_stand(42, 146), (0, 0, 0))
    stand.put("Bare_frame", FRAME, (-4, 0, 63.6), (0, 0, 0))
    chain = [tube((0, y, 0), (0, y * 1.2, -42), 0.5) for y in (-2.2, 2.2)]
    stand.put("Hanging_chain", [*chain, tube((0, -2.2, 0), (0, 2.2, 0), 0.5)], (16, 0, 149.8))
    stand.put("Removed_wheel", WHEEL, (4, 61, 31.2), (25, 0, 0))
    stand.rest("Wash_bucket", vessel(11, 15, 25, 0.4), (-52, 6, 0))
    stand.put("Wash_sponge", cube(14, 9, 6), (-52, 4, 0.6), (0, 0, 25))
    stand.put(
        "Wash_brush", [tube((0, 0, 0), (0, 0, 32), 1), capsule((0, 0, 2), (0, 0, 10), 2.4)], (-50, 12, 2.8), (13, 10, 0)
    )
    stand.rest(
        "Fork",
        [
            tube((-5, 0, 1.2), (-5, 40, 1.2), 1.2),
            tube((5, 0, 1.2), (5, 40, 1.2), 1.2),
            cube(14, 4, 3, 0, 42),
            tube((0, 43, 1.4), (0, 62, 1.4), 1.4),
        ],
        (20, -60, 0.1),
        (0, 0, 80),
    )
    stand.rest("Cardboard", cube(60, 45, 0.5, 66, 20), (0, 0, 0), (0, 0, 4))
    stand.rest(
        "Crankset",
        [shift(ring(9, 0.5, "z"), 0, 0, 0.5), cube(19, 2.4, 1.4, 8, 0, 0.6), cyl(2.4, 1.6)],
        (66, 20, 0.5),
        (0, 0, 60),
    )


def _build_wheels(wheels: Group) -> None:
    brackets = [block(x, x + 2, -41, 0.2, 207, 212) for x in (-130, -1, 128)]
    wheels.put("Tyre_rail", [merge(*brackets), tube((-131, -40, 209), (131, -40, 209), 1.5)])
    for number, (x, turn, gap) in enumerate(
        ((-116, 2, 0.1), (-106, -3, 0), (-95, 1, -0.3), (-60, -2, 0.3), (-50, 4, 0), (42, 0, -0.2), (53, -5, 0.1)), 1
    ):
        # The inside of a tyre rests on the rail.
        wheels.put(f"Tyre_{number}", TYRE, (x, -40, 210.5 - 29.8 + gap), (0, 0, turn))
    for number, x in enumerate((168, 252), 1):
        wheels.put(
            f"Wheel_hook_{number}",
            [tube((0, 0.3, 0), (0, -9, 0), 0.5), tube((0, -9, 0), (0, -10, 3), 0.5), cube(3, 0.6, 8, 0, -0.3, -4)],
            (x, 0, 202),
        )
        wheels.put(f"Wheel_on_hook_{number}", WHEEL, (x, -5.6, 202.5 - 28.7), (0, 9 * number, 0))
    for number, (x, y, turn) in enumerate(((-92, -44, 0), (-90, -43, 20), (-93, -46, 70)), 1):
        wheels.rest(f"Stacked_wheel_{number}", FLAT_WHEEL, (x, y, 5 + 10 * (number - 1)), (0, 0, turn))
    for number, (x, y) in enumerate(((-8, -44), (-6, -42), (-10, -45), (-7, -43)), 1):
        wheels.rest(f"Piled_tyre_{number}", FLAT_TYRE, (x, y, 2.2 + 4.4 * (number - 1)))
    wheels.rest("Wheel_bag", cube(66, 60, 5), (-8, -44, 17.6), (0, 0, 6))
    wheels.rest("Loan_helmet", HELMET, (-2, -42, 22.6))
    wheels.put("Leaning_wheel_1", WHEEL, (72, -9.6, 33.5), (-13, 0, 0))
    wheels.put("Leaning_wheel_2", WHEEL, (84, -16.2, 32.8), (-17, 0, 0))
    wheels.rest(
        "Floor_pump",
        [
            cube(26, 8, 2),
            cyl(2.2, 55, 0, 0, 2),
            tube((-13, 0, 62), (13, 0, 62), 1.4),
            cyl(0.7, 8, 0, 0, 56),
            tube((2, 2, 6), (12, 6, 40), 0.6),
        ],
        (120, -30, 0),
        (0, 0, 22),
    )
    wheels.put("Flat_carton", cube(70, 8, 72), (190, -19.2, 0.9), (-12, 0, 0))


def _build_compressor(air: Group) -> None:
    tank = [
        capsule((-24, 0, 26), (24, 0, 26), 15),
        *(cube(4, 20, 14, x) for x in (-20, 20)),
        cube(28, 20, 16, 0, 0, 40),
        cyl(7, 12, 8, 0, 54),
    ]
    air.rest("Compressor", tank, (62, -28, 0), (0, 0, 4))
    air.put(
        "Hose_hook",
        [cube(8, 0.8, 12, 0, -0.5, -6), tube((0, 0, 0), (0, -12, 0), 1.6), tube((0, -12, -1), (0, -12, 5), 1.6)],
        (60, 0, 150),
    )
    air.put(
        "Air_hose",
        merge(
            *(shift(ring(r, 0.7), 0.3 * i, -3.4 - 1.5 * i, 151.7 - r + 0.7) for i, r in enumerate((17, 16.4, 17.3, 16)))
        ),
        (60, 0, 0),
    )
    air.put("Blow_gun", [capsule((0, 0, 0), (0, 0, -9), 1.4), tube((0, 0, 0), (9, 0, 3), 0.8)], (78, -6, 134))
    air.rest("Rubbish_bin", vessel(15, 19, 46, 0.5), (-10, -26, 0))
    air.put("Bin_liner", vessel(14, 18.6, 44, 0.2), (-10, -26, 1.2))
    air.put("Old_tube", [shift(ring(9, 1.2, "z"), 0, 0, 1), shift(ring(8, 1.2, "x"), 2, 0, 9)], (-10, -26, 3.4))
    air.put("Torn_box", cube(22, 14, 10), (-10, -25, 14.2), (12, 9, 30))
    broom = [tube((0, 0, 4), (0, 0, 140), 1.3), cube(30, 6, 7)]
    air.put("Broom", broom, (104, -25.9, 0.5), (-10, 0, 0))
    air.rest("Dustpan", [open_box(24, 22, 5, 0.4), capsule((0, 12, 4), (0, 26, 6), 1.2)], (36, -58, 0), (0, 0, 195))


def _build_wall_bikes(wall: Group) -> None:
    wall.put(
        "Bike_hook",
        [
            cube(6, 1, 14, 6, -0.4, -7),
            tube((6, 0, 0), (6, -34.5, 0), 0.8),
            tube((6, -34.5, 0), (-3, -34.5, 0), 0.8),
            tube((-3, -34.5, 0), (-3, -34.5, 3), 0.8),
        ],
        (100, 0, 204),
    )
    # Nose up: both wheels at the wall, the rim of the front one on the hook.
    wall.put("Gravel_bike", BIKE, (100, -0.5, 204.8 - 80.8), (0, -90, 90))
    wall.put("City_bike", BIKE, (-62, -47, 0.1), (-10, 0, 2))
    wall.put(
        "Panniers",
        [cube(30, 10, 30, 0, y, -32) for y in (-12, 12)] + [cube(26, 26, 1, 0, 0, -1)],
        (-116.4, -36.2, 72),
        (-10, 0, 2),
    )
    wall.put("Poster_frame", cube(60, 2, 84, -60, -1.3, 150))
    for number, (x, z) in enumerate(((-88, 231), (-32, 231), (-88, 153), (-32, 153)), 1):
        wall.put(f"Poster_screw_{number}", SCREW, (x, -2.3, z))
    wall.put("Pennant", [tube((-10, 0, 0), (10, 0, 0), 0.5), cube(20, 0.3, 34, 0, -0.1, -34)], (14, -0.6, 226))


def _build_window(window: Group) -> None:
    """Things at the window; it is behind at y = 0, and x goes to the west."""
    loops = [block(x, x + 1.6, y, y + 2, 2, 38) for x in (-100, -92, -30, -22, 40, 48, 70, 78) for y in (-89, -39)]
    bars = [block(-112, 84, -91, -85, 0, 4), block(-112, 84, -41, -35, 0, 4)]
    window.rest("Bike_rack", merge(*bars, *loops), (0, 0, 0))
    for number, (x, dz) in enumerate(((-95, 0.2), (-25, 0), (45, -0.1)), 1):
        window.put(f"Sale_bike_{number}", BIKE, (x, -116, dz), (0, 0, 90))
        window.put(f"Price_tag_{number}", TAG, (x + 15, -79, 97.7 + dz), (0, 0, 84 + 6 * number))
    window.put("Bike_basket", [open_box(36, 26, 22, 0.6), cube(6, 8, 2, 0, -14, 17)], (-95, -60.5, 80))
    window.rest(
        "U_lock",
        [
            tube((-5, 0, 1), (-5, 18, 1), 0.9),
            tube((5, 0, 1), (5, 18, 1), 0.9),
            tube((-8, 0, 1), (8, 0, 1), 1.4),
            tube((-5, 18, 1), (5, 18, 1), 0.9),
        ],
        (-98, -66, 80.6),
        (0, 0, 30),
    )
    window.rest("Rain_cape", cube(18, 10, 5), (-84, -60, 80.6), (0, 0, 80))
    straps = [tube((0, y, 0), (0, 0, -9), 0.4) for y in (-12, 12)]
    window.put("Sale_helmet", [*HELMET.parts, *straps], (-53, -87, 91.6), (180, 0, 90))
    window.rest("Podium", cube(80, 130, 22), (122, -120, 0), (0, 0, -6))
    window.rest("Kids_bike", BIKE, (122, -120, 22), (0, 0, 77), 0.58)
    window.put(
        "Streamer", [capsule((0, 0, 0), (-1, -1, -12), 0.5), capsule((0, 0, 0), (1, 1, -13), 0.5)], (109.3, -103, 78.5)
    )
    window.rest("Podium_sign", [cube(16, 6, 1), cube(15, 0.4, 12, 0, 1, 0.8)], (96, -162, 22), (0, 0, 10))
    for number, x in enumerate((110, -110), 1):
        window.rest(f"Sill_pot_{number}", POT, (x, -10, 90.2), (0, 0, 30 * number))
        window.put(f"Sill_plant_{number}", LEAVES, (x, -10, 101.4), (0, 0, 75 * number))
    window.rest("Display_bell", [cyl(3, 1), shift(vessel(0.5, 3, 2.6, 0.2), 0, 0, 1)], (40, -12, 90.2))
    window.rest(
        "Old_lamp", [cyl(4, 2), tube((0, 0, 2), (0, 0, 8), 0.8), cone(4.5, 7, 0, 0, 7)], (10, -11, 90.2), (0, 0, 40)
    )
    window.rest("Bike_book_1", cube(24, 17, 3), (-40, -12, 90.2), (0, 0, 6))
    window.rest("Bike_book_2", cube(21, 15, 2.4), (-39, -12, 93.2), (0, 0, -9))
    window.put("Leaning_card", cube(14, 0.4, 20), (70, 3.7, 90.3), (-20, 0, 0))


def _build_parking(shop: Shop) -> None:
    cargo = shop.group("Workshop/Cargo", (455, 165, 0), 100)
    frame = [
        tube((-60, 0, 34), (-40, 0, 62), 2),
        tube((-40, 0, 62), (-10, 0, 30), 2.4),
        tube((-10, 0, 24), (72, 0, 22), 2.8),
        tube((-12, 0, 34), (-2, 0, 84), 1.6),
        tube((-2, -28, 98), (-2, 28, 98), 1.2),
        tube((-2, 0, 84), (-2, 0, 98), 1.4),
        capsule((-50, 0, 92), (-38, 0, 92), 3),
        tube((-40, 0, 62), (-44, 0, 91), 1.4),
    ]
    wheels = [
        shift(ring(32, 2.2), -60, 0, 34.2),
        shift(ring(22, 2.2), 60, -36, 24.2),
        shift(ring(22, 2.2), 60, 36, 24.2),
        tube((60, -38, 24), (60, 38, 24), 1.4),
    ]
    cargo.put("Cargo_bike", [*frame, *wheels, cube(60, 30, 1.4, 40, 0, 27)])
    cargo.rest("Cargo_box", open_box(78, 60, 48, 1.8), (44, 0, 28.4))
    cargo.rest("Blanket", [cube(46, 44, 3), cube(26, 26, 3, 6, 4, 2.6)], (33.5, 0, 30.2), (0, 0, 8))
    cargo.rest("Parcel_1", cube(20, 40, 16), (70, 0, 30.2), (0, 0, 2))
    cargo.rest("Parcel_2", cube(16, 22, 10), (70, -4, 46.2), (0, 0, 14))
    cargo.rest(
        "Dog_toy",
        [capsule((-4, 0, 2.2), (4, 0, 2.2), 1.4), *(cyl(2.2, 4.4, x) for x in (-5, 5))],
        (14.5, -12, 33.2),
        (0, 0, 33),
    )
    cargo.put("Box_sticker", cube(30, 0.2, 12), (44, -30.2, 48))
    crate = shop.group("Workshop/Parts_crate", (395, 275, 0), 24)
    crate.rest("Crate", open_box(60, 40, 32, 1.2), (0, 0, 0))
    for number, (x, y, turn, z) in enumerate(
        ((-14, 2, (0, 0, 10), 4.1), (4, -10, (0, 0, -50), 4.1), (-4, -2, (8, 0, 80), 9.6)), 1
    ):
        crate.put(
            f"Scrap_saddle_{number}",
            [capsule((-10, 0, 0), (10, 0, 0), 2.8), cube(12, 12, 3, -8, 0, -1)],
            (x, y, z),
            turn,
        )
    crate.put("Scrap_bar", tube((0, 0, 0), (26, 3, 44.5), 1.3), (10, -2, 2.6))
    trolley = shop.group("Workshop/Gate", (500, 440, 0), -62)
    trolley.rest("Trekking_bike", BIKE, (0, 0, 0))
    trolley.put("Rack_bag", [cube(28, 16, 14), cube(3, 17, 1.4, 0, 0, -1.2)], (-54, 0.4, 72.1), (0, 0, 3))
    trolley.put("Phone_mount", [cube(8, 15, 1.2), shift(ring(1.5, 0.4, "y"), 0, 0, -2.2)], (37, 0, 100.2), (0, -14, 0))
    trolley.put("Spiral_lock", [ring(9, 1.2, "x"), shift(ring(8.7, 1.2, "x"), 1.4, 0, 0)], (0, 0, 75.2), (0, 0, 12))


def _build_hoist(hoist: Group) -> None:
    for number, (x, drop, turn) in enumerate(((37, 54, 0), (-25, 61.8, 90)), 1):
        bows = [((-7, 0, 0), (7, 0, 0)), ((-7, 0, 0), (-7, 0, -12)), ((-7, 0, -12), (2, 0, -12))]
        rope = [tube((a[0], 0, a[2] - drop), (b[0], 0, b[2] - drop), 0.6) for a, b in bows]
        plate = cube(12, 8, 3, 0, 0, -3)
        hoist.put(
            f"Hoist_rope_{number}", [plate, tube((0, 0, 0), (0, 0, -drop), 0.5), *rope], (x, 3, 319.8), (0, 0, turn)
        )
    # The bar lies in one hook, the saddle in the other.
    hoist.put("Hoisted_bike", BIKE, (0, 0, 157.6))
