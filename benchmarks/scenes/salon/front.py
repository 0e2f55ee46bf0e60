"""The front of the shop: the counter, the places to wait, the play corner."""

from benchmarks.scenes.salon import furniture, things
from benchmarks.scenes.salon.shapes import (
    Shape,
    ball,
    box,
    cuboid,
    disc,
    hollow_box,
    lathe,
    merge,
    move,
    rod,
    squash,
    turn,
    vessel,
)
from benchmarks.scenes.salon.shared import CUP, MAGAZINE, SAUCER, SPOON, add_plant
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["build_front"]


def build_front(salon: Salon) -> None:
    """Add the counter, the places to wait and the play corner."""
    _build_counter(salon)
    _build_waiting(salon)
    _build_play_corner(salon)


def _build_counter(salon: Salon) -> None:
    name = "Shop/Reception"
    x, y = 4.5, 2.15
    salon.rest(f"{name}/Counter", Asset("counter", furniture.counter(1.6)), (x, y), "Building/Floor")
    front = Asset("counter_drawer", furniture.drawer(0.735, 0.5, 0.16, 0.21))
    knob = Asset(
        "drawer_knob",
        move(turn(lathe([(0.006, 0), (0.006, 0.012), (0.015, 0.018), (0.012, 0.028), (0, 0.028)]), "x", 90), y=0),
    )
    for number, z in enumerate((0.03, 0.255, 0.48), 1):
        out = 0.16 if number == 3 else 0.0
        salon.put(f"{name}/Drawer_{number}", front, (x + 0.3925, y + 0.3 + out, z), 180)
        salon.put(f"{name}/Knob_{number}", knob, (x + 0.3925, y + 0.3 + out, z + 0.12), 180)
    salon.rest(
        f"{name}/Notepad",
        Asset("notepad", cuboid(0.15, 0.21, 0.012)),
        (x + 0.3, y + 0.33),
        f"{name}/Drawer_3",
        yaw=10,
        below=0.55,
    )
    salon.rest(
        f"{name}/Stapler",
        salon.model("KatorLegaz/stapler"),
        (x + 0.55, y + 0.33),
        f"{name}/Drawer_3",
        yaw=60,
        below=0.55,
    )
    top = {"below": 0.8}
    salon.rest(
        f"{name}/Laptop", salon.model("BlendSwap-CC-BY/laptop"), (x - 0.35, y + 0.08), f"{name}/Counter", yaw=170, **top
    )
    salon.rest(
        f"{name}/Till",
        Asset("till", merge(cuboid(0.4, 0.38, 0.11), move(turn(cuboid(0.28, 0.02, 0.18), "x", 25), y=0.02, z=0.11))),
        (x + 0.45, y + 0.05),
        f"{name}/Counter",
        yaw=182,
        **top,
    )
    salon.rest(
        f"{name}/Desk_phone", salon.model("Scopia/phone"), (x + 0.08, y - 0.05), f"{name}/Counter", yaw=165, **top
    )
    salon.rest(f"{name}/Diary", Asset("diary", cuboid(0.3, 0.22, 0.03)), (x, y + 0.18), f"{name}/Counter", yaw=5, **top)
    salon.rest(f"{name}/Pencil", salon.model("Scopia/pencil2"), (x, y + 0.18), f"{name}/Diary", yaw=70)
    salon.rest(f"{name}/Pen_pot", salon.model("Scopia/penbox"), (x + 0.23, y - 0.2), f"{name}/Counter", **top)
    salon.rest(
        f"{name}/Lamp", salon.model("Scopia/desk_lamp1"), (x - 0.68, y + 0.05), f"{name}/Counter", yaw=200, **top
    )
    salon.rest(
        f"{name}/Sweet_bowl",
        Asset("sweet_bowl", vessel(0.05, 0.09, 0.07, 0.004)),
        (x - 0.5, y - 0.26),
        f"{name}/Counter",
    )
    sweet = Asset("sweet", ball(0.014))
    for number, (dx, dy) in enumerate(((0, 0), (0.032, 0.004), (-0.02, 0.026), (0.004, -0.034)), 1):
        salon.rest(f"{name}/Sweet_{number}", sweet, (x - 0.5 + dx, y - 0.26 + dy), f"{name}/Sweet_bowl")
    salon.rest(
        f"{name}/Card_stand",
        Asset(
            "card_stand",
            merge(
                box(-0.05, 0.05, -0.02, 0.025, 0, 0.004),
                box(-0.05, 0.05, 0.02, 0.025, 0.004, 0.05),
                box(-0.05, 0.05, -0.02, -0.016, 0.004, 0.02),
            ),
        ),
        (x - 0.1, y - 0.27),
        f"{name}/Counter",
        yaw=4,
    )
    salon.rest(
        f"{name}/Business_cards",
        Asset("business_cards", box(-0.043, 0.043, -0.012, 0.012, 0, 0.052)),
        (x - 0.1, y - 0.268),
        f"{name}/Card_stand",
        yaw=4,
        below=1.11,
    )
    add_plant(salon, f"{name}/Counter_plant", (x + 0.6, y - 0.26), f"{name}/Counter")
    salon.rest(
        f"{name}/Card_reader",
        Asset("card_reader", cuboid(0.08, 0.16, 0.04)),
        (x + 0.25, y - 0.27),
        f"{name}/Counter",
        yaw=12,
    )
    salon.rest(
        f"{name}/Folder_1",
        Asset("folder", cuboid(0.07, 0.28, 0.32)),
        (x - 0.68, y + 0.05),
        f"{name}/Counter",
        below=0.5,
    )
    salon.rest(
        f"{name}/Folder_2",
        Asset("folder", cuboid(0.07, 0.28, 0.32)),
        (x - 0.6, y + 0.04),
        f"{name}/Counter",
        yaw=2,
        below=0.5,
    )
    salon.rest(
        f"{name}/Book",
        Asset("price_book", cuboid(0.2, 0.28, 0.035)),
        (x - 0.3, y + 0.05),
        f"{name}/Counter",
        yaw=-8,
        below=0.5,
    )
    salon.rest(f"{name}/Waste_bin", salon.model("BlendSwap-CC-0/dustbin"), (x - 0.25, y + 0.05), "Building/Floor")
    paper = Asset("paper_ball", squash(ball(0.05), z=0.8))
    salon.rest(f"{name}/Paper_ball", paper, (x - 0.25, y + 0.05), f"{name}/Waste_bin", below=0.2)
    salon.rest(
        f"{name}/Backpack", salon.model("BlendSwap-CC-BY/backpack"), (x - 1.05, y + 0.1), "Building/Floor", yaw=180
    )
    salon.rest(f"{name}/Stool", salon.model("BlendSwap-CC-0/stool2"), (x - 0.1, y + 0.62), "Building/Floor", yaw=30)
    salon.rest(
        f"{name}/Stool_cushion", Asset("stool_cushion", squash(disc(0.15, 0.035))), (x - 0.1, y + 0.62), f"{name}/Stool"
    )


