"""The reception: its counter, and where people wait."""

from benchmarks.scenes.vet.parts import bag, bin_can, drawer, garment, hook, seat
from benchmarks.scenes.vet.shapes import ball, box, crate, cup, cyl, moved, pillow, rod, sheet, slabs, strip
from benchmarks.scenes.vet.stage import Group, Practice

__all__ = ["build_reception"]

TOP = 740.0
LEDGE = 1075.0


def build_reception(practice: Practice) -> None:
    """Add the reception, without its shelves."""
    room = practice.group("R01_Reception")
    counter = room.group("Counter", (3300, 2050, 0))
    _counter(counter)
    _ledge(counter)
    _pedestal(counter.group("Pedestal", (-700, 610, 0), 180))
    _staff(room)
    _waiting(room)
    _walls(room)


def _counter(desk: Group) -> None:
    top, sides = (-1100, 1100, 25, 620, 715, TOP), [(s - 12, s + 12, 25, 600, 0, 715) for s in (-1088, 1088)]
    desk.put(
        "Desk", slabs((-1100, 1100, 0, 25, 0, 1050), *sides, top, (-1120, 1120, -80, 220, 1050, LEDGE)), fixed=True
    )
    till = desk.group("Till", (600, 320, TOP))
    hollow = [(-200, 200, -210, 210, 0, 8), (-200, 200, -210, 210, 102, 110), (-200, 200, -210, -202, 8, 102)]
    walls = [(x, x + 8, -202, 210, 8, 102) for x in (-200, 192)]
    case = [slabs(*hollow, *walls), box(300, 240, 90, (0, -40, 110)), box(260, 14, 150, (0, 20, 195), (-20, 0, 0))]
    till.put("Case", case)
    till.put("CashDrawer", drawer(376, 390, 70, 396, 4, 5), (0, 355, 14), (0, 0, 180), fixed=True)
    till.put("CoinTray", crate(350, 200, 40, 4), (0, 245, 19.5), fixed=True)
    till.put("Notes", box(72, 150, 11), (-100, 240, 24), (0, 0, 4), fixed=True)
    till.put(
        "Coins", [cyl(12, 14, (x, y, 0)) for x, y in ((0, 0), (27, 3), (4, 28), (32, 30))], (60, 230, 23.5), fixed=True
    )
    printer = [
        slabs(
            (-70, 70, -80, 80, 0, 60),
            (-70, -62, -80, 80, 60, 130),
            (62, 70, -80, 80, 60, 130),
            (-62, 62, 72, 80, 60, 130),
            (-62, 62, -80, -72, 60, 130),
        )
    ]
    desk.put("ReceiptPrinter", printer, (230, 300, TOP))
    desk.put("PaperRoll", cyl(32, 80), (190, 300, TOP + 92), (0, 90, 0))
    desk.put("PhoneBase", [box(180, 190, 30), box(60, 120, 3, (40, 0, 29))], (960, 400, TOP), (0, 0, 170))
    desk.put(
        "Handset",
        [box(40, 190, 22), box(46, 46, 14, (0, -72, -6)), box(46, 46, 14, (0, 72, -6))],
        (915, 415, TOP + 36),
        (0, 0, 172),
        fixed=True,
    )
    desk.put(
        "Screen",
        [cyl(110, 10), box(50, 30, 130, (0, 20, 10)), box(510, 26, 310, (0, 0, 95))],
        (-150, 260, TOP),
        (0, 0, 180),
    )
    desk.put("Keys", [box(430, 130, 16), *(box(410, 20, 5, (0, y, 16)) for y in (-45, -15, 15, 45))], (-150, 480, TOP))
    desk.put("MousePad", box(210, 180, 3), (-480, 490, TOP), (0, 0, 6), fixed=True)
    desk.put("Mouse", pillow(60, 105, 34), (-470, 495, TOP + 3), (0, 0, 12), fixed=True)
    desk.put("PenPot", crate(80, 80, 100, 3), (-640, 270, TOP))
    for index, (x, y, ax, ay) in enumerate([(-15, 10, 12, 8), (12, 14, -10, 6)]):
        pen = [cyl(4.5, 140), cyl(2, 8, (0, 0, -6))]
        desk.put(f"Pen_{index + 1}", pen, (-640 + x, 270 + y, TOP + 11), (ax, ay, 0), fixed=True)


