"""Window corner, luggage rack, and what is on the walls and the ceiling of the guest room."""

from benchmarks.scenes.hotel.building import DETECTOR, SPRINKLER
from benchmarks.scenes.hotel.desk import CUP, SAUCER
from benchmarks.scenes.hotel.shapes import box, crate, cup, cyl, drape, lathe, moved, puff, slabs, tube, wave
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["build_living"]


def build_living(hotel: Hotel) -> None:
    """Add the window corner, the luggage and the fittings."""
    room = hotel.group("guest_room/fittings")
    _window(hotel.group("guest_room/window", (240, 0, 10)))
    _seat(hotel.group("guest_room/seat", (352, 0, 100), -35))
    _luggage(hotel.group("guest_room/luggage", (306, 0, 373), 176))
    room.put(
        "ceiling_lamp",
        [
            cyl(6, 3, (0, 27, 0)),
            tube([(0, 28, 0), (0, 14, 0)], 0.4, 6),
            lathe([(6, 14), (24, 0), (23.5, 0), (5.5, 14), (6, 14)]),
        ],
        (240, 230.1, 215),
        fixed=True,
    )
    room.put("smoke_detector", DETECTOR, (330, 255.8, 215), fixed=True, asset="smoke_detector")
    room.put("sprinkler_01", SPRINKLER, (150, 256, 120), fixed=True, asset="sprinkler")
    louvres = [(-30, 30, y, y + 0.8, 0.6, 2.4) for y in (-7, -3.5, 0, 3.5, 7)]
    room.put("aircon_grille", slabs((-34, 34, -11, 11, 0, 1), *louvres), (479.7, 240, 110), (0, -90, 0), fixed=True)
    room.put(
        "thermostat", [box(9, 9, 2), cyl(2.6, 1.4, (0, 3.8, 1.6), (90, 0, 0))], (479, 146, 374), (0, -90, 0), fixed=True
    )
    room.put(
        "key_card_slot",
        slabs(
            (-4, 4, 0, 12, 0, 1.2),
            (-4, 4, 0, 8, 3, 3.8),
            (-4, -3.2, 0, 8, 1.2, 3),
            (3.2, 4, 0, 8, 1.2, 3),
            (-3.2, 3.2, 0, 1, 1.2, 3),
        ),
        (479.8, 120, 402),
        (0, -90, 0),
        fixed=True,
    )
    room.put("key_card", box(5.4, 8.6, 0.3), (477.7, 121, 402), (0, -90, 0), fixed=True)
    plate = [box(8, 8, 0.9), box(5, 5, 0.6, (0, 1.5, 0.7))]
    room.put("light_switch_01", plate, (479.4, 108, 386), (0, -90, 0), fixed=True)
    room.put(
        "full_length_mirror",
        [box(44, 150, 2), box(40, 146, 0.6, (0, 2, 1.2))],
        (478.8, 30, 342),
        (0, -90, 0),
        fixed=True,
    )
    hooks = [tube([(x, 2, 1), (x, 2, 4), (x, 4.5, 5)], 0.6) for x in (-18, 0, 18)]
    hall = hotel.group("guest_room/hall", (345, 0, 419.7), 180)
    hall.put("coat_hooks", [box(50, 7, 1.6), *hooks], (0, 165, 0.6), fixed=True)
    loop = tube([(-4, -2, 4.6), (-2, 3, 2.9), (0, 5.9, 2.9), (2, 3, 2.9), (4, -2, 4.6)], 0.3, 6)
    hall.put("rain_jacket", [loop, moved(puff(44, 78, 7, 0.6), (0, -79, 4.6))], (-18, 162, -0.1), fixed=True)


