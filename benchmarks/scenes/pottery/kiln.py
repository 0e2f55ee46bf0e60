"""The kiln room, modelled in millimetres: a front loader, a top loader, kiln furniture and protective gear."""

import math

from benchmarks.scenes.pottery.shapes import Mesh, bag, box, lathe, merge, moved, ring, rod, tray, tube, turned, vessel
from benchmarks.scenes.pottery.stage import Group, Part, Pottery, Shape, shape
from benchmarks.scenes.pottery.things import (
    BLACK,
    BLUE,
    BRICK,
    BROWN,
    CELADON,
    CREAM,
    GLASS,
    GREY,
    STEEL,
    WHITE,
    WOOD,
    YELLOW,
    bowl,
    bucket,
    cylinder,
    hook,
    panel,
    slab,
    vase,
)

__all__ = ["build_kiln_room"]


def build_kiln_room(pottery: Pottery) -> None:
    """Add the kiln room."""
    room = pottery.group(pottery.root, "Kiln_room", unit=10)
    front = pottery.group(room, "Front_loader", (1000, 590, 0))
    _build_front_loader(pottery, front)
    _load_front_loader(pottery, front)
    _build_top_loader(pottery, pottery.group(room, "Top_loader", (810, 412, 0), 12))
    _build_furniture(pottery, pottery.group(room, "Kiln_furniture", (1100, 430, 0), -90))
    _build_wall_things(pottery, pottery.group(room, "South_wall", (930, 352, 0), 180))


def _build_front_loader(pottery: Pottery, group: Group) -> None:
    legs = [box(6, 6, 36, a * 47, y) for a in (-1, 1) for y in (-6, -84)]
    pottery.put(group, "Kiln_stand", shape(merge(*legs, box(104, 90, 4, 0, -45, 36)), BLACK), (0, 0, 0))
    walls = [box(18, 88, 106, a * 41, -45) for a in (-1, 1)]
    walls += [box(64, 88, 18, 0, -45, z) for z in (0, 88)] + [box(64, 18, 70, 0, -10, 18)]
    kiln = pottery.group(group, "Kiln", (0, 0, 40))
    pottery.put(kiln, "Kiln_body", shape(merge(*walls), GREY), (0, 0, 0))
    leaf = pottery.group(kiln, "Leaf", (-50, -89.4, 0.3), -112)
    face = merge(box(100, 10, 105, 50, -5), box(62, 5, 68, 50, 2.5, 18.6))
    pottery.fix(leaf, "Kiln_door", shape(face, STEEL, Part(box(90, 0.4, 95, 50, -10.2, 5), GREY)), (0, 0, 0))
    latch = merge(rod(1.2, 5, "-y"), rod(1.5, 14, "z", 0, -5, -7))
    pottery.fix(leaf, "Door_latch", shape(latch, BLACK), (93, -10.3, 55))
    flue = lathe([(7, 0), (7.5, 0), (7.5, 134.3), (7, 134.3)], closed=True)
    pottery.fix(kiln, "Flue", shape(flue, STEEL), (10, -35, 105.9))
    probe = merge(rod(0.6, 24, "-y", 0, 0, 0), moved(box(4, 4, 4, 0, 0, -2), 0, 1.9, 0))
    pottery.fix(kiln, "Thermocouple", shape(turned(probe, 0, 0, -90), WHITE), (50.2, -50, 70))
    pottery.wall(
        group,
        "Controller",
        shape(box(22, 10, 30, 0, -5, -15), BLUE, Part(box(14, 0.3, 6, 0, -10.1, 3), GLASS)),
        (74, 10, 140),
    )


def _load_front_loader(pottery: Pottery, group: Group) -> None:
    load = pottery.group(group, "Load", (0, -46, 58), 1)
    corners = [(-24, -20), (24, -20), (24, 20), (-24, 20)]
    batt = slab(56, 50, 2, CREAM, "kiln_shelf")
    level = 0.0
    for number, height in enumerate((5, 20), 1):
        prop = shape(merge(box(4, 4, height)), CREAM, asset=f"kiln_prop_{height}")
        for corner, (x, y) in enumerate(corners, 1):
            pottery.put(load, f"Prop_{number}{corner}", prop, (x + 0.2 * corner, y, level), 10 * corner)
        pottery.put(load, f"Kiln_shelf_{number}", batt, (0, 0, level + height), number - 2)
        level += height + 2
    for number, (x, y) in enumerate(((-11, -12), (8, -10)), 1):
        pottery.put(load, f"Fired_vase_{number}", vase(6, 15 + number, (BLUE, CELADON, BROWN)[number - 1]), (x, y, 7))
    pottery.put(
        load,
        "Cone_pack",
        shape(
            merge(
                box(7, 2, 1), *(moved(turned(lathe([(0, 0), (0.7, 0), (0, 5)], 4), 8), x, 0, 0.9) for x in (-2, 0, 2))
            ),
            WHITE,
        ),
        (10, 6, 7),
        20,
    )
    pottery.put(load, "Fired_bowl_1", bowl(8, 6, CELADON), (-9, -8, 29))
    pottery.put(load, "Fired_bowl_2", bowl(8, 6, BLUE), (10, 8, 29))


def _stilt() -> Shape:
    """Return a tripod with three tips, 2 high."""
    arms = [turned(box(5, 1, 1, 2.5, 0, 0), 0, 0, a) for a in (0, 120, 240)]
    tips = [
        moved(lathe([(0, 0), (0.5, 0), (0.3, 2), (0, 2)], 6), 4.5 * math.cos(a), 4.5 * math.sin(a))
        for a in (0, 2.094, 4.189)
    ]
    return shape(merge(*arms, *tips), WHITE, asset="stilt")


