"""The shell of the office and objects fixed to it; centimetres, wall-hung objects have their back at z = 0."""

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import Mesh, copies, merge, moved
from scenes.writer.shapes import box, cylinder, lathe, panel, prism, sweep, tube

ROOM = (1300.0, 280.0, 960.0)
"""Clear width (x), height (y) and depth (z)."""
WALL = 15.0
WINDOWS = (70.0, 350.0, 630.0)
"""Left edges of the windows in the back wall, from its left end; they are 200 wide, 90 to 230 high."""


def facing(profile: list[tuple[float, float]], segments: int = 0) -> Mesh:
    """Return a lathe shape turned so that its axis points into the room (+z)."""
    return moved(lathe(profile, segments), turn=(90, 0, 0))


@asset("Floor_Carpet")
def floor_carpet(a: Asset) -> None:
    a.add("carpet_tiles", box((-650, -10, -480), (650, 0, 480)), "carpet_grey")
    a.surfaces["top"] = 0.0


@asset("ceiling_grid")
def ceiling_grid(a: Asset) -> None:
    """Ceiling seen from below: 1300 wide, 4 high, 960 deep."""
    slab = moved(panel((ROOM[0], ROOM[2], 4), [], open_back=True), turn=(90, 0, 0))
    a.add("tiles", moved(slab, by=(-650, 0, -480)), "ceiling_paint")


@asset("W1300_B", looks="")
def wall_back(a: Asset) -> None:
    """Wall with three window openings: 1300 wide, 280 high."""
    holes = [(x, 90.0, x + 200, 230.0) for x in WINDOWS]
    a.add("geo", panel((ROOM[0], ROOM[1], WALL), holes, open_back=True), "wall_paint")


@asset("W960", looks="")
def wall_side(a: Asset) -> None:
    """Closed wall: 960 wide, 280 high."""
    a.add("geo", panel((ROOM[2], ROOM[1], WALL), [], open_back=True), "wall_paint")


@asset("W1300_F", looks="")
def wall_front(a: Asset) -> None:
    """Wall with a door opening: 1300 wide, 280 high."""
    a.add("geo", panel((ROOM[0], ROOM[1], WALL), [(350, 0, 450, 210)], open_back=True), "wall_paint")


@asset("partition_drywall", looks="")
def partition(a: Asset) -> None:
    """Light wall: 200 wide, 280 high, 10 deep."""
    a.add("board", box((-100, 0, -5), (100, 279.5, 5)), "wall_paint")


@asset("GP300")
def glass_wall(a: Asset) -> None:
    """Glazed wall in a metal frame: 300 wide, 270 high, 6 deep."""
    frame = [box((x - 3, 0, -3), (x + 3, 270, 3)) for x in (-147.0, -49.0, 49.0, 147.0)]
    frame += [box((-144, y, -3), (144, y + 6, 3)) for y in (0.0, 264.0)]
    a.add("frame", merge(*frame), "steel_dark")
    panes = [box((x, 6, -0.6), (x + 92, 264, 0.6)) for x in (-144.0, -46.0, 52.0)]
    a.add("panes", merge(*panes), "window_glass")


@asset("A_4471", looks="")
def column(a: Asset) -> None:
    """Round column: 40 across, 279 high."""
    a.add("shaft", cylinder((0, 0, 0), 20, 279), "wall_paint")


@asset("Window_200x140")
def window(a: Asset) -> None:
    frame = [box((x, 0, -10), (x + 6, 140, -4), 0.4) for x in (0.0, 97.0, 194.0)]
    frame += [box((6, y, -10), (194, y + 6, -4), 0.4) for y in (0.0, 134.0)]
    a.add("frame", merge(*frame), "plastic_white")
    a.add("glass", box((6, 6, -7.6), (194, 134, -6.4)), "window_glass")
    a.add("handle", box((98.5, 60, -4), (101.5, 76, 0), 0.6), "chrome")


@asset("prp_0213")
def blind(a: Asset) -> None:
    """Venetian blind: 204 wide, 70 high, hanging from its head rail."""
    a.add("head_rail", box((-102, -6, 1), (102, 0, 8), 0.5), "steel_light")
    slat = moved(box((-100, -0.15, -2.4), (100, 0.15, 2.4)), by=(0, -9, 4.5), turn=(30, 0, 0))
    a.add("slats", copies(slat, [(0, -4.2 * k, 0) for k in range(14)]), "plastic_white")
    a.add("cords", copies(tube([(0, -6, 4.5), (0, -66, 4.5)], 0.15), [(-70, 0, 0), (70, 0, 0)]), "plastic_grey")
    a.add("bottom_rail", box((-100, -69, 2.5), (100, -67, 6.5), 0.4), "steel_light")


