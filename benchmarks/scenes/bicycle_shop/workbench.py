"""The workbench with its tool wall, and the tool cabinet beside it."""

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
    merge,
    open_box,
    ring,
    shift,
    tube,
    vessel,
)
from benchmarks.scenes.bicycle_shop.stage import Asset, Group, Shop
from benchmarks.scenes.bicycle_shop.things import HOOK, MUG, SCREW, WHEEL, drawer

__all__ = ["build_bench", "build_tool_cabinet"]

SPANNER = Asset("spanner", (ring(1.5, 0.5), cube(1.6, 0.6, 15, 0, 0, -17), shift(ring(1.2, 0.4), 0, 0, -18.2)))
PLIERS = Asset(
    "pliers", (capsule((-0.6, 0, 0), (2.2, 0, -11), 0.8), capsule((0.6, 0, 0), (-2.2, 0, -11), 0.8), cube(2.4, 1, 6))
)
SCREWDRIVER = Asset("screwdriver", (capsule((0, 0, 1.6), (0, 0, 8), 1.5), tube((0, 0, -9), (0, 0, 0.5), 0.35)))
TUBE_BOX = Asset("tube_box", (cube(8, 8, 6.5),))
BEARING = ball(0.35)
TOP = 90.0
BOARD = -2.6
"""y of the front of the pegboard."""


def build_bench(shop: Shop) -> None:
    """Add the bench at the west wall; in its frame, the wall is at y = 0 and x goes to the right."""
    bench = shop.group("Workshop/Bench", (0, 510, 0), 90)
    bench.rest("Workbench", _workbench(), (0, 0, 0))
    _fill_top(bench)
    _fill_mat(bench)
    _fill_lower_board(bench)
    _build_wall(bench)
    _hang_tools(bench)


def _workbench() -> Mesh:
    legs = [block(x, x + 8, y, y + 8, 0, 85) for x in (-126, 118) for y in (-74, -14)]
    rails = [block(-126, 126, -12, -8, 70, 85), block(-122, 122, -72, -8, 20, 23)]
    return merge(block(-130, 130, -77, -2, 85, TOP), *legs, *rails)


def _fill_top(bench: Group) -> None:
    jaws = [cube(16, 20, 5), cube(10, 28, 9, 0, -4, 5), cube(12, 3, 6, 0, -19, 12), cube(12, 3, 6, 0, -12.6, 12)]
    bench.rest("Vise", [*jaws, tube((-9, -23, 8), (9, -23, 8), 0.8)], (-104, -60, TOP), (0, 0, 8))
    bench.put(
        "Clamped_hub",
        [tube((-7, 0, 0), (7, 0, 0), 1.7), tube((-8, 0, 0), (8, 0, 0), 0.5)],
        (-101.9, -75.5, 105.6),
        (0, 0, 8),
    )
    fork = [cube(26, 20, 3), cube(3, 4, 44, -6.5, 0, 2), cube(3, 4, 44, 6.5, 0, 2)]
    bench.rest("Truing_stand", fork, (92, -38, TOP), (0, 0, -14))
    bench.put("Wheel_in_truing_stand", WHEEL, (92, -38, 134.7), (0, 17, 76))
    radio = [cube(28, 11, 16), tube((-8, -5.4, 8), (-8, -6, 8), 4.5), tube((12, 4, 15), (20, 5, 34), 0.2)]
    bench.rest("Radio", radio, (22, -14, TOP), (0, 0, -6))
    bench.rest("Spray_can", [cyl(3.3, 17), cone(3.2, 2.5, 0, 0, 17), cyl(1, 2.4, 0, 0, 18.6)], (-62, -17, TOP))
    bench.rest(
        "Oil_can", [cyl(4, 9), cone(4, 5, 0, 0, 9), tube((0, 0, 12.5), (5, 0, 20), 0.3)], (-52, -22, TOP), (0, 0, 200)
    )
    bench.rest("Grease_tub", vessel(5, 5.6, 8, 0.2), (-76, -20, TOP))
    bench.put("Grease_lid", [cyl(5.8, 0.9), cyl(5.2, 0.3, 0, 0, -0.2)], (-75.6, -20.3, TOP + 7.9))
    bench.rest("Brush_jar", vessel(4, 4.4, 11, 0.3), (-40, -14, TOP))
    brush = [tube((0, 0, 0), (0, 0, 15), 0.5), cube(2.4, 0.9, 5, 0, 0, 14.5)]
    bench.put("Brush_1", brush, (-41.5, -14.6, TOP + 0.6), (6, 14, 0))
    bench.put("Brush_2", brush, (-38.7, -13, TOP + 0.4), (-9, -11, 40))
    bench.rest("Mug", MUG, (34, -62, TOP), (0, 0, 35))
    bench.put("Teaspoon", [tube((0, 0, 0), (0, 0, 12), 0.25), ball(0.9, 0, 0, 0.6)], (33, -62.4, TOP + 0.7), (8, 19, 0))
    bench.rest("Glove_box", [open_box(24, 12, 9, 0.3)], (-20, -9, TOP), (0, 0, 3))
    bench.put("Glove_1", [cube(18, 9, 1, 0, 0, 0.4), cube(18, 9, 1.2, 0.4, 0.3, 1.5)], (-20, -9, TOP), (0, 0, 3))
    bench.put("Glove_2", capsule((-3, 0, 3), (2, 1, 10.5), 2.0), (-20, -9, TOP), (0, 0, 3))
    charger = [cube(16, 11, 6), cube(7, 8, 1, 0, 0, 5.6)]
    bench.rest("Battery_charger", charger, (60, -13, TOP), (0, 0, 5))
    bench.put("Drill_battery", cube(7.2, 8.2, 7), (60, -13, TOP + 6.4), (0, 0, 5))
    drill = [
        capsule((-7, 0, 0), (7, 0, 0), 3.2),
        cone(1.6, 4, 0, 0, 0),
        cube(4, 4, 12, -3, 0, -14),
        cube(8, 6, 4, -3, 0, -17),
    ]
    bench.rest("Cordless_drill", drill, (60, -50, TOP + 3.3), (90, 0, 30))
    bench.rest("Invoice_pad", cube(15, 21, 1.2), (-66, -58, TOP), (0, 0, 12))
    bench.rest("Ballpoint", capsule((-6, 0, 0.4), (6, 0, 0.4), 0.4), (-65, -57, TOP + 1.2), (0, 0, 60))
    bench.rest("Tyre_lever_1", cube(11, 1.8, 0.5), (-84, -50, TOP), (0, 0, 40))
    bench.rest("Tyre_lever_2", cube(11, 1.8, 0.5), (-82, -48, TOP + 0.5), (0, 0, -15))
    arm = [
        cube(6, 6, 9, 0, 0, -6.6),
        tube((0, 0, 2), (8, -4, 40), 0.8),
        tube((8, -4, 40), (-22, -16, 58), 0.8),
        cone(8, 10, -24, -17, 50),
    ]
    bench.put("Bench_lamp", arm, (131, -20, TOP))


