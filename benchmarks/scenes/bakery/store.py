"""The store: a shelf unit, the fridge and the chest freezer, sacks on a pallet and a hand truck."""

from benchmarks.scenes.bakery.forms import (
    bar,
    block,
    bulge,
    column,
    hoop,
    hose,
    joined,
    open_box,
    orb,
    panels,
    turned,
    vessel,
)
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import bottle, bow_handle, jar, jar_lid, sack

__all__ = ["build_store"]


def build_store(world: Area) -> None:
    """Add the room behind the bakehouse: x from 760 to 1150, z from 0 to 290."""
    store = world.area("Store")
    _shelves(store.area("DryShelves", (920, 0, 0)))
    _fridge(store.area("Fridge", (1150, 0, 56), -90))
    _freezer(store.area("ChestFreezer", (1150, 0, 200), -90))
    _pallet(store.area("Pallet", (930, 0, 234), 3))
    _truck(store.area("HandTruck", (800, 0, 62), 40))
    ladder = [bar((s * 20, 0, 0), (s * 17, 178, 0), 2) for s in (-1, 1)]
    ladder += [bar((-19, y, 0), (19, y, 0), 1.6) for y in range(24, 170, 29)]
    # It leans against the wall at z = 290.
    store.fix("step_ladder", ladder, (1040, 0.5, 257), (10, 0, 0))
    right = store.area("DoorWall", (760, 0, 250), 90)
    right.fix("list_nail", bar((0, 152, -2), (0, 152.6, 2.4), 0.25))
    board = [panels((-11, 11, -33, -1, 0, 0.5)), panels((-4, 4, -5, -2, 0.5, 1.1)), hoop(1, 0.2, (0, -0.8, 0.25))]
    right.fix("stock_list", board, (0, 152.65, 0.9))


def _shelves(unit: Area) -> None:
    posts = [(x - 2, x + 2, 0, 190, z - 2, z + 2) for x in (-78, 78) for z in (3, 43)]
    braces = [(s * 78 - 1, s * 78 + 1, y, y + 3, 5, 41) for y in (14, 96, 184) for s in (-1, 1)]
    unit.stand("shelf_posts", panels(*posts, *braces))
    for number, y in enumerate((18, 64, 110, 156), start=1):
        unit.fix(f"store_shelf_{number:02}", panels((-75.8, 75.8, y, y + 2.5, 1.2, 44.8)))
    carton = joined(panels((-17, 17, 0, 20, -14, 14)), panels((-17.2, 17.2, 20, 20.3, -2.5, 2.5)))
    low = unit.area("LowShelf", (0, 20.5, 23))
    for number, (x, up) in enumerate([(-52, 0.0), (-52, 20.5), (-12, 0.0)], start=1):
        low.stand(f"carton_{number:02}", carton, (x, up, 0), (0, 5 * number - 8, 0), "carton")
    low.stand("oil_can", [column(10, 30), column(2, 2, (5, 30, 0))], (40, 0, 0))
    eggs = unit.area("EggShelf", (0, 66.5, 23))
    for number in range(2):
        eggs.fix(f"egg_box_{number + 1:02}", open_box(30, 7, 30, 0.4), (-54, 0.1 + 7.2 * number, 0), (0, 2 * number, 0))
    egg = turned([(0, 0), (1.4, 0.4), (2.3, 2), (2, 4), (0, 5.8)])
    for number, (x, z) in enumerate([(-6, 0), (6, -6)], start=1):
        eggs.fix(f"egg_{number:02}", egg, (-54 + x, 7.8, z), like="egg")
    eggs.stand("raisin_jar", jar(8, 24), (-10, 0, 0))
    eggs.fix("raisins", turned([(0, 0), (7.4, 0), (7.4, 13), (0, 14)]), (-10, 0.5, 0))
    eggs.fix("raisin_jar_lid", jar_lid(8), (-10, 24, 0))
    eggs.stand("cake_tin", vessel(14, 14, 9, 0.3), (38, 0, 0))
    eggs.fix(
        "cake_tin_lid", turned([(0, 0.1), (14.1, 0.1), (14.1, -2), (14.4, -2), (14.4, 0.5), (0, 0.5)]), (38, 9.1, 0)
    )
    high = unit.area("HighShelf", (0, 112.5, 23))
    high.stand("wicker_basket", vessel(14, 18, 16, 0.8), (-40, 0, 0))
    high.fix("tea_towel", bulge(20, 6, 18, 0.4), (-40, 0.9, 0))
    high.stand("yeast_box", panels((-12, 12, 0, 14, -10, 10)), (10, 0, 2), (0, 14, 0))


