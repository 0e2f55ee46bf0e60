"""The bar of the café: a counter with a recess for the sink, one to the guests, shelves and a fridge."""

from benchmarks.scenes.bicycle_shop.parts import (
    Mesh,
    Scatter,
    Vector,
    ball,
    block,
    capsule,
    cone,
    cube,
    cyl,
    lathe,
    merge,
    open_box,
    ring,
    shift,
    tube,
    vessel,
)
from benchmarks.scenes.bicycle_shop.stage import Asset, Group, Shop
from benchmarks.scenes.bicycle_shop.things import BOTTLE, CUP, GLASS, LEAVES, MUG, PLATE, POT, SAUCER, SPOON, STOOL

__all__ = ["build_bar"]

BACK = 90.0
"""Height of the counter at the wall."""
FRONT = 108.0
"""Height of the counter to the guests."""
CUP_HOOK = Asset(
    "cup_hook",
    (tube((0, 0, 0.3), (0, 0, -3), 0.25), tube((0, 0, -3), (0, -3, -3), 0.25), tube((0, -3, -3), (0, -3, -1.5), 0.25)),
)
JAR = Asset("jar", (vessel(5, 5.4, 15, 0.3), cyl(5.6, 2, 0, 0, 14.8), ball(1, 0, 0, 17.4)))
TIN = Asset("tea_tin", (cube(9, 9, 14), cyl(3.6, 1.6, 0, 0, 13.8)))
CARTON = Asset("milk_carton", (cube(7, 7, 19), cube(7, 1, 3, 0, 0, 18.8)))
JUICE = Asset("juice_bottle", (cyl(3.4, 16), cone(3.4, 6, 0, 0, 16), cyl(1.5, 4, 0, 0, 19)))


def build_bar(shop: Shop) -> None:
    """Add the bar; in its frame, the east wall is at y = 0 and the guests sit at low y."""
    bar = shop.group("Cafe/Bar", (1000, 340, 0), -90)
    _build_back_counter(bar)
    _fill_back_counter(bar)
    _build_shelves(bar)
    _build_fridge(shop.group("Cafe/Bar/Fridge", (135, -3, 0)))
    _build_front_counter(bar)
    _fill_front_counter(bar)


def _build_back_counter(bar: Group) -> None:
    top = [
        block(-100, 40, -60, -1, 86, 90),
        block(80, 100, -60, -1, 86, 90),
        block(40, 80, -60, -50, 86, 90),
        block(40, 80, -16, -1, 86, 90),
    ]
    panels = [block(x, x + 2, -58, -2, 8, 86) for x in (-100, -1, 98)]
    boards = [
        block(-98, 98, -58, -2, 8, 10),
        block(-98, -1, -56, -2, 44, 46),
        block(-98, 98, -3, -2, 10, 86),
        block(-98, 98, -52, -4, 0, 8),
    ]
    bar.rest("Back_counter", merge(*top, *panels, *boards), (0, 0, 0))
    for number, x in enumerate((25.2, 74.8), 1):
        bar.put(f"Door_{number}", cube(48.8, 1.8, 76, x, -59.1, 9.4))
        bar.put(
            f"Knob_{number}",
            [ball(1.4, 0, -1.6), tube((0, 0.3, 0), (0, -1.4, 0), 0.5)],
            (45 if number == 1 else 55, -60, 72),
        )
    bar.put(
        "Sink",
        [
            shift(open_box(39.4, 33.4, 15, 0.4), 0, 0, -14.9),
            shift(
                merge(
                    block(-22, 22, -19, -16.3, 0, 0.3),
                    block(-22, 22, 16.3, 19, 0, 0.3),
                    block(-22, -19.3, -16.3, 16.3, 0, 0.3),
                    block(19.3, 22, -16.3, 16.3, 0, 0.3),
                ),
                0,
                0,
                0,
            ),
        ],
        (60, -33, BACK + 0.1),
    )
    tap = [
        cyl(2.4, 4),
        tube((0, 0, 3), (0, 0, 24), 1.2),
        tube((0, 0, 24), (0, -16, 22), 1),
        tube((2, 0, 3), (8, -1, 5), 0.7),
    ]
    bar.rest("Tap", tap, (60, -8.5, BACK))
    bar.put("Drain_pipe", [tube((60, -33, 75.5), (60, -33, 55), 2), tube((60, -33, 55), (60, -2, 52), 2)])
    bar.put(
        "Towel_rail",
        [tube((12, -63, 62), (38, -63, 62), 0.7), *(tube((x, -63, 62), (x, -59.8, 62), 0.7) for x in (12, 38))],
    )
    bar.put(
        "Tea_towel",
        [cube(20, 0.5, 30, 25, -64.2, 33), cube(20, 3, 0.5, 25, -63, 62.8), cube(20, 0.5, 22, 25, -61.8, 41)],
    )


