"""Fridge, wall cupboards and pantry shelf, with what they hold."""

from __future__ import annotations

from .layout import INSTANCE, Extras, Frame, Layout, kg
from .place_counter import WALL_Z


def place_fridge(scene: Layout, floor: str) -> None:
    """The fridge and its contents, shelf by shelf."""
    group = scene.group("coldStore")
    at = Frame(-242, WALL_Z)
    fridge = scene.put(f"{group}/Fridge_01", "fridge_freezer", (0, 0), on=floor, frame=at, extras=kg(68))
    for name, asset, surface, x, z, yaw in (
        ("milkCarton_1", "milk_carton", "s3", -19, 40, 8),
        ("milkCarton_2", "milk_carton", "s3", -10, 39, -5),
        ("orangeJuice", "juice_carton", "s3", 0, 41, 12),
        ("water_btl_02", "water_bottle", "s3", 12, 38, 0),
        ("yoghurt_1", "yoghurt_pot", "s2", -20, 42, 0),
        ("yoghurt_2", "yoghurt_pot", "s2", -11, 43, 30),
        ("yogurt_3", "yoghurt_pot", "s2", -15.5, 33, 70),
        ("butterDish", "butter_dish", "s2", 4, 40, 5),
        ("jam_apricot", "jam_jar_orange", "s2", 19, 43, 0),
        ("eggCarton", "egg_carton", "s1", -7, 41, -4),
        ("ketchup", "ketchup_bottle", "s1", 13, 42, 10),
        ("honey_2", "honey_jar", "s1", 20.5, 32, 0),
        ("casserole_red", "casserole", "floor", -8, 29, 18),
        ("milkBottle", "milk_bottle", "floor", 18, 42, 0),
    ):
        extras = kg(1.03) if asset == "milk_carton" else None
        spot, turn = (float(x), float(z)), (0.0, float(yaw), 0.0)
        scene.put(f"{group}/{name}", asset, spot, inside=fridge, surface=surface, frame=at, turn=turn, extras=extras)
    scene.put(f"{group}/lunchbox", "lunch_box", (13, 26), inside=fridge, surface="s2", frame=at)


def place_wall_units(scene: Layout) -> None:
    """Wall cupboards with doors and knobs, the open shelf, and their contents."""
    scene.group("wallUnits")
    first = _cupboard(scene, "cab_up_01", -180, 60)
    second = _cupboard(scene, "cab_up_02", -129.95, 40)
    third = _cupboard(scene, "cab_up_03", 80.1, 60)
    _crockery(scene, first, second)
    _dry_goods(scene, third)
    _open_shelf(scene)


def _cupboard(scene: Layout, name: str, x: float, width: int) -> str:
    group = scene.group(f"wallUnits/{name}")
    at = Frame(x, WALL_Z)
    carcass = scene.fix(f"{group}/carcass", f"wall_carcass_{width}", (0, 145, 0), at)
    if width == 40:
        scene.fix(f"{group}/door", "wall_door_40", (0, 145, 33.1), at)
        scene.fix(f"{group}/knob", "knob_round", (16, 150, 35.2), at)
        return carcass
    for side, sign in (("L", -1), ("R", 1)):
        scene.fix(f"{group}/door_{side}", "wall_door_30", (15 * sign, 145, 33.1), at)
        scene.fix(f"{group}/knob_{side}", "knob_round", (3 * sign, 150, 35.2), at)
    return carcass


def _crockery(scene: Layout, first: str, second: str) -> None:
    group = scene.group("wallUnits/crockery")
    at, below = Frame(-180, WALL_Z), ""
    for k in range(4):
        path, surface = f"{group}/sidePlate_{k + 1}", "stack" if below else "bottom"
        spot = (-16.0, 16.0)
        below = scene.put(path, "side_plate", spot, on=below, inside=first, surface=surface, frame=at, extras=INSTANCE)
    for k, x in enumerate((4.0, 20.0)):
        scene.put(f"{group}/cerealBowl_{k + 1}", "cereal_bowl", (x, 16), inside=first, surface="bottom", frame=at)
    for k, x in enumerate((-20.0, -10.0, 0.0)):
        scene.put(
            f"{group}/tumbler_{k + 1}",
            "tumbler",
            (x, 22),
            inside=first,
            surface="shelf",
            frame=at,
            extras=INSTANCE,
        )
    scene.put(f"{group}/geo_bowlSmall", "cereal_bowl", (17, 16), inside=first, surface="shelf", frame=at)
    at = Frame(-129.95, WALL_Z)
    for k, (x, z, yaw) in enumerate(((-10.0, 22.0, -35.0), (6.0, 22.0, 20.0), (-6.0, 9.0, -80.0))):
        turn = (0.0, yaw, 0.0)
        scene.put(
            f"{group}/mugLarge_{k + 1}",
            "mug_large",
            (x, z),
            inside=second,
            surface="bottom",
            frame=at,
            turn=turn,
        )
    for k, x in enumerate((-10.0, 0.0, 10.0)):
        scene.put(f"{group}/wineglass_{k + 5}", "wine_glass", (x, 18), inside=second, surface="shelf", frame=at)


