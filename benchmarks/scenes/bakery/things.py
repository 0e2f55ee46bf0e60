"""Things of which the bakery has several, in several rooms."""

from math import cos, radians, sin

from benchmarks.scenes.bakery.forms import (
    Piece,
    bar,
    bent,
    block,
    bulge,
    column,
    hoop,
    hose,
    joined,
    open_box,
    orb,
    panels,
    tipped,
    turned,
    vessel,
)

__all__ = [
    "HANG",
    "bottle",
    "bow_handle",
    "caster",
    "chair",
    "croissant",
    "cup",
    "drawer",
    "fan",
    "jar",
    "jar_lid",
    "long_loaf",
    "loop_at",
    "plate",
    "price_tag",
    "sack",
    "spoon",
    "tin_loaf",
    "tray",
    "wall_hook",
]

HANG = (0.0, -0.2, 2.9)
"""Where a loop rests on a wall hook."""


def tray(w: float, d: float, rim: float = 1.5) -> Piece:
    """Return a baking tray."""
    return open_box(w, rim, d, 0.2, 0.4)


def plate(r: float) -> Piece:
    """Return a plate or a saucer, 1.6 high; things stand at 0.6 in its middle."""
    return turned([(0, 0), (r * 0.55, 0), (r, 1.4), (r, 1.6), (r * 0.6, 0.6), (0, 0.6)], 28)


def cup(r: float, h: float) -> list[Piece]:
    """Return a cup with an ear towards x."""
    ear = hose([(r * 0.9, h * 0.8, 0), (r + 2, h * 0.75, 0), (r + 2.2, h * 0.45, 0), (r * 0.85, h * 0.3, 0)], 0.4)
    return [vessel(r * 0.7, r, h, 0.3), ear]


def jar(r: float, h: float) -> Piece:
    """Return a hollow jar with a neck."""
    t = 0.3
    outside = [(0, 0), (r, 0), (r, h - 1.5), (r * 0.9, h - 1), (r * 0.9, h)]
    return turned([*outside, (r * 0.9 - t, h), (r * 0.9 - t, h - 1.2), (r - t, h - 1.7), (r - t, t), (0, t)])


def jar_lid(r: float) -> Piece:
    """Return the lid of a jar of radius r; its origin is the rim, over which it reaches down."""
    a = r * 0.9 + 0.15
    return turned([(0, 0.1), (a, 0.1), (a, -0.8), (a + 0.2, -0.8), (a + 0.2, 0.5), (0, 0.5)])


def bottle(r: float, h: float) -> Piece:
    """Return a filled bottle with its cap on."""
    neck = r * 0.4
    profile = [(0, 0), (r, 0), (r, h * 0.62), (neck, h * 0.82), (neck, h * 0.93)]
    return turned([*profile, (neck + 0.2, h * 0.93), (neck + 0.2, h), (0, h)])


def spoon(length: float) -> list[Piece]:
    """Return a spoon or a fork that lies along z, its bowl at the end."""
    return [block(0.9, 0.25, length * 0.75, (0, 0.1, -length * 0.1)), orb(1.3, (0, 0, length * 0.36), 0.25)]


def tin_loaf(w: float, h: float, d: float) -> Piece:
    """Return a loaf that was baked in a tin."""
    return bulge(w, h, d, 0.35)


def long_loaf(r: float, length: float) -> Piece:
    """Return a baguette along z that lies on y = 0."""
    return bulge(2 * r, 1.7 * r, length, 0.8, 24)


def croissant() -> Piece:
    """Return a croissant."""
    return bent(5.5, 5)


def price_tag() -> Piece:
    """Return a folded card that stands, 7 wide."""
    front = tipped(panels((-3.5, 3.5, 0, 5.4, -0.05, 0.05)), (-15, 0, 0)).to(0, 0.02, 1.4)
    back = tipped(panels((-3.5, 3.5, 0, 5.4, -0.05, 0.05)), (15, 0, 0)).to(0, 0.02, -1.4)
    return joined(front, back)