def _fill_back_counter(bar: Group) -> None:
    machine = merge(
        block(-36, 36, -24, 20, 0, 7),
        block(-36, 36, 0, 20, 7, 42),
        block(-36, 36, -22, 20, 30, 42),
        *(block(x, x + 1, -21, 19, 42, 45) for x in (-36, 35)),
    )
    heads = [cyl(3.8, 5, x, -12, 25.4) for x in (-16, 14)]
    bar.rest("Espresso_machine", [machine, *heads, tube((30, -18, 31), (27, -20, 15), 0.5)], (-48, -31, BACK))
    bar.put("Drip_tray", open_box(62, 20, 2, 0.3), (-48, -43.5, BACK + 7.0))
    for number, x in enumerate((-16, 14), 1):
        handle = [cyl(3.4, 3.4), tube((0, 0, 1.6), (0, -16, 0.4), 1.2)]
        bar.put(f"Portafilter_{number}", handle, (-48 + x, -43, BACK + 22.3), (0, 0, 14 * number - 20))
    bar.rest("Milk_jug", [vessel(4.4, 3.8, 11, 0.3), _jug_handle()], (-21, -44, BACK + 7.5), (0, 0, 70))
    bar.rest("Cup_1", CUP, (-64, -43, BACK + 7.4), (0, 0, 100))
    for number, (x, y) in enumerate(((-76, -22), (-65, -21), (-54, -22.5), (-43, -21)), 2):
        bar.rest(f"Cup_{number}", CUP, (x, y, BACK + 42), (0, 0, 50 * number))
    bar.put("Cup_6", CUP, (-65, -21, BACK + 42 + 1.7), (0, 0, 160))
    grinder = [cube(16, 22, 30), cube(10, 10, 4, 0, -9, 12), lathe([(3, 30), (9, 46), (9, 50), (0.1, 50)])]
    bar.rest("Coffee_grinder", grinder, (4, -26, BACK), (0, 0, -4))
    bar.rest("Tamping_mat", cube(18, 14, 0.8), (24, -44, BACK), (0, 0, 3))
    bar.rest("Tamper", [cyl(2.9, 2), cyl(1.2, 6, 0, 0, 2), ball(1.7, 0, 0, 8.6)], (22, -44, BACK + 0.8))
    bar.rest("Knock_box", [vessel(7, 8, 12, 0.5), tube((-7.6, 0, 11.4), (7.6, 0, 11.4), 0.9)], (27, -20, BACK))
    bar.rest("Dirty_plate", PLATE, (55, -34, BACK - 14.4))
    bar.put("Dirty_cup", CUP, (72, -36, BACK - 11.6), (78, 0, 40))
    bar.rest("Dish_sponge", cube(9, 6, 3), (75, -9, BACK), (0, 0, 15))
    bar.rest("Dish_soap", [cyl(3, 15), cyl(1, 4, 0, 0, 15)], (88, -14, BACK))
    bar.rest(
        "Upturned_glass", [lathe([(0.1, 13), (2.8, 13), (3.6, 0), (3.3, 0), (2.5, 12.7), (0.1, 12.7)])], (92, -36, BACK)
    )
    z = 10.0
    bar.rest("Detergent", [cube(10, 7, 24), cyl(2, 4, 2, 0, 24)], (20, -24, z), (0, 0, 8))
    bar.rest("Cleaning_bucket", vessel(10, 14, 22, 0.4), (76, -30, z))
    bar.put("Cleaning_cloth", [cube(14, 10, 2), cube(9, 9, 2, 1, 1, 1.8)], (76, -30, z + 0.5))
    bar.rest("Coffee_sack_1", cube(26, 18, 12), (-70, -30, z), (0, 0, 5))
    bar.rest("Coffee_sack_2", cube(25, 17, 11), (-69, -31, z + 12), (0, 0, -6))
    bar.rest("Coffee_sack_3", cube(26, 18, 12), (-30, -28, z), (0, 0, 12))
    for number in range(3):
        bar.put(f"Bowl_{number + 1}", vessel(4, 9, 7, 0.4), (-74, -30, 46.0 + 1.0 * number))
    bar.rest("Spare_tray", cube(46, 32, 1.4), (-32, -30, 46))


