"""The meeting corner and the reception."""

from __future__ import annotations

from examples.demo_kitchen.layout import Extras, Frame, kg

from .catalogue import Office
from .place_desks import Item, put_all
from .place_shell import BACK, FRONT, RIGHT, TOP


def place_meeting(scene: Office, floor: str) -> None:
    """Table with six chairs, projector and whiteboard in the right back corner."""
    group = scene.group("Meeting_Area")
    centre = Frame(400, -300)
    rug = scene.put(f"{group}/Rug_Round_Meeting", "round_rug", (0, 0), on=floor, frame=centre)
    table = scene.put(f"{group}/ConferenceTable_240", "meeting_table", (0, 0), on=rug, frame=centre, extras=kg(72))
    chairs = (
        "MeetingChair_01",
        "MeetingChair_02",
        "MeetingChair_03",
        "mtg_chr_4",
        "MeetingChair_05",
        "Meeting_Chiar_06",
    )
    for k, name in enumerate(chairs):
        x, back = (-75.0 + 75.0 * (k % 3)), k >= 3
        spot, yaw = (x, -78.0 if back else 78.0), (0.0 if back else 180.0)
        scene.put(f"{group}/{name}", "visitor_chair", spot, on=floor, frame=centre, turn=(0, yaw + 6 * (k - 2), 0))
    items: tuple[Item, ...] = (
        ("ConferencePhone_Spider", "conference_phone", 0, 0, 30),
        ("WaterCarafe_1L", "carafe", -40, 6, 0),
        ("Tumbler_01", "tumbler", -52, -12, 0),
        ("Tumbler_02", "tumbler", -30, -16, 0),
        ("gls_3", "tumbler", 62, 24, 0),
        ("WaterBottle_still_05", "water_bottle", 50, -14, 0),
        ("wtr_2", "water_bottle", 58, -8, 0),
        ("laptop_guest", "laptop", 84, 22, 10),
    )
    put_all(scene, group, table, centre, items)
    scene.put(f"{group}/pen_05", "pen", (30, 28), on=table, frame=centre, turn=(0, 40, 90))
    _boards(scene, group)


def _boards(scene: Office, group: str) -> None:
    projector = Extras(mass=3.4, display_name="Ceiling projector")
    scene.fix(f"{group}/EPX_2600_01", "projector", (400, TOP - 0.2, -230), turn=(0, 180, 0), extras=projector)
    scene.fix(f"{group}/ProjectionScreen_220", "projection_screen", (400, 258, BACK))
    east = Frame(RIGHT, -300, -90)
    board = scene.fix(f"{group}/Whiteboard_180x120", "whiteboard", (0, 90, 0), east)
    for name, asset, x in (
        ("whiteboard_marker_red", "marker", -24.0),
        ("wb_marker_02", "marker", -6.0),
        ("pSphere_1", "marker", 10.0),
        ("board_eraser", "eraser", 28.0),
    ):
        scene.put(f"{group}/{name}", asset, (x, 5.8), on=board, surface="ledge", frame=east)
    scene.fix(f"{group}/skt_meeting", "socket", (110, 30, 0), east)


def place_reception(scene: Office, floor: str) -> None:
    """The counter by the entrance and the waiting corner."""
    group = scene.group("Reception")
    frame = Frame(40, 350, 90)
    counter = scene.put(f"{group}/Reception_Counter", "reception_desk", (0, 0), on=floor, frame=frame, extras=kg(95))
    behind: tuple[Item, ...] = (
        ("Monitor_reception", "monitor", 20, 4, 180),
        ("Keyboard_reception", "keyboard", 20, -24, 180),
        ("mouse_reception", "mouse", -12, -24, 180),
        ("VoIP_Phone_7841", "desk_phone", -50, -16, 200),
        ("rtr_ax", "router", 76, 10, 180),
    )
    put_all(scene, group, counter, frame, behind, "work")
    above: tuple[Item, ...] = (
        ("tissue_box_2", "tissue_box", 80, 25, 0),
        ("plant_tiny", "desk_plant", -86, 26, 0),
        ("PictureFrame_small", "photo_frame", -62, 26, 170),
    )
    put_all(scene, group, counter, frame, above, "ledge")
    scene.put(f"{group}/ReceptionChair", "task_chair", (10, -72), on=floor, frame=frame, turn=(0, 10, 0))
    scene.put(f"{group}/HandSanitizer_Post", "sanitizer", (160, 440), on=floor, turn=(0, 180, 0))
    scene.put(f"{group}/CoatRack_175", "coat_rack", (350, 445), on=floor)
    stand = scene.put(f"{group}/Paragueros", "umbrella_stand", (385, 456), on=floor)
    scene.put(f"{group}/Umbrella_black", "umbrella", (382, 456), inside=stand, turn=(0, 0, 3))
    scene.put(f"{group}/umb_2", "umbrella", (388, 456), inside=stand, turn=(0, 120, 3))
    _waiting(scene, group, floor)


def _waiting(scene: Office, group: str, floor: str) -> None:
    rug = scene.put(f"{group}/Rug_Lounge", "rug", (500, 330), on=floor)
    table = scene.put(f"{group}/Lounge_Table_80", "coffee_table", (500, 330), on=rug)
    scene.put(f"{group}/Sofa_2Seater", "sofa", (500, 433), on=floor, turn=(0, 180, 0), extras=kg(48))
    scene.put(f"{group}/LoungeChair_petrol", "armchair", (590, 260), on=floor, turn=(0, -60, 0))
    scene.put(f"{group}/Magazine_01", "magazine", (490, 338), on=table, turn=(0, 20, 0))
    scene.put(f"{group}/Magazine_02", "magazine", (514, 320), on=table, turn=(0, -50, 0))
    scene.put(f"{group}/Object_08", "backpack", (420, 300), on=floor, turn=(0, 200, 0))
    for k, (name, x) in enumerate((("PictureFrame_01", 580.0), ("PictureFrame_02", 490.0))):
        scene.fix(f"{group}/{name}", "picture", (0, 160 + 4 * k, 0), Frame(x, FRONT, 180))
