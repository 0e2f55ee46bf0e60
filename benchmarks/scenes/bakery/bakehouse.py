"""The machines of the bakehouse along its walls: oven, proofer, flour bins, sink, mixer and rack trolley."""

from benchmarks.scenes.bakery.forms import (
    bar,
    block,
    bulge,
    column,
    hoop,
    hose,
    joined,
    open_box,
    orb,
    panels,
    vessel,
)
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import HANG, bottle, bow_handle, caster, loop_at, tray, wall_hook

__all__ = ["build_bakehouse"]


def build_bakehouse(house: Area) -> None:
    """Add what stands and hangs along the walls; the wall with the oven is at z = 0."""
    _oven(house.area("DeckOven", (120, 0, 0)))
    _proofer(house.area("Proofer", (262, 0, 0)))
    _bins(house.area("FlourBins", (400, 0, 0)))
    _tools(house.area("ToolRail", (400, 165, 0)))
    _sink(house.area("Sink", (640, 0, 0)))
    _mixer(house.area("Mixer", (560, 0, 220), -20))
    _trolley(house.area("RackTrolley", (690, 0, 318), 5))
    peel = [bar((0, 0, 0), (0, 132, 0), 1.4), block(1, 40, 28, (0, 128, 0))]
    house.fix("oven_peel", peel, (27.4, 0.2, 190), (0, 0, 9.2))
    left = house.area("LeftWall", (0, 0, 320), 90)
    left.fix("apron_hook", wall_hook(), (0, 160, 0))
    straps = hose([(-9, -32, 0), (-6, -10, 0), (-0.6, 0.2, 0), (0.6, 0.2, 0), (6, -10, 0), (9, -32, 0)], 0.4)
    left.fix(
        "apron",
        [straps, block(24, 26, 2, (0, -56, 0.4)), block(56, 62, 3, (0, -117, 0.4))],
        (0, 160 + HANG[1], HANG[2]),
    )
    fly_lamp = [block(46, 26, 8, (0, 210, 4.2)), *(bar((-20, y, 8.6), (20, y, 8.6), 1.2) for y in (218, 228))]
    house.area("BackWall", (500, 0, 0)).fix("fly_lamp", fly_lamp)


def _oven(oven: Area) -> None:
    body = [
        (-68, 68, 0, 30, 6, 92),
        (-70, 70, 30, 50, 0.5, 98),
        (-70, 70, 74, 90, 0.5, 98),
        (-70, 70, 114, 136, 0.5, 98),
    ]
    for low, high in ((50, 74), (90, 114)):
        body += [(-70, -61, low, high, 0.5, 98), (61, 70, low, high, 0.5, 98), (-61, 61, low, high, 0.5, 8)]
    oven.stand("oven_body", panels(*body))
    knob = [column(2.6, 2.4, (0, 0, 0), (90, 0, 0)), block(0.8, 4.6, 1, (0, -2.3, 2.8))]
    leaf, handle = panels((-60.5, 60.5, 0, 23, 0, 2.6)), bow_handle(84).to(0, 18, 2.6)
    for number, (y, tilt) in enumerate([(50.4, 0), (90.4, 84)], start=1):
        oven.fix(f"hearth_stone_{number:02}", panels((-60.5, 60.5, y - 0.3, y + 1.8, 8.3, 96)))
        oven.fix(f"oven_door_{number:02}", leaf, (0, y, 98.3), (tilt, 0, 0))
        oven.fix(f"oven_door_handle_{number:02}", handle, (0, y, 98.3), (tilt, 0, 0))
        oven.fix(f"heat_knob_{number:02}", knob, (56, y + 31.4, 98.1), (0, 0, 20 * number))
    for number, (x, y, z) in enumerate([(-20, 92.2, 70), (14, 92.2, 64), (0, 52.2, 50)], start=1):
        oven.stand(f"baking_loaf_{number:02}", bulge(22, 11, 22, 1), (x, y, z), (0, 30 * number, 0), "baking_loaf")
    hood = [(-72, 72, 186, 188, 0.2, 104), (-72, -70.5, 170, 186, 0.2, 104), (70.5, 72, 170, 186, 0.2, 104)]
    oven.fix("extractor_hood", panels(*hood, (-70.5, 70.5, 170, 186, 102.5, 104), (-70.5, 70.5, 170, 186, 0.2, 1.7)))
    oven.fix("flue_pipe", [column(11, 101.8, (0, 188.1, 40)), column(14, 2, (0, 188.1, 40))])


