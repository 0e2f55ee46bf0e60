"""The simulated areas, workshop and charging bay; centimetres, x east, y north."""

from __future__ import annotations

from .layout import Area, Extras, kg
from .place_hall import EAST, NORTH, WEST


def place_workshop(root: Area) -> None:
    """Benches and tools: rigid bodies without kind, each with its mass."""
    shop = root.area("workshop", kind="", style="body")
    one = shop.put("workbench_01", "workbench", (1250, 46), yaw=NORTH, extras=kg(64, True))
    two = shop.put("workbench_02", "workbench", (1560, 46), yaw=NORTH, extras=kg(64, True))
    _hand_tools(shop, one)
    _bench_two(shop, two)
    _chest(root)
    shop.put("taburete_2", "stool", (1550, 160), extras=kg(6.2))
    shop.put("bucket_black", "bucket", (1405, 130), yaw=70, extras=kg(0.9))
    shop.put("shovel_d_handle", "shovel", (1830, 28), turn=(8, 0, NORTH), extras=kg(1.9))
    shop.put("cardbox_small_screws", "carton_small", (1600, 46), on=22.0, extras=kg(7.0))


def _hand_tools(shop: Area, bench: str) -> None:
    shop.put("Schraubstock", "vise", (1175, 62), on=bench, yaw=NORTH, extras=kg(11))
    shop.put("hammer_claw", "hammer", (1218, 64), on=bench, yaw=85, extras=kg(0.72))
    shop.put("martillo_02", "hammer", (1241, 60), on=bench, yaw=93, extras=kg(0.72))
    for k in range(3):
        name = ("screwdriver_flat", "screwdiver_02", "sd3")[k]
        shop.put(name, "screwdriver", (1257.0 + 5 * k, 62), on=bench, yaw=88.0 + 3 * k, extras=kg(0.11))
    for k in range(3):
        name = ("wrench_combi_13", "wrench_combi_17", "wrn_19")[k]
        extras = Extras(mass=round(0.1 + 0.06 * k, 2), scale=round(0.8 + 0.2 * k, 1))
        shop.put(name, "wrench", (1280.0 + 6 * k, 60), on=bench, yaw=90, extras=extras)
    shop.put("pliers_combi", "pliers", (1303, 62), on=bench, yaw=100, extras=kg(0.31))
    shop.put("cordless_drill", "drill", (1331, 60), on=bench, yaw=150, extras=kg(1.8))
    shop.put("tape_measure_5m", "tape_measure", (1294, 34), on=bench, yaw=-20, extras=kg(0.28))
    shop.put("work_gloves_pair", "gloves", (1216, 32), on=bench, yaw=12, extras=kg(0.16))


def _bench_two(shop: Area, bench: str) -> None:
    shop.put("bench_grinder", "bench_grinder", (1488, 48), on=bench, yaw=NORTH, extras=kg(14))
    shop.put("tlb_45", "toolbox", (1545, 38), on=bench, yaw=186, extras=kg(8.4))
    shop.put("hand_saw", "saw", (1556, 66), on=bench, yaw=4, extras=kg(0.55))
    shop.put("paint_can_blue", "paint_can", (1588, 34), on=bench, extras=kg(2.6))
    shop.put("paint_can_blue_copy", "paint_can", (1609, 38), on=bench, yaw=60, extras=kg(2.6))
    shop.put("spray_bottle", "spray_bottle", (1620, 58), on=bench, yaw=NORTH, extras=kg(0.6))
    shop.put("obj_23", "hard_hat", (1642, 36), on=bench, yaw=140, extras=kg(0.4))


def _chest(root: Area) -> None:
    """The tool chest, its drawers bodies of their own; the third stands open."""
    chest = root.area("workshop/tool_chest", kind="", style="body")
    chest.put("chest_body", "chest_body", (1735, 40), yaw=NORTH, extras=kg(46))
    for k, pulled in enumerate((0.0, 0.0, 19.0, 0.0)):
        height = (17.0, 35.0, 53.0, 71.0)[k]
        chest.fix(f"chest_drawer_{k + 1}", "chest_drawer", (1735, 40 + pulled, height), NORTH, extras=kg(5.5))


def place_charging(root: Area) -> None:
    """Robots and chargers: plain Xforms with visual and collision, as a simulator's importer leaves them."""
    bay = root.area("charging_bay", kind="", style="sdf")
    bare = Extras(link="")
    bay.put("amr_01", "amr", (2310, 200), yaw=EAST)
    bay.put("amr_02", "amr", (2310, 340), yaw=EAST)
    carrier = bay.put("amr_03", "amr", (1130, 680), yaw=EAST)
    bay.put("charging_dock_1", "dock", (2389, 200), yaw=WEST)
    bay.put("charging_dock_2", "dock", (2389, 340), yaw=WEST)
    bay.fix("battery_charger_48v", "charger", (1990, 12.5, 110), NORTH, extras=bare)
    bay.fix("ladegeraet_2", "charger", (2100, 12.5, 110), NORTH, extras=bare)
    bay.put("robot_arm_6dof", "robot_arm", (1960, 340), yaw=EAST)
    bay.put("tote_pick", "tote", (2038, 345), yaw=90, extras=bare)
    bay.put("model_7", "tote", (1960, 430), yaw=3, extras=bare)
    bay.put("cable_reel", "cable_reel", (1890, 70), yaw=30)
    bay.put("hose_coil", "hose", (2230, 80))
    bay.put("parcel_small", "carton_small", (1125, 680), on=carrier, yaw=95, extras=bare)
    bay.put("bucket_grit", "bucket", (2170, 60), extras=bare)
