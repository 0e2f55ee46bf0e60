"""Kitchenette and print room; centimetres, standing on y = 0, front towards +z."""

from scenes.writer.assets import Asset, asset
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import box, cylinder, lathe, tube


@asset("KU_180")
def kitchen_run(a: Asset) -> None:
    """Base run with worktop, cut out for a sink at x = 50: 180 wide, 90 high, 60 deep, back at z = 0."""
    a.add("carcass", box((-90, 10, 0), (90, 86, 56)), "laminate_white")
    a.add("plinth", box((-88, 0, 4), (88, 10, 50)), "steel_dark")
    a.add(
        "doors",
        copies(box((-89.7, 11, 56), (-45.3, 85, 58), 0.3), [(45.0 * k, 0, 0) for k in range(4)]),
        "laminate_white",
    )
    top = [box((-90, 86, 0), (26, 90, 60), 0.3), box((74, 86, 0), (90, 90, 60), 0.3)]
    top += [box((26, 86, 0), (74, 90, 12)), box((26, 86, 50), (74, 90, 60))]
    a.add("worktop", merge(*top), "laminate_maple")


@asset("NK_48", looks="")
def sink(a: Asset) -> None:
    """Inset sink: 50 wide, 18 deep below its rim, 40 front to back; the rim lies at the origin."""
    rim = [box((-25, 0, z), (25, 0.5, z + 2)) for z in (-20.0, 18.0)]
    rim += [box((x, 0, -18), (x + 2, 0.5, 18)) for x in (-25.0, 23.0)]
    a.add("rim", merge(*rim), "brushed_steel")
    walls = [box((x, -3.8, -18), (x + 0.5, 0, 18)) for x in (-23.5, 23.0)]
    walls += [box((-23, -3.8, z), (23, 0, z + 0.5)) for z in (-18.5, 18.0)]
    a.add("bowl", merge(*walls, box((-23, -3.9, -18), (23, -3.6, 18))), "brushed_steel")
    a.add("drain", cylinder((0, -3.6, 0), 3, 0.3), "chrome")


@asset("mixer_tap", is_y_up=True)
def tap(a: Asset) -> None:
    """Mixer tap: 5 wide, 30 high, 20 deep."""
    a.add("base", cylinder((0, 0, 0), 2.5, 5), "chrome")
    a.add("spout", tube([(0, 5, 0), (0, 24, 0), (0, 30, 6), (0, 28, 15), (0, 22, 17)], 1.1, 8), "chrome")
    a.add("lever", tube([(2, 4, 0), (4, 6, 0), (5, 11, 0)], 0.6), "chrome")


@asset("WU_90")
def wall_cupboard(a: Asset) -> None:
    """Wall cupboard with two doors: 90 wide, 60 high, 34 deep, its back at z = 0."""
    a.add("carcass", box((-45, 0, 0), (45, 60, 32)), "laminate_white")
    a.add("doors", merge(*(box((x, 0.3, 32), (x + 44.4, 59.7, 34), 0.3) for x in (-44.7, 0.3))), "laminate_maple")


@asset("FR_85U", has_kind=False)
def fridge(a: Asset) -> None:
    """Small refrigerator: 55 wide, 85 high, 58 deep, its back at z = 0."""
    a.add("cabinet", box((-27.5, 1, 0), (27.5, 85, 53), 0.6), "steel_light")
    a.add("door", box((-27.3, 4, 53.4), (27.3, 84, 58), 0.8), "steel_light")
    a.add("grip", box((20, 50, 58), (22, 78, 60.5), 0.5), "chrome")


@asset("CafeLine_X8")
def coffee_machine(a: Asset) -> None:
    """Bean-to-cup coffee machine: 30 wide, 42 high, 42 deep."""
    a.add("body", merge(box((-15, 0, -20), (15, 38, 4), 0.8), box((-15, 24, 4), (15, 38, 18), 0.8)), "plastic_black")
    a.add("bean_hopper", box((-10, 38, -14), (10, 44, 4), 0.5), "glass_black")
    a.add("spout", merge(*(cylinder((x, 18, 12), 1, 6, segments=8) for x in (-2, 2))), "chrome")
    a.add("drip_tray", box((-13, 0, 4), (13, 2.5, 20), 0.3), "brushed_steel")
    a.add("touchscreen", box((-7, 28, 18), (7, 36, 18.3)), "screen_blue")
    a.surfaces["tray"] = 2.5


