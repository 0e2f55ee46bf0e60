"""The glaze kitchen: a counter with drawers, buckets of glaze, a rack of materials, a spray booth and a table."""

import math

from benchmarks.scenes.pottery.shapes import (
    Mesh,
    bag,
    box,
    carcass,
    heap,
    lathe,
    merge,
    moved,
    open_bag,
    ribbon,
    ring,
    rod,
    tray,
    tube,
    turned,
    vessel,
)
from benchmarks.scenes.pottery.stage import Group, Part, Pottery, Shape, shape
from benchmarks.scenes.pottery.things import (
    BLACK,
    BLUE,
    BRICK,
    BROWN,
    CELADON,
    CREAM,
    GLASS,
    GREEN,
    GREY,
    RED,
    STEEL,
    WHITE,
    WOOD,
    apron,
    bowl,
    brush,
    bucket,
    bucket_lid,
    hook,
    jar,
    jar_lid,
    leaning,
    panel,
    polyline,
    slab,
    table,
    vase,
)

__all__ = ["build_glaze_kitchen"]


def build_glaze_kitchen(pottery: Pottery) -> None:
    """Add the glaze kitchen."""
    room = pottery.group(pottery.root, "Glaze_kitchen")
    counter = pottery.group(room, "Counter", (950, 0, 0), 180)
    _build_counter(pottery, counter)
    _build_worktop(pottery, counter)
    _build_above(pottery, pottery.group(room, "Above_counter", (950, 0, 150), 180))
    _build_buckets(pottery, pottery.group(room, "Glaze_bench", (1100, 165, 0), -90))
    _build_rack(pottery, pottery.group(room, "Material_rack", (1010, 340, 0)))
    _build_booth(pottery, pottery.group(room, "Spray_booth", (805, 340, 0)))
    _build_hooks(pottery, pottery.group(room, "Hooks", (712, 60, 165), 90))


def _bar_handle(length: float) -> Mesh:
    """Return a bar in front of y = 0, along x."""
    feet = [rod(0.5, 2.6, "-y", side * length * 0.4) for side in (-1, 1)]
    return merge(rod(0.6, length, "x", -length / 2, -3, 0), *feet)


def _build_counter(pottery: Pottery, group: Group) -> None:
    for number, boards in ((1, (46,)), (2, ()), (3, (46,))):
        base = shape(carcass(80, 58, 82, boards, plinth=8), WHITE, asset="base_cabinet_shelf" if boards else None)
        pottery.put(group, f"Base_cabinet_{number}", base, (-80.5 + 80.2 * (number - 1), -0.2, 0))
    pottery.put(group, "Worktop", slab(244, 62, 4, WOOD), (0, -31, 82.1))
    for name, x, turn, side in (("left", -120.2, 0, 1), ("right", -40.9, 0, -1)):
        leaf = moved(box(39.3, 1.8, 73, 19.65, -0.9), 0 if side > 0 else -39.3)
        pottery.fix(group, f"Base_door_{name}", shape(leaf, CELADON), (x, -58.5, 8.4), turn)
        pottery.fix(
            group,
            f"Base_knob_{name}",
            shape(merge(rod(0.8, 2, "-y"), rod(1.6, 1.2, "-y", 0, -2)), BLACK, asset="knob"),
            (x + side * 35, -60.3, 62),
        )
    pottery.put(group, "Silica_sack", shape(bag(30, 24, 30), CREAM), (-98, -26, 9.8), 4)
    drawer = merge(box(79, 1.8, 22.6, 0, 0.9, -3), moved(tray(74, 52, 14, 1), 0, 27.8))
    for number in range(3):
        at = (-0.3, -60.4 - (32 if number == 2 else 0), 13 + 23.5 * number)
        pottery.fix(group, f"Counter_drawer_{number + 1}", shape(drawer, CELADON, asset="counter_drawer"), at)
        pottery.fix(
            group,
            f"Drawer_handle_{number + 1}",
            shape(_bar_handle(20), STEEL, asset="bar_handle"),
            (at[0], at[1] + 0.1, at[2] + 9),
        )
    for number, (x, turn) in enumerate(((-24, 12),), 1):
        pottery.fix(group, f"Hake_brush_{number}", brush(21, BROWN), (x, -86, 61.5), rot=(90, 0, 180 + turn))
    pottery.put(group, "Rag_pile", shape(bag(40, 34, 9), CREAM), (-8, -30, 14))


