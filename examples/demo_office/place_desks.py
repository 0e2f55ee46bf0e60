"""The open-plan desks and the storage along the left wall."""

from __future__ import annotations

from examples.demo_kitchen.layout import Extras, Frame, Layout, kg

from .catalogue import Office
from .place_shell import LEFT

Item = tuple[str, str, float, float, float]
"""Name, asset, x and z from the middle of the desk (centimetres; one sits at +z), turn in degrees."""

DESKS: dict[str, tuple[Frame, tuple[Item, ...]]] = {
    "Desk_A1": (
        Frame(-440, -200),
        (
            ("Monitor_27_L", "monitor", -33, -18, 12),
            ("Monitor_27_R", "monitor", 32, -18, -12),
            ("Keyboard_01", "keyboard", 0, 14, 0),
            ("mouse_01", "mouse", 30, 17, -6),
            ("DockingStation_01", "dock", 52, 6, -15),
            ("CoffeeMug_01", "mug", -52, 18, 30),
            ("PenHolder_01", "pen_holder", -70, -20, 0),
        ),
    ),
    "Desk_A2": (
        Frame(-278, -200),
        (
            ("mon_L", "monitor", 0, -18, 0),
            ("kbd_03", "keyboard", 0, 14, 0),
            ("mse_3", "mouse", 33, 16, 5),
            ("Laptop_Pro14", "laptop", -52, 4, 25),
            ("desk_phone_1", "desk_phone", 55, -8, -20),
            ("Headset_BT220", "headset", 52, 22, 15),
            ("TissueBox_01", "tissue_box", 62, -30, 0),
        ),
    ),
    "Desk_A3": (
        Frame(-440, -282, 180),
        (
            ("SM_Monitor_27_03", "monitor", -30, -18, 10),
            ("Monitor_27_04", "monitor", 34, -18, -10),
            ("SM_Keyboard_03", "keyboard", 2, 14, 0),
            ("SM_Mouse_03", "mouse", 34, 14, 0),
            ("DeskLamp_Arc", "desk_lamp", -68, -14, 30),
            ("Stapler_red", "stapler", 58, 20, 40),
            ("TapeDispenser", "tape_dispenser", 65, 0, 200),
            ("smartphone", "mobile", -50, 20, 12),
        ),
    ),
    "Desk_A4": (
        Frame(-278, -282, 180),
        (
            ("monitor_curved_copy1", "monitor", 0, -18, 0),
            ("Tastatur_01", "keyboard", 0, 15, 0),
            ("raton_usb", "mouse", 33, 15, 0),
            ("calculator_SL12", "calculator", -45, 16, 10),
            ("letterTray_3tier", "letter_tray", -60, -18, 0),
            ("polySurface9", "photo_frame", 55, -12, -20),
            ("hole_punch", "hole_punch", 60, 18, 25),
        ),
    ),
    "Desk_B1": (
        Frame(-440, 60),
        (
            ("Monitor_27_05", "monitor", -10, -18, 0),
            ("Keybord_wireless", "keyboard", -8, 14, 0),
            ("Mouse_wireless", "mouse", 26, 14, 0),
            ("dockingstation_usb_c", "dock", 40, -22, 0),
            ("Schreibtischlampe", "desk_lamp", 66, -14, -30),
            ("mug_striped_02", "mug", 46, 20, 100),
            ("scissors_21cm", "scissors", -55, 14, 60),
        ),
    ),
    "Desk_B2": (
        Frame(-278, 60),
        (
            ("laptop_02", "laptop", 0, 0, 0),
            ("ms_07", "mouse", 30, 8, 0),
            ("phn_2", "desk_phone", -54, -10, 18),
            ("PhotoFrame_family", "photo_frame", 58, -16, -15),
            ("succulent_small", "desk_plant", 66, 10, 0),
            ("penpot_2", "pen_holder", 44, -22, 0),
            ("Object_23", "stapler", -50, 22, 70),
        ),
    ),
}
CHAIRS = ("ErgoChair_Pro_01", "ErgoChair_Pro_02", "ErgoChair_Pro_03", "chr_04", "OfficeChair_05", "Ofice_Chair_06")
PEDESTALS = ("Pedestal_3Drawer_01", "Pedestal_3Drawer_02", "pedestal_3", "Rollcontainer_04", "ped_05", "Pedestal_06")
TURNS = (12.0, -25.0, 8.0, 35.0, -15.0, 160.0)


