"""Where hair is cut and washed: stations, trolleys, wash places."""

import numpy as np

from benchmarks.scenes.salon import furniture, things
from benchmarks.scenes.salon.rooms import WALLS, at_wall, hang
from benchmarks.scenes.salon.shapes import Shape, bent, box, cuboid, lathe, merge, move, rod, turn, vessel
from benchmarks.scenes.salon.shared import (
    COMB,
    CUP,
    JAR,
    MAGAZINE,
    ROLLED,
    SAUCER,
    SHAMPOO,
    SPOON,
    TAP,
    TUBE,
    add_plant,
)
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["build_stations"]

CHAIR = Asset("styling_chair", furniture.chair_of_salon(), 0.0254, "Z", "salon_styling_chair.usda")
TROLLEY = Asset("trolley", furniture.trolley_frame((0.2, 0.36, 0.52, 0.68)), 0.001, "Z", "salon_trolley.usda")
TROLLEY_DRAWER = Asset("trolley_drawer", furniture.drawer(0.345, 0.3, 0.06, 0.13))
MIRROR = Asset("mirror", furniture.frame(0.8, 1.25))
LEDGE = Asset("ledge", furniture.board(0.85, 0.28, 0.03))
RING = Asset(
    "dryer_ring",
    merge(
        move(lathe([(0.045, 0), (0.05, 0), (0.05, 0.04), (0.045, 0.04), (0.045, 0)]), y=-0.1),
        box(-0.01, 0.01, -0.055, 0, 0, 0.04),
    ),
)
DRYER = Asset("hair_dryer", things.hair_dryer())
BRUSH = Asset("brush", things.brush())
SPRAY = Asset("spray_bottle", things.spray_bottle())
SCISSORS = Asset("scissors", things.scissors())


def build_stations(salon: Salon) -> None:
    """Add the stations, the trolleys and the wash places."""
    for number, x in enumerate((1.2, 2.8, 4.4), 1):
        _build_station(salon, f"Shop/Station_{number}", x)
    _fill_stations(salon)
    for number, (x, y) in enumerate(((2.0, 5.3), (3.6, 5.1)), 1):
        _build_trolley(salon, f"Shop/Trolley_{number}", x, y, 12.0 - 40 * number)
    _fill_trolleys(salon)
    for number, y in enumerate((3.3, 4.2), 1):
        _build_wash_place(salon, f"Shop/Wash_place_{number}", y)


def _build_station(salon: Salon, name: str, x: float) -> None:
    hang(salon, f"{name}/Mirror", MIRROR, "shop north", x, 0.98, 0.004)
    hang(salon, f"{name}/Ledge", LEDGE, "shop north", x, 0.88, -0.003)
    hang(salon, f"{name}/Dryer_holder", RING, "shop north", x + 0.55, 1.0, 0.002)
    salon.put(f"{name}/Hair_dryer", DRYER, (x + 0.51, 5.898, 1.022), 0, ("y", 90))
    hang(salon, f"{name}/Mirror_lamp", Asset("mirror_lamp", _mirror_lamp()), "shop north", x, 2.28, 0.006)
    salon.rest(f"{name}/Styling_chair", CHAIR, (x + 0.03, 5.05), "Building/Floor", yaw=180 + 9 * (x - 2))


def _mirror_lamp() -> Shape:
    return merge(
        box(-0.05, 0.05, -0.02, 0, 0, 0.06),
        bent([(0, -0.015, 0.03), (0, -0.08, 0.05), (0, -0.12, 0.03)], 0.008),
        rod("x", -0.25, 0.25, (-0.12, 0.01), 0.02),
    )


