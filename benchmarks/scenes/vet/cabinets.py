"""The cabinets of the consulting room: a base run with a sink, a wall cabinet, and the dispensers between."""

from benchmarks.scenes.vet.parts import bar_handle, bottle, carcass, drawer, lidded
from benchmarks.scenes.vet.shapes import ball, box, crate, cup, cyl, moved, ring, rod, slabs, strip, tube
from benchmarks.scenes.vet.stage import Group, Practice

__all__ = ["build_cabinets"]

TOP = 900.0


def build_cabinets(practice: Practice) -> None:
    """Add the cabinets, in a frame whose y = 560 is the face of Partition_A."""
    run = practice.group("R02_Consulting/BaseRun", (2900, 2790, 0))
    run.put("RunCarcass", carcass(1800, 560, 100, 862, -300, 300), fixed=True)
    hole = [(-900, 380, -20, 560), (860, 900, -20, 560), (380, 860, -20, 60), (380, 860, 440, 560)]
    run.put("Worktop", slabs(*((*area, 862, TOP) for area in hole)), fixed=True)
    _drawers(run)
    _doors(run)
    _sink(run)
    _top(run.group("OnTop", (0, 0, TOP)))
    _wall(run.group("OnWall", (0, 560, 0)))


def _drawers(run: Group) -> None:
    for index, (z, out) in enumerate([(128, 0), (312, 0), (496, 330), (680, 0)]):
        handle = [moved(part, (0, -18, 105)) for part in bar_handle(200)]
        run.put(f"Drawer_{index + 1}", [drawer(552, 500, 120, 590), *handle], (-600, -out, z), fixed=True)
    pack = [box(34, 190, 16), box(24, 160, 8, (0, -5, 16))]
    for index, (x, y, z) in enumerate([(-800, -230, 0), (-760, -235, 0)]):
        run.put(f"SyringePack_{index + 1}", pack, (x, y, 504.5 + z), (0, 0, 3 * index), fixed=True, block="SyringePack")
    for index, (x, y, z) in enumerate([(-640, -270, 0), (-570, -265, 0)]):
        run.put(
            f"Bandage_{index + 1}",
            cyl(32, 50),
            (x, y, 504.5 + z + (32 if index == 3 else 0)),
            (90, 0, 0) if index == 3 else (0, 0, 0),
            block="Bandage",
        )


def _doors(run: Group) -> None:
    """A pair of doors in the middle, the left one open; one door, shut, below the sink."""
    for name, x, yaw, w, side in (
        ("DoorLeft", -272, -85, 288, 1),
        ("DoorRight", 292, 0, 288, -1),
        ("DoorSink", 308, 0, 580, 1),
    ):
        door = run.group(name, (x, -2 if yaw == 0 else -4, 0), yaw)
        door.put("Front", box(w, 18, 745, (side * w / 2, -9, 110)), fixed=True)
        door.put("Grip", bar_handle(160, upright=True), (side * (w - 40), -18, 680), fixed=True)
    run.put("InnerShelf", box(578, 470, 18, (0, 290, 470)), fixed=True)
    for index, (x, y, h) in enumerate([(-200, 180, 230), (-110, 200, 230)]):
        run.put(f"Disinfectant_{index + 1}", bottle(38, h), (x, y, 488))
    run.put("Cleaner", bottle(45, 270), (420, 230, 118))
    run.put(
        "TrapPipe",
        tube([(620, 250, 720), (620, 250, 520), (630, 290, 480), (650, 330, 520), (650, 530, 560)], 22),
        fixed=True,
    )
    run.put("SinkBucket", cup(100, 130, 220, 3), (630, 240, 118))


def _sink(run: Group) -> None:
    sides = [
        (385, 389, 65, 435, 724, TOP + 3),
        (851, 855, 65, 435, 724, TOP + 3),
        (389, 851, 65, 69, 724, TOP + 3),
        (389, 851, 431, 435, 724, TOP + 3),
    ]
    rim = [
        (370, 385, 50, 450, TOP, TOP + 3),
        (855, 870, 50, 450, TOP, TOP + 3),
        (385, 855, 50, 65, TOP, TOP + 3),
        (385, 855, 435, 450, TOP, TOP + 3),
    ]
    run.put("Basin", slabs((385, 855, 65, 435, 720, 724), *sides, *rim), fixed=True)
    spout = tube([(0, 0, 40), (0, 0, 240), (0, -30, 285), (0, -80, 300), (0, -130, 285), (0, -150, 240)], 12)
    run.put("Tap", [cyl(26, 45), spout, rod((20, 0, 45), (80, 0, 75), 7)], (620, 490, TOP))


