"""The consulting room: its table, its walls and its computer."""

from math import cos, pi, sin

from benchmarks.scenes.vet.parts import bin_can, carrier, garment, hook, seat
from benchmarks.scenes.vet.shapes import (
    ball,
    box,
    crate,
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

__all__ = ["build_consult"]


def build_consult(practice: Practice) -> None:
    """Add the room, without its cabinets."""
    room = practice.group("R02_Consulting", (4750, 0, 0))
    _table(room.group("ExamTable", (2100, 1500, 0), 8))
    _floor(room)
    _computer(room.group("Workplace", (4850, 2300, 0), -90))
    _outer_wall(room.group("WestWall", (0, 2500, 0), 90))


def _table(table: Group) -> None:
    frame = [box(800, 420, 40), box(220, 160, 790, (0, 0, 40)), box(1250, 600, 30, (0, 0, 830))]
    rim = slabs((-625, 625, -300, -290, 860, 868), (-625, 625, 290, 300, 860, 868))
    table.put("TableBody", [*frame, rim], fixed=True)
    table.put("RubberMat", sheet(1180, 540, 6), (0, 0, 860.5), fixed=True)
    table.put(
        "BabyScale", [box(340, 260, 55), box(120, 4, 36, (0, -131, 10)), box(200, 150, 14, (0, 0, 55))], (-330, 40, 866)
    )
    table.put(
        "ScaleTray", strip([(-300, 70), (-240, 14), (-200, 3), (200, 3), (240, 14), (300, 70)], 330, 6), (-330, 40, 935)
    )
    table.put("TrayTowel", sheet(360, 260, 9), (-330, 40, 941), (0, 0, 4), fixed=True)
    ring = [(60 * cos(pi * i / 10), 90 * sin(pi * i / 10), 9) for i in range(16)]
    scope = [tube([*ring, (-20, -150, 9), (60, -190, 8), (150, -170, 8)], 5), cyl(22, 16, (165, -168, 0))]
    table.put("Stethoscope", [*scope, rod((60, 0, 9), (75, -30, 9), 3)], (230, 90, 866.5), fixed=True)
    table.put(
        "NailClipper",
        [rod((0, 0, 6), (110, 22, 6), 5), rod((0, 14, 6), (110, -10, 6), 5), cyl(8, 12, (58, 8, 0))],
        (420, -160, 867),
        fixed=True,
    )
    table.put("GauzeRoll", cyl(28, 70), (500, 120, 895), (90, 0, 20))
    table.put("KidneyDish", crate(230, 110, 45, 3, 14), (130, -170, 866.5), (0, 0, -12))
    table.put(
        "Forceps",
        [rod((-70, -4, 5), (70, -12, 5), 3), rod((-70, 4, 5), (70, 12, 5), 3), ball(5, (70, 12, 2))],
        (130, -170, 869),
        (0, 0, 15),
        fixed=True,
    )
    table.put("Swab", pillow(45, 40, 25, 10), (70, -150, 870), fixed=True)


def _floor(room: Group) -> None:
    stool = room.group("Stool", (2950, 950, 0), 31)
    spokes = [moved(rod((0, 0, 70), (240, 0, 58), 15), rot=(0, 0, a)) for a in range(0, 360, 72)]
    rollers = [moved(ball(25, (240, 0, 0)), rot=(0, 0, a)) for a in range(0, 360, 72)]
    stool.put("StoolBody", [*spokes, *rollers, cyl(25, 440, (0, 0, 60)), cyl(180, 60, (0, 0, 490))])
    room.put("OwnerChair", seat(), (700, 420, 0), (0, 0, 187), block="Seat")
    room.put("FoldedCoat", pillow(330, 300, 90), (700, 420, 450), (0, 0, 10))
    room.put("Carrier", carrier(), (1300, 420, 0), (0, 0, 172))
    room.put("CarrierFleece", pillow(380, 240, 40), (1300, 420, 6), (0, 0, 172))
    pedal = room.group("PedalBin", (4350, 380, 0), 200)
    pedal.put("BinBody", [bin_can(150, 420), box(70, 60, 12, (0, -150, 20))])
    liner = [(0, 6), (112, 6), (143, 412), (158, 428), (160, 330), (157, 330), (155, 424), (140, 410), (109, 9), (0, 9)]
    pedal.put("Liner", lathe(liner), fixed=True)
    pedal.put("BinLid", [cyl(152, 14), box(40, 14, 16, (0, 160, 0))], (0, 203, 583), (-105, 0, 0), fixed=True)
    for index, (x, y, z) in enumerate([(-40, 20, 10)]):
        pedal.put(
            f"UsedSwab_{index + 1}", pillow(80, 70, 55, 9), (x, y, z), (0, 0, 50 * index), fixed=True, block="Crumpled2"
        )


def _computer(place: Group) -> None:
    """A monitor and a keyboard tray on an arm at the partition to the east, seen from the room."""
    arm = [
        box(90, 18, 260, (0, -9, 1150)),
        rod((0, -25, 1290), (0, -300, 1290), 20),
        cyl(26, 70, (0, -300, 1255)),
        rod((0, -300, 1305), (-160, -420, 1305), 18),
        rod((0, -300, 1260), (0, -300, 1050), 16),
        rod((0, -300, 1062), (60, -440, 1062), 14),
    ]
    place.put("WallArm", arm, (0, -1.5, 0), fixed=True)
    place.put(
        "Monitor",
        [box(520, 30, 320, (0, 0, -160)), box(110, 26, 110, (0, 26, -55))],
        (-172, -483, 1310),
        (6, 0, 12),
        fixed=True,
    )
    place.put(
        "KeyboardTray",
        slabs((-260, 260, -110, 110, 0, 8), (-260, 260, -110, -104, 8, 22)),
        (60, -470, 1079),
        (0, 0, 4),
        fixed=True,
    )
    place.put(
        "Keyboard",
        [box(380, 130, 16), *(box(360, 20, 5, (0, y, 16)) for y in (-45, -15, 15, 45))],
        (10, -470, 1087.5),
        (0, 0, 4),
        fixed=True,
    )
    place.put("Mouse", pillow(58, 100, 32), (268, -450, 1087.5), (0, 0, 10), fixed=True)


def _outer_wall(wall: Group) -> None:
    """What hangs on Partition_B, in a frame whose y = 0 is its face."""
    box_frame = slabs(
        (-300, 300, -60, 0, 1300, 1310),
        (-300, 300, -60, 0, 1740, 1750),
        (-300, -290, -60, 0, 1310, 1740),
        (290, 300, -60, 0, 1310, 1740),
        (-290, 290, -54, -48, 1310, 1740),
    )
    clips = slabs((-230, -90, -66, -58, 1726, 1744), (90, 230, -66, -58, 1726, 1744))
    wall.put("LightBox", [box_frame, clips], (0, -2, 0), fixed=True)
    wall.put("XrayFilm", box(240, 1, 300), (-160, -63, 1432), (0, 1, 0), fixed=True)
    for index, x in enumerate((-900, 540)):
        wall.put(f"Hook_{index + 1}", hook(), (x, -0.5, 1600), fixed=True, block="WallHook")
    wall.put("LabCoat", garment(430, 980), (540, -20.5, 1606.5), fixed=True)
    clip = [
        slabs((-110, -9, -2, 2, -330, 0), (9, 110, -2, 2, -330, 0), (-9, 9, -2, 2, -330, -22), (-9, 9, -2, 2, -4, 0)),
        box(90, 12, 30, (0, -6, -56)),
    ]
    wall.put("Clipboard", clip, (-900, -20.5, 1608.5), (0, -2, 0), fixed=True)
    wall.put("PatientSheet", box(200, 1, 280), (-906, -23.5, 1284), (0, -2, 0), fixed=True)
    holder = slabs(
        *(
            (x0, x1, y0, y1, z + a, z + b)
            for z in (0, 150)
            for x0, x1, y0, y1, a, b in (
                (-128, 128, -104, 0, 0, 4),
                (-128, -124, -104, 0, 4, 60),
                (124, 128, -104, 0, 4, 60),
                (-124, 124, -104, -100, 4, 40),
            )
        ),
        (-128, 128, -4, 0, 4, 290),
    )
    wall.put("GloveHolder", holder, (-560, -1, 1150), fixed=True)
    for index in range(2):
        glove_box = slabs(
            (-118, 118, -44, 44, 0, 3),
            (-118, 118, -44, -41, 3, 128),
            (-118, 118, 41, 44, 3, 128),
            (-118, -115, -41, 41, 3, 128),
            (115, 118, -41, 41, 3, 128),
            (-115, -40, -41, 41, 125, 128),
            (40, 115, -41, 41, 125, 128),
        )
        wall.put(f"GloveBox_{index + 1}", glove_box, (-560, -52, 1154 + 150 * index), fixed=False, block="GloveBox")
    wall.put(
        "Glove", [pillow(70, 50, 120), box(40, 4, 60, (0, 0, 105), (12, 0, 8))], (-560, -52, 1154 + 150 + 4), fixed=True
    )
    sharps = wall.group("Sharps", (-560, 0, 880))
    sharps.put(
        "SharpsBracket",
        slabs(
            (-90, 90, -5, 0, 0, 180),
            (-90, 90, -130, -5, 0, 5),
            (-90, -85, -130, -5, 5, 40),
            (85, 90, -130, -5, 5, 40),
            (-85, 85, -130, -125, 5, 40),
        ),
        (0, -2, 0),
        fixed=True,
    )
    sharps.put("SharpsBin", [crate(150, 100, 170, 3, 5), slabs((-80, 80, -54, 54, 170, 176))], (0, -66, 5))
