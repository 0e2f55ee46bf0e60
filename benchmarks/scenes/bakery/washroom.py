"""The toilet: bowl and cistern, the wash basin and what hangs beside it, mop and bucket."""

from benchmarks.scenes.bakery.forms import (
    Triple,
    block,
    bulge,
    cloth,
    column,
    hose,
    panels,
    roll,
    turned,
    vessel,
)
from benchmarks.scenes.bakery.layout import Area

__all__ = ["build_washroom"]


def build_washroom(world: Area) -> None:
    """Add the room: x from 760 to 1150, z from 600 to 900."""
    room = world.area("Washroom")
    _toilet(room.area("Toilet", (1150, 0, 690), -90))
    _basin(room.area("Basin", (930, 0, 600)))
    clean = room.area("Cleaning", (1080, 0, 860))
    bucket = [vessel(13, 16, 28, 0.5), *(block(3, 3, 1, (s * 16.2, 24, 0)) for s in (-1, 1))]
    handle = hose([(-16.4, 25.5, 0), (-13, 36, 5), (0, 40, 7), (13, 36, 5), (16.4, 25.5, 0)], 0.4)
    clean.stand("mop_bucket", [*bucket, handle])
    # The stick leans on the wall at z = 900.
    mop = [bulge(17, 8, 15, 0.6), column(1.1, 132, (0, 7, 0))]
    clean.fix("mop", mop, (0, 2.6, -3), (17.5, 0, 0))


def _toilet(toilet: Area) -> None:
    bowl = turned([(0, 0), (11, 0), (10, 14), (19, 38), (19, 40), (15, 40), (9, 24), (0, 22)])
    toilet.stand("toilet_bowl", [bowl.to(0, 0, 44), block(20, 36, 24, (0, 0, 14)), block(34, 3, 14, (0, 37, 20))])
    toilet.fix("toilet_seat", roll(13, 19.4, 2), (0, 40.2, 44))
    toilet.fix("toilet_lid", [column(19.4, 1.6, (0, 62.2, 20.5), (-94, 0, 0)), block(16, 4, 3.4, (0, 40.1, 22.1))])
    tank: list[Triple] = [(-19, 19, 42, 44, 0.4, 17), (-19, 19, 44, 78, 0.4, 1.6), (-19, 19, 44, 78, 15.8, 17)]
    tank += [(-19, -17.8, 44, 78, 1.6, 15.8), (17.8, 19, 44, 78, 1.6, 15.8), (-19.4, 19.4, 78, 80, 0.4, 17.4)]
    toilet.fix("cistern", panels(*tank, (-6, 6, 36.1, 42, 4, 12)))
    toilet.fix("flush_button", column(2.4, 1, (0, 79.8, 9)))
    toilet.fix(
        "roll_holder",
        [
            block(5, 5, 0.8, (0, -2.5, 0.5)),
            hose([(0, 0, 0.6), (0, 0, 7), (1.5, 0, 8), (13, 0, 8), (13.4, 1.2, 8)], 0.5),
        ],
        (44, 70, 0),
    )
    toilet.fix("paper_roll", roll(2, 5.6, 10), (56.4, 68.6, 8), (0, 0, 90))
    toilet.stand("brush_stand", vessel(5, 6, 14, 0.4), (-42, 0, 14))
    brush = [
        turned([(0, 0), (3, 0.6), (3.4, 5), (1, 8), (0, 8)]),
        column(0.8, 30, (0, 7, 0)),
        column(1.2, 5, (0, 36, 0)),
    ]
    toilet.fix("toilet_brush", brush, (-42, 0.6, 14), (4, 0, 5))


def _basin(basin: Area) -> None:
    bowl = turned([(0, 66), (8, 66), (22, 80), (22, 84), (17, 84), (15, 80), (6, 71), (0, 70)])
    basin.fix("wash_basin", [bowl.to(0, 0, 30), panels((-20, 20, 72, 84, 0.2, 13.2))])
    spout = hose([(0, 0, 0), (0, 12, 0), (0, 16, 3), (0, 16, 11), (0, 13, 13)], 1)
    basin.stand("basin_tap", [column(2, 3), spout, block(1.4, 1, 7, (0, 15.6, -2), (-14, 0, 0))], (0, 84, 6))
    trap = hose([(0, 66.4, 30), (0, 52, 30), (1, 46, 27), (2, 46, 22), (2, 52, 19), (2, 54, 14), (2, 54, -0.2)], 1.8)
    basin.fix("drain_trap", trap)
    basin.fix("mirror", panels((-26, 26, 110, 180, 0.3, 1.2)))
    basin.fix("soap_dispenser", [block(10, 20, 9, (0, 0, 4.8)), block(6, 3, 5, (0, -2.4, 7))], (48, 112, 0))
    rail = hose([(-15, 0, 0.1), (-15, 0, 5.4), (-14.4, 0, 6), (14.4, 0, 6), (15, 0, 5.4), (15, 0, 0.1)], 0.7)
    basin.fix("towel_rail", rail, (-50, 116, 0))
    fall = [(4.4, -38), (4.6, -2), (5.2, 0.9), (6, 1.15), (6.8, 0.9), (7.4, -2), (7.6, -50)]
    basin.fix("hand_towel", cloth(fall, 22, 0.6), (-50, 116, 0))
