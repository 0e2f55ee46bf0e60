"""Things of which there are copies, and those that take many parts."""

from benchmarks.scenes.bicycle_shop.parts import (
    Part,
    Vector,
    ball,
    block,
    capsule,
    cone,
    cube,
    cyl,
    lathe,
    merge,
    open_box,
    ring,
    shift,
    tube,
    vessel,
)
from benchmarks.scenes.bicycle_shop.stage import Asset

__all__ = [
    "BIKE",
    "BOTTLE",
    "CARTON",
    "CHAIR",
    "CUP",
    "FRAME",
    "GLASS",
    "HELMET",
    "HOOK",
    "LEAVES",
    "MUG",
    "PENDANT",
    "PICTURE",
    "PLATE",
    "POT",
    "SAUCER",
    "SCREW",
    "SPOON",
    "STOOL",
    "TYRE",
    "WHEEL",
    "coat",
    "drawer",
    "lamp_on_chains",
    "work_stand",
]

HUB: Vector = (-52, 0, 34)
FRONT_HUB: Vector = (52, 0, 34)
CRANK: Vector = (-8, 0, 28)
SEAT: Vector = (-22, 0, 78)
HEAD: Vector = (32, 0, 86)


def _wheel(x: float = 0.0, z: float = 0.0) -> tuple[Part, ...]:
    """A wheel about an axle along y: tyre, rim, eight spokes and a hub."""
    spokes = [(30.0, 0.0), (21.2, 21.2), (0.0, 30.0), (-21.2, 21.2)]
    return (
        shift(ring(32.0, 2.2), x, 0, z),
        shift(ring(29.6, 0.8), x, 0, z),
        *(tube((x - a, 0, z - b), (x + a, 0, z + b), 0.15) for a, b in spokes),
        tube((x, -5, z), (x, 5, z), 1.8),
    )