@asset("door_office_100")
def door(a: Asset) -> None:
    """Door leaf: 98 wide, 208 high, 4.5 deep, its middle at x = 0, its front at z = -3.5."""
    a.add("leaf", box((-49, 0.5, -8), (49, 208.5, -3.5), 0.3), "laminate_maple")
    a.add("pane", box((22, 60, -8.2), (36, 190, -3.3)), "window_glass")


@asset("hw_lv3", looks="")
def lever(a: Asset) -> None:
    """Door lever: 14 wide, 4 high, 6 deep."""
    a.add("rose", facing([(0, 0), (2.6, 0), (2.6, 0.8), (0, 0.8)]), "chrome")
    a.add("grip", tube([(0, 0, 0.8), (0, 0, 5), (2, 0, 6), (13, 0, 6)], 0.9, 8), "chrome")


@asset("E_0112")
def socket(a: Asset) -> None:
    """Double wall socket: 15 wide, 8 high."""
    a.add("plate", box((-7.6, -4, 0), (7.6, 4, 0.9), 0.3), "plastic_white")
    wells = [moved(facing([(0, 0), (2, 0), (2, 0.3), (0, 0.3)]), by=(x, 0, 0.9)) for x in (-3.6, 3.6)]
    a.add("wells", merge(*wells), "plastic_grey")


@asset("LightSwitch_2g")
def light_switch(a: Asset) -> None:
    """Light switch with two rockers: 8 wide, 8 high."""
    a.add("plate", box((-4, -4, 0), (4, 4, 0.8), 0.2), "plastic_white")
    a.add("rockers", merge(*(box((x, -3, 0.8), (x + 2.8, 3, 1.5), 0.3) for x in (-3.0, 0.2))), "plastic_white")


@asset("LUM_3012")
def panel_light(a: Asset) -> None:
    """Light panel on the ceiling: 120 wide, 5 high, 30 deep, hanging below the origin."""
    a.add("housing", box((-60, -4, -15), (60, 0, 15), 0.5), "steel_light")
    a.add("diffuser", box((-58, -4.8, -13), (58, -4, 13)), "led_panel")


@asset("exit_sign", is_y_up=True)
def exit_sign(a: Asset) -> None:
    """Escape route sign: 36 wide, 16 high."""
    a.add("box", box((-18, -8, 0), (18, 8, 4), 0.5), "plastic_white")
    a.add("green", box((-17, -7, 4), (17, 7, 4.3)), "sign_green")
    arrow = merge(box((-10, -1.2, 4.3), (2, 1.2, 4.5)), prism([(2, -4.5), (9, 0), (2, 4.5)], 4.3, 4.5))
    a.add("arrow", arrow, "plastic_white")


@asset("Clock_Wall_30")
def clock(a: Asset) -> None:
    """Wall clock: 30 across, 4 deep."""
    a.add("case", facing([(0, 0), (15, 0), (15, 4), (13.8, 4), (13.8, 3), (0, 3)]), "plastic_black")
    a.add("dial", facing([(0, 3.05), (13.7, 3.05), (13.7, 3.2), (0, 3.2)]), "plastic_white")
    hands = [box((-0.5, -1, 3.3), (0.5, 7.5, 3.5)), moved(box((-0.35, -1, 3.5), (0.35, 11, 3.7)), turn=(0, 0, -110))]
    a.add("hands", merge(*hands), "plastic_black")


@asset("xt_007")
def extinguisher(a: Asset) -> None:
    """Fire extinguisher: 16 across, 55 high; the origin is at its foot, its back at z = 0."""
    body = [(0.0, 0.0), (7.2, 0.0), (7.8, 1.0), (7.8, 38.0), (6.0, 42.0), (2.2, 44.0), (2.2, 47.0), (0.0, 47.0)]
    a.add("cylinder", moved(lathe(body), by=(0, 0, 9)), "enamel_red")
    a.add("valve", merge(box((-1.5, 47, 5), (1.5, 50, 13), 0.3), box((-1, 50, 5), (1, 52, 16), 0.3)), "steel_dark")
    a.add("hose", tube([(1.5, 48, 9), (6, 50, 9), (9, 40, 9), (8.7, 16, 9)], 1.1, 8), "plastic_black")
    a.add("label", sweep([(0, 14, 16.9), (0, 28, 16.9)], [(4, -0.1), (4, 0.1), (-4, 0.1), (-4, -0.1)]), "paper_white")


@asset("PictureFrame_A2")
def picture(a: Asset) -> None:
    """Framed print: 64 wide, 46 high."""
    sides = [box((x, -23, 0), (x + 2.4, 23, 2.4), 0.3) for x in (-32.0, 29.6)]
    sides += [box((-29.6, y, 0), (29.6, y + 2.4, 2.4), 0.3) for y in (-23.0, 20.6)]
    a.add("frame", merge(*sides), "oak_dark")
    a.add("print", box((-29.6, -20.6, 0.4), (29.6, 20.6, 1.0)), "print_landscape")
