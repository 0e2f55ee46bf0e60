"""The room shell and objects fixed to it; centimetres, wall-hung objects have their back at z = 0."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import arc, bend, box, cylinder, ellipsoid, facet, lathe, panel, sheet, tube

ROOM = (550.0, 260.0, 420.0)
"""Clear width (x), height (y) and depth (z), centimetres."""
WALL = 14.0


def _facing(profile: list[tuple[float, float]], segments: int = 28) -> Mesh:
    """Return a lathe shape turned so that its axis points into the room (+z)."""
    return moved(lathe(profile, segments), turn=(90, 0, 0))


@asset()
def floor_tiles(a: Asset) -> None:
    half_x, half_z, tile = ROOM[0] / 2, ROOM[2] / 2, 50.0
    side = tile - 0.4
    flat = facet([(0, 0, 0), (side, 0, 0), (side, 0, -side), (0, 0, -side)])
    light: list[Mesh] = []
    warm: list[Mesh] = []
    for i in range(11):
        for j in range(8):
            where = (-half_x + i * tile + 0.2, 0.0, half_z - j * tile - 0.2)
            (light if (i + j) % 2 else warm).append(moved(flat, by=where))
    strip = facet([(0, 0, 0), (side, 0, 0), (side, 0, -19.6), (0, 0, -19.6)])
    for i in range(11):
        where = (-half_x + i * tile + 0.2, 0.0, -half_z + 20 - 0.2)
        (light if i % 2 else warm).append(moved(strip, by=where))
    a.add("slab_geo", box((-half_x, -8, -half_z), (half_x, -0.2, half_z)), "stone_dark")
    a.add("tiles_light", merge(*light), "tile_light")
    a.add("tiles_warm", merge(*warm), "tile_warm")
    a.surfaces["top"] = 0.0


# Outward faces of the shell are omitted: with back-face culling, a camera outside sees the room.
@asset()
def ceiling_panel(a: Asset) -> None:
    slab = moved(panel((ROOM[0], ROOM[2], 2), [], open_back=True), turn=(90, 0, 0))
    a.add("ceiling_geo", moved(slab, by=(-ROOM[0] / 2, 0, -ROOM[2] / 2)), "ceiling_paint")


@asset()
def wall_back(a: Asset) -> None:
    a.add("wall_geo", panel((ROOM[0], ROOM[1], WALL), [(178, 108, 262, 203)], open_back=True), "wall_paint")


@asset()
def wall_right(a: Asset) -> None:
    a.add("wall_geo", panel((ROOM[2], ROOM[1], WALL), [(170, 90, 320, 220)], open_back=True), "wall_paint")


@asset()
def wall_left(a: Asset) -> None:
    a.add("wall_geo", panel((ROOM[2], ROOM[1], WALL), [(235, 0, 325, 205)], open_back=True), "wall_paint")


@asset()
def wall_front(a: Asset) -> None:
    a.add("wall_geo", panel((ROOM[0], ROOM[1], WALL), [], open_back=True), "wall_paint")


def _window(a: Asset, width: float, height: float) -> None:
    x, y, bar = width / 2 - 0.1, height - 0.1, 6.0
    rim = [
        box((-x, 0.1, -10), (x, bar, -3), 0.4),
        box((-x, y - bar, -10), (x, y, -3), 0.4),
        box((-x, bar, -10), (-x + bar, y - bar, -3), 0.4),
        box((x - bar, bar, -10), (x, y - bar, -3), 0.4),
        box((-bar / 2, bar, -9.5), (bar / 2, y - bar, -3.5), 0.4),
    ]
    a.add("frame_geo", merge(*rim), "lacquer_white")
    panes = [box((-x + bar, bar, -7), (-bar / 2, y - bar, -6)), box((bar / 2, bar, -7), (x - bar, y - bar, -6))]
    a.add("pane_glass", merge(*panes), "window_glass")
    grip = tube(bend((0, height * 0.42, -3.5), (0, height * 0.42, 1), (0, height * 0.42 - 9, -0.5)), 0.8)
    a.add("handle", grip, "brushed_steel")


@asset()
def window_small(a: Asset) -> None:
    _window(a, 84, 95)


@asset()
def window_wide(a: Asset) -> None:
    _window(a, 150, 130)


@asset()
def window_sill(a: Asset) -> None:
    a.add("board", box((-74.9, 0, 0.05), (74.9, 3, 18), 0.5), "lacquer_white")


@asset()
def door_frame(a: Asset) -> None:
    sides = [box((-52, 0, 0.05), (-44.9, 212, 2), 0.3), box((44.9, 0, 0.05), (52, 212, 2), 0.3)]
    a.add("casing_geo", merge(*sides, box((-44.9, 204.9, 0.05), (44.9, 212, 2), 0.3)), "lacquer_white")


@asset()
def door_leaf(a: Asset) -> None:
    a.looks = "mtl"
    a.add("leaf_LOW", box((-44.5, 0.6, -6), (44.5, 204.3, -2), 0.2), "oak_light")
    fields = [box((-36, 14, -2), (36, 92, -1.2), 0.5), box((-36, 108, -2), (36, 192, -1.2), 0.5)]
    a.add("panels_geo", merge(*fields), "oak_light")


@asset()
def door_lever(a: Asset) -> None:
    a.looks = "mtl"
    a.add("rose", _facing([(0, 0.05), (2.6, 0.05), (2.6, 0.7), (0, 0.7)]), "brushed_steel")
    grip = tube([(0, 0, 0.5), (0, 0, 4), *bend((0, 0, 4.6), (0, 0, 6), (2, 0, 6)), (12, 0, 6)], 0.9, 8)
    a.add("grip_geo", grip, "brushed_steel")


@asset()
def wall_socket(a: Asset) -> None:
    a.add("plate", box((-4, -4, 0.05), (4, 4, 0.9), 0.3), "plastic_white")
    ring = _facing([(1.9, 0.9), (1.9, 1.3), (1.6, 1.3), (1.6, 0.91), (0, 0.91)])
    a.add("inset", ring, "plastic_grey")


@asset()
def light_switch(a: Asset) -> None:
    a.add("plate", box((-4, -4, 0.05), (4, 4, 0.9), 0.3), "plastic_white")
    a.add("rocker", moved(box((-2.7, -2.7, 0), (2.7, 2.7, 0.6), 0.2), by=(0, 0, 0.8), turn=(5, 0, 0)), "plastic_white")


@asset()
def radiator_panel(a: Asset) -> None:
    ribs = copies(box((-3.6, 0, 3), (3.6, 55, 9), 1.0), [(-60 + 8 * k, 0, 0) for k in range(16)])
    a.add("ribs_geo", ribs, "lacquer_white")
    rails = [tube([(-63, y, 6), (63, y, 6)], 1.6, 8) for y in (5.0, 50.0)]
    pipes = [tube([(63, 5, 6), (66, 5, 6), (66, -12.5, 6)], 0.9), box((-50, 20, 0.05), (-47, 24, 3.2))]
    a.add("pipes", merge(*rails, *pipes, box((47, 20, 0.05), (50, 24, 3.2))), "lacquer_white")
    a.add("valve/knob_geo", moved(cylinder((0, 0, 0), 2, 5, 0.4, 16), by=(66, 5, 6), turn=(0, 0, -90)), "plastic_white")
    a.subcomponents.append("valve")


def _drape(width: float, height: float, folds: float) -> Mesh:
    u, v = np.meshgrid(np.linspace(0, 1, 41), np.linspace(0, 1, 2), indexing="ij")
    wave = np.sin(2 * np.pi * folds * u) * (3.2 - 1.2 * v)
    x = (u - 0.5) * width * (1 - 0.08 * np.sin(np.pi * v))
    return sheet(np.stack([x, v * height, wave + 7], axis=2), 0.3)


@asset()
def curtain_panel(a: Asset) -> None:
    a.add("cloth_geo", _drape(46, 216, 5), "fabric_linen")


@asset()
def curtain_rod(a: Asset) -> None:
    a.add("rod", tube([(-125, 0, 7), (125, 0, 7)], 1.2, 8), "oak_dark")
    ends = [ellipsoid((x, 0, 7), (2.6, 2.4, 2.4), 12) for x in (-126.0, 126.0)]
    arms = [box((x - 1, -1.5, 0.05), (x + 1, 1.5, 6.4), 0.2) for x in (-118.0, 118.0)]
    a.add("brackets_geo", merge(*ends, *arms), "oak_dark")


def _pendant(a: Asset, radius: float, drop: float, colour: str) -> None:
    a.add("canopy", cylinder((0, -3, 0), 5, 2.95, 0.4, 20), "plastic_black")
    a.add("cord", tube([(0, -3, 0), (0, -drop, 0)], 0.35, 6), "plastic_black")
    outside = [(3, -drop), (radius * 0.55, -drop - radius * 0.25), (radius, -drop - radius * 0.9)]
    inside = [(radius - 0.5, -drop - radius * 0.9), (radius * 0.55 - 0.6, -drop - radius * 0.25 - 0.8), (0, -drop - 1)]
    profile = [(0.0, -drop), *outside, *inside]
    a.add("shade_geo", lathe(profile[::-1]), colour)
    a.add("bulb_geo", ellipsoid((0, -drop - radius * 0.45, 0), (3, 4, 3), 14), "lamp_glow")


@asset()
def pendant_large(a: Asset) -> None:
    _pendant(a, 26, 82, "enamel_teal")


@asset()
def pendant_small(a: Asset) -> None:
    _pendant(a, 13, 78, "brass")


@asset()
def wall_clock(a: Asset) -> None:
    rim = [(0, 0.05), (14.5, 0.05), (15, 0.6), (15, 3.4), (14, 3.8), (13.4, 3.4), (13.4, 2.0)]
    a.add("case_geo", _facing([*rim, (0, 2.0)]), "oak_dark")
    a.add("dial", _facing([(13.3, 2.02), (13.3, 2.1), (0, 2.1)]), "paper_white")
    ticks = []
    for hour in range(12):
        tick = facet([(-0.3, 10.8, 2.2), (0.3, 10.8, 2.2), (0.3, 12.6, 2.2), (-0.3, 12.6, 2.2)])
        ticks.append(moved(tick, turn=(0, 0, 30.0 * hour)))
    hands = [moved(box((-0.35, -1.5, 2.3), (0.35, 7.5, 2.5)), turn=(0, 0, 52))]
    hands.append(moved(box((-0.25, -1.5, 2.6), (0.25, 11, 2.8)), turn=(0, 0, -64)))
    a.add("hands", merge(*ticks, *hands), "plastic_black")


def _picture(a: Asset, width: float, height: float, frame: str, print_: str) -> None:
    x, y = width / 2, height / 2
    sides = [
        box((-x, -y, 0.05), (x, -y + 2.5, 2.2), 0.3),
        box((-x, y - 2.5, 0.05), (x, y, 2.2), 0.3),
        box((-x, -y + 2.5, 0.05), (-x + 2.5, y - 2.5, 2.2), 0.3),
        box((x - 2.5, -y + 2.5, 0.05), (x, y - 2.5, 2.2), 0.3),
    ]
    a.add("frame_geo", merge(*sides), frame)
    a.add("passepartout", box((-x + 2.5, -y + 2.5, 0.4), (x - 2.5, y - 2.5, 1.0)), "paper_white")
    a.add("print_geo", box((-x + 8, -y + 8, 1.0), (x - 8, y - 8, 1.1)), print_)


@asset()
def picture_large(a: Asset) -> None:
    _picture(a, 70, 50, "oak_dark", "print_landscape")


@asset()
def picture_small(a: Asset) -> None:
    _picture(a, 34, 44, "brass", "print_fruit")


@asset()
def chalk_board(a: Asset) -> None:
    a.add("board_geo", box((-30, -40, 0.05), (30, 40, 1.6)), "chalk_board")
    edge = [box((-32, -42, 0.05), (32, -40, 2.4), 0.3), box((-32, 40, 0.05), (32, 42, 2.4), 0.3)]
    edge += [box((-32, -40, 0.05), (-30, 40, 2.4), 0.3), box((30, -40, 0.05), (32, 40, 2.4), 0.3)]
    a.add("rim", merge(*edge), "beech")
    lines = [
        box((-24, y, 1.6), (-24 + length, y + 0.7, 1.7)) for y, length in ((26.0, 30.0), (16.0, 22.0), (6.0, 34.0))
    ]
    a.add("chalk", merge(*lines), "paper_white")


@asset()
def cooker_hood(a: Asset) -> None:
    a.looks = "mtl"
    a.add("canopy_geo", box((-30, 0, 0.05), (30, 6, 50), 0.4), "brushed_steel")
    a.add("chimney", box((-13, 9, 0.05), (13, 99.5, 26), 0.4), "brushed_steel")
    a.add("collar_LOW", box((-20, 6, 0.05), (20, 9, 34), 0.4), "brushed_steel")
    a.add(
        "buttons",
        copies(box((-1, 2, 49.9), (1, 4, 50.6), 0.2), [(-6, 0, 0), (-2, 0, 0), (2, 0, 0), (6, 0, 0)]),
        "plastic_black",
    )
    a.add("filter", box((-26, -0.4, 6), (26, 0, 46)), "plastic_grey")


@asset()
def flush_light(a: Asset) -> None:
    dome = [(0, -9), *arc((0, 6), 15, -88, -36, 6), (14, -1.5), (14, -0.05), (0, -0.05)]
    a.add("glass_dome", lathe(dome), "lamp_glow")
