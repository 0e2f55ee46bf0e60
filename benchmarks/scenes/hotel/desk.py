"""The desk with its television and tray of tea, and the minibar beside it."""

from benchmarks.scenes.hotel.bed import PLUG, SOCKET
from benchmarks.scenes.hotel.shapes import Part, ball, box, crate, cup, cyl, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["BOTTLE", "CUP", "SAUCER", "SPOON", "build_desk", "build_minibar"]

CUP = (cup(2.6, 4.2, 6.5, 0.35), tube([(3.6, 5.2, 0), (5.8, 5, 0), (6, 2.8, 0), (3.2, 2, 0)], 0.35, 6))
SAUCER = (lathe([(0.001, 0), (4, 0), (7.4, 1.5), (7.3, 1.8), (3.8, 0.4), (0.001, 0.4)]),)
SPOON = (ball(2.4, 0.5, 3.6, (0, 0, 4.5)), tube([(0, 0.4, 3), (0, 0.5, 0), (0, 0.3, -6)], 0.22, 6))
BOTTLE = (lathe([(0.001, 0), (3.2, 0), (3.2, 13), (1.2, 18), (1.2, 22), (1.5, 22), (1.5, 23.5), (0.001, 23.5)]),)
CAN = (lathe([(0.001, 0), (2.8, 0), (3.3, 1), (3.3, 11), (2.8, 12), (0.001, 12)]),)


def build_desk(hotel: Hotel) -> None:
    """Add the desk at the south wall, a chair and the television on its arm."""
    desk = hotel.group("guest_room/desk", (115, 0, 391), 180)
    top = (
        (-70, 70, 72, 75, -28, 28),
        (-69, -66, 0, 72, -26, 26),
        (66, 69, 0, 72, -26, 26),
        (-66, 66, 40, 72, -26, -24),
    )
    desk.put("desk_body", slabs(*top))
    walls = ((-24, -23, 1, 8, -20, 24), (23, 24, 1, 8, -20, 24), (-23, 23, 1, 8, -20, -19))
    drawer = slabs((-24, 24, 0, 1, -20, 24), *walls, (-26, 26, -0.5, 9.6, 24, 26))
    desk.put("desk_drawer", drawer, (30, 62, 0), fixed=True)
    desk.put("drawer_bar", tube([(-6, 0, 0), (-6, 0, 2.2), (6, 0, 2.2), (6, 0, 0)], 0.5, 6), (30, 66.5, 26), fixed=True)
    desk.group("in_drawer", (30, 63, 0)).put("stationery_set", box(22, 1.6, 31), (-2, 0, 2), (0, 5, 0))
    chair = desk.group("chair", (-4, 0, 44), 176, unit=2.54)
    legs = [(x, x + 3.5, 0, 43, z, z + 3.5) for x in (-21, 17.5) for z in (-20, 17)]
    back = ((-21, -17.5, 43, 88, -20, -17), (17.5, 21, 43, 88, -20, -17), (-17.5, 17.5, 62, 86, -19.5, -17.5))
    chair.put("desk_chair", slabs(*legs, (-22, 22, 43, 45.5, -21, 21), *back))
    chair.put("seat_pad", puff(40, 4, 38, 0.2), (0, 45.5, 2.5))
    chair.put(
        "scarf",
        tube([(-8, 50, -21.2), (-8, 85, -20.9), (-8, 87.7, -18.5), (-8, 85, -16.1), (-8, 60, -16)], 1.2),
        fixed=True,
    )
    chair.put(
        "shoulder_bag",
        [
            crate(30, 22, 9, 0.8),
            tube([(-13, 21, 0), (-10, 40, -3), (-2, 45, -7.4), (2, 45, -7.4), (10, 40, -3), (13, 21, 0)], 0.8),
        ],
        (26.6, 43.9, -18.4),
        (0, 90, 0),
        fixed=True,
    )
    things = desk.group("on_top", (0, 75, 0))
    _screen(things)
    _tea(things.group("tea_tray", (-44, 0, 6), 8))
    _writing(things)
    under = hotel.group("guest_room/waste", (64, 0, 386), 20)
    under.put("waste_bin", cup(9.5, 12, 27, 0.5))
    under.put("paper_ball_01", puff(7, 6.6, 7.2, 0.9), (-2.6, 0.5, 1))