@asset("MW_20L")
def microwave(a: Asset) -> None:
    """Microwave oven: 46 wide, 27 high, 34 deep."""
    a.add("case", box((-23, 1, -17), (23, 27, 15), 0.4), "brushed_steel")
    a.add("door", box((-22.6, 1.5, 15), (10, 26.5, 17), 0.3), "glass_black")
    a.add("panel", box((10.5, 1.5, 15), (22.6, 26.5, 16.6), 0.3), "plastic_black")
    a.add("handle", box((8, 5, 17), (9.5, 23, 19.5), 0.4), "chrome")


@asset("kettle_17")
def kettle(a: Asset) -> None:
    """Electric kettle on its base: 22 wide, 25 high."""
    a.add("base", lathe([(0, 0), (8.5, 0), (8, 2), (0, 2)]), "plastic_black")
    a.add("jug", lathe([(0, 2.2), (7.6, 2.2), (7.8, 6), (5.6, 22), (0, 23)]), "brushed_steel")
    a.add("handle", tube([(-5.8, 21, 0), (-11, 20, 0), (-11, 9, 0), (-7.4, 6, 0)], 1.0), "plastic_black")
    a.add("lid_knob", cylinder((0, 22.8, 0), 1.3, 1.8), "plastic_black")


@asset("cup_espresso")
def espresso_cup(a: Asset) -> None:
    """Small cup: 8 wide, 6 high."""
    a.add("cup", lathe([(0, 0), (2, 0), (3.1, 6), (2.8, 6), (1.8, 0.6), (0, 0.6)]), "ceramic_white")
    a.add("ear", tube([(2.8, 4.8, 0), (4.6, 4.6, 0), (4.4, 2.4, 0), (2.4, 2, 0)], 0.35), "ceramic_white")


@asset("spoon_s", has_kind=False, looks="")
def teaspoon(a: Asset) -> None:
    """Tea spoon lying flat: 3 wide, 1 high, 14 deep."""
    bowl = moved(lathe([(0, 0), (0.8, 0.1), (1.5, 0.8), (1.4, 0.9), (0.7, 0.25), (0, 0.2)], 10), scale=(1, 1, 1.5))
    a.add("bowl", moved(bowl, by=(0, 0, -4.8)), "brushed_steel")
    a.add("stem", tube([(0, 0.8, -2.7), (0, 0.4, 2), (0, 0.3, 9)], 0.3), "brushed_steel")


@asset("sugar_pourer")
def sugar_pourer(a: Asset) -> None:
    """Glass sugar pourer with a metal spout: 8 across, 15 high."""
    a.add("jar", lathe([(0, 0), (3.9, 0), (3.9, 9), (3, 10.5), (0, 10.5)]), "glass_clear")
    a.add("sugar", cylinder((0, 0.4, 0), 3.5, 6), "paper_white")
    a.add("spout_top", lathe([(0, 10.5), (3.1, 10.5), (3.1, 12), (0.7, 13), (0.7, 15), (0, 15)]), "chrome")


@asset("milk_uht_1l")
def milk_carton(a: Asset) -> None:
    a.add("carton", box((-3.5, 0, -3.5), (3.5, 19.5, 3.5)), "carton_blue")
    a.add("front_print", box((-2.8, 3, 3.5), (2.8, 14, 3.55)), "paper_white")
    a.add("cap", cylinder((0, 19.5, 0.8), 1.5, 1.6), "carton_red")


@asset("wd_c18")
def water_dispenser(a: Asset) -> None:
    """Water dispenser with a bottle on top: 32 wide, 140 high, 34 deep, its back at z = 0."""
    a.add("cabinet", box((-16, 0, 0), (16, 100, 30), 1.0), "plastic_white")
    a.add("niche", box((-11, 62, 30), (11, 90, 30.3)), "plastic_grey")
    a.add("taps", merge(*(cylinder((x, 80, 32), 1.2, 5, segments=8) for x in (-5, 5))), "plastic_blue")
    a.add("drip_tray", box((-11, 61, 30), (11, 63, 36)), "plastic_grey")
    jug = [(0, 100), (3, 100), (3, 105), (13, 112), (13, 138), (11, 141), (0, 141)]
    a.add("bottle_19l", moved(lathe(jug), by=(0, 0, 15)), "window_glass")


