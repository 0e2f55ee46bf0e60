"""The office nook, where the staff also change: lockers, desk, notice board, coat rail and extinguisher."""

from benchmarks.scenes.bakery.forms import Triple, bar, block, bulge, column, hoop, hose, orb, panels, turned, vessel
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import HANG, cup, drawer, loop_at, wall_hook

__all__ = ["build_office"]


def build_office(world: Area) -> None:
    """Add the room: x from 760 to 1150, z from 300 to 590."""
    office = world.area("Office")
    _lockers(office.area("Lockers", (850, 0, 300)))
    desk = office.area("Desk", (1150, 0, 450), -90)
    _desk(desk)
    _on_desk(desk.area("OnDesk", (0, 75, 0)))
    _pinned(office.area("NoticeBoard", (1150, 130, 450), -90))
    _rail(office.area("CoatRail", (900, 170, 590), 180))
    fire = office.area("FirePoint", (760, 0, 400), 90)
    fire.fix(
        "extinguisher_bracket",
        panels((-4, 4, 60, 112, 0.2, 0.8), (-8, 8, 60, 60.8, 0.2, 17), (-9, 9, 60.8, 63, 16.2, 17)),
    )
    bottle = turned([(0, 0), (7, 0), (7.4, 1), (7.4, 38), (5, 43), (2.6, 45), (2.6, 48), (0, 48)])
    lever = [block(2, 1, 11, (0, 48, 2)), block(2, 1, 10, (0, 50.6, 2), (-14, 0, 0)), block(2, 3, 2, (0, 48, -2))]
    fire.stand(
        "fire_extinguisher",
        [bottle, *lever, hose([(2, 46, 0), (7, 44, 2), (8.6, 36, 3), (8.6, 14, 3)], 0.9)],
        (0, 60.8, 8.6),
    )
    fire.fix("extinguisher_sign", panels((-10, 10, 150, 170, 0.1, 0.4)))


def _lockers(bank: Area) -> None:
    body: list[Triple] = [
        (-49, 49, 10, 11.5, 0.4, 48),
        (-49, 49, 178.5, 180, 0.4, 48),
        (-49, 49, 11.5, 178.5, 0.4, 1.4),
    ]
    body += [(x - 0.6, x + 0.6, 11.5, 178.5, 1.4, 48) for x in (-48.4, -16.2, 16.2, 48.4)]
    body += [(x - 15.4, x + 15.4, 150, 151, 1.4, 46) for x in (-32.3, 0, 32.3)]
    feet = [(x - 2, x + 2, 0, 10, z - 2, z + 2) for x in (-46, 46) for z in (4, 44)]
    bank.stand("locker_bank", panels(*body, *feet))
    for number, (x, turn) in enumerate([(-48, 0), (-14.4, -94), (16.4, 0)], start=1):
        door = bank.area(f"Door{number}", (x, 0, 48.3), turn)
        slots = [block(14, 0.8, 0.3, (15.8, 160 + 4 * k, 1.4)) for k in range(3)]
        door.fix(
            "locker_door", [panels((0, 31.4, 12, 178, 0, 1.4)), *slots, hoop(1.3, 0.3, (28, 100, 2.4), (0, 90, 0))]
        )
    lock = [hoop(1.6, 0.35, (0, 0, 0)), block(4.4, 4.6, 1.8, (0, -5.8, 0))]
    bank.fix("padlock", lock, (-20, 97.8, 50.7))
    bank.stand("rucksack", [bulge(26, 38, 20, 0.4), hoop(3, 0.5, (0, 39, 0))], (0, 11.5, 22))
    bank.fix("locker_hook", wall_hook(), (0, 136, 1.2))
    jacket = [loop_at(1.6, 0.25), block(22, 4, 9, (0, -6.8, 3.4)), block(26, 58, 11, (0, -64, 3.4))]
    bank.fix("work_jacket", jacket, (0, 136 + HANG[1], 1.2 + HANG[2]))


def _desk(desk: Area) -> None:
    sides = [(-70, -67, 0, 72, 2, 64), (67, 70, 0, 72, 2, 64), (-67, 24, 30, 72, 3, 5)]
    unit = [(24, 26, 26, 72, 3, 62), (26, 67, 26, 28, 3, 62), (26, 67, 28, 72, 3, 4.4), (26, 67, 49, 50, 4.4, 60)]
    desk.stand("desk", panels((-71, 71, 72, 75, 1, 67), *sides, *unit))
    for number, (y, out) in enumerate([(51, 22), (29, 0)], start=1):
        desk.fix(
            f"desk_drawer_{number:02}",
            drawer(39.6, 16, 54, (40.8, 0.6, 3.4)),
            (46.5, y, 64.2 + out),
            (0, 0, 0),
            "desk_drawer",
        )
        desk.fix(
            f"desk_knob_{number:02}",
            [column(0.8, 2, (0, 0, 0), (90, 0, 0)), orb(1.4, (0, -1.4, 2.8))],
            (46.5, y + 10, 64 + out),
        )
    desk.fix("envelopes", block(22, 4, 11), (46, 51.7, 70), (0, 5, 0))
    star = [bar((0, 9, 0), (26 * a, 6, 26 * b), 1.8) for a, b in _five()]
    wheels = [orb(3, (26 * a, 0, 26 * b)) for a, b in _five()]
    chair = [*star, *wheels, column(2.4, 34, (0, 8, 0)), bulge(46, 8, 44, 0.3).to(0, 41, 0)]
    back = [block(5, 40, 1.6, (0, 40, 23), (8, 0, 0)), block(42, 46, 6, (0, 60, 24), (8, 0, 0))]
    desk.stand("office_chair", [*chair, *back], (-20, 0, 96), (0, -14, 0))
    desk.stand("seat_cushion", bulge(38, 4, 37, 0.3), (-20, 48.8, 95), (0, -14, 0))
    desk.stand("paper_basket", vessel(11, 14, 28, 0.4), (-52, 0, 40))
    desk.stand("paper_ball", orb(4.4), (-50, 0.5, 41))


