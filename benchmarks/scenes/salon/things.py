"""Small things of the salon, modelled by script, each from the middle of its underside."""

import numpy as np

from benchmarks.scenes.salon.shapes import (
    Shape,
    ball,
    bent,
    box,
    cuboid,
    disc,
    hollow_box,
    lathe,
    merge,
    move,
    ribbon,
    rod,
    squash,
    turn,
    vessel,
)

__all__ = [
    "apron",
    "bag",
    "bin_liner",
    "bottle",
    "broom",
    "brush",
    "bucket",
    "cape",
    "card",
    "coat",
    "comb",
    "cup",
    "cushion",
    "dish_rack",
    "draped",
    "dryer_hood",
    "dustpan",
    "hair_dryer",
    "hand_shower",
    "hanger",
    "hose",
    "iron",
    "ironing_board",
    "kettle",
    "key",
    "lid",
    "magazine",
    "pendant",
    "plant",
    "plate",
    "pot",
    "roll",
    "roll_holder",
    "rolled_towel",
    "saucer",
    "scissors",
    "soap_pump",
    "spoon",
    "spot",
    "spray_bottle",
    "tap",
    "towel",
    "umbrella",
]


def bottle(radius: float, height: float, neck: float = 0.35) -> Shape:
    """Return a closed bottle."""
    shoulder = height * (1 - neck)
    return lathe(
        [
            (0, 0),
            (radius, 0.002),
            (radius, shoulder),
            (radius * 0.45, shoulder + height * 0.1),
            (radius * 0.45, height),
            (0, height),
        ]
    )


def spray_bottle() -> Shape:
    """Return a water sprayer."""
    head = merge(box(-0.012, 0.012, -0.045, 0.02, 0.19, 0.215), box(-0.005, 0.005, -0.03, -0.022, 0.15, 0.19))
    return merge(bottle(0.035, 0.19), head)


def soap_pump() -> Shape:
    """Return a bottle with a pump."""
    return merge(
        bottle(0.032, 0.14), rod("z", 0.14, 0.165, (0, 0), 0.004), box(-0.008, 0.008, -0.04, 0.01, 0.165, 0.175)
    )


def cup() -> Shape:
    """Return a cup with a handle."""
    ear = bent([(0.033, 0, 0.055), (0.055, 0, 0.05), (0.055, 0, 0.025), (0.03, 0, 0.018)], 0.004)
    return merge(vessel(0.022, 0.037, 0.065, 0.003, 0.036), ear)


def saucer() -> Shape:
    """Return a saucer with a sunk middle."""
    return lathe([(0, 0), (0.035, 0), (0.07, 0.014), (0.07, 0.017), (0.034, 0.004), (0, 0.004)])


def plate(radius: float = 0.12) -> Shape:
    """Return a plate."""
    return lathe([(0, 0), (radius * 0.6, 0), (radius, 0.02), (radius, 0.024), (radius * 0.58, 0.005), (0, 0.005)], 28)


def spoon() -> Shape:
    """Return a spoon that lies along x."""
    return merge(move(squash(ball(0.011), x=1.5, z=0.25), x=0.045), box(-0.06, 0.035, -0.003, 0.003, 0.0015, 0.0045))


def kettle() -> Shape:
    """Return a kettle on its base, with lid, spout and handle."""
    ear = bent([(0.06, 0, 0.19), (0.12, 0, 0.18), (0.12, 0, 0.08), (0.075, 0, 0.06)], 0.009)
    spout = bent([(-0.065, 0, 0.12), (-0.09, 0, 0.16), (-0.1, 0, 0.19)], 0.012)
    return merge(
        lathe([(0, 0), (0.09, 0), (0.085, 0.03), (0.078, 0.035), (0.06, 0.2), (0.02, 0.215), (0, 0.215)]), ear, spout
    )


def magazine(width: float = 0.21, depth: float = 0.28, thickness: float = 0.006) -> Shape:
    """Return a closed magazine or book."""
    return cuboid(width, depth, thickness)


def card(width: float, height: float) -> Shape:
    """Return a sheet of paper of one face, upright at y = 0, with its middle at z = 0."""
    corners = [
        (-width / 2, 0, -height / 2),
        (width / 2, 0, -height / 2),
        (width / 2, 0, height / 2),
        (-width / 2, 0, height / 2),
    ]
    return Shape(np.array(corners), [[0, 1, 2, 3]])


def comb() -> Shape:
    """Return a comb that lies along x, with its teeth."""
    teeth = [box(x - 0.0015, x + 0.0015, -0.022, 0, 0, 0.003) for x in np.linspace(-0.085, 0.085, 18)]
    return merge(box(-0.09, 0.09, 0, 0.012, 0, 0.004), *teeth)


