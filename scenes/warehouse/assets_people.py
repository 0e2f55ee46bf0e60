"""Protective gear, cleaning and waste; centimetres, y up, front towards +z."""

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, pail, rod, turned
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import ellipsoid, prism, tube


@asset("HardHat_Yellow", has_kind=False)
def hard_hat(a: Asset) -> None:
    """Safety helmet."""
    a.add("shell", turned([(14, 0), (13.6, 5), (11, 10), (6, 13.4), (2, 14.2)], (0, 1.2, 0), 16), "MI_SafetyYellow")
    a.add("brim", moved(turned([(15, 0), (15, 1.2)], segments=16), by=(0, 0, 3), scale=(1, 1, 1.12)), "MI_SafetyYellow")
    a.add("ridge", block((3, 1.4, 16), (0, 14.4, 0), 0.5), "MI_SafetyYellow")


@asset("gl_pr_L", looks="", has_kind=False)
def gloves(a: Asset) -> None:
    """A pair of work gloves, lying."""
    for name, x in (("gl_l", -7.0), ("gl_r", 7.0)):
        palm = ellipsoid((x, 1.6, 0), (4.6, 1.6, 6), 8)
        fingers = [ellipsoid((x - 3.2 + 2.1 * k, 1.4, -8), (1.1, 1.2, 4.4), 8) for k in range(4)]
        cuff = block((8.4, 2.6, 7), (x, 0.2, 8), 1)
        a.add(name, merge(palm, *fingers, cuff), "glove_leather")


@asset("SafetyVest")
def vest(a: Asset) -> None:
    """High-visibility vest hanging by its shoulders."""
    flat = [prism([(2, 0), (25, 0), (25, 38), (2, 44)], 0, 2), prism([(6, 42), (22, 38), (19, 62), (8, 64)], 0, 2)]
    mirrored = [moved(m, turn=(0, 180, 0), by=(0, 0, 2)) for m in flat]
    a.add("cloth", merge(*flat, *mirrored), "hi_vis")
    bands = [block((50, 5, 2.4), (0, y, 1)) for y in (12.0, 26.0)]
    a.add("reflective_tape", merge(*bands), "reflex_silver")
    a.documentation = "Size L, two reflective bands."


@asset("Lockers_3Door")
def lockers(a: Asset) -> None:
    """Three staff lockers in one body."""
    a.add("body", block((120, 180, 50)), "steel_grey")
    a.add("doors", merge(*(block((38, 172, 1.6), (x, 4, 25.6), 0.4) for x in (-39.5, 0.0, 39.5))), "plastic_blue")
    slots = [block((18, 0.8, 0.4), (x, y, 26.5)) for x in (-39.5, 0.0, 39.5) for y in (160.0, 163.0, 166.0)]
    a.add("vents", merge(*slots), "plastic_black")
    a.add("locks", merge(*(disc((x + 14, 92, 27), 1.6, 1.6, "z", 8) for x in (-39.5, 0.0, 39.5))), "chrome")


@asset("br_030", "Besen")
def broom(a: Asset) -> None:
    """Yard broom, upright on its bristles."""
    a.add("stick", rod((0, 10, 0), (0, 148, 0), 1.3), "wood_beech")
    a.add("head", block((40, 4, 6), (0, 7, 0), 0.6), "lacquer_red")
    a.add("bristles", copies(block((2.4, 7, 5)), [(-18.0 + 4 * k, 0, 0) for k in range(10)]), "plastic_red")


@asset("Mop_Cotton")
def mop(a: Asset) -> None:
    """String mop, upright."""
    a.add("stick", rod((0, 12, 0), (0, 140, 0), 1.2), "galvanised")
    strings = [
        tube([(0, 16, 0), (2.4 * k, 12, 3 * s), (3.4 * k, 0.9, 5.0 * s)], 0.9, 5) for k in range(-3, 4) for s in (-1, 1)
    ]
    a.add("strings", merge(*strings), "paper")
    a.add("clamp", block((10, 5, 4), (0, 13, 0), 0.6), "plastic_blue")


@asset("wst_240")
def wheelie_bin(a: Asset) -> None:
    """Two-wheeled refuse bin."""
    a.add("body", moved(turned([(30, 0), (38, 92)], segments=4), turn=(0, 45, 0), by=(0, 6, 0)), "plastic_green")
    a.add("lid", block((58, 5, 66), (0, 98, 0), 1.6), "plastic_green")
    a.add("wheels", merge(*(disc((x, 9, -24), 9, 5) for x in (-24.0, 24.0))), "rubber_black")
    a.add("grip", rod((-22, 97, -34), (22, 97, -34), 1.5), "plastic_green")


@asset("wb_15", "papierkorb", looks="")
def waste_basket(a: Asset) -> None:
    """Paper basket."""
    a.add("papierkorb_geo", pail(11, 14, 30, 0.6, 16), "plastic_black")
