"""The breakfast kitchen: cabinets, dishwasher, worktop and fridge along the north wall; the buffet is apart."""

from benchmarks.scenes.hotel.desk import CUP
from benchmarks.scenes.hotel.shapes import Part, ball, box, crate, cup, cyl, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["FORK", "KNIFE", "PLATE", "build_kitchen"]

PLATE = (lathe([(0.001, 0), (7.5, 0), (12, 1.8), (11.9, 2.2), (7.4, 0.5), (0.001, 0.5)], 24),)
FORK = (box(1.8, 0.3, 6, (0, 0, 6)), box(0.8, 0.3, 13, (0, 0, -3)))
KNIFE = (box(1.8, 0.3, 11, (0, 0, 5)), box(1.4, 0.8, 9, (0, 0, -5)))


def build_kitchen(hotel: Hotel) -> None:
    """Add the kitchen, in a frame at its north-west corner."""
    kitchen = hotel.group("breakfast_kitchen", (720, 0, 10))
    _cabinets(kitchen.group("cabinets"))
    _dishwasher(kitchen.group("dishwasher", (110, 0, 32)))
    _worktop(kitchen.group("worktop", (0, 90, 0)))
    _wall(kitchen.group("wall_rails", (0, 0, 0.2)))
    _fridge(kitchen.group("fridge", (427, 0, 36)))
    pendant = [
        cyl(5, 2, (0, 78, 0)),
        tube([(0, 79, 0), (0, 16, 0)], 0.3, 6),
        lathe([(3, 17), (16, 0), (15.6, 0), (2.6, 17), (3, 17)]),
    ]
    kitchen.put("pendant_lamp_01", pendant, (250, 179.8, 220), fixed=True)
    bin_group = kitchen.group("waste", (28, 0, 330))
    bin_group.put("waste_sorter", [crate(40, 60, 30, 1), box(1, 56, 28, (0, 1, 0))])
    bin_group.put("banana_peel", puff(14, 5, 9, 0.9), (-10, 1, 3), (0, 30, 0))


def _cabinets(base: Group) -> None:
    uprights = [(x, x + 2, 0 if x in {78, 140} else 10, 86, 3, 60) for x in (5, 78, 140, 240, 393)]
    floors = [(7, 78, 10, 12, 3, 60), (142, 240, 10, 12, 3, 60), (242, 393, 10, 12, 3, 60)]
    backs = [(5, 80, 10, 86, 2, 3), (140, 395, 10, 86, 2, 3)]
    plinth = [(5, 80, 0, 10, 54, 56), (140, 395, 0, 10, 54, 56), (242, 393, 12, 86, 60, 61.6)]
    base.put("base_units", slabs(*uprights, *floors, *backs, *plinth))
    top = ((5, 395, 86, 90, 0.6, 12), (5, 395, 86, 90, 50, 63), (5, 160, 86, 90, 12, 50), (210, 395, 86, 90, 12, 50))
    base.put("worktop_slab", slabs(*top))
    for name, y, high, out in (("cutlery", 66, 18.0, 24), ("pans", 14, 50.0, 0)):
        drawer = slabs(
            (8, 77, 0, 1, 6, 60),
            (8, 9, 1, 12, 6, 60),
            (76, 77, 1, 12, 6, 60),
            (9, 76, 1, 12, 6, 7),
            (6, 79, 0, high, 60.2, 62),
        )
        base.put(f"drawer_{name}", drawer, (0, y, out), fixed=True)
        base.put(
            f"bar_{name}",
            tube([(-10, 0, 0), (-10, 0, 3), (10, 0, 3), (10, 0, 0)], 0.6, 6),
            (42.5, y + high - 5, 62 + out),
            fixed=True,
        )
    tray = slabs(
        (-16, 16, 0, 0.4, -20, 20),
        *((x, x + 0.4, 0.4, 5, -20, 20) for x in (-16, -5.4, 5, 15.6)),
        *((-15.6, 15.6, 0.4, 5, z, z + 0.4) for z in (-20, 19.6)),
    )
    base.put("cutlery_tray", tray, (44, 67, 60))
    base.put("drawer_fork_01", FORK, (33.2, 67.4, 61), (0, 3, 0), fixed=True, asset="fork")
    base.put("drawer_knife_01", KNIFE, (43, 67.4, 60), (0, 2, 0), fixed=True, asset="table_knife")
    base.put(
        "stock_pot",
        [
            cup(15, 15, 20, 0.4),
            *(tube([(s * 15, 15, -4), (s * 18, 15, -4), (s * 18, 15, 4), (s * 15, 15, 4)], 0.5, 6) for s in (-1, 1)),
        ],
        (40, 15, 32),
    )
    base.put("sink_door", box(97, 74, 2), (191, 11.6, 61.2), fixed=True)
    base.put("sink_door_knob", ball(3, 3, 3), (235, 74, 63.4), fixed=True)
    base.put("detergent_bottle", [puff(14, 26, 8, 0.4), cyl(2, 3, (0, 25.6, 0))], (170, 12, 34))
    flange = (
        (-26.5, -23.5, 0, 0.7, -20.5, 20.5),
        (23.5, 26.5, 0, 0.7, -20.5, 20.5),
        (-23.5, 23.5, 0, 0.7, -20.5, -17.5),
        (-23.5, 23.5, 0, 0.7, 17.5, 20.5),
    )
    bowl = (
        (-24, -23.5, -18, 0, -18, 18),
        (23.5, 24, -18, 0, -18, 18),
        (-23.5, 23.5, -18, 0, -18, -17.5),
        (-23.5, 23.5, -18, 0, 17.5, 18),
        (-24, 24, -18.5, -18, -18, 18),
    )
    base.put("sink", slabs(*flange, *bowl), (185, 90, 31), fixed=True)
    base.put(
        "kitchen_tap",
        [
            cyl(2.4, 5),
            tube([(0, 4, 0), (0, 26, 0), (0, 30, 6), (0, 27, 14), (0, 24, 15)], 1.1),
            box(1.4, 1, 7, (3, 5, 1), (0, 40, 0)),
        ],
        (185, 90, 6),
        fixed=True,
    )


