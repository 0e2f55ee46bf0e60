"""The hall and objects fixed to it; centimetres, Y up, front towards +z."""

from scenes.writer.assets import Asset, asset
from scenes.writer.forms import block, disc, legs, rod, turned
from scenes.writer.mesh import copies, merge, moved
from scenes.writer.shapes import bend, box, facet, panel, tube

LENGTH, WIDTH, HEIGHT = 2400.0, 1600.0, 520.0
"""Inside of the hall: east, north, up."""


@asset("Floor_Concrete_24x16")
def floor(a: Asset) -> None:
    """Slab with painted lanes, origin in the south-west corner."""
    a.add("slab_geo", box((0, -20, -WIDTH), (LENGTH, 0, 0)), "concrete_floor")
    lanes = [block((LENGTH - 80, 0.4, 10), (LENGTH / 2, 0, z)) for z in (-560.0, -860.0)]
    a.add("markings", merge(*lanes, block((10, 0.4, 520), (1010, 0, -280))), "floor_marking_yellow")


@asset("Wall_Panel_24m")
def wall_long(a: Asset) -> None:
    """A long wall with three strip windows; front faces the room."""
    holes = [(x, 300.0, x + 320.0, 420.0) for x in (200.0, 1040.0, 1880.0)]
    a.add("panel_geo", panel((LENGTH, HEIGHT, 16), holes, open_back=True), "M_WallPanel")


@asset("wl_1600_blank", looks="")
def wall_short(a: Asset) -> None:
    """A short wall without openings."""
    a.add("wl", panel((WIDTH, HEIGHT, 16), [], open_back=True), "M_WallPanel")


@asset("wl_1600_dock", looks="")
def wall_dock(a: Asset) -> None:
    """A short wall with two dock openings and a door."""
    holes = [(240.0, 0.0, 600.0, 400.0), (840.0, 0.0, 1200.0, 400.0), (1330.0, 0.0, 1430.0, 210.0)]
    a.add("wl", panel((WIDTH, HEIGHT, 16), holes, open_back=True), "M_WallPanel")


@asset("RoofSheet")
def roof(a: Asset) -> None:
    """Roof seen from inside: its lower face only."""
    corners = [(0.0, 0.0, -WIDTH), (LENGTH, 0.0, -WIDTH), (LENGTH, 0.0, 0.0), (0.0, 0.0, 0.0)]
    a.add("sheet_geo", facet(corners), "M_RoofSheet")


@asset("SM_PillarA_02")
def column(a: Asset) -> None:
    """Steel column with foot plate and crash guard."""
    flanges = [block((24, HEIGHT - 32, 2.5), (0, 2, z)) for z in (-11.0, 11.0)]
    a.add("SM_PillarA_02_body", merge(*flanges, block((2, HEIGHT - 32, 22), (0, 2, 0))), "steel_grey")
    a.add("SM_PillarA_02_foot", block((40, 2, 40)), "steel_grey")
    a.add("SM_PillarA_02_guard", block((32, 90, 4), (0, 2, 14.5), 1), "MI_SafetyYellow")


@asset("bm_1600")
def beam(a: Asset) -> None:
    """A roof beam along z, hung by its top."""
    a.add("web", block((2, 26, WIDTH), (0, -28, 0)), "steel_grey")
    a.add("flange", merge(block((20, 2, WIDTH), (0, -2, 0)), block((20, 2, WIDTH), (0, -30, 0))), "steel_grey")


@asset("RollerShutter_360x400")
def roller_door(a: Asset) -> None:
    slats = copies(block((360, 19, 3), bevel=1), [(0, 20.0 * k, 0) for k in range(19)])
    a.add("curtain", slats, "lacquer_white")
    a.add("rails", merge(block((10, 400, 8), (-182, 0, 0)), block((10, 400, 8), (182, 0, 0))), "galvanised")
    a.add("drum_housing", block((390, 44, 44), (0, 380, 12)), "galvanised")


