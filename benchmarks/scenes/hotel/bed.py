"""The double bed, its two nightstands and what is on and over them."""

from benchmarks.scenes.hotel.shapes import ball, box, crate, cup, cyl, drape, lathe, moved, puff, slabs, tube
from benchmarks.scenes.hotel.stage import Group, Hotel

__all__ = ["PLUG", "SOCKET", "build_bed"]

SOCKET = (slabs((-4, 4, -4, 4, 0, 0.6)), cyl(2.6, 0.8, (0, -0.4, 0.6), (90, 0, 0)))
"""Its back is at z = 0, its face at z = 1."""
PLUG = (
    cyl(1.9, 3, (0, -1.5, 2.5), (90, 0, 0)),
    cyl(0.25, 1.6, (-0.9, -0.8, 1.3), (90, 0, 0)),
    cyl(0.25, 1.6, (0.9, -0.8, 1.3), (90, 0, 0)),
)
"""Its pins go into a socket whose face is at z = 1."""


def build_bed(hotel: Hotel) -> None:
    """Add the sleeping corner; its head is at the west wall."""
    bed = hotel.group("guest_room/bed", (13.2, 0, 190), 90)
    bed.put(
        "headboard",
        [box(185, 90, 5), *(box(40, 70, 2, (46 * i - 69, 12, 3.4)) for i in range(4))],
        (0, 25, -0.5),
        fixed=True,
    )
    legs = [(x, x + 6, 0, 16, z, z + 6) for x in (-78, -3, 72) for z in (16, 198)]
    bed.put("bed_frame", slabs(*legs, (-82, 82, 16, 28, 9, 212)))
    bed.put("mattress", puff(160, 22, 200, 0.12), (0, 28, 110))
    side = [(-82.5, 30), (-82, 44), (-79, 50), (-60, 50.4), (0, 50.2), (60, 50.4), (79, 50), (82, 44), (82.5, 28)]
    bed.put("duvet", drape(side, 146, 4.5), (0, 0, 140), fixed=True)
    bed.put("pillow_01", puff(70, 13, 42, 0.5), (-40, 49.8, 34), (0, 3, 0))
    bed.put("pillow_02", puff(70, 13, 42, 0.5), (41, 49.8, 33))
    bed.put("pillow_03", puff(68, 12, 40, 0.5), (-39, 62.4, 32), (0, -2, 0))
    bed.put("pillow_04", puff(68, 12, 40, 0.5), (40, 62.55, 33), (0, 4, 0))
    over = [(-88, 20), (-88, 44), (-85, 53), (-80, 55.4), (0, 55.2), (80, 55.4), (85, 53), (88, 44), (88, 24)]
    bed.put("bed_runner", drape(over, 50, 1), (0, -0.15, 180), fixed=True)
    bed.put("cushion_01", puff(38, 38, 14, 0.5), (-18, 56.2, 73), (-28, 0, 0))
    bed.put("turndown_chocolate", box(3.5, 1, 3.5), (-40, 74.2, 32), (0, 25, 0))
    for name, x in (("L", 62), ("R", -62)):
        arm = (
            box(6, 8, 1),
            tube([(0, 4, 1), (0, 4, 6), (0, 9, 14), (0, 8, 20)], 0.7),
            moved(lathe([(0.001, 0), (3.5, 0), (2.2, 6), (0.001, 6.5)], 14), (0, 3, 21)),
        )
        bed.put(f"reading_light_{name}", arm, (x, 92, 4.5), fixed=True, asset="reading_light")
    room = hotel.group("guest_room/nightstands")
    for name, z in (("L", 74), ("R", 306)):
        _nightstand(room, name, z)
    _left(room.group("on_L", (36, 52, 74), 90))
    _right(room.group("on_R", (36, 52, 306), 90))
    hotel.group("guest_room/rug", (118, 0, 296), 4).put("bedside_rug", puff(110, 1.4, 55, 0.1))


def _nightstand(room: Group, name: str, z: float) -> None:
    stand = room.group(f"nightstand_{name}", (36, 0, z), 90)
    stand.put(
        "carcass",
        slabs(
            (-24, -22, 0, 50, -20, 20),
            (22, 24, 0, 50, -20, 20),
            (-24, 24, 50, 52, -20, 20),
            (-22, 22, 8, 10, -20, 20),
            (-22, 22, 32, 33.5, -20, 20),
            (-22, 22, 10, 50, -20, -19),
        ),
        asset="nightstand_carcass",
    )
    drawer = slabs(
        (-20.5, 20.5, 0, 1, -18, 19),
        (-20.5, -19.5, 1, 11, -18, 19),
        (19.5, 20.5, 1, 11, -18, 19),
        (-19.5, 19.5, 1, 11, -18, -17),
        (-21.7, 21.7, -0.3, 15.5, 19, 20.8),
    )
    out = 0.0 if name == "L" else 14.0
    stand.put("drawer", drawer, (0, 34, out), asset="nightstand_drawer", fixed=True)
    stand.put(
        "knob",
        [cyl(0.5, 1.6, (0, -0.8, 0.8), (90, 0, 0)), ball(2.4, 2.4, 2, (0, -1.2, 2))],
        (0, 41.5, 20.8 + out),
        fixed=True,
    )