def _fill_mat(bench: Group) -> None:
    bench.rest("Bench_mat", cube(78, 46, 0.5), (-15, -46, TOP), (0, 0, 2))
    z = TOP + 0.5
    bench.rest(
        "Derailleur",
        [cube(5, 3, 2), cube(2, 1.4, 8, 1, 0, 0.5), shift(ring(2, 0.5), 1, 0, 8.6)],
        (-40, -52, z + 1.5),
        (90, 0, 20),
    )
    bench.rest("Chain", shift(ring(5.5, 0.45, "z"), 0, 0, 0.45), (-28, -60, z))
    bench.rest("Rag", [cube(26, 20, 0.5), cube(14, 9, 0.6, 4, 2, 0.4)], (-4, -56, z), (0, 0, 24))
    bench.rest("Cone_spanner", SPANNER, (4, -52, z + 1.5), (90, 0, 70))
    bench.rest("Parts_dish", vessel(5.2, 6, 2.6, 0.3), (12, -38, z))
    places: list[Vector] = [(1.4 * i, 1.3 * j, 0.75) for i in range(-2, 3) for j in range(-2, 3) if i * i + j * j < 6]
    bench.put("Bearing_balls", Scatter(BEARING, places), (12, -38, z))
    bench.rest("Cassette", [cyl(6.5 - 0.5 * i, 0.45, 0, 0, 0.5 * i) for i in range(8)], (-42, -32, z))
    bench.rest("Lock_ring", cyl(1.8, 0.5), (-42, -32, z + 3.95))
    bench.rest(
        "Allen_key",
        [tube((0, 0, 0.3), (9, 0, 0.3), 0.3), tube((0, 0, 0.3), (0, 3, 0.3), 0.3)],
        (-20, -36, z),
        (0, 0, 33),
    )


