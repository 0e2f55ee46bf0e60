"""Meeting corner and reception; centimetres, standing on y = 0, front towards +z."""

import numpy as np

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import merge, moved
from scenes.writer.shapes import box, cylinder, lathe, sheet, tube


@asset("ConfTable_240")
def meeting_table(a: Asset) -> None:
    a.add("top", box((-120, 71, -55), (120, 74, 55), 0.8), "oak_light")
    a.add("pedestals", merge(*(box((x, 2, -30), (x + 12, 71, 30), 0.5) for x in (-80.0, 68.0))), "steel_dark")
    a.add("feet", merge(*(box((x, 0, -42), (x + 22, 2, 42), 0.3) for x in (-85.0, 63.0))), "steel_dark")


@asset("VC_22")
def visitor_chair(a: Asset) -> None:
    """Cantilever chair: 56 wide, 86 high, 58 deep."""
    for name, x in (("frame_L", -26.0), ("frame_R", 26.0)):
        line = [(x, 1.2, -24.0), (x, 1.2, 26.0), (x, 44.0, 26.0), (x, 44.0, -20.0), (x, 84.0, -27.0)]
        a.add(name, tube(line, 1.2, 8), "chrome")
    a.add("sled", tube([(-26, 1.2, -24), (26, 1.2, -24)], 1.2, 8), "chrome")
    a.add("seat", box((-25, 43, -20), (25, 47, 25), 1.5), "fabric_petrol")
    a.add("back", moved(box((-25, 0, -1.5), (25, 36, 1.5), 1.2), by=(0, 50, -21), turn=(-10, 0, 0)), "fabric_petrol")


@asset("EPX_2600")
def projector(a: Asset) -> None:
    """Projector under the ceiling: 34 wide, 40 high, 28 deep, hanging below the origin."""
    a.add("pole", cylinder((0, -28, 0), 2, 28), "plastic_white")
    a.add("body", box((-17, -40, -14), (17, -28, 14), 1.5), "plastic_white")
    a.add("lens", moved(cylinder((0, 0, 0), 4, 3), by=(8, -34, 14), turn=(90, 0, 0)), "glass_black")


@asset("ProjScreen_220")
def projection_screen(a: Asset) -> None:
    """Roller screen pulled down: 226 wide, 150 high, hanging below the origin."""
    a.add("cassette", box((-113, -9, 1), (113, 0, 10), 0.6), "plastic_white")
    a.add("cloth", box((-108, -147, 5), (108, -9, 5.2)), "board_white")
    a.add("bottom_bar", box((-110, -150, 4), (110, -147, 6.5), 0.4), "plastic_black")


@asset("Whiteboard_180")
def whiteboard(a: Asset) -> None:
    """Whiteboard with a pen ledge: 184 wide, 122 high, its lower edge at the origin."""
    a.add("surface", box((-90, 2, 0.5), (90, 120, 2)), "board_white")
    frame = [box((x, 0, 0), (x + 2, 122, 2.6)) for x in (-92.0, 90.0)]
    frame += [box((-90, y, 0), (90, y + 2, 2.6)) for y in (0.0, 120.0)]
    a.add("frame", merge(*frame), "steel_light")
    a.add("ledge", box((-40, -0.6, 2.6), (40, 0, 9)), "steel_light")
    a.surfaces["ledge"] = 0.0


@asset("mrk_b", looks="")
def marker(a: Asset) -> None:
    """Board marker lying along x: 13 wide, 1.8 high."""
    a.add("barrel", moved(cylinder((0, 0, 0), 0.9, 9), by=(-6.5, 0.9, 0), turn=(0, 0, -90)), "plastic_white")
    a.add("cap", moved(cylinder((0, 0, 0), 0.9, 4), by=(2.5, 0.9, 0), turn=(0, 0, -90)), "enamel_red")


