"""Pots, tools, hooks, cloths and furniture. Each stands on z = 0 unless said otherwise."""

import math
from collections.abc import Sequence

from benchmarks.scenes.pottery.shapes import (
    Mesh,
    bag,
    box,
    lathe,
    merge,
    moved,
    ribbon,
    ring,
    rod,
    tray,
    tube,
    turned,
    vessel,
)
from benchmarks.scenes.pottery.stage import Part, Shape, shape

__all__ = [
    "BLACK",
    "BLUE",
    "BRASS",
    "BRICK",
    "BROWN",
    "CELADON",
    "CLAY",
    "CREAM",
    "GLASS",
    "GREEN",
    "GREY",
    "RED",
    "STEEL",
    "WHITE",
    "WOOD",
    "YELLOW",
    "apron",
    "book",
    "bottle",
    "bowl",
    "bracket",
    "brush",
    "bucket",
    "bucket_lid",
    "cardboard",
    "cord_lamp",
    "cylinder",
    "door",
    "door_handle",
    "hook",
    "jar",
    "jar_lid",
    "leaning",
    "mug",
    "outlet",
    "panel",
    "plant",
    "plate",
    "polyline",
    "slab",
    "stick_tool",
    "stool",
    "table",
    "tap",
    "teapot",
    "teapot_lid",
    "vase",
    "wavy",
]

Point = tuple[float, float, float]

BLACK, WHITE, GREY = (0.08, 0.08, 0.09), (0.92, 0.92, 0.9), (0.5, 0.5, 0.52)
STEEL, BRASS, GLASS = (0.7, 0.72, 0.75), (0.75, 0.6, 0.25), (0.75, 0.88, 0.9)
CLAY, BRICK, BROWN = (0.62, 0.5, 0.42), (0.75, 0.42, 0.3), (0.35, 0.22, 0.14)
WOOD, CREAM, YELLOW = (0.72, 0.55, 0.35), (0.9, 0.85, 0.72), (0.9, 0.75, 0.2)
BLUE, GREEN, RED, CELADON = (0.2, 0.35, 0.6), (0.25, 0.5, 0.25), (0.75, 0.18, 0.15), (0.62, 0.75, 0.66)


def slab(sx: float, sy: float, sz: float, color: Point, asset: str | None = None, opacity: float = 1) -> Shape:
    """Return a plain box."""
    return shape(box(sx, sy, sz), color, asset=asset, opacity=opacity)


def cylinder(radius: float, height: float, color: Point, opacity: float = 1) -> Shape:
    """Return a plain cylinder."""
    return shape(rod(radius, height, n=24), color, opacity=opacity)


def panel(sx: float, sz: float, thickness: float, color: Point, opacity: float = 1) -> Shape:
    """Return a sheet in front of a wall: its back on y = 0, its middle on z = 0."""
    return shape(box(sx, thickness, sz, 0, -thickness / 2, -sz / 2), color, opacity=opacity)


def mug(color: Point) -> Shape:
    """Return a mug, 9.5 high, its handle at +x."""
    body = vessel([(3.6, 0), (4.2, 1.5), (4.2, 9.5)], 0.4)
    arc = [(3.9 + 2.6 * math.sin(math.pi * t), 0, 2 + 5.5 * t) for t in [i / 8 for i in range(9)]]
    return shape(merge(body, tube(arc, 0.5)), color, asset=f"mug_{round(color[1] * 100)}")


def bowl(radius: float, height: float, color: Point) -> Shape:
    """Return a bowl with a wall 0.5 thick; copies of radius 9 nest with a step of 1.35."""
    foot = radius * 0.42
    return shape(vessel([(foot, 0), (foot, 0.7), (radius, height)], 0.5, 0.9), color)


def plate(radius: float, color: Point) -> Shape:
    """Return a plate, 2.2 high; copies nest with a step of 0.75."""
    return shape(vessel([(radius * 0.6, 0), (radius * 0.68, 0.6), (radius, 2.2)], 0.9, 0.7, 32), color)


def vase(radius: float, height: float, color: Point, neck: float = 0.5) -> Shape:
    """Return a vase with a belly."""
    outline = [(0.6, 0), (0.85, 0.15), (1, 0.4), (0.85, 0.65), (neck, 0.85), (neck * 1.25, 1)]
    return shape(vessel([(r * radius, z * height) for r, z in outline], 0.5, 0.8), color)


