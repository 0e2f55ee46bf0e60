"""The house: floor, walls with openings, doors, windows, lamps and what is fixed to the walls of the hall."""

import math
from collections.abc import Sequence

from benchmarks.scenes.pottery.shapes import Mesh, box, lathe, merge, moved, ring, rod, tube, turned
from benchmarks.scenes.pottery.stage import Group, Part, Pottery, shape
from benchmarks.scenes.pottery.things import (
    BLACK,
    BLUE,
    CREAM,
    GLASS,
    GREEN,
    GREY,
    RED,
    STEEL,
    WHITE,
    WOOD,
    cord_lamp,
    door,
    door_handle,
    hook,
    outlet,
    plant,
    polyline,
    slab,
    vase,
    wavy,
)

__all__ = ["build_house"]

_HEIGHT = 280.0

Opening = tuple[float, float, float, float]


def _wall(length: float, thickness: float, openings: Sequence[Opening] = ()) -> Mesh:
    """Return a wall from x = 0 on, its face on y = 0, its back at +y, with openings x from, x to, z from, z to."""
    parts, start = [], 0.0
    for left, right, low, high in sorted(openings):
        parts.append((start, left, 0.0, _HEIGHT))
        parts += [(left, right, a, b) for a, b in ((0.0, low), (high, _HEIGHT)) if b > a]
        start = right
    parts.append((start, length, 0.0, _HEIGHT))
    return merge(*(box(b - a, thickness, d - c, (a + b) / 2, thickness / 2, c) for a, b, c, d in parts))


def build_house(pottery: Pottery) -> None:
    """Add the house."""
    house = pottery.group(pottery.root, "House")
    _build_walls(pottery, house)
    _build_doors(pottery, pottery.group(house, "Doors"))
    _build_windows(pottery, pottery.group(house, "Windows"))
    _build_ceiling_things(pottery, pottery.group(house, "Under_ceiling", (0, 0, _HEIGHT)))
    _build_wall_things(pottery, house)


def _build_walls(pottery: Pottery, house: Group) -> None:
    plan = [(1140, 640, 550, 300), (732, 362, 346, -201)]
    pottery.fix(house, "Floor", shape(merge(*(box(a, b, 10, c, d, -10) for a, b, c, d in plan)), GREY), (0, 0, 0))
    pottery.fix(house, "Ceiling", shape(merge(*(box(a, b, 12, c, d) for a, b, c, d in plan)), WHITE), (0, 0, _HEIGHT))
    walls: list[tuple[str, float, float, Sequence[Opening], tuple[float, float, float], float]] = [
        ("Wall_north", 1140, 20, [(120, 320, 95, 215)], (-20, 600, 0), 0),
        ("Wall_west", 962, 20, [(362 + 270, 362 + 420, 95, 215)], (0, -362, 0), 90),
        ("Wall_south", 732, 20, [(342, 512, 80, 220), (562, 652, 0, 205)], (712, -362, 0), 180),
        ("Wall_east", 620, 20, [(380, 500, 110, 210)], (1100, 600, 0), -90),
        ("Wall_glaze_south", 388, 20, [], (1100, 0, 0), 180),
        ("Wall_hall_east", 962, 12, [(110, 200, 0, 205), (380, 480, 0, 210)], (700, 600, 0), -90),
        ("Wall_kiln_room", 388, 12, [], (712, 340, 0), 0),
        ("Wall_shop_north", 400, 12, [(250, 340, 0, 210)], (0, -12, 0), 0),
        ("Wall_shop_east", 350, 12, [], (400, -12, 0), -90),
    ]
    for name, length, thickness, openings, at, turn in walls:
        pottery.fix(house, name, shape(_wall(length, thickness, openings), CREAM), at, turn)


def _frame(width: float, height: float, depth: float) -> Mesh:
    """Return the frame of a door, 4 wide, inside width and height, centred."""
    posts = [box(4, depth, height, side * (width / 2 - 2)) for side in (-1, 1)]
    return merge(*posts, box(width - 8, depth, 4, 0, 0, height - 4))


