"""The wash area beside the hall: a sink bench with taps and hoses, shelves, towels and cleaning things."""

import math

from benchmarks.scenes.pottery.shapes import (
    bag,
    box,
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
    BRICK,
    CELADON,
    GREEN,
    GREY,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    bottle,
    bowl,
    bracket,
    bucket,
    hook,
    mug,
    panel,
    polyline,
    slab,
    tap,
)

__all__ = ["build_wash_area"]


def build_wash_area(pottery: Pottery) -> None:
    """Add the wash area."""
    area = pottery.group(pottery.root, "Wash_area")
    bench = pottery.group(area, "Sink_bench", (556, -362, 0), 180)
    _build_bench(pottery, bench)
    _build_sink_things(pottery, bench)
    _build_shelf(pottery, pottery.group(area, "Cup_shelf", (540, -362, 160), 180))
    _build_towels(pottery, pottery.group(area, "Towels", (412, -200, 120), 90))
    _build_cleaning(pottery, pottery.group(area, "Cleaning", (700, -180, 0), -90))


def _build_bench(pottery: Pottery, group: Group) -> None:
    deck = [box(160, 12, 2, 0, -6, 86), box(160, 6, 2, 0, -59, 86)]
    deck += [box(width, 44, 2, x, -34, 86) for x, width in ((-74, 12), (0, 16), (74, 12))]
    basins = [moved(tray(60, 44, 24, 0.4), side * 38, -34, 62) for side in (-1, 1)]
    legs = [box(4, 4, 86, a * 77, y) for a in (-1, 1) for y in (-3, -58)] + [
        box(150, 2, 5, 0, y, 12) for y in (-3, -58)
    ]
    pottery.put(group, "Sink_bench", shape(merge(*deck, *basins, *legs), STEEL), (0, -0.3, 0))
    for number, x in enumerate((-38, 38), 1):
        pottery.put(group, f"Tap_{number}", tap(), (x, -6, 88))
        pottery.fix(
            group,
            f"Drain_pipe_{number}",
            polyline([(x, -34, 62), (x, -34, 50), (x * 0.6, -34, 46), (x * 0.45, -33, 34.7)], 2, GREY),
            (0, 0, 0),
        )
    trap = merge(tray(46, 40, 34, 0.8), box(46, 40, 0.8, 0, 0, 34))
    pottery.put(group, "Clay_trap", shape(trap, GREEN), (0, -32, 0), 2)
    pottery.wall(group, "Splash_panel", panel(176, 40, 0.6, WHITE), (0, 0, 108.5))
    heater = lathe([(0, 0), (18, 1), (20, 4), (20, 56), (18, 59), (0, 60)], 28)
    pottery.wall(
        group,
        "Water_heater",
        shape(merge(moved(heater, 0, -21), box(24, 2, 8, 0, -1, 40), box(24, 2, 8, 0, -1, 12)), WHITE),
        (-108, 0, 150),
    )


def _build_sink_things(pottery: Pottery, group: Group) -> None:
    spout = [
        (-38, -20.2, 103.2),
        (-38, -20.2, 100),
        (-38.4, -21, 94),
        (-41, -25, 80),
        (-44, -30, 68),
        (-46, -38, 64),
        (-40, -46, 63.8),
        (-30, -46, 63.8),
    ]
    pottery.fix(group, "Rinse_hose", polyline(spout, 1.2, GREEN), (0, 0, 0))
    pottery.put(group, "Soap_dispenser", bottle(3.5, 19, YELLOW), (4, -6, 88))
    pottery.put(group, "Washing_bowl", bowl(14, 9, BLUE), (32, -36, 62.4))
    over = turned(ribbon([(-9, 0.2), (0.4, 0.25), (3.3, 0.2), (3.6, -1), (3.7, -22)], 0.3, 10), 90)
    pottery.fix(group, "Rubber_gloves", shape(turned(over, 0, 0, -90), YELLOW), (-2, -59, 88))
    pottery.put(group, "Scrap_bucket", bucket(RED), (-56, -30, 0), 30)
    pottery.put(group, "Rubber_mat", slab(130, 60, 1, BLACK), (-10, -135, 0), -2)
    grate = merge(ring(2, 9, 0.6), *(box(16, 1, 0.5, 0, y, 0) for y in (-4, 0, 4)))
    pottery.fix(group, "Floor_drain", shape(grate, STEEL), (-20, -200, -0.25))