def teapot(color: Point) -> Shape:
    """Return a teapot without its lid: its mouth, of radius 3.4, is on z = 11."""
    body = vessel([(4.5, 0), (7.5, 2.5), (8, 5.5), (6.5, 9), (3.9, 11)], 0.5)
    spout = tube([(7.3, 0, 4), (10, 0, 5.5), (11.5, 0, 8), (13, 0, 10.5)], 0.9)
    handle = tube([(-6.6, 0, 8.6), (-10, 0, 9), (-11, 0, 6), (-7.6, 0, 3.4)], 0.6)
    return shape(merge(body, spout, handle), color)


def teapot_lid(color: Point) -> Shape:
    """Return a lid with a flange and a knob, to be placed on the mouth."""
    return shape(lathe([(0, -0.8), (3, -0.8), (3, 0), (4.3, 0), (3.4, 1), (0.9, 1.5), (1.3, 2.8), (0, 3.2)]), color)


def jar(radius: float, height: float, color: Point, opacity: float = 1) -> Shape:
    """Return a straight jar with a wall of 0.4 and a floor of 0.6."""
    return shape(vessel([(radius, 0), (radius, height)], 0.4, 0.6), color, opacity=opacity)


def jar_lid(radius: float, color: Point) -> Shape:
    """Return a lid that lies on a rim, z = 0, with a plug below it."""
    return shape(
        lathe([(0, -0.7), (radius - 0.6, -0.7), (radius - 0.6, 0), (radius + 0.2, 0), (radius, 1), (0, 1.1)]), color
    )


def bucket(color: Point) -> Shape:
    """Return a bucket, 30 high, 15 in radius, with a bail that hangs down."""
    body = vessel([(12.5, 0), (15, 29), (15.4, 29), (15.4, 30)], 0.4, 0.5, 32)
    bail = [
        (15.6 * math.cos(a), 15.6 * math.sin(a) * 0.995, 25 - 9 * math.sin(a))
        for a in [math.pi * i / 12 for i in range(13)]
    ]
    return shape(body, color, Part(tube(bail, 0.25, 6), STEEL), asset=f"bucket_{round(color[2] * 100)}")


def bucket_lid(color: Point) -> Shape:
    """Return a lid with a skirt around the rim, to be placed with z = 0 on the rim."""
    profile = [(0, 0), (15.5, 0), (15.5, -1.5), (15.9, -1.5), (15.9, 0.8), (14, 0.8), (13.6, 0.4), (0, 0.4)]
    return shape(lathe(profile, 32), color, asset=f"bucket_lid_{round(color[2] * 100)}")


def bottle(radius: float, height: float, color: Point, opacity: float = 1) -> Shape:
    """Return a shut bottle with a cap."""
    top = height * 0.75
    body = lathe(
        [
            (0, 0),
            (radius, 0),
            (radius, top),
            (radius * 0.4, height * 0.87),
            (radius * 0.4, height * 0.9),
            (0, height * 0.9),
        ]
    )
    cap = rod(radius * 0.5, height * 0.13, z=height * 0.87)
    return shape(body, color, Part(cap, WHITE), opacity=opacity)


def book(width: float, depth: float, height: float, color: Point) -> Shape:
    """Return a standing book, its spine at -y."""
    covers = [box(0.25, depth, height, side * (width - 0.25) / 2) for side in (-1, 1)]
    spine = box(width - 0.5, 0.25, height, 0, -depth / 2 + 0.125)
    pages = box(width - 0.5, depth - 0.9, height - 0.8, 0, 0, 0.4)
    return shape(merge(*covers, spine), color, Part(pages, CREAM))


def stick_tool(length: float, color: Point, head: str = "loop") -> Shape:
    """Return an upright tool of radius 0.5 with a loop, a needle, a sponge or a blade at its upper end."""
    handle = lathe([(0, 0), (0.45, 0), (0.5, length * 0.4), (0.35, length * 0.7), (0, length * 0.7)], 10)
    start, end = length * 0.69, length
    if head == "loop":
        arc = [
            (
                1.3 * math.sin(2 * math.pi * i / 12),
                0,
                (start + end) / 2 - (end - start) / 2 * math.cos(2 * math.pi * i / 12),
            )
            for i in range(13)
        ]
        tip = tube(arc, 0.12, 6)
    elif head == "needle":
        tip = lathe([(0, start), (0.12, start), (0, end)], 6)
    elif head == "sponge":
        tip = moved(bag(2.2, 2.2, end - start), 0, 0, start)
    else:
        tip = box(2, 0.15, end - start, 0, 0, start)
    return shape(handle, color, Part(tip, CREAM if head == "sponge" else STEEL))