def _build_doors(pottery: Pottery, doors: Group) -> None:
    entrance = pottery.group(doors, "Entrance", (105, -372, 0))
    pottery.fix(entrance, "Entrance_frame", shape(_frame(90, 205, 18), WOOD), (0, 0, 0))
    pottery.fix(entrance, "Entrance_door", door(81, 199.5, 4, BLUE), (-40.5, 2, 0.8))
    pottery.fix(entrance, "Entrance_handle_outside", door_handle(), (36, -2.1, 102))
    pottery.fix(entrance, "Entrance_handle_inside", door_handle(), (36, 2.1, 102), rot=(180, 0, 0))
    sign = merge(box(22, 0.6, 12, 0, 0, -20), tube([(-9, 0, -8), (0, 0, 0.2), (9, 0, -8)], 0.15, 6))
    pottery.fix(
        entrance,
        "Suction_hook",
        shape(merge(rod(2, 0.8, "y"), tube([(0, 0.8, 0), (0, 2.2, 0), (0, 2.4, 1)], 0.25)), GLASS),
        (-6, 2.1, 160),
    )
    pottery.fix(entrance, "Open_sign", shape(sign, RED), (-6, 3.7, 160.3))
    kiln = pottery.group(doors, "Kiln_room", (706, 445, 0), -90)
    pottery.fix(kiln, "Kiln_room_frame", shape(_frame(90, 205, 12), GREY), (0, 0, 0))
    leaf = pottery.group(kiln, "Leaf", (-40.5, 6, 0), 98)
    pottery.fix(leaf, "Kiln_room_door", door(80, 199, 4, STEEL), (0, 0, 1))
    pottery.fix(leaf, "Kiln_room_handle", door_handle(), (75, -4, 102))
    passage = pottery.group(doors, "Passage", (295, -12, 0), 0)
    ends = [box(2, 8, 5, side * 56, -4, -2.5) for side in (-1, 1)]
    pottery.wall(passage, "Curtain_rod", shape(merge(rod(1.1, 116, "x", -58, -7, 0), *ends), BLACK), (0, 0, 222))
    for name, x in (("Passage_curtain_left", -45), ("Passage_curtain_right", 43)):
        rings = [
            tube([(a, 1.9 * math.cos(t), 1.9 * math.sin(t)) for t in [i * math.pi / 5 for i in range(11)]], 0.2, 6)
            for a in (-8, 0, 8)
        ]
        cloth = moved(wavy(20, 212, 3, 2.2), 0, 0, -2)
        pottery.fix(passage, name, shape(cloth, GREEN, Part(merge(*rings), BLACK)), (x, -7, 221.4))


def _build_windows(pottery: Pottery, windows: Group) -> None:
    north = pottery.group(windows, "North", (200, 600, 95))
    west = pottery.group(windows, "West", (0, 345, 95), 90)
    shop = pottery.group(windows, "Shop", (285, -362, 80), 180)
    glaze = pottery.group(windows, "Glaze", (1100, 160, 110), -90)
    for group, name, width, height in (
        (north, "North_window", 200, 120),
        (west, "West_window", 150, 120),
        (shop, "Shop_window", 170, 140),
        (glaze, "Glaze_window", 120, 100),
    ):
        bars = [box(5, 6, height, a * (width / 2 - 2.5), 12) for a in (-1, 1)]
        bars += [box(width - 10, 6, 5, 0, 12, z) for z in (0, height - 5)] + [box(4, 6, height - 10, 0, 12, 5)]
        pane = box(width - 10, 1, height - 10, 0, 12, 5)
        pottery.fix(group, name, shape(merge(*bars), WHITE, Part(pane, GLASS, 0.3)), (0, 0, 0))
    sill = [("North_sill", north, 198), ("West_sill", west, 148)]
    for name, group, width in sill:
        pottery.fix(group, name, slab(width, 24, 3, WHITE), (0, -3, 0.1))
    pottery.put(north, "Sill_vase", vase(6, 18, CREAM), (-60, -4, 3.1))
    pottery.put(
        west,
        "Cactus_pot",
        shape(lathe([(0, 0), (5, 0), (7, 10), (6.4, 10), (6.2, 8.5), (0, 8.5)]), (0.7, 0.4, 0.25)),
        (30, -4, 3.1),
    )
    pottery.fix(west, "Cactus", shape(lathe([(0, 0), (3, 0), (4.2, 5), (3.5, 12), (0, 14)], 9), GREEN), (30, -4, 11.4))
    roller = merge(rod(2.5, 122, "x", -61, -4, 0), *(box(1, 6, 6, side * 61.5, -3, -3) for side in (-1, 1)))
    cloth = merge(box(116, 0.2, 45, 0, -6.4, -45), box(117, 1, 1.5, 0, -6.4, -46))
    pottery.wall(glaze, "Roller_blind", shape(roller, GREY, Part(cloth, CREAM)), (0, 0, 106))
    fins = merge(
        *(box(6, 9, 55, 7 * i - 59.5, -6.5) for i in range(18)),
        rod(1.6, 124, "x", -62, -6.5, 53),
        rod(1.6, 124, "x", -62, -6.5, 2),
    )
    feet = merge(*(box(3, 3, 4, side * 45, -1.5, z) for side in (-1, 1) for z in (8, 44)))
    pottery.fix(west, "Radiator", shape(merge(fins, feet), WHITE), (0, -0.1, -80))


