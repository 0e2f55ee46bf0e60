"""The back room, for the laundry and the breaks."""

from benchmarks.scenes.salon import furniture, things
from benchmarks.scenes.salon.rooms import WALLS, at_wall, hang
from benchmarks.scenes.salon.shapes import (
    Shape,
    ball,
    bent,
    box,
    cuboid,
    disc,
    hollow_box,
    merge,
    move,
    rod,
    squash,
    turn,
    vessel,
)
from benchmarks.scenes.salon.shared import LOTION, PLATE, SHAMPOO, TOWEL
from benchmarks.scenes.salon.stage import Asset, Salon

__all__ = ["build_back_room"]

BOX = Asset("storage_box", hollow_box(0.36, 0.28, 0.2, 0.004))
BOX_LID = Asset("storage_box_lid", things.lid(0.37, 0.29))
APRON = Asset("apron", things.apron())
KEY = Asset("key", things.key())
WET_TOWEL = Asset("wet_towel", things.draped(0.3, 0.32, 0.34, 0.011))


def build_back_room(salon: Salon) -> None:
    """Add everything in the back room."""
    rail = Asset(
        "door_curtain_rail",
        merge(
            rod("x", -0.6, 0.6, (-0.06, 0), 0.01),
            *(box(x - 0.01, x + 0.01, -0.065, 0, -0.01, 0.01) for x in (-0.55, 0.55)),
        ),
    )
    hang(salon, "Back/Door_curtain_rail", rail, "back west", 1.9, 2.15)
    salon.put(
        "Back/Door_curtain", Asset("door_curtain", furniture.curtain(0.45, 2.08, 8, 0.06)), (6.18, 2.2, 0.065), 90
    )
    _build_laundry(salon)
    _build_rack(salon)
    _build_cleaning(salon)
    _build_break_table(salon)


def _build_laundry(salon: Salon) -> None:
    name, wall = "Back/Laundry", "back east"
    yaw = WALLS[wall][0]
    salon.rest(
        f"{name}/Washing_machine",
        salon.model("Scopia/clothes_washing_machine"),
        at_wall(wall, 1.3, 0.34),
        "Building/Floor",
        yaw=yaw,
    )
    salon.rest(
        f"{name}/Dryer",
        salon.model("Scopia/dryer_machine"),
        at_wall(wall, 1.31, 0.34),
        f"{name}/Washing_machine",
        yaw=yaw,
    )
    salon.rest(
        f"{name}/Washing_powder",
        Asset("washing_powder", cuboid(0.16, 0.08, 0.24)),
        at_wall(wall, 1.15, 0.3),
        f"{name}/Dryer",
        yaw=20,
    )
    salon.rest(
        f"{name}/Peg_basket",
        Asset("peg_basket", vessel(0.08, 0.11, 0.11, 0.004)),
        at_wall(wall, 1.45, 0.3),
        f"{name}/Dryer",
    )
    peg = Asset("clothes_peg", cuboid(0.07, 0.012, 0.01))
    for number, (dx, dy, turned) in enumerate(((0, 0, 20), (0.01, 0.03, 80), (-0.02, -0.03, 130)), 1):
        x, y = at_wall(wall, 1.45, 0.3)
        salon.rest(
            f"{name}/Peg_{number}",
            peg,
            (x + dx, y + dy),
            [f"{name}/Peg_basket", *(f"{name}/Peg_{i}" for i in range(1, number))],
            yaw=turned,
        )
    basket = Asset("laundry_basket", squash(vessel(0.2, 0.27, 0.34, 0.008), x=1.3))
    salon.rest(f"{name}/Basket", basket, (8.2, 1.25), "Building/Floor", yaw=70)
    used = Asset("used_towel", squash(ball(0.13), x=1.2, z=0.6))
    for number, (dx, dy) in enumerate(((0.02, -0.06), (-0.03, 0.08), (0.02, 0.0)), 1):
        onto = [f"{name}/Basket"] if number < 3 else [f"{name}/Used_towel_1", f"{name}/Used_towel_2"]
        salon.rest(f"{name}/Used_towel_{number}", used, (8.2 + dx, 1.25 + dy), onto, yaw=40 * number, below=0.6)
    salon.rest(f"{name}/Drying_rack", Asset("drying_rack", furniture.drying_rack(0.9)), (7.75, 3.1), "Building/Floor")
    lift = float(salon.objects[f"{name}/Drying_rack"].matrix[2, 3]) + 0.956
    for number, (dx, bar) in enumerate(((-0.25, -0.28), (0.1, -0.28), (-0.22, 0.056), (0.15, 0.28)), 1):
        salon.put(f"{name}/Wet_towel_{number}", WET_TOWEL, (7.75 + dx, 3.1 + bar, lift - 0.006))
    hang(salon, f"{name}/Towel_shelf", Asset("towel_shelf", furniture.board(0.9, 0.3, 0.025)), wall, 2.4, 1.9, -0.002)
    for stack, along in enumerate((2.15, 2.6), 1):
        for number in range(1, 4):
            under = f"{name}/Towel_shelf" if number == 1 else f"{name}/Stack_{stack}/Towel_{number - 1}"
            salon.rest(
                f"{name}/Stack_{stack}/Towel_{number}",
                TOWEL,
                at_wall(wall, along + 0.003 * number, 0.14),
                under,
                yaw=yaw + 2 * number,
            )
    board = turn(things.ironing_board(), "x", -9)
    salon.put(
        f"{name}/Ironing_board",
        Asset("ironing_board", things.ironing_board()),
        (*at_wall(wall, 1.85, 0.237), -float(board.points[:, 2].min()) + 0.002),
        yaw,
        ("x", -9),
    )