def brush() -> Shape:
    """Return a round hairbrush that lies along x."""
    return merge(rod("x", -0.02, 0.1, (0, 0.024), 0.024), rod("x", -0.13, -0.02, (0, 0.024), 0.009))


def scissors() -> Shape:
    """Return closed scissors that lie along x."""
    rings = [
        bent(
            [(-0.06 + 0.02 * np.cos(t), s * 0.018 + 0.014 * np.sin(t), 0.003) for t in np.linspace(0, 2 * np.pi, 13)],
            0.003,
        )
        for s in (-1, 1)
    ]
    return merge(box(-0.045, 0.09, -0.006, 0.006, 0, 0.006), *rings)


def hair_dryer() -> Shape:
    """Return a hair dryer that lies on its side, the barrel along x."""
    return merge(
        rod("x", -0.09, 0.09, (0, 0.04), 0.04),
        rod("x", 0.09, 0.14, (0, 0.04), 0.025),
        rod("y", -0.15, -0.03, (0.036, -0.04), 0.016),
    )


def hanger() -> Shape:
    """Return a clothes hanger in the plane of y and z; its hook goes over a rail at the origin."""
    hook = [(0, 0.018 * np.sin(t), 0.018 * np.cos(t)) for t in np.linspace(-1.9, 1.9, 9)]
    return merge(
        bent([*hook[::-1], (0, 0, -0.05), (0, 0, -0.08)], 0.0025),
        bent(
            [(0, 0, -0.08), (0, 0.2, -0.16), (0, 0.2, -0.17), (0, -0.2, -0.17), (0, -0.2, -0.16), (0, 0, -0.08)], 0.005
        ),
    )


def cape() -> Shape:
    """Return a hairdresser's cape that hangs on a hanger at the origin."""
    return move(
        squash(
            lathe(
                [
                    (0.06, -0.07),
                    (0.2, -0.17),
                    (0.24, -0.6),
                    (0.27, -1.0),
                    (0.262, -1.0),
                    (0.23, -0.6),
                    (0.19, -0.18),
                    (0.055, -0.08),
                ]
            ),
            x=0.22,
        ),
        z=0,
    )


def coat(length: float) -> Shape:
    """Return a coat that hangs by a loop at the origin, flat towards the wall at +Y."""
    body = squash(
        lathe(
            [
                (0.05, -0.03),
                (0.17, -0.09),
                (0.21, -0.3),
                (0.24, -length),
                (0.23, -length),
                (0.2, -0.3),
                (0.16, -0.1),
                (0.045, -0.04),
            ]
        ),
        x=0.85,
        y=0.2,
    )
    sleeves = [bent([(s * 0.13, 0, -0.1), (s * 0.2, -0.01, -0.35), (s * 0.21, -0.015, -0.62)], 0.035) for s in (-1, 1)]
    loop = bent([(-0.012, 0, -0.035), (-0.012, 0, 0.0), (0, 0, 0.006), (0.012, 0, 0.0), (0.012, 0, -0.035)], 0.0025)
    return merge(body, *sleeves, loop)


def apron() -> Shape:
    """Return an apron that hangs by its neckband at the origin."""
    band = bent([(-0.08, 0, -0.22), (-0.03, 0, -0.05), (0, 0, 0.004), (0.03, 0, -0.05), (0.08, 0, -0.22)], 0.006)
    return merge(band, box(-0.12, 0.12, -0.005, 0.005, -0.45, -0.21), box(-0.26, 0.26, -0.008, 0.008, -0.95, -0.45))


def towel(width: float = 0.3, depth: float = 0.2, layers: int = 4) -> Shape:
    """Return a folded towel: a strip laid in layers."""
    line: list[tuple[float, float]] = []
    for layer in range(layers):
        z = 0.006 + 0.012 * layer
        ends = [(-depth / 2, z), (depth / 2, z)]
        line += ends if layer % 2 == 0 else ends[::-1]
    return ribbon(line, width, 0.011)


def rolled_towel(length: float = 0.3) -> Shape:
    """Return a rolled towel that lies along x."""
    return rod("x", -length / 2, length / 2, (0, 0.045), 0.045, 16)


def draped(width: float, front: float, back: float, over: float) -> Shape:
    """Return a towel over a rail at the origin, with falls in front and behind; `over` is the radius of its bend."""
    turns = [(-over * np.cos(t), over * np.sin(t)) for t in np.linspace(0, np.pi, 7)]
    return ribbon([(-over, -front), (-over, -front / 2), *turns, (over, -back / 2), (over, -back)], width, 0.007)