def _build_worktop(pottery: Pottery, group: Group) -> None:
    top = 86.1
    scale = merge(box(22, 24, 5), rod(2, 1.5, z=5), rod(10, 0.8, z=6.5, n=24))
    pottery.put(group, "Balance", shape(scale, GREY), (-95, -30, top), 8)
    pottery.put(group, "Weighing_bowl", bowl(10, 7, STEEL), (-95, -30, top + 7.3))
    pottery.put(group, "Iron_oxide", shape(heap(3.9, 2), RED), (-95, -30, top + 8.4))
    pottery.put(group, "Mortar", shape(vessel([(6, 0), (6, 2), (8, 9)], 1.4, 2.5), WHITE), (-66, -24, top))
    at, rot = leaning((-66, -24, top), 6.4, 2.6, 9, 200, 1.0)
    pestle = lathe([(0, 0), (1.2, 0.1), (1.4, 1), (0.8, 5), (0.9, 15), (0, 15.5)], 12)
    pottery.fix(group, "Pestle", shape(pestle, WHITE), at, rot=rot)
    pottery.put(group, "Brush_jar", jar(5, 14, CELADON), (-38, -18, top))
    for number, azimuth in enumerate((30, 200), 1):
        at, rot = leaning((-38, -18, top), 4.6, 0.6, 14, azimuth, 0.45)
        pottery.fix(group, f"Glaze_brush_{number}", brush(20 + number, WOOD), at, rot=rot)
    pottery.put(
        group,
        "Roll_holder",
        shape(merge(rod(7, 1.2, n=24), rod(1, 30, z=1.2), lathe([(0, 31), (1.8, 31), (1.8, 32.5), (0, 33)])), STEEL),
        (-8, -20, top),
    )
    pottery.put(group, "Paper_roll", shape(ring(2, 6.2, 25), WHITE), (-7.2, -20, top + 1.2))
    pages = [box(17, 24, 1.2, side * 8.6) for side in (-1, 1)]
    pottery.put(group, "Recipe_book", shape(merge(*pages, box(1, 24, 0.3)), CREAM), (28, -34, top), 6)
    pottery.put(
        group,
        "Measuring_jug",
        shape(
            merge(
                vessel([(6, 0), (7.5, 18)], 0.4, 0.6), tube([(7, 0, 15), (11, 0, 14), (10.5, 0, 7), (6.5, 0, 5)], 0.6)
            ),
            GLASS,
            opacity=0.5,
        ),
        (62, -26, top),
    )
    strainer = merge(
        lathe([(0, -4), (4, -3), (6.3, 0), (8.2, 0), (8.2, 0.5), (6.1, 0.5), (3.8, -2.7), (0, -3.7)]),
        tube([(8, 0, 0.25), (20, 0, 1)], 0.5),
    )
    pottery.put(group, "Strainer", shape(strainer, STEEL), (62, -26, top + 18), -60)
    for number, (x, y) in enumerate(((88, -20), (98, -38)), 1):
        pottery.put(group, f"Glaze_pot_{number}", jar(5.5, 11, WHITE), (x, y, top), 30 * number)
        if number < 2:
            pottery.put(group, f"Glaze_pot_lid_{number}", jar_lid(5.5, RED), (x, y, top + 11))
    pottery.put(group, "Glaze_liquid", shape(rod(5, 6, n=24), CELADON), (98, -38, top + 0.7))