@asset("door_T30_100", "door_T30")
def door_leaf(a: Asset) -> None:
    """Fire door leaf with its frame."""
    a.add("leaf", block((92, 204, 5), (0, 1, 0), 0.5), "lacquer_cream")
    frame = [block((6, 210, 10), (-49, 0, 0)), block((6, 210, 10), (49, 0, 0)), block((92, 5, 10), (0, 205, 0))]
    a.add("frame", merge(*frame), "steel_grey")
    a.add("vision_panel", block((22, 60, 5.6), (16, 120, 0)), "window_glass")


@asset("hw0034")
def door_handle(a: Asset) -> None:
    """Lever with long plate."""
    a.add("plate", block((4, 22, 1), (0, -16, 0.5), 0.3), "chrome")
    a.add(
        "lever", tube([(0, 0, 1), (0, 0, 6), *bend((0, 0, 6), (0.5, 0, 7.5), (4, 0, 7.5), 3), (13, 0, 7)], 1), "chrome"
    )


@asset("WindowStrip_320x120")
def window(a: Asset) -> None:
    """Fixed strip window in four panes."""
    bars = [block((4, 120, 10), (x, 0, 0)) for x in (-158.0, -79.0, 0.0, 79.0, 158.0)]
    rails = [block((312, 4, 10), (0, y, 0)) for y in (0.0, 116.0)]
    a.add("frame", merge(*bars, *rails), "lacquer_white")
    a.add("glass", block((312, 112, 1), (0, 4, 0)), "window_glass")


@asset("lt_hb_200")
def highbay_lamp(a: Asset) -> None:
    """LED high-bay lamp on a rod, hung by its top."""
    a.add("rod", rod((0, 0, 0), (0, -40, 0), 1), "galvanised")
    a.add("driver", block((12, 12, 12), (0, -52, 0), 1), "plastic_black")
    a.add("housing", turned([(8, 14), (20, 6), (22, 0)], (0, -66, 0), 18), "steel_grey")
    a.add("emitter", disc((0, -66.5, 0), 20, 1, "y", 18), "light_panel")


@asset("SecurityCam_Dome")
def dome_camera(a: Asset) -> None:
    """Surveillance camera on a wall arm."""
    a.add("arm", merge(block((10, 14, 2), (0, -7, 1)), rod((0, 0, 2), (0, 0, 22), 2.5)), "plastic_white")
    a.add("base", turned([(8, 0), (8, 5), (6, 7)], (0, -6, 26)), "plastic_white")
    a.add("bubble", turned([(1, 0), (4, 1), (6, 3.4), (7, 7)], (0, -13, 26)), "plastic_black")


@asset("el_0017")
def socket(a: Asset) -> None:
    """Industrial wall socket with lid."""
    a.add("box", block((11, 13, 6), (0, 0, 3), 0.8), "plastic_grey")
    a.add("lid", block((8, 8, 2), (0, 2, 7), 0.8), "plastic_blue")


@asset("el_0102", looks="mtl")
def control_panel(a: Asset) -> None:
    """Wall-mounted control panel with display, buttons and main switch."""
    a.add("enclosure", block((80, 120, 25), (0, 0, 12.5), 0.8), "lacquer_cream")
    a.add("hmi", block((30, 20, 1), (0, 84, 25)), "screen")
    a.add("buttons_green", merge(*(disc((x, 64, 26), 2, 2, "z") for x in (-20.0, -12.0))), "plastic_green")
    a.add("button_estop", disc((18, 64, 27), 3.6, 4, "z"), "plastic_red")
    a.add("main_switch", merge(disc((0, 30, 26), 6, 2, "z"), block((3, 11, 3), (0, 24.5, 28))), "MI_SafetyYellow")


@asset("PipeRun_DN80")
def pipe(a: Asset) -> None:
    """Sprinkler pipe with drops, along x."""
    a.add("main", rod((-700, 0, 0), (700, 0, 0), 4.5, 10), "lacquer_red")
    drops = [rod((x, -3, 0), (x, -22, 0), 1.5) for x in (-600.0, -200.0, 200.0, 600.0)]
    a.add("drops", merge(*drops), "lacquer_red")