def _build_ceiling_things(pottery: Pottery, under: Group) -> None:
    for number, (x, y) in enumerate(((110, 190), (430, 220)), 1):
        pottery.fix(under, f"Pendant_lamp_{number}", cord_lamp(70, GREEN), (x, y, 0.1 * number - 0.2))
    blades = [turned(moved(box(52, 12, 0.8), 38, 0, 0), 8, 0, a) for a in (0, 90, 180, 270)]
    mount = merge(rod(7, 5, z=-5), rod(1.5, 22, z=-27), lathe([(0, -40), (9, -38), (11, -32), (9, -27), (0, -27)]))
    pottery.fix(under, "Ceiling_fan", shape(mount, STEEL, Part(moved(merge(*blades), 0, 0, -33), WOOD)), (480, 420, 0))
    chain = tube([(0, 0, 0), (0.2, 0, -20), (0, 0.1, -44)], 0.15, 6)
    pottery.fix(
        under,
        "Fan_chain",
        shape(merge(chain, moved(lathe([(0, -2), (0.8, -1), (0.6, 0), (0, 0.2)]), 0, 0.1, -44)), STEEL),
        (486, 422, -38.4),
    )
    for number, (x, y, turn) in enumerate(((560, -180, 0), (906, 170, 0)), 1):
        tube_light = merge(box(120, 10, 4, 0, 0, -4), moved(turned(rod(1.6, 112, n=10), 0, 90), -56, 0, -6.5))
        pottery.fix(under, f"Tube_light_{number}", shape(tube_light, WHITE, asset="tube_light"), (x, y, -0.2), turn)


def _build_wall_things(pottery: Pottery, house: Group) -> None:
    north = pottery.group(house, "North_wall_things", (0, 600, 0))
    face = merge(turned(rod(15, 3, n=32), 90), moved(turned(ring(14, 16, 4, 32), 90), 0, 0, 0))
    hands = merge(box(0.8, 0.2, 9, 0, -3.2, -1), box(7, 0.2, 0.8, 3, -3.2, -0.4))
    pottery.wall(north, "Wall_clock", shape(face, WHITE, Part(hands, BLACK)), (372, 0, 205))
    extinguisher = pottery.group(north, "Extinguisher", (585, 0, 0))
    clamp = merge(
        box(6, 0.5, 30, 0, -0.25, 85), moved(turned(ring(8.1, 8.6, 3), 0), 0, -9, 100), box(5, 1.2, 1, 0, -0.6, 84)
    )
    pottery.wall(extinguisher, "Extinguisher_bracket", shape(clamp, BLACK), (0, 0, 0))
    body = lathe([(0, 80), (7.6, 80), (8, 84), (8, 118), (4, 124), (2.5, 125), (2.5, 128), (0, 128)])
    fittings = merge(box(3, 12, 2, 0, -3, 128), tube([(3, 0, 126), (8, -2, 124), (9.5, -2, 115), (9.3, -2, 95)], 0.9))
    pottery.fix(extinguisher, "Extinguisher", shape(body, RED, Part(fittings, BLACK)), (0, -9, 0.1))
    west = pottery.group(house, "West_wall_things", (0, 0, 0), 90)
    pottery.wall(west, "Hall_outlet", outlet(), (170, 0, 30))
    east = pottery.group(house, "East_wall_things", (700, 0, 0), -90)
    rails = [box(3, 6, 250, side * 19) for side in (-1, 1)] + [
        rod(1.4, 38, "x", -19, 0, z, 8) for z in range(25, 245, 28)
    ]
    lean = math.degrees(math.atan2(55, 250))
    pottery.fix(east, "Ladder", shape(merge(*rails), WOOD), (-50, -56.9, 0.6), rot=(-lean, 0, 0.5))
    pottery.wall(east, "Broom_hook", hook(), (-95, 0, 140))
    bristles = box(34, 6, 9, 0, 0, -129)
    eye = moved(turned(ring(0.7, 1.2, 0.5, 14), 90), 0, 0.25, -0.4)
    broom = merge(rod(1.2, 120, z=-121.4), box(36, 5, 3, 0, 0, -121), eye)
    pottery.fix(east, "Broom", shape(broom, WOOD, Part(bristles, BLACK)), (-95, -3, 139.9))
    plants = pottery.group(house, "Corner_plant", (40, 560, 0), 15)
    pottery.put(
        plants, "Plant_tub", shape(lathe([(0, 0), (14, 0), (19, 34), (18, 34), (13.5, 4), (0, 4)]), BLUE), (0, 0, 0)
    )
    pottery.put(
        plants, "Potting_soil", shape(lathe([(0, 0), (13.2, 0), (16.4, 24), (0, 25.5)]), (0.2, 0.14, 0.1)), (0, 0, 4.1)
    )
    pottery.fix(plants, "Rubber_plant", plant(38, 95, 14), (0, 0, 29.4))
    pottery.put(house, "Door_mat", slab(75, 45, 1.2, BLACK), (105, -325, 0), 1)
    cable = [(0, -3, 0), (0, -5, -4), (4, -6, -24), (20, -9, -29.5), (60, -20, -29.6), (105, -30, -28.6)]
    pottery.fix(
        west,
        "Lead_plug",
        shape(merge(turned(rod(1.9, 4.5), 90), rod(0.24, 1.6, "y", 0.95), rod(0.24, 1.6, "y", -0.95)), BLACK),
        (170, -0.9, 30),
    )
    pottery.fix(west, "Extension_lead", polyline(cable, 0.4, BLACK), (170, -2, 30))
    pottery.put(
        west,
        "Power_strip",
        shape(merge(box(32, 5, 4), *(moved(ring(1.6, 2, 0.2), x, 0, 4) for x in (-11, -4, 3, 10))), WHITE),
        (291, -32, 0),
    )