def _build_above(pottery: Pottery, group: Group) -> None:
    pottery.wall(group, "Wall_cupboard", shape(carcass(90, 32, 64, (33,)), WHITE), (-70, 0, 0))
    for name, x, turn, side in (("left", -114.8, 0, 1), ("right", -25.2, 112, -1)):
        leaf = pottery.group(group, f"Upper_leaf_{name}", (x, -32.5, 0.3), turn)
        mesh = moved(box(44, 1.8, 63, 22, -0.9), 0 if side > 0 else -44)
        pottery.fix(leaf, f"Upper_door_{name}", shape(mesh, CELADON), (0, 0, 0))
        pottery.fix(
            leaf,
            f"Upper_knob_{name}",
            shape(merge(rod(0.8, 2, "-y"), rod(1.6, 1.2, "-y", 0, -2)), BLACK, asset="knob"),
            (side * 40, -1.8, 8),
        )
    for number, (x, z, color) in enumerate(((-100, 1.8, BLUE), (-50, 1.8, GREEN), (-44, 33, RED)), 1):
        pottery.put(group, f"Oxide_jar_{number}", jar(5, 13, GLASS), (x, -16, z), 10 * number)
        pottery.put(group, f"Oxide_{number}", shape(rod(4.5, 3 + number, n=20), color), (x, -16, z + 0.7))
        if number != 2:
            pottery.put(group, f"Oxide_lid_{number}", jar_lid(5, BLACK), (x, -16, z + 13))
    pottery.wall(group, "Tile_board", panel(70, 44, 1.5, WOOD), (60, 0, 32))
    for number in range(4):
        x, z = 44 + 30 * (number % 2), 46 - 22 * (number // 2)
        pottery.fix(
            group,
            f"Nail_{number + 1}",
            shape(merge(rod(0.2, 4, "-y"), rod(0.45, 0.2, "-y", 0, -4)), STEEL, asset="nail"),
            (x, -0.8, z),
        )
        if number == 2:
            continue
        eye = moved(turned(ring(0.5, 1.2, 0.6, 12), 90), 0, 0.3, -0.3)
        tile = merge(eye, box(6, 0.6, 11, 0, 0, -12.3))
        pottery.fix(
            group,
            f"Test_tile_{number + 1}",
            shape(tile, (CELADON, BLUE, BROWN, GREEN, RED, CREAM)[number]),
            (x, -2.6, z),
            0,
        )


def _label() -> Shape:
    """Return a label around the front of a bucket, 14 above its bottom."""
    arc = [(13.78 * math.sin(a), -13.78 * math.cos(a)) for a in [0.06 * i for i in range(-6, 7)]]
    mesh = ribbon(arc, 0.1, 6)
    mesh.points[:, :2] *= 1 + 0.0862 * mesh.points[:, 2:] / 13.7
    return shape(mesh, CREAM)


def _build_buckets(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Low_bench", table(190, 44, 42, WOOD, top=3), (0, -26, 0))
    for number, (x, color) in enumerate(((-74, BLUE), (-38, WHITE), (0, WHITE), (40, BLUE)), 1):
        pottery.put(group, f"Glaze_bucket_{number}", bucket(color), (x, -26, 42), 20 * number)
        if number in (1, 2):
            pottery.put(group, f"Glaze_bucket_lid_{number}", bucket_lid(color), (x, -26, 72))
        if number < 4:
            pottery.fix(group, f"Bucket_label_{number}", _label(), (x, -26, 56))
    pottery.put(
        group, "Celadon_glaze", shape(lathe([(0, 0), (12.2, 0), (13.4, 17), (0, 17)], 32), CELADON), (0, -26, 42.5)
    )
    pottery.put(
        group, "Tenmoku_glaze", shape(lathe([(0, 0), (12.2, 0), (13.2, 14), (0, 14)], 32), BROWN), (40, -26, 42.5)
    )
    whisk = merge(
        rod(0.9, 14, z=20),
        *(
            turned(
                tube([(0, 0, 20), (3, 0, 12), (3, 0, 5), (0, 0, 1), (-3, 0, 5), (-3, 0, 12), (0, 0, 20)], 0.15, 6),
                0,
                0,
                a,
            )
            for a in (0, 60, 120)
        ),
    )
    at, rot = leaning((0, -26, 42), 13.5, 0.5, 30, 100, 1)
    pottery.fix(group, "Whisk", shape(whisk, STEEL), at, rot=rot)
    bend = [(17, 1.6, -6), (16.2, 1, -0.5), (15.7, 0.8, 0.5), (15, 0.7, 0.5), (13.9, 0.7, -1), (11.2, 1.4, -18)]
    arms = [tube([(x, side * y, z) for x, y, z in bend], 0.3) for side in (-1, 1)]
    tongs = merge(*arms, tube([(17, -1.6, -6), (17.2, 0, -7), (17, 1.6, -6)], 0.3))
    pottery.fix(group, "Dipping_tongs", shape(tongs, STEEL), (40, -26, 72), -35)
    pottery.fix(group, "Leaning_lid", bucket_lid(BLUE), (-89, -49.9, 15.9), rot=(78, 0, 0))


def _build_rack(pottery: Pottery, group: Group) -> None:
    posts = [box(3, 3, 175, a * 58.5, y) for a in (-1, 1) for y in (-1.5, -43.5)]
    boards = [box(120, 45, 2, 0, -22.5, z - 2) for z in (14, 64, 114, 164)]
    pottery.put(group, "Rack", shape(merge(*posts, *boards), STEEL), (0, -0.3, 0))
    for number, (x, turn) in enumerate(((-32, 3), (22, -6)), 1):
        pottery.put(
            group, f"Feldspar_bag_{number}", shape(bag(44, 34, 14), CREAM, asset="feldspar_bag"), (x, -22, 14), turn
        )
    pottery.put(group, "Open_sack", shape(open_bag(30, 24, 32, 0.3), CREAM), (-36, -22, 64), 5)
    pottery.put(group, "Whiting", shape(bag(26, 20, 16), WHITE), (-36, -22, 64.4), 5)
    scoop = merge(turned(vessel([(3.4, 0), (3.4, 9)], 0.3, 0.5), 0, 0), rod(0.9, 9, z=-9))
    pottery.fix(group, "Scoop", shape(scoop, STEEL), (-33, -22, 84.5), rot=(-118, 0, 30))
    pottery.put(group, "Tile_box", shape(tray(34, 12, 8, 0.5), WOOD), (16, -24, 64), -3)
    for number in range(3):
        pottery.put(
            group,
            f"Standing_tile_{number + 1}",
            slab(0.7, 6, 11, (BLUE, BROWN, CELADON, RED)[number]),
            (5 + 6.5 * number, -24.5, 64.5),
            -3,
        )
    for number, x in enumerate((-46, -26), 1):
        pottery.put(group, f"Powder_tub_{number}", jar(7.5, 18, WHITE), (x, -20, 114), 20 * number)
        if number != 2:
            pottery.put(group, f"Powder_tub_lid_{number}", jar_lid(7.5, BLUE), (x, -20, 132))


def _build_booth(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Booth_stand", table(86, 64, 78, STEEL, 20), (0, -34, 0))
    pottery.put(group, "Booth", shape(carcass(80, 60, 72), WHITE), (0, -3, 78))
    turntable = merge(rod(8, 1, n=24), rod(1.5, 5, z=1), rod(13, 1.2, z=6, n=24))
    pottery.put(group, "Turntable", shape(turntable, STEEL), (2, -34, 79.8))
    pottery.put(group, "Vase_to_spray", vase(9, 30, BRICK, 0.45), (2.5, -34, 87))
    duct = moved(
        merge(ring(8.5, 9, 0.4), lathe([(8.5, 0), (9, 0), (9, 130.2), (8.5, 130.2)], closed=True)), 0, -30, 150
    )
    pottery.fix(group, "Exhaust_duct", shape(duct, GREY), (0, 0, 0))
    pottery.fix(group, "Gun_hook", hook(), (40.2, -40, 120), 90)
    gun = merge(
        rod(1.2, 14, "y", 0, -7, -4),
        rod(1.1, 9, "z", 0, 3, -13),
        rod(2.2, 7, "z", 0, -3, -3),
        moved(turned(ring(0.6, 1.1, 0.6, 12), 0, 90), -0.3, 0, -0.4),
        box(1, 2, 3, 0, 0, -4),
    )
    pottery.fix(group, "Spray_gun", shape(gun, STEEL), (43.2, -40, 120.1))
    pottery.fix(
        group,
        "Air_hose",
        polyline(
            [
                (43.2, -37, 107.1),
                (43.6, -38, 96),
                (50, -46, 60),
                (52, -46, 42),
                (46, -37, 35),
                (36, -32, 34),
                (33.7, -32, 34),
            ],
            0.7,
            RED,
        ),
        (0, 0, 0),
    )
    tank = merge(
        turned(moved(lathe([(0, -24), (8, -23), (10, -20), (10, 20), (8, 23), (0, 24)]), 0, 0, 0), 0, 90),
        box(14, 12, 14, -8, 0, 9),
        box(3, 16, 8, -16, 0, -14),
        box(3, 16, 8, 16, 0, -14),
    )
    pottery.put(group, "Compressor", shape(moved(tank, 0, 0, 14), RED), (10, -32, 20))


def _build_hooks(pottery: Pottery, group: Group) -> None:
    for number, x in enumerate((-30, -8, 14), 1):
        pottery.wall(group, f"Wall_hook_{number}", hook(), (x, 0, 0))
    pottery.fix(group, "Glaze_apron", apron(CREAM), (-30, -3, 0.35))
    respirator = merge(
        moved(bag(12, 9, 9), 0, -1.7, -20),
        tube([(-5, 0, -13), (-3, 0, -4), (-1, 0, 0), (0, 0, 0.3), (1, 0, 0), (3, 0, -4), (5, 0, -13)], 0.3),
    )
    pottery.fix(
        group,
        "Respirator",
        shape(respirator, GREY, Part(moved(turned(rod(3, 3), 90), -4, -5.5, -17), BLACK)),
        (-8, -3, 0.35),
    )
    dust = merge(
        box(5, 2.5, 14, 0, 0, -32),
        box(4, 3, 12, 0, -2, -31),
        rod(1, 16, z=-18),
        moved(turned(ring(0.7, 1.2, 0.6, 12), 90), 0, 0.3, -0.5),
    )
    pottery.fix(group, "Bench_brush", shape(dust, WOOD), (14, -3, 0))