def _fridge(fridge: Area) -> None:
    body = [
        (-35, 35, 4, 9, 0.5, 60),
        (-35, 35, 175, 180, 0.5, 60),
        (-35, -31, 9, 175, 0.5, 60),
        (31, 35, 9, 175, 0.5, 60),
    ]
    feet = [(x - 2.5, x + 2.5, 0, 4, z - 2.5, z + 2.5) for x in (-30, 30) for z in (6, 54)]
    fridge.stand("fridge_body", panels(*body, (-31, 31, 9, 175, 0.5, 5), *feet))
    for number, y in enumerate((70, 115), start=1):
        fridge.fix(
            f"fridge_rack_{number:02}", panels((-30.8, 30.8, y, y + 0.8, 6, 50), (-30.8, 30.8, y, y + 3, 50, 50.8))
        )
    fridge.stand("vegetable_box", open_box(56, 22, 38, 0.5), (0, 9, 28))
    for number, x in enumerate((-18, -6), start=1):
        fridge.stand(f"butter_pack_{number:02}", block(9, 7, 18), (x, 70.8, 26), (0, 6 * number, 0), "butter_pack")
    fridge.stand(
        "cream_bucket",
        [vessel(9, 10.5, 19, 0.4), turned([(0, 18.9), (10.1, 18.9), (10.9, 18), (10.9, 20), (0, 20)])],
        (10, 115.8, 26),
    )
    door = fridge.area("FridgeDoor", (-35, 0, 60.6), -96)
    door.fix("fridge_door", panels((0, 70, 6, 178, 0, 5)))
    door.fix("fridge_handle", bow_handle(34, upright=True), (65, 110, 5))
    door.fix("bottle_rack", open_box(54, 9, 9.5, 0.4), (35, 44, -4.9))
    door.fix("milk_bottle", bottle(4, 26), (24, 44.5, -4.9))


def _freezer(chest: Area) -> None:
    walls = [(-55, 55, 3, 85, 0.6, 7), (-55, 55, 3, 85, 56, 62), (-55, -49, 3, 85, 7, 56), (49, 55, 3, 85, 7, 56)]
    chest.stand(
        "freezer_body", panels(*walls, (-49, 49, 3, 12, 7, 56), (22, 49, 12, 46, 7, 56), (-50, 50, 0, 3, 5, 58))
    )
    chest.fix("freezer_lid", [panels((-55, 55, 85.3, 91, 0.8, 62.5)), block(20, 2.4, 2, (0, 86, 63.4))])
    chest.stand("freezer_basket", open_box(24, 20, 44, 0.4, 0.6), (35.4, 46, 31.5))
    chest.fix("pea_bag", bulge(18, 8, 26, 0.4), (35.4, 46.7, 30))
    chest.stand("puff_pastry_box", block(38, 16, 28), (-24, 12, 30), (0, 8, 0))


def _pallet(pallet: Area) -> None:
    boards = [(-52, 52, 11.8, 14.2, z - 5, z + 5) for z in (-27, -9, 9, 27)]
    boards += [(x - 5, x + 5, 2, 11.8, -32, 32) for x in (-47, 0, 47)]
    pallet.stand("pallet", panels(*boards, *((x - 5, x + 5, 0, 2, -32, 32) for x in (-47, 0, 47))))
    for number, (x, y) in enumerate([(-25.4, 0), (25.4, 0), (-25, 12.8), (25.2, 12.8), (1, 25.6)], start=1):
        pallet.stand(
            f"flour_sack_{number:02}", sack(46, 13, 54), (x, 14.2 + y, 0), (0, 2 * number - 6, 0), "flour_sack"
        )


def _truck(truck: Area) -> None:
    frame = [bar((x, 1, 0), (x, 118, -4), 1.5) for x in (-17, 17)]
    frame += [bar((-17, y, -y / 30), (17, y, -y / 30), 1.2) for y in (30, 60, 90)]
    grips = hose([(-17, 116, -4), (-17, 122, -8), (-16, 124, -14), (16, 124, -14), (17, 122, -8), (17, 116, -4)], 1.3)
    wheels = [column(9, 4, (s * 22 + 2, 9, -10), (0, 0, 90)) for s in (-1, 1)]
    axle = [bar((-22, 9, -10), (22, 9, -10), 1), *(block(2, 3, 10, (x, 8, -5)) for x in (-17, 17))]
    truck.stand("hand_truck", [block(42, 0.8, 26, (0, 0.4, 12)), *frame, grips, *wheels, *axle])
    truck.stand("apple_crate", open_box(38, 22, 20, 0.8), (0, 1.2, 13.5), (0, 2, 0))
    for number, (x, z) in enumerate([(-8, -1), (5, 2)], start=1):
        truck.stand(
            f"apple_{number:02}",
            [orb(3.9, (0, 0, 0), 0.9), bar((0, 6.6, 0), (0.4, 8.2, 0), 0.2)],
            (x, 2.1, 13 + z),
            like="apple",
        )
