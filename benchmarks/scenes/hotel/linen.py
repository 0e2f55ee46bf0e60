"""The linen room: an open rack, a cupboard, bags in frames, and things on the wall."""

from benchmarks.scenes.hotel.bathroom import ROLL
from benchmarks.scenes.hotel.shapes import Part, box, crate, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel
from benchmarks.scenes.hotel.trolley import spray_bottle

__all__ = ["build_linen_room"]


def build_linen_room(hotel: Hotel) -> None:
    """Add the linen room, in a frame at its north-west corner."""
    room = hotel.group("linen_room", (10, 0, 590))
    _rack(room.group("rack", (240, 0, 174), 180, unit=0.1))
    _cupboard(room.group("cupboard", (20.5, 0, 130), 90))
    for name, x, z, turn in (("white", 108, 152, 0), ("terry", 114, 86, 25)):
        _sack(room.group(f"sack_{name}", (x, 0, z), turn), name)
    room.put(
        "tube_light",
        [
            box(122, 5, 14, (0, 4, 0)),
            tube([(-58, 2.4, 0), (58, 2.4, 0)], 1.5),
            *(box(2, 5, 4, (x, 0, 0)) for x in (-59, 59)),
        ],
        (190, 250.9, 100),
        fixed=True,
    )
    ladder = [tube([(x, 0.8, 0), (x, 180, 0)], 1.4) for x in (-18, 18)] + [
        tube([(-18, y, 0), (18, y, 0)], 1) for y in range(25, 170, 29)
    ]
    room.put("ladder", ladder, (345, -0.5, 60), (0, 90, -7.5), fixed=True)
    hooks = room.group("hooks", (90, 150, 0.2))
    hooks.put(
        "peg_board",
        [box(60, 8, 2, (0, -4, 1)), *(tube([(x, 0, 2), (x, 0, 6), (x, 2, 7)], 0.6) for x in (-20, 0, 20))],
        fixed=True,
    )
    loop = tube([(-4, -8, 4.6), (-2, -2, 4), (0, 1, 3.8), (2, -2, 4), (4, -8, 4.6)], 0.35, 6)
    hooks.put("apron", [loop, slabs((-15, 15, -45, -8, 4.4, 5), (-26, 26, -92, -45, 4.4, 5))], (-20, 0, 0), fixed=True)
    ring = lathe([(2, -0.2), (2.5, -0.2), (2.5, 0.2), (2, 0.2), (2, -0.2)], 16)
    hooks.put(
        "key_ring",
        [moved(ring, (0, -1.4, 4), (90, 0, 0)), slabs((-0.5, 0.5, -9, -3.6, 3.9, 4.2), (0.8, 1.7, -8, -3.2, 3.8, 4.1))],
        (20, 0, 0),
        fixed=True,
    )


def _rack(rack: Group) -> None:
    heights = (12, 66, 120, 174)
    posts = [(x, x + 3, 0, 200, z, z + 3) for x in (-95, 92) for z in (-24, 21)]
    rack.put("linen_rack", slabs(*posts, *((-95, 95, y, y + 2, -24, 24) for y in heights)))
    # The boards' tops are 2 cm higher than their undersides.
    for index, (x, y, size) in enumerate(((-66, 68, 8), (-66.4, 76, 8), (-12, 68, 9)), 1):
        rack.put(f"sheet_pack_{index:02}", puff(44, size, 36, 0.25), (x, y, 0), (0, (0, 2, -3)[index % 3], 0))
    rack.put("pillow_01", puff(62, 13, 40, 0.5), (48, 68, 0))
    rack.put("duvet_bag", puff(70, 34, 44, 0.4), (-52, 122, 0))
    rack.put("lidded_box", crate(50, 24, 38, 1, top=24), (24, 122, 0), (0, 2, 0))
    rack.put(
        "box_lid",
        slabs(
            (-26, 26, 0, 1, -20, 20),
            (-26, -25.4, -5, 0, -20, 20),
            (25.4, 26, -5, 0, -20, 20),
            (-25.4, 25.4, -5, 0, -20, -19.4),
            (-25.4, 25.4, -5, 0, 19.4, 20),
        ),
        (24, 146.1, 0),
        (0, 2, 0),
    )
    rack.put("sewing_tin", crate(20, 8, 14, 0.3), (72, 122, 4), (0, -15, 0))
    spool = lathe([(0.001, 0), (2, 0), (2, 0.5), (1.4, 0.8), (1.4, 4), (2, 4.3), (2, 4.8), (0.001, 4.8)], 14)
    rack.put("thread_spool_01", spool, (68, 122.3, 4))
    rack.put("baby_bath", crate(74, 22, 44, 0.8), (-40, 176, 0))
    rack.put("rubber_duck", [puff(8, 6, 10, 0.9), puff(5, 5, 5, 1)], (-34, 176.8, 4), (0, 40, 0))
    rack.put("shelf_label_01", box(8, 2.4, 0.2), (-66, 65.8, 24.2), fixed=True)
    rack.put(
        "vacuum_cleaner",
        [puff(34, 24, 46, 0.5), tube([(0, 16, 20), (6, 24, 26), (14, 22, 22), (16, 4, 16)], 1.8)],
        (-58, 14, -1),
        (0, 90, 0),
    )