def cushion(width: float, depth: float) -> Shape:
    """Return a cushion."""
    return merge(squash(ball(0.5), x=width, y=depth, z=0.13), cuboid(width * 0.9, depth * 0.9, 0.05, 0.04))


def pot(radius: float, height: float) -> Shape:
    """Return a flower pot with soil."""
    return merge(vessel(radius * 0.7, radius, height, 0.006), disc(radius * 0.9, 0.005, height * 0.8))


def plant(radius: float, height: float, leaves: int = 9) -> Shape:
    """Return the leaves and the root ball of a plant; the root ball is the lowest 4 cm."""
    parts = [disc(0.03, 0.04)]
    for i in range(leaves):
        leaf = squash(ball(0.5), x=radius * 0.9, y=radius * 0.25, z=0.006)
        leaf = move(
            turn(move(leaf, x=radius * 0.45), "y", -35 - 20 * (i % 3)), z=0.04 + (height - 0.1) * (i + 1) / leaves / 1.5
        )
        parts.append(turn(leaf, "z", 137.5 * i))
    return merge(*parts, rod("z", 0.04, height * 0.7, (0, 0), 0.006))


def bucket(radius: float = 0.14, height: float = 0.27) -> Shape:
    """Return a bucket with its bail folded down."""
    angles = np.linspace(0, np.pi, 9)
    bail = bent(
        [(radius * np.cos(t), -radius * np.sin(t) * 1.04, height - 0.02 - 0.03 * np.sin(t)) for t in angles], 0.003
    )
    return merge(vessel(radius * 0.75, radius, height, 0.003), bail)


def lid(width: float, depth: float, skirt: float = 0.02) -> Shape:
    """Return a lid with a skirt that goes over the rim; the skirt ends at z = 0."""
    return turn(move(hollow_box(width, depth, skirt, 0.003), z=-skirt), "x", 180)


def bag(width: float, depth: float, height: float) -> Shape:
    """Return an open bag with two handles."""
    handles = [
        bent(
            [
                (-width * 0.2, y, height - 0.03),
                (-width * 0.18, y, height + 0.12),
                (width * 0.18, y, height + 0.12),
                (width * 0.2, y, height - 0.03),
            ],
            0.006,
        )
        for y in (-depth / 2, depth / 2)
    ]
    return merge(hollow_box(width, depth, height, 0.004), *handles)


def bin_liner(radius: float, height: float) -> Shape:
    """Return a bag in a bin, of a single skin, folded over the rim."""
    return lathe(
        [
            (radius * 1.12, height * 0.85),
            (radius * 1.1, height),
            (radius * 0.95, height - 0.004),
            (radius * 0.7, 0.004),
            (0, 0),
        ]
    )


def broom() -> Shape:
    """Return a broom, upright on its bristles."""
    return merge(cuboid(0.34, 0.06, 0.09), rod("z", 0.09, 1.4, (0, 0), 0.012))


def dustpan() -> Shape:
    """Return a dustpan, hanging by the end of its handle at the origin."""
    ring = bent([(0.012 * np.cos(t), 0, 0.012 * np.sin(t) - 0.008) for t in np.linspace(0, 2 * np.pi, 11)], 0.003)
    return merge(
        ring,
        box(-0.012, 0.012, -0.008, 0.004, -0.16, -0.02),
        box(-0.11, 0.11, -0.004, 0.004, -0.4, -0.16),
        box(-0.11, 0.11, -0.05, 0.004, -0.17, -0.16),
    )


def umbrella() -> Shape:
    """Return a rolled umbrella, upright on its tip."""
    crook = bent([(0, 0, 0.7), (0, 0, 0.84), (0.02, 0, 0.87), (0.05, 0, 0.87), (0.065, 0, 0.84)], 0.008)
    return merge(lathe([(0.003, 0), (0.006, 0.08), (0.03, 0.55), (0.012, 0.68), (0.006, 0.72)]), crook)


def hose(path: list[tuple[float, float, float]]) -> Shape:
    """Return a hose along a path."""
    return bent(path, 0.008)


def hand_shower() -> Shape:
    """Return a hand shower, upright with its head on top, tilted towards -Y."""
    return merge(rod("z", 0, 0.17, (0, 0), 0.011), move(turn(disc(0.035, 0.025), "x", 60), y=-0.01, z=0.16))