def drawer(w: float, h: float, d: float, front: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Piece:
    """Return a drawer whose front has its outer face at z = 0 and its box behind it.

    Args:
        w: the width of its box.
        h: the height of its box.
        d: the depth of its box.
        front: the width of its front, and by how much it reaches below and above the box; (0, 0, 0): like the box.
    """
    wide, below, above = front if front[0] else (w, 0.0, 0.0)
    x = w / 2
    return panels(
        (-x, x, 0, 0.6, -d, -1.8),
        (-x, -x + 1, 0.6, h, -d, -1.8),
        (x - 1, x, 0.6, h, -d, -1.8),
        (-x + 1, x - 1, 0.6, h, -d, -d + 1),
        (-wide / 2, wide / 2, -below, h + above, -1.8, 0),
    )


def bow_handle(length: float, upright: bool = False) -> Piece:
    """Return a bow of wire on a face at z = 0."""
    a = length / 2
    path = [(-a, 0, -0.1), (-a, 0, 2.6), (-a + 0.4, 0, 3), (a - 0.4, 0, 3), (a, 0, 2.6), (a, 0, -0.1)]
    return hose([(0, x, z) for x, _, z in path] if upright else path, 0.5)


def wall_hook() -> list[Piece]:
    """Return a hook on a wall at z = 0; a loop rests at HANG."""
    return [block(2.4, 6, 0.5, (0, -3, 0.35)), hose([(0, 0, 0.4), (0, -0.6, 2), (0, -0.6, 3.8), (0, 1.2, 4.8)], 0.35)]


def loop_at(big: float, small: float) -> Piece:
    """Return a ring that hangs from the origin."""
    return hoop(big, small, (0, small - big, 0))


def chair() -> list[Piece]:
    """Return a chair that looks towards z; its seat is at 46."""
    legs = [bar((x, 0, 18), (x * 0.9, 43, 16), 1.5) for x in (-18, 18)]
    posts = [bar((x, 0, -20), (x * 0.95, 44, -17), 1.5) for x in (-18, 18)]
    posts += [bar((x * 0.95, 44, -17), (x * 0.95, 86, -21), 1.4) for x in (-18, 18)]
    rest = [block(36, 9, 1.6, (0, 74, -20.6), (-5, 0, 0)), block(36, 6, 1.6, (0, 58, -19), (-5, 0, 0))]
    return [block(40, 3, 39, (0, 43, 0)), *legs, *posts, *rest]


def caster() -> list[Piece]:
    """Return a wheel in its fork, 10 high."""
    fork = [block(0.4, 6, 3, (s * 1.9, 3.6, 0)) for s in (-1, 1)]
    return [column(4, 3, (1.5, 4, 0), (0, 0, 90)), *fork, block(4.4, 0.5, 5, (0, 9.5, 0))]


def sack(w: float, h: float, d: float) -> list[Piece]:
    """Return a filled paper sack with its sewn ends."""
    ends = [block(2.4, 0.6, d * 0.8, (s * (w / 2 + 0.6), h * 0.38, 0)) for s in (-1, 1)]
    return [bulge(w, h, d, 0.4), *ends]


def fan(n: int, spread: float, length: float, r: float) -> list[Piece]:
    """Return stems that spread from the origin, with a leaf at each end."""
    parts: list[Piece] = []
    for i in range(n):
        turn, lean = radians(360 * i / n + 20 * (i % 2)), radians(spread * (0.4 + 0.6 * ((i * 7) % n) / n))
        tip = (length * sin(lean) * cos(turn), length * cos(lean), length * sin(lean) * sin(turn))
        parts += [bar((0, 0, 0), tip, r), orb(length * 0.16, (tip[0], tip[1] - length * 0.05, tip[2]), 0.35)]
    return parts