def _five() -> list[tuple[float, float]]:
    return [(1.0, 0.0), (0.31, 0.95), (-0.81, 0.59), (-0.81, -0.59), (0.31, -0.95)]


def _on_desk(top: Area) -> None:
    laptop = [block(33, 1.8, 23), block(33, 22, 0.9, (0, 1.2, -11.6), (-18, 0, 0))]
    top.stand("laptop", laptop, (-18, 0, 36), (0, 4, 0))
    lamp = [column(8, 2), bar((0, 1, 0), (-10, 30, 0), 0.9), bar((-10, 30, 0), (8, 46, 10), 0.8)]
    shade = turned([(0, 46), (4, 46), (8, 36), (7.6, 36), (3.8, 45.4), (0, 45.4)]).to(8, 0, 10)
    top.stand("desk_lamp", [*lamp, shade], (44, 0, 20), (0, 30, 0))
    top.stand("pen_cup", vessel(3.6, 4, 10, 0.3), (20, 0, 18))
    top.fix("pencil", [column(0.4, 16), turned([(0, 16), (0.4, 16), (0, 17.4)])], (20.8, 0.7, 18), (6, 0, -13))
    top.stand("tea_mug", cup(4.2, 9), (12, 0, 48), (0, 140, 0))
    top.stand("invoice_pile", [block(21, 3, 30), block(21, 0.4, 30, (0.4, 3, 0.6), (0, 6, 0))], (-54, 0, 34), (0, 3, 0))
    top.stand("paper_weight", orb(3.6, squash=0.7), (-54, 3.5, 32))
    top.fix(
        "laptop_cable",
        hose([(-34, 1, 30), (-40, 0.5, 24), (-38, 0.5, 14), (-20, 3, 5), (-10, 14, 3), (-8, 26, 1.2)], 0.35),
    )
    top.fix("desk_socket", [block(8, 8, 1.2, (0, -4, 0.7)), column(2, 0.4, (0, 0, 1.2), (90, 0, 0))], (-8, 26, 0))


def _pinned(board: Area) -> None:
    frame = [(-45, 45, 0, 60, 0.3, 1.7), (-47, 47, -2, 0, 0.3, 2.4), (-47, 47, 60, 62, 0.3, 2.4)]
    board.fix("cork_board", panels(*frame, (-47, -45, 0, 60, 0.3, 2.4), (45, 47, 0, 60, 0.3, 2.4)))
    pin = [bar((0, 0, -0.9), (0, 0, 0.5), 0.1), column(0.6, 0.9, (0, 0, 0.3), (90, 0, 0))]
    for name, x, y, w, h in (("shift_plan", -22, 24, 30, 21), ("postcard", 20, 38, 15, 10)):
        board.fix(name, panels((-w / 2, w / 2, -h, 1.5, 0.05, 0.15)), (x, y + 12, 1.7), (0, 0, -3))
    for name, x, y in (("red_pin", -22, 36), ("blue_pin", 20, 50)):
        board.fix(name, pin, (x, y, 1.6), like="drawing_pin")


def _rail(rail: Area) -> None:
    pegs = [hose([(x, 0, 1.8), (x, 0, 8), (x, 1.6, 9.4)], 0.7) for x in (-36, -12, 12, 36)]
    rail.fix("coat_rail", [panels((-50, 50, -5, 5, 0.2, 2)), *pegs])
    crook = hose([(0, -6, 0), (0, -4, 0), (2, -2.6, 0), (1.8, 0.2, 0), (0, 1, 0), (-1.6, 0.2, 0)], 0.25)
    arms = [hose([(0, -6, 0), (20, -13, 0), (-20, -13, 0), (0, -6, 0)], 0.35)]
    rail.fix("coat_hanger", [crook, *arms], (-12, 0, 5))
    jacket = [block(40, 4, 7, (0, -14.8, 0)), block(44, 64, 10, (0, -78, 0))]
    jacket += [block(9, 54, 8, (s * 26, -70, 0), (0, 0, s * 5)) for s in (-1, 1)]
    rail.fix("baker_jacket", jacket, (-12, 0, 5.6))
    strap = [(-9.0, -42.0, 0.0), (-7, -8, 0), (-1.2, 0.2, 0), (0, 0.45, 0), (1.2, 0.2, 0), (7, -8, 0), (9, -42, 0)]
    rail.fix("shoulder_bag", [hose(strap, 0.4), block(24, 22, 7, (0, -62, 0))], (36, 0.7, 5.4))
