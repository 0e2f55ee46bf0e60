"""The shop: its window, the shelves with goods, the cloakroom, the lights."""

from benchmarks.scenes.salon import furniture, things
from benchmarks.scenes.salon.rooms import WALLS, at_wall, hang
from benchmarks.scenes.salon.shapes import Shape, box, disc, hollow_box, merge, rod, turn, vessel
from benchmarks.scenes.salon.shared import JAR, LOTION, MAGNET, NOTE, SHAMPOO, TUBE, add_plant
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["build_shop"]

CAPE = Asset("cape", things.cape())
HANGER = Asset("hanger", things.hanger())
PENDANT = Asset("pendant", things.pendant(0.75))


def build_shop(salon: Salon) -> None:
    """Add the window, the shelves, the cloakroom and the lights."""
    _build_window(salon)
    _build_retail(salon)
    _build_cloakroom(salon)
    _build_lights(salon)


def _build_window(salon: Salon) -> None:
    salon.put("Building/Shop_window", Asset("window_a", furniture.window(2.0, 1.5)), (1.6, -0.1, 0.8))
    salon.put("Building/Shop_door", Asset("shop_door", furniture.window(1.0, 2.1)), (3.8, -0.1, 0))
    salon.put("Building/Window_sill", Asset("sill", furniture.board(2.1, 0.24, 0.03)), (1.6, -0.02, 0.802), 180)
    hang(salon, "Shop/Curtain_rail", Asset("curtain_rail", _rail(2.3)), "shop south", 1.6, 2.42)
    curtain = Asset("curtain", furniture.curtain(0.5, 1.6))
    for number, x in enumerate((0.72, 2.5), 1):
        salon.put(f"Shop/Curtain_{number}", curtain, (x, 0.1, 0.815))
    for number, x in enumerate((1.2, 2.0), 1):
        add_plant(salon, f"Shop/Sill_plant_{number}", (x, 0.12), "Building/Window_sill")
    salon.rest("Shop/Sill_cactus", salon.model("BlendSwap-CC-0/cactus"), (1.55, 0.12), "Building/Window_sill", yaw=30)


def _rail(length: float) -> Shape:
    ends = [box(x - 0.01, x + 0.01, -0.11, 0, -0.01, 0.01) for x in (-length * 0.45, length * 0.45)]
    return merge(rod("x", -length / 2, length / 2, (-0.1, 0), 0.011), *ends)


def _build_retail(salon: Salon) -> None:
    heights = (0.45, 0.83, 1.21, 1.55)
    name, yaw = "Shop/Retail", WALLS["shop west"][0]
    salon.rest(
        f"{name}/Shelves",
        Asset("retail_shelves", furniture.carcass(1.3, 0.3, 1.9, heights), 0.001, "Z", "salon_retail_shelves.usda"),
        at_wall("shop west", 4.9, 0.16),
        "Building/Floor",
        yaw=yaw,
    )
    kinds = ((2, SHAMPOO, 5, "Shampoo"), (1, LOTION, 6, "Lotion"), (0, JAR, 4, "Wax"), (3, TUBE, 4, "Dye"))
    for level, asset, count, noun in kinds:
        for index in range(count):
            y = 4.42 + 0.16 * index + 0.02 * ((index * 7 + level) % 3)
            off = 0.14 + 0.03 * ((index + level) % 2)
            salon.rest(
                f"{name}/{noun}_{index + 1}",
                asset,
                at_wall("shop west", y, off),
                f"{name}/Shelves",
                yaw=23 * index,
                below=heights[level] + 0.03,
            )
    salon.rest(f"{name}/Wax_5", JAR, at_wall("shop west", 4.44, 0.14), f"{name}/Wax_1")
    salon.rest(
        f"{name}/Carton",
        Asset("carton", hollow_box(0.34, 0.26, 0.2, 0.004)),
        at_wall("shop west", 5.2, 0.16),
        f"{name}/Shelves",
        yaw=yaw + 4,
        below=0.1,
    )
    for index in range(3):
        salon.rest(
            f"{name}/Carton_bottle_{index + 1}",
            LOTION,
            at_wall("shop west", 5.11 + 0.08 * index, 0.15 + 0.02 * index),
            f"{name}/Carton",
            yaw=8,
            below=0.15,
        )
    salon.rest(
        f"{name}/Basket",
        salon.model("KatorLegaz/recycling-bin"),
        at_wall("shop west", 4.6, 0.16),
        f"{name}/Shelves",
        yaw=yaw,
        below=0.1,
    )
    tag = Asset("price_tag", box(-0.03, 0.03, -0.003, 0, -0.035, 0))
    for index, (along, level) in enumerate(((4.6, 2), (5.2, 2), (4.7, 1)), 1):
        x, y = at_wall("shop west", along, 0.302)
        salon.put(f"{name}/Price_tag_{index}", tag, (x, y, heights[level] + 0.002), yaw)
    salon.rest(
        f"{name}/Teddy",
        salon.model("BlendSwap-CC-0/teddyBear"),
        at_wall("shop west", 5.1, 0.17),
        f"{name}/Shelves",
        yaw=yaw,
    )
    salon.rest(
        f"{name}/Gift",
        salon.model("BlendSwap-CC-BY/gift"),
        at_wall("shop west", 4.6, 0.17),
        f"{name}/Shelves",
        yaw=yaw + 12,
    )