def _dry_goods(scene: Layout, cupboard: str) -> None:
    group = scene.group("wallUnits/dryGoods")
    at = Frame(80.1, WALL_Z)
    for name, asset, surface, x, z in (
        ("teaBox", "tea_box", "bottom", -18, 20),
        ("coffee_bag", "coffee_pack", "bottom", -3, 18),
        ("hazelnutSpread", "spread_jar", "bottom", 9, 18),
        ("honey", "honey_jar", "bottom", 19, 18),
        ("jamRaspberry", "jam_jar_raspberry", "shelf", -20, 20),
        ("jam_orange_v2", "jam_jar_orange", "shelf", -10, 20),
        ("model_17", "thermos", "shelf", 4, 18),
        ("can_tomato_3", "food_can", "shelf", 18, 20),
    ):
        about = Extras(documentation="Thermos flask, 1 litre.") if name == "model_17" else None
        spot = (float(x), float(z))
        scene.put(f"{group}/{name}", asset, spot, inside=cupboard, surface=surface, frame=at, extras=about)


def _open_shelf(scene: Layout) -> None:
    group = scene.group("wallUnits/openShelf")
    at = Frame(130.2, WALL_Z)
    shelf = scene.fix(f"{group}/Shelf_open", "wall_shelf_40", (0, 145, 0), at)
    scene.put(f"{group}/obj_0042", "box_grater", (-9, 13), on=shelf, surface="low", frame=at, turn=(0, 20, 0))
    scene.put(f"{group}/emailleTasse", "mug_enamel", (7, 14), on=shelf, surface="low", frame=at, turn=(0, -40, 0))
    scene.put(f"{group}/herbs", "basil_pot", (-7, 12.5), on=shelf, surface="high", frame=at, turn=(0, 45, 0))
    scene.put(f"{group}/candle_02", "candle_stick", (10, 13), on=shelf, surface="high", frame=at)


def place_pantry(scene: Layout, floor: str) -> None:
    """The high open shelf in the corner."""
    group = scene.group("pantry")
    at = Frame(228, WALL_Z)
    shelf = scene.put(f"{group}/Regal_hoch", "pantry_shelf", (0, 0), on=floor, frame=at, extras=kg(27))
    scene.put(f"{group}/toolBox", "tool_box", (-14, 17), on=shelf, surface="s0", frame=at, extras=kg(6.2))
    rack = scene.put(f"{group}/wineRack", "wine_rack", (-17, 2), on=shelf, surface="s1", frame=at)
    for k, (x, level) in enumerate(((-28.0, "low"), (-17.0, "low"), (-6.0, "low"), (-17.0, "high"))):
        name = f"WnBttl_{k + 1}" if k < 3 else "wineBottle_red"
        scene.put(f"{group}/{name}", "wine_bottle", (x, 3), inside=rack, surface=level, frame=at, turn=(90, 0, 0))
    for name, asset, surface, x, z, yaw in (
        ("waterBottle_1", "water_bottle", "s1", 13, 18, 0),
        ("waterBottle_2", "water_bottle", "s1", 24, 15, 0),
        ("cerealBox_flakes", "cereal_flakes", "s2", -25, 18, 6),
        ("cerealBox_flakes_02", "cereal_flakes", "s2", -2, 16, -4),
        ("Muesli_box", "cereal_muesli", "s2", 20, 18, 10),
        ("flourBag", "flour_bag", "s3", -28, 18, 0),
        ("riceBox", "rice_carton", "s3", -14, 18, 8),
        ("storageJar_pasta", "storage_jar", "s3", 2, 18, 0),
        ("can_tomato_1", "food_can", "s3", 15, 20, 40),
        ("can_tomato_2", "food_can", "s3", 24, 16, 90),
        ("servingTray", "serving_tray", "s4", -14, 18, 0),
        ("carafe_spare", "water_carafe", "s4", 17, 18, 0),
        ("atlas_kids", "atlas", "s5", -20, 18, 8),
        ("vase_spare", "flower_vase", "s5", 15, 18, 0),
    ):
        spot, turn = (float(x), float(z)), (0.0, float(yaw), 0.0)
        scene.put(f"{group}/{name}", asset, spot, on=shelf, surface=surface, frame=at, turn=turn)
    tray = f"{group}/servingTray"
    for k, x in enumerate((-24.0, -13.0)):
        scene.put(
            f"{group}/espressoCup_{k + 2}",
            "espresso_cup",
            (x, 18),
            on=tray,
            surface="inside",
            frame=at,
            turn=(0, 40, 0),
        )
