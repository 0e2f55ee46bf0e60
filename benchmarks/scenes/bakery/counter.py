"""The counter: the glass display with its pastries, the till, and what is kept below the counter top."""

from benchmarks.scenes.bakery.forms import (
    Triple,
    bar,
    block,
    bulge,
    cloth,
    column,
    hose,
    open_box,
    orb,
    panels,
    roll,
    turned,
    vessel,
)
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import croissant, drawer, jar, plate, price_tag, tray

__all__ = ["build_counter"]

TOP = 95.0


def build_counter(shop: Area) -> None:
    """Add the counter; customers stand at its +z side, staff at its open side."""
    counter = shop.area("Counter", (250, 0, 590))
    _body(counter)
    _display(counter.area("Display", (-74, TOP, 2)))
    _till(counter.area("Till", (104, TOP, -8)))
    _top(counter.area("OnTop", (0, TOP, 0)))


def _body(counter: Area) -> None:
    counter.stand(
        "counter_body",
        panels(
            (-180, 180, 0, 92, 33, 35),
            (-180, -177.5, 0, 92, -35, 33),
            (177.5, 180, 0, 92, -35, 33),
            (-177.5, 177.5, 8, 10.5, -33, 33),
            (-177.5, 177.5, 0, 8, -31, -29),
            (-1, 1, 10.5, 92, -33, 33),
        ),
    )
    counter.stand("counter_top", panels((-183, 183, 92, TOP, -38, 38)))
    counter.fix("shelf_left", panels((-177.3, -1.2, 48, 50, -32, 32.8)))
    counter.fix("shelf_right", panels((1.2, 177.3, 48, 50, -32, 32.8)))
    carton = [block(38, 24, 28), block(38.4, 0.3, 6, (0, 24, 0))]
    counter.stand("bag_carton", carton, (-130, 10.5, -6), (0, 4, 0))
    counter.stand("cleaning_crate", open_box(36, 18, 28, 0.5, 1), (70, 10.5, -4))
    counter.fix(
        "spray_bottle",
        [turned([(0, 0), (4, 0), (4, 15), (1.5, 19), (1.5, 22), (0, 22)]), block(2.5, 3, 8, (0, 22, 1))],
        (60, 11.2, -4),
    )
    counter.fix(
        "counter_cloth", cloth([(-7, 0.4), (0, 0.6), (7, 0.3), (7.6, 1), (6, 1.4), (-7, 1.2)], 16, 0.5), (76, 11.1, -2)
    )
    cake_box = [block(26, 10, 26), block(25, 0.3, 8, (0, 10, 0))]
    for number in range(2):
        counter.stand(
            f"cake_box_{number + 1:02}", cake_box, (-60 + number, 50 + 10.4 * number, 0), (0, 5 * number, 0), "cake_box"
        )
    counter.stand("bag_stack", block(22, 9, 34), (-120, 50, 2), (0, 3, 0))
    for number in range(2):
        counter.fix(f"spare_tray_{number + 1:02}", tray(58, 36), (60, 50.1 + 0.6 * number, 0), (0, number, 0))


