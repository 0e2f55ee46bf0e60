"""The shelves, the bench and the walls of the operating room."""

from benchmarks.scenes.vet.parts import basket, bin_can, carcass, hook, open_box
from benchmarks.scenes.vet.shapes import box, cyl, lathe, pillow, rod, slabs, tube
from benchmarks.scenes.vet.stage import Group, Practice

__all__ = ["build_stores"]


def build_stores(practice: Practice) -> None:
    """Add what stands and hangs along the walls."""
    room = "R03_Theatre"
    _rack(practice.group(f"{room}/WireRack", (-700, 1340, 0)))
    _bench(practice.group(f"{room}/Bench", (900, 1250, 0)))
    _walls(practice.group(f"{room}/EastWall", (1750, -150, 0), -90))
    floor = practice.group(f"{room}/Loose", (0, 0, 0))
    floor.put("WasteBin", bin_can(160, 460), (-1400, 900, 0))
    floor.put(
        "WasteBag",
        lathe(
            [(0, 6), (122, 6), (152, 450), (168, 468), (170, 380), (167, 380), (165, 464), (149, 448), (119, 9), (0, 9)]
        ),
        (-1400, 900, 0),
        fixed=True,
    )
    floor.put("UsedDrape", pillow(200, 190, 120), (-1400, 900, 11), fixed=True)


def _rack(rack: Group) -> None:
    posts = [cyl(14, 1850, (x, y, 0)) for x in (-590, 590) for y in (40, 420)]
    rack.put("RackPosts", posts)
    for index, z in enumerate((150, 600, 1050, 1500)):
        wires = [rod((-590, y, z), (590, y, z), 4) for y in range(40, 421, 38)]
        wires += [rod((x, 40, z - 6), (x, 420, z - 6), 4) for x in (-580, -290, 0, 290, 580)]
        rack.put(f"WireShelf_{index + 1}", wires, fixed=True, block=f"WireShelf{index + 1}")
    carton = slabs((-150, 150, -120, 120, 0, 160))
    spots = [
        (-420, 230, 154, 0),
        (-415, 235, 315, 3),
        (-80, 230, 154, -2),
        (-85, 225, 315, 2),
        (-80, 228, 476 - 160 + 159, 0),
    ]
    for index, (x, y, z, yaw) in enumerate([spot for spot in spots if spot[2] != 475]):
        rack.put(f"Carton_{index + 1}", carton, (x, y, z), (0, 0, yaw), block="CartonA")
    rack.put("Basket_1", basket(340, 300, 150), (320, 230, 154))
    rack.put("Basket_2", basket(340, 300, 150), (-30, 230, 604))
    for index, (x, y, z) in enumerate([(-80, -60, 6), (80, -60, 6), (0, 70, 6)]):
        rack.put(
            f"SterilePack_{index + 1}",
            pillow(140, 110, 62),
            (-30 + x, 230 + y, 604 + z),
            (0, 0, 15 * index),
            block="Pack",
        )
    rack.put("DrapeBundle_1", pillow(280, 250, 90), (320, 230, 160), fixed=True)
    for index, (z, yaw) in enumerate([(0, 0), (61, 5), (122, -4)]):
        rack.put(f"GlovePack_{index + 1}", box(240, 130, 60), (380, 220, 604 + z), (0, 0, yaw), block="GlovePack")
    rack.put("OpenCarton", open_box(260, 260, 180), (-400, 230, 1054))
    for index, (x, y) in enumerate([(-60, -60), (60, -60)]):
        rack.put(f"SalineBottle_{index + 1}", cyl(42, 190), (-400 + x, 230 + y, 1058), block="Saline")
    rack.put(
        "SterilisationCase",
        [
            slabs((-220, 220, -130, 130, 0, 120), (-226, 226, -136, 136, 120, 150)),
            tube([(-60, -130, 60), (-60, -158, 60), (60, -158, 60), (60, -130, 60)], 5),
        ],
        (60, 230, 1054),
    )


