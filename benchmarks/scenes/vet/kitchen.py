"""The corner where the staff cook and eat."""

from benchmarks.scenes.vet.parts import bar_handle, carcass, drawer, hook, mug, plate, seat
from benchmarks.scenes.vet.shapes import ball, box, crate, cup, cyl, lathe, moved, rod, slabs, strip, tube
from benchmarks.scenes.vet.stage import Group, Practice

__all__ = ["build_kitchen"]

TOP = 900.0


def build_kitchen(practice: Practice) -> None:
    """Add the room; its units stand at the outer wall to the north."""
    room = practice.group("R05_StaffKitchen", (7650, 3450, 0))
    units = room.group("Units", (640, 2990, 0))
    _base(units)
    _top(units.group("OnTop", (0, 0, TOP)))
    _upper(units.group("Upper", (0, 560, 0)))
    _fridge(room.group("Fridge", (1590, 2950, 0)))
    _meal(room.group("Meal", (1150, 1000, 0), 17))
    _rest(room)


def _base(units: Group) -> None:
    units.put("UnitCarcass", carcass(1200, 560, 100, 862, 0), fixed=True)
    units.put("UnitTop", box(1220, 590, 38, (0, 265, 862)), fixed=True)
    units.put("CutleryDrawer", drawer(560, 500, 90, 594), (-300, -280, 740), fixed=True)
    units.put("DrawerBar", bar_handle(180), (-300, -298, 800), fixed=True)
    dividers = [(x, x + 4, -180, 180, 3, 45) for x in (-110, -30, 50, 130)]
    tray = slabs(
        (-215, 215, -200, 200, 0, 3),
        (-215, 215, -200, -196, 3, 48),
        (-215, 215, 196, 200, 3, 48),
        (-215, -211, -196, 196, 3, 48),
        (211, 215, -196, 196, 3, 48),
        *dividers,
    )
    units.put("CutleryTray", tray, (-300, -50, 748.5), fixed=True)
    for kind, x, n in (("Fork", -160, 2), ("Knife", -68, 2), ("Spoon", 12, 2)):
        head = {
            "Fork": box(20, 60, 3, (0, 70, 1)),
            "Knife": box(16, 100, 2, (0, 80, 1)),
            "Spoon": ball(11, (0, 66, 0), 0.4),
        }[kind]
        for index in range(n):
            piece = [box(9, 150, 4, (0, -20, 0)), head]
            units.put(
                f"{kind}_{index + 1}",
                piece,
                (-300 + x + 22 * index - 10, -60, 752),
                (0, 0, 3 * index),
                fixed=True,
                block=kind,
            )
    for name, x, side in (("UnitDoorLeft", -597, 1), ("UnitDoorRight", 597, -1)):
        door = units.group(name, (x, -2, 0), 0 if side == 1 else 75)
        h = 610 if side == 1 else 750
        door.put("Panel", box(594, 18, h, (side * 297, -9, 108)), fixed=True)
        door.put("Bar", bar_handle(160, upright=True), (side * 550, -18, 108 + h - 130), fixed=True)
    units.put("ShelfBoard", box(564, 480, 18, (300, 290, 450)), fixed=True)
    units.put("Saucepan", [cup(110, 110, 110, 3), rod((108, 0, 90), (280, 0, 100), 10)], (220, 250, 468), (0, 0, 75))
    units.put("PanLid", [cyl(113, 6), cyl(104, 5, (0, 0, -5)), ball(16, (0, 0, 5))], (220, 250, 579), fixed=True)


