"""The operating room: the table, the lamp above it, trolleys, the drip stand and the anaesthesia machine."""

from benchmarks.scenes.vet.parts import bottle, drawer, wheels
from benchmarks.scenes.vet.shapes import (
    ball,
    box,
    crate,
    cup,
    cyl,
    lathe,
    moved,
    pillow,
    rod,
    sheet,
    slabs,
    strip,
    tube,
)
from benchmarks.scenes.vet.stage import Group, Practice

__all__ = ["build_theatre"]


def build_theatre(practice: Practice) -> None:
    """Add the room, without its shelves."""
    room = practice.group("R03_Theatre", (5800, 5200, 0))
    _table(room.group("OpTable", (0, 0, 0), 94))
    _lamp(room.group("OpLamp", (150, -200, 2700)))
    _drip(room.group("Drip", (-950, 350, 0)))
    _mayo(room.group("MayoStand", (620, -250, 0), -80))
    _trolley(room.group("Trolley", (1250, 300, 0), 90, 0.95))
    _anaesthesia(room.group("Anaesthesia", (-900, -700, 0), 35))


def _table(table: Group) -> None:
    base = [box(700, 440, 70, (0, 0, 0)), box(240, 200, 730, (0, 0, 70)), slabs((-700, 700, -270, 270, 800, 830))]
    rails = [
        part
        for s in (-1, 1)
        for part in (
            rod((-600, s * 290, 815), (600, s * 290, 815), 9),
            rod((-400, s * 268, 815), (-400, s * 290, 815), 7),
            rod((400, s * 268, 815), (400, s * 290, 815), 7),
        )
    ]
    table.put("OpTableBody", [*base, *rails])
    table.put("HeatPad", box(1150, 460, 24), (0, 0, 830))
    drape = strip(
        [(-330, -230), (-322, -40), (-300, 6), (-200, 4), (0, 4), (200, 4), (300, 6), (322, -40), (330, -180)], 900, 6
    )
    table.put("SurgicalDrape", moved(drape, rot=(0, 0, 90)), (-80, 0, 854), fixed=True)
    table.put("SandBag", pillow(260, 110, 60), (-250, 60, 861), (0, 0, 20), fixed=True)
    table.put(
        "RailClamp",
        [
            slabs((-30, 30, -14, 14, 9.5, 22), (-30, 30, -14, 14, -22, -9.5), (-30, 30, 10, 16, -9.5, 9.5)),
            cyl(9, 120, (0, 0, 21)),
            box(90, 30, 14, (0, 0, 140)),
        ],
        (440, 290, 815),
        fixed=True,
    )


def _lamp(lamp: Group) -> None:
    """A chain of arms under the ceiling; z = 0 is the ceiling."""
    lamp.put("LampPlate", [cyl(150, 40, (0, 0, -40)), cyl(40, 260, (0, 0, -300))], (0, 0, -1), fixed=True)
    lamp.put(
        "UpperArm",
        [cyl(55, 70, (0, 0, -372)), rod((0, 0, -337), (-560, 180, -360), 30), cyl(45, 80, (-560, 180, -400))],
        fixed=True,
    )
    lamp.put(
        "SpringArm",
        [cyl(40, 60, (-560, 180, -461)), rod((-560, 180, -430), (-140, 420, -700), 24), cyl(30, 50, (-140, 420, -730))],
        fixed=True,
    )
    head = lathe([(0, 90), (60, 88), (150, 66), (240, 30), (300, -22), (292, -26), (234, 18), (0, 34)], 32)
    bulbs = [cyl(40, 14, (x, y, 10)) for x, y in ((0, 0), (110, 0), (-110, 0), (0, 110), (0, -110))]
    lamp.put(
        "LampHead", [head, *bulbs, cyl(20, 80, (0, 0, 86)), cyl(22, 110, (0, 0, -75))], (-140, 420, -896), fixed=True
    )