def _screen(top: Group) -> None:
    # The desk's back is 1 cm from the wall, which is at z = -29.
    arm = [
        box(20, 24, 1.4, (0, 48, -28.2)),
        tube([(0, 60, -27.6), (0, 60, -24), (14, 60, -16), (2, 60, -7.6)], 1.6),
        box(12, 12, 1, (2, 54, -6.6), (0, 20, 0)),
    ]
    top.put("tv_arm", arm, fixed=True)
    screen = top.group("tv", (2, 60, -6), 20)
    screen.put("tv_panel", [box(92, 54, 3, (0, -27, 2.3)), box(40, 22, 2, (0, -11, 1.4))], fixed=True)
    screen.put("soundbar", box(70, 5, 6), (0, -32.2, 3), fixed=True)
    top.put("tv_socket", SOCKET, (40, 22, -28.8), fixed=True, asset="socket")
    top.put("tv_plug", PLUG, (40, 22, -28.9), fixed=True, asset="plug")
    top.put("tv_cable", tube([(40, 22, -25), (40, 24, -20), (30, 45, -20), (14, 55, -10.8)], 0.35, 6), fixed=True)


def _tea(tray: Group) -> None:
    rim = slabs(
        (-22, 22, 0, 0.8, -15, 15),
        (-22, -21, 0.8, 3, -15, 15),
        (21, 22, 0.8, 3, -15, 15),
        (-21, 21, 0.8, 3, -15, -14),
        (-21, 21, 0.8, 3, 14, 15),
    )
    tray.put("tray", rim)
    tray.put("kettle_base", [cyl(8.5, 2), box(4, 1.6, 3, (0, 0, -8))], (-12, 0.8, -4))
    spout = tube([(6, 13, 0), (9.5, 17, 0)], 1.5)
    grip = tube([(-6.2, 16.6, 0), (-11, 17, 0), (-11.5, 8, 0), (-7, 5, 0)], 1.1)
    kettle = lathe([(0.001, 0), (8, 0), (7.5, 12), (5.6, 19), (5.2, 19), (7.1, 12), (7.6, 0.5), (0.001, 0.5)])
    tray.put("kettle", [kettle, spout, grip], (-12, 2.8, -4), (0, 150, 0))
    tray.put(
        "kettle_lid",
        [lathe([(0.001, 0), (5.8, 0), (5, 1.2), (0.001, 1.6)]), ball(2, 2, 2, (0, 1.4, 0))],
        (-12, 21.8, -4),
    )
    tray.put("saucer_01", SAUCER, (9.4, 0.8, 2.5), asset="saucer")
    tray.put("tea_cup_01", CUP, (8.9, 1.2, 2.5), (0, 30, 0), asset="tea_cup")
    tray.put("teaspoon_01", SPOON, (13.8, 1.5, 3.5), (8, 10, 0), fixed=True)
    tray.put("sachet_bowl", cup(4, 6, 5, 0.4), (-7, 0.8, 8.9))
    for index, (x, z, tilt, turn) in enumerate(((-1.6, 0, 62, 5), (0, 0.4, 66, -8)), 1):
        name = ("tea_sachet", "sugar_stick")[index - 1]
        tray.put(
            f"{name}_{index:02}",
            box(3.2 if index < 2 else 1.6, 0.35, 6),
            (x - 7, 4, z + 8.9),
            (tilt, turn, 0),
            fixed=True,
        )


def _writing(top: Group) -> None:
    laptop = top.group("laptop", (12, 0, 6), -6)
    laptop.put("laptop_base", box(33, 1.6, 23))
    laptop.put("laptop_lid", box(33, 21.5, 0.7), (0, 1.75, -11.1), (-16, 0, 0), fixed=True)
    top.put("guest_directory", [box(24, 2.4, 32), box(22, 0.3, 30, (0, 2.4, 0))], (50, 0, 6), (0, -12, 0))
    top.put(
        "spectacles",
        [
            tube([(-6.5, 0.25, 6), (-6.5, 2, -6), (0, 2.4, -6.4), (6.5, 2, -6), (6.5, 0.25, 6)], 0.25, 6),
            *(cyl(2.3, 0.3, (x, 1.8, -6.3), (90, 0, 0)) for x in (-3.4, 3.4)),
        ],
        (51, 3.05, 6),
        (0, 30, 0),
    )
    lamp = (
        cyl(8, 1.6),
        tube([(0, 1, 0), (0, 30, 0), (5, 36, 0), (16, 34, 0)], 0.7),
        moved(lathe([(0.001, 6), (2, 6), (6, 0), (5.6, 0), (1.6, 5.6), (0.001, 5.6)]), (17, 29, 0)),
    )
    top.put("desk_lamp", lamp, (57, 0, -18), (0, 230, 0))