def _build_top_loader(pottery: Pottery, group: Group) -> None:
    legs = [box(4, 4, 22, 26 * math.cos(a), 26 * math.sin(a)) for a in (0.8, 2.36, 3.93, 5.5)]
    pottery.put(group, "Round_stand", shape(merge(*legs, moved(ring(20, 38, 3, 10), 0, 0, 22)), BLACK), (0, 0, 0))
    pot = lathe([(0, 0), (38, 0), (38, 72), (28, 72), (28, 10), (0, 10)], 10)
    pottery.put(group, "Round_kiln", shape(merge(pot, box(14, 12, 7.6, 0, 41, 65)), STEEL), (0, 0, 25))
    lid = pottery.group(group, "Lid", (0, 35.2, 97.5))
    disc = moved(lathe([(0, 0), (38, 0), (38, 8), (0, 8)], 10), 0, -38)
    pottery.fix(lid, "Kiln_lid", shape(disc, STEEL), (0, 0, 0), rot=(-104, 0, 0))
    grip = tube([(-7, -73.8, 4), (-7, -77.5, 4), (7, -77.5, 4), (7, -73.8, 4)], 0.8)
    pottery.fix(lid, "Lid_handle", shape(grip, BLACK), (0, 0, 0), rot=(-104, 0, 0))
    plug = lathe([(0, 0), (1.8, 0), (2.2, 11), (3, 11), (3, 13), (0, 13)], 12)
    pottery.fix(group, "Peephole_plug", shape(turned(plug, 90), WHITE), (0, -25, 72))
    for number, angle in enumerate((0.3, 2.4, 4.5), 1):
        pottery.put(
            group, f"Short_prop_{number}", cylinder(2, 4, CREAM), (17 * math.cos(angle), 17 * math.sin(angle), 35)
        )
    pottery.put(group, "Round_shelf", shape(rod(25, 2, n=28), CREAM), (0, 0, 39), 5)
    pottery.put(group, "Raku_bowl", bowl(11, 9, BROWN), (-6, 4, 41))
    pottery.put(group, "Raku_cup", shape(vessel([(3, 0), (4, 8)], 0.4, 0.6), BLACK), (-6, 4.2, 41.9))
    pottery.put(group, "Kiln_brick", slab(23, 11, 6.5, BRICK), (48, -36, 0), 30)


def _build_furniture(pottery: Pottery, group: Group) -> None:
    posts = [box(4, 4, 130, a * 58, y) for a in (-1, 1) for y in (-3, -47)]
    boards = [box(120, 50, 2, 0, -25, z - 2) for z in (20, 70, 130)]
    pottery.put(group, "Steel_rack", shape(merge(*posts, *boards), GREY), (0, -0.3, 0))
    batt = slab(56, 48, 2, CREAM, "spare_kiln_shelf")
    for number in range(2):
        pottery.put(group, f"Spare_kiln_shelf_{number + 1}", batt, (-28 + number, -25.5, 20 + 2 * number), 0.7 * number)
    pottery.put(group, "Cone_box", shape(tray(18, 12, 5, 0.3), WHITE), (-40, -22, 70), 10)
    for number, (x, turn) in enumerate(((-45, 30),), 1):
        pottery.fix(
            group,
            f"Pyrometric_cone_{number}",
            shape(turned(lathe([(0, 0), (0.8, 0), (0, 6.5)], 3), 90), CREAM),
            (x, -20, 71),
            turn,
        )
    pottery.put(group, "Kiln_wash", bucket(WHITE), (2, -25, 70), 100)
    pottery.fix(
        group,
        "Wash_brush",
        shape(merge(box(2.5, 1.5, 30, 0, 0, 8), box(6.5, 1.8, 8)), WOOD),
        (6, -25, 71.6),
        rot=(0, 18, 0),
    )
    half = slab(56, 48, 2, CREAM, "spare_kiln_shelf")
    pottery.fix(group, "Leaning_shelf", half, (-92, -4.8, 23.7), rot=(90 - 11, 0, 0))


def _build_wall_things(pottery: Pottery, group: Group) -> None:
    for number, x in enumerate((-40, -12), 1):
        pottery.wall(group, f"Gear_hook_{number}", hook(), (x, 0, 160))
    band = tube([(9 * math.cos(a), 0, -9 + 9 * math.sin(a)) for a in [2 * math.pi * i / 24 for i in range(25)]], 0.5)
    shield = moved(turned(lathe([(12, 0), (12.3, 0), (12.3, 24), (12, 24)], 24, closed=True), 0), 0, -1, -36)
    pottery.fix(
        group,
        "Face_shield",
        shape(
            merge(moved(band, 0, 0, 0.5), box(24, 0.6, 2.5, 0, -0.4, -16)),
            BLACK,
            Part(moved(_half(shield), 0, 0, 0), GLASS, 0.4),
        ),
        (-40, -3, 160.3),
    )
    mitt = merge(
        moved(bag(13, 3, 30), 0, 0, -38),
        moved(turned(ring(1, 1.5, 0.6, 14), 90), 0, 0.3, -1),
        box(2, 0.4, 6, 0, 0, -8.2),
    )
    pottery.fix(group, "Oven_mitt", shape(mitt, GREY), (-12, -3, 160.3))
    pottery.wall(group, "Firing_chart", panel(60, 42, 0.1, YELLOW), (75, 0, 155))


def _half(mesh: Mesh) -> Mesh:
    """Return the faces of a mesh whose points are all at y <= 0, as of a visor."""
    return Mesh(mesh.points, [face for face in mesh.faces if all(mesh.points[index][1] <= -0.5 for index in face)])