def _build_rack(salon: Salon) -> None:
    name, wall = "Back/Rack", "back east"
    yaw, heights = WALLS[wall][0], (0.1, 0.55, 1.0, 1.45)
    salon.rest(
        f"{name}/Rack",
        Asset("rack", furniture.metal_rack(1.1, 0.45, 1.6, heights)),
        at_wall(wall, 3.15, 0.26),
        "Building/Floor",
        yaw=yaw,
    )
    rack = f"{name}/Rack"
    for number, (along, level) in enumerate(((2.85, 1), (3.35, 1), (2.85, 2)), 1):
        salon.rest(
            f"{name}/Box_{number}",
            BOX,
            at_wall(wall, along, 0.26),
            rack,
            yaw=yaw + 2 * number,
            below=heights[level] + 0.01,
        )
    salon.rest(f"{name}/Lid_2", BOX_LID, at_wall(wall, 3.35, 0.26), f"{name}/Box_2", yaw=yaw + 4)
    salon.rest(f"{name}/Box_4", BOX, at_wall(wall, 3.36, 0.26), f"{name}/Lid_2", yaw=yaw - 3)
    salon.rest(f"{name}/Lid_3", BOX_LID, at_wall(wall, 2.85, 0.26), f"{name}/Box_3", yaw=yaw + 6)
    for number in (1, 2, 3):
        salon.rest(
            f"{name}/Bottle_{number}",
            LOTION,
            at_wall(wall, 2.71 + 0.07 * number, 0.24 + 0.02 * number),
            f"{name}/Box_1",
        )
    small = Asset("small_box", hollow_box(0.16, 0.12, 0.08, 0.003))
    salon.rest(f"{name}/Small_box", small, at_wall(wall, 3.3, 0.28), f"{name}/Box_4", yaw=15)
    roller = Asset("roller", move(rod("x", -0.03, 0.03, (0, 0.014), 0.014)))
    for number, dx in enumerate((-0.035, 0.0, 0.035), 1):
        x, y = at_wall(wall, 3.3, 0.28)
        salon.rest(f"{name}/Roller_{number}", roller, (x + dx, y + 0.27 * dx), f"{name}/Small_box", yaw=105)
    salon.rest(
        f"{name}/Curlers_3",
        Asset("curling_iron", merge(rod("x", -0.12, 0.1, (0, 0.016), 0.016), rod("x", 0.1, 0.18, (0, 0.016), 0.01))),
        at_wall(wall, 3.33, 0.26),
        f"{name}/Box_2",
        yaw=95,
        below=0.6,
    )
    salon.rest(
        f"{name}/Carton", salon.model("Scopia/cardboard-box"), at_wall(wall, 2.95, 0.26), rack, yaw=yaw, below=0.11
    )
    salon.rest(
        f"{name}/Toolbox",
        Asset(
            "toolbox",
            merge(
                cuboid(0.4, 0.2, 0.18),
                bent([(-0.08, 0, 0.17), (-0.08, 0, 0.22), (0.08, 0, 0.22), (0.08, 0, 0.17)], 0.008),
            ),
        ),
        at_wall(wall, 3.45, 0.26),
        rack,
        yaw=yaw,
        below=0.11,
    )
    salon.rest(
        f"{name}/Fan", salon.model("BlendSwap-CC-0/tableFan"), at_wall(wall, 3.3, 0.26), rack, yaw=yaw + 20, below=1.02
    )
    salon.rest(
        f"{name}/Mannequin_head",
        Asset(
            "mannequin_head",
            merge(disc(0.08, 0.02), rod("z", 0.02, 0.12, (0, 0), 0.045), move(squash(ball(0.09), z=1.25), z=0.1)),
        ),
        at_wall(wall, 3.55, 0.26),
        rack,
        below=1.02,
    )
    salon.rest(
        f"{name}/Suitcase",
        salon.model("BlendSwap-CC-0/briefcase"),
        at_wall(wall, 2.95, 0.26),
        rack,
        yaw=yaw,
        below=1.47,
    )
    salon.rest(f"{name}/Helmet", salon.model("Scopia/casque"), at_wall(wall, 3.4, 0.26), rack, yaw=yaw + 30, below=1.47)


