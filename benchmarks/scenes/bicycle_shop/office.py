"""The desk at the wall of the storeroom."""

from benchmarks.scenes.bicycle_shop.parts import (
    Mesh,
    ball,
    block,
    capsule,
    cone,
    cube,
    cyl,
    merge,
    ring,
    shift,
    tube,
    vessel,
)
from benchmarks.scenes.bicycle_shop.stage import Asset, Group, Shop
from benchmarks.scenes.bicycle_shop.things import MUG, drawer

__all__ = ["build_office"]

PAPERS = Asset("papers", (cube(21, 30, 1.6),))
BINDER = Asset("binder", (cube(7.5, 28, 31), tube((0, -14.1, 6), (0, -13.6, 6), 1.4)))
PIN = Asset("pin", (tube((0, 0.2, 0), (0, -0.9, 0), 0.35),))
TOP = 74.0


def build_office(shop: Shop) -> None:
    """Add the desk and what is on, in, over and below it; the wall is at y = 0."""
    office = shop.group("Office", (688, 575, 0), -90)
    desk = merge(
        block(-75, 75, -72, -2, 71, TOP),
        block(-75, -72, -70, -4, 0, 71),
        block(72, 75, -70, -4, 0, 71),
        block(-72, 72, -8, -6, 30, 71),
    )
    office.rest("Desk", desk, (0, 0, 0))
    _fill_desk(office)
    _build_drawers(office)
    _build_wall(office)
    chair = [
        cyl(24, 7, 0, 0, 42),
        cube(40, 5, 46, 0, -24, 56),
        tube((0, -20, 46), (0, -26, 60), 1.6),
        cyl(3, 36, 0, 0, 7),
    ]
    chair += [
        tube((0, 0, 8), (26 * x, 26 * y, 4.4), 1.8)
        for x, y in ((1, 0), (0.31, 0.95), (-0.81, 0.59), (-0.81, -0.59), (0.31, -0.95))
    ]
    chair += [
        ball(3, 28 * x, 28 * y, 3) for x, y in ((1, 0), (0.31, 0.95), (-0.81, 0.59), (-0.81, -0.59), (0.31, -0.95))
    ]
    office.rest("Swivel_chair", chair, (-6, -104, 0), (0, 0, 24))
    office.put(
        "Jacket",
        [cube(44, 1.6, 40, 0, -27.6, 63), cube(44, 8.4, 1.4, 0, -24.2, 102.2), cube(40, 1.4, 22, 0, -20.6, 81)],
        (-6, -104, 0),
        (0, 0, 24),
    )
    office.rest("Waste_paper_basket", vessel(11, 14, 30, 0.3), (-52, -42, 0))
    office.put("Paper_ball_1", ball(4, -54, -42, 4.6))
    office.put("Paper_ball_2", ball(4.4, -49, -39, 11))
    office.rest("Paper_ball_3", ball(4, 0, 0, 4), (-36, -62, 0))
    office.rest("Shredder_box", cube(36, 26, 24), (-8, -28, 0), (0, 0, -7))


def _fill_desk(office: Group) -> None:
    screen = [cube(24, 18, 1.4), tube((0, 3, 1), (0, 3, 22), 1.8), cube(56, 3, 34, 0, 0, 12)]
    office.rest("Monitor", screen, (-2, -20, TOP), (0, 0, 4))
    office.put("Sticky_note", cube(7.6, 0.1, 7.6, 22, -1.7, 36), (-2, -20, TOP), (0, 0, 4))
    office.rest("Keyboard", cube(44, 14, 2.2), (-6, -54, TOP), (0, 0, -3))
    office.rest("Mouse_pad", cube(24, 20, 0.3), (34, -54, TOP), (0, 0, 5))
    office.rest("Mouse", capsule((0, -3, 1.6), (0, 3, 1.6), 1.8), (35, -53, TOP + 0.7), (0, 0, -10))
    tray = merge(
        block(-13, 13, -17, 17, 0, 0.6),
        block(-13, -12.5, -17, 17, 0.6, 6),
        block(12.5, 13, -17, 17, 0.6, 6),
        block(-12.5, 12.5, 16.5, 17, 0.6, 6),
        *(block(x, x + 1, y, y + 1, 6, 9) for x in (-13, 12) for y in (-16, 15)),
    )
    office.rest("Inbox_tray_lower", tray, (-57, -24, TOP), (0, 0, 3))
    office.put("Inbox_tray_upper", tray, (-57, -24, TOP + 9.2), (0, 0, 3))
    office.rest("Invoices", PAPERS, (-57, -24.6, TOP + 0.7), (0, 0, 5))
    office.rest("Order_forms", PAPERS, (-57, -23.6, TOP + 9.9), (0, 0, 1))
    office.rest("Envelope", cube(22, 11, 0.4), (-57, -27, TOP + 11.5), (0, 0, -20))
    office.rest("Pen_cup", vessel(3.6, 4, 10, 0.3), (46, -16, TOP))
    for number, (x, y, a, b) in enumerate(((-1.2, 0, 0, 11), (1.4, 0.6, 5, -10), (0.2, 1.4, -12, 3)), 1):
        pen = [capsule((0, 0, 0.5), (0, 0, 13), 0.4)]
        office.put(f"Pen_{number}", pen, (46 - x, -16 + y, TOP + 0.7), (a, b, 0))
    office.rest("Coaster", cyl(5, 0.4), (60, -30, TOP))
    office.rest("Coffee_mug", MUG, (60.3, -30, TOP + 0.4), (0, 0, 200))
    office.rest("Order_book", cube(18, 25, 2), (63, -53, TOP), (0, 0, -6))
    office.rest("Fountain_pen", capsule((-6, 0, 0.5), (6, 0, 0.5), 0.5), (63, -54, TOP + 2), (0, 0, 70))
    office.rest("Telephone", [cube(18, 20, 4), cube(5, 21, 3, -6, 0, 4.2)], (-56, -56, TOP), (0, 0, 14))
    lamp = [
        cyl(8, 2),
        tube((0, 0, 2), (3, 3, 34), 0.7),
        tube((3, 3, 34), (-14, -16, 44), 0.7),
        cone(7, 9, -15, -17, 37),
    ]
    office.rest("Desk_lamp", lamp, (64, -12, TOP))


