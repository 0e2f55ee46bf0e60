"""Assets of which there are copies in more than one room."""

from benchmarks.scenes.salon import things
from benchmarks.scenes.salon.shapes import cuboid, disc, merge, rod, vessel
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = [
    "COMB",
    "CUP",
    "JAR",
    "LOTION",
    "MAGAZINE",
    "MAGNET",
    "NOTE",
    "PLATE",
    "ROLLED",
    "SAUCER",
    "SHAMPOO",
    "SPOON",
    "TAP",
    "TOWEL",
    "TUBE",
    "add_plant",
]

COMB = Asset("comb", things.comb())
CUP = Asset("cup", things.cup())
SAUCER = Asset("saucer", things.saucer())
SPOON = Asset("spoon", things.spoon())
SHAMPOO = Asset("shampoo", things.bottle(0.034, 0.21))
LOTION = Asset("lotion", things.bottle(0.026, 0.16, 0.25))
TUBE = Asset("tube_box", cuboid(0.05, 0.04, 0.15))
TAP = Asset("tap", things.tap())
TOWEL = Asset("folded_towel", things.towel())
ROLLED = Asset("rolled_towel", things.rolled_towel(), 1.0, "Z")
MAGAZINE = Asset("magazine", things.magazine())
NOTE = Asset("note", things.card(0.1, 0.14))
MAGNET = Asset("magnet", rod("y", -0.008, 0, (0, 0), 0.012))
POT = Asset("flower_pot", things.pot(0.07, 0.12))
LEAVES = Asset("leaves", things.plant(0.16, 0.3))
DISH = Asset("pot_saucer", vessel(0.06, 0.075, 0.018, 0.003))
JAR = Asset("jar_of_wax", merge(disc(0.04, 0.045), disc(0.042, 0.02, 0.045)))
PLATE = Asset("plate", things.plate())


def add_plant(salon: Salon, name: str, plan: tuple[float, float], onto: str) -> None:
    """Add a plant in a pot on a saucer, in a group."""
    salon.rest(f"{name}/Saucer", DISH, plan, onto)
    salon.rest(f"{name}/Pot", POT, plan, f"{name}/Saucer", yaw=20)
    soil = float(salon.objects[f"{name}/Pot"].matrix[2, 3]) + 0.115
    salon.rest(f"{name}/Plant", LEAVES, plan, f"{name}/Pot", yaw=75, below=soil)
