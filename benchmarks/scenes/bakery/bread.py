"""What is along the wall behind the counter: the bread rack, and the bench with the coffee machine."""

from benchmarks.scenes.bakery.forms import (
    bar,
    block,
    bulge,
    cabinet,
    column,
    hoop,
    hose,
    joined,
    open_box,
    orb,
    panels,
    turned,
    vessel,
)
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import (
    bottle,
    bow_handle,
    cup,
    drawer,
    jar,
    jar_lid,
    long_loaf,
    loop_at,
    plate,
    spoon,
    tin_loaf,
)

__all__ = ["build_bread_wall", "build_coffee"]


def build_bread_wall(shop: Area) -> None:
    """Add the rack and its bread; z = 0 is the face of the wall."""
    rack = shop.area("BreadWall", (300, 0, 450))
    rack.stand(
        "rack_frame",
        panels((-90, -87, 0, 205, 0.3, 38), (87, 90, 0, 205, 0.3, 38), (-87, 87, 12, 203, 0.3, 1.6)),
    )
    for number, y in enumerate((30, 75, 120, 165), start=1):
        rack.fix(f"rack_board_{number:02}", panels((-86.9, 86.9, y, y + 2.4, 1.7, 37.6)))
    low = rack.area("Crates", (0, 32.4, 19))
    for number, x in enumerate((-54.8, 18.0), start=1):
        low.stand(
            f"bread_crate_{number:02}", open_box(62, 17, 32, 0.8, 0.6), (x, 0, 0), (0, 2 * number - 3, 0), "bread_crate"
        )
    for number, x in enumerate((-74.8, -54.8, -34.8), start=1):
        low.stand(f"rye_loaf_{number:02}", tin_loaf(13, 12, 27), (x, 1, 0), (0, 3 - 2 * number, 0), "rye_loaf")
    low.stand("spelt_loaf", tin_loaf(17, 12, 26), (6, 1, 0), (0, 3, 0))
    white = rack.area("WhiteBread", (0, 77.4, 20))
    for number, x in enumerate((-70.0, -50.0, -30.0), start=1):
        white.stand(f"white_loaf_{number:02}", tin_loaf(15, 11, 30), (x, 0, 0), (0, 3 * number - 7, 0), "white_loaf")
    white.stand("white_loaf_04", tin_loaf(15, 11, 30), (-60, 10.7, 0), (0, -2, 0), "white_loaf")
    white.stand("cutting_board", panels((-14, 14, 0, 2, -15, 15)), (66, 0, 0))
    white.stand("half_loaf", tin_loaf(15, 11, 16), (66, 2, -4))
    baskets = rack.area("Baskets", (0, 122.4, 19))
    for number, (x, r) in enumerate([(-62.0, 14), (-20.0, 14), (52.0, 16)], start=1):
        baskets.stand(f"round_basket_{number:02}", vessel(r - 2, r, 10, 0.8), (x, 0, 0))
    for number, (x, z) in enumerate([(-66.5, -3.0), (-57.4, -3.4)], start=1):
        baskets.stand(f"seed_roll_{number:02}", bulge(8.6, 5.6, 8.6, 1), (x, 0.8, z), (0, 30 * number, 0), "seed_roll")
    knot = joined(hoop(4, 1.1, (0, 1.1, 0), (90, 0, 0)), hoop(2.4, 1, (0, 1.1, -1), (90, 0, 0)))
    for number, (x, z) in enumerate([(-25.4, 0.0), (-14.6, 0.4)], start=1):
        baskets.stand(f"pretzel_{number:02}", knot, (x, 0.8, z), (0, 50 * number, 0), "pretzel")
    baskets.stand("plaited_loaf", [orb(5.4, (-7 + 4.7 * k, 0, 1 - 2 * (k % 2)), 0.75) for k in range(4)], (52, 0.9, 0))
    top = rack.area("TopBoard", (0, 167.4, 19))
    top.stand("farm_loaf", bulge(24, 13, 24, 1), (-60, 0, 0), (0, 20, 0))
    top.stand(
        "wheat_jug",
        turned([(0, 0), (6, 0), (8, 8), (4, 17), (4.6, 21), (4.2, 21), (3.6, 17), (7.6, 8), (5.7, 0.4), (0, 0.4)]),
        (62, 0, 0),
    )
    top.fix(
        "wheat_ears",
        [bar((0, 0, 0), (a, 26, b), 0.2) for a, b in ((1.6, 0), (-1.2, 1.4), (-1, -1.6), (1, 1.2))],
        (62, 0.5, 0),
    )
    clip = panels((-4, 4, -3.4, 2.6, 0.1, 0.4), (-2, 2, 2.5, 2.7, -1.5, 0.4))
    for number, (x, y) in enumerate([(-56, 30), (-50, 75), (-62, 120)], start=1):
        rack.fix(f"shelf_tag_{number:02}", clip, (x, y, 37.6), like="shelf_tag")
    rack.fix(
        "side_hook", [hose([(0, 0, -0.4), (0, -0.6, 1.6), (0, -0.6, 3.6), (0, 1, 4.4)], 0.3)], (90, 130, 20), (0, 90, 0)
    )
    tongs = [
        loop_at(1.6, 0.25),
        block(2, 24, 0.5, (0, -27, 0.6), (2, 0, 0)),
        block(2, 24, 0.5, (0, -27, -0.6), (-2, 0, 0)),
        block(2, 0.6, 2, (0, -3.6, 0)),
    ]
    rack.fix("bread_tongs", tongs, (92.6, 129.7, 20), (0, 90, 0))
    rack.stand("baguette_basket", vessel(14, 18, 42, 0.9), (-110, 0, 22))
    for number, (x, z, a, b) in enumerate([(-6, 2, 2, 3), (5, 4, 1, -3), (3, -7.5, -2, -2)], start=1):
        # Upright along y: a loaf along z, tipped; its base is near the floor of the basket.
        rack.fix(f"baguette_{number:02}", long_loaf(3.2, 62), (-110 + x, 31.8, 22 + z), (90 + a, 0, b), "baguette")