def _build_drawers(office: Group) -> None:
    pedestal = office.shop.group("Office/Pedestal", (50, -9, 0))
    body = merge(
        block(-20, 20, -56, 0, 2, 4),
        block(-20, 20, -56, 0, 58, 60),
        block(-20, -18.4, -56, 0, 4, 58),
        block(18.4, 20, -56, 0, 4, 58),
        block(-18.4, 18.4, -1.6, 0, 4, 58),
    )
    pedestal.rest(
        "Cabinet", merge(body, *(block(x, x + 4, y, y + 4, 0, 2) for x in (-19, 15) for y in (-54, -6))), (0, 0, 0)
    )
    for number, (z, tall) in enumerate(((4.4, 25.2), (30, 14), (44.4, 13.2)), 1):
        out = 14.0 if number == 3 else 0.0
        pedestal.put(f"Drawer_{number}", drawer(36, 50, tall), (0, -56 - out, z))
        pedestal.put(
            f"Knob_{number}",
            [ball(1.5, 0, -1.6, 0), tube((0, 0.2, 0), (0, -1.6, 0), 0.6)],
            (0, -57.7 - out, z + tall / 2),
        )
    pedestal.rest("Stapler", [cube(4, 14, 3), cube(3, 13, 2, 0, 0, 3.4)], (-8, -60, 46.2), (0, 0, 30))
    pedestal.rest("Stamp", [cube(6, 4, 1.6), cyl(1.4, 4, 0, 0, 1.6)], (9, -62, 46.2))
    pedestal.rest("Cash_box", cube(24, 18, 8), (0, -34, 31.8), (0, 0, 4))
    pedestal.rest("Folders", cube(30, 36, 14), (0, -32, 6.2))


def _build_wall(office: Group) -> None:
    office.put("Binder_shelf", _shelf(), (0, 0, 132))
    for number, x in enumerate((-56, -48, -40.2), 1):
        office.rest(f"Binder_{number}", BINDER, (x, -15.5, 134))
    office.put("Binder_4", BINDER, (-27.9, -15.5, 134.6), (0, -9, 0))
    office.rest("Radio_clock", cube(14, 8, 8), (4, -12, 134), (0, 0, -8))
    office.rest("Small_pot", vessel(4, 5.4, 8, 0.5), (44, -12, 134))
    office.put("Cactus", [capsule((0, 0, -2), (0, 0, 8), 2.6), capsule((2, 0, 5), (5, 0, 9), 1.3)], (44, -12, 139.4))
    office.put("Notice_board", [cube(90, 1.6, 46, 0, -1.2, 0), cube(92, 2, 1.6, 0, -1.3, -1)], (12, 0, 176))
    for number, (x, z, turn) in enumerate(((-18, 192, 2), (-2, 188, -4), (16, 194, 0), (36, 186, 6)), 1):
        office.put(f"Note_{number}", cube(10.5, 0.1, 14.8, 0, 0, -13), (x, -2.2 - 0.02 * number, z + 12), (0, turn, 0))
        office.put(f"Pin_{number}", PIN, (x, -2.2, z + 12.2))
    office.put("Calendar_nail", tube((0, 0.4, 0), (0, -1.6, 0), 0.2), (-58, 0, 212))
    office.put("Calendar", [cube(30, 0.8, 42, 0, 0, -43), shift(ring(1.1, 0.15), 0, 0, -0.4)], (-58, -0.9, 211.7))
    keys = merge(
        block(-16, 16, -6, 0, 0, 1),
        block(-16, 16, -6, 0, 29, 30),
        block(-16, -15, -6, 0, 1, 29),
        block(15, 16, -6, 0, 1, 29),
        block(-15, 15, -0.8, 0, 1, 29),
    )
    office.put(
        "Key_cabinet", merge(keys, *(block(x, x + 0.6, -3.4, -0.8, 22, 22.6) for x in (-9, -3, 3, 9))), (78, -0.2, 166)
    )
    office.put("Key_cabinet_door", block(0, 32, -1, 0, 0, 30), (62, -6.3, 166), (0, 0, -70))
    for number, x in enumerate((-8.7, -2.7, 9.3), 1):
        key = [shift(ring(1.2, 0.2), 0, 0, -0.9), cube(1.4, 0.3, 5, 0, 0, -6.8)]
        office.put(f"Key_{number}", key, (78 + x, -2.6, 188.5))


def _shelf() -> Mesh:
    return merge(block(-64, 64, -28, 0.1, 0, 2), block(-64, -62, -28, 0.1, 2, 26), block(62, 64, -28, 0.1, 2, 26))
