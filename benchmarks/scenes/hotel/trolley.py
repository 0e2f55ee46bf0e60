"""The housekeeping trolley with its bags, the mop bucket beside it, and a tray before the door of the room."""

from math import cos, pi, sin

from benchmarks.scenes.hotel.bathroom import FLACON, ROLL
from benchmarks.scenes.hotel.desk import BOTTLE
from benchmarks.scenes.hotel.shapes import Part, ball, box, crate, cup, cyl, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["build_trolley", "spray_bottle"]

CASTER = (
    cyl(4, 2.4, (0, 2.8, 0), (90, 0, 0)),
    slabs((-2, 2, 3, 10, -2, -1.4), (-2, 2, 3, 10, 1.4, 2), (-3, 3, 9.6, 10, -3, 3)),
)


def spray_bottle() -> list[Part]:
    """Return a spray bottle; its trigger is a bow before its neck, at +x, 22 cm high."""
    body = lathe([(0.001, 0), (4, 0), (4, 14), (1.4, 19), (1.4, 22), (0.001, 22)], 16)
    return [body, box(10, 3, 2.6, (2, 22, 0)), tube([(4.6, 22.4, 0), (4.2, 19, 0), (3.6, 16.4, 0)], 0.4, 6)]


def build_trolley(hotel: Hotel) -> None:
    """Add the trolley; its long side is along x, its bags at its ends."""
    place = hotel.group("corridor/trolley", (80, 0.8, -6), 7)
    posts = [(x, x + 3, 10, 97, z, z + 3) for x in (-50, 47) for z in (-24, 21)]
    boards = [(-50, 50, 14, 16, -24, 24), (-50, 50, 55, 57, -24, 24), (-50, 50, 95, 97, -24, 24)]
    rims = [(-50, 50, 97, 102, z, z + 1) for z in (-24, 23)] + [(x, x + 1, 97, 102, -23, 23) for x in (-50, 49)]
    walls = [(-47, 47, 16, 95, -24, -23)]
    feet = [(x, x + 6, 10, 14, z, z + 6) for x in (-50, 44) for z in (-24, 18)]
    push = tube([(50, 90, -20), (60, 93, -20), (60, 93, 20), (50, 90, 20)], 1.2)
    hoops = [tube([(s * 50, 84, -19), (s * 78, 84, -19), (s * 78, 84, 19), (s * 50, 84, 19)], 0.9) for s in (-1,)]
    place.put("trolley_frame", [slabs(*posts, *boards, *rims, *walls, *feet), push, *hoops], fixed=True)
    for index, (x, z) in enumerate(((-47, -21), (-47, 21), (47, -21), (47, 21)), 1):
        place.put(f"caster_{index:02}", CASTER, (x, 0, z), (0, 25 * index, 0), fixed=True, asset="caster")
    _top(place.group("top", (0, 97, 0)))
    _boards(place)
    _bag(place.group("laundry", (-64, 0, 0)))
    for index, z in enumerate((-8, 7), 1):
        # The bow of the trigger is on the push bar's far side: the bottle hangs by it.
        place.put(f"spray_bottle_{index:02}", spray_bottle(), (57.5, 72.1, z), fixed=True, asset="spray_bottle")
    _beside(hotel.group("corridor/mopping", (176, 0.8, -2), -15))
    tray = hotel.group("corridor/room_service", (-235, 0, -57), 4)
    tray.put(
        "service_tray",
        slabs(
            (-22, 22, 0, 0.8, -15, 15),
            (-22, -21.2, 0.8, 2.6, -15, 15),
            (21.2, 22, 0.8, 2.6, -15, 15),
            (-21.2, 21.2, 0.8, 2.6, -15, -14.2),
            (-21.2, 21.2, 0.8, 2.6, 14.2, 15),
        ),
    )
    tray.put(
        "dinner_plate", lathe([(0.001, 0), (8, 0), (12, 1.8), (11.9, 2.2), (7.9, 0.5), (0.001, 0.5)], 24), (-7, 0.8, 0)
    )
    tray.put(
        "cloche",
        [
            lathe(
                [(11, 0), (10.4, 5), (6, 9), (0.001, 10), (0.001, 9.6), (5.8, 8.6), (10, 4.8), (10.6, 0), (11, 0)], 24
            ),
            ball(2.4, 2.4, 2.4, (0, 9.8, 0)),
        ],
        (-7, 2.9, 0),
    )
    tray.put("half_sandwich", puff(9, 3.4, 7, 0.4), (-7.4, 1.3, 0.6), (0, 50, 0))
    tray.put("empty_glass", cup(3, 3.6, 11, 0.25), (12, 0.8, -8))