def _jug_handle() -> Mesh:
    return shift(ring(3, 0.4), 5.4, 0, 6)


def _build_shelves(bar: Group) -> None:
    for name, z in (("Lower_shelf", 142), ("Upper_shelf", 176)):
        brackets = [block(x, x + 1.4, -16, 0.1, -9, 0) for x in (-64, 44)]
        bar.put(name, merge(block(-80, 60, -21, -0.2, 0, 2.4), *brackets), (0, -0.1, z))
    z = 144.4
    for number, x in enumerate((-74, -65.5, -57, -48.6), 1):
        bar.rest(f"Glass_{number}", GLASS, (x, -10 - number % 2, z))
    for number, x in enumerate((-34, -20, -5), 1):
        bar.rest(f"Jar_{number}", JAR, (x, -11, z), (0, 0, 30 * number))
    for number in range(4):
        bar.put(f"Plate_{number + 1}", PLATE, (16 + 0.3 * number, -10.6, z + 0.1 + 0.5 * number))
    bar.rest("Milk_pan", [vessel(7, 7.4, 8, 0.3), tube((7, 0, 7), (20, 0, 8), 0.9)], (38, -11, z), (0, 0, 20))
    for number, x in enumerate((18, 30, 50), 1):
        bar.put(f"Cup_hook_{number}", CUP_HOOK, (x, -12, 142))
        # The handle of the mug, up, hangs on the hook.
        bar.put(f"Hanging_mug_{number}", MUG, (x + 5, -13.5, 131.5), (0, -78, 0))
    z = 178.4
    for number, x in enumerate((-70, -59), 1):
        bar.rest(f"Tea_tin_{number}", TIN, (x, -11, z), (0, 0, 12 - 9 * number))
    bar.rest("Tea_tin_3", TIN, (-65, -11, z + 15.4), (0, 0, 6))
    bar.rest(
        "Teapot",
        [
            lathe([(0.1, 0), (6, 0), (9, 7), (5, 13), (0.1, 13.5)]),
            capsule((8, 0, 5), (14, 0, 12), 1.2),
            shift(ring(4, 0.6), -10, 0, 7),
        ],
        (-30, -11, z),
        (0, 0, 25),
    )
    bar.rest("Teapot_lid", [cyl(4, 0.8), ball(1.2, 0, 0, 1.7)], (-30, -11, z + 13.3))
    bar.rest("Ivy_pot", POT, (30, -11, z), (0, 0, 10), 0.9)
    bar.put(
        "Ivy",
        [*LEAVES.parts, capsule((6, -4, 2), (12, -9, -14), 1.1), capsule((-6, -5, 2), (-10, -9, -20), 1.1)],
        (30, -11, z + 10.3),
        (0, 0, 20),
        0.8,
    )
    bar.put("Menu_board", [cube(130, 2.4, 70, 0, -1.6, 0), cube(60, 4, 1.4, 0, -4, -0.4)], (-10, 0, 216))
    bar.rest("Chalk", tube((-4, 0, 0.6), (4, 0, 0.6), 0.6), (2, -4.2, 217.0))