@asset("board_eraser", looks="", is_y_up=True)
def eraser(a: Asset) -> None:
    """Board wiper: 13 wide, 3 high, 5 deep."""
    a.add("felt", box((-6.5, 0, -2.5), (6.5, 0.8, 2.5)), "fabric_grey")
    a.add("grip", box((-6.3, 0.8, -2.3), (6.3, 3, 2.3), 0.7), "plastic_blue")


@asset("spider_conf")
def conference_phone(a: Asset) -> None:
    """Conference telephone with three arms: 32 across, 6 high."""
    a.add("hub", lathe([(0, 0), (8, 0), (8.5, 2), (6, 5.5), (0, 6)]), "plastic_black")
    arms = [moved(box((0, 0.5, -3), (17, 2.8, 3), 1.0), turn=(0, 120.0 * k + 90, 0)) for k in range(3)]
    a.add("mics", merge(*arms), "plastic_black")
    a.add("keypad", box((-3, 5, -1), (3, 6.4, 4)), "plastic_grey")


@asset("gl_25")
def tumbler(a: Asset) -> None:
    """Drinking glass: 7 across, 11 high."""
    a.add("glass", lathe([(0, 0), (2.8, 0), (3.5, 11), (3.25, 11), (2.6, 0.8), (0, 0.8)]), "glass_clear")


@asset("gl_100")
def carafe(a: Asset) -> None:
    """Water carafe: 11 across, 27 high."""
    outside = [(0, 0), (4.6, 0), (5.5, 3), (5.2, 10), (2.6, 19), (2.6, 24), (3.8, 27)]
    inside = [(3.5, 27), (2.3, 24), (2.3, 19), (4.8, 10), (5.1, 3), (4.4, 0.6), (0, 0.6)]
    a.add("glass", lathe([*outside, *inside]), "glass_clear")


@asset("wtr_05", looks="")
def water_bottle(a: Asset) -> None:
    """Small plastic water bottle: 6.5 across, 22 high."""
    outline = [(0, 0), (3, 0), (3.25, 1), (3.25, 14), (1.3, 18.5), (1.3, 20), (0, 20)]
    a.add("bottle", lathe(outline), "glass_clear")
    a.add("label", lathe([(3.3, 6), (3.32, 6), (3.32, 11), (3.3, 11), (3.3, 6)]), "carton_blue")
    a.add("cap", cylinder((0, 20, 0), 1.5, 1.8), "plastic_blue")


@asset("R_RND240")
def round_rug(a: Asset) -> None:
    a.add("pile", cylinder((0, 0, 0), 120, 1.0, segments=32), "rug_teal")


@asset("R_200x140", looks="")
def rug(a: Asset) -> None:
    a.add("pile", box((-110, 0, -80), (110, 1, 80), 0.2), "wool_rug")
    a.add("fringe", merge(*(box((x, 0, -80), (x + 4, 0.4, 80)) for x in (-114.0, 110.0))), "fabric_linen")


@asset("ReceptionDesk_L")
def reception_desk(a: Asset) -> None:
    """Reception counter with a raised front: 200 wide, 110 high, 80 deep; visitors stand at its front."""
    a.add("front", box((-100, 0, 30), (100, 106, 34), 0.4), "laminate_maple")
    a.add("ledge", box((-103, 106, 12), (103, 110, 40), 0.5), "laminate_white")
    a.add("sides", merge(*(box((x, 0, -40), (x + 4, 106, 30)) for x in (-100.0, 96.0))), "laminate_maple")
    a.add("worktop", box((-96, 71, -40), (96, 74, 30)), "laminate_white")
    a.surfaces |= {"ledge": 110.0, "work": 74.0}


