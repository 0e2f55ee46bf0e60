"""Fitted kitchen units and storage; centimetres, back at z = 0, standing on y = 0."""

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import Point2, bend, box, circle, cylinder, lathe, panel, sweep, tube

BASE_DEPTH = 56.0
BASE_HEIGHT = 86.0
BOARD = 1.6


def _bow_handle(length: float, reach: float = 3.0) -> Mesh:
    """Return a horizontal bow handle on a front at z = 0."""
    x = length / 2
    left = bend((-x, 0, 0), (-x, 0, reach), (-x + reach, 0, reach), 4)
    right = bend((x - reach, 0, reach), (x, 0, reach), (x, 0, 0), 4)
    return tube([*left, *right], 0.55)


def _base_carcass(a: Asset, width: float, closed_top: bool) -> None:
    x = width / 2 - 0.05
    depth, floor = BASE_DEPTH, 10.0
    sides = [box((-x, floor, 0), (-x + BOARD, BASE_HEIGHT, depth)), box((x - BOARD, floor, 0), (x, BASE_HEIGHT, depth))]
    inner = x - BOARD
    bottom = box((-inner, floor, 0), (inner, floor + BOARD, depth))
    back = box((-inner, floor + BOARD, 0.0), (inner, BASE_HEIGHT, 0.8))
    top = BASE_HEIGHT - BOARD
    if closed_top:
        tops = [box((-inner, top, 0.8), (inner, BASE_HEIGHT, depth))]
    else:
        tops = [
            box((-inner, top, 0.8), (inner, BASE_HEIGHT, 4)),
            box((-inner, top, depth - 4), (inner, BASE_HEIGHT, depth)),
        ]
    a.add("carcass_geo", merge(*sides, bottom, back, *tops), "lacquer_white")
    a.add("plinth", box((-x, 0, 4), (x, floor, depth - 6)), "plastic_black")
    a.surfaces["inside"] = floor + BOARD


@asset()
def base_carcass_60(a: Asset) -> None:
    _base_carcass(a, 60, True)


@asset()
def base_carcass_40(a: Asset) -> None:
    _base_carcass(a, 40, True)


@asset()
def sink_carcass_80(a: Asset) -> None:
    _base_carcass(a, 80, False)


@asset()
def drawer_60(a: Asset) -> None:
    a.looks = "mtl"
    a.add("front_geo", box((-29.7, 0, 0), (29.7, 25, 2), 0.3), "lacquer_sage")
    x, wall, low, high, back = 27.0, 1.2, 3.0, 19.0, -50.0
    sides = [box((-x, low, back), (-x + wall, high, 0)), box((x - wall, low, back), (x, high, 0))]
    ends = [box((-x + wall, low, back), (x - wall, high, back + wall))]
    bottom = box((-x + wall, low, back + wall), (x - wall, low + wall, 0))
    a.add("box_geo", merge(*sides, *ends, bottom), "beech")
    a.add("handle/bow_geo", moved(_bow_handle(18), by=(0, 18, 2)), "brushed_steel")
    a.subcomponents.append("handle")
    a.surfaces["inside"] = low + wall


@asset()
def base_door_40(a: Asset) -> None:
    a.looks = "mtl"
    a.add("front_geo", box((-19.7, 0, 0), (19.7, 75.6, 2), 0.3), "lacquer_sage")
    a.add("handle/bow_geo", moved(_bow_handle(18), by=(0, 68, 2)), "brushed_steel")
    a.subcomponents.append("handle")


@asset()
def counter_top(a: Asset) -> None:
    slab = moved(panel((360, 60, 3.9), [(136, 10, 184, 49)]), turn=(-90, 0, 0))
    a.add("worktop_geo", moved(slab, by=(-180, 3.9, 60)), "stone_dark")
    a.add("upstand", box((-180, 3.9, 0), (180, 9, 1.4), 0.3), "stone_dark")
    a.surfaces["top"] = 3.9