def _build_cleaning(salon: Salon) -> None:
    name = "Back/Cleaning"
    _lean(salon, f"{name}/Broom", Asset("broom", things.broom()), 8.35, -8)
    _lean(salon, f"{name}/Ladder", Asset("ladder", furniture.ladder(1.9, 6)), 7.75, -10)
    salon.rest(
        f"{name}/Mop_bucket", Asset("mop_bucket", things.bucket(0.17, 0.3)), (8.75, 2.3), "Building/Floor", yaw=45
    )
    mop = Asset("mop", merge(squash(ball(0.09), z=0.7), rod("z", 0.1, 1.3, (0, 0), 0.012)))
    salon.rest(f"{name}/Mop", mop, (8.73, 2.3), f"{name}/Mop_bucket", tilt=("y", 5), below=0.1)
    hang(salon, f"{name}/Hook_rail", Asset("apron_rail", furniture.hook_rail(0.8, 4)), "back west", 3.1, 1.75, 0.004)
    for number, i in enumerate((0, 1, 3), 1):
        along = 3.1 + (-0.3, -0.1, 0.1, 0.3)[i]
        plan = at_wall("back west", along, 0.053)
        if number < 3:
            salon.put(f"{name}/Apron_{number}", APRON, (*plan, 1.7355), 90 + 3 * number)
        else:
            salon.put(f"{name}/Dustpan", Asset("dustpan", things.dustpan()), (*plan, 1.727), 90)
    board = merge(
        box(-0.15, 0.15, -0.015, 0, -0.06, 0.06),
        *(bent([(x, -0.01, -0.02), (x, -0.03, -0.02), (x, -0.034, -0.012)], 0.002) for x in (-0.09, -0.03, 0.03, 0.09)),
    )
    hang(salon, f"{name}/Key_board", Asset("key_board", board), "back west", 0.9, 1.6)
    for number, dy in enumerate((-0.09, 0.03, 0.09), 1):
        salon.put(f"{name}/Key_{number}", KEY, (*at_wall("back west", 0.9 + dy, 0.027), 1.5775), 90)
    hang(
        salon,
        f"{name}/First_aid/Cabinet",
        Asset("first_aid_cabinet", move(_upright(hollow_box(0.3, 0.4, 0.12, 0.012)), y=0)),
        "back north",
        6.32,
        1.5,
        0.0,
    )
    salon.put(
        f"{name}/First_aid/Door", Asset("first_aid_door", furniture.door_leaf(0.3, 0.4, 0.012)), (6.17, 3.68, 1.5)
    )
    salon.rest(
        f"{name}/Plasters",
        Asset("plasters", cuboid(0.08, 0.04, 0.1)),
        (6.27, 3.74),
        f"{name}/First_aid/Cabinet",
        below=1.53,
    )
    salon.rest(
        f"{name}/Medicine",
        salon.model("Scopia/medicoscopia_bottle"),
        (6.38, 3.74),
        f"{name}/First_aid/Cabinet",
        below=1.53,
    )
    hang(salon, f"{name}/Boiler", salon.model("Scopia/electric_water_heater"), "back north", 8.9, 1.85, 0.002)
    pipe = [(0, 0, 0.02), (0, 0, -0.3), (0, 0.05, -0.35), (0, 0.16, -0.36)]
    salon.put(
        f"{name}/Boiler_pipe", Asset("boiler_pipe", bent([(a, b, c) for a, b, c in pipe], 0.012)), (8.9, 3.62, 1.85)
    )
    salon.rest(f"{name}/Bin", Asset("bin", vessel(0.15, 0.18, 0.5, 0.004)), (6.35, 0.9), "Building/Floor")
    bin_z = float(salon.objects[f"{name}/Bin"].matrix[2, 3])
    salon.put(f"{name}/Bin_bag", Asset("bin_bag", things.bin_liner(0.17, 0.51)), (6.35, 0.9, bin_z + 0.004))
    salon.rest(
        f"{name}/Carton_in_bin",
        salon.model("BlendSwap-CC-0/tetrapak"),
        (6.34, 0.88),
        f"{name}/Bin_bag",
        yaw=30,
        below=bin_z + 0.2,
    )
    hang(salon, f"{name}/Switch", salon.model("Scopia/square-double-switch"), "back north", 7.42, 1.1, 0.001)
    salon.put(f"{name}/Ceiling_lamp", salon.model("KatorLegaz/fluorescent"), (7.7, 1.9, 2.8 - 0.106))