def _top(top: Group) -> None:
    for index, x in enumerate((-820, -560)):
        top.put(f"Jar_{index + 1}", cup(52, 52, 150, 4), (x, 400, 0))
    top.put("JarLid_1", lidded(52, 0), (-820, 400, 151), fixed=True)
    top.put(
        "CottonBalls",
        [ball(19, (x, y, z)) for x, y, z in ((-20, -16, 0), (20, -16, 0), (0, 20, 0), (0, -4, 33), (14, 16, 60))],
        (-820, 400, 5),
        fixed=True,
    )
    for index, (x, y, ax, ay) in enumerate([(-16, 6, 7, 9), (4, -14, -8, 6)]):
        top.put(f"Spatula_{index + 1}", box(16, 2, 180), (-560 + x, 400 + y, 6), (ax, ay, 20 * index), fixed=True)
    tray = top.group("Tray", (-150, 300, 0), 9)
    tray.put("SteelTray", crate(360, 240, 24, 2, 12))
    tray.put(
        "Scissors",
        [rod((-80, 10, 5), (60, -12, 5), 4), rod((-80, -10, 5), (60, 12, 5), 4)],
        (20, -50, 2.5),
        (0, 0, -20),
        fixed=True,
    )
    top.put(
        "ClipperDock",
        [box(90, 110, 20), slabs((-45, -33, 20, 50, 20, 60), (33, 45, 20, 50, 20, 60), (-45, 45, 50, 55, 20, 90))],
        (170, 380, 0),
    )
    top.put("HairClipper", [box(56, 40, 150), box(50, 14, 30, (0, -8, 150))], (170, 400 - 1, 21), (-4, 0, 0))
    top.put("PaperRollStand", [cyl(80, 12), cyl(8, 300, (0, 0, 12))], (265, 200, 0))
    top.put(
        "KitchenRoll",
        ring(10, 62, 240),
        (265, 200, 12),
    )


def _wall(wall: Group) -> None:
    """What is on the wall above the run; y = 0 is the face of the wall."""
    upper = wall.group("WallCabinet", (-520, -322, 1450))
    upper.put(
        "UpperCarcass",
        slabs(
            (-400, 400, 0, 320, 0, 18),
            (-400, 400, 0, 320, 682, 700),
            (-400, -382, 0, 320, 18, 682),
            (382, 400, 0, 320, 18, 682),
            (-382, 382, 308, 320, 18, 682),
        ),
        fixed=True,
    )
    upper.put("GlassShelf", box(762, 270, 8, (0, 165, 340)), fixed=True)
    for name, x, yaw, side in (("GlassLeft", -398, 0, 1), ("GlassRight", 398, 70, -1)):
        leaf = upper.group(name, (x, -2, 0), yaw)
        leaf.put("Pane", box(396, 6, 690, (side * 199, -3, 5)), fixed=True)
    for index, (x, z, r, h) in enumerate([(-300, 18, 30, 130), (-100, 18, 40, 170), (120, 348, 24, 110)]):
        upper.put(f"Vial_{index + 1}", bottle(r, h), (x, 140 + 15 * (index % 3), z))
    for index in range(3):
        upper.put(
            f"PillBox_{index + 1}",
            box(130, 70, 42),
            (220, 150, 18 + 42.5 * index),
            (0, 0, 6 * index),
            fixed=True,
            block="PillBox",
        )
    soap = [box(110, 100, 220, (0, -50, 0)), box(60, 50, 14, (0, -105, 8)), cyl(8, 22, (0, -85, -20))]
    wall.put("SoapDispenser", soap, (480, -1, 1180), fixed=True)
    case = slabs(
        (-140, 140, -120, -114, 0, 320),
        (-140, 140, -4, 0, 0, 320),
        (-140, -134, -114, -4, 0, 320),
        (134, 140, -114, -4, 0, 320),
        (-134, 134, -114, -4, 314, 320),
        (-134, 134, -40, -4, 0, 6),
        (-134, 134, -114, -80, 0, 6),
    )
    wall.put("TowelDispenser", case, (800, -2, 1240), fixed=True)
    wall.put("PaperTowels", box(240, 90, 180), (800, -60, 1247), fixed=True)
    wall.put(
        "NextTowel", strip([(0, 10), (4, -30), (-6, -80), (8, -120)], 220, 2), (800, -62, 1240), (0, 0, 90), fixed=True
    )
    charger = wall.group("Otoscope", (240, 0, 1200))
    charger.put(
        "Charger",
        [
            box(200, 30, 160, (0, -15, 0)),
            slabs(
                *((x - 28, x + 28, a, b, 0, 8) for x in (-50, 50) for a, b in [(-86, -30)]),
                *((x + s * 26 - 2, x + s * 26 + 2, -86, -30, 8, 70) for x in (-50, 50) for s in (-1, 1)),
                *((x - 24, x + 24, -86, -82, 8, 70) for x in (-50, 50)),
            ),
        ],
        (0, -1, 0),
        fixed=True,
    )
    handle = [cyl(16, 150), cyl(20, 30, (0, 0, 150))]
    charger.put(
        "OtoscopeHandle",
        [*handle, rod((0, 0, 190), (0, -50, 200), 12), rod((0, -50, 200), (0, -76, 204), 6), ball(22, (0, 0, 172))],
        (-50, -57, 1207 - 1200 + 2),
        fixed=True,
    )
    charger.put("OphthalmoscopeHandle", [*handle, box(40, 26, 70, (0, 0, 178))], (50, -57, 9), fixed=True)
