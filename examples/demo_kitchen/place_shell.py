"""The room, what is fixed to its walls and ceiling, and what stands along them."""

from __future__ import annotations

from .layout import Extras, Frame, Layout, kg

LEFT, RIGHT, BACK, FRONT = -275.0, 275.0, -210.0, 210.0
"""Inner faces of the walls, centimetres."""


def place_shell(scene: Layout) -> str:
    """Room shell and fixtures; returns the floor's path."""
    shell = scene.group("shell")
    floor = scene.fix(f"{shell}/floor_tiles", "floor_tiles", (0, 0, 0))
    scene.fix(f"{shell}/Wall_N", "wall_back", (LEFT, 0, BACK))
    scene.fix(f"{shell}/Wall_E", "wall_right", (RIGHT, 0, BACK), turn=(0, -90, 0))
    scene.fix(f"{shell}/Wall_W", "wall_left", (LEFT, 0, FRONT), turn=(0, 90, 0))
    scene.fix(f"{shell}/Wall_S", "wall_front", (RIGHT, 0, FRONT), turn=(0, 180, 0))
    scene.fix(f"{shell}/ceiling", "ceiling_panel", (0, 260, 0))
    _windows(scene, shell)
    _entry(scene, shell)
    _electrics(scene, shell)
    return floor


def _windows(scene: Layout, shell: str) -> None:
    scene.fix(f"{shell}/windowSink", "window_small", (-55, 108, BACK))
    east = Frame(RIGHT, 35, -90)
    scene.fix(f"{shell}/window_02", "window_wide", (0, 90, 0), east)
    sill = scene.fix(f"{shell}/Fensterbank", "window_sill", (0, 86.9, 0), east)
    scene.fix(f"{shell}/radiator_700", "radiator_panel", (0, 16, 0), east)
    scene.fix(f"{shell}/curtainRod", "curtain_rod", (0, 232, 0), east)
    scene.fix(f"{shell}/curtain_L", "curtain_panel", (-99, 14, 0), east)
    scene.fix(f"{shell}/curtain_R", "curtain_panel", (99, 14, 0), east)
    scene.put(f"{shell}/basil", "basil_pot", (-34, 9.5), on=sill, frame=east)
    scene.put(f"{shell}/vase_empty_02", "flower_vase", (6, 9.5), on=sill, frame=east)
    scene.put(f"{shell}/geo_basil_02", "basil_pot", (48, 9.5), on=sill, frame=east, turn=(0, 70, 0))


def _entry(scene: Layout, shell: str) -> None:
    entry = scene.group("shell/entry")
    west = Frame(LEFT, -70, 90)
    scene.fix(f"{entry}/doorFrame", "door_frame", (0, 0.1, 0), west)
    scene.fix(f"{entry}/door_int_LOW", "door_leaf", (0, 0, 0), west)
    scene.fix(f"{entry}/doorLever", "door_lever", (-40, 103, -2), west)
    scene.fix(f"{shell}/lightSwitch", "light_switch", (-62, 110, 0), west)


def _electrics(scene: Layout, shell: str) -> None:
    scene.fix(f"{shell}/socket_01", "wall_socket", (142, 132, BACK))
    scene.fix(f"{shell}/socket_02", "wall_socket", (-152, 128, BACK))
    scene.fix(f"{shell}/skt_03", "wall_socket", (0, 30, 0), Frame(LEFT, 165, 90))
    scene.fix(f"{shell}/ceilingLight", "flush_light", (-60, 260, -105))
    scene.fix(f"{shell}/smokeAlarm", "smoke_alarm", (-180, 260, 60))
    scene.fix(f"{shell}/pendant_table", "pendant_large", (90, 260, 80))
    scene.fix(f"{shell}/pendant_bar_L", "pendant_small", (-150, 260, -40))
    scene.fix(f"{shell}/pendant_bar_R", "pendant_small", (-90, 260, -40))


