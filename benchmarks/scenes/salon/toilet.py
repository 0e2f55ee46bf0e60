"""The toilet, with a shower."""

from benchmarks.scenes.salon import furniture, things
from benchmarks.scenes.salon.rooms import at_wall, hang
from benchmarks.scenes.salon.shapes import ball, bent, cuboid, disc, hollow_box, merge, move, rod, squash, turn, vessel
from benchmarks.scenes.salon.shared import LOTION, ROLLED, SHAMPOO, TAP, TOWEL, add_plant
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["build_toilet"]

ROLL = Asset("paper_roll", things.roll())


def build_toilet(salon: Salon) -> None:
    """Add everything in the toilet."""
    name, north, east = "Toilet", "wc north", "wc east"
    salon.rest(f"{name}/Toilet/Toilet", Asset("toilet", furniture.toilet()), at_wall(north, 8.4, 0.3), "Building/Floor")
    x, y = at_wall(north, 8.4, 0.4)
    salon.put(f"{name}/Toilet/Lid", Asset("toilet_lid", furniture.toilet_lid()), (x, y, 0.403))
    for number, (dx, under) in enumerate(
        ((-0.1, "Toilet/Toilet"), (0.06, "Toilet/Toilet"), (-0.098, "Spare_roll_1")), 1
    ):
        salon.rest(f"{name}/Spare_roll_{number}", ROLL, (8.4 + dx, 5.79), f"{name}/{under}")
    brush = Asset("toilet_brush", merge(squash(ball(0.035), z=1.2), rod("z", 0.07, 0.4, (0, 0), 0.008)))
    salon.rest(
        f"{name}/Brush_holder", Asset("brush_holder", vessel(0.055, 0.055, 0.16, 0.004)), (8.75, 5.85), "Building/Floor"
    )
    salon.rest(f"{name}/Brush", brush, (8.752, 5.848), f"{name}/Brush_holder")
    hang(salon, f"{name}/Roll_holder", Asset("roll_holder", things.roll_holder()), north, 7.95, 0.75, 0.003)
    # The roll hangs with its hole on the pin.
    salon.put(f"{name}/Roll", ROLL, (7.89, 6.0 - 0.073, 0.737), 0, ("y", 90))
    salon.put(f"{name}/Window", Asset("wc_window", furniture.window(0.8, 0.8)), (7.3, 6.1, 1.4))
    hang(salon, f"{name}/Washbasin", Asset("small_basin", furniture.basin(0.45, 0.38, 0.15)), east, 5.0, 0.72, 0.001)
    salon.rest(f"{name}/Tap", TAP, at_wall(east, 5.0, 0.05), f"{name}/Washbasin", yaw=-90)
    salon.rest(
        f"{name}/Soap", Asset("soap_pump", things.soap_pump()), at_wall(east, 5.15, 0.05), f"{name}/Washbasin", yaw=-90
    )
    waste = [(0, 0, 0.02), (0, 0, -0.2), (0.0, 0.04, -0.25), (0, 0.08, -0.2), (0, 0.2, -0.2)]
    salon.put(
        f"{name}/Waste_pipe",
        Asset("waste_pipe", bent([(a, b, c) for a, b, c in waste], 0.016)),
        (*at_wall(east, 5.0, 0.2), 0.72),
        -90,
    )
    hang(salon, f"{name}/Mirror", Asset("round_mirror", turn(disc(0.25, 0.012), "x", 90)), east, 5.0, 1.55, 0.004)
    hang(
        salon,
        f"{name}/Towel_rail",
        Asset(
            "towel_rail",
            merge(
                rod("x", -0.25, 0.25, (-0.07, 0), 0.008),
                *(bent([(x, 0, 0), (x, -0.04, 0), (x, -0.07, 0)], 0.007) for x in (-0.25, 0.25)),
            ),
        ),
        east,
        5.6,
        1.15,
    )
    salon.put(
        f"{name}/Hand_towel",
        Asset("hand_towel", things.draped(0.32, 0.4, 0.3, 0.0125)),
        (*at_wall(east, 5.6, 0.07), 1.1502),
        -90,
    )
    salon.rest(
        f"{name}/Bin", Asset("pedal_bin", vessel(0.1, 0.11, 0.27, 0.003)), at_wall(east, 5.5, 0.25), "Building/Floor"
    )
    salon.rest(f"{name}/Tissue", Asset("tissue", squash(ball(0.035), z=0.8)), at_wall(east, 5.51, 0.25), f"{name}/Bin")
    salon.rest(f"{name}/Mat", salon.model("KatorLegaz/bathmat"), (8.35, 5.1), "Building/Floor", yaw=2)
    salon.rest(
        f"{name}/Shelf_unit",
        Asset("wc_shelf", furniture.carcass(0.4, 0.3, 1.1, (0.4, 0.75), back=False)),
        at_wall("wc west", 5.4, 0.17),
        "Building/Floor",
        yaw=90,
    )
    unit = at_wall("wc west", 5.4, 0.17)
    salon.rest(
        f"{name}/Roll_basket",
        Asset("roll_basket", hollow_box(0.3, 0.24, 0.16, 0.006)),
        unit,
        f"{name}/Shelf_unit",
        yaw=92,
        below=0.1,
    )
    for number, dy in enumerate((-0.065, 0.06), 1):
        salon.rest(f"{name}/Basket_roll_{number}", ROLL, (unit[0], unit[1] + dy), f"{name}/Roll_basket", below=0.3)
    for number in (1, 2):
        under = f"{name}/Shelf_unit" if number == 1 else f"{name}/Guest_towel_1"
        salon.rest(
            f"{name}/Guest_towel_{number}",
            Asset("guest_towel", things.towel(0.24, 0.16, 4)),
            unit,
            under,
            yaw=90 + 3 * number,
            below=0.5,
        )
    salon.rest(f"{name}/Air_freshener", LOTION, (unit[0], unit[1] - 0.06), f"{name}/Shelf_unit", below=0.8)
    salon.rest(
        f"{name}/Cream",
        Asset("cream", disc(0.03, 0.03)),
        (unit[0] + 0.02, unit[1] + 0.06),
        f"{name}/Shelf_unit",
        below=0.8,
    )
    add_plant(salon, f"{name}/Plant", unit, f"{name}/Shelf_unit")
    _build_shower(salon, f"{name}/Shower")
    salon.put(f"{name}/Ceiling_lamp", salon.model("Scopia/ceiling-lamp"), (7.7, 5.0, 2.8 - 0.054))