@asset()
def sink_basin(a: Asset) -> None:
    outer, inner, depth = (27.0, 22.0), (23.0, 18.5), -18.0
    rim = moved(panel((54, 44, 0.5), [(4, 3.5, 50, 40.5)]), turn=(-90, 0, 0))
    a.add("rim_geo", moved(rim, by=(-outer[0], 0.5, outer[1])), "brushed_steel")
    x, z = inner
    walls = [
        box((-x - 0.4, depth, -z - 0.4), (-x, 0, z + 0.4)),
        box((x, depth, -z - 0.4), (x + 0.4, 0, z + 0.4)),
        box((-x, depth, -z - 0.4), (x, 0, -z)),
        box((-x, depth, z), (x, 0, z + 0.4)),
        box((-x, depth, -z), (x, depth + 0.4, z)),
    ]
    a.add("basin_geo", merge(*walls), "brushed_steel")
    drain: list[Point2] = [(0, 0), (4, 0), (4, 0.3), (2.6, 0.15), (0, 0.15)]
    a.add("drain", moved(lathe(drain), by=(0, depth + 0.4, 0)), "chrome")
    a.surfaces["inside"] = depth + 0.4


@asset()
def tap_swan(a: Asset) -> None:
    foot: list[Point2] = [(0, 0), (2.6, 0), (2.6, 0.8), (1.9, 1.4), (1.9, 7), (1.2, 8), (0, 8)]
    a.add("foot_geo", lathe(foot), "chrome")
    rise = [(0.0, y, 0.0) for y in (7.5, 14.0, 22.0)]
    over = bend((0, 24, 0), (0, 35, 0), (0, 34, 9), 6) + bend((0, 34, 10), (0, 34, 18), (0, 25, 18), 6)
    a.add("spout_geo", tube([*rise, *over], 1.1, 8), "chrome")
    a.add("lever/stick", tube([(1.5, 5, 0), (4, 5.6, 0), (9, 9, 0)], 0.6), "chrome")
    a.subcomponents.append("lever")


def _wall_carcass(a: Asset, width: float) -> None:
    x, height, depth = width / 2 - 0.05, 70.0, 33.0
    inner = x - BOARD
    boards = [box((-x, 0, 0), (-x + BOARD, height, depth)), box((x - BOARD, 0, 0), (x, height, depth))]
    boards += [box((-inner, y, 0), (inner, y + BOARD, depth)) for y in (0.0, height - BOARD)]
    boards.append(box((-inner, 34, 0.8), (inner, 34 + BOARD, depth - 2)))
    boards.append(box((-inner, BOARD, 0), (inner, height - BOARD, 0.8)))
    a.add("carcass_geo", merge(*boards), "lacquer_white")
    a.surfaces.update(bottom=BOARD, shelf=34 + BOARD)


@asset()
def wall_carcass_60(a: Asset) -> None:
    _wall_carcass(a, 60)


@asset()
def wall_carcass_40(a: Asset) -> None:
    _wall_carcass(a, 40)


def _wall_door(a: Asset, width: float) -> None:
    a.looks = "mtl"
    x = width / 2 - 0.25
    a.add("front_geo", box((-x, 0.2, 0), (x, 69.8, 2), 0.3), "lacquer_sage")
    a.add("field_LOW", box((-x + 5, 6, 2), (x - 5, 64, 2.4), 0.3), "lacquer_sage")


@asset()
def wall_door_30(a: Asset) -> None:
    _wall_door(a, 30)


@asset()
def wall_door_40(a: Asset) -> None:
    _wall_door(a, 40)


@asset()
def knob_round(a: Asset) -> None:
    profile: list[Point2] = [(0, 0), (0.7, 0), (0.6, 1.2), (1.5, 2.0), (1.6, 2.6), (1.0, 3.1), (0, 3.2)]
    a.add("knob_geo", moved(lathe(profile), turn=(90, 0, 0)), "brass")


def _boards(width: float, depth: float, heights: list[float], thick: float) -> list[Mesh]:
    x = width / 2
    return [box((-x, y - thick, 0), (x, y, depth), 0.2) for y in heights]


@asset()
def wall_shelf_40(a: Asset) -> None:
    heights = [2.0, 34.0]
    a.add("boards_geo", merge(*_boards(35.6, 24, heights, 2)), "oak_light")
    a.add("sides", merge(box((-19.8, 0, 0), (-17.8, 60, 24), 0.2), box((17.8, 0, 0), (19.8, 60, 24), 0.2)), "oak_light")
    a.surfaces.update(low=2.0, high=34.0)