def _display(case: Area) -> None:
    case.stand(
        "display_case",
        panels(
            (-104, 104, 0, 3, -32, 32),
            (-104, -103.2, 3, 45, -32, 32),
            (103.2, 104, 3, 45, -32, 32),
            (-103.2, 103.2, 3, 45, 31.2, 32),
            (-104, 104, 45, 46.5, -32, 32),
            (-103.2, 103.2, 3, 3.8, -32, -29),
            (-103.2, 103.2, 43.5, 45, -32, -29),
        ),
    )
    pane, grip = panels((-53, 53, 0, 39.4, -0.3, 0.3)), block(1.6, 8, 1, (48, 15, -0.7))
    case.fix("sliding_door_left", [pane, grip], (-50, 3.9, -31.2))
    case.fix("sliding_door_right", [pane, grip], (-4, 3.9, -29.8))
    case.fix("glass_shelf", panels((-103, 103, 23, 23.8, -9, 31)))
    for number, x in enumerate((-68, 0, 68), start=1):
        case.stand(f"display_tray_{number:02}", tray(60, 38, 1.2), (x, 3, 6), (0, number - 2, 0), "display_tray")
    for number, (x, z, turn) in enumerate([(-86, -4, 10), (-68, -3, -12), (-51, -5, 3), (-72, 13, 170)]):
        case.stand(f"croissant_{number + 1:02}", croissant(), (x, 3.3, z), (0, turn, 0), "croissant")
    for number, (x, z) in enumerate([(-12, 0), (6, -1)]):
        case.stand(
            f"chocolate_roll_{number + 1:02}", bulge(8, 4.5, 11, 0.6), (x, 3.3, z), (0, 6 * number - 9, 0), "choc_roll"
        )
    muffin = [turned([(0, 0), (2.6, 0), (3.4, 4), (4, 4.6), (3.2, 6.4), (0, 7)], 16)]
    for number, (x, z) in enumerate([(58, -2), (70, -3)]):
        case.stand(f"muffin_{number + 1:02}", muffin, (x, 3.3, z), (0, 40 * number, 0), "muffin")
    for number, x in enumerate((-68, 0), start=1):
        case.stand(f"price_card_{number:02}", price_tag(), (x + 4, 3, 28.6), (0, 0, 0), "price_card")
    for number, x in enumerate((-76, -34), start=1):
        case.stand(f"cake_plate_{number:02}", plate(14), (x, 23.8, 11), like="cake_plate")
    case.stand(
        "strawberry_cake",
        [column(11, 6), *(orb(1.5, (7 * a, 5.8, 7 * b)) for a, b in ((1, 0), (0, 1), (-1, 0), (0, -1)))],
        (-76, 24.5, 11),
    )
    case.stand("cheesecake", turned([(0, 0), (9.5, 0), (10.5, 5), (9.5, 5.4), (0, 5)]), (-34, 24.5, 11))
    case.stand("eclair_board", panels((-16, 16, 0, 1.4, -13, 13)), (30, 23.8, 10))
    for number in range(3):
        case.stand(
            f"eclair_{number + 1:02}",
            bulge(4.4, 3.6, 14, 0.7),
            (20 + 6.8 * number, 25.2, 10),
            (0, 4 * number - 6, 0),
            "eclair",
        )
    case.stand("price_card_03", price_tag(), (66, 23.8, 22), (0, -8, 0), "price_card")


