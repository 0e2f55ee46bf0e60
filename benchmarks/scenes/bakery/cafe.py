"""The café corner: tables, chairs and a bench, and what hangs on the walls and below the ceiling of the shop."""

from benchmarks.scenes.bakery.forms import (
    bar,
    block,
    bulge,
    cloth,
    column,
    hoop,
    hose,
    open_box,
    orb,
    panels,
    tipped,
    turned,
    vessel,
)
from benchmarks.scenes.bakery.layout import Area
from benchmarks.scenes.bakery.things import chair, cup, fan, jar, jar_lid, long_loaf, loop_at, plate, spoon

__all__ = ["build_cafe", "build_shop_walls"]


def build_cafe(shop: Area) -> None:
    """Add the furniture of the guests, and what stands on the floor of the shop."""
    cafe = shop.area("Cafe")
    _round_table(cafe.area("RoundTable", (610, 0, 580), 12))
    _square_table(cafe.area("SquareTable", (108, 0, 790)))
    bench = cafe.area("Bench", (0, 0, 790), 90)
    seat = panels(
        (-75, 75, 40, 44, 1, 46),
        (-75, 75, 44, 88, 1, 4),
        (-75, -72, 0, 40, 1, 46),
        (72, 75, 0, 40, 1, 46),
        (-72, 72, 12, 16, 20, 24),
    )
    bench.stand("bench_seat", seat)
    for number, x in enumerate((-36, 36), start=1):
        bench.stand(f"seat_pad_{number:02}", bulge(68, 5, 38, 0.2), (x, 44, 25.4), like="seat_pad")
    bench.fix("throw_pillow", tipped(bulge(38, 12, 38, 0.4), (75, 0, 0)).to(0, 65.6, 5.6), (-40, 0, 2.6))
    floor = cafe.area("Floor")
    floor.stand("door_mat", panels((-40, 40, 0, 1, -26, 26)), (610, 0, 860))
    floor.stand("plant_saucer", vessel(17, 19, 3, 0.6), (34, 0, 656))
    floor.stand("plant_tub", vessel(13, 18, 32, 1), (34, 0.7, 656))
    floor.fix("tub_soil", turned([(0, 0), (13.4, 0), (15.9, 18), (0, 19)]), (34, 9, 656))
    floor.fix(
        "rubber_plant",
        [bar((0, 0, 0), (1, 66, 2), 1.2), *(part.to(1, 40, 1) for part in fan(9, 70, 34, 0.5))],
        (34, 27, 656),
    )
    floor.stand("umbrella_stand", vessel(11, 12, 44, 0.5), (700, 0, 872))
    shaft = [
        bar((0, 0, 0), (0, 78, 0), 0.5),
        turned([(0, 8), (0.8, 8), (3.4, 58), (0.8, 62), (0, 62)]),
        hose([(0, 77, 0), (0, 82, 0), (3, 86, 0), (6, 84, 0), (6.4, 80, 0)], 0.9),
    ]
    floor.fix("umbrella", shaft, (695, 0.5, 872), (2, 40, 4))
    rods = [
        bar((0, 0, 0), (0, 172, 0), 2),
        *(bar((0, 5, 0), (24 * a, 1.5, 24 * b), 1.4) for a, b in ((1, 0), (-0.5, 0.86), (-0.5, -0.86))),
    ]
    pegs = [
        hose([(0, 165, 0), (9 * a, 162, 9 * b), (13 * a, 163, 13 * b), (15 * a, 167, 15 * b)], 0.7)
        for a, b in ((1, 0), (0, 1), (-1, 0), (0, -1))
    ]
    floor.stand("coat_stand", [*rods, *pegs], (486, 0, 866))
    coat = [
        loop_at(2, 0.25),
        panels((-0.3, 0.3, -8, -3.8, -1, 1)),
        *(panels((-a, a, -112, -7.6, -4, 4)).to(0, 0, 0) for a in (20,)),
        *(block(9, 62, 8, (s * 24, -72, 0), (0, 0, s * 4)) for s in (-1, 1)),
    ]
    floor.fix("rain_coat", coat, (486 + 11, 163.2, 866), (0, 90, 0))
    hat = turned([(0, 9), (6, 8.6), (8.4, 0.4), (14, 0), (14, -0.3), (8.2, 0), (5.8, 8.2), (0, 8.6)])
    floor.fix("felt_hat", hat, (486, 158.8, 866 + 17), (4, 0, 0))
    floor.stand("waste_bin", vessel(13, 16, 46, 0.4), (722, 0, 590))
    floor.fix(
        "waste_bag",
        turned(
            [
                (0, 0.6),
                (12.3, 0.6),
                (15.4, 45),
                (15.5, 46.4),
                (16.5, 46.4),
                (16.3, 40),
                (16.5, 40),
                (16.8, 46.8),
                (15.2, 46.8),
                (12.1, 0.8),
                (0, 0.8),
            ]
        ),
        (722, 0, 590),
    )
    paper_cup = [vessel(2.8, 4.2, 10, 0.15), turned([(0, 9.8), (4.1, 9.8), (4.4, 9.4), (4.4, 10.4), (0, 10.5)])]
    floor.fix("paper_cup", paper_cup, (718, 5.2, 592), (84, 30, 0))
    lamp = [
        column(14, 2),
        bar((0, 2, 0), (0, 152, 0), 1.2),
        turned([(0, 168), (10, 168), (20, 140), (19.6, 140), (9.7, 167.6), (0, 167.6)]),
        bar((0, 150, 0), (0, 167.8, 0), 0.6),
    ]
    floor.stand("floor_lamp", lamp, (66, 0, 876))


