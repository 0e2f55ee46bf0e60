"""The hall: wheels, tables for handbuilding and wedging, clay on a pallet, aprons and a shelf of books."""

import math

from benchmarks.scenes.pottery.shapes import (
    bag,
    box,
    lathe,
    merge,
    moved,
    open_bag,
    ring,
    rod,
    tray,
    tube,
    turned,
    vessel,
)
from benchmarks.scenes.pottery.stage import Group, Pottery, Shape, shape
from benchmarks.scenes.pottery.things import (
    BLACK,
    BLUE,
    BRASS,
    BROWN,
    CLAY,
    CREAM,
    GLASS,
    GREEN,
    GREY,
    RED,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    apron,
    book,
    bowl,
    bracket,
    brush,
    bucket,
    bucket_lid,
    jar,
    leaning,
    mug,
    outlet,
    plant,
    polyline,
    slab,
    stick_tool,
    stool,
    table,
    vase,
)

__all__ = ["build_hall"]


def build_hall(pottery: Pottery) -> None:
    """Add the hall."""
    hall = pottery.group(pottery.root, "Hall")
    _build_wheels(pottery, hall)
    _build_handbuilding(pottery, pottery.group(hall, "Handbuilding", (430, 220, 0), 4))
    _build_wedging(pottery, pottery.group(hall, "Wedging", (480, 600, 0)))
    _build_books(pottery, pottery.group(hall, "Book_shelf", (0, 100, 150), 90))
    _build_pallet(pottery, pottery.group(hall, "Clay_store", (92, 52, 0), 3))
    _build_pegs(pottery, pottery.group(hall, "Pegs", (195, 0, 165), 180))


def _build_wheels(pottery: Pottery, hall: Group) -> None:
    body = merge(
        box(84, 58, 3, 0, 0, 49),
        box(60, 44, 17, 0, 0, 32),
        *(tube([(a * 36, b * 23, 0), (a * 34, b * 21, 49)], 1.8) for a in (-1, 1) for b in (-1, 1)),
        rod(2, 4.2, x=-14, z=51.9),
    )
    wheel = shape(body, BLUE, asset="wheel")
    profile = [(6, 0), (24, 0), (24, 10), (23.4, 10), (23.4, 0.6), (6.6, 0.6), (6.6, 2.5), (6, 2.5)]
    pan = shape(lathe(profile, 32, closed=True), WHITE, asset="splash_pan")
    head = shape(lathe([(0, 0), (2, 0), (16, 0.4), (16, 2), (0, 2)], 32), STEEL, asset="wheel_head")
    pedal = shape(merge(box(10, 24, 3), turned(box(9, 22, 1.2, 0, 0, 3.6), 6)), BLACK, asset="pedal")
    places = [((110, 190, 0), 84), ((262, 470, 0), -38)]
    for number, (at, turn) in enumerate(places, 1):
        group = pottery.group(hall, f"Wheel_{number}", at, turn)
        pottery.put(group, "Wheel", wheel, (0, 0, 0))
        pottery.fix(group, "Wheel_head", head, (-14, 0, 56))
        pottery.put(group, "Pedal", pedal, (31, -42, 0), -7)
        pottery.fix(
            group,
            "Pedal_cable",
            polyline([(31, -30.5, 1.5), (30, -25, 0.6), (24, -18, 2), (20, -10, 20), (18, -8, 33)], 0.4, BLACK),
            (0, 0, 0),
        )
        pottery.put(group, "Wheel_stool", stool(), (-12, -58, 0), 20 * number)
        pottery.put(
            group,
            "Splash_pan" if number < 2 else "Loose_splash_pan",
            pan,
            (-14, 0, 52) if number < 2 else (-11, -57, 48),
            5,
        )
    one, two = (pottery.root._replace(path=f"{hall.path}/Wheel_{number}") for number in (1, 2))
    bat = shape(merge(rod(15, 1.6, n=32)), WOOD, asset="bat")
    pottery.put(one, "Bat", bat, (-14, 0, 58))
    pottery.put(
        one, "Thrown_cylinder", shape(vessel([(6, 0), (5.6, 8), (6.3, 17), (6.8, 18)], 0.8, 1.2), CLAY), (-14, 0, 59.6)
    )
    pottery.put(one, "Water_bowl", shape(vessel([(6, 0), (9, 3), (10, 9)], 0.5, 0.6), WHITE), (26, 8, 52))
    pottery.put(one, "Throwing_sponge", shape(bag(7, 5, 3.5), YELLOW), (25.5, 8.5, 52.6), 30)
    pottery.fix(one, "Needle_tool", stick_tool(14, WOOD, "needle"), (21, -17, 52.5), rot=(0, 90, 25))
    pottery.put(two, "Dry_bat", bat, (-14, 0, 58))
    pottery.put(two, "Trimmed_bowl", shape(turned(bowl(9, 7, CLAY).parts[0].mesh, 180), CLAY), (-13, 1, 66.6))
    pottery.fix(
        two,
        "Clay_coil",
        shape(
            tube(
                [(-10 + 11.5 * math.cos(a), 1 + 11.5 * math.sin(a), 60.1) for a in [i / 3 for i in range(-3, 4)]], 0.6
            ),
            CLAY,
        ),
        (-3, 0, 0),
    )
    pottery.fix(two, "Trimming_tool", stick_tool(17, WOOD, "loop"), (19, -20, 52.5), rot=(90, 0, 130))