def place_desks(scene: Office, floor: str) -> None:
    """Six desks, each a group with chair, drawers and what lies on it; a raised desk apart."""
    scene.group("OpenPlan")
    for k, (name, (frame, items)) in enumerate(DESKS.items()):
        group = scene.group(f"OpenPlan/{name}")
        desk = scene.put(f"{group}/Desk_160x80", "desk", (0, 0), on=floor, frame=frame, extras=kg(38))
        scene.put(f"{group}/{CHAIRS[k]}", "task_chair", (0, 72), on=floor, frame=frame, turn=(0, 180 + TURNS[k], 0))
        scene.put(f"{group}/{PEDESTALS[k]}", "pedestal", (-48, 2), on=floor, frame=frame)
        put_all(scene, group, desk, frame, items)
    _pens(scene)
    plan = f"{scene.root}/OpenPlan"
    for name, x in (("desk_divider_1", -440.0), ("desk_divider_2", -278.0)):
        desk = f"{plan}/Desk_A1/Desk_160x80" if x < -300 else f"{plan}/Desk_A2/Desk_160x80"
        scene.put(f"{plan}/{name}", "divider", (x, -238.5), on=desk)
    scene.put(f"{plan}/wasteBasket_01", "waste_basket", (-359, -120), on=floor)
    scene.put(f"{plan}/WasteBasket_02", "waste_basket", (-180, 60), on=floor)
    scene.put(f"{plan}/Papierkorb", "waste_basket", (-359, -370), on=floor)
    _raised_desk(scene, floor)


def put_all(scene: Layout, group: str, carrier: str, frame: Frame, items: tuple[Item, ...], surface: str = "") -> None:
    """Sets the items down on the carrier."""
    for name, asset, x, z, yaw in items:
        scene.put(f"{group}/{name}", asset, (x, z), on=carrier, surface=surface, frame=frame, turn=(0, yaw, 0))


def _pens(scene: Office) -> None:
    plan = f"{scene.root}/OpenPlan"
    for desk, cup, names in (
        ("Desk_A1", "PenHolder_01", ("ballpen_blue_1", "Mesh_0042")),
        ("Desk_B2", "penpot_2", ("pen_04", "boligrafo_azul")),
    ):
        frame, items = DESKS[desk]
        x, z = next((item[2], item[3]) for item in items if item[0] == cup)
        for k, name in enumerate(names):
            spot, lean = (x - 1.6 + 1.6 * k, z + 1.0 * (-1) ** k), (0.0, 0.0, 8.0 - 8.0 * k)
            scene.put(f"{plan}/{desk}/{name}", "pen", spot, inside=f"{plan}/{desk}/{cup}", frame=frame, turn=lean)


def _raised_desk(scene: Office, floor: str) -> None:
    group = scene.group("OpenPlan/SitStand")
    frame = Frame(60, -260, -90)
    about = Extras(display_name="Sit-stand desk", documentation="Motorised, shown in its upper position.")
    desk = scene.put(f"{group}/TBL_SitStand_140", "standing_desk", (0, 0), on=floor, frame=frame, extras=about)
    items: tuple[Item, ...] = (
        ("Monitor_27_06", "monitor", 0, -14, 0),
        ("keyboard_1", "keyboard", 0, 12, 0),
        ("MX_Mouse", "mouse", 32, 12, 0),
        ("hs_1", "headset", -48, 8, -30),
        ("mug_03", "mug", 52, 6, 60),
    )
    put_all(scene, group, desk, frame, items)


def place_storage(scene: Office, floor: str) -> None:
    """Bookcases, cabinets and the wide drawers along the left wall."""
    group = scene.group("Storage_West")
    for k, z in enumerate((-330.0, -248.0)):
        frame = Frame(LEFT + 0.5, z, 90)
        case = scene.put(f"{group}/Bookcase_{k + 1:02d}", "bookcase", (0, 0), on=floor, frame=frame, extras=kg(41))
        _fill(scene, group, case, frame, k)
    for k, (name, z) in enumerate(
        (("FilingCabinet_4D_01", -160.0), ("FilingCabinet_4D_02", -112.0), ("cab_f3", -64.0))
    ):
        frame = Frame(LEFT + 31.5, z, 90)
        scene.put(f"{group}/{name}", "filing_cabinet", (0, 0), on=floor, frame=frame)
        if k == 0:
            scene.put(f"{group}/cactus_small", "desk_plant", (0, 0), on=f"{group}/{name}", frame=frame)
    unit = scene.group("Storage_West/LateralFile")
    frame = Frame(LEFT + 0.5, 20, 90)
    carcass = scene.put(f"{unit}/carcass_80", "lateral_carcass", (0, 0), on=floor, frame=frame)
    for name, y in (("drawer_bottom", 6.4), ("drawer_top", 39.4)):
        scene.fix(f"{unit}/{name}", "file_drawer", (0, y, 43.2), frame, inside=carcass)
    scene.put(f"{unit}/printer_small_LJ", "printer", (-12, 22), on=carcass, frame=frame, extras=kg(8.6))


def _fill(scene: Office, group: str, case: str, frame: Frame, number: int) -> None:
    """Binders on the third level, books on the fourth; an archive box on the second."""
    binders = ("Binder_A4_", "bndr_")[number]
    for k in range(4 - 2 * number):
        spot = (-32.0 + 9.0 * k, 19.0)
        scene.put(f"{group}/{binders}{k + 1:02d}", "binder", spot, on=case, surface="level3", frame=frame)
    books = ("Book_manual_", "bk_")[number]
    for k in range(3 - number):
        spot = (-30.0 + 4.6 * k, 22.0)
        scene.put(f"{group}/{books}{k + 1}", "manual", spot, on=case, surface="level4", frame=frame)
    box = ("archive_carton_A", "Object_31")[number]
    scene.put(f"{group}/{box}", "carton", (10, 18), on=case, surface="level2", frame=frame)
