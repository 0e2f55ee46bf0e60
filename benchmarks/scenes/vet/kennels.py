"""The kennel room: cages, leads, carriers, sacks, cleaning things and the laundry."""

from benchmarks.scenes.vet.parts import basket, bottle, carrier, hook, towel
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

__all__ = ["build_kennels"]

LEVELS = (90.0, 760.0, 1430.0)


def build_kennels(practice: Practice) -> None:
    """Add the room."""
    room = practice.group("R04_Kennels", (0, 3450, 0))
    _cages(room.group("CageBank", (1500, 2838, 0)))
    _leads(room.group("LeadRail", (0, 900, 1600), 90))
    _feed(room)
    _carriers(room.group("CarrierStack", (3450, 3100, 0), -12))
    _cleaning(room.group("Cleaning", (3300, 300, 0)))
    _laundry(room.group("Laundry", (1400, 622, 0), 180))
    _dryer(room.group("DryingRack", (1900, 1800, 0), 20))


def _cages(bank: Group) -> None:
    """Two columns of three cages: front at y = 0, back at y = 700."""
    panels = [(-900, 900, 0, 700, z - 20, z) for z in (*LEVELS, 2100)] + [(-900, 900, 690, 700, 90, 2080)]
    panels += [(x - 10, x + 10, 0, 690, 90, 2080) for x in (-890, 0, 890)]
    feet = [(x, x + 50, y, y + 50, 0, 70) for x in (-890, 840) for y in (10, 630)]
    bank.put("BankBody", slabs(*panels, *feet), fixed=True)
    turned = {(0, 1): -95, (1, 0): -60, (1, 2): -120}
    for row, z in enumerate(LEVELS):
        for column, x in enumerate((-876, 14)):
            name = f"{'LR'[column]}{row + 1}"
            grille = bank.group(f"Grille_{name}", (x, -8, z + 8), turned.get((column, row), 0))
            latch = [box(60, 12, 40, (835, -14, 290)), box(14, 30, 90, (850, -30, 265))]
            frame = [rod((0, 0, a), (860, 0, a), 8) for a in (4, 624)] + [
                rod((a, 0, 4), (a, 0, 624), 8) for a in (0, 860)
            ]
            frame.append(rod((0, 0, 160), (860, 0, 160), 5))
            grille.put(
                "Mesh",
                [*frame, *latch, *(rod((a, 0, 4), (a, 0, 624), 3.5) for a in range(50, 830, 65))],
                fixed=True,
                block="GrilleDoor",
            )
    for name, x, z, wide in (
        ("L1", -450, 90, 780),
        ("R1", 440, 90, 800),
        ("L2", -440, 760, 700),
        ("L3", -450, 1430, 760),
    ):
        bank.put(f"Bedding_{name}", sheet(wide, 420, 10, 14 if name != "L2" else 3), (x, 430, z), (0, 0, 3))
    bank.put(
        "Donut",
        lathe([(0, 0), (260, 0), (290, 40), (270, 100), (220, 110), (190, 60), (180, 30), (0, 30)], 28),
        (300, 380, 760),
        scale=0.8,
    )
    bank.put(
        "SleepingCat",
        [
            pillow(210, 170, 100),
            ball(42, (75, 40, 40)),
            tube([(-95, 30, 24), (-90, 75, 18), (-10, 108, 16), (50, 100, 16)], 14),
        ],
        (300, 380, 785),
        (0, 0, 30),
        fixed=True,
    )
    dog = [pillow(520, 230, 200), pillow(180, 130, 110, 10), ball(30, (-40, 60, 60))]
    bank.put(
        "SleepingDog",
        [
            dog[0],
            moved(dog[1], (290, -40, 20)),
            tube([(-240, 0, 60), (-310, -30, 30), (-330, -110, 20)], 16),
            *(rod((x, -90, 26), (x + 30, -200, 24), 22) for x in (-120, 150)),
        ],
        (-450, 430, 113),
        (0, 0, 8),
        fixed=True,
    )
    for name, x, y, z in (("L1", -790, 90, 90), ("R1", 150, 110, 90), ("L2", -760, 110, 760), ("R3", 130, 120, 1430)):
        bank.put(
            f"Bowl_{name}",
            lathe([(0, 0), (85, 0), (65, 45), (62, 47), (50, 12), (0, 12)]),
            (x, y, z),
            block="SteelBowl",
        )
    bank.put("Kibble_L1", pillow(90, 88, 20, 10), (-790, 90, 102.5), fixed=True)
    bank.put(
        "HangingBowl",
        [
            cup(45, 60, 60, 3),
            tube([(-30, 57, 52), (-30, 80, 60), (-30, 89, 66), (-30, 98, 62), (-30, 103, 48)], 3),
            tube([(30, 57, 52), (30, 80, 60), (30, 89, 66), (30, 98, 62), (30, 103, 48)], 3),
        ],
        (-300, 84, 1540),
        (0, 0, 180),
        fixed=True,
    )
    bank.put(
        "RubberBone",
        [rod((-50, 0, 16), (50, 0, 16), 13), *(ball(18, (s * 55, t * 12, 0)) for s in (-1, 1) for t in (-1, 1))],
        (-180, 120, 90),
        (0, 0, 40),
    )
    bank.put("TennisBall", ball(33), (640, 110, 90))
    bank.put("LitterTray", crate(300, 240, 80, 4, 14), (735, 200, 760), (0, 0, 90), fixed=True)
    bank.put("Litter", box(216, 276, 26), (735, 200, 764.5), fixed=True)
    bank.put("RecordCard", box(150, 1, 105), (-450, -12.3, 470), (0, 1, 0), fixed=True)
    bank.put("TowelOnTop", pillow(420, 330, 70), (-500, 350, 2100), (0, 0, 5))


