"""The room, what is fixed to its walls and ceiling, and what stands alone on its floor."""

from __future__ import annotations

from examples.demo_kitchen.layout import INSTANCE, Extras, Frame, kg

from .assets_room import WINDOWS
from .catalogue import Office

LEFT, RIGHT, BACK, FRONT, TOP = -650.0, 650.0, -480.0, 480.0, 280.0
"""Inner faces of the room, centimetres."""


def place_shell(scene: Office) -> str:
    """Room shell and fixtures; returns the floor's path."""
    shell = scene.group("Shell")
    floor = scene.fix(f"{shell}/Floor_Carpet_grey", "floor_carpet", (0, 0, 0))
    scene.fix(f"{shell}/SM_Ceiling_01", "ceiling_grid", (0, TOP, 0))
    scene.fix(f"{shell}/wall_north", "wall_back", (LEFT, 0, BACK))
    scene.fix(f"{shell}/wall_east", "wall_side", (RIGHT, 0, BACK), turn=(0, -90, 0))
    scene.fix(f"{shell}/wall_west", "wall_side", (LEFT, 0, FRONT), turn=(0, 90, 0))
    scene.fix(f"{shell}/wall_south", "wall_front", (RIGHT, 0, FRONT), turn=(0, 180, 0))
    scene.fix(f"{shell}/partition_print_a", "partition", (-370, 0, 375), turn=(0, 90, 0))
    scene.fix(f"{shell}/GlassWall_Meeting", "glass_wall", (330, 0, -130))
    scene.fix(f"{shell}/Column_01", "column", (-60, 0.3, -80))
    _windows(scene, shell)
    _door(scene, shell)
    _electrics(scene, shell)
    _safety(scene, shell)
    return floor


def _windows(scene: Office, shell: str) -> None:
    names = (("Window_01", "blind_01"), ("Window_02", "blind_02"), ("Fenster_03", "Object_17"))
    for x, (window, blind) in zip(WINDOWS, names, strict=True):
        scene.fix(f"{shell}/{window}", "window", (LEFT + x, 90, BACK))
        scene.fix(f"{shell}/{blind}", "blind", (LEFT + x + 100, 238, BACK))


def _door(scene: Office, shell: str) -> None:
    entry = Frame(250, FRONT, 180)
    scene.fix(f"{shell}/EntranceDoor", "door", (0, 0, 0), entry)
    scene.fix(f"{shell}/door_lever", "lever", (42, 105, -3.4), entry, turn=(0, 0, 180))
    scene.fix(f"{shell}/lightSwitch_entry", "light_switch", (68, 110, 0), entry)
    scene.fix(f"{shell}/ExitSign", "exit_sign", (0, 228, 0), entry)


def _electrics(scene: Office, shell: str) -> None:
    for k, (x, z) in enumerate(((-440, -240), (-440, 60), (-120, -240), (-120, 90), (400, -330), (430, 300))):
        name = f"CeilingLight_{k + 1:02d}" if k < 4 else f"ltg_{k + 1}"
        scene.fix(f"{shell}/{name}", "panel_light", (x, TOP - 0.2, z), extras=INSTANCE)
    scene.fix(f"{shell}/socket_01", "socket", (-250, 30, BACK))
    scene.fix(f"{shell}/socket_02", "socket", (60, 30, BACK))
    scene.fix(f"{shell}/Steckdose_Kueche", "socket", (72, 112, 0), Frame(RIGHT, 40, -90))
    scene.fix(f"{shell}/pCube3", "socket", (0, 30, 0), Frame(LEFT, -80, 90))


def _safety(scene: Office, shell: str) -> None:
    scene.fix(f"{shell}/WallClock", "clock", (0, 212, 0), Frame(RIGHT, 190, -90))
    red = Extras(mass=9.2, documentation="Powder, 6 kg. Checked every two years.")
    scene.fix(f"{shell}/FireExtinguisher_6kg", "extinguisher", (0, 40, 0), Frame(LEFT, 245, 90), extras=red)
    scene.fix(f"{shell}/fire_ext_02", "extinguisher", (0, 40, 0), Frame(120, FRONT, 180), extras=kg(9.2))


def place_greenery(scene: Office, floor: str) -> None:
    """Plants and bins between the desks."""
    group = scene.group("Common")
    scene.put(f"{group}/Plant_Ficus_01", "floor_plant", (-610, -440), on=floor)
    scene.put(f"{group}/Plant_Ficus_02", "floor_plant", (130, -430), on=floor, turn=(0, 70, 0))
    scene.put(f"{group}/Zimmerpflanze", "floor_plant", (600, 440), on=floor, turn=(0, 160, 0))
    scene.put(f"{group}/RecyclingBin_paper", "recycling_bin", (-60, 150), on=floor, turn=(0, 90, 0))
    scene.put(f"{group}/Backpack_blue", "backpack", (-545, 150), on=floor, turn=(0, 40, 0))
    frame = Frame(LEFT, 150, 90)
    scene.fix(f"{group}/PictureFrame_04", "picture", (0, 165, 0), frame)
    scene.fix(f"{group}/Group12", "picture", (-90, 165, 0), frame)