def _proofer(cabinet: Area) -> None:
    ledges = [(s * 35.9 - 1.1, s * 35.9 + 1.1, y - 1, y, 6, 70) for y in (50, 80, 110, 140) for s in (-1, 1)]
    cabinet.stand(
        "proofer_body",
        panels(
            (-38, 38, 12, 16, 0.4, 76),
            (-38, 38, 184, 190, 0.4, 76),
            (-38, -36.8, 16, 184, 0.4, 76),
            (36.8, 38, 16, 184, 0.4, 76),
            (-36.8, 36.8, 16, 184, 0.4, 3),
            *((x - 3, x + 3, 0, 12, z - 3, z + 3) for x in (-33, 33) for z in (8, 68)),
            *ledges,
        ),
    )
    door = cabinet.area("ProoferDoor", (-37.6, 0, 76.4), -104)
    door.fix("proofer_door", [panels((0, 75, 14, 188, 0, 3)), panels((24, 51, 70, 150, 3, 3.4))])
    door.fix(
        "proofer_handle",
        [bar((71, 90, 6.4), (71, 118, 6.4), 0.9), *(bar((71, y, 2.8), (71, y, 6.4), 0.7) for y in (92, 116))],
    )
    for number, y in enumerate((50.0, 80.0, 110.0), start=1):
        cabinet.fix(f"proofing_tray_{number:02}", tray(71, 60, 2), (0, y + 0.1, 38), (0, 0, 0), "proofing_tray")
    for number, (x, y, z) in enumerate([(-18, 50.4, 30), (6, 50.4, 34), (14, 80.4, 40)], start=1):
        cabinet.stand(f"dough_round_{number:02}", bulge(17, 8, 17, 1), (x, y, z), (0, 20 * number, 0), "dough_round")


def _bins(bins: Area) -> None:
    lid = joined(panels((-23, 23, 0, 1.4, -26, 26)), panels((-8, 8, 1.4, 3.4, -1, 1)))
    for number, x in enumerate((-30, 30), start=1):
        bins.stand(f"flour_bin_{number:02}", open_box(42, 62, 48, 0.8, 1.2), (x, 0, 32), like="flour_bin")
    bins.fix("bin_lid_01", lid, (-30, 62.2, 32), like="bin_lid")
    # It leans against the front of the bin, its edge on the floor.
    bins.fix("bin_lid_02", lid, (34, 25.6, 62.6), (78, 0, 0), "bin_lid")
    bins.fix("rye_flour", panels((-20.4, 20.4, 0, 40, -23.4, 23.4)), (-30, 1, 32))
    bins.fix("wheat_flour", panels((-20.4, 20.4, 0, 38, -23.4, 23.4)), (30, 1, 32))
    scoop = [hose([(0, 3, 6), (0, 3, 19)], 1.3), open_box(11, 4, 14, 0.3, 0.6)]
    bins.stand("flour_scoop", scoop, (28, 39.1, 30), (0, 25, 0))


def _tools(rail: Area) -> None:
    rail.fix("tool_rail", [bar((-58, 0, 4), (58, 0, 4), 0.8), *(block(3, 3, 4, (x, -1.5, 2.2)) for x in (-50, 50))])
    bend = [(0, -0.6, -1.25), (0, 0.6, -1.15), (0, 1.2, 0), (0, 0.6, 1.15), (0, -2, 1.3), (0, -5, 1.3)]
    bend += [(0, -6.2, 2.1), (0, -6.3, 3.2), (0, -5, 4.2)]
    for number, x in enumerate((-36, -4, 28), start=1):
        rail.fix(f"s_hook_{number:02}", hose(bend, 0.3), (x, 0, 4), like="s_hook")
    loop = loop_at(1.2, 0.25)
    oval = [(0.0, -17, 0), (4, -23, 0), (5, -29, 0), (3, -33, 0), (0, -34, 0), (-3, -33, 0), (-5, -29, 0), (-4, -23, 0)]
    oval.append((-0.1, -17, 0))
    across = [(0.0, y, x) for x, y, _ in oval]
    rail.fix("whisk", [loop, column(1.2, 15, (0, -17.1, 0)), hose(oval, 0.2), hose(across, 0.2)], (-36, -6, 6.7))
    rail.fix("ladle", [loop, block(2, 28, 0.5, (0, -30, 0)), vessel(2.4, 5, 4, 0.2).to(0, -33, 3.8)], (-4, -6, 6.7))
    rail.fix(
        "sieve",
        [
            loop,
            bar((0, -2.2, 0), (0, -14, 0), 0.9),
            hoop(9, 0.9, (0, -23.8, 0)),
            column(8.4, 0.3, (0, -23.8, -0.5), (90, 0, 0)),
        ],
        (28, -6, 6.7),
    )