def _build_cloakroom(salon: Salon) -> None:
    name, wall = "Shop/Cloakroom", "shop west"
    hang(salon, f"{name}/Hook_rail", Asset("hook_rail", furniture.hook_rail(1.5, 5)), wall, 3.45, 1.7)
    hooks = [at_wall(wall, 2.85 + 0.3 * i, 0.05) for i in range(5)]
    coat = Asset("coat", things.coat(0.95))
    salon.put(f"{name}/Coat_1", coat, (*hooks[0], 1.682), 90)
    salon.put(f"{name}/Coat_2", coat, (*hooks[2], 1.68), 94)
    salon.put(f"{name}/Jacket", Asset("jacket", things.coat(0.62)), (*hooks[4], 1.681), 86)
    scarf = Asset("scarf", things.draped(0.085, 0.5, 0.45, 0.008))
    salon.put(f"{name}/Scarf", scarf, (*hooks[3], 1.688), 0)
    salon.rest(
        f"{name}/Bench", Asset("bench", furniture.bench(1.0)), at_wall(wall, 3.4, 0.32), "Building/Floor", yaw=90
    )
    salon.rest(f"{name}/Hat", salon.model("Scopia/chapeau"), at_wall(wall, 3.1, 0.33), f"{name}/Bench", yaw=50)
    salon.rest(f"{name}/Shoes", salon.model("Scopia/woman_shoes"), at_wall(wall, 3.45, 0.3), "Building/Floor", yaw=90)
    salon.rest(
        f"{name}/Shopping_bag",
        Asset("shopping_bag", things.bag(0.3, 0.18, 0.32)),
        at_wall(wall, 3.66, 0.33),
        f"{name}/Bench",
        yaw=80,
    )
    salon.rest(
        f"{name}/Bread",
        salon.model("BlendSwap-CC-0/bread"),
        at_wall(wall, 3.66, 0.33),
        f"{name}/Shopping_bag",
        yaw=80,
        below=0.7,
    )
    salon.rest(
        f"{name}/Milk", salon.model("BlendSwap-CC-0/tetrapak"), at_wall(wall, 3.62, 0.33), f"{name}/Bread", yaw=80
    )
    salon.rest(
        f"{name}/Umbrella_stand",
        Asset("umbrella_stand", vessel(0.11, 0.12, 0.5, 0.005)),
        at_wall(wall, 4.1, 0.2),
        "Building/Floor",
    )
    umbrella = Asset("umbrella", things.umbrella())
    for number, (dx, dy, angle, yaw) in enumerate(((-0.05, 0.04, 8, 0), (0.05, -0.04, -8, 0)), 1):
        salon.rest(
            f"{name}/Umbrella_{number}",
            umbrella,
            (0.2 + dx, 4.1 + dy),
            f"{name}/Umbrella_stand",
            tilt=("x", angle),
            yaw=yaw,
            below=0.1,
        )
    hang(
        salon,
        f"{name}/Notice_board",
        Asset(
            "notice_board",
            merge(box(-0.4, 0.4, -0.015, 0, 0, 0.6), *(box(x, x + 0.02, -0.022, 0, 0, 0.6) for x in (-0.4, 0.38))),
        ),
        wall,
        2.1,
        1.3,
        0.002,
    )
    for number, (along, z) in enumerate(((1.9, 1.7), (2.1, 1.55), (2.28, 1.72), (2.16, 1.45)), 1):
        hang(salon, f"{name}/Note_{number}", NOTE, wall, along, z, 0.018 + 0.001 * number)
        if number != 4:
            hang(salon, f"{name}/Magnet_{number}", MAGNET, wall, along, z + 0.055, 0.0185 + 0.001 * number)
    hang(salon, f"{name}/Poster", Asset("poster", things.card(0.5, 0.7)), wall, 1.3, 1.6, 0.001)
    hang(salon, f"{name}/Wall_clock", Asset("wall_clock", turn(disc(0.15, 0.04), "x", 90)), wall, 2.1, 2.2, -0.002)
    hang(salon, f"{name}/Certificate_1", Asset("certificate", furniture.frame(0.3, 0.4, 0.015, 0.02)), wall, 0.45, 1.5)
    hang(
        salon,
        f"{name}/Certificate_2",
        Asset("certificate", furniture.frame(0.3, 0.4, 0.015, 0.02)),
        wall,
        0.85,
        1.55,
        0.007,
    )


