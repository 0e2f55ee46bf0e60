"""The work table in the middle of the bakehouse, with what lies on it and below it."""

from benchmarks.scenes.bakery.forms import block, bulge, cloth, column, hoop, open_box, panels, roll, turned, vessel
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import bow_handle, drawer, long_loaf

__all__ = ["build_worktable"]

TOP = 88.0


def build_worktable(house: Area) -> None:
    """Add the table; its drawer opens towards z."""
    table = house.area("WorkTable", (300, 0, 252), 2)
    legs = [(x - 2.5, x + 2.5, 0, 83, z - 2.5, z + 2.5) for x in (-95, 95) for z in (-34, 34)]
    aprons = [(-92.5, 92.5, 72, 83, -35.5, -33), *((x - 1.2, x + 1.2, 72, 83, -31.5, 31.5) for x in (-95, 95))]
    rails = [(-92.5, 92.5, 20, 24, z - 1.2, z + 1.2) for z in (-34, 34)]
    runners = [(x - 1.4, x + 1.4, 69.6, 70.8, -33, 36) for x in (14.6, 65.4)]
    table.stand("table_frame", panels(*legs, *aprons, *rails, *runners))
    table.stand("table_top", panels((-100, 100, 83, TOP, -40, 40)))
    table.stand("under_shelf", panels((-92, 92, 24, 26.4, -35, 35)))
    table.fix("table_drawer", drawer(50, 8, 48, (52, 0.4, 3.2)), (40, 71, 56))
    table.fix("drawer_pull", bow_handle(14), (40, 76, 56))
    for number, (x, r) in enumerate([(28, 3.6), (46, 4.6)], start=1):
        table.fix(f"biscuit_cutter_{number:02}", roll(r - 0.1, r, 4), (x, 71.7, 46))
    _on_top(table.area("OnTop", (0, TOP, 0)))
    _below(table.area("Below", (0, 26.4, 0)))


def _on_top(top: Area) -> None:
    folds = [
        (-20, 0.3),
        (-8, 0.3),
        (-7, 4.4),
        (-5.8, 4.4),
        (-4.8, 0.3),
        (5, 0.3),
        (6, 4.4),
        (7.2, 4.4),
        (8.2, 0.3),
        (20, 0.3),
    ]
    top.stand("linen_cloth", cloth(folds, 62, 0.3), (-64, 0, -18))
    for number, z in enumerate((-14.4, 0), start=1):
        top.stand(f"baguette_dough_{number:02}", long_loaf(3.4, 52), (-64, 0.5, -18 + z), (0, 90, 0), "baguette_dough")
    for number, x in enumerate((-80, -56), start=1):
        top.stand(f"dough_ball_{number:02}", bulge(15, 9, 15, 1), (x, 0, 22), (0, 25 * number, 0), "dough_ball")
    pin = [column(3.2, 32, (-16, 3.2, 0), (0, 0, -90)), *(column(1.4, 8, (x, 3.2, 0), (0, 0, -90)) for x in (-24, 16))]
    top.stand("rolling_pin", pin, (-2, 0, 24), (0, 8, 0))
    top.stand("flour_heap", bulge(24, 4, 18, 1), (-12, 0, -14))
    top.stand("dough_scraper", [block(14, 0.3, 10), block(14, 1.6, 2.6, (0, 0, -5))], (26, 0, 16), (0, -30, 0))
    for number in range(2):
        top.fix(
            f"loaf_tin_{number + 1:02}",
            open_box(11, 8, 25, 0.15, 1.2),
            (22, 0.1 + 1.15 * number, -18),
            (0, 0, 0),
            "loaf_tin",
        )
    top.stand("recipe_book", [block(19, 2, 25), block(19.6, 0.3, 25.6, (-0.2, 2, 0))], (56, 0, 24), (0, -12, 0))
    body = [
        block(26, 7, 28, (0, 1, 0)),
        block(20, 4, 2, (0, 2.4, 14.4)),
        *(column(1.4, 1, (x, 0, z)) for x in (-10, 10) for z in (-11, 11)),
    ]
    top.stand("table_scales", [*body, column(3, 2, (0, 8, 0))], (74, 0, -14))
    top.stand("scale_pan", turned([(0, 0), (10, 0), (13, 3), (12.7, 3), (9.9, 0.4), (0, 0.4)]), (74, 10, -14))
    top.stand("butter_block", panels((-3.6, 3.6, 0, 6, -6, 6)), (74, 10.5, -14), (0, 20, 0))


def _below(shelf: Area) -> None:
    for number in range(2):
        shelf.stand(
            f"mixing_bowl_{number + 1:02}", vessel(12, 20, 16, 0.3), (-52, 1.3 * number, 2), (0, 0, 0), "mixing_bowl"
        )
    shelf.stand("sugar_tub", vessel(16, 18, 34, 0.6), (28, 0, 0))
    shelf.stand(
        "sugar_tub_lid",
        [turned([(0, 0), (18.2, 0), (18.2, -1.2), (18.7, -1.2), (18.7, 1.2), (0, 1.8)]), hoop(2.4, 0.4, (0, 3.4, 0))],
        (28, 34.2, 0),
    )