@asset()
def pantry_shelf(a: Asset) -> None:
    heights = [10.0, 48.0, 86.0, 124.0, 162.0, 200.0]
    a.add("boards_geo", merge(*_boards(76, 35, heights, 2)), "oak_light")
    posts = [box((x, 0, z), (x + 2, 204, z + 4), 0.2) for x in (-40.0, 38.0) for z in (0.0, 31.0)]
    a.add("uprights_geo", merge(*posts), "oak_light")
    a.surfaces.update({f"s{k}": y for k, y in enumerate(heights)})


@asset()
def sideboard(a: Asset) -> None:
    a.add("corpus_geo", box((-60, 14, 0.1), (60, 82, 40), 0.4), "oak_dark")
    a.add("top_geo", box((-62, 82, 0.1), (62, 85, 43), 0.5), "oak_dark")
    feet = copies(
        moved(lathe([(0, 0), (1.6, 0), (2.6, 14), (0, 14)])), [(-54, 0, 5), (54, 0, 5), (-54, 0, 35), (54, 0, 35)]
    )
    a.add("feet", feet, "oak_dark")
    for name, x in (("doorL", -39.5), ("doorM", 0.0), ("doorR", 39.5)):
        a.add(f"{name}/front_geo", box((x - 19, 16, 40), (x + 19, 80, 41.6), 0.4), "oak_dark")
        grip = moved(lathe([(0, 0), (0.8, 0), (1.5, 2), (0, 2.4)]), by=(x + 14, 48, 41.6), turn=(90, 0, 0))
        a.add(f"{name}/knob", grip, "brass")
        a.subcomponents.append(name)


@asset()
def spice_rack(a: Asset) -> None:
    boards = [box((-18, 0, 0.05), (18, 1, 8)), box((-18, 1, 0.05), (18, 14, 1))]
    sides = [box((-19, 0, 0.05), (-18, 14, 8), 0.2), box((18, 0, 0.05), (19, 14, 8), 0.2)]
    a.add("rack_geo", merge(*boards, *sides), "beech")
    a.add("rail", tube([(-18, 5, 7.4), (18, 5, 7.4)], 0.4), "brass")
    a.surfaces["inside"] = 1.0


@asset()
def wine_rack(a: Asset) -> None:
    cell, wall, depth = 10.0, 1.0, 22.0
    width = 3 * cell + 4 * wall
    sheets = [
        box((-width / 2 + k * (cell + wall), 0, 0), (-width / 2 + k * (cell + wall) + wall, 2 * cell + 3 * wall, depth))
        for k in range(4)
    ]
    for row in range(3):
        for k in range(3):
            x = -width / 2 + wall + k * (cell + wall)
            sheets.append(box((x, row * (cell + wall), 0), (x + cell, row * (cell + wall) + wall, depth)))
    a.add("rack_LOW", merge(*sheets), "oak_dark")
    a.surfaces.update(low=wall, high=2 * wall + cell)


@asset()
def dish_rack(a: Asset) -> None:
    ring = [(-17.0, 0.5, -13.0), (17.0, 0.5, -13.0), (17.0, 0.5, 13.0), (-17.0, 0.5, 13.0)]
    upper = [(x, 11.0, z) for x, _, z in ring]
    wires = [tube(ring, 0.4, 6, closed=True), tube(upper, 0.4, 6, closed=True)]
    wires += [tube([(x, 0.5, z), (x, 11, z)], 0.3, 6) for x in (-17.0, 17.0) for z in (-13.0, 0.0, 13.0)]
    for k in range(8):
        x = -14.0 + 4 * k
        wires.append(sweep([(x, 0.9, -13), (x, 0.9, 13)], circle(0.25, 5)))
        wires += [tube([(x, 0.9, z), (x, 6, z)], 0.25, 5) for z in (-5.0, 5.0)]
    # Two cross wires carry the plates: a 19 cm plate stays clear of what the rack stands on.
    wires += [tube([(-17, 1.0, z), (17, 1.0, z)], 0.25, 6) for z in (-4.0, 4.0)]
    a.add("wire_geo", merge(*wires), "chrome")
    a.add(
        "feet",
        copies(cylinder((0, 0, 0), 0.8, 0.4, 0, 10), [(x, 0, z) for x in (-16, 16) for z in (-12, 12)]),
        "plastic_black",
    )
    a.surfaces["inside"] = 0.39