def _drip(drip: Group) -> None:
    legs = [moved(rod((0, 0, 70), (300, 0, 62), 14), rot=(0, 0, a + 10)) for a in range(0, 360, 72)]
    rollers = [moved(ball(30, (300, 0, 0)), rot=(0, 0, a + 10)) for a in range(0, 360, 72)]
    arms = [
        moved(tube([(0, 0, 1895), (60, 0, 1905), (120, 0, 1890), (140, 0, 1905), (144, 0, 1925)], 5), rot=(0, 0, a))
        for a in (0, 90, 180, 270)
    ]
    drip.put("DripStand", [*legs, *rollers, cyl(12, 1900), cyl(20, 900), *arms])
    # The lowest point of an arm is at 120, 1890; its upper side is 5 mm higher.
    ring = tube([(118, -12, 1872), (118, -8, 1890), (118, 0, 1898.5), (118, 8, 1890), (118, 12, 1872)], 3)
    drip.put(
        "InfusionBag",
        [
            ring,
            box(110, 6, 16, (118, 0, 1858)),
            moved(pillow(210, 120, 42), (97, 0, 1760), (0, 90, 0)),
            cyl(9, 30, (118, 0, 1630)),
        ],
        fixed=True,
    )
    drip.put(
        "DripChamber", [cyl(4, 24, (118, 0, 1612)), cyl(11, 70, (118, 0, 1545)), cyl(4, 14, (118, 0, 1533))], fixed=True
    )
    line = [(118, 0, 1540), (118, 0, 1400), (126, -90, 1270), (100, -146, 1180), (96, -146, 1040)]
    drip.put(
        "DripTube",
        tube(
            [
                *line,
                (100, -146, 940),
                (180, -140, 700),
                (420, -260, 690),
                (560, -330, 760),
                (650, -336, 876),
                (760, -340, 866),
            ],
            3,
        ),
        fixed=True,
    )
    drip.put(
        "InfusionPump",
        [
            box(180, 110, 200, (90, -80, 1000)),
            slabs(
                (-18, 40, -26, -12.5, 1065, 1135), (-18, 40, 12.5, 22, 1065, 1135), (14, 40, -12.5, 12.5, 1065, 1135)
            ),
            box(90, 3, 60, (80, -136, 1100)),
        ],
        fixed=True,
    )


def _mayo(mayo: Group) -> None:
    frame = [rod((-230, s * 180, 40), (230, s * 180, 40), 14) for s in (-1, 1)]
    frame += [
        rod((-230, -180, 40), (-230, 180, 40), 14),
        rod((-230, 0, 40), (-230, 0, 880), 16),
        rod((-230, 0, 880), (-150, 0, 904), 14),
    ]
    ring = [rod((-190, s * 150, 905), (190, s * 150, 905), 8) for s in (-1, 1)]
    ring += [rod((s * 190, -150, 905), (s * 190, 150, 905), 8) for s in (-1, 1)]
    mayo.put("MayoFrame", [*frame, *ring, *wheels(230, 180, 20), rod((-150, 0, 904), (-190, 0, 905), 9)])
    mayo.put("MayoTray", crate(470, 350, 28, 2, 10), (0, 0, 913))
    mayo.put("TrayCloth", sheet(420, 310, 2), (0, 0, 915.5), (0, 0, 1), fixed=True)
    tools = {
        "Scalpel": [box(120, 10, 4, (0, 0, 0)), box(36, 8, 1, (74, 0, 1.5))],
        "NeedleHolder": [rod((-80, -14, 4), (60, 4, 4), 3), rod((-80, 14, 4), (60, -4, 4), 3)],
        "Tweezers": [rod((-60, -7, 4), (60, -1, 4), 3), rod((-60, 7, 4), (60, 1, 4), 3), box(14, 20, 6, (-62, 0, 1))],
        "SutureScissors": [rod((-70, -12, 4), (60, 5, 4), 3.5), rod((-70, 12, 4), (60, -5, 4), 3.5)],
        "Retractor": [strip([(-90, 8), (-84, 2), (60, 2), (80, 6), (84, 22)], 18, 3)],
    }
    for index, (name, parts) in enumerate(tools.items()):
        mayo.put(name, parts, (-120, -110 + 46 * index, 918), (0, 0, (4, -3, 8, -6, 2)[index]), fixed=True)
    mayo.put(
        "GauzeStack",
        [box(90, 90, 5, (0, 0, 5.2 * i), (0, 0, 3 * i)) for i in range(5)],
        (120, -80, 918),
        (0, 0, 9),
        fixed=True,
    )
    mayo.put("SteelBowl", cup(40, 66, 56, 2), (120, 70, 918))
    mayo.put("WetSwab_1", pillow(42, 38, 28, 9), (108, 60, 920.5), fixed=True)


