"""The wardrobe with its content, and the ironing board on the door of the bathroom."""

from benchmarks.scenes.hotel.shapes import Part, box, crate, cyl, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["build_wardrobe"]

HOOK = tube([(0, 0, 0), (0, 3, 0), (1.6, 4.2, 0), (2, 6, 0), (0, 7.9, 0), (-2, 6, 0), (-2.1, 5, 0)], 0.22, 6)
HANGER = (HOOK, tube([(-21, -7, 0), (-20, -5.6, 0), (0, 0, 0), (20, -5.6, 0), (21, -7, 0), (-21, -7, 0)], 0.45, 6))
"""Wire hanger in the plane of x; its hook's crook is 7.7 cm above the top of its shoulders."""
RAIL_Y = 178.0


def _garment(width: float, length: float, depth: float) -> Part:
    """Return a hollow coat over the shoulders of a hanger whose middle is at the origin; its neck is open."""
    r = width / 2
    coat = lathe([(r + 2, -length), (r + 1, -7.6), (5, 0.7), (4.2, 0), (r, -7.3), (r + 1, -length), (r + 2, -length)])
    return Part("Mesh", points=coat.points * (1, 1, depth / width), faces=coat.faces)


def build_wardrobe(hotel: Hotel) -> None:
    """Add the wardrobe; the left sliding door is pushed to the right."""
    ward = hotel.group("guest_room/wardrobe", (449.5, 0, 110), -90)
    ward.put(
        "carcass",
        slabs(
            (-90, -88, 0, 215, -29, 31),
            (88, 90, 0, 215, -29, 31),
            (-88, 88, 8, 10, -29, 31),
            (-88, 88, 213, 215, -29, 31),
            (-88, 88, 0, 8, 22, 24),
            (-88, 88, 10, 213, -29, -28),
            (19, 21, 10, 213, -28, 24),
        ),
    )
    ward.put("sliding_door_L", box(90, 201.6, 2), (-3, 10.6, 29.4), fixed=True)
    ward.put("sliding_door_R", box(90, 201.6, 2), (42.5, 10.6, 26.4), fixed=True)
    for name, x, z in (("L", -44, 30.4), ("R", 84, 27.4)):
        ward.put(f"door_grip_{name}", box(2, 40, 0.5, (0, -20, 0.2)), (x, 105, z), fixed=True)
    shelves = ward.group("shelves", (54.5, 0, -2))
    for index, y in enumerate((50, 90, 130, 170), 1):
        shelves.put(f"shelf_{index:02}", box(66.6, 1.8, 51), (0, y, 0), fixed=True)
    shelves.put("laundry_bag", puff(30, 4, 38, 0.5), (-12, 51.8, 0), (0, 6, 0))
    shelves.put(
        "iron",
        [puff(12, 7, 24, 0.7), tube([(0, 6, -8), (0, 11, -8), (0, 12, 6), (0, 6, 8)], 1.1)],
        (20, 51.8, -2),
        (0, -8, 0),
    )
    shelves.put("spare_blanket", puff(58, 14, 42, 0.3), (0, 131.8, 1), (0, 2, 0))
    shelves.put("spare_pillow", puff(56, 14, 42, 0.5), (-1, 145.8, 0), (0, -3, 0))
    _safe(shelves.group("safe", (-4, 91.8, 0)))
    _rail(ward)
    _floor(ward.group("floor", (-34, 10, 0)))
    bath = hotel.group("guest_room/ironing", (441.5, 0, 287.5))
    arms = [
        tube([(x, 192, 6), (x, 189, 6), (x, 189, 2.4), (x, 204.9, 2.4), (x, 204.9, -2.4), (x, 198, -2.4)], 0.35, 6)
        for x in (-10, 10)
    ]
    bath.put("over_door_hook", [*arms, box(22, 2, 0.4, (0, 195, 2.8))], fixed=True)
    bow = tube([(-13, 184, 8.2), (-13, 189.8, 4.2), (13, 189.8, 4.2), (13, 184, 8.2)], 0.4, 6)
    leg = tube([(-12, 70, 6.9), (12, 120, 6.9), (12, 175, 6.9)], 0.9)
    bath.put("ironing_board", [slabs((-17, 17, 60, 186, 7.8, 11)), leg, bow], fixed=True)


def _safe(safe: Group) -> None:
    safe.put("safe_body", crate(42, 24, 36, 1.2, side="front"))
    safe.put("safe_door", box(39.2, 21.2, 1.6), (0, 1.4, 17), fixed=True)
    safe.put("safe_keypad", box(9, 6, 0.6), (8, 9, 18.1), fixed=True)
    safe.put("jewel_case", puff(11, 5, 8, 0.2), (-9, 1.2, -3), (0, 17, 0))


def _rail(ward: Group) -> None:
    rail = ward.group("hanging", (-34.5, RAIL_Y, -3))
    rail.put("rail", cyl(1.2, 106.6, (0, -53.3, 0), (0, 0, 90)), fixed=True)
    coats = {1: ("wool_coat", 46, 105.0, 11.0), 2: ("suit_jacket", 46, 72.0, 9.0), 3: ("blouse", 42, 64.0, 6.0)}
    for index, (x, turn) in enumerate(((-44, 88), (-20, 86), (0, 91), (16, 84)), 1):
        # The crook of the hook lies on the rail from above.
        y = -6.4
        rail.put(f"hanger_{index:02}", HANGER, (x, y, 0), (0, turn, 0), fixed=True, asset="wire_hanger")
        if index in coats:
            name, width, length, depth = coats[index]
            rail.put(name, _garment(width, length, depth), (x, y, 0), (0, turn, 0), fixed=True)


def _floor(floor: Group) -> None:
    for name, x in (("L", -38), ("R", -27)):
        parts = [puff(9, 3, 28, 0.7), moved(puff(8.6, 7, 13, 0.5), (0, 1.5, -7))]
        floor.put(
            f"leather_shoe_{name}",
            parts,
            (x, 0, 2 if name == "L" else -1),
            (0, 4 if name == "L" else -5, 0),
            asset="leather_shoe",
        )
    umbrella = (
        lathe([(0.001, 0), (0.6, 2), (2.6, 18), (3, 52), (0.7, 56), (0.7, 74), (0.001, 74)], 12),
        tube([(0, 73, 0), (0, 78, 0), (2.5, 81, 0), (5, 78, 0)], 0.8),
    )
    # It leans with its handle on the partition.
    floor.put("umbrella", umbrella, (36.2, 0.1, -16), (0, 0, -8), fixed=True)