def _fill_stations(salon: Salon) -> None:
    jar = Asset("comb_jar", vessel(0.035, 0.04, 0.14, 0.003))
    one, two, three = (f"Shop/Station_{number}" for number in (1, 2, 3))
    salon.rest(f"{one}/Comb_jar", jar, (0.9, 5.88), f"{one}/Ledge")
    for number, (dx, angle) in enumerate(((-0.012, 80), (0.012, 97), (0.0, 90)), 1):
        salon.rest(
            f"{one}/Comb_{number}",
            COMB,
            (0.9 + dx, 5.866 + 0.007 * number),
            f"{one}/Comb_jar",
            tilt=("y", angle),
            below=1.0,
        )
    salon.rest(f"{one}/Spray_bottle", SPRAY, (1.05, 5.85), f"{one}/Ledge", yaw=25)
    salon.rest(f"{one}/Saucer", SAUCER, (1.38, 5.84), f"{one}/Ledge")
    salon.rest(f"{one}/Cup", CUP, (1.38, 5.84), f"{one}/Saucer", yaw=40)
    salon.rest(f"{one}/Spoon", SPOON, (1.37, 5.79), f"{one}/Saucer", yaw=10)
    salon.rest(f"{one}/Brush", BRUSH, (1.2, 5.775), f"{one}/Ledge", yaw=-6)
    salon.rest(f"{two}/Scissors", SCISSORS, (2.55, 5.83), f"{two}/Ledge", yaw=60)
    salon.rest(f"{two}/Tray", salon.model("Scopia/sushi_tray"), (2.8, 5.85), f"{two}/Ledge")
    salon.rest(
        f"{two}/Clip_bowl",
        Asset("clip_bowl", vessel(0.03, 0.05, 0.045, 0.003)),
        (2.73, 5.86),
        f"{two}/Tray",
        below=0.93,
    )
    clip = Asset(
        "hair_clip", merge(box(-0.022, 0.022, -0.004, 0.004, 0, 0.003), box(-0.022, 0.0, -0.004, 0.004, 0.003, 0.008))
    )
    for number, (dx, dy, yaw) in enumerate(((0.002, 0.006, 20), (-0.003, -0.006, 100)), 1):
        salon.rest(
            f"{two}/Hair_clip_{number}",
            clip,
            (2.73 + dx, 5.86 + dy),
            [f"{two}/Clip_bowl", *([f"{two}/Hair_clip_1"] if number == 2 else [])],
            yaw=yaw,
        )
    salon.rest(f"{two}/Wax", JAR, (2.88, 5.87), f"{two}/Tray")
    salon.rest(f"{two}/Brush", BRUSH, (3.07, 5.83), f"{two}/Ledge", yaw=70)
    salon.rest(f"{three}/Magazine_1", MAGAZINE, (4.2, 5.85), f"{three}/Ledge", yaw=85)
    salon.rest(f"{three}/Magazine_2", MAGAZINE, (4.21, 5.855), f"{three}/Magazine_1", yaw=97)
    salon.rest(
        f"{three}/Sunglasses", salon.model("BlendSwap-CC-BY/sunglasses"), (4.2, 5.85), f"{three}/Magazine_2", yaw=10
    )
    salon.rest(f"{three}/Phone", salon.model("BlendSwap-CC-0/iphone"), (4.47, 5.84), f"{three}/Ledge", yaw=70)
    add_plant(salon, f"{three}/Orchid", (4.7, 5.86), f"{three}/Ledge")
    salon.rest(
        "Shop/Chair_towel",
        Asset("chair_towel", things.draped(0.34, 0.22, 0.25, 0.045)),
        (2.85, 4.78),
        f"{two}/Styling_chair",
        yaw=7,
    )
    salon.rest("Shop/Handbag", salon.model("BlendSwap-CC-0/handbag"), (4.85, 5.25), "Building/Floor", yaw=35)
    salon.rest(
        "Shop/Seat_cushion",
        Asset("booster_cushion", things.cushion(0.38, 0.36)),
        (1.2, 5.05),
        f"{one}/Styling_chair",
        below=0.6,
    )


def _build_trolley(salon: Salon, name: str, x: float, y: float, yaw: float) -> None:
    salon.rest(f"{name}/Frame", TROLLEY, (x, y), "Building/Floor", yaw=yaw)
    lift = salon.objects[f"{name}/Frame"].matrix[2, 3]
    for number, rail in enumerate((0.2, 0.36, 0.52, 0.68), 1):
        out = 0.12 if (name[-1], number) == ("2", 4) else 0.0
        front = turn(Shape(np.array([[0, -0.19 - out, 0]]), []), "z", yaw).points[0]
        salon.put(f"{name}/Drawer_{number}", TROLLEY_DRAWER, (x + front[0], y + front[1], lift + rail - 0.011), yaw)


