"""The bathroom: washstand, toilet, shower and towels."""

from benchmarks.scenes.hotel.shapes import box, crate, cup, cyl, drape, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["build_bathroom"]

ROLL = (lathe([(2, 0), (5.5, 0), (5.5, 10), (2, 10), (2, 0)], 24),)
"""A roll of paper with its hole."""
FLACON = (lathe([(0.001, 0), (1.7, 0), (1.7, 5), (1, 6), (1, 7.4), (0.001, 7.4)], 14),)


def build_bathroom(hotel: Hotel) -> None:
    """Add the bathroom, in a frame at its north-west corner."""
    bath = hotel.group("bathroom", (490, 0, 10))
    _washstand(bath.group("washstand", (125, 0, 0), unit=100))
    _toilet(bath.group("toilet", (220, 0, 105), -90))
    _shower(bath.group("shower", (174, 0, 239)))
    _towels(bath)
    bath.put(
        "extractor_fan",
        slabs((-12, 12, 0, 1, -12, 12), *((-9, 9, -1.2, 0, z, z + 1.2) for z in (-9, -4.5, 0, 4.5, 9))),
        (60, 259.1, 60),
        fixed=True,
    )


def _washstand(stand: Group) -> None:
    # The top has a square hole for the basin.
    top = (
        (-70, -18, 82, 85, 0.5, 55),
        (18, 70, 82, 85, 0.5, 55),
        (-18, 18, 82, 85, 0.5, 13),
        (-18, 18, 82, 85, 49, 55),
    )
    stand.put("counter", slabs(*top, (-70, -67, 0, 82, 0.5, 53), (67, 70, 0, 82, 0.5, 53), (-67, 67, 28, 30, 1, 50)))
    flange = (
        (-20, -17, 0, 0.9, -20, 20),
        (17, 20, 0, 0.9, -20, 20),
        (-17, 17, 0, 0.9, -20, -17),
        (-17, 17, 0, 0.9, 17, 20),
    )
    bowl = (
        (-17.6, -17, -14, 0, -17.6, 17.6),
        (17, 17.6, -14, 0, -17.6, 17.6),
        (-17, 17, -14, 0, -17.6, -17),
        (-17, 17, -14, 0, 17, 17.6),
        (-17.6, 17.6, -15, -14, -17.6, 17.6),
    )
    stand.put("basin", slabs(*flange, *bowl), (0, 85, 31), fixed=True)
    stand.put(
        "mixer_tap",
        [
            cyl(2.4, 12),
            tube([(0, 11, 0), (0, 12, 8), (0, 9.5, 14)], 1.1),
            box(1.6, 1, 9, (0, 13, 2), (-12, 0, 0)),
            cyl(1.2, 2, (0, 11.5, 0)),
        ],
        (0, 85, 6),
        fixed=True,
    )
    stand.put("basin_stopper", cyl(3, 0.8), (1, 71, 30))
    stand.put("toothbrush_glass", cup(3.2, 3.8, 10, 0.3), (-28, 85, 12))
    for name, x, tilt in (("blue", -1.1, 9),):
        stand.put(
            f"toothbrush_{name}",
            [tube([(0, 0, 0), (0, 15, 0), (0, 18.6, 0)], 0.4, 6), box(0.9, 2.4, 1.1, (0, 16, 0.8))],
            (x - 28, 85.45, 12),
            (0, 20, tilt),
            fixed=True,
        )
    stand.put(
        "amenity_dish",
        slabs(
            (-11, 11, 0, 0.7, -6, 6),
            (-11, -10.4, 0.7, 2.4, -6, 6),
            (10.4, 11, 0.7, 2.4, -6, 6),
            (-10.4, 10.4, 0.7, 2.4, -6, -5.4),
            (-10.4, 10.4, 0.7, 2.4, 5.4, 6),
        ),
        (42, 85, 16),
        (0, -12, 0),
    )
    for index, x in enumerate((-7, -2.6), 1):
        stand.put(f"flacon_{index:02}", FLACON, (42 + x, 85.7, 15.4 + 0.21 * x), asset="flacon")
    stand.put("wrapped_soap", puff(5.4, 2, 3.6, 0.3), (48.5, 85.7, 18), (0, 70, 0))
    stand.put("hand_towel_folded", puff(28, 5, 18, 0.25), (46, 85, 40), (0, 4, 0))
    stand.put("charging_stand", [cyl(3, 2), cyl(0.6, 1.4, (0, 2, 0))], (-52, 85, 14))
    stand.put(
        "electric_toothbrush",
        lathe(
            [(0.7, 0), (1.6, 0), (1.6, 15), (0.7, 17), (0.5, 22), (0.001, 24), (0.001, 1.5), (0.7, 1.5), (0.7, 0)], 14
        ),
        (-52, 87, 14),
    )
    stand.put("wall_mirror", [box(130, 80, 1.6), box(126, 76, 0.4, (0, 2, 1))], (0, 108, 1), fixed=True)
    stand.put("mirror_lamp", [box(60, 4, 4), tube([(-28, 1.5, 4), (28, 1.5, 4)], 1.6)], (0, 194, 2.1), fixed=True)
    stand.put("shelf_basket", crate(36, 16, 28, 0.8), (-36, 30, 26), (0, -7, 0))
    stand.put("spare_roll_01", ROLL, (-40, 30.8, 26), asset="toilet_roll")
    for index in range(2):
        stand.put(
            f"bath_towel_{index + 1:02}", puff(42, 7, 32, 0.3), (26, 30 + 7 * index, 26), (0, (0, 3, -2)[index], 0)
        )
    dryer = stand.group("hairdryer", (-88, 128, 0))
    dryer.put(
        "dryer_holder",
        [box(9, 14, 1.4, (0, -7, 0.8)), moved(lathe([(4.2, 0), (4.8, 0), (4.8, 3), (4.2, 3), (4.2, 0)]), (0, -3, 6.2))],
        fixed=True,
    )
    body = lathe([(0.001, -9), (2.6, -8.6), (3.4, 2), (4.6, 4), (4.6, 10), (0.001, 12)], 18)
    dryer.put("hairdryer", [body, tube([(0, 7, 3), (0, 6, 14), (0, 4, 16)], 1.7)], (0, -3.2, 6.2), fixed=True)