def _lamp(place: Group, at: tuple[float, float, float]) -> None:
    x, y, z = at
    place.put(
        "lamp_foot",
        [lathe([(0.001, 0), (7, 0), (7, 1.5), (2, 3), (3.5, 10), (1, 18), (1, 24), (0.001, 24)])],
        at,
        asset="lamp_foot",
    )
    place.put(
        "lamp_shade",
        [lathe([(8, 14), (14, -4), (13.6, -4), (7.6, 14), (8, 14)]), box(25.4, 0.4, 0.6, (0, -0.1, 0))],
        (x, y + 24, z),
        fixed=True,
    )
    place.put(
        "lamp_bulb",
        lathe([(0.001, 0), (1.2, 0), (1.3, 2), (3, 6), (2, 9), (0.001, 9.6)], 14),
        (x, y + 24.1, z),
        fixed=True,
    )


def _left(top: Group) -> None:
    _lamp(top, (12, 0, -6))
    top.put("phone_base", [box(16, 3.5, 20), box(8, 0.6, 8, (3, 3.5, 3))], (-9, 0, -6), (0, -10, 0))
    handset = (box(4.4, 2.4, 18, (0, 1.6, 0)), box(4.4, 1.6, 4.6, (0, 0, -6.6)), box(4.4, 1.6, 4.6, (0, 0, 6.6)))
    top.put("phone_handset", handset, (-13.6, 3.5, -6.8), (0, -10, 0))
    top.put("notepad", box(8, 0.8, 11), (-9, 0, 12), (0, 15, 0))
    top.put("ballpoint", tube([(-7, 0, 0), (6, 0, 0), (7.2, 0, 0)], 0.4), (-9, 1.2, 12), (0, 40, 0))
    inside = top.group("drawer_content", (0, -17, 0))
    inside.put("bible", box(13, 4, 19), (-5, 0, 2), (0, 8, 0))
    inside.put("guest_letter", box(14.8, 0.2, 21), (-5.3, 4, 2), (0, 3, 0))
    top.group("compartment", (0, -42, 0)).put("tissue_box", crate(23, 7, 12, 0.3, top=7), (1, 0, 2), (0, 4, 0))
    _socket(top, "L", 31)


def _right(top: Group) -> None:
    _lamp(top, (11, 0, -7))
    top.put("coaster", cyl(4.8, 0.5), (-10, 0, 6))
    top.put("water_glass", cup(3, 3.6, 11, 0.25), (-9.6, 0.5, 6.2))
    top.put("mobile_phone", box(7.4, 0.8, 15), (2, 0, 8), (0, -20, 0))
    charger = (
        slabs((-2, 2, -2, 2, 1.2, 5)),
        box(0.5, 0.5, 1.2, (-0.9, -0.25, 0.7)),
        box(0.5, 0.5, 1.2, (0.9, -0.25, 0.7)),
    )
    top.put("usb_charger", charger, (-31, 2, -25.8), fixed=True)
    cable = [(-31, 2, -20.9), (-30, 2, -10), (-24.6, 0.4, 0), (-20, 0.3, 14), (-8, 0.3, 17.4), (-0.6, 0.35, 15.2)]
    top.put("usb_cable", tube(cable, 0.22, 6), fixed=True)
    top.put("tv_remote", [box(4.6, 2, 17), box(3.6, 0.3, 12, (0, 2, -1))], (-13, 0, -8), (0, 20, 0))
    under = top.group("compartment", (0, -42, 0))
    for name, x in (("L", -6), ("R", 5)):
        sole = (box(9, 1, 26), drape([(-4.4, 1), (-4, 4.5), (0, 6), (4, 4.5), (4.4, 1)], 12, 0.4))
        under.put(
            f"slipper_{name}",
            sole,
            (x, 0, 4 if name == "L" else 2),
            (0, 184 if name == "L" else 180, 0),
            asset="slipper",
        )
    drawer = top.group("drawer_content", (0, -17, 14))
    drawer.put("passport", box(8.8, 0.5, 12.5), (-10, 0, 3), (0, -7, 0))
    _socket(top, "R", -31)


def _socket(top: Group, side: str, x: float) -> None:
    # The nightstands are 6 cm from the wall, the sockets 2 cm above their tops and beside them.
    top.put("socket", SOCKET, (x, 2, -25.8), fixed=True, asset="socket")
    if side == "L":
        top.put("lamp_plug", PLUG, (x, 2, -25.9), fixed=True, asset="plug")
        cable = [(x, 2, -22), (x, -2, -18), (25.5, 2, -14), (19, 0.4, -9), (17.6, 0.5, -7)]
        top.put("lamp_cable", tube(cable, 0.3, 6), fixed=True)