def _top(top: Group) -> None:
    oven = top.group("Microwave", (-320, 330, 0), 3)
    shell = slabs(
        (-240, 240, -180, 190, 10, 22),
        (-240, 240, -180, 190, 268, 280),
        (-240, -228, -180, 190, 22, 268),
        (120, 240, -180, 190, 22, 268),
        (-228, 120, 178, 190, 22, 268),
    )
    oven.put("OvenBody", [shell, *(cyl(14, 10, (x, y, 0)) for x in (-200, 200) for y in (-140, 150))])
    door = oven.group("OvenDoor", (-238, -182, 0), -85)
    door.put(
        "OvenDoorLeaf",
        [
            box(354, 22, 262, (177, -11, 14)),
            rod((335, -40, 60), (335, -40, 230), 8),
            rod((335, -40, 70), (335, -22, 70), 6),
            rod((335, -40, 220), (335, -22, 220), 6),
        ],
        fixed=True,
    )
    oven.put("Turntable", cyl(140, 6), (-54, 0, 24), fixed=True)
    oven.put("MealPlate", plate(115), (-54, 0, 30))
    oven.put("Lasagne", box(110, 80, 40, (0, 0, 0)), (-54, 0, 34.5), (0, 0, 20), fixed=True)
    top.put("KettleBase", cyl(85, 22), (40, 380, 0))
    top.put(
        "Kettle",
        [
            lathe([(0, 0), (80, 0), (62, 200), (40, 215), (0, 218)]),
            tube([(60, 0, 190), (120, 0, 180), (120, 0, 60), (75, 0, 40)], 11),
            rod((-60, 0, 170), (-95, 0, 195), 14),
        ],
        (40, 380, 22),
        (0, 0, -40),
    )
    toaster = slabs(
        (-140, 140, -85, 85, 0, 20),
        (-140, 140, -85, -55, 20, 190),
        (-140, 140, 55, 85, 20, 190),
        (-140, -110, -55, 55, 20, 190),
        (110, 140, -55, 55, 20, 190),
        (-110, 110, -10, 10, 20, 190),
    )
    top.put("Toaster", [toaster, box(20, 40, 10, (148, 0, 130))], (300, 400, 0), (0, 0, -4))
    for index, y in enumerate((-32,)):
        top.put(f"ToastSlice_{index + 1}", box(110, 14, 185), (300 + 0.07 * y, 400 + y, 21), (0, 0, -4), fixed=True)
    rack = top.group("DishRack", (420, 120, 0))
    wires = [rod((-170, y, 10), (170, y, 10), 3) for y in (-110, -40, 40, 110)]
    wires += [rod((x, -110, 14), (x, 110, 14), 3) for x in (-170, 170)]
    wires += [rod((x, y, 10), (x, y, 90), 2.5) for x in range(-150, 31, 30) for y in (-40, 40)]
    wires += [rod((x, -110, 120), (x, 110, 120), 3) for x in (-170, 170)] + [
        rod((x, y, 0), (x, y, 120), 3) for x in (-170, 170) for y in (-110, 110)
    ]
    rack.put("RackFrame", wires)
    for index in range(2):
        rack.put(
            f"DryPlate_{index + 1}",
            moved(plate(95), rot=(0, 84, 0)),
            (-142 + 30 * index, 0, 108),
            fixed=True,
            block="DryPlate",
        )
    rack.put("DryGlass", moved(cup(30, 36, 110, 3), (0, 0, 110), (180, 0, 0)), (110, 40, 13), fixed=True)
    rack.put(
        "DryMug", [moved(part, (0, 0, 92), (180, 0, 0)) for part in mug()], (105, -55, 13), (0, 0, 100), fixed=True
    )


def _upper(wall: Group) -> None:
    """An open shelf with hooks under its board; y = 0 is the face of the wall."""
    brackets = [(x, x + 6, -240, 0, 1494, 1500) for x in (-500, 494)] + [
        (x, x + 6, -6, 0, 1350, 1494) for x in (-500, 494)
    ]
    wall.put("ShelfBrackets", slabs(*brackets), (0, -1, 0), fixed=True)
    wall.put("WallShelf", box(1200, 260, 24, (0, -132, 1500)), fixed=True)
    cuphook = [
        rod((0, 0, -24), (0, 0, 2), 3),
        tube([(0, 0, -22), (0, 10, -26), (0, 14, -38), (0, 8, -50), (0, 0, -53), (0, -10, -48), (0, -14, -36)], 3),
    ]
    for index, x in enumerate((-450, -320, -60, 70)):
        wall.put(f"CupHook_{index + 1}", cuphook, (x, -140, 1500), fixed=True, block="CupHook")
        if index != 2:
            # The handle lies in the bow of the hook, its axis along x, and the mug tilts.
            wall.put(
                f"Mug_{index + 1}",
                [moved(part, (-66, 0, -48), (0, 0, 0)) for part in mug()],
                (x, -140, 1452.5),
                (0, -90, 0),
                fixed=True,
                block="Mug",
            )
    for index in range(3):
        wall.put(f"Plate_{index + 1}", plate(120), (-430, -130, 1524 + 8.5 * index), fixed=True, block="DinnerPlate")
    for index in range(2):
        wall.put(
            f"Bowl_{index + 1}", cup(42, 75, 62, 4), (-180, -130, 1524 + 14.5 * index), fixed=True, block="CerealBowl"
        )
    wall.put("TowelHook", hook(), (560, -1, 1250), fixed=True, block="WallHook")
    tea = [
        tube([(-12, 0, -30), (-8, 0, -4), (0, 0, 1), (8, 0, -4), (12, 0, -30)], 2.5),
        moved(strip([(-60, 0), (-20, 8), (20, -4), (60, 4)], 10, 4), (0, 0, -34)),
        slabs((-70, 70, -9, 3, -320, -34)),
    ]
    wall.put("TeaTowel", tea, (560, -20.5, 1256), fixed=True)