def _build_fridge(fridge: Group) -> None:
    shell = merge(
        block(-30, 30, -58, 0, 0, 8),
        block(-30, 30, -58, 0, 146, 152),
        block(-30, -26.5, -58, 0, 8, 146),
        block(26.5, 30, -58, 0, 8, 146),
        block(-26.5, 26.5, -3, 0, 8, 146),
        *(block(-26.5, 26.5, -52, -3, z, z + 1) for z in (40, 75, 110)),
    )
    fridge.rest("Fridge", shell, (0, 0, 0))
    frame = merge(
        block(-30, -25, -62, -58.4, 4, 150),
        block(25, 30, -62, -58.4, 4, 150),
        block(-25, 25, -62, -58.4, 4, 9),
        block(-25, 25, -62, -58.4, 145, 150),
    )
    fridge.put("Fridge_door", [frame, cube(50.4, 1, 136.4, 0, -60, 8.8)])
    fridge.put("Fridge_handle", capsule((-27, -63.4, 70), (-27, -63.4, 105), 1))
    for number, (x, y) in enumerate(((-18, -30), (-9.5, -31), (-17, -22)), 1):
        fridge.rest(f"Milk_{number}", CARTON, (x, y, 41), (0, 0, 5 * number))
    for number, x in enumerate((-16, -6, 6), 1):
        fridge.rest(f"Juice_{number}", JUICE, (x, -32, 76))
    fridge.rest("Cake_box", cube(30, 30, 12), (2, -28, 111), (0, 0, 6))
    fridge.rest("Butter_dish", [cube(18, 11, 1.4), cube(15, 8.6, 5, 0, 0, 1.3)], (12, -30, 41))
    fridge.rest("Salad_bowl", vessel(8, 14, 10, 0.4), (0, -28, 8))
    fridge.put("Lettuce", ball(8, 0, -28, 17.2))
    fridge.rest("Bread_basket", vessel(14, 18, 11, 0.8), (-4, -30, 152))
    fridge.put("Bread_roll_1", capsule((-4, 0, 0), (4, 0, 0), 4), (-8, -30, 157), (0, 0, 30))
    fridge.put("Bread_roll_2", capsule((-4, 0, 0), (4, 0, 0), 4), (3, -27, 157.2), (0, 0, -60))
    fridge.put("Rota", cube(0.1, 15, 21, -30.2, -30, 105))
    fridge.put("Fridge_magnet", tube((-30.2, -30, 123), (-31, -30, 123), 1.4))


def _build_front_counter(bar: Group) -> None:
    top = [block(-112, 97, -180, -118, 104, FRONT), block(-112, -62, -118, -78, 104, FRONT)]
    panels = [
        block(-108, 93, -170, -167, 0, 104),
        block(-108, -105, -167, -80, 0, 104),
        block(90, 93, -167, -122, 0, 104),
        block(-105, 90, -167, -124, 48, 50),
        block(-8, -6, -167, -126, 0, 104),
    ]
    bar.rest("Guest_counter", merge(*top, *panels), (0, 0, 0))
    bar.put(
        "Foot_rail",
        [
            tube((-106, -182, 22), (90, -182, 22), 1.8),
            *(tube((x, -182, 22), (x, -169.6, 22), 1.2) for x in (-100, -8, 84)),
        ],
    )
    bar.put("Menu_poster", cube(42, 0.3, 58, 40, -170.4, 36))
    bar.put(
        "Bag_hook",
        [
            cube(3, 0.6, 6, -40, -170.3, 84),
            tube((-40, -170, 86), (-40, -176, 86), 0.5),
            tube((-40, -176, 86), (-40, -176, 89), 0.5),
        ],
    )
    strap = [tube((0, 0, 0), (x, 0, -26), 0.5) for x in (-11, 11)]
    bar.put("Handbag", [*strap, cube(28, 9, 22, 0, 0, -48)], (-40, -175, 87.2), (0, 0, 0))
    for number, x in enumerate((-74, -16, 44), 1):
        bar.rest(f"Bar_stool_{number}", STOOL, (x, -214, 0), (0, 0, 17 * number))
    bar.rest("Cycling_gloves", [cube(9, 15, 1.6), cube(9, 15, 1.6, 3, 1, 1.5)], (-15, -212, 75), (0, 0, 24))