def _dishwasher(place: Group) -> None:
    place.put("dishwasher_body", crate(58, 84, 54, 2, side="front"))
    # The door lies open, its hinge at its lower edge.
    place.put("dishwasher_door", slabs((-29, 29, 0, 4, 0, 66), (-24, 24, 4, 4.6, 8, 58)), (0, 5.4, 27.4), fixed=True)
    place.put(
        "dishwasher_handle",
        tube([(-20, 0, 0), (-20, -3, 0), (20, -3, 0), (20, 0, 0)], 0.7, 6),
        (0, 5.3, 89),
        fixed=True,
    )
    for name, y, out in (("lower", 10, 30), ("upper", 46, 0)):
        edge = [
            tube([(-25, h, -24), (25, h, -24), (25, h, 24), (-25, h, 24), (-25, h, -24)], 0.3, 6) for h in (0.3, 11)
        ]
        wires = [tube([(x, 11, -24), (x, 0.3, -24), (x, 0.3, 24), (x, 11, 24)], 0.25, 6) for x in range(-20, 21, 5)]
        pins = [tube([(x, 0.3, z), (x, 7, z)], 0.2, 5) for x in (-10, 10) for z in range(-16, 17, 4)]
        place.put(f"{name}_rack", [*edge, *wires, *(pins if name == "lower" else [])], (0, y, out), fixed=True)
    for index, z in enumerate((24.2, 32.2), 1):
        place.put(f"rack_plate_{index:02}", PLATE, (0, 22.6, z - 0.3), (94, 0, 0), fixed=True, asset="plate")
    for index, (x, z) in enumerate(((-8, 4), (6, 6)), 1):
        place.put(f"rack_cup_{index:02}", CUP, (x, 53.1, z), (180, 40 * index, 0), fixed=True, asset="tea_cup")


def _worktop(top: Group) -> None:
    machine = top.group("coffee_machine", (272, 0, 28), 4)
    body = slabs((-18, 18, 0, 7, -22, 20), (-18, 18, 7, 42, -22, -2), (-18, 18, 28, 42, -2, 18))
    machine.put("coffee_machine", [body, tube([(-3, 28, 8), (-3, 23, 8)], 0.9), tube([(3, 28, 8), (3, 23, 8)], 0.9)])
    machine.put(
        "drip_grid",
        slabs(
            *((x, x + 1.6, 0, 0.6, -6, 6) for x in range(-13, 13, 3)),
            (-14, 14, 0, 0.6, -7, -6),
            (-14, 14, 0, 0.6, 6, 7),
        ),
        (0, 7, 8),
        fixed=True,
    )
    machine.put("cup_under_spout", CUP, (0, 7.6, 8), (0, -60, 0), asset="tea_cup")
    machine.put(
        "bean_hopper", [lathe([(0.001, 0), (8, 0), (11, 12), (10.6, 12), (7.6, 0.5), (0.001, 0.5)])], (0, 42, -8)
    )
    toaster = slabs(
        (-14, 14, 0, 9, -9, 9),
        (-14, -12, 9, 19, -9, 9),
        (12, 14, 9, 19, -9, 9),
        *((-12, 12, 9, 19, z0, z1) for z0, z1 in ((-9, -4.6), (-1.6, 1.6), (4.6, 9))),
    )
    top.put("toaster", [toaster, box(2, 1.4, 3, (15, 12, 0))], (335, 0, 26), (0, -10, 0))
    top.put("toast_slice", puff(11, 12, 1.6, 0.3), (335.5, 9.1, 29.05), (0, -10, 0), fixed=True)
    top.put("bread_board", box(38, 1.8, 26), (112, 0, 36), (0, 6, 0))
    top.put("loaf", puff(24, 11, 12, 0.5), (107, 1.8, 34), (0, 10, 0))


