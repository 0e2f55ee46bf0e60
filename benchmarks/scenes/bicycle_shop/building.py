"""Walls, doors, windows, lamps and what else belongs to the house."""

from benchmarks.scenes.bicycle_shop.parts import Mesh, block, capsule, cube, cyl, merge, shift, tube
from benchmarks.scenes.bicycle_shop.stage import Group, Shop
from benchmarks.scenes.bicycle_shop.things import PENDANT, lamp_on_chains

__all__ = ["build_house"]


def build_house(shop: Shop) -> None:
    """Add the house: 10 m by 7 m inside, with a storeroom in its north-east corner."""
    house = shop.group("Building")
    house.put("Floor", cube(1040, 740, 20, 500, 350, -20))
    house.put("Walls", _walls())
    house.put("Ceiling", cube(1040, 740, 15, 500, 350, 319.6))
    _build_doors(house)
    _build_fixtures(house)
    _build_lamps(shop)


def _walls() -> Mesh:
    """One mesh: the outer walls with openings for a door and a window, and two walls of the storeroom."""
    return merge(
        block(-20, 0, -20, 720, 0, 320),
        block(1000, 1020, -20, 720, 0, 320),
        block(0, 1000, 700, 720, 0, 320),
        block(0, 120, -20, 0, 0, 320),
        block(120, 420, -20, 0, 0, 90),
        block(120, 420, -20, 0, 230, 320),
        block(420, 500, -20, 0, 0, 320),
        block(500, 600, -20, 0, 215, 320),
        block(600, 1000, -20, 0, 0, 320),
        block(688, 700, 480, 700, 0, 320),
        block(700, 720, 480, 492, 0, 320),
        block(720, 800, 480, 492, 205, 320),
        block(800, 1000, 480, 492, 0, 320),
    )


def _build_doors(house: Group) -> None:
    frame = merge(
        block(-49, -38, -2.5, 2.5, 0, 214), block(38, 49, -2.5, 2.5, 0, 214),
        block(-38, 38, -2.5, 2.5, 0, 22), block(-38, 38, -2.5, 2.5, 203, 214),
    )  # fmt: skip
    house.put("Shop_door", [frame, cube(76.4, 0.8, 181.4, 0, 0, 21.8)], (550, -9, 0.4))
    house.put("Shop_door_handle", tube((0, 0, 90), (0, 0, 125), 1.4), (593, -5.2, 0))
    house.put("Store_door", cube(78, 4, 203, 39, 0, 0.5), (722, 490, 0), (0, 0, 70))
    lever = [cyl(1, 4, 0, 0, 0), capsule((0, 0, 4), (10, 0, 4.4), 0.9)]
    house.put("Store_door_handle", lever, (745.6, 549.5, 104), (-90, 0, 250))
    pane = merge(
        block(-149.5, -141, -3, 3, 0, 139), block(141, 149.5, -3, 3, 0, 139), block(-3, 3, -3, 3, 8, 131),
        block(-141, 141, -3, 3, 0, 8), block(-141, 141, -3, 3, 131, 139),
    )  # fmt: skip
    house.put("Shop_window", [pane, cube(283, 0.6, 124, 0, 0, 7.5)], (270, -11, 90.4))
    house.put("Window_sill", cube(312, 30, 3, 270, 7, 87.2))
    house.put("Roller_blind", [tube((-148, 0, 0), (148, 0, 0), 4), cube(290, 0.4, 38, 0, -2, -39)], (270, 4.3, 236))
    house.put("Open_sign", cube(40, 0.6, 14), (330, -10.1, 190), (0, 4, 0))