def brush(length: float, color: Point) -> Shape:
    """Return an upright brush of radius 0.45, its hair above."""
    handle = lathe([(0, 0), (0.25, 0), (0.45, length * 0.6), (0.4, length * 0.8), (0, length * 0.8)], 10)
    hair = lathe([(0, length * 0.8), (0.45, length * 0.8), (0.5, length * 0.9), (0, length)], 10)
    return shape(handle, color, Part(hair, BROWN))


def leaning(
    at: Point, inner: float, floor: float, height: float, azimuth: float, radius: float = 0.5
) -> tuple[Point, Point]:
    """Return place and angles of a stick in a vessel at a place: it stands on the floor and leans on the rim."""
    reach = inner - radius * 1.25
    foot = reach * 0.45
    tilt = math.degrees(math.atan2(reach - foot, height - floor))
    angle = math.radians(azimuth)
    rise = floor + radius * math.sin(math.radians(tilt)) + 0.05
    return (at[0] + foot * math.cos(angle), at[1] + foot * math.sin(angle), at[2] + rise), (0, tilt, azimuth)


def hook(color: Point = STEEL, reach: float = 3) -> Shape:
    """Return a hook at a wall: its plate on y = 0, the arm on z = 0, 0.3 thick, bent up at its end."""
    arm = tube(
        [(0, -0.2, 0), (0, -reach * 0.5, 0), (0, -reach - 0.4, 0), (0, -reach - 1.1, 0.6), (0, -reach - 1.2, 1.8)], 0.3
    )
    return shape(merge(box(2, 0.3, 4, 0, -0.15, -2), arm), color, asset=f"hook_{round(reach)}")


def bracket() -> Shape:
    """Return a shelf bracket, 20 deep: its back on y = 0, its top on z = 0."""
    return shape(
        merge(
            box(2.5, 0.4, 18, 0, -0.2, -18),
            box(2.5, 20, 0.4, 0, -10, -0.4),
            tube([(0, -0.4, -15), (0, -9, -6), (0, -17, -0.5)], 0.5),
        ),
        BLACK,
        asset="bracket",
    )


def wavy(width: float, height: float, waves: int, depth: float = 1.5, thickness: float = 0.25) -> Mesh:
    """Return a hanging cloth along x with its upper edge on z = 0."""
    steps = waves * 8
    path = [(width * (i / steps - 0.5), depth * math.sin(2 * math.pi * waves * i / steps)) for i in range(steps + 1)]
    return moved(ribbon(path, thickness, height), 0, 0, -height)


def apron(color: Point, height: float = 75) -> Shape:
    """Return an apron that hangs: the inside of its neck loop is at the origin."""
    strap = tube([(-5, 0, -15), (-3.5, 0, -5), (-1, 0, 0), (0, 0, 0.3), (1, 0, 0), (3.5, 0, -5), (5, 0, -15)], 0.3)
    return shape(moved(wavy(15, height, 2, 1.2, 0.4), 0, 0, -14), color, Part(strap, BLACK))


def cord_lamp(cord: float, color: Point) -> Shape:
    """Return a lamp that hangs from z = 0, with rose, cord and shade in one."""
    shade = lathe([(2, -cord), (3, -cord), (16, -cord - 13), (15.6, -cord - 13), (2.6, -cord - 0.6)], closed=True)
    parts = [
        rod(5, 2.5, z=-2.5),
        rod(0.3, cord, z=-cord - 1),
        lathe([(0, -cord - 10), (3, -cord - 7), (1.5, -cord - 1), (0, -cord - 1)]),
    ]
    return shape(merge(shade, *parts), color, asset=f"lamp_{round(cord)}")