def _toilet(place: Group) -> None:
    # Its back, at z = 0, is the east wall.
    bowl = lathe([(0.001, 0), (12, 0), (13, 20), (19, 38), (19, 40), (14, 40), (12, 30), (5, 20), (0.001, 20)], 24)
    place.put("toilet_bowl", [bowl, box(22, 38, 20, (0, 0, -20))], (0, 0, 38))
    place.put("cistern", [box(38, 36, 15)], (0, 41, 7.8), fixed=True)
    place.put("flush_button", cyl(2.2, 0.8), (0, 76.9, 8), fixed=True)
    ring = lathe([(12, 0), (19.4, 0), (19.4, 1.6), (12, 1.6), (12, 0)], 24)
    place.put("toilet_seat", ring, (0, 40.2, 38), fixed=True)
    place.put(
        "toilet_lid", [lathe([(0.001, 0), (19, 0), (19, 1.6), (0.001, 1.6)], 24)], (0, 61, 19.4), (83, 0, 0), fixed=True
    )
    place.put("tissue_roll_spare", ROLL, (-11, 77, 8), asset="toilet_roll")
    holder = [box(5, 5, 1), tube([(0, 2.5, 0.4), (0, 2.5, 7), (1, 2.5, 8), (13, 2.5, 8)], 0.7)]
    place.put("roll_holder", holder, (42, 66, 0.7), fixed=True)
    place.put("toilet_roll", ROLL, (54.2, 67.3, 8.7), (0, 0, 90), fixed=True, asset="toilet_roll")
    place.put("brush_pot", cup(5, 5.4, 14, 0.4), (-32, 0, 10))
    place.put(
        "toilet_brush",
        [puff(7, 8, 7, 0.8), tube([(0, 7, 0), (0, 38, 0)], 0.8)],
        (-31.6, 0.5, 10),
        (0, 0, -2),
        fixed=True,
    )
    place.put("pedal_bin", [cup(9, 10, 24, 0.4), box(5, 1, 5, (0, 1, 11))], (-62, 0, 12.8), (0, 70, 0))
    place.put(
        "bin_liner",
        lathe(
            [
                (0.001, 1.2),
                (8.2, 1.2),
                (9.3, 23.6),
                (9.6, 24.4),
                (10.6, 24.4),
                (10.7, 20),
                (10.4, 20),
                (10.3, 24.1),
                (9.3, 24.1),
                (8, 1.5),
                (0.001, 1.5),
            ]
        ),
        (-62, 0.2, 12.8),
        fixed=True,
    )
    place.put("cotton_pad", cyl(3, 0.6), (-60, 1.8, 13.8), (0, 0, 6))


