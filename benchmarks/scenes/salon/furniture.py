"""Furniture of the salon, modelled by script. Fronts look towards -Y; what hangs at a wall has its back at y = 0."""

from collections.abc import Sequence

import numpy as np

from benchmarks.scenes.salon.shapes import (
    Shape,
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
)

__all__ = [
    "basin",
    "bench",
    "board",
    "bracket_shelf",
    "carcass",
    "chair_of_salon",
    "coat_rail",
    "counter",
    "curtain",
    "door_leaf",
    "drawer",
    "drying_rack",
    "frame",
    "hook_rail",
    "ladder",
    "metal_rack",
    "pull",
    "sink",
    "toilet",
    "toilet_lid",
    "trolley_frame",
    "wash_chair",
    "wash_stand",
    "window",
    "worktop",
]


def carcass(
    width: float,
    depth: float,
    height: float,
    boards: Sequence[float],
    wall: float = 0.018,
    *,
    back: bool = True,
    top: bool = True,
) -> Shape:
    """Return a cabinet without front, with boards whose tops are at the given heights.

    Without a top, it has two stretchers for a worktop.
    """
    inner = width / 2 - wall
    parts = [
        box(-width / 2, -inner, -depth / 2, depth / 2, 0, height),
        box(inner, width / 2, -depth / 2, depth / 2, 0, height),
        box(-inner, inner, -depth / 2, depth / 2, 0, wall),
        *(
            box(-inner, inner, y0, y1, height - wall, height)
            for y0, y1 in (
                [(-depth / 2, depth / 2)] if top else [(-depth / 2, -depth / 2 + 0.05), (depth / 2 - 0.05, depth / 2)]
            )
        ),
        *(box(-inner, inner, -depth / 2 + 0.01, depth / 2 - 0.006, top - wall, top) for top in boards),
    ]
    if back:
        parts.append(box(-inner, inner, depth / 2 - 0.006, depth / 2, wall, height - wall))
    return merge(*parts)


def metal_rack(width: float, depth: float, height: float, boards: Sequence[float]) -> Shape:
    """Return a rack of four posts and boards, open on all sides."""
    posts = [
        move(cuboid(0.03, 0.03, height), x, y)
        for x in (-width / 2 + 0.015, width / 2 - 0.015)
        for y in (-depth / 2 + 0.015, depth / 2 - 0.015)
    ]
    return merge(*posts, *(cuboid(width - 0.004, depth - 0.004, 0.025, top - 0.025) for top in boards))


def door_leaf(width: float, height: float, thickness: float = 0.018) -> Shape:
    """Return a door leaf from its hinge at the origin along +X."""
    return box(0, width, -thickness, 0, 0, height)


def pull(length: float, axis: str = "z") -> Shape:
    """Return a bow handle that sticks out towards -Y."""
    bow = bent(
        [(0, 0, 0), (0, -0.028, 0), (0, -0.03, 0.006), (0, -0.03, length - 0.006), (0, -0.028, length), (0, 0, length)],
        0.005,
    )
    return move(bow, z=-length / 2) if axis == "z" else turn(move(bow, z=-length / 2), "y", 90)


def drawer(width: float, depth: float, height: float, front: float) -> Shape:
    """Return an open drawer with a front of height `front`, whose face is at y = 0."""
    tray = move(hollow_box(width - 0.03, depth, height, 0.01), y=depth / 2 + 0.012, z=0.012)
    return merge(tray, box(-width / 2, width / 2, 0, 0.016, 0, front))


def board(width: float, depth: float, thickness: float) -> Shape:
    """Return a board with its back at y = 0, its top at z = 0."""
    return box(-width / 2, width / 2, -depth, 0, -thickness, 0)


def bracket_shelf(width: float, depth: float) -> Shape:
    """Return a wall shelf on two angles, as one mesh, with its top at z = 0."""
    angles = [
        merge(
            box(x - 0.012, x + 0.012, -0.004, 0, -0.17, -0.02),
            box(x - 0.012, x + 0.012, -depth * 0.8, 0, -0.024, -0.02),
        )
        for x in (-width * 0.35, width * 0.35)
    ]
    return merge(board(width, depth, 0.02), *angles)


def frame(width: float, height: float, depth: float = 0.025, border: float = 0.03) -> Shape:
    """Return a framed pane: a mirror or a picture, with its underside at z = 0."""
    half = width / 2
    return merge(
        box(-half, half, -depth, 0, 0, border),
        box(-half, half, -depth, 0, height - border, height),
        box(-half, -half + border, -depth, 0, border, height - border),
        box(half - border, half, -depth, 0, border, height - border),
        box(-half + border, half - border, -depth * 0.6, 0, border, height - border),
    )