def _fill_lower_board(bench: Group) -> None:
    z = 23.0
    bench.rest("Toolbox", [open_box(46, 22, 18, 0.8)], (-90, -42, z), (0, 0, 6))
    bench.put(
        "Toolbox_lid", [cube(46.4, 22.4, 2.5), capsule((-8, 0, 4), (8, 0, 4), 1)], (-90, -42, z + 17.8), (0, 0, 6)
    )
    bench.put(
        "Toolbox_hammer",
        [tube((-15, 0, 0), (12, 0, 0), 1.3), cube(3, 10, 3, 13, 0, -1.5)],
        (-90, -42, z + 2.4),
        (0, 0, 10),
    )
    bench.rest("Tube_crate", open_box(50, 36, 16, 1), (-25, -40, z), (0, 0, -4))
    for number, (x, y, level) in enumerate(
        ((-38, -46, 0), (-29, -46, 0), (-20, -45, 0), (-12, -40, 0), (-33, -45.5, 1)), 1
    ):
        bench.rest(f"Tube_box_{number}", TUBE_BOX, (x, y, z + 1 + 6.5 * level), (0, 0, -4 + 3 * number))
    bench.rest("Paint_tin_1", [cyl(8, 18), cyl(7.4, 0.6, 0, 0, 17.8)], (30, -38, z))
    bench.rest("Paint_tin_2", [cyl(8, 18), cyl(7.4, 0.6, 0, 0, 17.8)], (31, -37, z + 18.4))
    bench.rest("Solvent_can", [cube(16, 10, 26), cyl(2, 3, 4, 0, 26)], (58, -30, z), (0, 0, -12))
    bench.rest("Bucket", vessel(11, 15, 26, 0.4), (92, -42, z))
    bench.put("Sponge", cube(14, 9, 5), (91, -43, z + 0.9), (0, 0, 20))


def _build_wall(bench: Group) -> None:
    bench.put("Pegboard", cube(190, 2, 100, -25, -1.6, 118))
    for number, (x, z) in enumerate(((-118, 216), (68, 216), (-118, 120), (68, 120)), 1):
        bench.put(f"Pegboard_screw_{number}", SCREW, (x, BOARD, z))
    bench.put("Magnet_strip", cube(40, 1.6, 4, 98, -1.1, 152))
    for number, x in enumerate((84, 96, 110), 1):
        bench.put(f"Hex_key_{number}", cube(1.2, 1.0, 16 - number, x, -2.5, 140 + number), (0, 0, 0))
    bench.put(
        "Power_strip",
        [cube(40, 4, 5), *(tube((x, -2, 2.5), (x, -2.6, 2.5), 1.9) for x in (-12, 0, 12))],
        (95, -2.3, 103),
    )
    bench.put(
        "Charger_plug", [tube((0, 0.5, 0), (0, -3, 0), 1.8), tube((0, -3, 0), (-8, -4, -8), 0.3)], (83, -5.0, 105.5)
    )
    cable = [tube((0, 0, 0), (-4, -2, -6.6), 0.3), tube((-4, -2, -6.6), (-9, -3, -5), 0.3)]
    bench.put("Charger_cable", cable, (76, -9, 97.6))
    bench.put(
        "Bench_shelf",
        merge(block(-60, 60, -22, 0.2, 0, 2), block(-50, -48, -18, 0.2, -14, 0), block(48, 50, -18, 0.2, -14, 0)),
        (-30, 0, 236),
    )
    bench.rest("Trophy", [cube(9, 9, 4), cyl(1, 9, 0, 0, 4), cone(4.5, 8, 0, 0, 11)], (-75, -11, 238), (0, 0, 10))
    bench.rest("Loudspeaker", cube(16, 16, 26), (10, -11, 238), (0, 0, -15))
    bench.rest(
        "Model_bike",
        [shift(ring(4, 0.4), -7, 0, 4.4), shift(ring(4, 0.4), 7, 0, 4.4), tube((-7, 0, 4.4), (7, 0, 4.4), 0.4)],
        (-35, -12, 238),
    )