FRAME_PARTS: tuple[Part, ...] = (
    tube(CRANK, SEAT, 1.6),
    tube(SEAT, HEAD, 1.6),
    tube(CRANK, (36, 0, 68), 2.0),
    tube((36, 0, 68), (31, 0, 92), 1.9),
    *(tube((x, y * 0.4, z), (-52, y, 34), 0.8) for y in (-6, 6) for x, _, z in (CRANK, SEAT)),
    *(tube((36, y * 0.6, 68), (52, y, 34), 1.0) for y in (-6, 6)),
    tube((31, 0, 92), (37, 0, 98), 1.4),
    tube((37, -28, 98), (37, 28, 98), 1.2),
    *(capsule((36, y, 98), (24, y, 98), 1.5) for y in (-28, 28)),
    tube(SEAT, (-25, 0, 91), 1.3),
    capsule((-32, 0, 92), (-18, 0, 92), 3.0),
    tube((-8, -8, 28), (-8, 8, 28), 1.2),
    tube((-8, 8, 28), (6, 8, 18), 0.9),
    tube((-8, -8, 28), (-22, -8, 38), 0.9),
    cube(9, 9, 2, 6, 14, 17),
    cube(9, 9, 2, -22, -14, 37),
)
FRAME = Asset("frame", FRAME_PARTS)
WHEEL = Asset("wheel", _wheel())
BIKE = Asset(
    "bike",
    (
        *FRAME_PARTS,
        *_wheel(-52, 34),
        *_wheel(52, 34),
        # The rack over the rear wheel.
        cube(36, 12, 1, -54, 0, 71),
        *(tube((-60, y, 71), (-52, y * 1.1, 34), 0.5) for y in (-5.5, 5.5)),
        tube((-20, 5, 27), (-27, 17, 0.4), 0.8),
    ),
)
TYRE = Asset("tyre", (ring(32.0, 2.2, "x"),))
HELMET = Asset(
    "helmet",
    (lathe([(13, 0), (13.5, 6), (10, 12), (4, 15), (0.1, 15.5), (0.1, 14), (9, 11), (12, 6), (12, 0), (13, 0)]),),
)
HOOK = Asset("hook", (tube((0, 0.4, 0), (0, -6, 0), 0.3), tube((0, -6, 0), (0, -6.6, 1.5), 0.3)))
SCREW = Asset("screw", (tube((0, 0.2, 0), (0, -0.4, 0), 0.5),))
CUP = Asset(
    "cup", (vessel(2.6, 4.2, 6.5, 0.3), tube((4.0, 0, 5.2), (6.0, 0, 4.4), 0.4), tube((6, 0, 4.4), (3.2, 0, 1.8), 0.4))
)
MUG = Asset(
    "mug", (vessel(4.0, 4.2, 9.5, 0.4), tube((4.1, 0, 7.8), (7.0, 0, 6.6), 0.5), tube((7, 0, 6.6), (4.0, 0, 2.4), 0.5))
)
SAUCER = Asset("saucer", (lathe([(0.01, 0), (4, 0), (7.6, 1.6), (7.4, 1.9), (3.8, 0.4), (0.01, 0.4)]),))
PLATE = Asset("plate", (lathe([(0.01, 0), (6, 0), (10.5, 1.7), (10.3, 2.0), (5.8, 0.4), (0.01, 0.4)]),))
SPOON = Asset("spoon", (cube(11, 0.6, 0.2, 2, 0, 0.1), lathe([(0.01, 0), (1.4, 0.3), (1.3, 0.4), (0.01, 0.2)], 12)))
GLASS = Asset("glass", (vessel(2.8, 3.6, 13, 0.25),))
BOTTLE = Asset("bottle", (lathe([(0.01, 0), (3.6, 0), (3.6, 15), (1.4, 20), (1.4, 24.5), (0.01, 24.5)]),))
POT = Asset("pot", (vessel(5.5, 7.5, 13, 0.8), cyl(6.4, 1, 0, 0, 10.5)))
LEAVES = Asset(
    "leaves",
    (
        tube((0, 0, -3), (0.5, 0.5, 16), 0.6),
        *(capsule((0, 0, 6), (x, y, z), 1.3) for x, y, z in ((9, 2, 20), (-8, 5, 24), (-3, -9, 18), (4, 7, 28))),
    ),
)
CHAIR = Asset(
    "chair",
    (
        merge(
            block(-21, 21, -21, 21, 43, 46),
            *(block(x, x + 4, y, y + 4, 0, 43) for x in (-20, 16) for y in (-20, 16)),
            *(block(x, x + 4, 17, 20, 46, 86) for x in (-20, 16)),
            block(-20, 20, 17, 19, 72, 86),
        ),
    ),
)
STOOL = Asset("stool", (cyl(17, 4, 0, 0, 71), cyl(2.5, 70, 0, 0, 2), cyl(21, 2), shift(ring(14, 1, "z"), 0, 0, 28)))
PENDANT = Asset(
    "pendant", (cyl(5, 3, 0, 0, -3), cyl(0.3, 92, 0, 0, -95), cone(18, 22, 0, 0, -115), ball(5, 0, 0, -112))
)
PICTURE = Asset("picture", (cube(44, 2, 58, 0, -1, -29), cube(36, 0.4, 50, 0, -2.1, -25)))
CARTON = Asset("carton", (cube(38, 28, 26), cube(38.2, 5, 0.2, 0, 0, 25.95)))


def drawer(width: float, depth: float, tall: float) -> Part:
    """Return an open drawer whose front is at y = 0 and a little larger than the rest."""
    tray = shift(open_box(width - 2, depth, tall - 3, 0.8), 0, depth / 2, 1)
    return merge(tray, block(-width / 2, width / 2, -1.8, 0.2, 0, tall))


def work_stand(reach: float = 40.0, grip: float = 142.0) -> tuple[Part, ...]:
    """Return a stand for repairs whose jaws, at the origin of the plan, hold a tube at a height."""
    return (
        cyl(32, 3, 0, reach),
        tube((0, reach, 2), (0, reach, grip + 12), 3.2),
        tube((0, reach + 2, grip + 4), (0, 4, grip), 2.4),
        cube(9, 6, 8, 0, 0, grip - 4),
        tube((0, 7, grip), (12, 12, grip + 5), 0.9),
    )


def lamp_on_chains(width: float) -> tuple[Part, ...]:
    """Return a tube lamp that hangs 45 cm below the origin on two chains."""
    chains = [tube((x, 0, 0), (x, 0, -40), 0.4) for x in (-width / 3, width / 3)]
    return (*chains, cube(width, 16, 5, 0, 0, -45), capsule((-width / 2 + 6, 0, -45.5), (width / 2 - 6, 0, -45.5), 1.5))


def coat(long: float = 85.0) -> tuple[Part, ...]:
    """Return a coat that hangs from a loop at the origin, in front of a wall behind it."""
    return (
        ring(1.6, 0.3),
        capsule((-15, -4, -8), (15, -4, -8), 4),
        block(-20, 20, -8.5, 0.5, -long, -6),
        capsule((-22, -4, -14), (-24, -4, -60), 4.5),
        capsule((22, -4, -14), (24, -4, -60), 4.5),
    )