def _build_shower(salon: Salon, name: str) -> None:
    east = "wc east"
    salon.rest(f"{name}/Tray", Asset("shower_tray", hollow_box(0.8, 0.8, 0.08, 0.03)), (8.78, 4.34), "Building/Floor")
    riser = [(0, 0, 0.0), (0, -0.04, 0.0), (0, -0.05, 0.02), (0, -0.05, 1.0), (0, -0.08, 1.06), (0, -0.3, 1.07)]
    hang(salon, f"{name}/Riser", Asset("riser", bent([(a, b, c) for a, b, c in riser], 0.01)), east, 4.34, 1.05)
    salon.put(f"{name}/Shower_head", Asset("shower_head", disc(0.1, 0.02)), (*at_wall(east, 4.34, 0.3), 2.092), -90)
    caddy = merge(
        hollow_box(0.24, 0.1, 0.07, 0.003),
        bent([(0, 0.045, 0.06), (0, 0.045, 0.28), (0, 0.06, 0.3), (0, 0.075, 0.28)], 0.003),
    )
    salon.put(f"{name}/Caddy", Asset("caddy", caddy), (*at_wall(east, 4.34, 0.125), 1.3), -90)
    for number, dy in enumerate((-0.07, 0.06), 1):
        salon.rest(
            f"{name}/Caddy_bottle_{number}", SHAMPOO, at_wall(east, 4.34 + dy, 0.125), f"{name}/Caddy", below=1.35
        )
    rail = Asset("shower_rail", rod("y", -0.87, 0.0, (0, 0), 0.012))
    salon.put(f"{name}/Curtain_rail", rail, (8.35, 4.795, 2.0))
    salon.put(f"{name}/Curtain_rail_2", Asset("shower_rail_2", rod("x", 8.35, 9.201, (0, 0), 0.012)), (0, 4.795, 2.0))
    salon.put(
        f"{name}/Curtain", Asset("shower_curtain", furniture.curtain(0.5, 1.85, 8, 0.06)), (8.35, 4.25, 0.139), 90
    )
    for number, dy in enumerate((-0.22, -0.08, 0.07, 0.21), 1):
        ring = bent(
            [
                (0.02 * c, 0, 0.02 * s)
                for c, s in (
                    (1, 0),
                    (0.7, 0.7),
                    (0, 1),
                    (-0.7, 0.7),
                    (-1, 0),
                    (-0.7, -0.7),
                    (0, -1),
                    (0.7, -0.7),
                    (1, 0),
                )
            ],
            0.002,
        )
        salon.put(f"{name}/Ring_{number}", Asset("curtain_ring", ring), (8.35, 4.25 + dy, 1.993), 3 * number)
    hang(salon, f"{name}/Robe_hook", Asset("robe_hook", furniture.hook_rail(0.06, 1)), "wc south", 8.05, 1.8)
    salon.put(f"{name}/Bathrobe", Asset("bathrobe", things.coat(1.1)), (*at_wall("wc south", 8.05, 0.05), 1.7815), 180)
    salon.rest(
        f"{name}/Stool",
        Asset(
            "wc_stool",
            merge(
                disc(0.16, 0.03, 0.42),
                *(move(cuboid(0.03, 0.03, 0.42), a, b) for a in (-0.1, 0.1) for b in (-0.1, 0.1)),
            ),
        ),
        (7.75, 4.2),
        "Building/Floor",
        yaw=12,
    )
    salon.rest(f"{name}/Stool_towel", TOWEL, (7.75, 4.2), f"{name}/Stool", yaw=30)
    salon.rest(f"{name}/Slippers", salon.model("BlendSwap-CC-0/slippers"), (8.1, 4.5), "Building/Floor", yaw=60)
    salon.rest(f"{name}/Rolled_towel", ROLLED, (7.75, 4.2), f"{name}/Stool_towel", yaw=28)