def _shower(place: Group) -> None:
    place.put("shower_tray", crate(90, 6, 100, 2.5))
    place.put("drain_cover", cyl(5.5, 0.6), (10, 2.5, 14))
    place.put("glass_wall", box(1, 195, 97), (-43.7, 6, 0.4))
    place.put("brace_bar", tube([(-43.1, 196, -30), (45.8, 196, -30)], 0.9), (0, 0, 0), fixed=True)
    # The south wall is at z = 51.
    rail = tube([(0, -5, 0), (0, -5, -5), (0, 75, -5), (0, 75, 0)], 1)
    place.put("shower_rail", rail, (4, 120, 50.9), fixed=True)
    place.put(
        "rail_slider",
        [
            cyl(2, 5, (0, -2.5, 0)),
            moved(lathe([(1.5, -2), (2.3, -2), (2.3, 2), (1.5, 2), (1.5, -2)], 14), (0, 0, -4.4)),
        ],
        (4, 178, 45.9),
        fixed=True,
    )
    head = lathe([(0.001, 12), (1, 12), (5, 15), (5, 17), (0.001, 17)])
    place.put(
        "hand_shower",
        [tube([(0, -9, 0), (0, 13, 0)], 1.4), moved(head, (0, 17.6, 10.8), (-110, 0, 0))],
        (4, 178, 41.5),
        fixed=True,
    )
    place.put(
        "shower_mixer",
        [
            tube([(-14, 0, -6), (14, 0, -6)], 2.2),
            tube([(-8, 0, 0), (-8, 0, -6)], 1.4),
            tube([(8, 0, 0), (8, 0, -6)], 1.4),
            cyl(0.9, 4, (0, -5.6, -6)),
        ],
        (4, 100, 50.8),
        fixed=True,
    )
    hose = [(4, 95, 44.8), (4, 84, 44), (-6, 70, 38), (-14, 90, 34), (-10, 130, 35), (2, 160, 40), (4, 169.4, 41.5)]
    place.put("shower_hose", tube(hose, 0.8), fixed=True)
    basket = slabs(
        (-14, 14, 0, 0.6, -11, 0),
        (-14, 14, 4, 5, -11, -10.4),
        (-14, -13.4, 0.6, 5, -11, 0),
        (13.4, 14, 0.6, 5, -11, 0),
        (-13.4, 13.4, 0.6, 8, -0.6, 0),
    )
    place.put("wire_caddy", basket, (-24, 115, 50.8), fixed=True)
    place.put("shower_gel", FLACON, (-31, 115.6, 45.4), asset="flacon", scale=2.2)
    squeegee = [
        tube([(0, 0, 0), (0, 14, 0)], 1),
        box(1.4, 3, 24, (0, -3, 0)),
        tube([(0, 13.6, 0), (0, 17.6, 0), (0.4, 18.6, 0), (2.6, 18.6, 0), (2.9, 17.6, 0), (2.9, 14, 0)], 0.4, 6),
    ]
    # Its hook goes over the edge of the glass.
    place.put("squeegee", squeegee, (-45.6, 182.85, -10), fixed=True)
    place.put("rubber_mat", puff(60, 0.8, 44, 0.1), (-4, 2.5, -14))


def _towels(bath: Group) -> None:
    rail = bath.group("towel_radiator", (0.3, 0, 150), 90)
    rungs = [tube([(-24, y, 8), (24, y, 8)], 1) for y in (60, 72, 84, 108, 120, 144, 156, 168)]
    posts = [tube([(x, 50, 8), (x, 178, 8)], 1.5) for x in (-24, 24)]
    stubs = [tube([(x, y, 0), (x, y, 8)], 0.8) for x in (-24, 24) for y in (60, 168)]
    rail.put("towel_rail", [*rungs, *posts, *stubs], fixed=True)
    for name, x, y, width, front, back in (
        ("bath_towel_wet", -1.0, 108.0, 40, 40, 30),
        ("hand_towel_wet", 5, 144, 26, 22, 20),
    ):
        line = [(-1.8, -back), (-1.6, -2), (-1.1, 0.4), (0, 1.1), (1.1, 0.4), (1.6, -2), (1.9, -front)]
        rail.put(name, moved(drape(line, width, 0.6), (0, 0, 0), (0, -90, 0)), (x, y, 8), fixed=True)
    robe = bath.group("robe", (0, 0, 64), 90)
    robe.put(
        "robe_hook",
        [cyl(2.4, 0.8, (0, -0.4, 0.5), (90, 0, 0)), tube([(0, 0, 0.5), (0, 0, 4), (0, 3, 5.5)], 0.6)],
        (0, 172, 0.1),
        fixed=True,
    )
    loop = tube([(-3, -5, 4.8), (-2, -1, 3.4), (0, 1, 2.8), (2, -1, 3.4), (3, -5, 4.8)], 0.35, 6)
    robe.put("bathrobe", [loop, moved(puff(46, 108, 9, 0.5), (0, -112, 5.2))], (0, 172, 0.1), fixed=True)
    bath.put("bath_mat", puff(70, 1.2, 46, 0.1), (94, 0, 236), (0, 86, 0))
    shelf = bath.group("towel_shelf", (219.8, 140, 105), -90)
    shelf.put(
        "wall_shelf", [box(60, 2, 24, (0, 0, 12)), *(slabs((x, x + 2, -8, 0, 0, 14)) for x in (-26, 24))], fixed=True
    )
    for index, (x, z) in enumerate(((-12, 12), (-11.6, 12.4)), 1):
        shelf.put(f"folded_towel_{index:02}", puff(30, 6, 20, 0.3), (x, 2 + 6 * (index - 1), z), (0, 2 * index, 0))
    rolled = moved(puff(8, 20, 8, 0.6), (0, 4, -10), (90, 0, 0))
    for index, (x, y) in enumerate(((9, 2), (18.2, 2), (13.6, 9.4)), 1):
        shelf.put(f"rolled_towel_{index:02}", rolled, (x, y, 12), asset="rolled_towel")