def _leads(rail: Group) -> None:
    rail.put("HookBoard", box(900, 18, 90, (0, -9, -10)), (0, -1, 0), fixed=True)
    for index, x in enumerate((-360, -180, 180)):
        rail.put(f"LeadHook_{index + 1}", hook(), (x, -19, 0), fixed=True, block="WallHook")
    # A loop passes over the lowest point of its hook.
    for index, (x, length) in enumerate([(-360, 620), (180, 560)]):
        loop = [
            (-14, 0, -120),
            (-10, 0, -20),
            (0, 0, 7.5),
            (10, 0, -20),
            (14, 0, -120),
            (6, -3, -200),
            (10, -6, -length),
            (22, -6, -length - 16),
            (26, -6, -length + 20),
        ]
        rail.put(f"Lead_{index + 1}", tube([(4, 0, -200), *loop], 3.5), (x, -39, 0), fixed=True)
    ring = tube(
        [
            (70 * s, 0, c)
            for s, c in (
                (0.0, 7.5),
                (0.5, -2),
                (0.87, -28),
                (1.0, -63),
                (0.87, -98),
                (0.5, -124),
                (0.0, -133),
                (-0.5, -124),
                (-0.87, -98),
                (-1.0, -63),
                (-0.87, -28),
                (-0.5, -2),
                (0.0, 7.5),
            )
        ],
        3.5,
        6,
    )
    for index, y in enumerate((-34,)):
        rail.put(
            f"Collar_{index + 1}", ring, (-180, y, 0), (0, 0, 4 * index), fixed=True, block="CollarRing", scale=1.0
        )