def _ledge(desk: Group) -> None:
    desk.put("Bell", [cyl(42, 8), ball(36, (0, 0, 6), 0.6), cyl(5, 14, (0, 0, 46))], (250, 60, LEDGE))
    cradle = slabs(
        (-45, 45, -70, 60, 0, 14), (-45, -40, -70, 60, 14, 34), (40, 45, -70, 60, 14, 34), (-40, 40, 54, 60, 14, 34)
    )
    desk.put("TerminalCradle", cradle, (560, 70, LEDGE))
    desk.put("CardTerminal", [box(78, 150, 30), box(60, 50, 4, (0, 40, 30))], (560, 35, LEDGE + 15), fixed=True)
    desk.put("TreatBowl", cup(50, 85, 60, 4), (-250, 70, LEDGE))
    spots = [(-24, -18, 4, 10), (22, -16, 4, 60)]
    for index, (x, y, z, yaw) in enumerate(spots):
        bone = [rod((-18, 0, 7), (18, 0, 7), 6), *(ball(9, (s * 20, t * 6, 0)) for s in (-1, 1) for t in (-1, 1))]
        desk.put(f"Biscuit_{index + 1}", bone, (-250 + x, 70 + y, LEDGE + z), (0, 0, yaw), fixed=True, block="Bone")
    desk.put("PlantPot", [cup(60, 80, 130, 5), cyl(70, 90, (0, 0, 10))], (-900, 60, LEDGE))
    leaves = [
        moved(strip([(0, 0), (40, 110), (120, 170), (180, 150)], 34, 3), rot=(0, 0, yaw)) for yaw in range(0, 360, 45)
    ]
    desk.put("Fern", leaves, (-900, 60, LEDGE + 95), fixed=True)


def _pedestal(group: Group) -> None:
    """Three drawers that open to the staff; the middle one is pulled out."""
    panels = [(-200, 200, 480, 498, 60, 640), (-200, -184, 20, 480, 60, 640), (184, 200, 20, 480, 60, 640)]
    group.put(
        "PedestalBody",
        [
            slabs(*panels, (-184, 184, 20, 480, 60, 76), (-184, 184, 20, 480, 624, 640)),
            *(box(30, 30, 61, (x, y, 0)) for x in (-170, 170) for y in (60, 440)),
        ],
    )
    for index, (z, out) in enumerate([(90, 0), (275, 260), (460, 0)]):
        pull = rod((-60, -30, 100), (60, -30, 100), 14)
        group.put(f"PedestalDrawer_{index + 1}", [drawer(360, 440, 130, 392), pull], (0, 20 - out, z), fixed=True)
    group.put(
        "Stapler",
        [box(38, 140, 14), box(34, 130, 22, (0, 4, 22), (6, 0, 0)), box(20, 20, 16, (0, 60, 10))],
        (-100, -130, 283),
        (0, 0, 25),
    )
    group.put("FileFolder", box(220, 310, 24), (50, -70, 283), (0, 0, 3))


def _staff(room: Group) -> None:
    chair = room.group("SwivelChair", (3150, 2960, 0), -15)
    legs = [moved(rod((0, 0, 75), (290, 0, 60), 18), rot=(0, 0, a)) for a in range(0, 360, 72)]
    rollers = [moved(ball(28, (290, 0, 0)), rot=(0, 0, a)) for a in range(0, 360, 72)]
    back = [box(60, 20, 300, (0, 215, 440), (-6, 0, 0)), box(420, 50, 380, (0, 240, 620), (-6, 0, 0))]
    chair.put("ChairFrame", [*legs, *rollers, cyl(28, 380, (0, 0, 60)), box(470, 450, 70, (0, 0, 430)), *back])
    fold = strip([(-52, -330), (-50, -100), (-46, -20), (-30, 6), (0, 10), (30, 6), (45, -20), (48, -300)], 390, 12)
    chair.put("Cardigan", fold, (0, 278, 995), (0, 6, 90), fixed=True)
    room.put("PaperBin", bin_can(130, 280), (4250, 3050, 0))
    for index, (x, y, z) in enumerate([(-35, 10, 4)]):
        room.put(
            f"PaperBall_{index + 1}",
            pillow(75, 70, 62, 9),
            (4250 + x, 3050 + y, z),
            (0, 0, 40 * index),
            fixed=True,
            block="Crumpled",
        )