def chair_of_salon() -> Shape:
    """Return a styling chair: a foot, a column, a seat with arms and a back, a footrest."""
    arms = [
        merge(box(x - 0.03, x + 0.03, -0.22, 0.2, 0.62, 0.66), box(x - 0.015, x + 0.015, 0.02, 0.1, 0.48, 0.62))
        for x in (-0.29, 0.29)
    ]
    rest = bent([(-0.17, -0.2, 0.42), (-0.17, -0.42, 0.2), (0.17, -0.42, 0.2), (0.17, -0.2, 0.42)], 0.012)
    back = move(turn(cuboid(0.5, 0.07, 0.46), "x", -10), y=0.22, z=0.52)
    return merge(disc(0.29, 0.03), disc(0.05, 0.39, 0.03), cuboid(0.54, 0.5, 0.12, 0.4), back, rest, *arms)


def wash_chair() -> Shape:
    """Return the reclined chair in front of a wash stand."""
    back = move(turn(cuboid(0.52, 0.08, 0.55), "x", -28), y=0.22, z=0.42)
    arms = [box(x - 0.04, x + 0.04, -0.25, 0.25, 0.28, 0.62) for x in (-0.3, 0.3)]
    return merge(cuboid(0.56, 0.6, 0.28), cuboid(0.52, 0.6, 0.14, 0.28), back, *arms)


def wash_stand() -> Shape:
    """Return the column below a wash basin."""
    return merge(cuboid(0.34, 0.3, 0.78), cuboid(0.4, 0.36, 0.02))


def basin(width: float, depth: float, height: float) -> Shape:
    """Return a basin of one skin with a wide rim at its back."""
    half, near, far = width / 2 - 0.03, -depth / 2 + 0.03, depth / 2 - 0.1
    bottom = [
        (x, y, 0.03)
        for x, y in (
            (-half * 0.6, near * 0.6),
            (half * 0.6, near * 0.6),
            (half * 0.6, far * 0.6),
            (-half * 0.6, far * 0.6),
        )
    ]
    inner = [(x, y, height) for x, y in ((-half, near), (half, near), (half, far), (-half, far))]
    outer = [
        (x, y, height)
        for x, y in ((-width / 2, -depth / 2), (width / 2, -depth / 2), (width / 2, depth / 2), (-width / 2, depth / 2))
    ]
    under = [(x * 0.7, y * 0.7, 0.0) for x, y, _ in outer]
    points = np.array(bottom + inner + outer + under)
    around = [(i, (i + 1) % 4) for i in range(4)]
    faces = [[0, 1, 2, 3], [12, 13, 14, 15]]
    for low, high in ((0, 4), (4, 8), (8, 12)):
        faces += [[low + i, low + j, high + j, high + i] for i, j in around]
    return Shape(points, faces)


def sink(width: float, depth: float, height: float) -> Shape:
    """Return a sink with a flange of 2 cm that rests on the worktop around its hole; the flange is at z = 0."""
    bowl = move(hollow_box(width, depth, height, 0.004), z=-height + 0.003)
    flange = [
        box(-width / 2 - 0.02, width / 2 + 0.02, side * depth / 2, side * (depth / 2 + 0.02), 0, 0.004)
        for side in (-1, 1)
    ]
    sides = [box(side * width / 2, side * (width / 2 + 0.02), -depth / 2, depth / 2, 0, 0.004) for side in (-1, 1)]
    return merge(bowl, *flange, *sides)


def worktop(width: float, depth: float, thickness: float, hole: tuple[float, float, float, float]) -> Shape:
    """Return a worktop with a hole x0 x1 y0 y1, as four boxes."""
    x0, x1, y0, y1 = hole
    half_w, half_d = width / 2, depth / 2
    return merge(
        box(-half_w, x0, -half_d, half_d, 0, thickness),
        box(x1, half_w, -half_d, half_d, 0, thickness),
        box(x0, x1, -half_d, y0, 0, thickness),
        box(x0, x1, y1, half_d, 0, thickness),
    )


def trolley_frame(levels: Sequence[float]) -> Shape:
    """Return a trolley on castors: four posts, a rimmed top, and rails at the given heights."""
    posts = [move(cuboid(0.02, 0.02, 0.78, 0.06), x, y) for x in (-0.17, 0.17) for y in (-0.17, 0.17)]
    castors = [move(rod("x", -0.012, 0.012, (0, 0.03), 0.03), x, y) for x in (-0.17, 0.17) for y in (-0.17, 0.17)]
    rails = [box(x - 0.006, x + 0.006, -0.16, 0.16, z - 0.012, z) for z in levels for x in (-0.158, 0.158)]
    return merge(
        *posts, *castors, *rails, move(hollow_box(0.38, 0.38, 0.035, 0.008), z=0.835), cuboid(0.36, 0.36, 0.015, 0.06)
    )


def counter(width: float) -> Shape:
    """Return a reception desk: a table top at 0.76 m, a raised front at 1.08 m, and a shelf on the inner side."""
    half = width / 2
    return merge(
        box(-half, half, -0.35, -0.31, 0, 1.06),
        box(-half, half, -0.4, -0.12, 1.06, 1.09),
        box(-half, half, -0.31, 0.3, 0.73, 0.76),
        box(-half, -half + 0.03, -0.31, 0.3, 0, 0.73),
        box(half - 0.03, half, -0.31, 0.3, 0, 0.73),
        box(-0.015, 0.015, -0.31, 0.3, 0, 0.73),
        box(-half + 0.03, -0.015, -0.31, 0.28, 0.36, 0.38),
    )