@asset("LS_02")
def sofa(a: Asset) -> None:
    """Sofa for two: 160 wide, 78 high, 82 deep."""
    a.add("base", box((-80, 12, -41), (80, 28, 41), 2.0), "fabric_grey")
    a.add("cushions", merge(*(box((x, 28, -20), (x + 61, 44, 40), 4.0) for x in (-61.5, 0.5))), "fabric_grey")
    a.add("back", box((-62, 28, -41), (62, 78, -20), 5.0), "fabric_grey")
    a.add("arms", merge(*(box((x, 28, -41), (x + 18, 58, 41), 4.0) for x in (-80.0, 62.0))), "fabric_grey")
    a.add("feet", merge(*(cylinder((x, 0, z), 2, 12) for x in (-70, 70) for z in (-34, 34))), "oak_dark")
    a.surfaces["seat"] = 44.0


@asset("LS_01")
def armchair(a: Asset) -> None:
    """Tub armchair: 72 wide, 74 high, 68 deep."""
    u, v = np.meshgrid(np.linspace(0, 1, 13), np.linspace(0, 1, 3), indexing="ij")
    angle = np.pi * (1.15 - 1.3 * u)
    shell = np.stack([34 * np.cos(angle), 16 + 56 * v - 14 * v * np.abs(np.cos(angle)), -32 * np.sin(angle)], axis=2)
    a.add("shell", sheet(shell, 5), "fabric_petrol")
    a.add("seat", moved(cylinder((0, 0, 0), 29, 14), by=(0, 30, 1)), "fabric_petrol")
    a.add("legs", merge(*(cylinder((x, 0, z), 1.6, 31) for x in (-20, 20) for z in (-18, 20))), "oak_dark")


@asset("LoungeTable_80")
def coffee_table(a: Asset) -> None:
    """Low round table: 80 across, 40 high."""
    a.add("top", cylinder((0, 37, 0), 40, 3, 0.6), "oak_light")
    legs = []
    for k in range(3):
        x, z = float(np.cos(2 * np.pi * k / 3)), float(np.sin(2 * np.pi * k / 3))
        legs.append(tube([(30 * x, 0, 30 * z), (22 * x, 37, 22 * z)], 1.6))
    a.add("legs", merge(*legs), "steel_dark")


@asset("magazine_a4", has_kind=False, looks="")
def magazine(a: Asset) -> None:
    """Magazine lying flat: 21 wide, 0.6 high, 29 deep."""
    a.add("pages", box((-10.5, 0, -14.8), (10.5, 0.5, 14.8)), "paper_white")
    a.add("title_page", box((-10.5, 0.5, -14.8), (10.5, 0.6, 14.8)), "carton_red")


@asset("coat_stand_175")
def coat_rack(a: Asset) -> None:
    """Coat stand: 50 wide, 178 high."""
    a.add("foot", cylinder((0, 0, 0), 18, 3, 0.5), "steel_dark")
    a.add("pole", cylinder((0, 3, 0), 1.8, 173), "steel_dark")
    hook = [(0.0, 158.0, 0.0), (14.0, 160.0, 0.0), (20.0, 168.0, 0.0), (21.0, 174.0, 0.0)]
    a.add("hooks", merge(*(moved(tube(hook, 0.9), turn=(0, 72.0 * k, 0)) for k in range(5))), "steel_dark")


@asset("UmbrellaStand")
def umbrella_stand(a: Asset) -> None:
    a.add("tube", lathe([(0, 0), (12, 0), (12, 50), (11.4, 50), (11.4, 1), (0, 1)]), "steel_light")
    a.surfaces["inside"] = 1.0


@asset("HYG_11")
def sanitizer(a: Asset) -> None:
    """Hand sanitizer dispenser on a post: 30 wide, 128 high, 30 deep."""
    a.add("foot", box((-15, 0, -15), (15, 1, 15), 0.3), "steel_light")
    a.add("post", box((-3, 1, -6), (3, 122, -2), 0.3), "steel_light")
    a.add("dispenser", box((-6, 98, -2), (6, 124, 9), 1.5), "plastic_white")
    a.add("nozzle", cylinder((0, 96, 4), 1, 2), "plastic_blue")
    a.add("drip_tray", box((-6, 78, -2), (6, 79, 10)), "plastic_grey")