def _feed(room: Group) -> None:
    feed = room.group("Feed", (420, 1900, 0), 80)
    for index, (x, y, z, yaw) in enumerate([(-320, 0, 0, 3), (-310, 10, 133, -6)]):
        feed.put(f"Sack_{index + 1}", pillow(480, 340, 132), (x, y, z), (0, 0, yaw), block="Sack15")
    feed.put("SackUpright", moved(pillow(560, 340, 150), (75, 0, 280), (0, 90, 0)), (180, 60, -2), (0, 0, 8))
    feed.put("FeedBin", lathe([(0, 0), (180, 0), (200, 480), (196, 480), (176, 4), (0, 4)], 28), (680, 20, 0))
    feed.put(
        "FeedBinLid",
        [cyl(204, 14), cyl(190, 10, (0, 0, -10)), tube([(-40, 0, 12), (-30, 0, 36), (30, 0, 36), (40, 0, 12)], 7)],
        (906.5, 15, 203.5),
        (0, 84, 0),
        fixed=True,
    )
    feed.put(
        "LooseKibble", lathe([(0, 4), (174, 4.0), (183, 230), (90, 270), (0, 275)], 28), (680, 20, 0.5), fixed=True
    )
    feed.put("Scoop", [cup(36, 50, 90, 3), rod((45, 0, 60), (150, 0, 90), 9)], (730, 15, 312), (0, -84, 0), fixed=True)


def _carriers(stack: Group) -> None:
    stack.put("Carrier_1", carrier(), (0, 0, 0), block="Carrier")
    stack.put("Carrier_2", carrier(), (5, 4, 341), (0, 0, 4), block="Carrier")
    stack.put("Carrier_3", carrier(), (0, 10, 682), (0, 0, -5), block="Carrier", scale=0.9)
    stack.put("CarrierTowel", sheet(360, 400, 16, 6), (0, 0, 6))


def _cleaning(corner: Group) -> None:
    """The bucket and the brooms; Partition_C is at x = 650, Partition_A at y = -300."""
    corner.put(
        "MopBucket",
        [crate(380, 300, 300, 5, 12), *(ball(20, (x, y, -38)) for x in (-150, 150) for y in (-110, 110))],
        (0, 150, 38),
    )
    corner.put(
        "Wringer",
        slabs(
            (-110, 110, -60, -55, -90, 40),
            (-110, 110, 55, 60, -90, 40),
            (-110, -105, -55, 55, -90, 40),
            (105, 110, -55, 55, -90, 40),
            (-105, 105, -55, 55, -90, -86),
            (-110, 110, -90, -60, 1, 6),
        ),
        (0, 72, 338),
        fixed=True,
    )
    corner.put(
        "Mop",
        [rod((0, 0, 30), (0, 0, 1350), 12), moved(pillow(130, 90, 60, 12), (0, 0, 0))],
        (40, 217, 53),
        (-15, 0, 0),
        fixed=True,
    )
    corner.put(
        "Broom",
        [box(320, 60, 30, (0, 0, 70)), box(310, 44, 72), rod((0, 0, 98), (0, 0, 1400), 12)],
        (320, -135, 2),
        (6.25, 0, 0),
        fixed=True,
    )
    hang = corner.group("Pegs", (-420, -300, 1350), 180)
    hang.put("PanHook", hook(), (0, -0.5, 0), fixed=True, block="WallHook")
    pan = [
        tube([(0, -2, 9), (14, -1, -6), (0, 0, -24), (-14, -1, -6), (0, -2, 9)], 3),
        box(24, 12, 180, (0, 0, -200)),
        box(240, 10, 230, (0, 8, -430)),
        box(240, 60, 10, (0, -20, -432)),
    ]
    hang.put("DustPan", pan, (0, -19, -1.5), fixed=True)
    corner.put(
        "FireExtinguisher",
        [
            lathe([(0, 0), (75, 0), (75, 380), (40, 440), (22, 450), (22, 470), (0, 470)]),
            box(40, 110, 24, (0, -20, 472)),
            tube([(0, 30, 460), (60, 40, 430), (86, 10, 300), (86, 0, 120)], 9),
        ],
        (560, 900, 900),
        (0, 0, -90),
        fixed=True,
    )
    corner.put(
        "ExtinguisherBracket",
        slabs((644, 650, 860, 940, 880, 1300), (470, 644, 860, 940, 893, 899)),
        (-1, 0, 0),
        fixed=True,
    )