@asset("MFP_C4500", has_kind=False)
def copier(a: Asset) -> None:
    """Floor-standing copier: 62 wide, 115 high, 68 deep, its back at z = 0."""
    a.add(
        "cassettes", copies(box((-31, 4, 0), (31, 18, 62), 0.5), [(0, 15.0 * k, 0) for k in range(3)]), "plastic_grey"
    )
    a.add("engine", box((-31, 50, 0), (31, 80, 60), 0.8), "plastic_white")
    a.add("scanner", box((-31, 92, 0), (31, 104, 60), 0.8), "plastic_white")
    a.add("rear_column", box((-31, 80, 0), (31, 92, 20)), "plastic_grey")
    a.add("feeder", box((-26, 104, 4), (22, 115, 54), 1.5), "plastic_grey")
    a.add("touch_panel", moved(box((-10, 0, -5), (10, 2, 9), 0.4), by=(20, 98, 64), turn=(35, 0, 0)), "screen_blue")


@asset("LJ_M402", has_kind=False)
def printer(a: Asset) -> None:
    """Desktop laser printer: 38 wide, 28 high, 36 deep."""
    a.add("body", box((-19, 0, -18), (19, 22, 18), 1.0), "plastic_white")
    a.add("cover", box((-18, 22, -17), (18, 26, 8), 1.2), "plastic_grey")
    a.add("out_tray", moved(box((-12, 0, 0), (12, 0.5, 12)), by=(0, 22.2, 8), turn=(-10, 0, 0)), "plastic_grey")
    a.add("cassette", box((-17, 1, 18), (17, 6, 19.5), 0.3), "plastic_black")


@asset("paper_ream_80g", has_kind=False, looks="")
def ream(a: Asset) -> None:
    """Wrapped ream of paper: 21 wide, 5.4 high, 29.7 deep."""
    a.add("wrapper", box((-10.6, 0, -14.9), (10.6, 5.4, 14.9), 0.2), "carton_blue")
    a.add("stripe", box((-10.65, 1, -4), (10.65, 5.45, 4)), "paper_white")


@asset("shd_p4", has_kind=False)
def shredder(a: Asset) -> None:
    """Paper shredder: 38 wide, 60 high, 28 deep."""
    a.add("bin", box((-18, 0, -13), (18, 44, 13), 1.0), "plastic_grey")
    a.add("head", box((-19, 44, -14), (19, 60, 14), 1.5), "plastic_black")
    a.add("slot", box((-12, 60, -0.8), (12, 60.15, 0.8)), "steel_light")


@asset("Rack_24U", has_kind=False)
def server_rack(a: Asset) -> None:
    posts = [box((x, 0, z), (x + 4, 130, z + 4)) for x in (-30.0, 26.0) for z in (0.0, 66.0)]
    plates = [box((-30, y, 0), (30, y + 3, 70)) for y in (0.0, 127.0)]
    a.add("cabinet", merge(*posts, *plates, *(box((x, 3, 4), (x + 0.6, 127, 66)) for x in (-30.0, 29.4))), "steel_dark")
    a.add("servers", copies(box((-25, 10, 8), (25, 18.4, 66)), [(0, 9.0 * k, 0) for k in range(5)]), "plastic_black")
    a.add("patch_panel", box((-25, 92, 50), (25, 96.4, 66)), "steel_light")
    leds = [box((-22, 14 + 9.0 * k, 66), (-21, 15 + 9.0 * k, 66.1)) for k in range(5)]
    a.add("leds", merge(*leds), "plastic_green")