def _build_shelf(pottery: Pottery, group: Group) -> None:
    for number, x in enumerate((-40, 40), 1):
        pottery.wall(group, f"Cup_bracket_{number}", bracket(), (x, 0, -2.2))
    pottery.put(group, "Cup_board", slab(110, 22, 2, WOOD), (0, -11.5, -2.1))
    for number, (x, color) in enumerate(((-46, BLUE), (-28, BRICK)), 1):
        pottery.put(group, f"Tea_mug_{number}", mug(color), (x, -11, 0), 80 * number)
    for number, x in enumerate((-30, 10), 1):
        cup_hook = tube([(0, 0, 0.6), (0, 0, -1), (0, -0.9, -2.1), (0, -2, -2.6), (0, -3, -2), (0, -3.2, -1)], 0.25)
        pottery.fix(group, f"Screw_hook_{number}", shape(cup_hook, STEEL, asset="cup_hook"), (x, -10, -2.3))
        if number < 2:
            cup = turned(
                merge(
                    vessel([(3.6, 0), (4.2, 1.5), (4.2, 9.5)], 0.4),
                    tube([(3.9 + 2.6 * math.sin(math.pi * t), 0, 2 + 5.5 * t) for t in [i / 8 for i in range(9)]], 0.5),
                ),
                0,
                -90,
            )
            pottery.fix(group, f"Hanging_mug_{number}", shape(moved(cup, 4.75, 0, -5.95), CELADON), (x, -12, -4.7))


def _build_towels(pottery: Pottery, group: Group) -> None:
    ends = [merge(box(2, 0.6, 5, a * 50, -0.3, -2.5), rod(0.8, 9, "-y", a * 50, -0.3, 0)) for a in (-1, 1)]
    pottery.wall(group, "Towel_rail", shape(merge(rod(1, 102, "x", -51, -8, 0), *ends), STEEL), (0, 0, 0))
    for number, (x, front, color) in enumerate(((-24, 40, WHITE), (18, 52, BLUE)), 1):
        fold = [
            (-1.6, -34),
            (-1.4, -8),
            (-1.25, -0.5),
            (-0.8, 0.95),
            (0, 1.25),
            (0.8, 0.95),
            (1.25, -0.5),
            (1.4, -8),
            (1.7, -front),
        ]
        cloth = turned(turned(ribbon([(-a, b) for a, b in fold], 0.4, 32), 90), 0, 0, 90)
        pottery.fix(group, f"Hand_towel_{number}", shape(moved(cloth, -16), color), (x, -8, 0.1))
    pottery.wall(group, "Tool_hook", hook(), (75, 0, 40))
    dust = merge(
        moved(turned(ring(0.8, 1.4, 0.5, 14), 90), 0, 0.25, -0.5), box(3, 0.5, 40, 0, 0, -41), box(22, 1, 18, 0, 0, -58)
    )
    pottery.fix(group, "Squeegee", shape(dust, RED), (75, -3, 40))
    pottery.put(group, "Laundry_basket", shape(vessel([(18, 0), (23, 50)], 0.8, 1), WOOD), (-80, -28, -120))
    pottery.put(group, "Used_towels", shape(bag(26, 24, 16), WHITE), (-80, -28, -119), 30)


def _build_cleaning(pottery: Pottery, group: Group) -> None:
    reel = merge(
        moved(turned(ring(6, 22, 1.2, 28), 90), 0, -4),
        moved(turned(ring(6, 22, 1.2, 28), 90), 0, -20),
        moved(turned(ring(5, 7, 20), 90), 0, -2),
        box(12, 2.2, 16, 0, -1.1, -8),
        rod(2, 8, "-y", 0, -1),
    )
    pottery.wall(group, "Hose_reel", shape(reel, RED), (-60, 0, 110))
    coil = [(12 * math.cos(a), -6.6 - 0.33 * a, 12 * math.sin(a)) for a in [i * math.pi / 8 for i in range(16 * 6)]]
    hang = [
        (12.2, -19, -10),
        (12.6, -19.5, -40),
        (13, -20, -80),
        (15, -24, -104),
        (24, -34, -108.6),
        (40, -40, -108.6),
        (52, -32, -108.6),
    ]
    hose = tube([(x, max(y, -18.4), z) for x, y, z in coil], 1.3)
    tail = tube([(12, -18.4, 0), *hang], 1.3)
    pottery.fix(group, "Garden_hose", shape(merge(hose, tail), GREEN), (-60, 0, 110))
    pottery.put(group, "Mop_bucket", shape(tray(38, 28, 26, 0.6), YELLOW), (60, -36, 0), 8)
    tilt = math.degrees(math.atan2(29, 130))
    mop = merge(rod(1.1, 132, z=8), moved(lathe([(0, 0), (8, 0), (7, 6), (2, 9), (0, 9)], 14), 0, 0, 0))
    pottery.fix(group, "Mop", shape(mop, WOOD), (58, -31.7, 2.4), rot=(-tilt, 0, 0))
    pottery.put(group, "Grey_crate", shape(tray(50, 36, 28), GREY, asset="stack_crate"), (130, -24, 0), 2)
    pottery.put(group, "Grey_crate_on_top", shape(tray(50, 36, 28), GREY, asset="stack_crate"), (130.5, -24, 28), 4)
    pottery.put(
        group,
        "Old_sponges",
        shape(merge(bag(12, 9, 5), moved(bag(12, 9, 5), 10, 7, 0), moved(bag(11, 8, 5), 3, 2, 4.6)), YELLOW),
        (126, -26, 28.6),
    )
