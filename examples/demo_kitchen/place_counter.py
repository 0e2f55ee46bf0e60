"""The run of fitted units along the back wall and everything on its worktop."""

from __future__ import annotations

from .layout import INSTANCE, Extras, Frame, Layout, kg

WALL_Z = -209.9
"""Back of fitted things, a millimetre off the wall; centimetres."""
FRONT_Z = WALL_Z + 56.1


def place_counter(scene: Layout, floor: str) -> None:
    """Base units, built-in devices, worktop, sink and hob."""
    run = scene.group("counterRun")
    first = _base_units(scene, floor)
    scene.put(f"{run}/dishWasher", "dishwasher_60", (-120, WALL_Z), on=floor, extras=kg(41))
    top = scene.put(f"{run}/Worktop", "counter_top", (-30, WALL_Z), on=first[0])
    scene.relations += [(top, "on", other) for other in first[1:]]
    sink = scene.fix(f"{run}/sink_steel", "sink_basin", (-50, 90.05, -179.4))
    scene.put(f"{run}/sponge", "sponge", (-16, -184), on=top)
    scene.put(f"{run}/soapDispenser", "soap_pump", (-16, -199), on=top)
    scene.put(f"{run}/tap_swanNeck", "tap_swan", (-50, -205), on=top)
    scene.put(f"{run}/mug_dirty", "mug_enamel", (-61, -186), inside=sink, turn=(0, 130, 0))
    scene.fix(f"{run}/cookerHood", "cooker_hood", (20, 160, WALL_Z))
    _oven(scene, run, floor)
    _hob(scene, top)
    _left_worktop(scene, top)
    _right_worktop(scene, top)


def _base_units(scene: Layout, floor: str) -> list[str]:
    carcasses = []
    left = scene.group("counterRun/baseUnit_L")
    carcasses.append(scene.put(f"{left}/carcass", "base_carcass_60", (-180, WALL_Z), on=floor))
    middle = scene.group("counterRun/sinkUnit")
    carcasses.append(scene.put(f"{middle}/carcass_sink", "sink_carcass_80", (-50, WALL_Z), on=floor))
    right = scene.group("counterRun/baseUnit_R")
    carcasses.append(scene.put(f"{right}/carcass", "base_carcass_60", (80, WALL_Z), on=floor))
    corner = scene.group("counterRun/baseUnit_end")
    carcasses.append(scene.put(f"{corner}/crcs_40", "base_carcass_40", (130, WALL_Z), on=floor))
    for unit, x, prefix, carcass in (
        (left, -180, "drwr_L", carcasses[0]),
        (right, 80, "drwr_R", carcasses[2]),
    ):
        for k, y in enumerate((60.6, 35.4, 10.2)):
            scene.fix(f"{unit}/{prefix}{k + 1}", "drawer_60", (x, y, FRONT_Z), inside=carcass)
    scene.fix(f"{middle}/doorSink_L", "base_door_40", (-69.9, 10.2, FRONT_Z))
    scene.fix(f"{middle}/doorSink_R", "base_door_40", (-30.1, 10.2, FRONT_Z))
    scene.fix(f"{corner}/cab_door", "base_door_40", (130, 10.2, FRONT_Z))
    _inside_base_units(scene, carcasses)
    return carcasses


def _inside_base_units(scene: Layout, carcasses: list[str]) -> None:
    run = f"{scene.root}/counterRun"
    top_drawer, low_drawer = f"{run}/baseUnit_R/drwr_R1", f"{run}/baseUnit_R/drwr_R3"
    drawer = Frame(80, FRONT_Z)
    insert = scene.put(f"{run}/cutleryTray", "cutlery_insert", (0, -26), inside=top_drawer, frame=drawer)
    tray = drawer.within(0, -26)
    for name, asset, x, z in (
        ("cakeFork_1", "dessert_fork", -21.0, 3.0),
        ("cakeFork_2", "dessert_fork", -16.8, 3.0),
        ("teaSpoon_01", "tea_spoon", -11.4, 3.0),
        ("teaSpoon_02", "tea_spoon", -7.0, 3.0),
        ("servingSpoon", "table_spoon", 0.3, 0.0),
        ("steak_knife", "table_knife", 9.4, 0.0),
        ("kitchenScissors", "scissors", 19.1, -2.0),
    ):
        scene.put(f"{run}/{name}", asset, (x, z), inside=insert, frame=tray)
    scene.put(f"{run}/bakingTray", "baking_tray", (0, -26), inside=low_drawer, frame=drawer)
    scene.put(f"{run}/spray_cleaner", "spray_bottle", (-72, -182), inside=carcasses[1], turn=(0, 35, 0))
    scene.put(f"{run}/dishTabs", "tab_box", (-26, -186), inside=carcasses[1])
    scene.put(f"{run}/spareBucket", "bucket", (130, -181), inside=carcasses[3], turn=(0, 80, 0))


