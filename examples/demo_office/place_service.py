"""The kitchenette niche and the print room; nothing below the print room has a kind."""

from __future__ import annotations

from examples.demo_kitchen.layout import Extras, Frame, kg

from .catalogue import Office
from .place_desks import Item, put_all
from .place_shell import FRONT, RIGHT
from .write import BARE


def place_kitchenette(scene: Office, floor: str) -> None:
    """The run along the right wall with everything on it."""
    group = scene.group("kitchenette")
    frame = Frame(RIGHT - 0.5, 0, -90)
    run = scene.put(f"{group}/Kitchenette_Unit_180", "kitchen_run", (0, 0), on=floor, frame=frame)
    scene.fix(f"{group}/Sink_Steel", "sink", (50, 90.1, 31), frame)
    items: tuple[Item, ...] = (
        ("tap_mixer", "tap", 50, 6, 0),
        ("CoffeeMachine_CafeLine", "coffee_machine", -20, 26, 0),
        ("Microwave_20L", "microwave", -64, 22, 0),
        ("Kettle_17", "kettle", 10, 16, 30),
        ("Mug_white_04", "mug", -2, 44, 15),
        ("EspressoCup_01", "espresso_cup", -50, 48, 0),
        ("EspressoCup_02", "espresso_cup", -60, 50, 70),
        ("SugarPourer", "sugar_pourer", 14, 40, 0),
        ("MilkCarton_UHT", "milk_carton", 5, 34, 20),
        ("teaspoon_01", "teaspoon", -66, 48, 30),
        ("spn_2", "teaspoon", -72, 47, 30),
        ("glass_4", "tumbler", 80, 20, 0),
        ("glass_5", "tumbler", 80, 32, 0),
    )
    put_all(scene, group, run, frame, items)
    for name, x in (("WallCabinet_90_L", -45.0), ("WallCabinet_90_R", 45.2)):
        scene.fix(f"{group}/{name}", "wall_cupboard", (x, 145, 0.1), frame)
    fridge = scene.put(f"{group}/MiniFridge_85", "fridge", (120, 0), on=floor, frame=frame, extras=kg(29))
    scene.put(f"{group}/Plant_herb", "desk_plant", (112, 26), on=fridge, frame=frame)
    tank = Extras(display_name="Water cooler")
    scene.put(f"{group}/WD_C18_waterDispenser", "water_dispenser", (-112, 0), on=floor, frame=frame, extras=tank)
    scene.put(f"{group}/KitchenBin", "waste_basket", (166, 20), on=floor, frame=frame)


def place_print_room(scene: Office, floor: str) -> None:
    """Copier, shelf and cabinets in the left front corner, as plain references."""
    group = scene.group(BARE)
    south = Frame(-500, FRONT - 0.5, 180)
    scene.put(f"{group}/MFP_C4500_copier", "copier", (-70, 0), on=floor, frame=south, extras=kg(110))
    shelf = scene.put(f"{group}/SteelShelf_4tier", "steel_shelf", (30, 0), on=floor, frame=south)
    for k, name in enumerate(("PaperReam_A4_01", "PaperReam_A4_02", "ream_3")):
        scene.put(f"{group}/{name}", "ream", (-30 + 26 * k, 20), on=shelf, surface="middle", frame=south)
    scene.put(f"{group}/ream_4", "ream", (-30, 20), on=f"{group}/PaperReam_A4_01", frame=south, turn=(0, 3, 0))
    scene.put(f"{group}/CableBox_misc", "cable_box", (-22, 20), on=shelf, surface="low", frame=south)
    scene.put(f"{group}/LJ_M402_spare", "printer", (-24, 20), on=shelf, surface="high", frame=south)
    scene.put(f"{group}/Carton_toner", "carton", (22, 20), on=shelf, surface="high", frame=south)
    rack = Extras(documentation="Network and file servers of this floor.")
    scene.put(f"{group}/ServerRack_24U", "server_rack", (110, 0), on=floor, frame=south, extras=rack)
    scene.put(f"{group}/router_01", "router", (110, 30), on=f"{group}/ServerRack_24U", frame=south)
    west = Frame(-650, 340, 90)
    table = scene.put(f"{group}/sorting_table", "side_table", (0, 31), on=floor, frame=west)
    tools: tuple[Item, ...] = (
        ("stapler_blk", "stapler", 30, 46, 20),
        ("HolePunch_2", "hole_punch", 10, 44, -10),
    )
    put_all(scene, group, table, west, tools)
    scene.fix(f"{group}/FirstAidBox", "first_aid", (-20, 150, 0), west)
    scene.put(f"{group}/Shreder_P4", "shredder", (-398, 445), on=floor, turn=(0, -90, 0))
    scene.put(f"{group}/PlatformTrolley", "trolley", (-440, 350), on=floor, turn=(0, 20, 0))
    deck = f"{group}/PlatformTrolley"
    scene.put(f"{group}/Box_delivery_1", "carton", (-440, 356), on=deck, surface="deck", turn=(0, 24, 0))
    scene.put(f"{group}/node_118", "carton", (-440, 356), on=f"{group}/Box_delivery_1", turn=(0, 10, 0))
    scene.put(f"{group}/Karton_leer", "carton", (-580, 440), on=floor, turn=(0, -12, 0))