def place_wall_decor(scene: Layout) -> None:
    """Things that hang on the walls."""
    decor = scene.group("wallDecor")
    west = Frame(LEFT, 95, 90)
    scene.fix(f"{decor}/pictureFrame_L", "picture_large", (-8, 170, 0), west)
    scene.fix(f"{decor}/pictureFrame_02", "picture_small", (48, 172, 0), west)
    scene.fix(f"{decor}/wallClock", "wall_clock", (0, 196, 0), Frame(LEFT, 8, 90))
    scene.fix(f"{decor}/SM_Chalkboard", "chalk_board", (0, 150, 0), Frame(165, FRONT, 180))
    scene.fix(f"{decor}/picture_small_v2", "picture_small", (0, 160, 0), Frame(-140, FRONT, 180))
    extras = kg(9.4)
    scene.fix(f"{decor}/fireExtinguisher", "fire_extinguisher", (0, 62, 8.5), Frame(LEFT, 12, 90), extras=extras)


def place_corners(scene: Layout, floor: str) -> None:
    """Cleaning things, the reading corner and the plant."""
    cleaning = scene.group("cleaningCorner")
    # The broom leans on the wall: its lean follows from its foot's distance.
    scene.put(f"{cleaning}/broom", "broom", (-254.3, 183), on=floor, turn=(0, 90, 8))
    scene.put(f"{cleaning}/Bucket_blue", "bucket", (-222, 190), on=floor, turn=(0, 25, 0), extras=kg(0.8))
    scene.put(f"{cleaning}/dustpan", "dust_pan", (-190, 184), on=floor, turn=(0, 160, 0))
    scene.put(f"{cleaning}/stepladder", "step_ladder", (248.5, 184), on=floor, turn=(0, -90, 0))
    scene.put(f"{cleaning}/rubbishBin", "pedal_bin", (169, -192), on=floor)
    scene.put(f"{cleaning}/trashBag", "trash_bag", (172.5, -147), on=floor)
    corner = scene.group("readingCorner")
    seat = Frame(-135, 152, 155)
    chair = scene.put(f"{corner}/Sessel_01", "lounge_chair", (0, 0), on=floor, frame=seat, extras=kg(24))
    scene.put(f"{corner}/teddy_LOW", "teddy", (11, 21), on=chair, surface="seat", frame=seat, turn=(0, 10, 0))
    pillow_lean = (-10.0, 155.0, 0.0)
    x, z = seat.world(-4, -18.5)
    scene.put(f"{corner}/cushion_big", "throw_pillow", (x, z), on=chair, surface="seat", turn=pillow_lean)
    scene.put(f"{corner}/shoppingBasket", "shopping_basket", (-70, 188), on=floor, turn=(0, 8, 0))
    scene.put(f"{corner}/plant_tall", "floor_plant", (241, -125), on=floor, turn=(0, 30, 0))
    scene.put(f"{corner}/wateringCan", "watering_can", (206, -85), on=floor, turn=(0, 205, 0))


def place_sideboard(scene: Layout, floor: str) -> None:
    """The sideboard on the left wall and what stands on it."""
    group = scene.group("sideboard")
    west = Frame(LEFT, 95, 90)
    board = scene.put(f"{group}/Cuboard", "sideboard", (0, 0), on=floor, frame=west, extras=kg(46))
    scene.put(f"{group}/birdCage", "bird_cage", (-43, 21.5), on=board, frame=west)
    vase = scene.put(f"{group}/vase_tall", "flower_vase", (-15, 20), on=board, frame=west)
    scene.put(f"{group}/tulips", "tulips", (-15, 20), inside=vase, frame=west)
    stand = scene.put(f"{group}/cakeStand", "cake_stand", (13, 21), on=board, frame=west)
    scene.put(f"{group}/layerCake", "layer_cake", (13, 21), on=stand, frame=west)
    about = Extras(documentation="Valve radio, works on mains only.")
    scene.put(f"{group}/radio_old", "radio_retro", (44, 20), on=board, frame=west, extras=about)