@asset("ap_router_ax", has_kind=False)
def router(a: Asset) -> None:
    """Router with aerials: 24 wide, 18 high, 15 deep."""
    a.add("case", box((-12, 0, -7), (12, 3.2, 7), 0.8), "plastic_black")
    a.add(
        "antennas", merge(*(cylinder((x, 2, -7.5), 0.6, 16, segments=8) for x in (-10, -3.5, 3.5, 10))), "plastic_black"
    )
    a.add("leds", merge(*(box((x, 1.4, 7), (x + 0.6, 1.8, 7.05)) for x in (-6.0, -4.0, -2.0))), "plastic_green")


@asset("bx_211", has_kind=False)
def cable_box(a: Asset) -> None:
    """Open crate with coiled cables: 40 wide, 24 high, 30 deep."""
    sides = [box((x, 0, -15), (x + 0.6, 22, 15)) for x in (-20.0, 19.4)]
    sides += [box((-19.4, 0, z), (19.4, 22, z + 0.6)) for z in (-15.0, 14.4)]
    a.add("crate", merge(*sides, box((-19.4, 0, -14.4), (19.4, 0.6, 14.4))), "plastic_blue")
    ring = [(9.0, 0.0, 0.0), (6.4, 0.0, 6.4), (0.0, 0.0, 9.0), (-6.4, 0.0, 6.4)]
    loop = tube([*ring, *((-x, y, -z) for x, y, z in ring)], 0.9, 6, closed=True)
    a.add("cables", copies(loop, [(-6, 14, 1), (5, 17, -2), (4, 20, 3)]), "plastic_black")


@asset("Carton_40", has_kind=False, looks="")
def carton(a: Asset) -> None:
    """Closed cardboard box: 40 wide, 30 high, 30 deep."""
    a.add("body", box((-20, 0, -15), (20, 30, 15)), "paper_kraft")
    a.add("tape", box((-20.05, 22, -2.5), (20.05, 30.05, 2.5)), "honey")


@asset("FirstAid_DIN", has_kind=False)
def first_aid(a: Asset) -> None:
    """First aid case for a wall: 30 wide, 22 high, 12 deep, its lower edge at the origin."""
    a.add("case", box((-15, 0, 0), (15, 22, 12), 0.8), "plastic_green")
    a.add("cross", merge(box((-6, 9.5, 12), (6, 12.5, 12.2)), box((-1.5, 5, 12), (1.5, 17, 12.2))), "plastic_white")
    a.add("latches", merge(*(box((x, 20, 12), (x + 3, 23, 13)) for x in (-10.0, 7.0))), "chrome")


@asset("PlatformTrolley", has_kind=False)
def trolley(a: Asset) -> None:
    """Platform trolley with a push bar: 50 wide, 95 high, 80 deep."""
    a.add("deck", box((-25, 14, -40), (25, 17, 40), 0.6), "plastic_blue")
    a.add("push_bar", tube([(-22, 17, -38), (-22, 94, -41), (22, 94, -41), (22, 17, -38)], 1.4, 8), "chrome")
    wheel = moved(cylinder((0, -1.8, 0), 6, 3.6), turn=(0, 0, 90))
    a.add("wheels", copies(wheel, [(x, 6, z) for x in (-19, 19) for z in (-30, 30)]), "plastic_black")
    a.surfaces["deck"] = 17.0


@asset("REG_4", has_kind=False)
def steel_shelf(a: Asset) -> None:
    """Storage shelf on four posts: 100 wide, 180 high, 40 deep, its back at z = 0."""
    posts = [box((x, 0, z), (x + 3, 180, z + 3)) for x in (-50.0, 47.0) for z in (0.0, 37.0)]
    a.add("posts", merge(*posts), "steel_dark")
    a.add("boards", merge(*(box((-50, y, 0), (50, y + 3, 40)) for y in (8.0, 62.0, 116.0, 174.0))), "steel_light")
    a.surfaces |= {"low": 11.0, "middle": 65.0, "high": 119.0}


@asset("WT_120", has_kind=False)
def side_table(a: Asset) -> None:
    """Plain work table: 120 wide, 85 high, 60 deep."""
    a.add("top", box((-60, 82, -30), (60, 85, 30), 0.4), "laminate_white")
    legs = [box((x, 0, z), (x + 4, 82, z + 4)) for x in (-58.0, 54.0) for z in (-28.0, 24.0)]
    a.add("legs", merge(*legs), "steel_light")