def build_coffee(shop: Area) -> None:
    """Add the bench and what is on it and above it; z = 0 is the face of the wall."""
    bench = shop.area("CoffeeBench", (90, 0, 450))
    bench.stand(
        "bench_body",
        cabinet(140, 10, 88, 55, 1.8, (-0.9, 0.9, 11.8, 86.2, 0.9, 54), (-66, 66, 0, 10, 4, 50)).to(0, 0, 0.2),
    )
    bench.fix("bench_top", panels((-71.5, 71.5, 88.1, 91, 0.3, 59)))
    for number, (y, out) in enumerate([(12.6, 0), (37.2, 0), (61.8, 24)], start=1):
        bench.fix(
            f"bench_drawer_{number:02}",
            drawer(65.6, 17, 50, (69, 0.4, 6.4)),
            (-34.5, y, 57 + out),
            (0, 0, 0),
            "bench_drawer",
        )
        bench.fix(f"drawer_bow_{number:02}", bow_handle(16), (-34.5, y + 17, 57 + out), (0, 0, 0), "drawer_bow")
    bench.fix("napkin_pack", block(17, 8, 17), (-50, 62.5, 65), (0, 6, 0))
    bench.fix(
        "bottle_opener",
        [hoop(1.8, 0.4, (0, 0.4, 0), (90, 0, 0)), block(1.6, 0.6, 9, (0, 0.1, 6))],
        (-37, 62.5, 66),
        (0, 30, 0),
    )
    door = bench.area("BenchDoor", (69, 0, 55.4))
    door.fix("door_front", panels((-67.5, 0, 12.4, 86, 0, 1.8)))
    door.fix(
        "door_knob", [column(0.7, 2, (0, 0, 0), (90, 0, 0)), column(1.6, 1.2, (0, 0, 2), (90, 0, 0))], (-63, 72, 1.7)
    )
    bench.fix("bench_shelf", panels((1.2, 67.8, 50, 51.8, 1.4, 50)))
    carton = joined(panels((-4.5, 4.5, 0, 18, -4.5, 4.5)), panels((-4.5, 4.5, 18, 22, -0.6, 0.6)))
    for number, x in enumerate((14, 26), start=1):
        bench.stand(f"milk_carton_{number:02}", carton, (x, 51.8, 24), (0, 7 * number, 0), "milk_carton")
    bench.stand("bean_sack", bulge(34, 24, 26, 0.5), (36, 11.8, 28))
    _machine(bench.area("Espresso", (-27, 91, 28)))
    _bench_top(bench.area("OnBench", (0, 91, 0)))
    _above(bench.area("CupBoard", (0, 165, 0)))


def _machine(machine: Area) -> None:
    feet = [column(1.8, 3, (x, 0, z)) for x in (-24, 24) for z in (-18, 18)]
    heads = [column(3.8, 3.2, (x, 27, 10)) for x in (-13, 13)]
    gallery = [(-28, 28, 44, 48, 19.2, 20), (-28, -27.2, 44, 48, -22, 19.2), (27.2, 28, 44, 48, -22, 19.2)]
    machine.stand(
        "machine_body",
        [
            block(56, 5, 44, (0, 3, -1)),
            block(56, 22, 20, (0, 8, -13)),
            block(56, 14, 43, (0, 30, -1)),
            panels(*gallery),
            *feet,
            *heads,
        ],
    )
    machine.stand(
        "drip_tray", panels((-26, 26, 8, 8.3, -2.5, 20), *((-26, 26, 8.3, 9.4, z, z + 0.8) for z in range(-2, 20, 2)))
    )
    filter_holder = [
        turned([(0, 0), (3.4, 0), (3.7, 2.4), (3.3, 2.4), (3, 0.4), (0, 0.4)]),
        bar((0, 1.2, 3.2), (0, 0.6, 16), 1.1),
        column(0.9, 2.4, (0, -2.4, 0)),
    ]
    for number, x in enumerate((-13, 13), start=1):
        machine.fix(
            f"filter_holder_{number:02}", filter_holder, (x, 24.5, 10), (0, -12 + 6 * number, 0), "filter_holder"
        )
    machine.fix("steam_wand", hose([(27, 33, 14), (31, 32, 15), (33, 26, 16), (33.4, 14, 17)], 0.5))
    small = cup(3.2, 5.6)
    machine.stand("espresso_cup_01", small, (-13, 9.4, 10), (0, 30, 0), "espresso_cup")
    for number, (x, z) in enumerate([(-20, -14), (-10, -13), (2, -15)], start=2):
        machine.stand(f"espresso_cup_{number:02}", small, (x, 44, z), (0, 50 * number, 0), "espresso_cup")
    machine.fix(
        "machine_cable",
        hose([(20, 12, -22.4), (24, 10, -25), (40, 8, -25.6), (56, 12, -26), (70, 20, -26.4), (70, 22, -27.2)], 0.5),
    )