def _hang_tools(bench: Group) -> None:
    """Hang tools on hooks whose ends point up; eyes hang on the hook, with small gaps."""
    upper = (-110, -98, -86, -74, -62, -44, -24, 0, 24, 48)
    for number, x in enumerate(upper, 1):
        bench.put(f"Hook_{number}", HOOK, (x, BOARD, 204 if number < 9 else 196))
    for number, x in enumerate(upper[:5], 1):
        # The eye has an inner radius of 1 cm, and the hook a radius of 3 mm.
        bench.put(
            f"Spanner_{number}",
            SPANNER,
            (x, BOARD - 3.2 - 0.3 * number, 203.25 - 0.05 * number),
            (2, 0.5 * number, 0),
            1.0 + 0.06 * (5 - number),
        )
    bench.put("Pliers_1", PLIERS, (-44, BOARD - 3.6, 204.4), (3, 0, 0))
    bench.put("Pliers_2", PLIERS, (-24, BOARD - 4, 204.2), (2, -3, 0))
    hammer = [tube((0, 0, -26), (0, 0, 2), 1.3), capsule((-5, 0, 1.8), (5, 0, 1.8), 1.6)]
    bench.put("Hammer_hook", HOOK, (6.6, BOARD, 204))
    bench.put("Hammer", hammer, (3.2, BOARD - 3.4, 204.2))
    bench.put("Tape_roll", ring(4.2, 1.1), (24, BOARD - 3.5, 193))
    bench.put(
        "Chain_whip",
        [ring(1.6, 0.5), cube(2, 0.6, 24, 0, 0, -26), capsule((0, -0.5, -25), (4, -0.5, -33), 0.6)],
        (48, BOARD - 3, 195.4),
        (0, -4, 0),
    )
    rack = cube(40, 6, 2, -92, BOARD - 2.8, 150)
    bench.put("Screwdriver_rack", rack)
    for number, x in enumerate((-107, -97, -87, -77), 1):
        # The shank goes through the board, the handle rests on it.
        bench.put(
            f"Screwdriver_{number}", SCREWDRIVER, (x, BOARD - 3, 152.1 - 0.15 * number), (0, 0, 0), 1.0 + 0.05 * number
        )
    bench.put("Saw_hook", HOOK, (-10, BOARD, 178))
    saw = [
        ring(1.8, 0.5),
        tube((-1.5, 0, -1), (-8, 0, -9), 0.7),
        tube((-8, 0, -9), (30, 0, -16), 0.6),
        cube(36, 0.3, 1.6, 12, 0, -26),
        tube((30, 0, -16), (30, 0, -26), 0.6),
        capsule((-8, 0, -9), (-7, 0, -26), 1.4),
    ]
    bench.put("Hacksaw", saw, (-10, BOARD - 3, 176.9))


def build_tool_cabinet(shop: Shop) -> None:
    """Add a cabinet on castors with five drawers, the second of which is pulled out."""
    cabinet = shop.group("Workshop/Tool_cabinet", (2, 341, 0), 94)
    body = merge(
        block(-34, 34, -48, -2, 8, 10),
        block(-34, 34, -48, -2, 92, 95),
        block(-34, -32, -48, -2, 10, 92),
        block(32, 34, -48, -2, 10, 92),
        block(-32, 32, -4, -2, 10, 92),
    )
    castors = merge(*(block(x, x + 4, y, y + 5, 0, 8) for x in (-31, 27) for y in (-46, -9)))
    cabinet.rest("Cabinet", merge(body, castors), (0, 0, 0))
    levels = (10.6, 30.6, 50.6, 66.6, 79.6)
    talls = (19.4, 19.4, 15.4, 12.4, 11.8)
    for number, (z, tall) in enumerate(zip(levels, talls, strict=True), 1):
        out = 22.0 if number == 4 else 0.6 if number == 2 else 0.0
        cabinet.put(f"Drawer_{number}", drawer(63, 42, tall), (0, -48 - out, z))
        cabinet.put(f"Handle_{number}", capsule((-15, 0, 0), (15, 0, 0), 0.8), (0, -50.5 - out, z + tall - 3))
    z = levels[3] + 1.8
    cabinet.rest("Socket_set", cube(20, 14, 5), (-14, -58, z), (0, 0, 7))
    cabinet.rest("Ratchet", [tube((-9, 0, 1), (9, 0, 1), 0.9), cyl(2, 2.4, 9)], (10, -62, z), (0, 0, 50))
    cabinet.rest("Tape_measure", cube(7, 3.6, 6), (22, -54, z), (0, 0, 10))
    cabinet.rest("Brake_cable_coil", shift(ring(9, 0.8, "z"), 0, 0, 0.8), (-10, -28, levels[0] + 1.8))
    cabinet.rest("Torch", capsule((-6, 0, 1.8), (6, 0, 1.8), 1.8), (16, -24, levels[1] + 1.8), (0, 0, 20))
    tray = open_box(44, 28, 2.2, 0.3)
    cabinet.rest("Rubber_tray", tray, (-6, -24, 95), (0, 0, -5))
    cabinet.rest("Torx_key_1", tube((-6, 0, 0.35), (6, 0, 0.35), 0.35), (-12, -26, 95.3), (0, 0, 20))
    cabinet.rest("Torx_key_2", tube((-5, 0, 0.35), (5, 0, 0.35), 0.35), (-2, -20, 95.3), (0, 0, -50))
    cabinet.rest("Crank_puller", [cyl(1.6, 6), cube(9, 1.6, 1.2, 0, 0, 5)], (6, -26, 95.3))
    holder = [cube(0.6, 8, 8, -34.5, -20, 74), tube((-34.5, -20, 78), (-62, -20, 78), 0.8)]
    cabinet.put("Paper_holder", holder, (0, 0, 0))
    # The hole of the roll has a radius of 2 cm: it hangs on the bar.
    cabinet.put("Paper_roll", [shift(ring(5.5, 3.4, "x"), x, 0, 0) for x in (-8, -3, 3, 8)], (-48.5, -20, 76.8))