def bench(width: float) -> Shape:
    """Return a bench of slats on two frames."""
    slats = [box(-width / 2, width / 2, y, y + 0.08, 0.42, 0.45) for y in (-0.19, -0.09, 0.01, 0.11)]
    legs = [
        merge(
            box(x - 0.02, x + 0.02, -0.18, -0.14, 0, 0.42),
            box(x - 0.02, x + 0.02, 0.14, 0.18, 0, 0.42),
            box(x - 0.02, x + 0.02, -0.14, 0.14, 0.38, 0.42),
        )
        for x in (-width * 0.4, width * 0.4)
    ]
    return merge(*slats, *legs)


def hook_rail(width: float, hooks: int) -> Shape:
    """Return a board with hooks that end 6 cm before the wall, 2 cm higher; the middle of the board is at z = 0."""
    step = width / hooks
    bows = [
        bent([(x, -0.015, -0.02), (x, -0.05, -0.02), (x, -0.06, -0.012), (x, -0.06, 0.02)], 0.005)
        for x in (-width / 2 + step * (i + 0.5) for i in range(hooks))
    ]
    return merge(box(-width / 2, width / 2, -0.018, 0, -0.05, 0.05), *bows)


def coat_rail(width: float, height: float) -> Shape:
    """Return a rail on two feet for clothes hangers."""
    feet = [
        merge(box(x - 0.015, x + 0.015, -0.25, 0.25, 0, 0.03), rod("z", 0.03, height, (x, 0), 0.014))
        for x in (-width / 2, width / 2)
    ]
    return merge(*feet, rod("x", -width / 2, width / 2, (0, height - 0.014), 0.012))


def curtain(width: float, height: float, folds: int = 9, depth: float = 0.07) -> Shape:
    """Return a curtain in folds, with its lower hem at z = 0."""
    count = folds * 4 + 1
    line = [(width * (i / (count - 1) - 0.5), depth / 2 * (0, 1, 0, -1)[i % 4]) for i in range(count)]
    strip = ribbon(line, height, 0.003)
    # The ribbon is drawn out along x, its line is in y and z.
    points = strip.points[:, [1, 2, 0]] + [0, 0, height / 2]
    return Shape(points, strip.faces)


def drying_rack(width: float) -> Shape:
    """Return an X-shaped rack for laundry with six bars at 0.95 m."""
    legs = [bent([(x, -0.28, 0.012), (x, 0.28, 0.95)], 0.011) for x in (-width / 2, width / 2)]
    legs += [bent([(x, 0.28, 0.012), (x, -0.28, 0.95)], 0.011) for x in (-width / 2 + 0.03, width / 2 - 0.03)]
    bars = [rod("x", -width / 2, width / 2, (y, 0.95), 0.006) for y in (-0.28, -0.168, -0.056, 0.056, 0.168, 0.28)]
    frame_sides = [rod("y", -0.28, 0.28, (0.95, x), 0.008) for x in (-width / 2, width / 2)]
    return merge(*legs, *bars, *frame_sides)


def ladder(length: float, steps: int) -> Shape:
    """Return a straight ladder that stands upright."""
    sides = [box(x - 0.015, x + 0.015, -0.03, 0.03, 0, length) for x in (-0.2, 0.2)]
    rungs = [rod("x", -0.2, 0.2, (0, (i + 0.7) * length / steps), 0.014) for i in range(steps)]
    return merge(*sides, *rungs)


def window(width: float, height: float) -> Shape:
    """Return a window with one mullion, of frame, panes and handle, centred in the plan."""
    half = width / 2
    bars = [
        box(-half, half, -0.035, 0.035, 0, 0.06),
        box(-half, half, -0.035, 0.035, height - 0.06, height),
        *(box(x - 0.03, x + 0.03, -0.035, 0.035, 0.06, height - 0.06) for x in (-half + 0.03, 0, half - 0.03)),
    ]
    panes = [box(x0, x1, -0.006, 0.006, 0.06, height - 0.06) for x0, x1 in ((-half + 0.06, -0.03), (0.03, half - 0.06))]
    return merge(*bars, *panes, box(-0.01, 0.01, -0.06, -0.035, height * 0.45, height * 0.45 + 0.12))


def toilet() -> Shape:
    """Return a toilet with its cistern, without lid."""
    bowl = squash(
        lathe([(0.1, 0), (0.12, 0.2), (0.19, 0.38), (0.19, 0.4), (0.14, 0.4), (0.09, 0.22), (0, 0.2)]), y=1.25
    )
    return merge(move(bowl, y=-0.1), box(-0.13, 0.13, 0.05, 0.2, 0, 0.4), box(-0.2, 0.2, 0.12, 0.29, 0.4, 0.78))


def toilet_lid() -> Shape:
    """Return the closed lid of a toilet."""
    return squash(disc(0.19, 0.025), y=1.22)