def _round_table(table: Area) -> None:
    table.stand("table_round", [column(22, 2), column(3.4, 70, (0, 2, 0)), column(36, 3, (0, 72, 0))])
    top = table.area("OnTable", (0, 75, 0))
    top.fix("place_mat", panels((-19, 19, 0, 0.4, -14, 14)), (0, 0.2, 17), (0, 0, 0))
    top.stand("cake_dish", plate(10), (-4, 0.7, 18))
    wedge = panels((-1.5, 1.5, 0, 5, -5, 5))
    top.fix("cake_slice", wedge, (-5.4, 1.35, 18), (0, 30, 0))
    top.fix("cake_fork", spoon(15), (12, 0.6, 17), (0, 4, 0), "cake_fork")
    top.stand("cafe_saucer", plate(7.4), (17, 0.2, -8))
    top.stand("cafe_cup", cup(4.2, 6.6), (17, 0.8, -8), (0, -30, 0))
    top.fix("cafe_spoon", spoon(11), (22.4, 1.7, -7.4), (0, 8, 0))
    top.stand(
        "sugar_shaker",
        [turned([(0, 0), (3.6, 0), (3.8, 11), (0, 11)]), turned([(0, 11), (3.9, 11), (3, 14), (0, 14.6)])],
        (-14, 0, -13),
    )
    top.stand(
        "flower_vase",
        turned([(0, 0), (3.4, 0), (4, 5), (2.2, 11), (2.6, 13), (2.3, 13), (1.9, 11), (3.7, 5), (3, 0.5), (0, 0.5)]),
        (-2, 0, -18),
    )
    tulip = [bar((0, 0, 0), (0, 25, 0), 0.3), turned([(0, 24), (1.6, 25), (1.9, 27.6), (1.2, 30), (0, 30)])]
    top.fix("tulip", tulip, (-2, 0.8, -19), (4, 0, 4))
    seats = table.area("Seats")
    seats.stand("chair_01", chair(), (0, 0, 62), (0, 176, 0), "chair")
    seats.stand("chair_02", chair(), (-62, 0, 0), (0, 84, 0), "chair")
    seats.stand("chair_cushion", bulge(38, 4, 33, 0.2), (0, 46, 61), (0, 176, 0))
    bag = [
        open_box(26, 26, 12, 0.4, 0.5),
        *(hose([(-7, 25, s * 5.9), (-6, 36, s * 4), (6, 36, s * 4), (7, 25, s * 5.9)], 0.5) for s in (-1, 1)),
    ]
    seats.stand("hand_bag", bag, (-60, 46, 1), (0, 80, 0))
    seats.fix("purse", bulge(15, 3.4, 8, 0.4), (-60.4, 46.6, 2), (0, 84, 0))
    seats.stand("shopping_bag", open_box(32, 36, 16, 0.2, 0.2), (42, 0, 46), (0, 30, 0))
    seats.fix("baguette_04", long_loaf(3.2, 62), (34.2, 31.3, 50.5), (96, 30, 0), "baguette")
    seats.stand("bun_bag", block(16, 12, 10), (46.5, 0.3, 43.4), (0, 30, 0))