def _till(till: Area) -> None:
    body = panels(
        (-20, 20, 1, 2, -20, 18),
        (-20, 20, 11, 12, -20, 18),
        (-20, -19, 2, 11, -20, 18),
        (19, 20, 2, 11, -20, 18),
        (-19, 19, 2, 11, 17, 18),
    )
    till.stand("till_body", [body, *(column(1.2, 1, (x, 0, z)) for x in (-17, 17) for z in (-17, 15))])
    # It is pulled out by 14 towards the staff; its own front looks to +z, so it is turned.
    till.fix("till_drawer", drawer(37, 7.4, 35, (37.4, 0, 0.8)), (0, 2.4, -34), (0, 180, 0))
    parting = [(x, x + 0.2, 0.2, 4, -14, 14) for x in (-9, 0, 9)]
    walls: list[Triple] = [(-17, 17, 0, 0.2, -14, 14), (-17, 17, 0.2, 4.4, -14.2, -14), (-17, 17, 0.2, 4.4, 14, 14.2)]
    walls += [(-17.2, -17, 0, 4.4, -14.2, 14.2), (17, 17.2, 0, 4.4, -14.2, 14.2)]
    till.fix("cash_tray", panels(*walls, *parting, (-17, 17, 0.2, 4, -1, -0.8)), (0, 3.1, -17.5))
    till.fix("coins", [column(1.2, 1.4, (x, 0, z)) for x, z in ((-1.5, 0), (1.4, 1.2), (0.2, -2.4))], (-13.2, 3.4, -26))
    till.fix("banknotes", block(7.4, 0.9, 12), (-4.5, 3.4, -10))
    screen = [column(7, 1, (0, 0, 0)), bar((0, 1, 0), (0, 17, 2), 1.4), block(30, 20, 2.4, (0, 13, 0), (12, 0, 0))]
    till.stand("till_screen", screen, (0, 12, 4))
    till.fix("till_key", [bar((0, 0, 0.6), (0, 0, -2.2), 0.25), block(2, 2.6, 0.3, (0, -1.3, -3))], (12, 7, -34))
    printer = panels(
        (-7, 7, 0, 0.8, -9, 9),
        (-7, 7, 0.8, 11, 8.2, 9),
        (-7, 7, 0.8, 11, -9, -8.2),
        (-7, -6.2, 0.8, 11, -8.2, 8.2),
        (6.2, 7, 0.8, 11, -8.2, 8.2),
        (-7, 7, 11, 12, -9, 3),
    )
    till.stand("receipt_printer", printer, (44, 0, -14), (0, 180, 0))
    till.fix("receipt_roll", [roll(0.7, 3.6, 9)], (39.5, 4.6, -15), (0, 0, -90))
    till.stand(
        "card_reader",
        [
            block(8, 4, 16, (0, 1.2, 0), (8, 0, 0)),
            block(6, 2.4, 4, (0, 0, -5)),
            block(6, 0.6, 5, (0, 5.6, -2.6), (8, 0, 0)),
        ],
        (38, 0, 24),
        (0, 0, 0),
    )
    till.fix(
        "reader_cable",
        hose([(38, 3.6, 17.2), (37.6, 2.2, 14), (36, 0.4, 10), (30, 0.4, 8), (26, 1.5, 4), (19.9, 5, 4)], 0.3),
    )


def _top(top: Area) -> None:
    stand = turned([(0, 0), (8, 0), (8, 0.8), (1.6, 2.4), (1.4, 10), (14, 11.4), (14.4, 12.2), (13.6, 12), (0, 11.9)])
    top.stand("cake_stand", stand, (54, 0, 14))
    top.stand("lemon_cake", roll(2.8, 9.4, 7, 28), (54, 12, 14))
    dome = [(0, 14.4), (7, 13.4), (11.4, 9), (12.4, 0), (12, 0), (11, 8.8), (6.8, 13), (0, 14)]
    top.stand("glass_dome", [turned(list(reversed(dome))), orb(1.5, (0, 14.2, 0))], (54, 12.1, 14))
    top.stand(
        "cake_knife", [block(1.8, 1.4, 11, (0, 0, -10)), block(2.6, 0.3, 20, (0, 0.6, 5))], (74, 0, 22), (0, 24, 0)
    )
    top.stand("tip_jar", jar(5, 14), (166, 0, 20))
    top.fix(
        "tip_coins",
        [
            column(1.2, 0.25, (x, y, z), (8, 0, 5))
            for x, y, z in ((0, 0, 1.5), (1.8, 0.2, -1), (-2, 0.1, 0), (0, 0.6, 0))
        ],
        (166, 0.5, 20),
    )
    holder = panels(
        (-6, 6, 0, 0.4, -3, 3),
        (-6, 6, 0.4, 17, -3, -2.7),
        (-6, 6, 0.4, 7, 2.7, 3),
        (-6, -5.7, 0.4, 7, -2.7, 2.7),
        (5.7, 6, 0.4, 7, -2.7, 2.7),
    )
    top.stand("flyer_holder", holder, (170, 0, -6), (0, 14, 0))
    top.fix("flyers", block(10.4, 20, 1.8, (0, 0.5, 0), (-3, 0, 0)), (170, 0.1, -6.2), (0, 14, 0))
    top.stand("tasting_bowl", vessel(6, 9, 5, 0.4), (120, 0, 24))
    for number, (x, z, y) in enumerate([(-2.4, -1, 0), (2.2, -2, 0), (0.4, 2.8, 0)], start=1):
        top.stand(
            f"bread_cube_{number:02}", block(3, 3, 3), (120 + x, 0.6 + y, 24 + z), (0, 25 * number, 0), "bread_cube"
        )