def _build_waiting(salon: Salon) -> None:
    name = "Shop/Waiting"
    salon.rest(f"{name}/Rug", Asset("rug", cuboid(1.9, 1.3, 0.012)), (1.55, 1.45), "Building/Floor", yaw=3)
    salon.rest(f"{name}/Sofa", salon.model("BlendSwap-CC-0/sofa2"), (1.6, 0.75), "Building/Floor", yaw=180)
    for number, x in enumerate((1.2, 2.0), 1):
        salon.rest(
            f"{name}/Cushion_{number}",
            Asset("sofa_cushion", things.cushion(0.36, 0.36)),
            (x, 0.9),
            f"{name}/Sofa",
            yaw=20 * number,
            below=0.55,
        )
    salon.rest(f"{name}/Coffee_table", Asset("coffee_table", _coffee_table()), (1.55, 1.65), f"{name}/Rug", yaw=2)
    table = f"{name}/Coffee_table"
    salon.rest(f"{name}/Magazine_1", MAGAZINE, (1.3, 1.65), table, yaw=12)
    for number, (dx, yaw) in enumerate(((0.005, 20), (-0.006, -4), (0.01, 33)), 2):
        salon.rest(f"{name}/Magazine_{number}", MAGAZINE, (1.3 + dx, 1.65), f"{name}/Magazine_{number - 1}", yaw=yaw)
    salon.rest(f"{name}/Magazine_5", MAGAZINE, (1.4, 1.62), table, yaw=80, below=0.3)
    salon.rest(f"{name}/Newspaper", salon.model("KatorLegaz/newspaper"), (1.75, 1.66), table, yaw=10, below=0.3)
    salon.rest(f"{name}/Vase", salon.model("Scopia/vase1"), (1.62, 1.72), table)
    salon.rest(f"{name}/Saucer", SAUCER, (1.85, 1.6), table)
    salon.rest(f"{name}/Cup", CUP, (1.85, 1.6), f"{name}/Saucer", yaw=-60)
    salon.rest(f"{name}/Spoon", SPOON, (1.85, 1.6), f"{name}/Cup", tilt=("y", 62), yaw=200)
    salon.rest(f"{name}/Glass", salon.model("KatorLegaz/12-oz-glass"), (1.7, 1.53), table)
    salon.rest(f"{name}/Armchair", salon.model("Scopia/armchair2"), (2.75, 1.6), "Building/Floor", yaw=-80)
    salon.rest(f"{name}/Floor_plant", salon.model("Scopia/ficus"), (0.4, 0.5), "Building/Floor")
    salon.rest(
        f"{name}/Side_table",
        Asset("side_table", merge(disc(0.2, 0.02, 0.5), rod("z", 0.02, 0.5, (0, 0), 0.02), disc(0.16, 0.02))),
        (2.8, 0.7),
        "Building/Floor",
    )
    salon.rest(f"{name}/Table_lamp", salon.model("Scopia/little_lamp1"), (2.8, 0.7), f"{name}/Side_table")