def _square_table(table: Area) -> None:
    legs = [block(5, 71, 5, (x, 0, z)) for x in (-31, 31) for z in (-31, 31)]
    table.stand("table_square", [block(70, 3, 70, (0, 71, 0)), *legs])
    drop = [
        (-36.4, 58),
        (-36, 72),
        (-35.4, 74.1),
        (-34, 74.4),
        (0, 74.3),
        (34, 74.4),
        (35.4, 74.1),
        (36, 72),
        (36.4, 56),
    ]
    table.fix("table_cloth", cloth(drop, 66, 0.3))
    top = table.area("OnTable", (0, 74.5, 0))
    pot = turned(
        [(0, 0), (5, 0), (7.6, 5), (6, 10.4), (3.4, 11.4), (3, 11.4), (5.6, 10), (7.2, 5), (4.6, 0.4), (0, 0.4)]
    )
    top.stand(
        "tea_pot",
        [
            pot,
            bar((6.6, 5, 0), (12.6, 10.6, 0), 0.9),
            hose([(-5.4, 10, 0), (-11, 9.6, 0), (-11.4, 4, 0), (-6.8, 3, 0)], 0.7),
        ],
        (-12, 0, -12),
    )
    top.fix(
        "tea_pot_lid", [turned([(0, 0.1), (3.6, 0.1), (3.2, 1.2), (0, 1.6)]), orb(0.9, (0, 1.5, 0))], (-12, 11.5, -12)
    )
    top.stand("tea_cup", cup(4.4, 6), (14, 0, -6), (0, 120, 0))
    top.fix("newspaper", [block(29, 0.9, 20), block(29.4, 0.5, 19.6, (0, 0.9, 0))], (4, 0.1, 20), (0, -10, 0))
    rims = [hoop(2.3, 0.2, (s * 3, 2.3, 0)) for s in (-1, 1)]
    top.fix(
        "reading_glasses",
        [
            *rims,
            bar((-0.8, 2.6, 0), (0.8, 2.6, 0), 0.2),
            *(bar((s * 5.2, 2.8, 0), (s * 5, 0.3, -11), 0.2) for s in (-1, 1)),
        ],
        (2, 1.6, 24),
        (0, -20, 0),
    )
    top.stand("candle_holder", vessel(2.6, 3.8, 5, 0.5), (2, 0, -24))
    top.stand("candle", [column(2, 3.4), bar((0, 3.4, 0), (0, 4.2, 0), 0.1)], (2, 0.5, -24))
    top.stand(
        "menu_stand",
        [block(10, 1.6, 4, (0, 0, 1.6)), block(10, 1.6, 1.4, (0, 0, -1.9)), block(10, 0.6, 0.9, (0, 0, -0.8))],
        (-22, 0, 12),
        (0, 40, 0),
    )
    top.fix("menu_card", block(9.4, 21, 0.5), (-22.5, 0.7, 11.4), (0, 40, 0))
    seats = table.area("Seats")
    seats.stand("chair_03", chair(), (62, 0, 2), (0, -84, 0), "chair")
    seats.stand("chair_04", chair(), (6, 0, -62), (0, 6, 0), "chair")
    fall = [
        (-24.6, 40),
        (-23.8, 70),
        (-23.2, 84),
        (-22.6, 86.4),
        (-20.8, 87),
        (-19, 86.4),
        (-17.4, 84),
        (-16.4, 70),
        (-15.8, 54),
    ]
    seats.fix("knit_jacket", cloth(fall, 33, 0.8), (6, 0, -62), (0, 6, 0))