def _sink(sink: Area) -> None:
    top = [(-60, 4, 86, 90, 0.3, 60), (48, 60, 86, 90, 0.3, 60), (4, 48, 86, 90, 0.3, 12), (4, 48, 86, 90, 52, 60)]
    bowl = [
        (3, 4, 62, 86, 11, 53),
        (48, 49, 62, 86, 11, 53),
        (4, 48, 62, 86, 11, 12),
        (4, 48, 62, 86, 52, 53),
        (4, 48, 61, 62, 12, 52),
    ]
    legs = [(x - 2, x + 2, 0, 86, z - 2, z + 2) for x in (-57, 57) for z in (4, 56)]
    sink.stand("sink_unit", panels(*top, *bowl, *legs, (-60, 60, 90, 100, 0.3, 2)))
    spout = hose([(0, 4, 0), (0, 26, 0), (0, 31, 4), (0, 31, 15), (0, 28, 19), (0, 25, 19)], 1.2)
    sink.stand("sink_tap", [column(2.4, 5), spout, bar((2, 3.4, 0), (8, 6, 0), 0.7)], (26, 90, 7))
    sink.stand("wash_bowl", vessel(12, 17, 14, 0.4), (24, 62, 31))
    brush = [block(3, 2, 9, (0, 0, 0)), block(2, 1.4, 18, (0, 1, 12), (4, 0, 0))]
    sink.stand("scrub_brush", brush, (-30, 90, 24), (0, 40, 0))
    sink.stand("dish_soap", bottle(4, 24), (-50, 90, 14))


def _mixer(mixer: Area) -> None:
    mixer.stand("rubber_mat", panels((-44, 44, 0, 1.2, -54, 60)))
    body = [
        block(60, 8, 84, (0, 1.2, 0)),
        block(36, 106, 28, (0, 9, -24)),
        block(34, 26, 80, (0, 101, 2)),
        block(30, 3, 46, (0, 39, 12)),
        column(3, 3, (0, 98.2, 18)),
    ]
    mixer.stand("mixer_body", body)
    mixer.stand("mixer_bowl", vessel(16, 24, 34, 0.5), (0, 42, 18))
    mixer.fix("mixer_dough", bulge(28, 17, 28, 1), (0, 42.7, 18))
    mixer.fix(
        "dough_hook", hose([(0, 98.3, 18), (0, 80, 18), (5, 74, 20), (7, 68, 16), (2, 62.6, 14), (-5, 61, 19)], 1.2)
    )
    bars = [bar((14 * a, 79, 18 + 19.5 * b), (14 * a, 101, 18 + 19.5 * b), 0.5) for a in (-1, 1) for b in (-1, 1)]
    mixer.fix("bowl_guard", [hoop(24, 0.6, (0, 79, 18), (90, 0, 0)), *bars])
    mixer.fix("speed_lever", [bar((17.6, 92, -24), (26, 98, -24), 0.8), orb(2.2, (26.6, 96.4, -24))])


def _trolley(trolley: Area) -> None:
    posts = [(x - 1.2, x + 1.2, 10, 172, z - 1.2, z + 1.2) for x in (-25, 25) for z in (-31, 31)]
    ledges = [
        (min(s * 20, s * 24), max(s * 20, s * 24), y - 0.4, y, -31, 31) for y in (40, 72, 104, 136) for s in (-1, 1)
    ]
    rungs = [(-26.2, 26.2, y, y + 2.4, z - 1.2, z + 1.2) for y in (10, 172) for z in (-31, 31)]
    sides = [(x - 1.2, x + 1.2, 10, 12.4, -30, 30) for x in (-25, 25)]
    trolley.fix("trolley_frame", panels(*posts, *ledges, *rungs, *sides))
    for number, (x, z) in enumerate([(-25, -31), (25, -31), (-25, 31), (25, 31)], start=1):
        trolley.fix(f"caster_{number:02}", caster(), (x, 0.05, z), (0, 35 * number, 0), "caster")
    for number, y in enumerate((72.0, 104.0, 136.0), start=1):
        trolley.fix(f"rack_tray_{number:02}", tray(45, 60, 2), (0, y + 0.05 * number, 1), (0, 0, 0), "rack_tray")
    for number, (x, y, z) in enumerate([(-10, 72.3, -14), (9, 72.3, -12), (-8, 104.3, 4)], start=1):
        trolley.stand(f"bun_{number:02}", bulge(12, 7, 12, 1), (x, y, z), (0, 30 * number, 0), "bun")