def _fill_front_counter(bar: Group) -> None:
    z = FRONT
    till = [cube(34, 36, 10), cube(26, 14, 16, 0, 8, 10), cube(24, 2, 18, 0, -2, 14)]
    bar.rest("Cash_register", till, (66, -146, z), (0, 0, 183))
    bar.rest("Card_reader", cube(8, 17, 4), (36, -168, z), (0, 0, 12))
    bar.rest("Tip_jar", vessel(5, 5.6, 14, 0.3), (22, -164, z))
    coins: list[Vector] = [(1.7 * i, 1.7 * j, 0.2 + 0.25 * ((i * i + j) % 4)) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    bar.put("Coins", Scatter(cyl(1.1, 0.2), coins), (22, -164, z + 0.5))
    bar.rest("Cake_stand", [cyl(8, 1), cyl(1.6, 9, 0, 0, 1), cyl(15, 1.2, 0, 0, 10)], (-6, -148, z))
    bar.rest("Cake", [cyl(11, 7)], (-6, -148, z + 11.2))
    bar.put(
        "Cake_dome",
        lathe([(14, 0), (14, 10), (9, 15), (0.1, 16.5), (0.1, 16), (8.8, 14.6), (13.6, 9.8), (13.6, 0), (14, 0)]),
        (-6, -148, z + 11.3),
    )
    bar.rest(
        "Serving_tray",
        [
            cube(46, 32, 0.8),
            cube(46, 1, 2, 0, -15.5),
            cube(46, 1, 2, 0, 15.5),
            cube(1, 32, 2, -22.5),
            cube(1, 32, 2, 22.5),
        ],
        (-50, -148, z),
        (0, 0, 7),
    )
    for number, (x, y) in enumerate(((-61, -150), (-41, -145)), 1):
        bar.rest(f"Saucer_{number}", SAUCER, (x, y, z + 0.8))
        bar.rest(f"Served_cup_{number}", CUP, (x, y, z + 1.3), (0, 0, 70 * number))
        bar.rest(f"Spoon_{number}", SPOON, (x - 4.6, y - 4.6, z + 2.4), (0, 0, 120))
    bar.rest("Sugar_bowl", vessel(3.4, 4.6, 6, 0.3), (-52, -138, z + 0.8))
    bar.put(
        "Sugar_lumps",
        [
            cube(1.5, 1.5, 1.5, x, y, h)
            for x, y, h in ((-1.2, 0, 0.5), (0.7, 0.9, 0.5), (0.5, -1.1, 0.5), (-0.2, 0.1, 2.0))
        ],
        (-52, -138, z + 0.8),
    )
    holder = merge(block(-8, 8, -4, 4, 0, 0.6), block(-8, 8, -4, -3.6, 0.6, 9), block(-8, 8, 3.6, 4, 0.6, 9))
    bar.rest("Napkin_holder", holder, (-92, -160, z), (0, 0, -20))
    bar.put("Napkins", cube(14, 5, 13), (-92, -160, z + 0.7), (0, 0, -20))
    bar.rest(
        "Menu_holder",
        merge(block(-6, 6, -4, 4, 0, 1), block(-6, 6, -1.2, -0.6, 1, 4), block(-6, 6, 0.6, 1.2, 1, 4)),
        (8, -170, z),
        (0, 0, 6),
    )
    bar.put("Menu_card", cube(15, 0.5, 21), (8, -170, z + 1.1), (0, 0, 6))
    bar.rest(
        "Flower_vase",
        lathe([(0.01, 0), (4, 0), (5, 8), (2.2, 17), (1.9, 17), (4.6, 8), (3.7, 0.5), (0.01, 0.5)]),
        (-84, -128, z),
    )
    bar.put(
        "Tulip", [tube((0, 0, 0.8), (0.6, 0.4, 27), 0.3), capsule((0.6, 0.4, 28), (0.8, 0.5, 30), 2)], (-84, -128, z)
    )
    bar.rest("Newspaper_1", cube(30, 40, 1.4), (-88, -98, z), (0, 0, 4))
    bar.rest("Newspaper_2", cube(30, 40, 1.2), (-87, -99, z + 1.4), (0, 0, -7))
    bar.rest(
        "Reading_glasses",
        [
            shift(ring(2.2, 0.2, "y"), -3, 0, 2.4),
            shift(ring(2.2, 0.2, "y"), 3, 0, 2.4),
            *(tube((x, 0, 3), (x, 12, 1), 0.2) for x in (-5, 5)),
        ],
        (-86, -102, z + 2.6),
        (0, 0, 30),
    )
    crate = merge(open_box(34, 28, 11, 1), block(-16, 16, -0.4, 0.4, 1, 9))
    bar.rest("Lemonade_crate", crate, (-60, -145, 50), (0, 0, 0))
    for number, (x, y) in enumerate(((-10, -7), (0, -7), (10, -6.6), (-9, 7)), 1):
        bar.rest(f"Lemonade_{number}", BOTTLE, (-60 + x, -145 + y, 51))
    bar.rest("Paper_bags", cube(24, 32, 7), (16, -146, 50), (0, 0, -5))
    bar.rest("Folded_cloth", [cube(22, 16, 4)], (56, -148, 50), (0, 0, 8))
    bar.rest("Waste_bin", vessel(14, 17, 42, 0.5), (30, -143, 0))
    bar.rest(
        "Step_stool",
        merge(block(-18, 18, -12, 12, 22, 25), *(block(x, x + 3, -12, 12, 0, 22) for x in (-18, 15))),
        (-50, -142, 0),
        (0, 0, 5),
    )