def _cupboard(case: Group) -> None:
    sides = ((-45, -43, 0, 180, -20, 20), (43, 45, 0, 180, -20, 20), (-43, 43, 0, 180, -20, -19))
    boards = [(-43, 43, y, y + 2, -19, 20) for y in (6, 60, 114, 178)]
    case.put("open_cupboard", slabs(*sides, *boards))
    case.put("cleaner_spray_01", spray_bottle(), (-30, 62, 2), (0, 70, 0), asset="spray_bottle")
    rolls = [moved(ROLL[0], (x, 0, z)) for x in (-11, 0, 11) for z in (-5.6, 5.6)]
    case.put("roll_pack", rolls, (-24, 116, 0))
    case.put("bulb_carton", crate(30, 20, 24, 0.5), (20, 116, 0), (0, -6, 0))
    bulb = [lathe([(0.001, 0), (1.2, 0), (1.3, 2), (3, 6), (2, 9), (0.001, 9.6)], 14)]
    case.put("spare_bulb_01", bulb, (18, 116.5, 1))
    case.put("rag_bucket", [lathe([(0.001, 0), (11, 0), (14, 26), (13.4, 26), (10.4, 0.6), (0.001, 0.6)])], (20, 8, 1))
    case.put("rags", puff(19, 13, 18, 0.8), (20, 8.6, 1), (0, 30, 0))


def _sack(sack: Group, name: str) -> None:
    hoop = [(-22, 82, -20), (22, 82, -20), (22, 82, 20), (-22, 82, 20), (-22, 82, -20)]
    legs = [tube([(x, 82, z), (x * 1.15, 0.2, z * 1.15)], 1.1) for x in (-22, 22) for z in (-20, 20)]
    sack.put(
        "bag_frame",
        [tube(hoop, 1.1), *legs, *(tube([(-25, 5, z), (25, 5, z)], 0.8) for z in (-22.8, 22.8))],
        fixed=True,
    )
    inner = [
        (-20, 20, 22, 22.4, -18, 18),
        (-20.4, -20, 22, 83.4, -18.4, 18.4),
        (20, 20.4, 22, 83.4, -18.4, 18.4),
        (-20, 20, 22, 83.4, -18.4, -18),
        (-20, 20, 22, 83.4, 18, 18.4),
    ]
    hem = [(s * 22 - 2, s * 22 + 2, 83.2, 83.6, -18.4, 18.4) for s in (-1, 1)] + [
        (-20, 20, 83.2, 83.6, s * 20 - 2, s * 20 + 2) for s in (-1, 1)
    ]
    flaps: list[tuple[float, ...]] = [(s * 23.6 - 0.2, s * 23.6 + 0.2, 70, 83.6, -18.4, 18.4) for s in (-1, 1)]
    # Its hem is folded over the hoop.
    sack.put("bag", slabs(*inner, *hem, *flaps), fixed=True)
    heap: list[tuple[str, Part, float]] = [("bundle_01", puff(36, 30, 32, 0.7), 22.4)]
    if name == "white":
        heap.append(("bundle_02", puff(34, 26, 30, 0.8), 52.0))
    for label, part, y in heap:
        sack.put(label, part, (0.4, y, 0), (0, 5, 0))