def _fridge(fridge: Group) -> None:
    """Front at y = 0, back at y = 600; the door stands open to the right."""
    body = slabs(
        (-280, 280, 40, 590, 20, 60),
        (-280, 280, 40, 590, 1380, 1420),
        (-280, -245, 40, 590, 60, 1380),
        (245, 280, 40, 590, 60, 1380),
        (-245, 245, 550, 590, 60, 1380),
    )
    fridge.put("FridgeBody", [body, *(cyl(20, 21, (x, y, 0)) for x in (-240, 240) for y in (80, 550))])
    door = fridge.group("FridgeDoor", (278, 36, 0), 82)
    door.put(
        "DoorLeaf",
        [
            slabs((-556, 0, -40, 0, 30, 1415)),
            rod((-520, -70, 900), (-520, -70, 1200), 9),
            rod((-520, -70, 915), (-520, -40, 915), 7),
            rod((-520, -70, 1185), (-520, -40, 1185), 7),
        ],
        fixed=True,
    )
    for index, z in enumerate((200, 760)):
        door.put(
            f"DoorRack_{index + 1}",
            slabs(
                (-500, -56, 0, 110, z, z + 5),
                (-500, -56, 106, 110, z + 5, z + 75),
                (-500, -496, 0, 106, z + 5, z + 75),
                (-60, -56, 0, 106, z + 5, z + 75),
            ),
            fixed=True,
        )
    door.put("MilkBottle", lathe([(0, 0), (40, 0), (40, 170), (20, 230), (20, 250), (0, 250)]), (-400, 55, 205))
    door.put("JuiceCarton", box(80, 80, 210), (-290, 54, 205), (0, 0, 5))
    door.put("Ketchup", lathe([(0, 0), (32, 0), (32, 120), (12, 170), (12, 190), (0, 190)]), (-180, 52, 765))
    for index, z in enumerate((300, 640, 1000)):
        fridge.put(f"GlassShelf_{index + 1}", box(486, 440, 6, (0, 325, z)), fixed=True)
    fridge.put("VeggieBox", crate(460, 420, 170, 4), (0, 320, 62))
    for index, (x, y) in enumerate([(-120, -60), (-30, -80)]):
        fridge.put(f"Apple_{index + 1}", ball(36, (0, 0, 0), 0.9), (x, 320 + y, 66), block="Apple")
    fridge.put("LunchBox_1", [crate(200, 140, 70, 3), slabs((-103, 103, -73, 73, 70, 78))], (-110, 260, 306))
    yog = lathe([(0, 0), (30, 0), (37, 75), (39, 78), (0, 78)])
    for index, (x, z) in enumerate([(70, 0), (155, 0)]):
        fridge.put(f"Yoghurt_{index + 1}", yog, (x, 230, 306 + z), block="Yoghurt")
    fridge.put("CheeseBox", crate(180, 120, 60, 3), (-90, 250, 646))
    fridge.put("Cheese", box(120, 70, 36), (-90, 250, 649.5), (0, 0, 12))
    fridge.put("FridgeMagnet", cyl(14, 7), (-281.5, 200, 1250), (0, -90, 0), fixed=True)
    fridge.put("DutyRota", box(1, 210, 297), (-281, 200, 1000), (1, 0, 0), fixed=True)


def _meal(meal: Group) -> None:
    legs = [rod((x, y, 0), (x, y, 722), 22) for x in (-340, 340) for y in (-240, 240)]
    meal.put("MealTable", [box(800, 600, 26, (0, 0, 720)), *legs])
    meal.put("MealChair_1", seat(), (-40, 560, 0), (0, 0, -6), block="Seat")
    bowl = lathe([(0, 0), (70, 0), (130, 60), (150, 90), (146, 92), (125, 62), (66, 6), (0, 6)], 24)
    meal.put("FruitBowl", bowl, (180, 60, 746))
    for index, (x, y, z) in enumerate([(-40, -22, 7), (40, -24, 7), (0, 44, 7)]):
        meal.put(f"Orange_{index + 1}", ball(36), (180 + x, 60 + y, 746 + z), block="Orange")
    meal.put("OrangeOnTop", ball(36), (180, 58, 746 + 64), fixed=True)
    meal.put(
        "Newspaper", strip([(-160, 3), (-80, 3), (0, 4), (80, 3), (160, 3)], 230, 5), (-180, -120, 746), (0, 0, 20)
    )
    meal.put(
        "Glasses",
        [
            rod((-60, 0, 20), (60, 0, 20), 3),
            *(cyl(22, 3, (s * 34, 0, 20), (90, 0, 0)) for s in (-1, 1)),
            rod((-60, 0, 20), (-55, 120, 3), 2),
            rod((60, 0, 20), (55, 120, 3), 2),
        ],
        (-170, -150, 751),
        (0, 0, 40),
        fixed=True,
    )
    meal.put("Coaster", cyl(50, 5), (-120, 150, 746), fixed=True)
    meal.put("TeaMug", mug(), (-120, 150, 751.5), (0, 0, 60), fixed=True)
    meal.put(
        "TeaSpoon",
        [rod((0, 0, 0), (0, 0, 130), 2.5), ball(9, (0, 0, -10), 1.2)],
        (-132, 142, 764),
        (14, 10, 0),
        fixed=True,
    )


def _rest(room: Group) -> None:
    room.put("KitchenBin", lathe([(0, 0), (130, 0), (150, 480), (146, 480), (126, 4), (0, 4)], 24), (168, 2450, 0))
    room.put(
        "SwingLid",
        [lathe([(0, 90), (80, 88), (140, 40), (152, 0), (148, 0), (137, 37), (78, 84), (0, 86)], 24)],
        (168, 2450, 480.5),
        fixed=True,
    )