def _build_fixtures(house: Group) -> None:
    section = [block(-1, 689, -9, 9, 0, 2), block(-1, 689, -1, 1, 2, 20), block(-1, 689, -9, 9, 20, 22)]
    house.put("Steel_beam", merge(*section), (0, 352, 297.9))
    radiator = merge(*(block(x, x + 7, -5, 5, 0, 60) for x in range(-100, 100, 8)), block(-100, 98, -2, 2, 5, 55))
    house.put("Radiator", radiator, (270, 7.5, 12))
    house.put("Radiator_valve", [capsule((0, 0, 0), (0, 0, 5), 2.2), tube((0, 0, 0), (5, 0, 0), 1)], (164.5, 7.5, 16))
    house.put("Extinguisher", [cyl(7.5, 42), _cylinder_head(), cube(4, 3, 30, 0, -8.4, 8)], (645, 9.8, 95))
    house.put("Exit_sign", cube(32, 2.4, 16, 550, 1.4, 222))
    house.put("Wall_clock", [tube((0, 0, 0), (0, -4, 0), 17), tube((0, -4, 0), (0, -4.3, 0), 15)], (760, 479.8, 240))
    house.put("Breaker_box", block(-15, 15, 0, 9, 0, 44), (655, 699.6, 140), (0, 0, 180))
    house.put("Breaker_box_door", block(-14.5, 14.5, 9.1, 10.1, 0.5, 43.5), (655, 699.6, 140), (0, 0, 180))
    house.put("Light_switch", [cube(8, 1.2, 8), cube(4, 0.8, 5, 0, 1, 1.5)], (485, 0.4, 108))
    house.put("Store_switch", cube(8, 1.2, 8, 811, 493, 108))
    sockets = ((0.8, 650, 30, 90), (440, 699.4, 30, 0), (999.5, 300, 112, -90), (687.6, 498, 30, -90))
    for number, (x, y, z, turn) in enumerate(sockets, 1):
        house.put(f"Socket_{number}", [cube(8, 1, 8), tube((0, -0.4, 4), (0, -0.9, 4), 2.4)], (x, y, z), (0, 0, turn))
    house.put("Air_duct", tube((20, 640, 298), (686, 640, 298), 18))
    for number in (1, 2, 3):
        strap = merge(
            block(-1.5, 1.5, -18.6, -18, 0, 40),
            block(-1.5, 1.5, 18, 18.6, 0, 40),
            block(-1.5, 1.5, -18.6, 18.6, -0.6, 0),
        )
        house.put(f"Duct_strap_{number}", strap, (number * 170, 640, 279.8))
    house.put("Door_mat", cube(96, 58, 1.4, 550, 36, 0))


def _cylinder_head() -> Mesh:
    """Return the head of the extinguisher."""
    return shift(merge(block(-2, 2, -2, 2, 0, 7), block(-2, 2, 0, 9, 4, 6)), 0, 0, 41.5)


def _build_lamps(shop: Shop) -> None:
    lamps = shop.group("Building/Lamps")
    for number, (x, y) in enumerate(((130, 470), (290, 430)), 1):
        lamps.put(f"Tube_lamp_{number}", lamp_on_chains(120), (x, y, 319.8))
    # A third one, whose chains are things of their own, hangs under the beam.
    for number, x in enumerate((400, 480), 1):
        lamps.put(f"Chain_{number}", tube((x, 352, 253.3), (x, 352, 298.2), 0.5))
    lamps.put("Tube_lamp_3", [cube(120, 16, 5), capsule((-54, 0, -0.4), (54, 0, -0.4), 1.5)], (440, 352, 248.6))
    for number, (x, y) in enumerate(((850, 120), (857, 300), (857, 400)), 1):
        lamps.put(f"Pendant_{number}", PENDANT, (x, y, 320.1 if number == 2 else 319.5))
    lamps.put("Store_lamp", [cyl(16, 8), cyl(14, 1, 0, 0, -0.8)], (850, 600, 311.5))
    for number, (x, y) in enumerate(((350, 250), (750, 250)), 1):
        lamps.put(f"Smoke_detector_{number}", cyl(6, 4, x, y, 315.4))