def _waiting(room: Group) -> None:
    row = room.group("BeamSeats", (300, 1500, 0), 90)
    feet = [part for x in (-550, 550) for part in (box(60, 420, 30, (x, 0, 0)), box(50, 40, 320, (x, 20, 30)))]
    row.put("Beam", [*feet, box(1500, 60, 60, (0, 20, 350))])
    for index, x in enumerate((-500, 0, 500)):
        shell = strip([(-230, 26), (-205, 38), (-100, 28), (140, 28), (190, 50), (235, 200), (260, 400)], 460, 10)
        row.put(f"SeatShell_{index + 1}", moved(shell, rot=(0, 0, 90)), (x, 0, 387), fixed=True, block="SeatShell")
    row.put("PetMagazine", strip([(-105, 3), (0, 3), (105, 3)], 290, 5), (20, -10, 421), (0, 0, 30), fixed=True)
    row.put("Handbag", bag(280, 110, 220), (-500, 10, 421), (0, 0, -8))
    row.put("Wallet", box(110, 24, 85), (-470, 12, 426), (0, 0, -8))
    for index, (x, y, yaw) in enumerate([(1000, 3000, 4), (1560, 3010, -7)]):
        room.put(f"VisitorChair_{index + 1}", seat(), (x, y, 0), (0, 0, yaw), block="Seat")
    room.put("SeatPad", pillow(380, 380, 45), (1560, 3010, 450), (0, 0, -7))
    table = room.group("LowTable", (1180, 2100, 0), 12, 1.08)
    table.put(
        "Table",
        [
            box(700, 500, 24, (0, 0, 376)),
            *(rod((x, y, 0), (x * 0.95, y * 0.95, 378), 16) for x in (-310, 310) for y in (-210, 210)),
        ],
    )
    for index, (x, yaw) in enumerate([(-150, 3), (-140, -12)]):
        table.put(f"Journal_{index + 1}", box(210, 290, 6), (x, 10, 400 + 6.4 * index), (0, 0, yaw), fixed=True)
    table.put("ToyCrate", crate(260, 200, 120, 8), (170, 20, 400), (0, 0, -5))
    table.put("ToyBall", ball(40), (220, 40, 408))
    room.put("DoorMat", sheet(900, 550, 12), (1200, 420, 0), fixed=True)


def _walls(room: Group) -> None:
    rack = room.group("LeafletRack", (2000, 3350, 1150))
    slab = [(-180, 180, -6, 0, 0, 640)]
    for row in range(3):
        z = 20 + row * 200
        slab += [(-180, 180, -52, -6, z, z + 5), (-180, 180, -52, -48, z + 5, z + 90)]
        slab += [(x - 2, x + 2, -48, -6, z + 5, z + 90) for x in (-178, 0, 178)]
    rack.put("RackBody", slabs(*slab), (0, -1.5, 0), fixed=True)
    for index in range(6):
        x, z, count = -90 + 180 * (index % 2), 20 + 200 * (index // 2) + 5, 3 + 5 * ((index * 7) % 4)
        if index != 4:
            rack.put(f"Leaflets_{index + 1}", box(140, count, 190 - 3 * index), (x, -20 - count / 2, z), (-4, 0, 0))
    clock = [cyl(150, 30, (0, 0, 0), (90, 0, 0)), box(8, 3, 110, (0, -33, 0)), box(70, 3, 8, (30, -33, 0))]
    room.put("WallClock", clock, (3300, 3348, 2150), fixed=True)
    board = room.group("NoticeBoard", (0, 2700, 1300), 90)
    board.put("Cork", [box(800, 16, 560, (0, -8, 0)), *(box(830, 22, 20, (0, -11, z)) for z in (-12, 552))], fixed=True)
    for index, (x, z, yaw) in enumerate([(-220, 230, 2)]):
        board.put(f"Notice_{index + 1}", box(180, 1, 240), (x, -17.5, z), (0, yaw, 0), fixed=True)
        pin = [rod((0, -2, 0), (0, 8, 0), 1), cyl(5, 10, (0, -2, 0), (90, 0, 0))]
        board.put(f"Pin_{index + 1}", pin, (x, -18, z + 220), fixed=True, block="DrawingPin")
    scale = room.group("DogScale", (4250, 1450, 0), -90)
    scale.put(
        "Platform", [box(900, 500, 50, (0, 0, 12)), *(cyl(20, 13, (x, y, 0)) for x in (-380, 380) for y in (-190, 190))]
    )
    scale.put("RubberTop", sheet(860, 460, 5), (0, 0, 62), fixed=True)
    scale.put("Readout", [box(200, 45, 110), box(150, 3, 60, (0, -24, 28))], (0, 376, 1250), fixed=True)
    coats = room.group("CoatHooks", (0, 700, 1650), 90)
    for index, x in enumerate((-120, 80)):
        coats.put(f"CoatHook_{index + 1}", hook(), (x, -1, 0), fixed=True, block="WallHook")
    coats.put("Raincoat", garment(420, 820), (80, -21, 6.5), fixed=True)