def _bench_top(top: Area) -> None:
    grinder = [block(16, 4, 24), block(14, 26, 14, (0, 4, -4)), block(6, 5, 8, (0, 20, 6)), column(5, 1.5, (0, 30, -4))]
    top.stand("grinder_body", grinder, (40, 0, 22))
    top.stand(
        "bean_hopper",
        turned([(0, 0), (4, 0), (8.4, 7), (8.4, 16), (8, 16), (8, 7.2), (3.7, 0.4), (0, 0.4)]),
        (40, 31.5, 18),
    )
    top.fix("hopper_beans", turned([(0, 0), (3.6, 0), (7.7, 6.6), (7.7, 9), (0, 11)]), (40, 32.1, 18))
    top.fix(
        "hopper_lid",
        [turned([(0, 0.1), (8.2, 0.1), (8.7, -0.4), (8.7, 1), (0, 1.4)]), orb(1, (0, 1.2, 0))],
        (40, 47.6, 18),
    )
    top.stand(
        "milk_jug",
        [vessel(5, 4, 11, 0.2), hose([(4.4, 9, 0), (8, 9, 0), (8.4, 5, 0), (4.8, 2.6, 0)], 0.5)],
        (14, 0, 48),
    )
    top.fix(
        "milk_thermometer",
        [bar((0, 0.5, 4), (0, 15, -6.6), 0.25), column(1.8, 1, (0, 14.6, -6.4), (60, 0, 0))],
        (14, 0, 48),
    )
    for number in range(2):
        top.fix(f"saucer_{number + 1:02}", plate(7), (20, 0.1 + 0.75 * number, 26), (0, 15 * number, 0), "saucer")
    top.stand("sugar_jar", jar(5, 13), (61, 0, 20))
    top.fix("sugar_fill", turned([(0, 0), (4.5, 0), (4.5, 7), (0, 7.6)]), (61, 0.5, 20))
    top.fix("sugar_jar_lid", jar_lid(5), (61, 13, 20))
    top.stand("spoon_glass", vessel(3, 3.8, 11, 0.3), (38, 0, 48))
    for number, (x, a, b) in enumerate([(-1.2, 7, 6), (1, -8, -5)], start=1):
        top.fix(f"teaspoon_{number:02}", spoon(15), (38 + x, 7.5, 48), (-90 + a, 0, b), "teaspoon")
    top.fix("bench_socket", [block(8, 8, 1.2, (0, -4, 0.7)), column(2, 0.4, (0, 0, 1.3), (90, 0, 0))], (43, 22, 0))


def _above(board: Area) -> None:
    board.fix(
        "cup_board",
        panels(
            (-60, 60, 0, 2.4, 0.2, 22),
            (-45, -42, -16, 0, 0.2, 2),
            (42, 45, -16, 0, 0.2, 2),
            (-45, -42, -2.4, 0, 2, 18),
            (42, 45, -2.4, 0, 2, 18),
        ),
    )
    hook = hose([(0, 0.4, 0), (0, -1.6, 0), (0, -3.4, 1), (0, -4, 2.4), (0, -3.2, 3.8)], 0.25)
    mug = [vessel(4, 4, 9, 0.4), hose([(3.8, 7.6, 0), (6.8, 7.2, 0), (7, 2.4, 0), (3.8, 1.6, 0)], 0.5)]
    for number, x in enumerate((-30, -14, 2), start=1):
        board.fix(f"cup_hook_{number:02}", hook, (x, 0, 11), like="cup_hook")
    for number, x in enumerate((-30, 2), start=1):
        # The ear, at x = 6.9, hangs in the hook; the mug hangs down from it.
        board.fix(f"mug_{number:02}", mug, (x + 4.8, -10.15, 13.4), (0, 0, 90), "mug")
    board.stand("tea_tin", [block(9, 13, 9), block(9.4, 1.6, 9.4, (0, 13, 0))], (-48, 2.4, 11), (0, 4, 0))
    board.stand("syrup_bottle", bottle(3.8, 26), (-18, 2.4, 11))