def _build_lights(salon: Salon) -> None:
    for number, (x, y) in enumerate(((1.6, 1.5), (4.5, 2.2), (5.3, 0.9)), 1):
        salon.put(f"Shop/Pendant_{number}", PENDANT, (x, y, 2.8 - 0.003 * (number - 2)))
    salon.put("Shop/Track/Rail", Asset("track", box(-2.0, 2.0, -0.02, 0.02, -0.03, 0)), (2.8, 4.4, 2.8))
    for number, x in enumerate((1.2, 2.8, 4.4), 1):
        salon.put(f"Shop/Track/Spot_{number}", Asset("spot", things.spot()), (x, 4.4, 2.772), 180 + 10 * (number - 2))
    salon.put("Shop/Smoke_detector", Asset("smoke_detector", disc(0.06, 0.035, -0.035)), (3.4, 3.1, 2.8))
    for number, (x, y, yaw) in enumerate(((5.35, 5.55, -30), (0.85, 5.9, 30)), 1):
        salon.rest(
            f"Shop/Hood_dryer_{number}",
            Asset("hood_dryer", things.dryer_hood()),
            (
                x,
                y - 0.35,
            ),
            "Building/Floor",
            yaw=yaw,
        )
    salon.rest(
        "Shop/Cape_rail", Asset("cape_rail", furniture.coat_rail(0.8, 1.5)), (0.7, 2.55), "Building/Floor", yaw=4
    )
    top = salon.objects["Shop/Cape_rail"].matrix[2, 3] + 1.5
    for number, dx in enumerate((-0.25, -0.08, 0.06, 0.26), 1):
        salon.put(f"Shop/Hanger_{number}", HANGER, (0.7 + dx, 2.55 + 0.07 * dx, top - 0.0175), 4 + 2 * number)
        if number < 4:
            salon.put(f"Shop/Cape_{number}", CAPE, (0.7 + dx, 2.55 + 0.07 * dx, top - 0.0175), 4 + 2 * number)
    hang(salon, "Shop/Light_switch", salon.model("Scopia/square-switch"), "shop south", 4.5, 1.1)
    hang(salon, "Shop/Socket_1", salon.model("BlendSwap-CC-BY/wallSocket"), "shop north", 2.0, 0.3)
    hang(salon, "Shop/Socket_2", salon.model("BlendSwap-CC-BY/wallDoubleSocket"), "shop north", 3.6, 0.3)
    hang(salon, "Shop/Radiator", salon.model("BlendSwap-CC-0/radiator3"), "shop south", 2.95, 0.15, 0.02)
    hang(salon, "Shop/Extinguisher", salon.model("BlendSwap-CC-0/fireExtinguisher"), "shop east", 2.7, 0.9, 0.003)
    hang(salon, "Shop/Emergency_sign", salon.model("BlendSwap-CC-0/emergencySign"), "shop south", 3.8, 2.25)
    hang(
        salon,
        "Shop/Loudspeaker_shelf",
        Asset("loudspeaker_shelf", furniture.bracket_shelf(0.4, 0.28)),
        "shop east",
        5.6,
        2.0,
        0.0,
    )
    salon.rest(
        "Shop/Loudspeaker",
        salon.model("BlendSwap-CC-0/speaker2"),
        at_wall("shop east", 5.6, 0.14),
        "Shop/Loudspeaker_shelf",
        yaw=-90,
    )