def _fill_trolleys(salon: Salon) -> None:
    one, two = "Shop/Trolley_1", "Shop/Trolley_2"
    salon.rest(f"{one}/Hair_dryer", DRYER, (2.02, 5.33), f"{one}/Frame", yaw=140)
    salon.rest(f"{one}/Brush_1", BRUSH, (1.93, 5.26), f"{one}/Frame", yaw=-20)
    salon.rest(f"{one}/Brush_2", BRUSH, (2.06, 5.19), f"{one}/Frame", yaw=-34)
    salon.rest(
        f"{one}/Foil",
        Asset("foil_roll", rod("x", -0.1, 0.1, (0, 0.025), 0.025)),
        (2.0, 5.3),
        f"{one}/Drawer_3",
        yaw=-28,
    )
    salon.rest(
        f"{one}/Gloves", Asset("box_of_gloves", cuboid(0.2, 0.11, 0.06)), (2.0, 5.29), f"{one}/Drawer_2", yaw=-20
    )
    salon.rest(f"{two}/Dye_bowl", Asset("dye_bowl", vessel(0.045, 0.065, 0.055, 0.003)), (3.52, 5.16), f"{two}/Frame")
    salon.rest(
        f"{two}/Dye_brush",
        Asset("dye_brush", merge(box(-0.02, 0.02, -0.03, 0.03, 0, 0.008), box(0.02, 0.17, -0.006, 0.006, 0, 0.007))),
        (3.5, 5.16),
        f"{two}/Dye_bowl",
        yaw=35,
        tilt=("y", -34),
    )
    salon.rest(f"{two}/Dye_1", TUBE, (3.67, 5.2), f"{two}/Frame", yaw=-60)
    salon.rest(f"{two}/Dye_2", TUBE, (3.7, 5.13), f"{two}/Frame", yaw=-66, tilt=("y", 90))
    salon.rest(f"{two}/Spray_bottle", SPRAY, (3.62, 5.01), f"{two}/Frame", yaw=100)
    salon.rest(f"{two}/Scissors", SCISSORS, (3.48, 5.06), f"{two}/Drawer_4", yaw=20)
    salon.rest(f"{two}/Comb", COMB, (3.43, 5.0), f"{two}/Drawer_4", yaw=24)


def _build_wash_place(salon: Salon, name: str, y: float) -> None:
    yaw = WALLS["shop east"][0]
    salon.put(f"{name}/Stand", Asset("wash_stand", furniture.wash_stand()), (*at_wall("shop east", y, 0.25), 0), yaw)
    salon.rest(
        f"{name}/Basin",
        Asset("wash_basin", furniture.basin(0.55, 0.6, 0.2)),
        at_wall("shop east", y, 0.33),
        f"{name}/Stand",
        yaw=yaw,
    )
    salon.rest(f"{name}/Tap", TAP, at_wall("shop east", y, 0.08), f"{name}/Basin", yaw=yaw)
    x0, y0 = at_wall("shop east", y - 0.14, 0.07)
    top = salon.objects[f"{name}/Basin"].solid.points[:, 2].max()
    salon.put(f"{name}/Hand_shower", Asset("hand_shower", things.hand_shower()), (x0, y0, top - 0.004), yaw)
    path = [
        (0, 0, 0.02),
        (0.02, 0.03, 0.0),
        (0.02, 0.02, -0.1),
        (-0.04, 0.01, -0.3),
        (-0.08, 0.01, -0.1),
        (-0.12, 0, 0.0),
    ]
    salon.put(f"{name}/Hose", Asset("shower_hose", things.hose([(a, b, c) for a, b, c in path])), (x0, y0, top), yaw)
    salon.rest(
        f"{name}/Wash_chair",
        Asset("wash_chair", furniture.wash_chair()),
        at_wall("shop east", y, 1.2),
        "Building/Floor",
        yaw=yaw,
    )
    number = name[-1]
    hang(salon, f"{name}/Shelf", Asset("wash_shelf", furniture.bracket_shelf(0.82, 0.22)), "shop east", y, 1.45, 0.003)
    for index in range(3):
        salon.rest(
            f"{name}/Shampoo_{index + 1}",
            SHAMPOO,
            at_wall("shop east", y - 0.35 + 0.09 * index, 0.1 + 0.02 * (index % 2)),
            f"{name}/Shelf",
            yaw=15 * index,
        )
    for index in range(3):
        onto = [f"{name}/Shelf"] if index < 2 else [f"{name}/Rolled_towel_1", f"{name}/Rolled_towel_2"]
        salon.rest(
            f"{name}/Rolled_towel_{index + 1}",
            ROLLED,
            at_wall("shop east", y + 0.25, 0.06 + 0.1 * index if index < 2 else 0.11),
            onto,
            yaw=yaw + 3 * index,
        )
    if number == "1":
        salon.rest(
            f"{name}/Neck_towel",
            Asset("neck_towel", things.draped(0.3, 0.12, 0.14, 0.06)),
            at_wall("shop east", y, 0.62),
            f"{name}/Basin",
            yaw=yaw,
        )