def door(width: float, height: float, thickness: float, color: Point) -> Shape:
    """Return a leaf whose hinge is on the z axis and which extends to +x, its front at -y."""
    leaf = box(width, thickness, height, width / 2, -thickness / 2)
    fields = [box(width * 0.7, 0.4, height * 0.38, width / 2, -thickness - 0.2, height * z) for z in (0.07, 0.53)]
    return shape(merge(leaf, *fields), color)


def door_handle() -> Shape:
    """Return a lever with its plate at y = 0, to -y."""
    lever = tube([(0, -0.2, 0), (0, -4.5, 0), (-1, -5.2, 0), (-11, -5.2, 0)], 0.8)
    return shape(merge(box(3.5, 0.5, 18, 0, -0.25, -11), lever), STEEL, asset="door_handle")


def outlet() -> Shape:
    """Return a wall socket centred on z = 0, with a recess."""
    return shape(
        merge(box(8, 0.8, 8, 0, -0.4, -4), moved(turned(ring(2.1, 3.2, 0.5), 90), 0, -0.8, 0)), WHITE, asset="outlet"
    )


def plant(spread: float, height: float, leaves: int = 9, color: Point = GREEN) -> Shape:
    """Return a bunch of stems with leaves that grow from z = 0."""
    parts: list[Mesh] = []
    for i in range(leaves):
        angle, reach = 2.4 * i, spread * (0.45 + 0.55 * (i % 3) / 2)
        top = height * (1 - 0.2 * (i % 4) / 3)
        x, y = math.cos(angle), math.sin(angle)
        stem = [
            (0.1 * reach * x, 0.1 * reach * y, -1.5),
            (0.3 * reach * x, 0.3 * reach * y, top * 0.6),
            (reach * 0.8 * x, reach * 0.8 * y, top * 0.9),
        ]
        leaf = turned(moved(lathe([(0, -0.1), (spread * 0.22, 0), (0, 0.1)], 8), 0, 0, 0), 20, -15, 30 * i)
        parts += [tube(stem, 0.2, 5), moved(leaf, *stem[-1])]
    return shape(merge(*parts), color)


def stool(height: float = 48) -> Shape:
    """Return a round stool with three legs and a ring."""
    legs = [
        tube([(14 * math.cos(a), 14 * math.sin(a), 0), (9 * math.cos(a), 9 * math.sin(a), height - 2.5)], 1.2)
        for a in (0.5, 2.6, 4.7)
    ]
    return shape(rod(16, 3, z=height - 3, n=28), WOOD, Part(merge(*legs), STEEL), asset=f"stool_{round(height)}")


def table(sx: float, sy: float, height: float, color: Point, board: float | None = None, top: float = 3.5) -> Shape:
    """Return a table with four legs and perhaps a lower board whose top is at a height."""
    legs = [box(6, 6, height - top, a * (sx / 2 - 6), b * (sy / 2 - 6)) for a in (-1, 1) for b in (-1, 1)]
    parts = [box(sx, sy, top, 0, 0, height - top), *legs]
    parts += [box(sx - 18, 2.5, 8, 0, side * (sy / 2 - 6), height - top - 8) for side in (-1, 1)]
    if board is not None:
        parts.append(box(sx - 8, sy - 8, 2, 0, 0, board - 2))
    return shape(merge(*parts), color)


def tap(reach: float = 14) -> Shape:
    """Return a tap that stands: column, spout to -y and a lever."""
    spout = tube([(0, 0, 0), (0, 0, 14), (0, -3, 18), (0, -reach + 3, 18), (0, -reach, 14)], 1.1, 10)
    return shape(merge(rod(2.4, 1), spout, tube([(1, 0, 8), (4, 0, 9), (8, 0, 12)], 0.6)), STEEL, asset="tap")


def cardboard(sx: float, sy: float, sz: float) -> Shape:
    """Return an open box of cardboard with two flaps bent outwards."""
    flaps = [moved(turned(box(0.4, sy, sx * 0.35, 0, 0, 0), 0, side * 125), side * sx / 2, 0, sz) for side in (-1, 1)]
    return shape(merge(tray(sx, sy, sz, 0.5), *flaps), (0.7, 0.55, 0.38))


def polyline(points: Sequence[Point], radius: float, color: Point) -> Shape:
    """Return a cable or hose along points."""
    return shape(tube(points, radius), color)