def _oven(scene: Layout, run: str, floor: str) -> None:
    group = scene.group("counterRun/ovenGrp")
    oven = scene.put(f"{group}/oven_builtIn", "oven_builtin", (20, WALL_Z), on=floor, extras=kg(34))
    for k, x in enumerate((0.0, 9.0, 31.0, 40.0)):
        scene.fix(f"{group}/ovn_knob_{k + 1}", "oven_knob", (x, 79, WALL_Z + 58.05), turn=(0, 0, 25.0 * k))
    scene.put(f"{run}/roastingPan", "roasting_tin", (20, WALL_Z + 31), inside=oven, extras=kg(1.3))


def _hob(scene: Layout, top: str) -> None:
    group = scene.group("counterRun/hobGrp")
    hob = scene.put(f"{group}/Ceranfeld_60", "hob_ceramic", (20, -179), on=top)
    pot = scene.put(f"{group}/SM_StockPot", "stock_pot", (6, -190), on=hob, extras=kg(1.9))
    scene.put(f"{group}/SM_StockPot_lid", "pot_lid_24", (6, -190), on=pot)
    scene.put(f"{group}/fryingPan_28", "frying_pan_28", (34, -167), on=hob, turn=(0, -12, 0), extras=kg(1.1))
    scene.put(f"{group}/saucepan_cu", "sauce_pan", (6, -167), on=hob, turn=(0, 180, 0))


def _left_worktop(scene: Layout, top: str) -> None:
    run = scene.group("counterRun/worktopLeft")
    scene.put(f"{run}/Microwave", "microwave", (-183, -190), on=top, extras=kg(12.5))
    scene.put(f"{run}/Wasserkocher", "kettle_electric", (-147, -194), on=top, turn=(0, -30, 0), extras=kg(1.1))
    scene.put(f"{run}/sugarTin", "sugar_tin", (-130, -199), on=top)
    scene.put(f"{run}/kitchenScale", "kitchen_scale", (-131.5, -164), on=top)
    about = Extras(mass=0.9, display_name="Rolling pin")
    scene.put(f"{run}/prop_b", "rolling_pin", (-176, -159), on=top, turn=(0, 4, 0), extras=about)
    scene.put(f"{run}/teaTowel", "towel_folded", (-103, -160.5), on=top, turn=(0, 6, 0))
    rack = scene.put(f"{run}/dishRack", "dish_rack", (-102, -185), on=top)
    for k, x in enumerate((-109.1, -105.1, -101.1)):
        scene.put(f"{run}/plate_drying_{k + 1}", "side_plate", (x, -185), inside=rack, turn=(0, 0, 90))
    spices = scene.fix(f"{run}/spiceRack", "spice_rack", (-128, 119, WALL_Z))
    for k in range(5):
        spot = (-142.4 + 7.2 * k, WALL_Z + 4.1)
        scene.put(f"{run}/spiceJar_{k + 1:02d}", "spice_jar", spot, inside=spices, extras=INSTANCE)


def _right_worktop(scene: Layout, top: str) -> None:
    run = scene.group("counterRun/worktopRight")
    maker = scene.put(f"{run}/coffeeMachine", "coffee_maker", (62, -193), on=top, extras=kg(2.8))
    scene.put(f"{run}/coffeePot_glass", "coffee_jug", (62, -187.5), on=maker, surface="plate", turn=(0, 20, 0))
    board = scene.put(f"{run}/CuttingBoard", "cutting_board", (80, -165.6), on=top)
    scene.put(f"{run}/breadLoaf", "bread_loaf", (75, -169), on=board, turn=(0, 3, 0), extras=kg(0.75))
    scene.put(f"{run}/bread_knife", "bread_knife", (85, -157.4), on=board, turn=(0, 90, 0))
    scene.put(f"{run}/blender", "blender_jug", (91, -196.5), on=top, turn=(0, 40, 0))
    block = scene.put(f"{run}/knifeBlock", "knife_block", (108, -200), on=top)
    for name, asset, x in (("chefKnife", "chef_knife", -3.6), ("knife_util_02", "paring_knife", -0.6)):
        scene.put(f"{run}/{name}", asset, (108 + x, -200), inside=block)
    scene.put(f"{run}/knife_util_03", "paring_knife", (110.4, -200), inside=block)
    crock = scene.put(f"{run}/utensilPot", "utensil_crock", (127, -198), on=top)
    for name, asset, spot, turn in (
        ("ladle", "soup_ladle", (-2.4, 0.0), (0.0, 180.0, 7.0)),
        ("whisk_01", "balloon_whisk", (2.4, 0.0), (0.0, 0.0, -7.0)),
        ("spatula_blk", "turner_slotted", (0.0, 2.4), (7.0, 0.0, 0.0)),
        ("woodenSpoon", "wooden_spoon", (0.0, -2.0), (-6.0, 0.0, 0.0)),
    ):
        scene.put(f"{run}/{name}", asset, (127 + spot[0], -198 + spot[1]), inside=crock, turn=turn)
    scene.put(f"{run}/paperTowel", "paper_towel", (142.3, -200), on=top)
    scene.put(f"{run}/toaster", "toaster", (130.5, -172), on=top, turn=(0, -4, 0), extras=kg(1.6))
    scene.put(f"{run}/oliveOil", "oil_bottle", (106, -186), on=top)
    scene.put(f"{run}/oil_btl_2", "oil_bottle", (99, -183), on=top)