def _trolley(cart: Group) -> None:
    posts = [rod((x, y, 74), (x, y, 860), 13) for x in (-340, 340) for y in (-220, 220)]
    grip = tube([(340, -220, 850), (390, -220, 880), (390, 220, 880), (340, 220, 850)], 12)
    cart.put("TrolleyFrame", [*posts, grip, *wheels(340, 220, 40)])
    for name, z in (("TopDeck", 800), ("LowDeck", 280)):
        cart.put(
            name,
            slabs(
                (-350, 350, -230, 230, z, z + 14),
                (-350, 350, -230, -224, z + 14, z + 50),
                (-350, 350, 224, 230, z + 14, z + 50),
                (-350, -344, -224, 224, z + 14, z + 50),
                (344, 350, -224, 224, z + 14, z + 50),
            ),
            fixed=True,
        )
    for index, (x, y) in enumerate([(-290, 150), (-200, 160)]):
        cart.put(f"Flask_{index + 1}", bottle(36, 190), (x, y, 814), (0, 0, 40 * index), block="Flask")
    cart.put(
        "YellowBin",
        [crate(150, 150, 200, 3), slabs((-77, 77, -77, 77, 200, 206), (-30, 30, -30, 30, 206, 222))],
        (240, 120, 814),
    )
    for index, (x, z, yaw) in enumerate([(-250, 0, 0), (-250, 80.5, 8)]):
        cart.put(f"SutureBox_{index + 1}", box(140, 90, 80), (x, -120, 814 + z), (0, 0, yaw), block="SutureBox")
    cart.put("NestDish_1", crate(200, 120, 45, 2, 18), (110, -120, 814))
    cart.put("NestDish_2", crate(200, 120, 45, 2, 18), (110, -120, 824), (0, 0, 1), fixed=True)
    cart.put("LinenPack_1", pillow(300, 240, 80), (-160, 0, 294))