def _upright(shape: Shape) -> Shape:
    """Return an open box turned with its opening to the front and its lower edge at z = 0."""
    turned = turn(shape, "x", 90)
    low, back = turned.points[:, 2].min(), turned.points[:, 1].max()
    return move(turned, y=-back, z=-low)


def _lean(salon: Salon, path: str, asset: Asset, x: float, tilt: float) -> None:
    """Lean a thing at the north wall of the back room."""
    leaning = turn(asset.shape, "x", tilt).points
    salon.put(path, asset, (x, 3.8 - float(leaning[:, 1].max()), -float(leaning[:, 2].min())), 0, ("x", tilt))


def _build_break_table(salon: Salon) -> None:
    name = "Back/Table"
    salon.rest(
        f"{name}/Table",
        Asset(
            "break_table",
            merge(
                cuboid(0.8, 0.7, 0.03, 0.72),
                *(move(cuboid(0.05, 0.05, 0.72), x, y) for x in (-0.35, 0.35) for y in (-0.3, 0.3)),
            ),
        ),
        (7.4, 1.75),
        "Building/Floor",
        yaw=4,
    )
    salon.rest(f"{name}/Chair_1", salon.model("BlendSwap-CC-BY/chair3"), (6.85, 1.75), "Building/Floor", yaw=95)
    salon.rest(f"{name}/Chair_2", salon.model("BlendSwap-CC-BY/chair3"), (7.45, 2.35), "Building/Floor", yaw=-8)
    table = f"{name}/Table"
    salon.rest(f"{name}/Tablecloth", Asset("tablecloth", cuboid(0.5, 0.5, 0.003)), (7.4, 1.75), table, yaw=48)
    salon.rest(
        f"{name}/Fruit_bowl", Asset("fruit_bowl", vessel(0.06, 0.14, 0.09, 0.004)), (7.42, 1.76), f"{name}/Tablecloth"
    )
    apple = Asset("apple", squash(ball(0.037), z=0.92))
    for number, (dx, dy) in enumerate(((0.035, 0.0), (-0.03, 0.03), (-0.025, -0.035)), 1):
        salon.rest(f"{name}/Apple_{number}", apple, (7.42 + dx, 1.76 + dy), f"{name}/Fruit_bowl")
    salon.rest(f"{name}/Apple_4", apple, (7.416, 1.758), [f"{name}/Apple_{i}" for i in (1, 2, 3)])
    salon.rest(f"{name}/Plate", PLATE, (7.2, 1.9), table)
    salon.rest(f"{name}/Hamburger", salon.model("BlendSwap-CC-BY/hamburger"), (7.2, 1.9), f"{name}/Plate")
    salon.rest(f"{name}/Knife", salon.model("BlendSwap-CC-BY/knife"), (7.06, 1.88), table, yaw=10)
    salon.rest(f"{name}/Glass", salon.model("KatorLegaz/highball-glass"), (7.25, 1.55), table)
    salon.rest(
        f"{name}/Newspaper", salon.model("KatorLegaz/newspaper"), (7.65, 1.62), [table, f"{name}/Tablecloth"], yaw=40
    )
    salon.rest(f"{name}/Glasses", salon.model("Scopia/glasses"), (7.65, 1.62), f"{name}/Newspaper", yaw=110)
    salon.rest(f"{name}/Cap", salon.model("Scopia/casquette"), (7.45, 2.33), f"{name}/Chair_2", yaw=60, below=0.6)
    salon.rest(
        f"{name}/Shopping_bag", Asset("cloth_bag", things.bag(0.26, 0.1, 0.28)), (7.35, 1.75), "Building/Floor", yaw=30
    )
    salon.rest(f"{name}/Water_bottle", SHAMPOO, (7.32, 1.735), f"{name}/Shopping_bag", below=0.1)
    salon.rest(
        f"{name}/Banana_box",
        Asset("lunch_box", cuboid(0.1, 0.05, 0.12)),
        (7.41, 1.78),
        f"{name}/Shopping_bag",
        yaw=30,
        below=0.1,
    )