@asset("hv_duct_60")
def duct(a: Asset) -> None:
    """Round ventilation duct with flanges, along x."""
    a.add("duct", disc((0, 0, 0), 28, 1200, "x", 16), "galvanised")
    a.add("flanges", merge(*(disc((x, 0, 0), 31, 3, "x", 16) for x in (-598.0, -200.0, 200.0, 598.0))), "galvanised")


@asset("AirVent_Grille")
def vent(a: Asset) -> None:
    """Wall grille with slats."""
    frame = [block((60, 4, 3), (0, y, 1.5)) for y in (0.0, 36.0)] + [
        block((4, 32, 3), (x, 4, 1.5)) for x in (-28.0, 28.0)
    ]
    slats = [moved(block((52, 5, 0.6)), by=(0, 6.0 + 5 * k, 1.5), turn=(40, 0, 0)) for k in range(6)]
    a.add("grille", merge(*frame, *slats), "galvanised")


@asset("sf_001", "FireExtinguisher")
def fire_extinguisher(a: Asset) -> None:
    """Powder extinguisher."""
    a.add("cylinder", turned([(7.5, 0), (8, 1), (8, 38), (6, 43), (2.5, 45)]), "lacquer_red")
    a.add("valve", merge(block((3, 5, 3), (0, 45, 0)), block((3, 2, 13), (0, 50, 2), 0.4)), "plastic_black")
    a.add(
        "hose", tube([(0, 47, 2), *bend((0, 47, 9), (0, 46, 13), (0, 36, 12), 4), (0, 14, 10.5)], 1.1), "rubber_black"
    )


@asset("sf_009", "FirstAid")
def first_aid_cabinet(a: Asset) -> None:
    """Wall cabinet with a cross."""
    a.add("box", block((38, 48, 14), (0, 0, 7), 0.8), "lacquer_white")
    a.add("cross", merge(block((6, 20, 0.4), (0, 14, 14.1)), block((20, 6, 0.4), (0, 21, 14.1))), "plastic_green")
    a.add("lock", disc((15, 24, 14.6), 1.2, 1.4, "z"), "chrome")


@asset("sign_exit")
def exit_sign(a: Asset) -> None:
    """Emergency exit sign, hung by its top."""
    a.add("board", block((60, 30, 4), (0, -38, 0), 0.5), "plastic_green")
    a.add("pictogram", merge(block((14, 18, 4.4), (-14, -32, 0)), block((20, 4, 4.4), (12, -25, 0))), "paper")
    a.add("hangers", merge(*(rod((x, -8, 0), (x, 0, 0), 0.5) for x in (-24.0, 24.0))), "galvanised")


@asset("sign_ppe_40", looks="")
def safety_sign(a: Asset) -> None:
    """Mandatory-helmet sign for a wall."""
    a.add("plate", block((40, 50, 0.4), (0, 0, 0.2)), "paper")
    a.add("disc", disc((0, 28, 0.6), 17, 0.3, "z", 20), "plastic_blue")


@asset("bollard_k90")
def bollard(a: Asset) -> None:
    """Impact bollard."""
    a.add("post", turned([(8, 0), (8, 96), (6, 100)]), "MI_SafetyYellow")
    a.add("bands", merge(*(turned([(8.2, 0), (8.2, 10)], (0, y, 0)) for y in (50.0, 74.0))), "plastic_black")
    a.add("foot", block((26, 1.5, 26)), "steel_grey")


@asset("PartitionWall_300")
def partition(a: Asset) -> None:
    """Glazed office partition, 300 wide."""
    a.add("base", block((300, 100, 8)), "lacquer_white")
    a.add("glazing", block((292, 140, 1.5), (0, 100, 0)), "window_glass")
    a.add("mullions", merge(*legs(300, 6, 240, 6), block((300, 6, 6), (0, 240, 0))), "steel_grey")
