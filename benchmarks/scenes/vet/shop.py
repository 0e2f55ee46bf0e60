"""The shelves with pet food and the hooks with goods of the reception."""

from benchmarks.scenes.vet.parts import bottle, lidded
from benchmarks.scenes.vet.shapes import box, cup, cyl, pillow, rod, sheet, slabs
from benchmarks.scenes.vet.stage import Practice

__all__ = ["build_shop"]


def build_shop(practice: Practice) -> None:
    """Add the unit at the outer wall, in a frame whose back is the wall."""
    unit = practice.group("R01_Reception/FoodShelves", (2900, 452, 0), 180)
    posts = [(x, x + 40, y, y + 30, 0, 1900) for x in (-800, 760) for y in (10, 415)]
    unit.put("Uprights", slabs(*posts, (-760, 760, 433, 445, 60, 1900)), fixed=True)
    for index, z in enumerate((80, 620, 1050, 1450)):
        unit.put(f"Board_{index + 1}", box(1516, 410, 22, (0, 222, z)), fixed=True)
    for index, (x, y, z, yaw) in enumerate([(-440, 220, 0, 2), (-430, 215, 137, -3), (130, 220, 0, -2)]):
        unit.put(
            f"FoodSack_{index + 1}",
            pillow(540, 390, 136),
            (x, y, 102 + z),
            (0, 0, yaw),
            block="Sack20",
        )
    can = [cyl(38, 100), cyl(40, 4), cyl(40, 4, (0, 0, 96))]
    spots = [(-45, 0), (45, 0), (0, 101)]
    for index, (x, z) in enumerate(spots):
        unit.put(f"Can_{index + 1}", can, (-560 + x, 150, 642 + z), (0, 0, 17 * index), block="Can400")
    for index, (x, y, z, yaw) in enumerate([(-200, 160, 0, 0), (-200, 160, 180.5, 5), (40, 170, 0, -4)]):
        unit.put(f"DryBox_{index + 1}", box(190, 110, 180), (x, y, 642 + z), (0, 0, yaw), block="DryBox")
    for index, x in enumerate((440,)):
        unit.put(f"Shampoo_{index + 1}", bottle(36, 210 - 12 * index), (x, 130, 642), (0, 0, 30 * index))
    for index, x in enumerate((-620, -270)):
        unit.put(f"SnackJar_{index + 1}", cup(68, 68, 170, 4), (x, 150, 1072))
        unit.put(f"SnackLid_{index + 1}", lidded(68, 0), (x, 150, 1072 + 171), fixed=True)
        if index != 1:
            snack = [
                rod((-40, y, z), (40, y + 6, z + 3), 7)
                for y, z in ((-24, 8), (-6, 9), (14, 8), (30, 10), (-12, 24), (8, 25))
            ]
            unit.put(f"Snacks_{index + 1}", snack, (x, 150, 1077), (0, 0, 40 * index), fixed=True)
    unit.put("BedCushion", pillow(480, 380, 150), (60, 215, 1072))
    unit.put("CatBlanket", sheet(360, 280, 26), (60, 210, 1221), (0, 0, 8), fixed=True)
    unit.put("ParcelTop", box(420, 300, 240), (-450, 220, 1472), (0, 0, -6))