def _laundry(place: Group) -> None:
    """The washing machine: front at y = 0, back to Partition_A at y = 620."""
    drum = slabs(
        (-300, 300, 0, 600, 0, 20),
        (-300, 300, 0, 600, 830, 850),
        (-300, -290, 0, 600, 20, 830),
        (290, 300, 0, 600, 20, 830),
        (-290, 290, 590, 600, 20, 830),
        (-290, 290, 0, 10, 20, 180),
        (-290, 290, 0, 10, 660, 830),
        (-290, -200, 0, 10, 180, 660),
        (200, 290, 0, 10, 180, 660),
    )
    place.put("WasherBody", [drum, box(520, 8, 70, (20, -3, 740)), cyl(26, 22, (180, 0, 775), (90, 0, 0))])
    ring = moved(
        lathe([(0, 0), (235, 0), (240, 20), (240, 440), (235, 440), (235, 22), (225, 6), (0, 6)], 32), (0, 0, 0)
    )
    shaft = rod((0, 470, 420), (0, 591, 420), 25)
    place.put("Drum", [moved(ring, (0, 470, 420), (90, 0, 0)), shaft], fixed=True)
    door = place.group("WasherDoor", (-215, -6, 420), -105)
    door.put(
        "Porthole",
        [
            moved(
                lathe(
                    [
                        (0, 40),
                        (90, 38),
                        (140, 10),
                        (150, 0),
                        (205, 0),
                        (205, -24),
                        (150, -24),
                        (138, -4),
                        (88, 32),
                        (0, 34),
                    ],
                    32,
                ),
                (215, 0, 0),
                (-90, 0, 0),
            ),
            box(26, 18, 60, (14, -6, -30)),
        ],
        fixed=True,
    )
    for index, (x, y, w, h, yaw) in enumerate([(0, 270, 225, 90, 6), (20, 330, 215, 80, 60)]):
        place.put(f"WashTowel_{index + 1}", pillow(w, 190, h), (x, y, 205 + 90 * index), (0, 0, yaw), fixed=True)
    sock = strip([(-30, 60), (-24, 4), (0, -8), (24, -30), (30, -120)], 70, 10)
    place.put("WashCloth", moved(sock, rot=(0, 0, 90)), (30, 6, 197), (0, 0, 180), fixed=True)
    place.put("DetergentBox", box(200, 130, 260), (-160, 350, 850), (0, 0, 7))
    place.put("SoftenerBottle", bottle(55, 280), (40, 380, 850))
    place.put("LaundryBasket", basket(480, 360, 300), (720, 250, 0), (0, 0, 8))
    place.put("DirtyBlanket_1", pillow(440, 320, 130), (720, 250, 6), (0, 0, 8))


def _dryer(rack: Group) -> None:
    legs = [rod((x, s * 280, 8), (x, -s * 140, 920), 10) for x in (-420, 420) for s in (-1, 1)]
    rails = [rod((-425, y, 920), (425, y, 920), 7) for y in (-140, -70, 0, 70, 140)]
    sides = [rod((x, -140, 920), (x, 140, 920), 8) for x in (-420, 420)]
    rack.put(
        "DryerFrame",
        [*legs, *rails, *sides, rod((-420, -280, 10), (420, -280, 10), 8), rod((-420, 280, 10), (420, 280, 10), 8)],
    )
    hung = [
        ("Towel_1", -140, 340, 300, 360, -170),
        ("Towel_2", 140, 300, 330, 340, 150),
        ("Towel_3", 0, 260, 240, 300, 30),
    ]
    for name, y, front, back, width, x in hung:
        rack.put(name, moved(towel(front, back, width, 11), rot=(0, 0, 90)), (x, y, 920), fixed=True)