def _window(place: Group) -> None:
    place.put("window_sill", box(250, 3, 18, (0, 0, 0)), (0, 87, 8.9), fixed=True)
    fins = [(x, x + 3, 15, 62, 3, 8) for x in range(-62, 62, 8)]
    place.put("radiator", slabs((-64, 64, 14, 18, 2.6, 8.4), (-64, 64, 58, 62, 2.6, 8.4), *fins))
    place.put(
        "radiator_valve",
        [cyl(1.6, 4, (0, -2, 0), (0, 0, 90)), cyl(2.6, 7, (5, -3.5, 0), (0, 0, 90))],
        (66.2, 59, 5.5),
        fixed=True,
    )
    for side, x in (("L", -134), ("R", 134)):
        place.put(
            f"rod_bracket_{side}",
            [
                box(4, 8, 1, (0, -6, 0.6)),
                tube([(0, 0, 0.8), (0, 0, 22)], 0.7),
                slabs(
                    (-0.6, 0.6, -1.8, 0, 21, 22.5),
                    (-0.6, 0.6, -1.8, -1.1, 22.5, 26.8),
                    (-0.6, 0.6, -1.1, 0.5, 25.6, 26.8),
                ),
            ],
            (x, 240, 0),
            fixed=True,
        )
    place.put(
        "curtain_rod",
        [cyl(1.1, 280, (0, -140, 0), (0, 0, 90)), *(moved(puff(5, 5, 5, 1), (x, -2.5, 0)) for x in (-141, 141))],
        (0, 240, 24),
        fixed=True,
    )
    for side, x, width, folds in (("L", -112, 40, 6), ("R", 104, 62, 8)):
        place.put(
            f"curtain_{side}",
            moved(drape(wave(width, 3.2, folds), 232, 0.4), (0, 0, 0), (90, 0, 0)),
            (x, 120.5, 24),
            fixed=True,
        )
        rings = place.group(f"rings_{side}", (x, 240, 24))
        for index in range(1, 3):
            ring = lathe([(1.6, -0.3), (2.1, -0.3), (2.1, 0.3), (1.6, 0.3), (1.6, -0.3)], 16)
            rings.put(
                f"ring_{index:02}",
                [moved(ring, (0, 0, 0), (0, 0, 90)), box(0.6, 2, 0.3, (0, -3.7, 0))],
                ((2 * index - 3) * width * (0.5 - 0.5 / folds), -0.5, 0),
                fixed=True,
                asset="curtain_ring",
            )
    place.put("blind_cassette", box(226, 7, 7), (0, 220.5, 3.6), fixed=True)
    place.put("blind_fabric", box(222, 53, 0.3), (0, 167.6, 3.6), fixed=True)
    place.put("blind_hem_bar", box(222, 2.4, 1.2), (0, 165.4, 3.6), fixed=True)
    sill = place.group("on_sill", (60, 90, 9), 12)
    sill.put("orchid_saucer", cup(6, 7, 1.6, 0.4))
    sill.put("orchid_pot", cup(4.6, 6, 11, 0.5), (0, 0.4, 0))
    sill.put("potting_soil", lathe([(0.001, 0.6), (4.1, 0.6), (5.2, 9.6), (0.001, 9.8)]), (0, 0.4, 0), fixed=True)
    stem = tube([(0, 7, 0), (1, 24, 0), (5, 40, 1), (12, 44, 2)], 0.35, 6)
    leaves = [moved(puff(14, 0.8, 5, 0.8), (5 * s, 10.4, s), (0, 25 * s, 12 * s)) for s in (-1, 1)]
    blooms = [moved(puff(5, 3, 5, 1), (x, y, 2)) for x, y in ((5, 39), (9, 42), (12.4, 43))]
    sill.put("orchid", [stem, *leaves, *blooms], (0, 0.4, 0), fixed=True)


