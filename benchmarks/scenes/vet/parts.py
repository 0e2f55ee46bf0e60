"""Things that several rooms have, each as parts with the middle of its base at the origin."""

from math import cos, pi, sin

from benchmarks.scenes.vet.shapes import Part, ball, box, crate, cup, cyl, lathe, moved, rod, slabs, strip, tube

__all__ = [
    "bag",
    "bar_handle",
    "basket",
    "bin_can",
    "bottle",
    "carcass",
    "carrier",
    "drawer",
    "garment",
    "hook",
    "lidded",
    "mug",
    "open_box",
    "plate",
    "seat",
    "towel",
    "wheels",
]


def bottle(r: float, h: float) -> Part:
    """Return a bottle with its cap, a solid."""
    return lathe([(0, 0), (r, 0), (r, 0.62 * h), (0.4 * r, 0.78 * h), (0.4 * r, 0.85 * h), (0.5 * r, h), (0, h)])


def lidded(r: float, h: float) -> list[Part]:
    """Return a knobbed lid that lies on a jar of radius r and reaches 6 mm into it."""
    return [cyl(r + 1, 5, (0, 0, h)), cyl(r - 5, 6, (0, 0, h - 6)), ball(8, (0, 0, h + 4))]


def mug(r: float = 40, h: float = 92) -> list[Part]:
    """Return a mug with its handle along +x."""
    loop = [(r - 2 + 30 * sin(pi * i / 8), 0, 48 - 30 * cos(pi * i / 8)) for i in range(9)]
    return [cup(r, r, h, 3.5), tube(loop, 4.5, 6)]


def plate(r: float, h: float = 18) -> Part:
    """Return a plate with a sloping rim."""
    return lathe([(0, 0), (0.6 * r, 0), (r, h), (r, h + 3), (0.6 * r, 4), (0, 4)], 28)


def drawer(w: float, d: float, h: float, front: float, low: float = 10, t: float = 8) -> Part:
    """Return a drawer whose front plate, `front` wide, is before y = 0 and reaches `low` below its box."""
    x = w / 2
    return slabs(
        (-x, x, 0, d, 0, t),
        (-x, -x + t, 0, d, t, h),
        (x - t, x, 0, d, t, h),
        (-x + t, x - t, d - t, d, t, h),
        (-front / 2, front / 2, -18, 0, -low, h + 20),
    )


def carcass(w: float, d: float, low: float, high: float, *uprights: float, t: float = 18) -> Part:
    """Return a cabinet without fronts: back at y = d, a plinth below, panels also at the given x."""
    x = w / 2
    sides = [(at - t / 2, at + t / 2, 0, d - t, low + t, high) for at in (-x + t / 2, *uprights, x - t / 2)]
    plinth = [] if low <= 0 else [(-x + 5, x - 5, 50, d - 5, 0, low)]
    return slabs((-x, x, 0, d, low, low + t), (-x, x, d - t, d, low + t, high), *sides, *plinth)


def bar_handle(length: float, upright: bool = False) -> list[Part]:
    """Return a bar that stands 28 mm out of a front at y = 0."""
    x = length / 2
    parts = [
        rod((-x, -28, 0), (x, -28, 0), 5),
        *(rod((s * (x - 15), -28, 0), (s * (x - 15), 0, 0), 4) for s in (-1, 1)),
    ]
    return [moved(part, rot=(0, 90, 0)) for part in parts] if upright else parts


def hook(reach: float = 40) -> list[Part]:
    """Return a hook with a plate at y = 0; its lowest inner point is at y = -reach / 2, z = 4."""
    r = reach / 2
    arc = [(0, -r + r * cos(pi * i / 8), -r * sin(pi * i / 8) + r) for i in range(9)]
    return [box(24, 6, 70, (0, -3, 0)), tube([(0, -4, r + 12), *arc, (0, -2 * r, r + 18)], 4, 6)]


def seat(h: float = 450, w: float = 440) -> list[Part]:
    """Return a chair with its back towards +y."""
    x = w / 2 - 25
    legs = [rod((sx * x, sy * x, 0), (sx * x, sy * x, h - 10), 11) for sx in (-1, 1) for sy in (-1, 1)]
    posts = [rod((sx * x, x, h - 10), (sx * x, x + 60, h + 380), 10) for sx in (-1, 1)]
    return [box(w, w, 22, (0, 0, h - 22)), *legs, *posts, box(w - 30, 16, 200, (0, x + 38, h + 180), (-8, 0, 0))]


def wheels(x: float, y: float, r: float = 30) -> list[Part]:
    """Return four castors at the corners of a frame whose posts begin above them."""
    return [moved(cyl(r, 22, (0, 0, -11)), (sx * x, sy * y, r), (0, 90, 0)) for sx in (-1, 1) for sy in (-1, 1)]


def open_box(w: float, d: float, h: float) -> list[Part]:
    """Return a carton with four flaps that stand open."""
    flaps = [moved(box(w, 3, h / 3), (0, s * d / 2, h - 2), (-s * 40, 0, 0)) for s in (-1, 1)]
    return [crate(w, d, h, 4), *flaps]


def basket(w: float, d: float, h: float) -> Part:
    """Return a basket that is wider at its top."""
    return crate(w, d, h, 6, 18)


def bin_can(r: float, h: float) -> Part:
    """Return a round waste bin."""
    return cup(r * 0.8, r, h, 4, 24)


def towel(front: float, back: float, width: float, r: float = 14) -> Part:
    """Return a towel that hangs over a rod of radius r - 3 along y through the origin."""
    arc = [(-r * cos(pi * i / 8), r * sin(pi * i / 8)) for i in range(9)]
    return strip([(-r - 4, -front), (-r - 1, -front / 2), *arc, (r + 3, -back / 2), (r + 1, -back)], width, 6)


def bag(w: float, d: float, h: float) -> list[Part]:
    """Return an open shopping bag with two loops for its handles."""
    loops = [
        tube([(-w / 4, y, h - 5), (-w / 5, y, h + 90), (0, y, h + 125), (w / 5, y, h + 90), (w / 4, y, h - 5)], 5)
        for y in (-d / 2 + 4, d / 2 - 4)
    ]
    return [crate(w, d, h, 5), *loops]


def garment(w: float, h: float) -> list[Part]:
    """Return a coat or apron that hangs by a loop whose top is at the origin, 34 mm thick."""
    loop = tube([(-12, 0, -36), (-9, 0, -8), (-5, 0, -1), (0, 0, 1), (5, 0, -1), (9, 0, -8), (12, 0, -36)], 2.5, 6)
    return [loop, box(w * 0.6, 26, 60, (0, 0, -92)), box(w, 34, h - 90, (0, 0, -h))]


def carrier() -> list[Part]:
    """Return a hollow carrier whose grille is before y = -250."""
    shell = slabs(
        (-220, 220, -250, 250, 0, 6),
        (-220, -214, -250, 250, 6, 330),
        (214, 220, -250, 250, 6, 330),
        (-214, 214, 244, 250, 6, 330),
        (-214, 214, -250, 250, 324, 330),
        (-214, -120, -250, -244, 6, 324),
        (120, 214, -250, -244, 6, 324),
        (-120, 120, -250, -244, 6, 40),
        (-120, 120, -250, -244, 290, 324),
    )
    grip = tube([(-70, 0, 334), (-62, 36, 335), (62, 36, 335), (70, 0, 334)], 6)
    bars = [rod((x, -252, 30), (x, -252, 300), 3) for x in range(-105, 106, 35)]
    return [shell, grip, *bars, rod((-122, -252, 160), (122, -252, 160), 3)]