def build_shop_walls(shop: Area) -> None:
    """Add what is fixed to the walls and to the ceiling."""
    board = shop.area("Blackboard", (610, 118, 450))
    frame = panels(
        (-60, 60, 0, 84, 0.2, 1.6),
        (-62, 62, -2, 0, 0.2, 2.4),
        (-62, 62, 84, 86, 0.2, 2.4),
        (-62, -60, 0, 84, 0.2, 2.4),
        (60, 62, 0, 84, 0.2, 2.4),
        (-40, 40, -3, -2, 0.2, 9),
        (-40, 40, -2, -0.8, 8.2, 9),
    )
    board.fix("blackboard", frame)
    board.fix("chalk", column(0.6, 8, (0, 0.6, 0), (0, 0, -90)), (-18, -1.9, 5), (0, 4, 0))
    board.fix("chalk_sponge", bulge(11, 3.6, 5, 0.3), (20, -1.9, 5.4))
    board.fix("offer_sheet", panels((-10, 10, -14, 14, 0.1, 0.2)), (34, 58, 1.6))
    board.fix("board_magnet", column(1.4, 0.8, (0, 0, 0), (90, 0, 0)), (34, 69.6, 1.85))
    sign = shop.area("HangingSign", (250, 0, 545))
    sign.fix(
        "bread_sign",
        [block(120, 32, 2.4, (0, 206, 0)), *(hoop(1.6, 0.3, (x, 239.4, 0), (0, 90, 0)) for x in (-48, 48))],
    )
    for name, x in (("sign_chain_left", -48), ("sign_chain_right", 48)):
        links = [hoop(1.9, 0.3, (x, 242.3 + 3.2 * k, 0), (0, 90 * (k % 2), 0)) for k in range(14)]
        sign.fix(name, [*links, bar((x, 285.6, 0), (x, 289.9, 0), 0.5), column(2.4, 0.8, (x, 289.1, 0))])
    shade = turned([(0, 190), (4, 190), (17, 174), (16.6, 174), (3.8, 189.4), (0, 189.4)])
    for number, x in enumerate((160, 340), start=1):
        pendant = [column(5, 2.4, (0, 287.5, 0)), bar((0, 189, 0), (0, 288, 0), 0.4), shade, orb(3.4, (0, 179, 0))]
        shop.fix(f"counter_lamp_{number:02}", pendant, (x, 0, 610), like="counter_lamp")
    pair = shop.area("TableLamp", (610, 0, 580))
    pair.fix("lamp_cord", [column(6, 2, (0, 287.9, 0)), bar((0, 170, 0), (0, 288, 0), 0.45)])
    pair.fix("lamp_shade", turned([(0, 170.4), (5, 170.4), (24, 152), (23.5, 152), (4.8, 169.8), (0, 169.8)]))
    pair.fix("lamp_bulb", [column(1.6, 5, (0, 165, 0)), orb(4, (0, 157.6, 0))])
    planter = shop.area("HangingPlant", (470, 0, 780))
    planter.fix(
        "planter_hook",
        [
            column(2.4, 0.8, (0, 289.1, 0)),
            hose([(0, 289.5, 0), (0, 285, 0), (1.6, 283, 0), (0, 281, 0), (-1.6, 282.4, 0)], 0.35),
        ],
    )
    cords = [bar((0, 277.6, 0), (14 * a, 225, 14 * b), 0.3) for a, b in ((1, 0), (-0.5, 0.866), (-0.5, -0.866))]
    planter.fix("planter_cords", [hoop(2, 0.3, (0, 279.65, 0), (0, 90, 0)), *cords])
    planter.fix("planter_bowl", vessel(9, 14.6, 15, 0.6), (0, 212, 0))
    planter.fix(
        "trailing_ivy",
        [
            turned([(0, 212.7), (8.2, 212.7), (12.7, 224.7), (0, 225)]),
            bar((0, 224, 0), (0, 230, 0), 0.6),
            *(part.to(0, 230, 0) for part in fan(8, 98, 24, 0.3)),
        ],
    )
    side = shop.area("SideWall", (750, 0, 765), -90)
    side.fix("jam_board", panels((-38, 38, 130, 132.4, 0.2, 20), (-38, 38, 132.4, 136, 19.2, 20)))
    side.stand("jam_jar", jar(4.6, 11), (-20, 132.4, 10))
    side.fix("jam", turned([(0, 0), (4.1, 0), (4.1, 8.4), (0, 8.4)]), (-20, 132.8, 10))
    side.fix("jam_jar_lid", jar_lid(4.6), (-20, 143.4, 10))
    side.fix(
        "shop_clock",
        [column(15, 4, (0, 0, 0), (90, 0, 0)), block(1, 11, 0.4, (0, 0, 4.2)), block(8, 1, 0.4, (4, 0, 4.2))],
        (0, 205, 0.2),
    )
    left = shop.area("LeftWall", (0, 0, 790), 90)
    for name, x, y, w, h in (("picture_mill", -40, 122, 40, 50), ("picture_wheat", 18, 130, 52, 36)):
        edge = panels(
            (-w / 2, w / 2, 0, h, 0.2, 1),
            (-w / 2, w / 2, 0, 2, 1, 2.6),
            (-w / 2, w / 2, h - 2, h, 1, 2.6),
            (-w / 2, 2 - w / 2, 2, h - 2, 1, 2.6),
            (w / 2 - 2, w / 2, 2, h - 2, 1, 2.6),
        )
        left.fix(name, edge, (x, y, 0))
    front = shop.area("FrontWall", (260, 0, 900), 180)
    heater = [
        block(120, 46, 7, (0, 16, 6)),
        *(block(3, 8, 3.6, (x, 40, 1.9)) for x in (-40, 40)),
        bar((62, 20, 9), (62, 0.1, 9), 1),
    ]
    front.fix("radiator", heater)
    front.fix("radiator_valve", [bar((61, 20, 9), (64, 20, 9), 1.4), column(2.4, 7, (64, 20, 9), (0, 0, -90))])
    front.stand("herb_pot", vessel(5, 7, 11, 0.5), (-110, 82.5, 5))
    herb = [turned([(0, 0.5), (4.4, 0.5), (6, 9), (0, 9.6)]), *(part.to(0, 9, 0) for part in fan(6, 50, 16, 0.3))]
    front.fix("herb", herb, (-110, 82.6, 5))
    entry = shop.area("Entry", (610, 0, 910))
    entry.fix(
        "sign_hook",
        [
            column(1.8, 0.6, (0, 170, -0.2), (-90, 0, 0)),
            hose([(0, 170, -0.6), (0, 169.6, -1.8), (0, 170.6, -2.4)], 0.25),
        ],
    )
    string = hose([(-12, 156.6, -1.2), (-6, 163, -1.3), (0, 169.9, -1.5), (6, 163, -1.3), (12, 156.6, -1.2)], 0.15)
    entry.fix("open_sign", [block(30, 16, 0.8, (0, 141, -1.2)), string])
    shop.fix("dome_camera", [column(6, 2.6, (0, 287.2, 0)), orb(5, (0, 281.6, 0), 0.8)], (700, 0, 480))
