"""Pallet racks, shelves and their loads; centimetres, x east, y north."""

from __future__ import annotations

from .layout import INSTANCE, PLAIN, Area, Extras

Spot = tuple[str, str, float, float, str]
"""Name of the pallet, what it carries, x and y, and the rack level it stands on."""


def place_racks(root: Area) -> None:
    """Four rack bays with ten loaded pallets."""
    racks = root.area("PalletStorage")
    for k, (x, y) in enumerate(((800.0, 1440.0), (1090.0, 1440.0), (800.0, 1130.0), (1090.0, 1130.0))):
        name = f"SM_RackLong_A1_{k + 1:02d}" if k else "SM_RackLong_A1"
        racks.put(name, "pallet_rack", (x, y), extras=INSTANCE)
    one, two, three, four = [path for path, placed in root.scene.placed.items() if placed.key == "pallet_rack"]
    spots: list[Spot] = [
        ("EUR_Pallet_01", "stack", 735, 1440, ""),
        ("EUR_Pallet_03", "crates", 735, 1440, f"{one}#low"),
        ("plt_04", "large", 865, 1440, f"{one}#low"),
        ("EUR_Pallet_05", "stack", 735, 1440, f"{one}#high"),
        ("EUR_Pallet_06", "drums", 1025, 1440, ""),
        ("Palette_07", "stack", 1025, 1440, f"{two}#low"),
        ("EUR_Pallet_08", "medium", 1155, 1440, f"{two}#low"),
        ("pallett_11", "stack", 865, 1130, f"{three}#low"),
        ("plt_12", "crates", 1025, 1130, f"{four}#low"),
        ("EUR_Pallet_13", "stack", 1155, 1130, f"{four}#high"),
    ]
    count = 0
    for name, load, x, y, level in spots:
        pallet = racks.put(name, "pallet", (x, y), on=level or 0.0, extras=INSTANCE)
        count = _load(racks, load, (x, y), pallet, count)


def _load(area: Area, load: str, at: tuple[float, float], pallet: str, count: int) -> int:
    """Puts goods on a pallet; returns the running number of cartons."""
    x, y = at
    if load == "stack":
        names = {"01": "Stack_Cartons_9", "05": "CartonStack_high", "07": "mesh_031", "11": "stk_ctn"}
        area.put(names.get(pallet[-2:], "Stack_Cartons_9_copy"), "carton_stack", (x, y), on=pallet)
    elif load == "crates":
        name = "WoodenCrate_A" if y > 1300 else "crate_wood_02"
        area.put(name, "crate", (x, y), on=pallet, yaw=3 if y > 1300 else -4, extras=Extras(mass=38.0))
    elif load == "drums":
        for k, (dx, dy) in enumerate(((-29, -20), (29, -20), (0, 21))):
            scale = Extras(scale=0.66, instanceable=True)
            area.put(
                ("Drum_Steel_01", "Drum_Steel_02", "Drum_Steel_03")[k],
                "drum",
                (x + dx, y + dy),
                on=pallet,
                extras=scale,
            )
    elif load:
        return _cartons(area, load, at, pallet, count)
    return count


def _cartons(area: Area, load: str, at: tuple[float, float], pallet: str, count: int) -> int:
    large = load == "large"
    spots = ((-31.0, -21.0), (31.0, -21.0), (0.0, 21.0)) if large else ((-40.0, -16.0), (2.0, -16.0), (-20.0, 18.0))
    for dx, dy in spots:
        count += 1
        name = f"SM_CardBox{'A_02' if large else 'B_01'}_{count:02d}"
        name = {"SM_CardBoxA_02_03": "Karton_gross_03", "SM_CardBoxB_01_05": "geo_8"}.get(name, name)
        key = "carton_large" if large else "carton_medium"
        area.put(name, key, (at[0] + dx, at[1] + dy), on=pallet, yaw=round(0.8 * (count % 3), 1), extras=INSTANCE)
    return count


def place_shelves(root: Area) -> None:
    """Three shelving units with bins, totes and small cartons."""
    area = root.area("SmallParts")
    prefix = "aws_robomaker_warehouse_ShelfE_01"
    shelves = [
        area.put(f"{prefix}_{k + 1:03d}", "shelf_unit", (1370.0 + 125 * k, 1565), extras=INSTANCE) for k in range(3)
    ]
    for k in range(3):
        area.put(f"StackingBin_Y_{k + 1}", "stacking_bin", (1330.0 + 26 * k, 1563), on=f"{shelves[0]}#b")
    area.put("Tote_Blue_01", "tote", (1370, 1563), on=f"{shelves[0]}#a")
    area.put("Tote_Blue_02", "tote", (1464, 1563), on=f"{shelves[1]}#a")
    area.put("KLT_03", "tote", (1527, 1563), on=f"{shelves[1]}#a")
    for k in range(3):
        name = ("bx_c03_1", "bx_c03_2", "caja_pequena")[k]
        area.put(name, "carton_small", (1460.0 + 34 * k, 1563), on=f"{shelves[1]}#b", extras=INSTANCE)
    area.put("CardboardBox_open_stock", "carton_open", (1620, 1563), on=f"{shelves[2]}#b", yaw=90)
    area.put("prop_22", "gloves", (1640, 1563), on=f"{shelves[2]}#c")


def place_bulk(root: Area) -> None:
    """Drums, barrels, gas bottles and pallets on the floor by the aisle."""
    area = root.area("BulkGoods")
    spare = area.put("EUR_Pallet_empty", "pallet", (1480, 1200), yaw=90, extras=INSTANCE)
    area.put("EUR_Pallet_empty_top", "pallet", (1481, 1199), on=spare, yaw=91, extras=INSTANCE)
    for k, (x, y) in enumerate(((1600.0, 1180.0), (1664.0, 1190.0))):
        area.put(("OilDrum_200L", "drm_2")[k], "drum", (x, y), yaw=30.0 * k)
    area.put("Fass_blau_1", "barrel", (1730, 1190))
    area.put("fass_blau_2", "barrel", (1740, 1260), yaw=50)
    for k, x in enumerate((1780.0, 1806.0, 1832.0)):
        note = "Argon for the welding bay" if not k else ""
        extras = Extras(documentation=note) if note else PLAIN
        area.put(("GasCylinder_Argon", "GasCylinder_O2", "cyl_3")[k], "gas_bottle", (x, 1580), extras=extras)