def _cutter(sides: int, radius: float) -> Shape:
    """Return a ring for cutting clay, 3 high."""
    return shape(lathe([(radius, 0), (radius + 0.15, 0), (radius + 0.15, 3), (radius, 3)], sides, closed=True), STEEL)


def _build_handbuilding(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Worktable", table(220, 100, 80, WOOD), (0, 0, 0))
    pottery.put(group, "Canvas", slab(90, 60, 0.3, CREAM), (-50, 0, 80), -2)
    pottery.put(group, "Clay_slab", shape(lathe([(0, 0), (20, 0), (20, 0.8), (0, 0.8)], 14), CLAY), (-58, -2, 80.3))
    for number, y in ((1, -25.0), (2, 22.0)):
        pottery.put(group, f"Guide_stick_{number}", slab(70, 3, 0.8, WOOD), (-52, y, 80.3), number)
    pin = merge(rod(3, 50, "y", 0, -25, 0, 20), rod(1.2, 10, "y", 0, -35, 0), rod(1.2, 10, "y", 0, 25, 0))
    pottery.fix(group, "Rolling_pin", shape(pin, BROWN), (-50, -1, 84.2), -4)
    pottery.put(group, "Cutter_box", shape(tray(24, 18, 6), WOOD), (20, 26, 80), 12)
    for number, (sides, radius, x, y) in enumerate(((24, 4, 14.5, 22), (6, 3.4, 24, 23.5)), 1):
        pottery.put(group, f"Cutter_{number}", _cutter(sides, radius), (x, y, 80.6), 12)
    pottery.put(group, "Tool_jar", jar(5, 13, BLUE), (8, -30, 80), 40)
    tools = [
        ("Loop_tool", stick_tool(20, WOOD), 20),
        ("Needle", stick_tool(17, RED, "needle"), 95),
        ("Sponge_stick", stick_tool(26, WOOD, "sponge"), 170),
        ("Slip_brush", brush(22, GREEN), 240),
        ("Metal_scraper", stick_tool(19, WOOD, "blade"), 305),
    ]
    for name, tool, azimuth in tools:
        at, rot = leaning((8, -30, 80), 4.6, 0.6, 13, azimuth)
        pottery.fix(group, name, tool, at, rot=rot)
    banding = merge(rod(9, 1.5, n=28), rod(2.5, 9, z=1.5), rod(12, 1.5, z=10.5, n=28))
    pottery.put(group, "Banding_wheel", shape(banding, GREY), (62, 16, 80))
    pottery.put(group, "Coil_vase", vase(9, 24, CLAY, 0.6), (62.5, 16, 92))
    sketch = merge(box(21, 30, 0.3, 0, 0, 0), box(20.5, 29, 0.9, 0, 0, 0.3), box(21, 30, 0.3, 0, 0, 1.2))
    pottery.put(group, "Sketchbook", shape(sketch, BLACK), (55, -28, 80), 18)
    pottery.fix(group, "Pencil", shape(rod(0.35, 17, n=6), YELLOW), (48, -30, 81.9), rot=(0, 90, 30))
    pottery.put(group, "Coffee_mug", mug(RED), (88, -20, 80), -50)
    at, rot = leaning((88, -20, 80), 3.8, 0.7, 9.5, 140, 0.35)
    pottery.put(group, "Plastic_bag", shape(open_bag(26, 22, 30, 0.15), WHITE, opacity=0.4), (88, 30, 80), 10)
    pottery.put(group, "Damp_pot", vase(8, 20, CLAY, 0.7), (88, 30, 80.2))
    legs = [box(4, 4, 44, a * 18, 17) for a in (-1, 1)] + [box(4, 4, 88, a * 18, -18) for a in (-1, 1)]
    back = [box(32, 2.5, 9, 0, -18, z) for z in (60, 77)]
    chair = shape(merge(*legs, *back, box(42, 42, 3, 0, 0, 44)), WOOD, asset="chair")
    pottery.put(group, "Chair", chair, (-55, -50, 0), 3)
    pottery.put(group, "Cushion", shape(bag(36, 36, 4), RED), (-55, -49, 47), 6)
    pottery.put(group, "Table_stool_1", stool(), (20, -66, 0))
    pottery.put(group, "Plaster_crate", shape(tray(50, 36, 26, 0.8), GREY), (40, 5, 0), -8)
    pottery.put(group, "Plaster_mould_1", slab(20, 18, 10, WHITE), (30, 4, 0.8), -8)


def _build_wedging(pottery: Pottery, group: Group) -> None:
    pottery.put(group, "Wedging_table", table(120, 70, 76, WOOD, 22), (0, -38, 0))
    pottery.put(group, "Plaster_slab", shape(merge(box(62, 52, 6)), WHITE), (-22, -38, 76), 1)
    pottery.put(group, "Clay_block", shape(bag(24, 18, 14), CLAY), (-30, -32, 82), 25)
    scale = merge(box(26, 28, 6), rod(2, 2, z=6), box(24, 24, 1, 0, 2, 8))
    pottery.put(group, "Clay_scale", shape(scale, GREY), (36, -34, 76), -5)
    pottery.put(
        group, "Clay_ball", shape(lathe([(0, 0), (2.5, 0.2), (5, 3), (5, 5), (2.8, 8.4), (0, 9)]), CLAY), (36, -33, 85)
    )
    pottery.put(group, "Slop_bucket", bucket(WHITE), (-36, -38, 22), 30)
    pottery.put(group, "Slop_lid", bucket_lid(WHITE), (-36, -38, 52))
    screw_hook = merge(
        rod(0.25, 2.5, "x", -2.5, 0, 0, 8), tube([(0, 0, 0), (1.5, 0, 0), (2.4, 0, 0.6), (2.4, 0, 1.6)], 0.25)
    )
    pottery.fix(group, "Screw_hook", shape(screw_hook, BRASS), (60.2, -50, 74))
    grip = [rod(0.9, 7, "y", 0, -3.5, z) for z in (-2.8, -44)]
    wire = tube([(0, 0, -2), (0, 0.4, -12), (0.3, 0.4, -30), (0, 0, -43.5)], 0.1, 6)
    loop = tube([(0, -0.9, -2), (0, -0.6, -0.4), (0, 0, 0.1), (0, 0.6, -0.4), (0, 0.9, -2)], 0.1, 6)
    pottery.fix(group, "Cutting_wire", shape(merge(*grip, wire, loop), WOOD), (61.3, -50, 74.25))
    pottery.fix(group, "Magnetic_strip", shape(box(60, 2, 5, 0, -1, -2.5), BLACK), (-5, -0.15, 135))
    hung = [
        ("Fettling_knife", stick_tool(18, WOOD, "blade")),
        ("Loop_tool_large", stick_tool(22, BROWN)),
        ("Steel_kidney", slab(5, 0.15, 10, STEEL)),
        ("Ball_stylus", stick_tool(17, BLUE, "needle")),
    ]
    for number, (name, tool) in enumerate(hung):
        depth = -2 - (0.5 if tool.height > 10 else 0.08)
        pottery.fix(group, name, tool, (-28 + 11 * number, depth - 0.2, 124 if tool.height > 10 else 131), 0)


def _build_books(pottery: Pottery, group: Group) -> None:
    for number, x in ((1, -45), (2, 45)):
        pottery.wall(group, f"Bracket_{number}", bracket(), (x, -0.1, -2.6))
    pottery.put(group, "Shelf_board", slab(130, 23, 2.5, WOOD), (0, -12, -2.5))
    end = merge(box(0.3, 10, 14), box(9, 10, 0.3, 4.5))
    pottery.put(group, "Bookend_left", shape(end, BLACK, asset="bookend"), (-55, -10, 0))
    pottery.put(group, "Bookend_right", shape(end, BLACK, asset="bookend"), (-31.6, -10, 0), 180)
    edge = -54.7
    for number, (width, height, color) in enumerate(
        ((3.2, 24, RED), (4.5, 27, CREAM), (2.1, 21, BLUE), (5, 29, GREEN), (3.6, 25, BROWN), (4.1, 22, GREY)), 1
    ):
        pottery.put(
            group,
            f"Glaze_book_{number}",
            book(width, 17, height, color),
            (edge + width / 2, -11.5, 0.3 if number < 3 or number > 4 else 0.15),
        )
        edge += width + 0.08
    pottery.put(
        group,
        "Lying_book",
        shape(merge(box(18, 24, 0.3), box(17.5, 23, 2.4, 0, 0, 0.3), box(18, 24, 0.3, 0, 0, 2.7)), BLACK),
        (-12, -12.5, 0),
        86,
    )
    radio = merge(box(24, 9, 14), moved(turned(ring(4, 5, 0.4), 90), -5, -4.5, 7), rod(1, 0.8, "-y", 7, -4.5, 9))
    pottery.put(group, "Radio", shape(radio, CREAM), (22, -11, 0), -6)
    pottery.fix(
        group,
        "Radio_cable",
        polyline(
            [
                (24, -6.2, 4),
                (28, -3.5, 2),
                (32, -0.6, 1),
                (33, -0.4, -10),
                (34, -0.6, -80),
                (35, -2, -118),
                (35, -5.1, -120),
            ],
            0.3,
            BLACK,
        ),
        (0, 0, 0),
    )
    pottery.wall(group, "Radio_outlet", outlet(), (35, 0, -120))
    pottery.fix(
        group,
        "Radio_plug",
        shape(merge(rod(1.9, 3.8, "-y"), rod(0.24, 1.6, "y", 0.95), rod(0.24, 1.6, "y", -0.95)), BLACK),
        (35, -1, -120),
    )
    pottery.put(
        group, "Ivy_pot", shape(lathe([(0, 0), (5, 0), (6.5, 11), (6, 11), (5.8, 9.5), (0, 9.5)]), WHITE), (52, -12, 0)
    )
    pottery.fix(group, "Ivy", plant(14, 10, 10), (52, -12, 9.6))


def _build_pallet(pottery: Pottery, group: Group) -> None:
    planks = [box(120, 11, 2.2, 0, y, 11.8) for y in (-34.5, -17, 0, 17, 34.5)] + [
        box(12, 80, 2.2, x, 0, 9.6) for x in (-54, 0, 54)
    ]
    planks += [box(12, 10, 9.6, x, y) for x in (-54, 0, 54) for y in (-35, 0, 35)]
    pottery.put(group, "Pallet", shape(merge(*planks), WOOD), (0, 0, 0))
    clay = shape(bag(42, 27, 13), GREY, asset="clay_bag")
    places = [
        (-34, -15, 14, 0),
        (-34, 14, 14, 2),
        (12, -15, 14, -1),
        (12, 14, 14, 0),
        (-34, 0, 27, 90),
        (12, -14, 27, 3),
    ]
    for number, (x, y, z, turn) in enumerate(places, 1):
        pottery.put(group, f"Clay_bag_{number}", clay, (x, y, z), turn)
    pottery.put(group, "Opened_clay_bag", shape(open_bag(30, 24, 34, 0.2), GREY), (46, -2, 14), 92)
    pottery.put(group, "Clay_piece", shape(bag(24, 19, 20), CLAY), (46, -2, 14.2), 92)


def _build_pegs(pottery: Pottery, group: Group) -> None:
    pottery.wall(group, "Peg_rail", slab(100, 2, 9, WOOD), (0, -1, -4.5))
    for number in range(5):
        pottery.fix(
            group,
            f"Peg_{number + 1}",
            shape(rod(0.9, 9, "-y", 0, 0.5, 0), WOOD, asset="peg"),
            (-40 + 20 * number, -2, 0),
        )
    for number, (peg, color) in enumerate(((0, BLUE), (1, BROWN), (3, GREEN)), 1):
        pottery.fix(group, f"Apron_{number}", apron(color, 70 + 4 * number), (-40 + 20 * peg, -7 - 0.5 * number, 0.95))
    hat = lathe([(0, -2), (9, -3), (10, -12), (16, -14), (16, -14.5), (9.6, -12.6), (8.6, -3.4), (0, -2.4)])
    pottery.fix(group, "Straw_hat", shape(hat, YELLOW), (40, -17, -8), rot=(90, 0, 0))
    pottery.fix(group, "Waste_bin", shape(vessel([(13, 0), (16, 38)], 0.6, 0.8), GREY), (-36, -24, 0.1 - 165))
    pottery.fix(
        group,
        "Bin_liner",
        shape(
            lathe(
                [
                    (0, 0.1),
                    (12.2, 0.1),
                    (15.3, 37),
                    (15.3, 37.5),
                    (16.4, 37.5),
                    (16.4, 33),
                    (16.3, 33),
                    (16.3, 37.3),
                    (15.5, 37.3),
                ]
            ),
            GLASS,
            opacity=0.6,
        ),
        (-36, -24, 0.9 - 165),
    )