def _bench(bench: Group) -> None:
    """A low cabinet without doors with the autoclave on it; its back is the outer wall at y = 550."""
    bench.put("BenchBody", carcass(1100, 550, 90, 820, 0), fixed=True)
    bench.put("BenchTop", box(1130, 580, 36, (0, 262, 820)), fixed=True)
    bench.put("VetbedRoll", cyl(140, 420), (280, 480 - 10, 248), (90, 0, 0))
    oven = slabs(
        (-240, 240, -230, 230, 0, 40),
        (-240, 240, -230, 230, 340, 380),
        (-240, -190, -230, 230, 40, 340),
        (190, 240, -230, 230, 40, 340),
        (-190, 190, 190, 230, 40, 340),
    )
    steri = bench.group("Autoclave", (-220, 270, 856))
    steri.put("AutoclaveBody", [oven, box(120, 6, 26, (150, -232, 346))])
    door = steri.group("AutoclaveDoor", (-205, -246, 190), -100)
    door.put("DoorDisc", [cyl(170, 26, (190, 0, 0), (90, 0, 0)), box(60, 24, 40, (20, -13, -20))], fixed=True)
    for index, z in enumerate((70, 180)):
        steri.put(
            f"SteriTray_{index + 1}",
            slabs(
                (-186, 186, -210, 170, z, z + 3),
                (-186, -183, -210, 170, z + 3, z + 22),
                (183, 186, -210, 170, z + 3, z + 22),
                (-183, 183, -210, -207, z + 3, z + 22),
            ),
            fixed=True,
        )
    steri.put(
        "SteriClamp",
        [rod((-70, -8, 5), (60, 6, 5), 4), rod((-70, 8, 5), (60, -6, 5), 4)],
        (-60, -60, 73),
        (0, 0, 30),
        fixed=True,
    )
    steri.put("SteriPouch", pillow(180, 120, 26), (50, -20, 183), (0, 0, 15), fixed=True)


def _walls(wall: Group) -> None:
    board = wall.group("WhiteBoard", (-300, 0, 1100))
    board.put(
        "BoardPanel",
        [box(1000, 18, 700, (0, -9, 0)), slabs((-300, 300, -80, -18, 0, 4), (-300, 300, -80, -76, 4, 16))],
        (0, -2, 0),
        fixed=True,
    )
    for index, x in enumerate((-180,)):
        board.put(
            f"Marker_{index + 1}",
            [cyl(8, 100, (0, 0, 8), (0, 90, 0)), cyl(9, 40, (95, 0, 9), (0, 90, 0))],
            (x, -48, 5),
            (0, 0, 2 * index - 1),
            fixed=True,
        )
    board.put("Eraser", [box(110, 44, 14), box(110, 40, 20, (0, 0, 14))], (220, -52, 4.5), fixed=True)
    for index, (x, z) in enumerate([(-300, 560), (320, 300)]):
        board.put(
            f"Magnet_{index + 1}",
            cyl(15, 8),
            (x, -21.5 if index < 2 else -20, z),
            (90, 0, 0),
            fixed=True,
            block="RoundMagnet",
        )
    board.put("OpPlan", box(210, 1, 297), (-300, -20.8, 300), (0, -2, 0), fixed=True)
    wall.put(
        "TheatreClock", [cyl(140, 40, (0, 0, 0), (90, 0, 0)), box(6, 3, 100, (0, -43, 0))], (-300, -1, 2200), fixed=True
    )
    wall.put("ApronHook", hook(), (-1100, 0, 1650), fixed=True, block="WallHook")
    apron = [
        tube([(-60, 0, -150), (-40, 0, -40), (-6, 0, 0), (0, 0, 1.5), (6, 0, 0), (40, 0, -40), (60, 0, -150)], 3),
        box(420, 22, 640, (0, 0, -800)),
        box(220, 20, 80, (0, 0, -162)),
    ]
    wall.put("RubberApron", apron, (-1100, -20, 1656), fixed=True)
