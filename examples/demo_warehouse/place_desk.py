"""Packing station and office corner; centimetres, x east, y north."""

from __future__ import annotations

from .layout import INSTANCE, Area, Extras
from .place_hall import EAST, NORTH, SOUTH, WEST


def place_packing(root: Area) -> None:
    """Conveyor, two packing tables and their tools."""
    area = root.area("PackingStation")
    first = area.put("ConveyorRoller_01", "conveyor", (500, 430))
    second = area.put("ConveyorRoller_02", "conveyor", (801, 430))
    for k, x in enumerate((400.0, 520.0, 720.0)):
        name, belt = f"SM_CardBoxB_01_{k + 21}", first if x < 650 else second
        area.put(name, "carton_medium", (x, 430), on=belt, yaw=4.0 - 5 * k, extras=INSTANCE)
    area.put("Tote_Conveyor", "tote", (610, 430), on=first, yaw=2)
    area.put("SM_CardBoxA_02_24", "carton_large", (850, 430), on=second, yaw=-3, extras=INSTANCE)
    tables = [area.put(f"PackingTable_{k + 1}", "packing_table", (460.0 + 240 * k, 190), yaw=NORTH) for k in range(2)]
    _table_one(area, tables[0])
    _table_two(area, tables[1])
    _around(area)


def _table_one(area: Area, table: str) -> None:
    area.put("ParcelScale", "bench_scale", (520, 195), on=table, yaw=NORTH)
    area.put("LabelPrinter", "label_printer", (400, 182), on=table, yaw=NORTH)
    area.put("CardboardBox_open", "carton_open", (458, 195), on=table, yaw=NORTH)
    area.put("TapeDispenser_1", "tape_dispenser", (418, 218), on=table, yaw=200)
    area.put("BoxCutter", "cutter", (384, 222), on=table, yaw=30)
    area.put("Barcode_Scaner_1", "barcode_scanner", (378, 196), on=table, yaw=NORTH)
    area.put("Monitor_Packing", "monitor", (430, 166), on=f"{table}#shelf", yaw=NORTH)
    area.put("bx_c03_11", "carton_small", (490, 166), on=f"{table}#shelf", extras=INSTANCE)
    area.put("bx_c03_12", "carton_small", (522, 166), on=f"{table}#shelf", yaw=4, extras=INSTANCE)


def _table_two(area: Area, table: str) -> None:
    for k in range(2):
        name = ("ParcelBag_01", "parcel_bag_copy")[k]
        area.put(name, "parcel_bag", (640.0 + 42 * k, 190), on=table, yaw=5.0 * k - 4)
    area.put("TapeDispenser_2", "tape_dispenser", (756, 212), on=table, yaw=170)
    area.put("scn_02", "barcode_scanner", (768, 180), on=table, yaw=NORTH)
    area.put("pCube14", "cutter", (740, 172), on=table, yaw=75)
    area.put("WorkGloves_Pair", "gloves", (650, 219), on=table, yaw=15)
    area.put("Taza_blanca", "mug", (770, 219), on=table, yaw=40)
    area.put("kbd", "keyboard", (700, 166), on=f"{table}#shelf", yaw=NORTH)


def _around(area: Area) -> None:
    trolley = area.put("PlatformTrolley_01", "trolley", (870, 280), yaw=EAST)
    area.put("SM_CardBoxA_02_25", "carton_large", (872, 280), on=trolley, yaw=92, extras=INSTANCE)
    area.put("WheelieBin_Cardboard", "wheelie_bin", (880, 50), yaw=NORTH)
    area.put("wheelieBin_Residual", "wheelie_bin", (950, 52), yaw=NORTH)
    area.put("WasteBasket_Packing", "waste_basket", (580, 250))
    pallet = area.put("EUR_Pallet_outbound", "pallet", (250, 110), yaw=2, extras=INSTANCE)
    area.put("Group_12", "carton_stack", (250, 110), on=pallet, yaw=2)
    area.put("packing_stool", "stool", (620, 330))


def place_office(root: Area) -> None:
    """Two desks, filing cabinet and lockers behind a glazed partition."""
    area = root.area("Office_NE")
    area.put("PartitionWall_1", "partition", (1880, 1150), yaw=EAST)
    area.put("PartitionWall_2", "partition", (1880, 1450), yaw=EAST)
    area.put("PartitionWall_3", "partition", (2246, 1000), yaw=SOUTH)
    north = area.put("Desk_North", "desk", (2050, 1550), yaw=SOUTH)
    east = area.put("Desk_East", "desk", (2352, 1270), yaw=WEST)
    area.put("OfficeChair_1", "office_chair", (2045, 1475), yaw=170)
    area.put("silla_oficina", "office_chair", (2275, 1275), yaw=80)
    _desk_north(area, north)
    _desk_east(area, east)
    _filing(root)
    area.put("Lockers_Staff_A", "lockers", (1912, 1140), yaw=EAST)
    second = area.put("Lockers_Staff_B", "lockers", (1912, 1262), yaw=EAST)
    area.put("HardHat_Yellow_1", "hard_hat", (1910, 1235), on=second, yaw=80)
    area.put("HardHat_Yellow_2", "hard_hat", (1912, 1280), on=second, yaw=110)
    area.fix("SafetyVest_hanging", "vest", (2399.5, 1440, 108), WEST)
    area.fix("SafetyVest_hanging_1", "vest", (2399.5, 1510, 108), WEST)
    area.put("WasteBasket_Office", "waste_basket", (2150, 1500))


def _desk_north(area: Area, desk: str) -> None:
    area.put("Monitor_24_a", "monitor", (2044, 1565), on=desk)
    area.put("Keyboard_DE", "keyboard", (2047, 1532), on=desk)
    area.put("DeskLamp", "desk_lamp", (1988, 1560), on=desk, yaw=20)
    area.put("wtr_btl", "water_bottle", (2120, 1545), on=desk)
    area.put("DesktopPC", "computer", (2105, 1545), yaw=SOUTH)


def _desk_east(area: Area, desk: str) -> None:
    area.put("Monitor_24_c", "monitor", (2372, 1275), on=desk, yaw=WEST)
    area.put("Keyboard_DE_2", "keyboard", (2334, 1275), on=desk, yaw=WEST)
    for k in range(3):
        name = ("Binder_A4_1", "Binder_A4_2", "Node_0x4")[k]
        area.put(name, "binder", (2376, 1322.0 + 8.4 * k), on=desk, yaw=WEST)
    area.put("pc_2", "computer", (2365, 1215), yaw=WEST)


def _filing(root: Area) -> None:
    """The filing cabinet: carcass and drawers are components of their own."""
    unit = root.area("Office_NE/FilingCabinet_01")
    unit.put("cabinet_body", "cabinet_body", (2200, 1568))
    for k in range(3):
        extras = Extras(display_name=("Delivery notes", "Invoices", "")[k])
        unit.fix(f"drawer_{k + 1}", "cabinet_drawer", (2200, 1568, (2.5, 36.0, 69.5)[k]), extras=extras)