def _wall(wall: Group) -> None:
    strip = (x0, x1) = (30.0, 86.0)
    wall.put("knife_strip", box(x1 - x0, 5, 1.4), (sum(strip) / 2, 128, 0.8), fixed=True)
    for index, (x, long, wide) in enumerate(((40, 22, 4.0), (54, 18, 3.4)), 1):
        blade = [box(wide, long, 0.25, (0, -long + 4, 0)), box(2.4, 11, 1.6, (0, 4, 0.2))]
        wall.put(f"chef_knife_{index:02}", blade, (x, 130, 1.75), (0, 0, 180 + 2 * index), fixed=True)
    rail = [tube([(345, 190, 0), (345, 190, 7), (393, 190, 7), (393, 190, 0)], 0.8)]
    wall.put("pan_rail", rail, fixed=True)
    hook = [
        tube(
            [(0, -6.6, 0), (0, -7.6, 1.4), (0, -6.2, 2.4), (0, 0.2, 1.3), (0, 1.2, 0), (0, 0.2, -1.3), (0, -1.2, -1.4)],
            0.3,
            6,
        )
    ]
    wall.put("s_hook_01", hook, (366, 189.95, 7), fixed=True)
    pan = lathe([(0.001, 0), (11, 0), (12, 4.5), (11.6, 4.5), (10.7, 0.4), (0.001, 0.4)], 24)
    rim = [(0, 0, 0), (-1.2, -1.6, 0), (-1, -3.6, 0), (0, -4.4, 0), (1, -3.6, 0), (1.2, -1.6, 0), (0, 0, 0)]
    parts = [moved(pan, (0, -31.6, -2), (90, 0, 0)), tube([(0, -4.2, 0), (0, -20, 0)], 0.9), tube(rim, 0.3, 6)]
    wall.put("frying_pan_01", parts, (366, 183.0, 8.4), fixed=True)


def _fridge(fridge: Group) -> None:
    fridge.put("fridge_body", crate(62, 180, 60, 4, side="front"))
    door = fridge.group("door", (31, 1, 30.6), 88)
    door.put("fridge_door", [box(62, 178, 5, (-31, 0, 2.5))], fixed=True)
    door.put("fridge_handle", tube([(-57, 80, 5), (-57, 80, 9), (-57, 120, 9), (-57, 120, 5)], 0.8), fixed=True)
    door.put("rota_sheet", box(21, 29.7, 0.1, (0, -29.7, 0)), (-32, 150, 5.15), (0, 0, 2), fixed=True)
    door.put("magnet", cyl(1.6, 0.8, (0, -0.4, 0), (90, 0, 0)), (-32, 148, 5.6), fixed=True)
    door.put(
        "door_shelf",
        slabs(
            (-56, -6, 0, 1, -10, 0), (-56, -6, 1, 8, -10, -9.4), (-56, -55.4, 1, 8, -9.4, 0), (-6.6, -6, 1, 8, -9.4, 0)
        ),
        (0, 60, -0.1),
        fixed=True,
    )
    carton = [
        box(7, 18, 7),
        Part(
            "Mesh",
            at=(0, 18, 0),
            points=slabs((-3.5, 3.5, 0, 3, -0.4, 0.4)).points,
            faces=slabs((0, 1, 0, 1, 0, 1)).faces,
        ),
    ]
    door.put("milk_carton_01", carton, (-16, 61, -4.9))
    for index, y in enumerate((60, 105), 1):
        fridge.put(f"glass_shelf_{index:02}", box(53.6, 1, 48), (0, y, -1), fixed=True)
    fridge.put("crisper", crate(52, 22, 46, 1), (0, 4.2, 1), fixed=True)
    fridge.put("lettuce", puff(18, 14, 18, 0.9), (-10, 5.4, 2))
    fridge.put("cheese_box", puff(26, 9, 18, 0.15), (-10, 61, 2), (0, 10, 0))
    fridge.put("egg_carton", crate(30, 5, 11, 0.4), (6, 106, 6), (0, 4, 0))
    for index, x in enumerate((-11.5, -6), 1):
        fridge.put(f"egg_{index:02}", [ball(4.4, 5.8, 4.4)], (6 + x, 106.4, 6 - 0.07 * x), asset="egg")
    for index in range(2):
        fridge.put(
            f"yoghurt_{index + 1:02}",
            [cup(3, 3.8, 7, 0.3), cyl(3.9, 0.2, (0, 7, 0))],
            (15, 61 + 7.2 * index, 4),
            asset="yoghurt",
        )