def _top(top: Group) -> None:
    walls = crate(44, 9, 36, 0.8)
    top.put(
        "amenity_organizer",
        [walls, box(0.6, 7, 34, (-7, 0.8, 0)), box(0.6, 7, 34, (7, 0.8, 0))],
        (-24, 0, 0),
        (0, 2, 0),
    )
    for index, (x, z) in enumerate(((-17.5, -6), (-13.6, -3)), 1):
        top.put(f"shampoo_{index:02}", FLACON, (x - 24, 0.8, z), asset="flacon")
    top.put("soap_01", puff(5.4, 2, 3.6, 0.3), (-24, 0.8, -3), (0, 20, 0))
    top.put("clipboard", [box(22, 0.5, 31), box(8, 1, 3, (0, 0.5, -14))], (24, 0, 1), (0, -8, 0))
    top.put("rubber_gloves", puff(12, 2, 20, 0.6), (25, 0.6, 4), (0, 24, 0))


def _boards(place: Group) -> None:
    for index in range(2):
        place.put(
            f"fresh_towel_{index + 1:02}", puff(40, 8, 32, 0.3), (-24, 57 + 8 * index, -2), (0, (1, -2, 3)[index], 0)
        )
    place.put("roll_box", crate(38, 18, 30, 0.6), (24, 57, -2), (0, -3, 0))
    for index, (x, z) in enumerate(((14, -8), (27, -7)), 1):
        place.put(f"paper_roll_{index:02}", ROLL, (x, 57.6, z), asset="toilet_roll")
    place.put("folded_sheet_01", puff(44, 9, 34, 0.25), (-22, 16, -2))
    place.put("bottle_crate", crate(36, 14, 26, 0.8), (24, 16, 0), (0, 4, 0))
    for index, (x, z) in enumerate(((14, -5), (22, -6)), 1):
        place.put(f"refill_bottle_{index:02}", BOTTLE, (x, 16.8, z), asset="water_bottle")


def _bag(bag: Group) -> None:
    wall = [(11, 24.4), (12.3, 80), (12.5, 85.4), (15.5, 85.4), (15.6, 76), (15.1, 76), (15, 85.05), (12.9, 85.05)]
    sack = lathe([(0.001, 24.4), *wall, (12.7, 80), (11.4, 24), (0.001, 24)], 24)
    # The hoop is 28 by 38 cm; the bag's hem is folded over it.
    bag.put("laundry_bag", Part("Mesh", points=sack.points * (1, 1, 1.4), faces=sack.faces), fixed=True)
    bag.put("used_sheet", puff(19, 24, 26, 0.8), (0, 24.6, 0), (0, 12, 0))
    bag.put("used_towel", puff(18, 16, 22, 0.9), (0.6, 48, 1.5), (0, 50, 0))


def _beside(place: Group) -> None:
    feet = [cyl(1.8, 1.4, (13 * cos(k * pi / 2 + 0.8), 0.9, 13 * sin(k * pi / 2 + 0.8)), (90, 0, 0)) for k in range(4)]
    place.put("mop_bucket", [moved(cup(14, 17, 28, 0.6), (0, 3, 0)), cyl(15, 0.8, (0, 2.4, 0)), *feet])
    place.put(
        "wringer",
        [
            slabs((-12, 12, 0, 0.8, -15, -2), (-12, -11, 0.8, 8, -15, -2), (11, 12, 0.8, 8, -15, -2)),
            tube([(12, 6, -8), (17, 16, -8)], 0.8),
        ],
        (0, 31, 0),
    )
    place.put("mop", [puff(13, 9, 12, 0.8), tube([(0, 8, 0), (0, 128, 0)], 1.2)], (1, 3.9, 6), (3, 0, 3), fixed=True)
    leaves = [box(30, 60, 0.6, (0, -0.65, 7 * s), (-13 * s, 0, 0)) for s in (-1, 1)]
    place.put("wet_floor_sign", leaves, (62, 0, 4), (0, 30, 0))