def _anaesthesia(rig: Group) -> None:
    """Its front is towards -y."""
    posts = [box(40, 40, 1250, (x, 180, 100)) for x in (-260, 260)]
    deck = [box(600, 460, 50, (0, 0, 70)), box(560, 400, 24, (0, 0, 860)), box(560, 300, 24, (0, 60, 1330))]
    rails = slabs(
        (-280, 280, 190, 206, 1150, 1190),
        (-280, 280, -200, 200, 560, 572),
        (-280, -268, -200, 190, 572, 860),
        (268, 280, -200, 190, 572, 860),
    )
    rig.put("RigFrame", [*posts, *deck, rails, *wheels(260, 190, 36)], fixed=True)
    for index, (z, out) in enumerate([(590, 0), (720, 200)]):
        rig.put(f"RigDrawer_{index + 1}", drawer(520, 340, 90, 532, 6, 5), (0, -190 - out, z), fixed=True)
    for index, x in enumerate((-120, -70)):
        airway = [tube([(0, -110, 8), (0, 20, 8), (0, 90, 14), (0, 120, 40)], 7), cyl(11, 24, (0, -118, 8), (90, 0, 0))]
        rig.put(f"AirwayTube_{index + 1}", airway, (x, -240 + 10 * index, 730), (0, 0, 4 * index - 4), fixed=True)
    rig.put(
        "FacialMask",
        lathe([(0, 0), (44, 0), (50, 14), (20, 50), (14, 72), (10, 72), (15, 48), (44, 12), (40, 4), (0, 4)]),
        (130, -260, 725),
    )
    rig.put(
        "Vaporiser",
        [box(120, 110, 190, (0, -55, 0)), cyl(50, 50, (0, -55, 190)), box(60, 20, 40, (0, 2, 80))],
        (-120, 178, 1060),
        fixed=True,
    )
    rig.put(
        "FlowMeter",
        [
            box(150, 40, 260, (0, -20, 0)),
            *(cyl(8, 180, (x, -46, 50)) for x in (-45, 0, 45)),
            *(cyl(12, 20, (x, -40, 20), (90, 0, 0)) for x in (-45, 0, 45)),
        ],
        (120, 189, 1020),
        fixed=True,
    )
    rig.put(
        "AbsorberBase",
        [box(160, 160, 60), cyl(20, 330, (0, 90, 0)), box(120, 130, 50, (0, 40, 330))],
        (-190, -90, 884),
        fixed=True,
    )
    rig.put(
        "LimeCanister",
        [lathe([(0, 0), (68, 0), (68, 200), (64, 200), (64, 4), (0, 4)]), cyl(70, 20, (0, 0, 201))],
        (-190, -90, 945),
        fixed=True,
    )
    rig.put("SodaLime", cyl(62, 150), (-190, -90, 950), fixed=True)
    rig.put(
        "BreathingBag",
        [
            rod((62, 0, -10), (0, 0, -10), 14),
            cyl(14, 34, (0, 0, -44)),
            moved(pillow(180, 110, 90), (-45, 0, -130), (0, 90, 0)),
        ],
        (-310, -50, 1250),
        fixed=True,
    )
    for index, x in enumerate((-215,)):
        path = [
            (x, -115, 1240),
            (x + 10, -170, 1230),
            (x + 40, -320, 1100),
            (x + 90, -420, 950),
            (x + 230, -470, 930),
            (25, -500, 990),
        ]
        rig.put(f"CorrugatedHose_{index + 1}", tube(path, 15, 10), fixed=True)
    rig.put("YPiece", [ball(22, (25, -505, 970)), rod((25, -505, 992), (60, -540, 1040), 13)], fixed=True)
    for index, x in enumerate((-120,)):
        body = lathe([(0, 0), (70, 0), (70, 520), (40, 590), (20, 600), (20, 640), (0, 640)])
        rig.put(
            f"GasCylinder_{index + 1}",
            [body, box(60, 40, 30, (0, 0, 640))],
            (x, 310, 121),
            fixed=True,
            block="Cylinder5L",
        )
    rig.put("CylinderShelf", slabs((-240, 240, 231, 400, 104, 119), (-240, 240, 384, 400, 119, 220)), fixed=True)
    rig.put(
        "CylinderStrap",
        [slabs((-242, 242, 382, 388, 500, 540), (-242, -236, 180, 382, 500, 540), (236, 242, 180, 382, 500, 540))],
        fixed=True,
    )
    rig.put(
        "SupplyHose",
        tube([(-120, 310, 786), (-112, 302, 880), (-40, 270, 980), (60, 230, 1080), (130, 195, 1100)], 7),
        fixed=True,
    )
    rig.put(
        "VitalMonitor",
        [box(340, 160, 260, (0, 0, 20)), box(300, 100, 20), box(300, 4, 200, (0, -82, 50))],
        (-60, 50, 1354),
        (0, 0, 5),
    )
    lead = [
        (-180, -36, 1420),
        (-180, -60, 1390),
        (-190, -140, 1300),
        (-100, -330, 1060),
        (0, -330, 1000),
        (20, -240, 905),
        (40, -170, 892),
    ]
    rig.put("SensorLead", tube([*lead, (64, -115, 889)], 4), fixed=True)
    rig.put("SensorClip", [box(60, 24, 10), box(60, 24, 8, (0, 0, 14), (0, 6, 0))], (85, -90, 884), (0, 0, 50))