def build_minibar(hotel: Hotel) -> None:
    """Add the open minibar and the glasses on it, right of the desk."""
    bar = hotel.group("guest_room/minibar", (216, 0, 394), 180)
    bar.put("fridge_body", crate(48, 74, 48, 3, side="front"))
    door = bar.group("door", (24, 1.4, 24.6), 108)
    # Its hinge is at the origin; shut, it reaches to the left along -x.
    door.put("fridge_door", slabs((-48, 0, 0, 73, 0, 4), (-45, -44, 4, 69, -1, 0), (-4, -3, 4, 69, -1, 0)), fixed=True)
    door.put("door_pull", tube([(-44, 50, 4), (-44, 50, 7), (-44, 66, 7), (-44, 66, 4)], 0.6, 6), fixed=True)
    for index, y in enumerate((6, 38), 1):
        rack = slabs(
            (-44, -4, 0, 0.8, -9, 0),
            (-44, -4, 0.8, 8, -9, -8.4),
            (-44, -43.4, 0.8, 8, -8.4, 0),
            (-4.6, -4, 0.8, 8, -8.4, 0),
        )
        door.put(f"door_rack_{index:02}", rack, (0, y, -0.1), fixed=True, asset="minibar_door_rack")
    for index, x in enumerate((-12, -33), 1):
        door.put(f"water_bottle_{index:02}", BOTTLE, (x, 6.8, -4.5), asset="water_bottle")
    door.put("tonic_can_01", CAN, (-14, 38.8, -4.4), asset="can")
    for index, y in enumerate((27, 50), 1):
        wires = [tube([(-20 + 5 * i, 0, -19), (-20 + 5 * i, 0, 17)], 0.3, 6) for i in range(9)]
        ends = [tube([(-20.9, 0, z), (20.9, 0, z)], 0.35, 6) for z in (-19, 17)]
        bar.put(f"wire_shelf_{index:02}", [*wires, *ends], (0, y, 0), fixed=True, asset="wire_shelf")
    for index, (x, z) in enumerate(((-13, 4.0), (-4, 6.0)), 1):
        bar.put(f"juice_bottle_{index:02}", BOTTLE, (x, 27.3, z), asset="water_bottle", scale=0.78)
    bar.put("chocolate_bar", box(16, 1.2, 7), (10, 27.3, 5), (0, 25, 0))
    for index, (x, z) in enumerate(((-12, 8), (-4, 8.5)), 1):
        bar.put(f"beer_can_{index:02}", CAN, (x, 50.3, z), asset="can")
    bar.put("bar_carton", crate(20, 9, 14, 0.4), (6, 3, 4), (0, 12, 0))
    for index, x in enumerate((-4, 3), 1):
        bar.put(f"miniature_{index:02}", BOTTLE, (6 + x, 3.4, 4 - 0.2 * x), asset="water_bottle", scale=0.5)
    top = bar.group("on_top", (0, 74, 0), 5)
    top.put("glass_mat", box(40, 0.4, 22), (0, 0, 2))
    wine = lathe(
        [(0.001, 0), (3.4, 0), (0.5, 0.8), (0.5, 8), (3.6, 12), (3.2, 18), (3, 18), (3.4, 12), (0.4, 8.4), (0.001, 8.3)]
    )
    top.put("wine_glass_01", wine, (-12, 0.4, 6))
    top.put("tumbler_upside_down", cup(3.2, 3.8, 9, 0.3), (-11, 9.4, -3), (180, 0, 0))
    bucket = (
        cup(8, 10, 18, 0.5),
        tube([(-10, 15, 0), (-12, 14, 0), (-12, 11, 0), (-9.4, 10, 0)], 0.5, 6),
        tube([(10, 15, 0), (12, 14, 0), (12, 11, 0), (9.4, 10, 0)], 0.5, 6),
    )
    top.put("ice_bucket", bucket, (9, 0.4, 1), (0, 25, 0))
    top.put("sparkling_wine", BOTTLE, (10, 1.7, 2), (7, 0, -9), fixed=True, asset="water_bottle", scale=1.25)
    tongs: list[Part] = [tube([(-1.2, 0, 0), (-1.4, 13, 0), (0, 21, 0), (1.4, 13, 0), (1.2, 0, 0)], 0.3, 6)]
    top.put("ice_tongs", tongs, (4.4, 1.6, -1), (-5, 30, 7), fixed=True)