def tap() -> Shape:
    """Return a tap with a lever and a spout towards -Y."""
    spout = bent([(0, 0, 0.1), (0, -0.03, 0.2), (0, -0.09, 0.21), (0, -0.13, 0.17)], 0.011)
    return merge(disc(0.025, 0.11), spout, box(0.02, 0.075, -0.007, 0.007, 0.085, 0.1))


def pendant(drop: float) -> Shape:
    """Return a lamp that hangs from a ceiling at z = 0."""
    shade = lathe([(0.02, 0.2), (0.05, 0.2), (0.19, 0.0), (0.185, 0.0), (0.045, 0.195)])
    return merge(
        disc(0.05, 0.025, -0.025),
        rod("z", -drop + 0.2, -0.02, (0, 0), 0.003),
        move(shade, z=-drop),
        move(ball(0.03), z=-drop + 0.08),
    )


def spot() -> Shape:
    """Return a spot lamp below a track at z = 0."""
    return merge(
        box(-0.02, 0.02, -0.015, 0.015, -0.02, 0),
        rod("z", -0.07, -0.02, (0, 0), 0.006),
        move(turn(lathe([(0.03, -0.12), (0.03, 0), (0, 0)]), "x", 35), z=-0.06),
    )


def dryer_hood() -> Shape:
    """Return a hood dryer on a stand with five castors."""
    feet = [turn(box(0, 0.3, -0.015, 0.015, 0.05, 0.075), "z", 72 * i) for i in range(5)]
    wheels = [turn(move(rod("y", -0.01, 0.01, (0.025, 0), 0.025), x=0.28), "z", 72 * i) for i in range(5)]
    hood = turn(
        lathe([(0.17, 0), (0.19, 0.12), (0.13, 0.25), (0, 0.28), (0, 0.27), (0.12, 0.24), (0.18, 0.12), (0.165, 0)]),
        "x",
        -15,
    )
    return merge(
        *feet,
        *wheels,
        rod("z", 0.05, 1.25, (0, 0), 0.016),
        box(-0.03, 0.03, -0.2, 0.02, 1.2, 1.25),
        move(hood, y=-0.22, z=1.08),
    )


def roll(radius: float = 0.055, length: float = 0.1) -> Shape:
    """Return a roll of paper that stands, with its hole."""
    return lathe([(0.02, 0), (radius, 0), (radius, length), (0.02, length), (0.02, 0)])


def roll_holder() -> Shape:
    """Return a holder for a roll: a plate at the wall at y = 0, and a pin along x at z = 0."""
    return merge(
        box(-0.09, -0.07, -0.008, 0, -0.02, 0.02),
        bent([(-0.08, 0, 0), (-0.08, -0.065, 0), (-0.075, -0.07, 0), (0.06, -0.07, 0)], 0.007),
    )


def iron() -> Shape:
    """Return an iron on its sole."""
    ear = bent([(-0.1, 0, 0.07), (-0.09, 0, 0.13), (0.03, 0, 0.13), (0.06, 0, 0.07)], 0.012)
    return merge(squash(lathe([(0, 0), (0.055, 0), (0.05, 0.05), (0.02, 0.08), (0, 0.08)]), x=2.2), ear)


def ironing_board() -> Shape:
    """Return a folded ironing board, upright on its end, with its legs at +Y."""
    legs = [bent([(x, 0.045, 0.0), (x, 0.04, 1.15)], 0.01) for x in (-0.12, 0.12)]
    return merge(box(-0.17, 0.17, -0.015, 0.02, 0.03, 1.25), box(-0.1, 0.1, -0.015, 0.02, 1.25, 1.38), *legs)


def dish_rack() -> Shape:
    """Return a rack of wire: a rim, feet, and bars between which plates stand."""
    bars = [
        bent([(x, -0.12, 0.1), (x, -0.1, 0.02), (x, 0.1, 0.02), (x, 0.12, 0.1)], 0.003)
        for x in np.linspace(-0.18, 0.18, 10)
    ]
    rim = bent(
        [(-0.19, -0.12, 0.1), (0.19, -0.12, 0.1), (0.19, 0.12, 0.1), (-0.19, 0.12, 0.1), (-0.19, -0.12, 0.1)], 0.004
    )
    feet = [rod("z", 0, 0.1, (x, y), 0.005) for x in (-0.18, 0.18) for y in (-0.12, 0.12)]
    return merge(*bars, rim, *feet)


def key() -> Shape:
    """Return a key that hangs by its ring at the origin."""
    ring = bent([(0.009 * np.cos(t), 0, 0.009 * np.sin(t) - 0.004) for t in np.linspace(0, 2 * np.pi, 11)], 0.0015)
    return merge(ring, box(-0.004, 0.004, -0.001, 0.001, -0.06, -0.013))