def _seat(seat: Group) -> None:
    frame = (
        (-34, 34, 12, 26, -32, 32),
        (-34, -24, 26, 56, -32, 32),
        (24, 34, 26, 56, -32, 32),
        (-24, 24, 26, 82, -32, -20),
    )
    legs = [(x, x + 4, 0, 12, z, z + 4) for x in (-32, 28) for z in (-30, 26)]
    seat.put("armchair_shell", slabs(*frame, *legs))
    seat.put("seat_cushion", puff(47.4, 15, 51, 0.2), (0, 26, 5.8))
    seat.put("back_cushion", puff(44, 36, 14, 0.35), (0, 41, -9), (-6, 0, 0))
    seat.put(
        "plaid",
        drape([(22.4, 42), (22.6, 52), (24, 56.2), (30, 56.4), (34.6, 56), (35, 50), (35.2, 22)][::-1], 30, -0.8),
        (0, 0, 4),
        fixed=True,
    )
    table = seat.group("side_table", (-62, 0, 6), 20)
    table.put("side_table", [cyl(24, 2.4, (0, 48, 0)), tube([(0, 2, 0), (0, 49, 0)], 2), cyl(15, 2)])
    table.put("saucer", SAUCER, (9, 50.4, 8), asset="saucer")
    table.put("coffee_cup", CUP, (9, 50.8, 8), (0, -40, 0), asset="tea_cup")
    table.put("cake_plate", lathe([(0.001, 0), (6, 0), (9, 1.4), (8.9, 1.8), (5.8, 0.5), (0.001, 0.5)]), (8, 50.4, -10))
    table.put("biscuit_01", cyl(2.8, 0.9), (6.2, 50.9, -11))
    table.put("biscuit_02", cyl(2.8, 0.9), (9, 51.6, -9.6), (0, 0, -14), fixed=True)
    lamp = seat.group("floor_lamp", (0, 0, -50))
    lamp.put("floor_lamp", [cyl(14, 2), tube([(0, 2, 0), (0, 140, 0)], 1.1)])
    lamp.put(
        "floor_lamp_shade",
        [lathe([(14, 34), (20, 0), (19.6, 0), (13.6, 34), (14, 34)]), box(30, 0.6, 0.6, (0, 16, 0))],
        (0, 123.6, 0),
        fixed=True,
    )


def _luggage(place: Group) -> None:
    bars = [tube([(x, 0.8, -z), (x, 48, z)], 1.3) for x in (-32, 32) for z in (-22, 22)]
    ends = [tube([(-34, 48.4, z), (34, 48.4, z)], 1.3) for z in (-22, 22)]
    straps = [box(5, 0.4, 46, (x, 49.4, 0)) for x in (-20, 0, 20)]
    place.put("luggage_rack", [*bars, *ends, *straps, tube([(-32, 24, 0), (32, 24, 0)], 0.8)], (0, 0.1, 0))
    case = place.group("suitcase", (2, 50.2, 1), 3)
    case.put("suitcase_base", crate(66, 14, 44, 0.6), fixed=True)
    # The lid is open to 100 degrees; its hinge is at the back of the base.
    lid = slabs(
        (-33, 33, 0, 44, -0.6, 0),
        (-33, 33, 0, 0.6, 0, 11),
        (-33, 33, 43.4, 44, 0, 11),
        (-33, -32.4, 0.6, 43.4, 0, 11),
        (32.4, 33, 0.6, 43.4, 0, 11),
    )
    case.put("suitcase_lid", moved(lid, (0, 0, 0), (-10, 0, 0)), (0, 12.3, -32.9), fixed=True)
    case.put("suitcase_handle", tube([(-9, 7, 22), (-8, 8, 25), (8, 8, 25), (9, 7, 22)], 0.7, 6), fixed=True)
    case.put("shirt_01", puff(24, 3, 32, 0.25), (-19, 0.6, -1))
    case.put("shirt_02", puff(24, 2.8, 31, 0.25), (-18.8, 3.6, -1), (0, 3, 0))
    case.put("jeans_folded", puff(22, 5, 38, 0.3), (5, 0.6, 0))
    case.put("toiletry_bag", puff(20, 8, 13, 0.4), (5, 5.6, -7), (0, -10, 0))
    case.put("sock_ball_01", puff(8, 7, 7, 0.9), (24, 0.6, -12), (0, 30, 0))
    case.put("sandals", [box(8, 2.4, 25, (-5, 0, 0)), box(8, 2.4, 25, (5, 0, 1))], (-19, 6.4, 0), (0, 10, 0))
    place.put(
        "luggage_tag",
        [
            box(5, 8, 0.3, (0, -11, 0)),
            tube([(0, -3, 0), (0, -0.8, 1.1), (0, 0.95, 0.9), (0, 0.95, -0.9), (0, -0.8, -1.1), (0, -3, 0)], 0.15, 5),
        ],
        (2, 58.2, 26),
        fixed=True,
    )
    place.put(
        "backpack",
        [puff(34, 46, 22, 0.4), tube([(-6, 44, -6), (0, 50, -8), (6, 44, -6)], 0.8)],
        (-2, 0, 43),
        (0, 184, 0),
    )