def _coffee_table() -> Shape:
    legs = [move(cuboid(0.05, 0.05, 0.41), x, y) for x in (-0.45, 0.45) for y in (-0.22, 0.22)]
    return merge(*legs, cuboid(1.0, 0.55, 0.03, 0.41), cuboid(0.9, 0.45, 0.015, 0.18))


def _build_play_corner(salon: Salon) -> None:
    name = "Shop/Play_corner"
    salon.rest(f"{name}/Play_rug", salon.model("Scopia/round-carpet"), (5.3, 0.8), "Building/Floor")
    salon.rest(f"{name}/Children_table", salon.model("Scopia/children_table"), (5.35, 0.85), f"{name}/Play_rug", yaw=5)
    salon.rest(
        f"{name}/Children_chair",
        salon.model("Scopia/children_chair"),
        (5.3, 0.36),
        ["Building/Floor", f"{name}/Play_rug"],
        yaw=170,
    )
    salon.rest(f"{name}/Doll", salon.model("Scopia/doll"), (5.3, 0.36), f"{name}/Children_chair", yaw=170, below=0.32)
    salon.rest(
        f"{name}/Colouring_book",
        Asset("colouring_book", cuboid(0.21, 0.28, 0.004)),
        (5.3, 0.85),
        f"{name}/Children_table",
        yaw=20,
    )
    salon.rest(
        f"{name}/Crayon",
        Asset("crayon", rod("x", -0.04, 0.04, (0, 0.005), 0.005)),
        (5.32, 0.87),
        f"{name}/Colouring_book",
        yaw=40,
    )
    salon.rest(
        f"{name}/Toy_box", Asset("toy_box", hollow_box(0.5, 0.35, 0.32, 0.012)), (5.72, 0.23), "Building/Floor", yaw=4
    )
    salon.rest(f"{name}/Ball", Asset("toy_ball", ball(0.09)), (5.85, 0.17), f"{name}/Toy_box")
    salon.rest(f"{name}/Toy_train", salon.model("BlendSwap-CC-BY/toyTrain"), (5.67, 0.31), f"{name}/Toy_box", yaw=5)
    salon.rest(
        f"{name}/Toy_plane", salon.model("BlendSwap-CC-0/cartoon_biplane"), (5.67, 0.31), f"{name}/Toy_train", yaw=30
    )
    block = Asset("toy_block", cuboid(0.04, 0.04, 0.04))
    for number, (bx, by, onto) in enumerate(
        ((5.05, 0.85, "Play_rug"), (5.1, 0.86, "Play_rug"), (5.08, 0.855, "Block_1 Block_2"), (5.06, 0.94, "Play_rug")),
        1,
    ):
        salon.rest(
            f"{name}/Block_{number}", block, (bx, by), [f"{name}/{part}" for part in onto.split()], yaw=11 * number
        )
