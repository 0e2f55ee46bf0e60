"""The hall, what is fixed to it, and the goods-in lane; centimetres, x east, y north."""

from __future__ import annotations

from .assets_shell import HEIGHT, LENGTH, WIDTH
from .layout import INSTANCE, Area, Extras

EAST, SOUTH, WEST, NORTH = 90.0, 0.0, -90.0, 180.0
"""Headings: where an asset's front looks."""


def place_shell(root: Area) -> None:
    """Floor, walls, roof, steelwork, doors and windows."""
    shell = root.area("Building")
    shell.fix("Floor_Concrete", "floor", (0, 0, 0))
    shell.fix("Wall_North", "wall_long", (0, WIDTH, 0), SOUTH)
    shell.fix("Wall_South", "wall_long", (LENGTH, 0, 0), NORTH)
    shell.fix("wl_E", "wall_short", (LENGTH, WIDTH, 0), WEST)
    shell.fix("Wall_West_Dock", "wall_dock", (0, 0, 0), EAST)
    shell.fix("Roof_Sheet", "roof", (0, 0, HEIGHT))
    for k, x in enumerate((600.0, 1200.0, 1800.0)):
        shell.fix(f"SM_PillarA_{2 * k + 1:02d}", "column", (x, 880, 0), SOUTH, extras=INSTANCE)
        shell.fix(f"SM_PillarA_{2 * k + 2:02d}", "column", (x, 540, 0), NORTH, extras=INSTANCE)
        shell.fix(("RoofBeam_A", "RoofBeam_B", "polySurface12")[k], "beam", (x, WIDTH / 2, HEIGHT))
    shell.fix("RollerShutter_Dock1", "roller_door", (5, 420, 0), EAST)
    shell.fix("Rolltor_2", "roller_door", (5, 1020, 0), EAST)
    shell.fix("FireDoor_T30", "door_leaf", (2, 1380, 0), EAST)
    shell.fix("FireDoor_T30_handle", "door_handle", (4.5, 1420, 104), EAST)
    names = ("Window_N_01", "Window_N_02", "Window_N_03", "Window_S_01", "wnd_S2", "Window_S_03")
    for name, x in zip(names, (360.0, 1200.0, 2040.0) * 2, strict=True):
        north = name.startswith("Window_N")
        shell.fix(name, "window", (x, WIDTH + 8 if north else -8, 300), SOUTH if north else NORTH)


def place_services(root: Area) -> None:
    """Lamps, pipes, electrics and safety fixtures."""
    mep = root.area("MEP")
    lamps = ("HighBay_LED_1", "HighBay_LED_2", "HighBay_LED_3", "HighBay_LED_4", "HighBay_LED_5", "lt6")
    for k, name in enumerate(lamps):
        mep.fix(name, "highbay_lamp", ((400.0, 1000.0, 2100.0)[k % 3], 400.0 + 800 * (k // 3), HEIGHT - 0.5))
    mep.fix("SprinklerPipe_DN80", "pipe", (1200, 820, 470))
    mep.fix("VentilationDuct", "duct", (1200, 1552, 470))
    mep.fix("AirVent_E1", "vent", (2399.5, 1150, 430), WEST)
    mep.fix("SecurityCam_Dock", "dome_camera", (0.5, 720, 440), EAST)
    mep.fix("cctv_s", "dome_camera", (900, 0.5, 440), NORTH)
    mep.fix("ControlPanel_Dock", "control_panel", (0.5, 1520, 80), EAST)
    mep.fix("WallSocket_CEE_01", "socket", (400, 0.5, 105), NORTH)
    mep.fix("skt_2", "socket", (1420, 0.5, 105), NORTH)
    mep.fix("enchufe_03", "socket", (2399.5, 520, 60), WEST)


def place_safety(root: Area) -> None:
    """Extinguishers, signs, first aid, bollards."""
    safety = root.area("Safety")
    safety.fix("FireExtinguisher_01", "fire_extinguisher", (9, 720, 70), EAST)
    safety.fix("Fire_Extinguiser_02", "fire_extinguisher", (2391, 760, 70), WEST)
    safety.fix("fx_ext", "fire_extinguisher", (1060, 9, 70), NORTH)
    safety.fix("FirstAidCabinet", "first_aid_cabinet", (1425, 0.5, 140), NORTH)
    safety.fix("ExitSign_Door", "exit_sign", (10, 1380, 262), EAST)
    safety.fix("ExitSign_Aisle", "exit_sign", (1200, 700, 490), EAST)
    safety.fix("sign_helmet_mandatory", "safety_sign", (0.5, 670, 150), EAST)
    safety.fix("sgn_02", "safety_sign", (2399.5, 700, 150), WEST)
    for k, y in enumerate((215.0, 625.0, 815.0, 1225.0)):
        safety.fix(f"Bollard_{k + 1}", "bollard", (60, y, 0), extras=INSTANCE)


def place_goods_in(root: Area) -> None:
    """Trucks, cones and what stands along the west wall."""
    lane = root.area("goods_in")
    lane.put("Forklift_Main", "forklift", (330, 700), yaw=EAST, extras=Extras(mass=3900.0))
    lane.put("PalletJack_01", "pallet_jack", (420, 1010), yaw=EAST)
    lane.put("hpt_2", "pallet_jack", (1330, 960), yaw=SOUTH)
    lane.put("HandTruck", "hand_truck", (170, 1290), yaw=200)
    lane.put("StepLadder_Alu", "stepladder", (520, 1420), yaw=30)
    lane.put("ladder_alumnium_4m", "ladder", (560, 1520), turn=(-10, 0, 0))
    for k, (x, y) in enumerate(((1420, 640), (1590, 650), (1590, 740), (1420, 750))):
        name = f"SM_TrafficCone_{k + 1:02d}" if k != 3 else "Object_17"
        lane.put(name, "cone", (x, y), yaw=17.0 * k, extras=INSTANCE)
    lane.put("CautionWetFloor", "wet_floor_sign", (1505, 690), yaw=25)
    lane.put("Barrier_Fold_A", "barrier", (1820, 620), yaw=5)
    lane.put("br3", "barrier", (2100, 618), yaw=-4)
    lane.put("Besen_Hof", "broom", (26, 1290), turn=(0, -8, 0))
    lane.put("Mop_Cotton", "mop", (22, 1255), turn=(0, -6, 0))
    lane.put("Bucket_12L", "bucket", (60, 1270), yaw=40)
    lane.put("DrumTrolley", "trolley", (280, 1180), yaw=75)
